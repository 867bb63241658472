//! From weights wᵢ to coordinates λᵢ = wᵢ / Σ wⱼ, for every kind that has a closed form.

use casteljau_geom::glam::DVec2;
use pulp::{Arch, Simd, WithSimd};

use super::lanes::{Jet, LANES, Lanes};
use super::rows;
use crate::{Orientation, Polygon};

/// Unnormalised coordinates on a polygon that is counter-clockwise and of a size near 1.
///
/// Only ratios matter: all weights of a point may carry a common factor, smooth near that point.
pub(super) trait Weights: Sync {
    /// The polygon.
    fn frame(&self) -> &Frame;
    /// Passes on wᵢ for i = 0, 1, …, n−1, in this order.
    fn values(&self, u: Lanes, v: Lanes, emit: impl FnMut(usize, Lanes));
    /// Passes on the jets of wᵢ for i = 0, 1, …, n−1, in this order.
    fn jets(&self, u: Lanes, v: Lanes, emit: impl FnMut(usize, Jet));
}

/// A polygon's vertices, mirrored (u → −u) if it runs clockwise, times the power of two that brings the largest extent
/// into [½, 1): weights then neither overflow nor depend on orientation, and no rounding is added.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) vertices: Vec<DVec2>,
    scale: DVec2,
}

impl Frame {
    pub(super) fn new(polygon: &Polygon) -> Self {
        let [low, high] = polygon.bounding_box();
        // The exponent field of a positive normal number: 2^e ≤ size < 2^(e+1).
        let exponent = ((high - low).max_element().to_bits() >> 52) as i32 - 1023;
        let power = 2f64.powi(-exponent - 1);
        let mirror = match polygon.orientation() {
            Orientation::CounterClockwise => 1.0,
            Orientation::Clockwise => -1.0,
        };
        let scale = DVec2::new(mirror * power, power);
        Self { vertices: polygon.vertices().iter().map(|p| *p * scale).collect(), scale }
    }

    /// Factors that bring the rows 1, u, v, uu, uv, vv back to the caller's units.
    fn row_scales(&self) -> [f64; 6] {
        let DVec2 { x, y } = self.scale;
        [1.0, x, y, x * x, x * y, y * y]
    }

    /// The first to eighth of at least one point, the last one repeated where there are fewer.
    #[inline(always)]
    fn load(&self, points: &[DVec2]) -> (Lanes, Lanes) {
        let (mut u, mut v) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            let p = points[l.min(points.len() - 1)];
            u[l] = p.x * self.scale.x;
            v[l] = p.y * self.scale.y;
        }
        (Lanes(u), Lanes(v))
    }
}

/// Coordinates with their derivatives up to `order` (at most 2) at all `points`, on this thread.
///
/// `out` holds rows(order)·n entries a point. The widest vector instructions at hand are used; the result does not
/// depend on them, nor on how points are grouped into calls.
pub(super) fn evaluate(weights: &impl Weights, points: &[DVec2], order: usize, out: &mut [f64]) {
    match order {
        0 => Arch::new().dispatch(Batch::<_, 0> { weights, points, out }),
        1 => Arch::new().dispatch(Batch::<_, 1> { weights, points, out }),
        _ => Arch::new().dispatch(Batch::<_, 2> { weights, points, out }),
    }
}

struct Batch<'a, W, const ORDER: usize> {
    weights: &'a W,
    points: &'a [DVec2],
    out: &'a mut [f64],
}

impl<W: Weights, const ORDER: usize> WithSimd for Batch<'_, W, ORDER> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let frame = self.weights.frame();
        let n = frame.vertices.len();
        let stride = rows(ORDER) * n;
        for (points, out) in self.points.chunks(LANES).zip(self.out.chunks_mut(LANES * stride)) {
            let (u, v) = frame.load(points);
            if ORDER == 0 {
                let mut sum = Lanes::ZERO;
                self.weights.values(u, v, |i, w| {
                    sum = sum + w;
                    scatter(out, stride, i, w);
                });
                for (l, out) in out.chunks_exact_mut(stride).enumerate() {
                    let inverse = 1.0 / sum.0[l];
                    out.iter_mut().for_each(|w| *w *= inverse);
                }
            } else {
                let mut sum = Jet::ZERO;
                self.weights.jets(u, v, |i, w| {
                    sum = sum + w;
                    let parts = [w.f, w.u, w.v, w.uu, w.uv, w.vv];
                    for (row, part) in parts.iter().enumerate().take(rows(ORDER)) {
                        scatter(out, stride, row * n + i, *part);
                    }
                });
                let sums = [sum.f, sum.u, sum.v, sum.uu, sum.uv, sum.vv];
                for (l, out) in out.chunks_exact_mut(stride).enumerate() {
                    divide::<ORDER>(out, sums.map(|s| s.0[l]), frame.row_scales());
                }
            }
        }
    }
}

/// Entry `at` of every point's part of `out`.
#[inline(always)]
fn scatter(out: &mut [f64], stride: usize, at: usize, values: Lanes) {
    if out.len() == LANES * stride {
        for l in 0..LANES {
            out[l * stride + at] = values.0[l];
        }
    } else {
        for (out, value) in out.chunks_exact_mut(stride).zip(values.0) {
            out[at] = value;
        }
    }
}

/// The quotient rule, in place: rows of w become rows of λ = w/W, `sum` being the jet of W.
#[inline(always)]
fn divide<const ORDER: usize>(out: &mut [f64], sum: [f64; 6], scale: [f64; 6]) {
    let n = out.len() / rows(ORDER);
    let inverse = 1.0 / sum[0];
    let [_, wu, wv, wuu, wuv, wvv] = sum;
    let (value, out) = out.split_at_mut(n);
    let (du, out) = out.split_at_mut(n);
    let (dv, out) = out.split_at_mut(n);
    for ((f, u), v) in value.iter_mut().zip(&mut *du).zip(&mut *dv) {
        *f *= inverse;
        *u = (*u - *f * wu) * inverse;
        *v = (*v - *f * wv) * inverse;
    }
    if ORDER == 2 {
        let (duu, out) = out.split_at_mut(n);
        let (duv, dvv) = out.split_at_mut(n);
        for (i, ((uu, uv), vv)) in duu.iter_mut().zip(duv).zip(dvv).enumerate() {
            let (f, u, v) = (value[i], du[i], dv[i]);
            *uu = (*uu - 2.0 * u * wu - f * wuu) * inverse * scale[3];
            *uv = (*uv - u * wv - v * wu - f * wuv) * inverse * scale[4];
            *vv = (*vv - 2.0 * v * wv - f * wvv) * inverse * scale[5];
        }
    }
    du.iter_mut().for_each(|u| *u *= scale[1]);
    dv.iter_mut().for_each(|v| *v *= scale[2]);
}
