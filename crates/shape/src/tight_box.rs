//! Bounding boxes that touch the shape, by branch and bound.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use casteljau_bernstein::{TriangleNet, subdivide_along};
use casteljau_geom::glam::{DVec2, DVec3, DVec4};
use casteljau_geom::{BoundingBox, rounding_bound};

use crate::{BezierCurve, BezierPatch, BezierTriangle, ControlPoint, ShapeError};

/// At most so many parts are looked at for each face of the box.
const MOST_PARTS: usize = 1 << 16;

/// A part after so many halvings that still has weights of both signs has a pole.
const MOST_HALVINGS: u32 = 100;

impl<P: ControlPoint> BezierCurve<P> {
    /// The box around the curve over its interval, each face at most `tolerance` away from touching it, in model
    /// units.
    ///
    /// The curve is halved where its hull reaches farthest; the hull of what is left over bounds it, and rounding is
    /// in that bound, so that the box contains the curve for certain. Weights of both signs are served as long as
    /// there is no pole. Near an extreme each halving gains a factor 4.
    ///
    /// ```
    /// use casteljau_shape::{Curve, geom::glam::DVec3};
    /// let arch = Curve::new([DVec3::ZERO, DVec3::new(1.0, 2.0, 0.0), 2.0 * DVec3::X])?;
    /// assert_eq!(arch.bounding_box().max.y, 2.0);
    /// assert!((arch.tight_box(1e-9)?.max.y - 1.0).abs() <= 1e-9);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Construction`] unless the tolerance is positive, [`ShapeError::Unbounded`] where there is a
    /// pole.
    pub fn tight_box(&self, tolerance: f64) -> Result<BoundingBox, ShapeError> {
        tight_box(self.control_points(), &Grid([self.degree()]), tolerance)
    }
}

impl<P: ControlPoint> BezierPatch<P> {
    /// The box around the patch over its rectangle, each face at most `tolerance` away from touching it, in model
    /// units. Otherwise as [`BezierCurve::tight_box`].
    ///
    /// Where an extreme is taken along a whole curve that is no parameter line, some `1/√tolerance` parts are
    /// needed; after 65,536 of them the box is larger than `tolerance` allows, and contains the patch all the same.
    ///
    /// # Errors
    /// Those of [`BezierCurve::tight_box`].
    pub fn tight_box(&self, tolerance: f64) -> Result<BoundingBox, ShapeError> {
        tight_box(self.control_points(), &Grid(self.degrees()), tolerance)
    }
}

impl<P: ControlPoint> BezierTriangle<P> {
    /// The box around the triangle, each face at most `tolerance` away from touching it, in model units. Otherwise as
    /// [`BezierPatch::tight_box`].
    ///
    /// # Errors
    /// Those of [`BezierCurve::tight_box`].
    pub fn tight_box(&self, tolerance: f64) -> Result<BoundingBox, ShapeError> {
        tight_box(self.control_points(), &Bisected { degree: self.degree() }, tolerance)
    }
}

/// A net over a domain that is halved again and again: what [`tight_box`] asks of a kind of shape.
pub trait Halving {
    /// The sum of the degrees.
    fn total_degree(&self) -> usize;

    /// Places of the corners in a net.
    fn corners(&self) -> Vec<usize>;

    /// The nets over the two halves of a part that came out of so many halvings, each net being pairs (x, w). After a
    /// fixed number of halvings the parts must be smaller in every direction.
    ///
    /// # Errors
    /// Those of the kernels, where a net does not fit.
    fn halves(&self, net: &[DVec2], halvings: u32) -> Result<[Vec<DVec2>; 2], ShapeError>;
}

/// An interval, a rectangle or a box under a tensor-product net of these degrees, halved across one axis after another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grid<const D: usize>(
    /// The degrees, the last axis running fastest.
    pub [usize; D],
);

impl<const D: usize> Halving for Grid<D> {
    fn total_degree(&self) -> usize {
        self.0.iter().sum()
    }

    fn corners(&self) -> Vec<usize> {
        let place = |corner: usize| {
            let end = |axis: usize| (corner >> axis & 1) * self.0[axis];
            (0..D).fold(0, |place, axis| place * (self.0[axis] + 1) + end(axis))
        };
        (0..1 << D).map(place).collect()
    }

    fn halves(&self, net: &[DVec2], halvings: u32) -> Result<[Vec<DVec2>; 2], ShapeError> {
        let mut left = vec![DVec2::ZERO; net.len()];
        let mut right = left.clone();
        subdivide_along(net, self.0, halvings as usize % D, 0.5, &mut left, &mut right)?;
        Ok([left, right])
    }
}

/// A triangle, its edge from vertex 0 to vertex 1 halved; the newest vertex becomes vertex 2, so that the parts have
/// four shapes at most.
struct Bisected {
    degree: usize,
}

