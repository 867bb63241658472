//! The formula of the patch, once for every kind of number.
//!
//! One sweep around the sides computes all blends from the coordinates λ and hands them to a [`Sink`]: one sink adds
//! the weighted control points up, another stores the blends themselves.

use casteljau_geom::SurfaceJet;
use casteljau_geom::glam::DVec3;

use crate::jet::Second;
use crate::scalar::{Scalar, power};
use crate::{CenterWeight, CornerPoint, MAX_DEGREE, MAX_LAYERS, Ribbon};

/// What the formula reads of a patch.
#[derive(Clone, Copy)]
pub(crate) struct Net<'a> {
    pub ribbons: &'a [Ribbon],
    pub blend_power: u32,
    pub center_weight: CenterWeight,
    pub center: DVec3,
    /// Whether a negative λ is an error of λ, as with harmonic coordinates, or meant, as with mean value ones.
    pub noise: bool,
    /// In ascending order of the corners.
    pub corner_points: &'a [CornerPoint],
}

/// Receives the blends, before division by their sum.
pub(crate) trait Sink<T> {
    /// μ_j B_j(s) along and B_k(h) across side `side`: the weight of C_{j,k} is along[j]·across[k].
    fn ribbon(&mut self, side: usize, along: &[T], across: &[T]);
    /// The weight of the corner point of that index.
    fn corner_point(&mut self, index: usize, weight: T);
    fn center(&mut self, weight: T);
}

