use casteljau_geom::GeomError;
use casteljau_geom::Interval;
use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_shape::{
    BezierCurve, BezierPatch, BezierTriangle, Curve, LARGEST_COORDINATE, Patch, ShapeError, Triangle,
};
use casteljau_solid::{
    BezierHexahedron, BezierTetrahedron, BezierWedge, Hexahedron, SolidError, Tetrahedron, Wedge,
};

use crate::Reason;
use crate::place::Step;
use crate::record::Fault;

/// The control points of a shape as a file gives them, flat, in the order of the net.
///
/// Points with weights stay apart here: multiplying them would round, and a file would not be written as it was read.
#[derive(Clone, Debug, PartialEq)]
pub enum NetRecord {
    /// `control_points`: a polynomial shape.
    Points(Vec<[f64; 3]>),
    /// `control_points` and `weights`, as many of one as of the other: a rational shape.
    Weighted {
        /// The control points.
        points: Vec<[f64; 3]>,
        /// Their weights.
        weights: Vec<f64>,
    },
    /// `homogeneous`: (w·x, w·y, w·z, w), a rational shape.
    Homogeneous(Vec<[f64; 4]>),
}

impl NetRecord {
    /// The number of control points.
    pub fn len(&self) -> usize {
        match self {
            Self::Points(points) | Self::Weighted { points, .. } => points.len(),
            Self::Homogeneous(points) => points.len(),
        }
    }

    /// Whether there are no control points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The field that holds the points.
    pub(crate) fn field(&self) -> &'static str {
        match self {
            Self::Points(_) | Self::Weighted { .. } => "control_points",
            Self::Homogeneous(_) => "homogeneous",
        }
    }

    /// What the shape's constructor says of this net, at the field, the control point or the coordinate it is about.
    ///
    /// `rows` are the lengths of the rows that the file nests, as for [`nested`].
    pub(crate) fn fault(&self, error: ShapeError, rows: &[usize]) -> Fault {
        let at = |field, place| [vec![Step::Field(field)], nested(place, rows)].concat();
        let steps = match (error, self) {
            // Three is the weight; a coordinate that is in range itself is out of it by its weight.
            (ShapeError::Coordinate { place, axis, .. }, Self::Weighted { points, .. })
                if points
                    .get(place)
                    .and_then(|p| p.get(axis))
                    .is_none_or(|x| x.abs() <= LARGEST_COORDINATE) =>
            {
                at("weights", place)
            }
            (ShapeError::Coordinate { place, axis, .. }, _) => {
                [at(self.field(), place), vec![Step::Index(axis)]].concat()
            }
            (ShapeError::WeightCount { .. } | ShapeError::NoWeight { .. }, Self::Weighted { .. }) => {
                vec![Step::Field("weights")]
            }
            (ShapeError::Degree { .. }, _) => vec![Step::Field("degree")],
            _ => vec![Step::Field(self.field())],
        };
        (steps, Reason::Shape(Box::new(error)))
    }

    /// As [`fault`](Self::fault), of what a solid's constructor says.
    pub(crate) fn solid_fault(&self, error: SolidError, rows: &[usize]) -> Fault {
        match error {
            SolidError::Shape(error) => self.fault(error, rows),
            _ => (vec![Step::Field(self.field())], Reason::Solid(Box::new(error))),
        }
    }
}

/// The steps to a control point in an array that nests rows: none for a flat one, the length of a row for rows of points,
/// the number of rows and their length for rows of rows.
pub(crate) fn nested(place: usize, rows: &[usize]) -> Vec<Step> {
    match rows {
        [] => vec![Step::Index(place)],
        [_, inner @ ..] => {
            // What one step of the outer array skips.
            let skipped = rows.iter().fold(1_usize, |product, n| product.saturating_mul((*n).max(1)));
            [vec![Step::Index(place / skipped)], nested(place % skipped, inner)].concat()
        }
    }
}

/// Points in memory as files have them.
pub(crate) fn points(points: &[DVec3]) -> Vec<[f64; 3]> {
    points.iter().map(DVec3::to_array).collect()
}

/// Points of files as shapes take them.
pub(crate) fn vectors(points: &[[f64; 3]]) -> Vec<DVec3> {
    points.iter().copied().map(DVec3::from).collect()
}

/// Homogeneous points of files as shapes take them.
pub(crate) fn homogeneous(points: &[[f64; 4]]) -> Vec<DVec4> {
    points.iter().copied().map(DVec4::from).collect()
}

/// The interval that a field gives.
pub(crate) fn interval([start, end]: [f64; 2], steps: &[Step]) -> Result<Interval, Fault> {
    Interval::new(start, end).map_err(|error: GeomError| (steps.to_vec(), Reason::Interval(error)))
}

macro_rules! from_shapes {
    ($($polynomial:ty, $rational:ty;)*) => {$(
        impl From<&$polynomial> for NetRecord {
            fn from(shape: &$polynomial) -> Self {
                Self::Points(points(shape.control_points()))
            }
        }

        /// Homogeneous: dividing by the weights would round.
        impl From<&$rational> for NetRecord {
            fn from(shape: &$rational) -> Self {
                Self::Homogeneous(shape.control_points().iter().map(DVec4::to_array).collect())
            }
        }
    )*};
}

from_shapes! {
    Curve, BezierCurve<DVec4>;
    Patch, BezierPatch<DVec4>;
    Triangle, BezierTriangle<DVec4>;
    Tetrahedron, BezierTetrahedron<DVec4>;
    Hexahedron, BezierHexahedron<DVec4>;
    Wedge, BezierWedge<DVec4>;
}
