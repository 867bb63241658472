//! One tensor-product patch at scattered parameters.
//!
//! Of a low total degree each polynomial is nested Horner schemes in x = u/(1−u) and y = v/(1−v), as in `horner.rs`:
//! one multiply-add a control point and component. The lanes where u or v is 1, and patches of higher degree, take
//! the basis of both parameters and add up rows first.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use std::sync::atomic::{AtomicUsize, Ordering};

use pulp::Scalar;
use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::blocks::store;
use super::horner::{ONE_SIDED, select, splat};
use super::nets::{Nets, ORDERS};
use super::parallel::{CHUNK, each_chunk};
use super::quotient::{lane, largest_weight, refuse_pole, scale, settle, surface, uncertainty};
use super::simd::{Job, Lanes, WIDTH, dispatch, dispatch_in};
use super::{BatchPoint, check_length};
use crate::glam::{DVec2, DVec3, DVec4};
use crate::{BernsteinError, MAX_DEGREE, TensorNet, basis, binomial};

/// Degrees up to this one have their basis in registers on the stack; the number of control points a side is one more.
const MAX_BASIS: usize = 32;

/// A tensor-product patch, `p(u,v) = Σᵢ Σⱼ Bᵢᵐ(u) Bⱼⁿ(v) Pᵢⱼ`, made ready to be evaluated at many scattered parameters.
///
/// For parameters that form a grid, [`GridBatch`](crate::GridBatch) takes a fraction of the time.
///
/// ```
/// use casteljau_bernstein::{PatchBatch, glam::DVec2};
/// let patch = PatchBatch::new(&[0.0, 0.0, 0.0, 1.0], [1, 1])?; // u·v
/// let [mut value, mut in_u, mut in_v] = [[0.0; 2]; 3];
/// patch.evaluate(&[DVec2::new(0.5, 0.25), DVec2::ONE], [&mut value, &mut in_u, &mut in_v])?;
/// assert_eq!((value, in_u, in_v), ([0.125, 1.0], [0.25, 1.0], [0.5, 1.0]));
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone)]
pub struct PatchBatch<P> {
    net: Vec<P>,
    degrees: [usize; 2],
    /// The nets of all orders, without binomial factors.
    plain: Vec<Vec<f64>>,
    /// The same multiplied by `C(m−a,i)·C(n−b,j)`.
    scaled: Vec<Vec<f64>>,
}

impl<P: BatchPoint> PatchBatch<P> {
    /// Prepares the patch with the net `points` of the degrees m (with u) and n (with v), in the order of
    /// [`TensorNet`].
    ///
    /// Cost: memory for twelve nets.
    ///
    /// # Errors
    /// [`BernsteinError::NetLength`] unless there are (m+1)(n+1) points, [`BernsteinError::Degree`] above
    /// [`MAX_DEGREE`].
    pub fn new(points: &[P], degrees: [usize; 2]) -> Result<Self, BernsteinError> {
        TensorNet::new(points, degrees)?;
        let mut nets = Nets::new(degrees, P::DIMENSION, ORDERS.len());
        nets.set(cast_slice(points));
        let plain = nets.into_nets();
        let mut scaled = plain.clone();
        for (net, [a, b]) in scaled.iter_mut().zip(ORDERS) {
            let [Some(m), Some(n)] = [degrees[0].checked_sub(a), degrees[1].checked_sub(b)] else { continue };
            for (at, point) in net.chunks_exact_mut(P::DIMENSION).enumerate() {
                let factor = binomial(m, at / (n + 1)) * binomial(n, at % (n + 1));
                point.iter_mut().for_each(|x| *x *= factor);
            }
        }
        Ok(Self { net: points.to_vec(), degrees, plain, scaled })
    }

    /// Degrees m and n.
    #[must_use]
    pub fn degrees(&self) -> [usize; 2] {
        self.degrees
    }