/// Binomial coefficients up to the largest degree.
const BINOMIAL: [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1] = {
    let mut table = [[0.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
    let mut n = 0;
    while n <= MAX_DEGREE {
        table[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            table[n][k] = table[n - 1][k - 1] + table[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    table
};

/// `B_j^d = (d over j) x^j y^{d−j}` for x + y = 1, into the first d + 1 places: products of non-negative numbers, each
/// right to 2d roundings.
#[inline(always)]
pub(crate) fn along_basis<T: Scalar>(degree: usize, x: T, y: T, basis: &mut [T; MAX_DEGREE + 1]) {
    let d = degree.min(MAX_DEGREE);
    let mut x_power = x;
    for j in 1..=d {
        basis[j] = x_power.scale(BINOMIAL[d][j]);
        if j < d {
            x_power = x_power * x;
        }
    }
    let mut y_power = y;
    for j in (0..d).rev() {
        basis[j] = if j == 0 { y_power } else { basis[j] * y_power };
        if j > 0 {
            y_power = y_power * y;
        }
    }
}

/// The first l of `B_k^{2l−1}(h)`, with g = 1 − h given apart because it is known to more digits.
#[inline(always)]
fn across_basis<T: Scalar>(layers: usize, h: T, g: T, basis: &mut [T; MAX_LAYERS]) {
    across_from(layers, h, g, power(g, layers as u32), basis);
}

/// The first l of `B_k^{2l−1}(h)/(1 − h)^l`.
pub(crate) fn across_ratio_basis<T: Scalar>(layers: usize, h: T, g: T, basis: &mut [T; MAX_LAYERS]) {
    across_from(layers, h, g, g.like(1.0), basis);
}

/// (2l−1 over k) h^k g^{l−1−k}·common, k < l.
#[inline(always)]
fn across_from<T: Scalar>(layers: usize, h: T, g: T, common: T, basis: &mut [T; MAX_LAYERS]) {
    let l = layers.clamp(1, MAX_LAYERS);
    let mut h_power = h;
    for k in 1..l {
        basis[k] = h_power.scale(BINOMIAL[2 * l - 1][k]);
        if k + 1 < l {
            h_power = h_power * h;
        }
    }
    let mut g_power = common;
    for k in (0..l).rev() {
        basis[k] = if k == 0 { g_power } else { basis[k] * g_power };
        if k > 0 {
            g_power = g_power * g;
        }
    }
}

/// `B_1^{2l−1}(h)`.
#[inline(always)]
fn first_across<T: Scalar>(layers: usize, h: T, g: T) -> T {
    let degree = 2 * layers - 1;
    let scaled = h.scale(degree as f64);
    if degree > 1 { scaled * power(g, degree as u32 - 1) } else { scaled }
}

/// Hands every blend to `sink` and returns their sum, `None` where it is 1 by construction.
///
/// `lambda(i)` is λ_i. Values below zero, which approximate coordinates have beside the sides, are raised to zero, and so
/// is h where the blends α and β take its powers: then α, β ∈ [0, 1] and no denominator vanishes. This is no threshold:
/// raising is continuous and moves λ by no more than its error, so the bound on the surface's error holds as it stands.
#[inline(always)]
pub(crate) fn sweep<T: Scalar>(
    net: &Net<'_>,
    lambda: impl Fn(usize) -> T,
    sink: &mut impl Sink<T>,
) -> Option<T> {
    let n = net.ribbons.len();
    let (weight, p) = (net.center_weight, net.blend_power);
    let at = |i: usize| lambda(i).clamped(net.noise);

    let mut before = at(n - 1);
    let one = before.like(1.0);
    let mut here = at(0);
    let last = one - (at(n - 2) + before);
    let mut g = before + here;
    let mut h = one - g;
    let (mut alpha, _) = T::blends(last.clamped(net.noise), h.clamped(net.noise), p);
    let mut total = one.like(0.0);
    let mut extra = one.like(if matches!(weight, CenterWeight::Harmonic) { 1.0 } else { 0.0 });
    let mut corner_point = 0;
    // Kept for all sides: with derivatives they are kilobytes, and each side overwrites what it uses.
    let mut along = [one.like(0.0); MAX_DEGREE + 1];
    let mut across = [one.like(0.0); MAX_LAYERS];

    for (i, ribbon) in net.ribbons.iter().enumerate() {
        let after = at(if i + 1 == n { 0 } else { i + 1 });
        let g_after = here + after;
        let h_after = one - g_after;
        let (alpha_after, beta) = T::blends(h.clamped(net.noise), h_after.clamped(net.noise), p);

        let (d, l) = (ribbon.degree().min(MAX_DEGREE), ribbon.layers().min(MAX_LAYERS));
        let (rest, s) = T::shares(before, here);
        along_basis(d, s, rest, &mut along);
        let mut along_sum = one.like(0.0);
        for (j, blend) in along[..=d].iter_mut().enumerate() {
            if 2 * j < d {
                *blend = *blend * alpha;
            } else if 2 * j > d {
                *blend = *blend * beta;
            }
            along_sum = along_sum + *blend;
        }
        across_basis(l, h, g, &mut across);
        let mut across_sum = across[0];
        for blend in &across[1..l] {
            across_sum = across_sum + *blend;
        }
        total = total + along_sum * across_sum;
        sink.ribbon(i, &along[..=d], &across[..l]);

        if let Some(extra_point) = net.corner_points.get(corner_point)
            && extra_point.corner == i
        {
            let next = &net.ribbons[if i + 1 == n { 0 } else { i + 1 }];
            let both = first_across(l, h, g) * first_across(next.layers(), h_after, g_after);
            let blend = (alpha_after * beta).scale(4.5) * both;
            total = total + blend;
            sink.corner_point(corner_point, blend);
            corner_point += 1;
        }
        match weight {
            CenterWeight::Nth => {
                let pair = (h * g) * (h_after * g_after);
                extra = extra + (pair * pair).scale(n as f64);
            }
            CenterWeight::Harmonic => extra = extra * (h * h),
            CenterWeight::None | CenterWeight::Deficiency => {}
        }
        (before, here, g, h, alpha) = (here, after, g_after, h_after, alpha_after);
    }
    match weight {
        CenterWeight::None => Some(total),
        CenterWeight::Deficiency => {
            sink.center(one - total);
            None
        }
        CenterWeight::Nth => {
            sink.center(extra);
            Some(total + extra)
        }
        CenterWeight::Harmonic => {
            let extra = extra.scale(harmonic_factor(n));
            sink.center(extra);
            Some(total + extra)
        }
    }
}

/// (2/9)(1 − 2/n)^(−2n).
fn harmonic_factor(n: usize) -> f64 {
    let n = n as f64;
    2.0 / 9.0 * (1.0 - 2.0 / n).powf(-2.0 * n)
}

/// Σ weight·point, one number a coordinate.
struct PointSum<'a, T> {
    net: &'a Net<'a>,
    sum: [T; 3],
}

impl<T: Scalar> PointSum<'_, T> {
    #[inline(always)]
    fn add(&mut self, point: DVec3, weight: T) {
        self.sum[0] = self.sum[0] + weight.scale(point.x);
        self.sum[1] = self.sum[1] + weight.scale(point.y);
        self.sum[2] = self.sum[2] + weight.scale(point.z);
    }
}

impl<T: Scalar> Sink<T> for PointSum<'_, T> {
    #[inline(always)]
    fn ribbon(&mut self, side: usize, along: &[T], across: &[T]) {
        let ribbon = &self.net.ribbons[side];
        for (row, &blend) in ribbon.control_points().chunks_exact(along.len()).zip(across) {
            let (mut x, mut y, mut z) =
                (along[0].scale(row[0].x), along[0].scale(row[0].y), along[0].scale(row[0].z));
            for (point, &w) in row[1..].iter().zip(&along[1..]) {
                x = x + w.scale(point.x);
                y = y + w.scale(point.y);
                z = z + w.scale(point.z);
            }
            self.sum[0] = self.sum[0] + x * blend;
            self.sum[1] = self.sum[1] + y * blend;
            self.sum[2] = self.sum[2] + z * blend;
        }
    }
    #[inline(always)]
    fn corner_point(&mut self, index: usize, weight: T) {
        self.add(self.net.corner_points[index].point, weight);
    }
    #[inline(always)]
    fn center(&mut self, weight: T) {
        self.add(self.net.center, weight);
    }
}

/// The point of the surface, coordinate by coordinate; `zero` is the number 0.
#[inline(always)]
pub(crate) fn surface<T: Scalar>(net: &Net<'_>, zero: T, lambda: impl Fn(usize) -> T) -> [T; 3] {
    let mut sink = PointSum { net, sum: [zero; 3] };
    match sweep(net, lambda, &mut sink) {
        Some(total) => {
            let inverse = total.reciprocal();
            let [x, y, z] = sink.sum;
            [x * inverse, y * inverse, z * inverse]
        }
        None => sink.sum,
    }
}

/// The value of the surface at one point.
pub(crate) fn point(net: &Net<'_>, lambda: &dyn Fn(usize) -> f64) -> DVec3 {
    DVec3::from_array(surface(net, 0.0, lambda))
}

/// The surface's jet at one point.
pub(crate) fn jet(net: &Net<'_>, lambda: &dyn Fn(usize) -> Second<f64>) -> SurfaceJet {
    surface_jet(surface(net, Second([0.0; 6]), lambda))
}

/// Three coordinates with derivatives as a point with derivatives.
pub(crate) fn surface_jet(coordinates: [Second<f64>; 3]) -> SurfaceJet {
    let [x, y, z] = coordinates.map(|jet| jet.0);
    let part = |i: usize| DVec3::new(x[i], y[i], z[i]);
    SurfaceJet { point: part(0), du: part(1), dv: part(2), duu: part(3), duv: part(4), dvv: part(5) }
}

const _: () = assert!(MAX_LAYERS * 2 - 1 <= MAX_DEGREE);
