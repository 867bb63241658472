//! Wachspress coordinates on convex polygons.

use casteljau_geom::glam::DVec2;

use super::lanes::{Jet, Lanes};
use super::weights::{Frame, Weights};
use crate::{DomainError, Polygon};

/// Areas below this, in a polygon of size about 1, count as this much in values: they are then linear on a side to
/// within 1e-80.
const FLOOR: f64 = 1e-80;

/// `λᵢ = wᵢ/Σwⱼ`, `wᵢ = Bᵢ / (AᵢAᵢ₊₁)`: Aᵢ twice the area of (vᵢ₋₁, vᵢ, x), Bᵢ that of (vᵢ₋₁, vᵢ, vᵢ₊₁).
///
/// Rational of degree n−2 over n−3, positive inside, smooth up to the boundary, corners included.
///
/// On side k the weights of its two ends grow like 1/Aₖ, and no other one: a common factor, without effect on the
/// values. For derivatives all weights are multiplied by AₘAₘ₊₁, m being the vertex of the largest weight, whose own
/// weight becomes the constant Bₘ: the factors cancel by name, not by division, and nothing grows anywhere in the
/// closed polygon. This is the classical product of the areas to all other sides, less the factors that all weights
/// share, so that it neither underflows for many sides nor needs room for partial products.
///
/// Sources: Wachspress, *A Rational Finite Element Basis* (1975); Meyer, Barr, Lee and Desbrun, *Generalized
/// barycentric coordinates on irregular polygons* (2002).
#[derive(Clone, Debug)]
pub(super) struct WachspressCoordinates {
    frame: Frame,
    corner_areas: Vec<f64>,
    certificate: f64,
}

impl WachspressCoordinates {
    /// Least turn π − ω at a corner of interior angle ω, in radians. At a straight corner Bᵢ is zero and the
    /// coordinates are those of the polygon without it; up to there they lose the factor 1/(π − ω) in accuracy.
    pub(super) const LEAST_TURN: f64 = 1e-8;

    /// Error: [`DomainError::NotConvex`], [`DomainError::StraightCorner`].
    pub(super) fn new(polygon: &Polygon) -> Result<Self, DomainError> {
        let n = polygon.len();
        let mut least = f64::INFINITY;
        for corner in 0..n {
            let angle = polygon.interior_angle(corner);
            if polygon.is_concave(corner) {
                return Err(DomainError::NotConvex { corner, angle });
            }
            let turn = std::f64::consts::PI - angle;
            if turn < Self::LEAST_TURN {
                return Err(DomainError::StraightCorner { corner, turn, least: Self::LEAST_TURN });
            }
            least = least.min(turn.sin());
        }
        let frame = Frame::new(polygon);
        let v = &frame.vertices;
        let corner_areas =
            (0..n).map(|i| (v[i] - v[(i + n - 1) % n]).perp_dot(v[(i + 1) % n] - v[i])).collect();
        Ok(Self { corner_areas, certificate: super::rounding_bound(polygon) / least, frame })
    }

    pub(super) fn certificate(&self) -> f64 {
        self.certificate
    }

    #[inline(always)]
    fn spoke(&self, i: usize, u: Lanes, v: Lanes) -> [Lanes; 2] {
        let DVec2 { x, y } = self.frame.vertices[i];
        [Lanes::splat(x) - u, Lanes::splat(y) - v]
    }

    #[inline(always)]
    fn weight(&self, i: usize) -> Lanes {
        Lanes::splat(self.corner_areas[i])
    }
}

#[inline(always)]
fn area([ax, ay]: [Lanes; 2], [bx, by]: [Lanes; 2]) -> Lanes {
    ax * by - ay * bx
}

/// The area as a function of x.
#[inline(always)]
fn area_jet(a: [Lanes; 2], b: [Lanes; 2]) -> Jet {
    Jet::linear(area(a, b), a[1] - b[1], b[0] - a[0])
}

#[inline(always)]
fn reciprocal(area: Lanes) -> Lanes {
    Lanes::splat(1.0) / area.max(Lanes::splat(FLOOR))
}

