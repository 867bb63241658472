//! Control points of shapes: Euclidean, or homogeneous with a weight.

use casteljau_bernstein::Point;
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_geom::{BoundingBox, GeomError, extended_quotient_partials, partial_count, rounding_bound};

use crate::ShapeError;
use crate::error::check_points;

/// What the control points of a shape may be: `DVec3` for polynomial shapes, `DVec4` = (w·x, w·y, w·z, w) for
/// rational ones.
///
/// Everything that is linear in the control points is written once for both; the rational ones are divided by
/// their weight at the end, by the quotient rule. No other type can be one.
pub trait ControlPoint: Point + private::Sealed {
    /// Whether there is a weight to divide by.
    const RATIONAL: bool;

    /// The numbers in memory.
    fn components(&self) -> &[f64];

    /// `(w·x, w·y, w·z, w)`.
    fn homogeneous(self) -> DVec4;

    /// The point in space; `None` at infinity.
    fn euclidean(self) -> Option<DVec3>;

    /// Derivatives of the shape in N parameters, from the kernel that fills in those of its net; what leaves the
    /// range of numbers is infinite or NaN.
    ///
    /// `uncertainty` bounds the error of the weight that it is given.
    ///
    /// # Errors
    /// [`GeomError::Pole`] where the weight vanishes within that bound.
    fn project<const N: usize>(
        out: &mut [DVec3],
        kernel: impl FnOnce(&mut [Self]),
        uncertainty: impl FnOnce(f64) -> f64,
    ) -> Result<(), GeomError>;
}

mod private {
    /// Keeps the kinds of control points to those of this crate.
    pub trait Sealed {}

    impl Sealed for casteljau_geom::glam::DVec3 {}
    impl Sealed for casteljau_geom::glam::DVec4 {}
}

/// Derivatives of a rational shape are kept on the stack while there are at most so many: a surface's up to
/// order 7.
const ON_STACK: usize = partial_count::<2>(7);

impl ControlPoint for DVec3 {
    const RATIONAL: bool = false;

    fn components(&self) -> &[f64] {
        self.as_ref()
    }

    fn homogeneous(self) -> DVec4 {
        self.extend(1.0)
    }

    fn euclidean(self) -> Option<DVec3> {
        Some(self)
    }

    fn project<const N: usize>(
        out: &mut [DVec3],
        kernel: impl FnOnce(&mut [Self]),
        _: impl FnOnce(f64) -> f64,
    ) -> Result<(), GeomError> {
        kernel(out);
        Ok(())
    }
}

impl ControlPoint for DVec4 {
    const RATIONAL: bool = true;

    fn components(&self) -> &[f64] {
        self.as_ref()
    }

    fn homogeneous(self) -> DVec4 {
        self
    }

    fn euclidean(self) -> Option<DVec3> {
        let p = self.xyz() / self.w;
        p.is_finite().then_some(p)
    }

    fn project<const N: usize>(
        out: &mut [DVec3],
        kernel: impl FnOnce(&mut [Self]),
        uncertainty: impl FnOnce(f64) -> f64,
    ) -> Result<(), GeomError> {
        let mut stack = [DVec4::ZERO; ON_STACK];
        let mut heap = Vec::new();
        let net = match stack.get_mut(..out.len()) {
            Some(net) => net,
            None => {
                heap.resize(out.len(), DVec4::ZERO);
                &mut heap[..]
            }
        };
        kernel(net);
        let Some(value) = net.first() else { return Ok(()) };
        extended_quotient_partials::<N>(net, uncertainty(value.w), out)
    }
}

/// Homogeneous control points from Euclidean ones with their weights; one of weight 0 contributes nothing.
///
/// # Errors
/// [`ShapeError::WeightCount`], [`ShapeError::Coordinate`].
pub fn lifted(points: &[DVec3], weights: &[f64]) -> Result<Vec<DVec4>, ShapeError> {
    if points.len() != weights.len() {
        return Err(ShapeError::WeightCount { needed: points.len(), given: weights.len() });
    }
    check_points(points)?;
    for (place, &weight) in weights.iter().enumerate() {
        if !weight.is_finite() {
            return Err(ShapeError::Coordinate { place, axis: 3, value: weight });
        }
    }
    Ok(points.iter().zip(weights).map(|(&p, &w)| (p * w).extend(w)).collect())
}

