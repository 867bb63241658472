use casteljau_domain::DomainError;
use casteljau_geom::glam::{DVec2, DVec3};

/// What can be wrong with a Generalized Bézier patch, and where.
///
/// Sides and corners are counted from 0; corner i lies between side i and side i + 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GbError {
    /// Fewer than three ribbons.
    #[error("a patch needs at least 3 sides, not {count}")]
    TooFewSides {
        /// Ribbons given.
        count: usize,
    },
    /// A ribbon's degree is outside 1 to [`MAX_DEGREE`](crate::MAX_DEGREE).
    #[error("a ribbon's degree is 1 to {}, not {degree}", crate::MAX_DEGREE)]
    Degree {
        /// Degree given.
        degree: usize,
    },
    /// A ribbon's number of layers is outside 1 to [`MAX_LAYERS`](crate::MAX_LAYERS).
    #[error("a ribbon has 1 to {} layers, not {layers}", crate::MAX_LAYERS)]
    Layers {
        /// Layers given.
        layers: usize,
    },
    /// The number of control points is not layers·(degree + 1).
    #[error("a ribbon of degree {degree} with {layers} layers has {expected} control points, not {found}")]
    PointCount {
        /// Degree along the side.
        degree: usize,
        /// Layers across it.
        layers: usize,
        /// layers·(degree + 1).
        expected: usize,
        /// Points given.
        found: usize,
    },
    /// A control point is not finite or too large to be multiplied ([`MAX_COORDINATE`](crate::MAX_COORDINATE)).
    #[error("{place}: the point ({}, {}, {}) is not finite or exceeds 1e70", point.x, point.y, point.z)]
    Point {
        /// Which point it is.
        place: Place,
        /// The point.
        point: DVec3,
    },
    /// All control points of a side coincide.
    #[error("side {side} has zero length: all its control points are ({}, {}, {})", at.x, at.y, at.z)]
    ZeroLengthSide {
        /// The side.
        side: usize,
        /// Where it is.
        at: DVec3,
    },
    /// A side does not end where the next begins.
    #[error("side {side} ends {gap:.3e} away from the start of side {next} (allowed {allowed:.1e})")]
    CornerGap {
        /// The side that ends.
        side: usize,
        /// The side that begins.
        next: usize,
        /// Distance between the two ends, in model units.
        gap: f64,
        /// Largest distance allowed, in model units.
        allowed: f64,
    },
    /// Two corners of the patch coincide.
    #[error("corners {first} and {second} are {distance:.3e} apart (more than {allowed:.1e} is needed)")]
    EqualCorners {
        /// The corner of lower number.
        first: usize,
        /// The other corner.
        second: usize,
        /// Their distance, in model units.
        distance: f64,
        /// The distance that must be exceeded, in model units.
        allowed: f64,
    },
    /// A tolerance is negative or not a number.
    #[error("the corner tolerance must be a number from 0 to 1, not {value}")]
    Tolerance {
        /// Value given.
        value: f64,
    },
    /// The blend power is outside 1 to [`MAX_BLEND_POWER`](crate::MAX_BLEND_POWER).
    #[error("the blend power is 1 to {}, not {power}", crate::MAX_BLEND_POWER)]
    BlendPower {
        /// Power given.
        power: u32,
    },
    /// The centre has a weight but there is no centre.
    #[error("the center weight `{weight}` needs a center")]
    MissingCenter {
        /// The weight asked for.
        weight: crate::CenterWeight,
    },
    /// The weight of the centre would not vanish on the sides, so the patch would miss its own boundary.
    #[error("the center weight `{weight}` does not vanish on the sides of a patch with {sides} sides")]
    CenterWeightOnBoundary {
        /// The weight asked for.
        weight: crate::CenterWeight,
        /// Sides of the patch.
        sides: usize,
    },
    /// The weight of a corner point would not vanish on a side, so the patch would miss its own boundary.
    #[error("the weight of the corner point at corner {corner} does not vanish on side {side}: {reason}")]
    CornerPointOnBoundary {
        /// The corner.
        corner: usize,
        /// A side on which the weight stays.
        side: usize,
        /// Which property of the patch is to blame.
        reason: &'static str,
    },
    /// There is no such corner.
    #[error("there is no corner {corner}: the patch has {sides}")]
    NoSuchCorner {
        /// Number given.
        corner: usize,
        /// Corners of the patch.
        sides: usize,
    },
    /// Two corner points for one corner.
    #[error("corner {corner} has two corner points")]
    RepeatedCornerPoint {
        /// The corner.
        corner: usize,
    },
    /// There is no such side.
    #[error("there is no side {side}: the patch has {sides}")]
    NoSuchSide {
        /// Number given.
        side: usize,
        /// Sides of the patch.
        sides: usize,
    },
    /// There is no such control point in a ribbon.
    #[error("a ribbon of degree {degree} with {layers} layers has no point j = {j}, k = {k}")]
    NoSuchPoint {
        /// Index along the side.
        j: usize,
        /// Index of the layer.
        k: usize,
        /// Degree of the ribbon.
        degree: usize,
        /// Layers of the ribbon.
        layers: usize,
    },
    /// The domain polygon has a wrong number of vertices.
    #[error("the domain has {vertices} vertices, the patch {sides} sides")]
    DomainSize {
        /// Vertices of the polygon.
        vertices: usize,
        /// Sides of the patch.
        sides: usize,
    },
    /// The parameter lies outside the domain or is not finite.
    #[error("({}, {}) is outside the domain polygon", uv.x, uv.y)]
    Outside {
        /// The parameter.
        uv: DVec2,
    },
    /// A parameter along a side is outside (0, 1), or outside [0, 1] where the ends are allowed.
    #[error("the parameter {t} along side {side} is out of range")]
    SideParameter {
        /// The side.
        side: usize,
        /// The parameter.
        t: f64,
    },
    /// Derivatives with respect to (u, v) do not exist at corners; [`point`](crate::ConcavePatch::point) and
    /// [`normal`](crate::ConcavePatch::normal) do.
    #[error("derivatives do not exist at corner {corner}")]
    CornerDerivative {
        /// The corner.
        corner: usize,
    },
    /// The two tangents are parallel or zero: there is no normal.
    #[error("there is no normal at {location:?}: the tangents are parallel or zero")]
    NoNormal {
        /// Where in the domain.
        location: casteljau_domain::Location,
    },
    /// A derivative exceeds the range of f64.
    #[error("the derivatives at ({}, {}) exceed the range of numbers", uv.x, uv.y)]
    Overflow {
        /// The parameter.
        uv: DVec2,
    },
    /// A buffer has a wrong length.
    #[error("{what} has length {found}, expected {expected}")]
    Length {
        /// Which buffer.
        what: &'static str,
        /// Length needed.
        expected: usize,
        /// Length given.
        found: usize,
    },
    /// Derivatives were asked of samples that were prepared without them.
    #[error("the samples hold derivatives to order {held}, order {needed} is needed")]
    SampleOrder {
        /// Order held.
        held: usize,
        /// Order needed.
        needed: usize,
    },
    /// The samples or the matrix belong to a patch of another structure (sides, degrees, layers, centre, corner points).
    #[error("prepared for a patch of another structure: {what} is {found}, expected {expected}")]
    Structure {
        /// What differs.
        what: &'static str,
        /// The patch's own.
        expected: usize,
        /// What was prepared for.
        found: usize,
    },
    /// Polygon, layout or coordinates.
    #[error("domain: {0}")]
    Domain(#[from] DomainError),
    /// A curve of the patch.
    #[error("side curve: {0}")]
    Shape(#[from] casteljau_shape::ShapeError),
}

/// Names one point of a patch's input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// A ribbon's control point, before the ribbon belongs to a patch.
    Ribbon {
        /// Index along the side.
        j: usize,
        /// Index of the layer.
        k: usize,
    },
    /// The centre.
    Center,
    /// The corner point at a corner.
    CornerPoint {
        /// The corner.
        corner: usize,
    },
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ribbon { j, k } => write!(f, "control point j = {j}, k = {k}"),
            Self::Center => write!(f, "center"),
            Self::CornerPoint { corner } => write!(f, "corner point at corner {corner}"),
        }
    }
}