    /// Values (K = 1), with first (K = 3) and second (K = 6) partial derivatives at the parameters (u, v), each kind
    /// in its own buffer, in the order of [`partial_index`](crate::partial_index): 1; u, v; uu, uv, vv.
    ///
    /// Error: at most `4(m + n + 2(a+b) + 2)·u·scale`, see [the crate](crate). Cost: one multiply-add a component and
    /// control point for each kind; degrees above 31 go one by one through [`TensorNet::partials`].
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless every buffer has the length of `parameters`.
    pub fn evaluate<const K: usize>(
        &self,
        parameters: &[DVec2],
        out: [&mut [P]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(K == 1 || K == 3 || K == 6, "values; first; second derivatives") };
        for out in &out {
            check_length("out", parameters.len(), out.len())?;
        }
        let mut out = out.map(cast_slice_mut::<P, f64>);
        if self.degrees.iter().any(|&d| d >= MAX_BASIS) {
            self.one_by_one(parameters, K, |place, jet| {
                for (out, p) in out.iter_mut().zip(jet) {
                    out[P::DIMENSION * place..][..P::DIMENSION].copy_from_slice(cast_slice(&[*p]));
                }
            });
            return Ok(());
        }
        let view = self.view(cast_slice(parameters));
        match &mut out[..] {
            [a] => view.evaluate::<1, false>(P::DIMENSION, [a]),
            [a, b, c] => view.evaluate::<3, false>(P::DIMENSION, [a, b, c]),
            [a, b, c, d, e, f] => view.evaluate::<6, false>(P::DIMENSION, [a, b, c, d, e, f]),
            _ => Ok(()),
        }
    }

    /// The first `kinds` partial derivatives at each parameter, given to `take` with its place.
    fn one_by_one(&self, parameters: &[DVec2], kinds: usize, mut take: impl FnMut(usize, &[P])) {
        let net = TensorNet::validated(&self.net, self.degrees);
        let mut jet = [P::ZERO; 6];
        for (place, uv) in parameters.iter().enumerate() {
            net.partials(uv.x, uv.y, &mut jet[..kinds]);
            take(place, &jet[..kinds]);
        }
    }

    fn view<'a>(&'a self, parameters: &'a [f64]) -> View<'a> {
        View {
            net: cast_slice(&self.net),
            degrees: self.degrees,
            plain: &self.plain,
            scaled: &self.scaled,
            parameters,
        }
    }
}

impl PatchBatch<DVec4> {
    /// As [`evaluate`](Self::evaluate), for a rational net `(w·x, w·y, w·z, w)`: points and derivatives in space, by the
    /// quotient rule.
    ///
    /// Error: that of numerator and denominator, magnified by 1/|w| once an order.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`], and [`BernsteinError::Pole`] with the first place where the denominator
    /// vanishes within its rounding error, or the quotient is out of range; the buffers hold 0 at such places, and the
    /// answers everywhere else.
    pub fn evaluate_rational<const K: usize>(
        &self,
        parameters: &[DVec2],
        out: [&mut [DVec3]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(K == 1 || K == 3 || K == 6, "values; first; second derivatives") };
        for out in &out {
            check_length("out", parameters.len(), out.len())?;
        }
        let mut out = out.map(cast_slice_mut::<DVec3, f64>);
        let view = self.view(cast_slice(parameters));
        if self.degrees.iter().any(|&d| d >= MAX_BASIS) {
            let mut pole = usize::MAX;
            self.one_by_one(parameters, K, |place, jet| {
                let mut all = [[0.0; 4]; K];
                all.iter_mut().zip(jet).for_each(|(to, p)| *to = p.to_array());
                let (points, _) = surface(Scalar, all, 0.0);
                for (out, point) in out.iter_mut().zip(points) {
                    out[3 * place..3 * place + 3].copy_from_slice(&point);
                }
                if settle(all[0][3], view.bound(place), &mut out, place) {
                    pole = pole.min(place);
                }
            });
            return refuse_pole(pole);
        }
        match &mut out[..] {
            [a] => view.evaluate::<1, true>(4, [a]),
            [a, b, c] => view.evaluate::<3, true>(4, [a, b, c]),
            [a, b, c, d, e, f] => view.evaluate::<6, true>(4, [a, b, c, d, e, f]),
            _ => Ok(()),
        }
    }
}

/// A patch and parameters as plain numbers, so that the kernels are compiled with this crate and once.
#[derive(Clone, Copy)]
struct View<'a> {
    net: &'a [f64],
    degrees: [usize; 2],
    plain: &'a [Vec<f64>],
    scaled: &'a [Vec<f64>],
    /// u and v of each place.
    parameters: &'a [f64],
}