/// The control points of one shape, if every coordinate is finite and in range and not all weights are zero.
///
/// # Errors
/// [`ShapeError::Coordinate`], [`ShapeError::NoWeight`].
pub fn checked<P: ControlPoint>(points: Vec<P>) -> Result<Vec<P>, ShapeError> {
    check_points(&points)?;
    if P::RATIONAL && points.iter().all(|p| p.homogeneous().w == 0.0) {
        return Err(ShapeError::NoWeight { control_points: points.len() });
    }
    Ok(points)
}

/// Control points with their weights, `(w·x, w·y, w·z, w)`.
#[must_use]
pub fn homogeneous<P: ControlPoint>(points: &[P]) -> Vec<DVec4> {
    points.iter().map(|p| p.homogeneous()).collect()
}

/// The largest weight in absolute value.
#[must_use]
pub fn largest_weight<P: ControlPoint>(points: &[P]) -> f64 {
    points.iter().map(|p| p.homogeneous().w.abs()).fold(0.0, f64::max)
}

/// Whether all weights are positive, or all are negative: then the shape lies in the hull of its control
/// points.
#[must_use]
pub fn has_hull<P: ControlPoint>(points: &[P]) -> bool {
    let sign = points.first().map_or(1.0, |p| p.homogeneous().w.signum());
    points.iter().all(|p| p.homogeneous().w * sign > 0.0)
}

/// The box around points of which there are some, all finite, as a checked polynomial shape has them; the origin otherwise.
#[must_use]
pub fn points_box(points: &[DVec3]) -> BoundingBox {
    let origin = BoundingBox { min: DVec3::ZERO, max: DVec3::ZERO };
    BoundingBox::from_points(points.iter().copied()).unwrap_or(origin)
}

/// The box around the control points in space; `None` unless [`has_hull`], or where a quotient overflows.
#[must_use]
pub fn hull_box<P: ControlPoint>(points: &[P]) -> Option<BoundingBox> {
    if !has_hull(points) {
        return None;
    }
    BoundingBox::from_points(points.iter().map(|p| p.euclidean().unwrap_or(DVec3::NAN)))
}

/// A bound on the distance of two rational shapes in space at equal parameters, from their nets of one degree.
///
/// With N/w and N′/w′, both seen from a point c, it is `|(N−N′) − (N/w)(w−w′)|/|w′| ≤ (δ_N + R δ_w)/min w′`, R being
/// the largest distance of a control point of the first shape from c. `degree` is the total one, for an allowance
/// for the rounding of the second net.
///
/// # Errors
/// [`ShapeError::Unbounded`] unless the weights of both have one sign.
pub fn distance_bound<P: ControlPoint>(points: &[P], nearby: &[P], degree: usize) -> Result<f64, ShapeError> {
    let (Some(bounds), true) = (hull_box(points), has_hull(nearby)) else {
        return Err(ShapeError::Unbounded);
    };
    let center = bounds.center();
    let (mut in_space, mut in_weight, mut radius) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for (p, q) in points.iter().zip(nearby) {
        let (p, q) = (p.homogeneous(), q.homogeneous());
        let seen = |p: DVec4| p.xyz() - center * p.w;
        in_space = in_space.max(seen(p).distance(seen(q)));
        in_weight = in_weight.max((p.w - q.w).abs());
        radius = radius.max((seen(p) / p.w).length());
        least = least.min(q.w.abs());
        most = most.max(p.w.abs()).max(q.w.abs());
    }
    let rounding = rounding_bound(degree, 0, 2.0 * most * (radius + center.length()));
    Ok((in_space + radius * in_weight + rounding) / least)
}
