//! Homogeneous nets in coordinates of their own: centred, scaled by a power of two, of moderate weights.

use casteljau_bernstein::{TensorNet, restrict_tensor};
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_geom::{UNIT_ROUNDOFF, power_of_two_below};

use crate::{ControlPoint, ShapeError};

/// Below this degree the bases of a place are kept on the stack.
const BASIS_ON_STACK: usize = 24;

/// A net of homogeneous points `(w·x, w·y, w·z, w)`, its centre moved to the origin and its size near 1.
///
/// A curve has the degrees (n, 0).
#[derive(Debug, Clone)]
pub(super) struct LocalNet {
    points: Vec<DVec4>,
    degrees: [usize; 2],
    centre: DVec3,
    scale: f64,
    rounding: f64,
    /// Largest weight over least.
    weight_ratio: f64,
}

/// Value and partial derivatives up to order 2 by the net's parameters, in local coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct LocalJet {
    pub point: DVec3,
    pub first: [DVec3; 2],
    /// `second[k + l] = S_kl`
    pub second: [DVec3; 3],
}

impl LocalNet {
    /// Takes a checked net into local coordinates.
    ///
    /// # Errors
    /// [`ShapeError::Weight`] for a weight that is not positive.
    pub fn new(points: &[DVec4], degrees: [usize; 2]) -> Result<Self, ShapeError> {
        check_weights(points)?;
        let euclidean = || points.iter().map(|p| p.xyz() / p.w);
        let (low, high) = euclidean()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let centre = 0.5 * low + 0.5 * high;
        let largest = euclidean().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let size = (0.5 * (high - low).max_element()).max(UNIT_ROUNDOFF * largest);
        let scale = power_of_two_below(size).recip();
        let heaviest_weight = points.iter().map(|p| p.w).fold(0.0, f64::max);
        let heaviest = power_of_two_below(heaviest_weight).recip();
        // Multiplying by a power of two rounds nothing but what is beyond notice.
        let local = |p: &DVec4| ((p.xyz() - centre * p.w) * scale * heaviest).extend(p.w * heaviest);
        let degree = degrees[0] + degrees[1];
        Ok(Self {
            points: points.iter().map(local).collect(),
            degrees,
            centre,
            scale,
            rounding: (16 * (degree + 2)) as f64 * UNIT_ROUNDOFF * (largest * scale).max(2.0),
            weight_ratio: heaviest_weight / points.iter().map(|p| p.w).fold(f64::INFINITY, f64::min),
        })
    }

    /// The net of one of the four sides: `axis` held at its first or last value.
    pub fn side(&self, axis: usize, last: bool) -> Self {
        let points = self.line(axis, if last { self.degrees[axis] } else { 0 });
        Self { degrees: [points.len() - 1, 0], points, ..*self }
    }

    /// The control points of row i along v (axis 0), or of column i along u (axis 1).
    pub fn line(&self, axis: usize, i: usize) -> Vec<DVec4> {
        let stride = self.degrees[1] + 1;
        if axis == 0 {
            self.points[i * stride..(i + 1) * stride].to_vec()
        } else {
            self.points.iter().skip(i).step_by(stride).copied().collect()
        }
    }

    pub fn degrees(&self) -> [usize; 2] {
        self.degrees
    }

    /// A bound on the error of points in local coordinates, and so on distances.
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// What the bound of a piece's radius is for a shape that is a single point.
    pub fn rounding_of_points(&self) -> f64 {
        self.rounding * self.weight_ratio
    }

    /// A bound on the error of the first derivative along an axis, at the parameter t of that axis.
    ///
    /// The parts `m Bᵢᵐ⁻¹ wᵢ₊₁` of the derivative are `(i+1) Bᵢ₊₁ᵐ wᵢ₊₁/t`, at most m/t of w, and at most the
    /// ratio of the weights; likewise with 1 − t.
    pub fn slope_rounding(&self, axis: usize, t: f64) -> f64 {
        let part = |t: f64| t.recip().min(self.weight_ratio);
        self.rounding * self.degrees[axis] as f64 * (part(t) + part(1.0 - t))
    }

    /// A point of space in local coordinates.
    pub fn local(&self, q: DVec3) -> DVec3 {
        (q - self.centre) * self.scale
    }

    /// The distance of two points given in the coordinates of the shape; their squares need not be in range.
    pub fn distance(&self, p: DVec3, q: DVec3) -> f64 {
        ((p - q) * self.scale).length() / self.scale
    }

    /// A lower bound of the distance, in the coordinates of the shape, from one of φ; at most `distance`.
    pub fn certified(&self, phi: f64, distance: f64) -> f64 {
        let local = (2.0 * phi.max(0.0)).sqrt() * (1.0 - 8.0 * UNIT_ROUNDOFF) - self.rounding;
        (local.max(0.0) / self.scale).min(distance)
    }