impl View<'_> {
    fn evaluate<const K: usize, const RATIONAL: bool>(
        &self,
        dimension: usize,
        out: [&mut [f64]; K],
    ) -> Result<(), BernsteinError> {
        let width = if RATIONAL { 3 } else { dimension };
        let out = out.map(|out| out.chunks_mut(CHUNK * width));
        let pole = AtomicUsize::new(usize::MAX);
        each_chunk(self.parameters.chunks(2 * CHUNK).enumerate(), out, |(number, parameters), out| {
            let patch = View { parameters, ..*self };
            let job = Scattered::<K, RATIONAL> { patch, out, first: number * CHUNK, pole: &pole };
            if RATIONAL { dispatch_in::<_, 4>(job) } else { dispatch(dimension, job) }
        });
        refuse_pole(pole.into_inner())
    }

    /// The rounding error of the denominator at a place.
    #[cold]
    fn bound(&self, place: usize) -> f64 {
        let [m, n] = self.degrees;
        let mut rows = [[0.0; MAX_DEGREE + 1]; 2];
        basis(self.parameters[2 * place], &mut rows[0][..=m]);
        basis(self.parameters[2 * place + 1], &mut rows[1][..=n]);
        uncertainty(m + n) * scale(self.net, &rows[0][..=m], &rows[1][..=n])
    }
}

struct Scattered<'a, const K: usize, const RATIONAL: bool> {
    patch: View<'a>,
    out: [&'a mut [f64]; K],
    /// The place of the first parameter in the whole batch.
    first: usize,
    /// The first place of a pole.
    pole: &'a AtomicUsize,
}

impl<const K: usize, const RATIONAL: bool> Job for Scattered<'_, K, RATIONAL> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let Self { patch, mut out, first, pole } = self;
        let [m, n] = patch.degrees;
        let weight = if RATIONAL { uncertainty(m + n) * largest_weight(patch.net) } else { 0.0 };
        let count = patch.parameters.len() / 2;
        let mut place = 0;
        while place < count {
            let [u, v] = load_pairs(simd, patch.parameters, place);
            let at = At::new(simd, u, v);
            let mut jet = [[simd.splat_f64s(0.0); D]; K];
            for k in 0..K {
                jet[k] = at.partial(&patch, k);
            }
            if RATIONAL {
                let mut homogeneous = [[simd.splat_f64s(0.0); 4]; K];
                for k in 0..K {
                    for c in 0..D {
                        homogeneous[k][c] = jet[k][c];
                    }
                }
                // Σ|Bᵢ Bⱼ wᵢⱼ| is at most (|1−u| + |u|)ᵐ (|1−v| + |v|)ⁿ times the largest weight.
                let size = |s, t| simd.add_f64s(simd.abs_f64s(s), simd.abs_f64s(t));
                let spread = simd.mul_f64s(simd.power(size(at.su, u), m), simd.power(size(at.sv, v), n));
                let least = simd.mul_f64s(simd.splat_f64s(weight), spread);
                let (points, suspicious) = surface(simd, homogeneous, least);
                for k in 0..K {
                    store(simd, out[k], place, points[k]);
                }
                if simd.any(suspicious) {
                    for l in 0..S::F64_LANES.min(count - place) {
                        let denominator = lane::<S>(homogeneous[0][3], l);
                        if settle(denominator, patch.bound(place + l), &mut out, place + l) {
                            pole.fetch_min(first + place + l, Ordering::Relaxed);
                        }
                    }
                }
            } else {
                for k in 0..K {
                    store(simd, out[k], place, jet[k]);
                }
            }
            place += S::F64_LANES;
        }
    }
}

/// The parameters of as many places as there are lanes; lanes beyond the last repeat it.
#[inline(always)]
fn load_pairs<S: Lanes>(simd: S, parameters: &[f64], place: usize) -> [S::f64s; 2] {
    let pairs = match parameters.get(2 * place..2 * (place + S::F64_LANES)) {
        Some(all) => [simd.load(all, 0), simd.load(all, S::F64_LANES)],
        None => {
            let mut padded = [0.0; 2 * WIDTH];
            let rest = parameters.get(2 * place..).unwrap_or_default();
            padded[..rest.len()].copy_from_slice(rest);
            padded[rest.len()..]
                .as_chunks_mut()
                .0
                .fill([parameters[parameters.len() - 2], parameters[parameters.len() - 1]]);
            [simd.load(&padded, 0), simd.load(&padded, S::F64_LANES)]
        }
    };
    simd.deinterleave(pairs)
}

/// A register of parameters (u, v).
struct At<S: Lanes> {
    simd: S,
    u: S::f64s,
    v: S::f64s,
    /// 1 − u and 1 − v.
    su: S::f64s,
    sv: S::f64s,
    /// u/(1−u) and v/(1−v).
    x: S::f64s,
    y: S::f64s,
    /// The lanes where one of the quotients does not exist.
    ends: S::m64s,
    any_end: bool,
}

