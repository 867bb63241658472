//! Curves, patches and triangles as files describe them.

use casteljau_geom::Interval;
use casteljau_shape::{
    BezierCurve, BezierPatch, BezierTriangle, ControlPoint, Curve, Patch, PowerCurve, PowerPatch,
    RationalCurve, RationalPatch, RationalTriangle, ShapeError, Triangle,
};

use crate::net_record::{homogeneous, interval, nested, points, vectors};
use crate::place::Step;
use crate::record::Fault;
use crate::{Geometry, NetRecord, Reason};

/// A Bézier curve, polynomial or rational; its degree is the number of control points less one.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveRecord {
    /// The control points.
    pub net: NetRecord,
    /// The interval [a, b] of the parameter.
    pub interval: [f64; 2],
}

/// A polynomial curve by its coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerCurveRecord {
    /// The coefficient of tⁱ at place i.
    pub coefficients: Vec<[f64; 3]>,
    /// The interval [a, b] of the parameter.
    pub interval: [f64; 2],
}

/// A tensor-product Bézier patch, polynomial or rational.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchRecord {
    /// The degrees m with u and n with v.
    pub degrees: [usize; 2],
    /// The control points, `Pᵢⱼ` at place i·(n+1) + j.
    pub net: NetRecord,
    /// The intervals of u and of v.
    pub intervals: [[f64; 2]; 2],
}

/// A polynomial patch by its coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerPatchRecord {
    /// The degrees m with u and n with v.
    pub degrees: [usize; 2],
    /// The coefficient of uⁱ vʲ at place i·(n+1) + j.
    pub coefficients: Vec<[f64; 3]>,
    /// The intervals of u and of v.
    pub intervals: [[f64; 2]; 2],
}

/// A Bézier triangle, polynomial or rational.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleRecord {
    /// The degree.
    pub degree: usize,
    /// The control points in descending lexicographic order, (n,0,0), (n−1,1,0), …, (0,0,n).
    pub net: NetRecord,
}

/// Where a file names no interval.
pub(crate) const UNIT: [f64; 2] = [0.0, 1.0];

impl CurveRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        let over = interval(self.interval, &[Step::Field("interval")])?;
        let curve = match &self.net {
            NetRecord::Points(points) => {
                Curve::new(vectors(points)).map(|c| Geometry::Curve(c.with_interval(over)))
            }
            NetRecord::Weighted { points, weights } => RationalCurve::new(&vectors(points), weights)
                .map(|c| Geometry::RationalCurve(c.with_interval(over))),
            NetRecord::Homogeneous(points) => RationalCurve::from_homogeneous(homogeneous(points))
                .map(|c| Geometry::RationalCurve(c.with_interval(over))),
        };
        curve.map_err(|error| self.net.fault(error, &[]))
    }
}

impl PowerCurveRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        let over = interval(self.interval, &[Step::Field("interval")])?;
        let curve = PowerCurve::new(vectors(&self.coefficients));
        curve
            .map(|c| Geometry::PowerCurve(c.with_interval(over)))
            .map_err(|error| coefficient_fault(error, &[]))
    }
}

impl PatchRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        let over = both(self.intervals)?;
        let patch = match &self.net {
            NetRecord::Points(points) => {
                Patch::new(self.degrees, vectors(points)).map(|p| Geometry::Patch(p.with_intervals(over)))
            }
            NetRecord::Weighted { points, weights } => {
                RationalPatch::new(self.degrees, &vectors(points), weights)
                    .map(|p| Geometry::RationalPatch(p.with_intervals(over)))
            }
            NetRecord::Homogeneous(points) => {
                RationalPatch::from_homogeneous(self.degrees, homogeneous(points))
                    .map(|p| Geometry::RationalPatch(p.with_intervals(over)))
            }
        };
        patch.map_err(|error| self.net.fault(error, &[row_length(self.degrees)]))
    }
}

impl PowerPatchRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        let over = both(self.intervals)?;
        let patch = PowerPatch::new(self.degrees, vectors(&self.coefficients));
        patch
            .map(|p| Geometry::PowerPatch(p.with_intervals(over)))
            .map_err(|error| coefficient_fault(error, &[row_length(self.degrees)]))
    }
}

impl TriangleRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        let triangle = match &self.net {
            NetRecord::Points(points) => Triangle::new(self.degree, vectors(points)).map(Geometry::Triangle),
            NetRecord::Weighted { points, weights } => {
                RationalTriangle::new(self.degree, &vectors(points), weights).map(Geometry::RationalTriangle)
            }
            NetRecord::Homogeneous(points) => {
                RationalTriangle::from_homogeneous(self.degree, homogeneous(points))
                    .map(Geometry::RationalTriangle)
            }
        };
        triangle.map_err(|error| self.net.fault(error, &[]))
    }
}

/// Control points of a row; degrees are refused before the places of points matter.
fn row_length(degrees: [usize; 2]) -> usize {
    degrees[1].saturating_add(1)
}

fn both([u, v]: [[f64; 2]; 2]) -> Result<[Interval; 2], Fault> {
    let at = |index| [Step::Field("intervals"), Step::Index(index)];
    Ok([interval(u, &at(0))?, interval(v, &at(1))?])
}

fn coefficient_fault(error: ShapeError, rows: &[usize]) -> Fault {
    let mut steps = vec![Step::Field("coefficients")];
    if let ShapeError::Coordinate { place, axis, .. } = error {
        steps.extend(nested(place, rows));
        steps.push(Step::Index(axis));
    }
    (steps, Reason::Shape(Box::new(error)))
}

pub(crate) fn ends(interval: Interval) -> [f64; 2] {
    [interval.start(), interval.end()]
}

impl<'c, P> From<&'c BezierCurve<P>> for CurveRecord
where
    P: ControlPoint,
    NetRecord: From<&'c BezierCurve<P>>,
{
    fn from(curve: &'c BezierCurve<P>) -> Self {
        Self { interval: ends(curve.interval()), net: curve.into() }
    }
}

impl<'p, P> From<&'p BezierPatch<P>> for PatchRecord
where
    P: ControlPoint,
    NetRecord: From<&'p BezierPatch<P>>,
{
    fn from(patch: &'p BezierPatch<P>) -> Self {
        Self { degrees: patch.degrees(), net: patch.into(), intervals: patch.intervals().map(ends) }
    }
}

impl<'t, P> From<&'t BezierTriangle<P>> for TriangleRecord
where
    P: ControlPoint,
    NetRecord: From<&'t BezierTriangle<P>>,
{
    fn from(triangle: &'t BezierTriangle<P>) -> Self {
        Self { degree: triangle.degree(), net: triangle.into() }
    }
}

impl From<&PowerCurve> for PowerCurveRecord {
    fn from(curve: &PowerCurve) -> Self {
        Self { coefficients: points(curve.coefficients()), interval: ends(curve.interval()) }
    }
}

impl From<&PowerPatch> for PowerPatchRecord {
    fn from(patch: &PowerPatch) -> Self {
        Self {
            degrees: patch.degrees(),
            coefficients: points(patch.coefficients()),
            intervals: patch.intervals().map(ends),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_of_points_are_those_of_the_nested_net() {
        let mut points = vec![[0.0; 3]; 6];
        points[4][2] = f64::INFINITY;
        let record = PatchRecord { degrees: [1, 2], net: NetRecord::Points(points), intervals: [UNIT; 2] };
        let (steps, _) = record.build().unwrap_err();
        assert_eq!(crate::place::path_text(&steps), "control_points[1][1][2]");
    }
}