    /// Value and derivatives at a place of `[0, 1]²`.
    #[inline]
    pub fn jet(&self, at: [f64; 2]) -> LocalJet {
        let jet = homogeneous_jet(&self.points, self.degrees, at);
        let w = jet[0].w;
        if self.weight_ratio == 1.0 {
            let [point, du, dv, duu, duv, dvv] = jet.map(|p| p.xyz() / w);
            return LocalJet { point, first: [du, dv], second: [duu, duv, dvv] };
        }
        let point = jet[0].xyz() / w;
        let first = [1, 2].map(|k| (jet[k].xyz() - point * jet[k].w) / w);
        let second = [(0, 0), (0, 1), (1, 1)].map(|(k, l)| {
            let bend = jet[3 + k + l];
            let carried = first[k] * jet[1 + l].w + first[l] * jet[1 + k].w + point * bend.w;
            (bend.xyz() - carried) / w
        });
        LocalJet { point, first, second }
    }

    /// The net of the part over a box of `[0, 1]ᴰ`; the other axis stays whole.
    pub fn restrict(&self, area: &[[f64; 2]], out: &mut Vec<DVec4>) {
        let mut whole = [[0.0, 1.0]; 2];
        whole[..area.len()].copy_from_slice(area);
        out.resize(self.points.len(), DVec4::ZERO);
        // The lengths agree by construction.
        let done = restrict_tensor(&self.points, self.degrees, whole, out);
        debug_assert!(done.is_ok());
    }
}

/// The homogeneous derivatives 1; u, v; uu, uv, vv at a place of `[0, 1]²`.
#[inline]
pub(super) fn homogeneous_jet(points: &[DVec4], degrees: [usize; 2], [u, v]: [f64; 2]) -> [DVec4; 6] {
    let [m, n] = degrees;
    let mut jet = [DVec4::ZERO; 6];
    if m.max(n) >= BASIS_ON_STACK {
        TensorNet::validated(points, degrees).partials(u, v, &mut jet);
        return jet;
    }
    // The bases once for all rows: a fraction of the work of evaluating row by row.
    let (along, across) = (Basis::new(m, u), Basis::new(n, v));
    for (row, &[b, b1, b2]) in points.chunks_exact(n + 1).zip(&along.rows) {
        let mut line = [DVec4::ZERO; 3];
        for (&p, &[c, c1, c2]) in row.iter().zip(&across.rows) {
            line[0] += p * c;
            line[1] += p * c1;
            line[2] += p * c2;
        }
        jet[0] += line[0] * b;
        jet[1] += line[0] * b1;
        jet[2] += line[1] * b;
        jet[3] += line[0] * b2;
        jet[4] += line[1] * b1;
        jet[5] += line[2] * b;
    }
    jet
}

/// A Bernstein basis with its first two derivatives: those of one polynomial stand together.
struct Basis {
    rows: [[f64; 3]; BASIS_ON_STACK],
}

impl Basis {
    /// By the recurrence `Bᵢⁿ = (1−t) Bᵢⁿ⁻¹ + t Bᵢ₋₁ⁿ⁻¹`, and differences on the way:
    /// `(Bᵢⁿ)′ = n (Bᵢ₋₁ⁿ⁻¹ − Bᵢⁿ⁻¹)`, twice for the second derivative.
    #[inline]
    fn new(degree: usize, t: f64) -> Self {
        let s = 1.0 - t;
        let mut rows = [[0.0; 3]; BASIS_ON_STACK];
        rows[0][0] = 1.0;
        for n in 1..=degree {
            let factor = n as f64;
            // From the last polynomial down, so that those of degree n − 1 are still there.
            for i in (0..=n).rev() {
                let before = if i > 0 { rows[i - 1] } else { [0.0; 3] };
                let [b, b1, _] = rows[i];
                if n + 1 >= degree {
                    rows[i][2] = if n == degree { factor * (before[1] - b1) } else { 0.0 };
                    rows[i][1] = factor * (before[0] - b);
                }
                rows[i][0] = s * b + t * before[0];
            }
        }
        Self { rows }
    }
}

/// The derivative along one axis by the local parameter of `[−1, 1]`, at the degree of the net itself:
/// `½((m−i) (Pᵢ₊₁ − Pᵢ) + i (Pᵢ − Pᵢ₋₁))`.
pub(super) fn derivative_net(net: &[DVec4], degrees: [usize; 2], axis: usize, out: &mut Vec<DVec4>) {
    let [m, n] = degrees;
    let stride = n + 1;
    let step = if axis == 0 { stride } else { 1 };
    out.clear();
    for i in 0..=m {
        for j in 0..=n {
            let (place, before) = (i * stride + j, if axis == 0 { i } else { j });
            let after = degrees[axis] - before;
            let mut sum = DVec4::ZERO;
            if after > 0 {
                sum += (net[place + step] - net[place]) * (0.5 * after as f64);
            }
            if before > 0 {
                sum += (net[place] - net[place - step]) * (0.5 * before as f64);
            }
            out.push(sum);
        }
    }
}

/// Every weight positive, and large enough to be divided by.
pub(super) fn check_weights(points: &[DVec4]) -> Result<(), ShapeError> {
    for (place, p) in points.iter().enumerate() {
        if !(p.w > 0.0 && p.w.is_finite() && (1.0 / p.w).is_finite()) {
            return Err(ShapeError::Weight { place, value: p.w });
        }
    }
    Ok(())
}

/// A shape's control points with their weights, which become positive if all are negative.
pub(super) fn positive<P: ControlPoint>(points: &[P]) -> Vec<DVec4> {
    let points = crate::control_point::homogeneous(points);
    if points.iter().all(|p| p.w < 0.0) { points.into_iter().map(|p| -p).collect() } else { points }
}