impl<S: Lanes> At<S> {
    #[inline(always)]
    fn new(simd: S, u: S::f64s, v: S::f64s) -> Self {
        let (one, zero) = (simd.splat_f64s(1.0), simd.splat_f64s(0.0));
        let (su, sv) = (simd.sub_f64s(one, u), simd.sub_f64s(one, v));
        let ends = simd.or_m64s(simd.equal_f64s(su, zero), simd.equal_f64s(sv, zero));
        let (x, y) = (simd.div_f64s(u, su), simd.div_f64s(v, sv));
        Self { simd, u, v, su, sv, x, y, ends, any_end: simd.any(ends) }
    }

    /// The partial derivative with the place k in the list of orders.
    #[inline(always)]
    fn partial<const D: usize>(&self, patch: &View<'_>, k: usize) -> [S::f64s; D] {
        let [m, n] = patch.degrees;
        let [a, b] = ORDERS[k];
        if a > m || b > n {
            return [self.simd.splat_f64s(0.0); D];
        }
        if m + n > ONE_SIDED {
            return self.by_basis(patch.plain[k].as_chunks().0, m - a, n - b);
        }
        let mut sum = self.by_quotients(patch.scaled[k].as_chunks().0, m - a, n - b);
        if self.any_end {
            let other = self.by_basis(patch.plain[k].as_chunks().0, m - a, n - b);
            sum = select(self.simd, self.ends, other, sum);
        }
        sum
    }

    /// `(1−u)ᵐ (1−v)ⁿ Σᵢ Σⱼ qᵢⱼ xⁱ yʲ`.
    #[inline(always)]
    fn by_quotients<const D: usize>(&self, q: &[[f64; D]], m: usize, n: usize) -> [S::f64s; D] {
        let simd = self.simd;
        let mut sum = [simd.splat_f64s(0.0); D];
        for (i, q) in q.chunks_exact(n + 1).take(m + 1).rev().enumerate() {
            let mut row = splat(simd, &q[n]);
            for q in q[..n].iter().rev() {
                for c in 0..D {
                    row[c] = simd.mul_add_f64s(row[c], self.y, simd.splat_f64s(q[c]));
                }
            }
            for c in 0..D {
                sum[c] = if i == 0 { row[c] } else { simd.mul_add_f64s(sum[c], self.x, row[c]) };
            }
        }
        let power = simd.mul_f64s(simd.power(self.su, m), simd.power(self.sv, n));
        for c in 0..D {
            sum[c] = simd.mul_f64s(sum[c], power);
        }
        sum
    }

    /// `Σᵢ Bᵢᵐ(u) Σⱼ Bⱼⁿ(v) Pᵢⱼ`, m and n less than [`MAX_BASIS`].
    #[inline(always)]
    fn by_basis<const D: usize>(&self, net: &[[f64; D]], m: usize, n: usize) -> [S::f64s; D] {
        let simd = self.simd;
        let (in_u, in_v) = (basis_lanes(simd, self.su, self.u, m), basis_lanes(simd, self.sv, self.v, n));
        let mut sum = [simd.splat_f64s(0.0); D];
        for (row, bu) in net.chunks_exact(n + 1).take(m + 1).zip(&in_u) {
            let mut inner = [simd.splat_f64s(0.0); D];
            for (point, &bv) in row.iter().zip(&in_v) {
                for c in 0..D {
                    inner[c] = simd.mul_add_f64s(bv, simd.splat_f64s(point[c]), inner[c]);
                }
            }
            for c in 0..D {
                sum[c] = simd.mul_add_f64s(*bu, inner[c], sum[c]);
            }
        }
        sum
    }
}

/// `C(n,i) sⁿ⁻ⁱ tⁱ`, n less than [`MAX_BASIS`].
#[inline(always)]
fn basis_lanes<S: Lanes>(simd: S, s: S::f64s, t: S::f64s, n: usize) -> [S::f64s; MAX_BASIS] {
    let mut row = [simd.splat_f64s(1.0); MAX_BASIS];
    let mut power = t;
    for (i, b) in row[..=n].iter_mut().enumerate().skip(1) {
        *b = simd.mul_f64s(power, simd.splat_f64s(binomial(n, i)));
        power = simd.mul_f64s(power, t);
    }
    power = s;
    for b in row[..n].iter_mut().rev() {
        *b = simd.mul_f64s(*b, power);
        power = simd.mul_f64s(power, s);
    }
    row
}
