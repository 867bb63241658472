//! Mean value coordinates on simple polygons.

use casteljau_geom::glam::DVec2;

use super::lanes::{Jet, Lanes};
use super::weights::{Frame, Weights};
use crate::Polygon;

/// Lengths and areas below this, in a polygon of size about 1, count as this much: coordinates are then those of the
/// nearest vertex or side to within 1e-40, and nothing is divided by zero.
const FLOOR: f64 = 1e-40;

/// `λᵢ = wᵢ/Σwⱼ`, `wᵢ = (tan(αᵢ₋₁/2) + tan(αᵢ/2)) / |vᵢ − x|`, αᵢ the signed angle at x from vᵢ to vᵢ₊₁.
///
/// Defined for all simple polygons, smooth off the vertices, possibly negative on concave ones.
///
/// With dᵢ = vᵢ − x, A = dᵢ × dᵢ₊₁, D = dᵢ · dᵢ₊₁, s = |dᵢ||dᵢ₊₁| + |D|, the half-angle's tangent is A/s where D ≥ 0 and
/// s/A elsewhere, so no sum cancels. Toward side k only tan(αₖ/2) grows, like 1/A. Values need no care there: the two
/// weights that grow have it in common. For derivatives all weights are multiplied by Aₖ, k being the side with
/// the largest tangent: what is left is smooth up to the open side and beyond it, so derivatives on a side are computed
/// by the same formula as inside.
///
/// Sources: Floater, *Mean value coordinates* (2003); Hormann and Floater, *Mean value coordinates for arbitrary
/// planar polygons* (2006), which proves Σwⱼ ≠ 0.
#[derive(Clone, Debug)]
pub(super) struct MeanValueCoordinates {
    frame: Frame,
    certificate: f64,
}

/// From x to a vertex.
#[derive(Clone, Copy)]
struct Spoke {
    x: Lanes,
    y: Lanes,
    length: Lanes,
}

impl MeanValueCoordinates {
    /// Total: every simple polygon has these coordinates. Cost: O(n²) for the certificate.
    pub(super) fn new(polygon: &Polygon) -> Self {
        Self { frame: Frame::new(polygon), certificate: super::rounding_bound(polygon) }
    }

    pub(super) fn certificate(&self) -> f64 {
        self.certificate
    }

    #[inline(always)]
    fn spoke(&self, i: usize, u: Lanes, v: Lanes) -> Spoke {
        let DVec2 { x, y } = self.frame.vertices[i];
        let (x, y) = (Lanes::splat(x) - u, Lanes::splat(y) - v);
        let length = (x * x + y * y).sqrt().max(Lanes::splat(FLOOR));
        Spoke { x, y, length }
    }
}

/// `|a||b| + |a·b|`, a·b and `a×b`, the last one kept away from zero.
#[inline(always)]
fn products(a: Spoke, b: Spoke) -> (Lanes, Lanes, Lanes) {
    let area = a.x * b.y - a.y * b.x;
    let floor = Lanes::splat(FLOOR);
    let area = area.abs().less(floor).select(floor, area);
    let dot = a.x * b.x + a.y * b.y;
    (a.length * b.length + dot.abs(), dot, area)
}

/// Tangent of half the signed angle from a to b.
#[inline(always)]
fn half_tangent(a: Spoke, b: Spoke) -> Lanes {
    let (s, dot, area) = products(a, b);
    let obtuse = dot.less(Lanes::ZERO);
    obtuse.select(s, area) / obtuse.select(area, s)
}

/// Polar angle of a spoke, as a function of x; the value is not used and is left 0.
///
/// θ = arg d has ∇θ = (d_y, −d_x)/|d|², and is harmonic.
#[inline(always)]
fn angle(d: Spoke, inverse: Lanes) -> Jet {
    let (x, y) = (d.x * inverse, d.y * inverse);
    let square = inverse * inverse;
    let mixed = (y * y - x * x) * square;
    let pure = Lanes::splat(2.0) * (x * y) * square;
    Jet {
        f: Lanes::ZERO,
        u: y * inverse,
        v: Lanes::ZERO - x * inverse,
        uu: pure,
        uv: mixed,
        vv: Lanes::ZERO - pure,
    }
}

/// 1/|d| as a function of x.
#[inline(always)]
fn reciprocal_length(d: Spoke, inverse: Lanes) -> Jet {
    let (x, y) = (d.x * inverse, d.y * inverse);
    let square = inverse * inverse;
    let cube = square * inverse;
    let three = Lanes::splat(3.0);
    let one = Lanes::splat(1.0);
    Jet {
        f: inverse,
        u: x * square,
        v: y * square,
        uu: (three * (x * x) - one) * cube,
        uv: three * (x * y) * cube,
        vv: (three * (y * y) - one) * cube,
    }
}