/// The vertex m of largest weight and its two sides.
struct Factor {
    /// m, which is also the first side.
    vertex: Lanes,
    /// The vertex before m.
    before: Lanes,
    /// The vertex after m, which is also the second side.
    after: Lanes,
    /// Aₘ, Aₘ₊₁.
    areas: [Jet; 2],
}

impl WachspressCoordinates {
    #[inline(always)]
    fn factor(&self, u: Lanes, v: Lanes) -> Factor {
        let n = self.frame.vertices.len();
        let at = |i: usize| self.spoke(i, u, v);
        let mut largest = Lanes::ZERO;
        let mut f =
            Factor { vertex: Lanes::ZERO, before: Lanes::ZERO, after: Lanes::ZERO, areas: [Jet::ZERO; 2] };
        let mut ends = [at(n - 1), at(0)];
        let mut first = area_jet(ends[0], ends[1]);
        for i in 0..n {
            let next = at((i + 1) % n);
            let second = area_jet(ends[1], next);
            let weight = self.weight(i) * reciprocal(first.f) * reciprocal(second.f);
            let larger = largest.less(weight);
            largest = larger.select(weight, largest);
            let number = |k: usize| Lanes::splat((k % n) as f64);
            f.vertex = larger.select(number(i), f.vertex);
            f.before = larger.select(number(i + n - 1), f.before);
            f.after = larger.select(number(i + 1), f.after);
            f.areas = [larger.select_jet(first, f.areas[0]), larger.select_jet(second, f.areas[1])];
            ends = [ends[1], next];
            first = second;
        }
        f
    }
}

impl Factor {
    /// 1/A of side `i`, 1 for the two sides that are taken out.
    #[inline(always)]
    fn reciprocal(&self, i: usize, area: Jet) -> Jet {
        let number = Lanes::splat(i as f64);
        let r = reciprocal(area.f);
        let square = r * r;
        let full = area.compose(r, Lanes::ZERO - square, Lanes::splat(2.0) * square * r);
        number.equal(self.vertex).or(number.equal(self.after)).select_jet(Jet::one(), full)
    }

    /// Product of those of the two sides that do not meet vertex `i`.
    #[inline(always)]
    fn rest(&self, i: usize) -> Jet {
        let number = Lanes::splat(i as f64);
        let own = number.equal(self.vertex);
        let first = own.or(number.equal(self.before)).select_jet(Jet::one(), self.areas[0]);
        let second = own.or(number.equal(self.after)).select_jet(Jet::one(), self.areas[1]);
        first * second
    }
}

impl Weights for WachspressCoordinates {
    fn frame(&self) -> &Frame {
        &self.frame
    }

    #[inline(always)]
    fn values(&self, u: Lanes, v: Lanes, mut emit: impl FnMut(usize, Lanes)) {
        let n = self.frame.vertices.len();
        let first = self.spoke(0, u, v);
        let closing = reciprocal(area(self.spoke(n - 1, u, v), first));
        let mut current = first;
        let mut before = closing;
        for i in 0..n - 1 {
            let next = self.spoke(i + 1, u, v);
            let after = reciprocal(area(current, next));
            emit(i, self.weight(i) * before * after);
            current = next;
            before = after;
        }
        emit(n - 1, self.weight(n - 1) * before * closing);
    }

    #[inline(always)]
    fn jets(&self, u: Lanes, v: Lanes, mut emit: impl FnMut(usize, Jet)) {
        let n = self.frame.vertices.len();
        let factor = self.factor(u, v);
        let at = |i: usize| self.spoke(i, u, v);
        let mut current = at(0);
        let mut before = factor.reciprocal(0, area_jet(at(n - 1), current));
        for i in 0..n {
            let side = (i + 1) % n;
            let next = at(side);
            let after = factor.reciprocal(side, area_jet(current, next));
            emit(i, (before * after * factor.rest(i)).scale(self.weight(i)));
            current = next;
            before = after;
        }
    }
}