impl Halving for Bisected {
    fn total_degree(&self) -> usize {
        self.degree
    }

    fn corners(&self) -> Vec<usize> {
        let last = (self.degree + 1) * (self.degree + 2) / 2 - 1;
        vec![0, last - self.degree, last]
    }

    fn halves(&self, net: &[DVec2], _: u32) -> Result<[Vec<DVec2>; 2], ShapeError> {
        let mut near = [vec![DVec2::ZERO; net.len()], vec![DVec2::ZERO; net.len()]];
        let mut out = near.clone();
        let [a, b] = &mut near;
        TriangleNet::validated(net, self.degree).split_edge([0, 1], 0.5, a, b)?;
        for ((half, order), turned) in near.iter().zip([[0, 2, 1], [1, 2, 0]]).zip(&mut out) {
            TriangleNet::validated(half, self.degree).face(order, turned)?;
        }
        Ok(out)
    }
}

/// The box around a shape over its domain, each face at most `tolerance` away from touching it, in model units; see
/// [`BezierCurve::tight_box`].
///
/// # Errors
/// Those of [`BezierCurve::tight_box`], and of [`Halving::halves`].
pub fn tight_box<P: ControlPoint>(
    points: &[P],
    domain: &dyn Halving,
    tolerance: f64,
) -> Result<BoundingBox, ShapeError> {
    if tolerance.is_nan() || tolerance <= 0.0 {
        return Err(ShapeError::Construction { what: "tolerance of the box", value: tolerance });
    }
    let reach = |direction: DVec4| {
        let net =
            points.iter().map(|p| DVec2::new(p.homogeneous().dot(direction), p.homogeneous().w)).collect();
        reach(net, domain, tolerance)
    };
    let axes = [DVec4::X, DVec4::Y, DVec4::Z];
    let (mut min, mut max) = (DVec3::ZERO, DVec3::ZERO);
    for (axis, direction) in axes.into_iter().enumerate() {
        max[axis] = reach(direction)?;
        min[axis] = -reach(-direction)?;
    }
    Ok(BoundingBox { min, max })
}

/// A bound from above on `x/w` over a part of the domain, no more than `tolerance` above its largest value.
fn reach(net: Vec<DVec2>, domain: &dyn Halving, tolerance: f64) -> Result<f64, ShapeError> {
    let corners = domain.corners();
    let whole = Part::new(net, &corners, 0);
    let mut best = whole.at_corners;
    let mut parts = BinaryHeap::from([whole]);
    let mut seen = 1;
    while let Some(part) = parts.peek() {
        if part.upper <= best + tolerance || (seen >= MOST_PARTS && part.upper.is_finite()) {
            break;
        }
        if part.halvings >= MOST_HALVINGS || seen >= MOST_PARTS {
            // Weights of both signs on what is as good as a point.
            return if part.upper.is_finite() { break } else { Err(ShapeError::Unbounded) };
        }
        let Some(part) = parts.pop() else { break };
        for net in domain.halves(&part.net, part.halvings)? {
            let half = Part::new(net, &corners, part.halvings + 1);
            best = best.max(half.at_corners);
            seen += 1;
            parts.push(half);
        }
    }
    let Some(part) = parts.peek() else { return Ok(best) };
    // What the halvings that led here may have lost.
    let rounding = f64::from(part.halvings + 1) * rounding_bound(domain.total_degree(), 0, part.size);
    Ok(part.upper.max(best) + if part.halvings == 0 { 0.0 } else { rounding })
}

/// A part of the domain with its net of pairs (x, w).
struct Part {
    net: Vec<DVec2>,
    halvings: u32,
    /// No value on the part is above this.
    upper: f64,
    /// The largest value at a corner.
    at_corners: f64,
    /// The largest absolute value in the hull.
    size: f64,
}

impl Part {
    fn new(net: Vec<DVec2>, corners: &[usize], halvings: u32) -> Self {
        let sign = net.first().map_or(1.0, |p| p.y.signum());
        let bounded = net.iter().all(|p| p.y * sign > 0.0);
        let values = || net.iter().map(|p| p.x / p.y);
        let infinite = [f64::INFINITY; 2];
        let [upper, size] = if bounded {
            values().fold([f64::NEG_INFINITY, 0.0], |[a, b], x| [a.max(x), b.max(x.abs())])
        } else {
            infinite
        };
        let corners =
            corners.iter().filter_map(|&place| net.get(place).map(|p| p.x / p.y).filter(|x| x.is_finite()));
        let at_corners = corners.fold(f64::NEG_INFINITY, f64::max);
        Self { net, halvings, upper, at_corners, size }
    }
}

impl Ord for Part {
    fn cmp(&self, other: &Self) -> Ordering {
        self.upper.total_cmp(&other.upper)
    }
}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Part {}