/// |d| as a function of x.
#[inline(always)]
fn length(d: Spoke) -> Jet {
    let inverse = Lanes::splat(1.0) / d.length;
    let (x, y) = (d.x * inverse, d.y * inverse);
    Jet {
        f: d.length,
        u: Lanes::ZERO - x,
        v: Lanes::ZERO - y,
        uu: y * y * inverse,
        uv: Lanes::ZERO - x * y * inverse,
        vv: x * x * inverse,
    }
}

/// d as two functions of x.
#[inline(always)]
fn components(d: Spoke) -> [Jet; 2] {
    let minus = Lanes::splat(-1.0);
    [Jet::linear(d.x, minus, Lanes::ZERO), Jet::linear(d.y, Lanes::ZERO, minus)]
}

/// The factor common to all weights of a point.
struct Factor {
    /// Side whose tangent is taken out, −1 for none.
    side: Lanes,
    /// The factor: Aₖ, or 1 where all tangents are at most 1.
    factor: Jet,
    /// The factor times tan(αₖ/2): |a||b| − a·b.
    product: Jet,
}

impl MeanValueCoordinates {
    #[inline(always)]
    fn factor(&self, u: Lanes, v: Lanes) -> Factor {
        let n = self.frame.vertices.len();
        let mut largest = Lanes::splat(1.0);
        let mut side = Lanes::splat(-1.0);
        let mut current = self.spoke(n - 1, u, v);
        let mut ends = [current, current];
        for i in 0..n {
            let next = self.spoke(i, u, v);
            let tangent = half_tangent(current, next).abs();
            let larger = largest.less(tangent);
            largest = larger.select(tangent, largest);
            side = larger.select(Lanes::splat(i as f64), side);
            for (end, spoke) in ends.iter_mut().zip([current, next]) {
                end.x = larger.select(spoke.x, end.x);
                end.y = larger.select(spoke.y, end.y);
                end.length = larger.select(spoke.length, end.length);
            }
            current = next;
        }
        let [a, b] = ends;
        let ([ax, ay], [bx, by]) = (components(a), components(b));
        let product = length(a) * length(b) - (ax * bx + ay * by);
        let area = Jet::linear(a.x * b.y - a.y * b.x, a.y - b.y, b.x - a.x);
        let none = side.less(Lanes::ZERO);
        Factor { side, factor: none.select_jet(Jet::one(), area), product }
    }

    /// The factor times tan(α/2), α the angle from a to b, along side `i`.
    #[inline(always)]
    fn tangent(&self, i: usize, a: (Spoke, Lanes), b: (Spoke, Lanes), factor: &Factor) -> Jet {
        let t = half_tangent(a.0, b.0);
        let alpha = angle(b.0, b.1) - angle(a.0, a.1);
        // d tan(α/2) = ½(1 + t²) dα.
        let slope = Lanes::splat(0.5) + Lanes::splat(0.5) * (t * t);
        let plain = alpha.compose(t, slope, slope * t) * factor.factor;
        factor.side.equal(Lanes::splat(i as f64)).select_jet(factor.product, plain)
    }
}

impl Weights for MeanValueCoordinates {
    fn frame(&self) -> &Frame {
        &self.frame
    }

    #[inline(always)]
    fn values(&self, u: Lanes, v: Lanes, mut emit: impl FnMut(usize, Lanes)) {
        let n = self.frame.vertices.len();
        let first = self.spoke(0, u, v);
        let last = self.spoke(n - 1, u, v);
        let mut current = first;
        let closing = half_tangent(last, first);
        let mut before = closing;
        for i in 0..n - 1 {
            let next = self.spoke(i + 1, u, v);
            let after = half_tangent(current, next);
            emit(i, (before + after) / current.length);
            current = next;
            before = after;
        }
        emit(n - 1, (before + closing) / current.length);
    }

    #[inline(always)]
    fn jets(&self, u: Lanes, v: Lanes, mut emit: impl FnMut(usize, Jet)) {
        let n = self.frame.vertices.len();
        let factor = self.factor(u, v);
        let spoke = |i: usize| {
            let d = self.spoke(i, u, v);
            (d, Lanes::splat(1.0) / d.length)
        };
        let mut current = spoke(0);
        let mut before = self.tangent(0, spoke(n - 1), current, &factor);
        for i in 0..n {
            let side = (i + 1) % n;
            let next = spoke(side);
            let after = self.tangent(side, current, next, &factor);
            emit(i, (before + after) * reciprocal_length(current.0, current.1));
            current = next;
            before = after;
        }
    }
}
