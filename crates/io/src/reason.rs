use casteljau_gb::GbError;
use casteljau_geom::GeomError;
use casteljau_shape::ShapeError;
use casteljau_solid::SolidError;
use thiserror::Error;

use crate::vtu::VtuError;

/// What is wrong inside a file, and why. Sides, rows, points and corners count from 0.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Reason {
    /// Nothing, or nothing but blanks.
    #[error("the file is empty")]
    Empty,
    /// Bytes that are no text.
    #[error("not a text file: byte {offset} is 0x{byte:02x}, which is not UTF-8")]
    NotText {
        /// Where, in bytes from the start.
        offset: usize,
        /// The first byte that fits nothing.
        byte: u8,
    },
    /// Larger than [`MAX_FILE_BYTES`](crate::MAX_FILE_BYTES).
    #[error("more than {limit} bytes, the largest model file that is read")]
    TooLong {
        /// The limit.
        limit: u64,
    },
    /// JSON that cannot be parsed, or a field of the wrong type, missing, repeated or unknown.
    #[error("{message}")]
    Json {
        /// What the parser says.
        message: String,
    },
    /// A model file of another version.
    #[error("`casteljau` is {found}; this program reads version 1")]
    Version {
        /// What stands there.
        found: String,
    },
    /// A kind of shape that does not exist.
    #[error("there is no kind `{kind}`; supported: {supported}")]
    KindUnknown {
        /// What stands there.
        kind: String,
        /// The kinds that there are.
        supported: String,
    },
    /// A part of a solid that is of another kind.
    #[error("a shape of kind `{expected}` is needed here, not `{found}`")]
    PartKind {
        /// The kind that is needed.
        expected: &'static str,
        /// What stands there.
        found: String,
    },
    /// Both angles of a twist.
    #[error(
        "`angle` (radians per layer of control points) and `rigid_angle` (radians in all) exclude each other"
    )]
    TwoAngles,
    /// Neither angle of a twist.
    #[error(
        "there is no angle: `angle` (radians per layer of control points) or `rigid_angle` (radians in all) is needed"
    )]
    NoAngle,
    /// A form of GB patch that cannot be read yet.
    #[error("GB patches of form `{form}` are not supported yet; supported: `concave`")]
    FormNotYet {
        /// The form.
        form: String,
    },
    /// A form of GB patch that does not exist.
    #[error("there is no form `{form}`; supported: `concave`")]
    FormUnknown {
        /// What stands there.
        form: String,
    },
    /// A format that cannot be read yet.
    #[error("the format .{ending} is not supported yet; supported: {supported}")]
    FormatNotYet {
        /// Its ending.
        ending: String,
        /// The endings that can be read.
        supported: &'static str,
    },
    /// Too few sides for a patch.
    #[error("{sides} sides; a patch has at least 3")]
    Sides {
        /// How many there are.
        sides: i64,
    },
    /// A degree outside 1…20.
    #[error("side {side}: degree {degree} is outside 1 to {limit}")]
    Degree {
        /// The side.
        side: usize,
        /// Its degree.
        degree: i64,
        /// The highest degree.
        limit: usize,
    },
    /// A number of layers outside 1…6.
    #[error("side {side}: {layers} layers is outside 1 to {limit}")]
    Layers {
        /// The side.
        side: usize,
        /// Its layers.
        layers: i64,
        /// The largest number of layers.
        limit: usize,
    },
    /// A row of control points of another length than row 0.
    #[error("side {side}: row {row} has {found} control points, but row 0 has {expected}")]
    RowLength {
        /// The side.
        side: usize,
        /// The row.
        row: usize,
        /// Its length.
        found: usize,
        /// The length of row 0.
        expected: usize,
    },
    /// A number that is NaN or infinite.
    #[error("{what} is {value}, which is not finite")]
    NotFinite {
        /// Which number.
        what: String,
        /// Its value.
        value: f64,
    },
    /// Something else where a number is expected.
    #[error("{what}: `{found}` is not a number")]
    NotNumber {
        /// Which number.
        what: String,
        /// What stands there.
        found: String,
    },
    /// Something else where an integer is expected.
    #[error("{what}: `{found}` is not an integer")]
    NotInteger {
        /// Which number.
        what: String,
        /// What stands there.
        found: String,
    },
    /// The file ends too early.
    #[error("the file ends where {what} is expected")]
    Truncated {
        /// What is missing.
        what: String,
    },
    /// A count that the rest of the file cannot fulfil.
    #[error("{promised} {what} are promised, but the {left} numbers that follow hold {possible} at most")]
    Promised {
        /// What is counted.
        what: &'static str,
        /// The count.
        promised: i64,
        /// How many numbers follow.
        left: usize,
        /// How many that is enough for.
        possible: usize,
    },
    /// Something behind the end.
    #[error("`{found}` follows where the model has ended")]
    Trailing {
        /// The first word of it.
        found: String,
    },
    /// An outline with a wrong number of vertices.
    #[error("the domain has {found} vertices, but the patch has {expected} sides")]
    DomainVertices {
        /// Vertices of the outline.
        found: usize,
        /// Sides of the patch.
        expected: usize,
    },
    /// A word that means nothing in its place.
    #[error("`{found}` is not known; known: {known}")]
    Word {
        /// The word.
        found: String,
        /// The words that mean something.
        known: String,
    },
    /// Both a layout and an outline.
    #[error("`layout` and `domain` exclude each other")]
    LayoutAndDomain,
    /// A blend power below 1.
    #[error("the blend power must be a positive integer, not {value}")]
    BlendPower {
        /// Its value.
        value: u32,
    },
    /// A corner point for a corner that does not exist.
    #[error("there is no corner {corner}: the patch has {sides}")]
    Corner {
        /// The corner.
        corner: i64,
        /// How many there are.
        sides: usize,
    },
    /// Two corner points for one corner.
    #[error("corner {corner} has two corner points")]
    RepeatedCorner {
        /// The corner.
        corner: usize,
    },
    /// A code of a `.cgb` file that means nothing.
    #[error("{what} {value} does not exist; known: {known}")]
    Code {
        /// What the code stands for.
        what: &'static str,
        /// Its value.
        value: i64,
        /// The codes that mean something.
        known: &'static str,
    },
    /// A domain type of a `.cgb` file that is not supported yet.
    #[error("domain type {value} ({name}) is not supported yet; supported: 0 (projection), 1 (heuristic)")]
    DomainType {
        /// Its code.
        value: i64,
        /// What it stands for.
        name: &'static str,
    },
    /// A dilation other than 0 in a `.cgb` file.
    #[error("a dilation of {value} is not supported yet; supported: 0")]
    Dilation {
        /// Its value.
        value: f64,
    },
    /// A net whose number of control points, or of rows, does not fit the degree.
    #[error("degree {degree} needs {expected} {what}, not {found}")]
    NetSize {
        /// What is counted.
        what: &'static str,
        /// The degree they have to fit.
        degree: usize,
        /// How many there have to be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A row of coefficients of another length than the first one.
    #[error("row {row} has {found} coefficients, but row 0 has {expected}")]
    CoefficientRow {
        /// The row.
        row: usize,
        /// Its length.
        found: usize,
        /// The length of row 0.
        expected: usize,
    },
    /// A power basis without coefficients.
    #[error("there are no coefficients, and a polynomial has at least one")]
    NoCoefficients,
    /// Neither form of control points.
    #[error("there are no control points: `control_points` or `homogeneous` is needed")]
    NoNet,
    /// Homogeneous control points beside the fields that they stand in place of.
    #[error("`homogeneous` stands in place of `control_points` and `weights`: it excludes `{field}`")]
    TwoNets {
        /// The field that is too much.
        field: &'static str,
    },
    /// What is wrong with a `.vtu` file.
    #[error(transparent)]
    Vtu(VtuError),
    /// An interval that is none.
    #[error(transparent)]
    Interval(GeomError),
    /// A description that is well-formed and no curve, patch or triangle.
    #[error("{0}")]
    Shape(#[source] Box<ShapeError>),
    /// A description that is well-formed and no solid.
    #[error("{0}")]
    Solid(#[source] Box<SolidError>),
    /// A shape of another kind where a GB patch is asked for.
    #[error("a shape of kind `{kind}` is no GB patch")]
    NotGbPatch {
        /// The kind.
        kind: &'static str,
    },
    /// A ribbon that is none.
    #[error("side {side}: {source}")]
    Ribbon {
        /// The side.
        side: usize,
        /// What the ribbon's constructor says.
        source: Box<GbError>,
    },
    /// A description that is well-formed and no patch.
    #[error("{0}")]
    Geometry(#[source] Box<GbError>),
    /// The shape has something that the format has no place for.
    #[error("the format .{format} cannot hold {what}")]
    Unwritable {
        /// Ending of the format.
        format: &'static str,
        /// What is too much.
        what: String,
    },
    /// A coordinate that only f64 can hold, for a format of f32.
    #[error("vertex {vertex} has the coordinate {value:e}, beyond the range of f32 that STL holds")]
    BeyondF32 {
        /// The vertex.
        vertex: usize,
        /// Its coordinate.
        value: f64,
    },
    /// More vertices than the format can count.
    #[error("{count} vertices are more than the {limit} that the format can count")]
    TooManyVertices {
        /// How many there are.
        count: usize,
        /// The most that there can be.
        limit: usize,
    },
    /// More triangles than the format can count.
    #[error("{count} triangles are more than the {limit} that the format can count")]
    TooManyTriangles {
        /// How many there are.
        count: usize,
        /// The most that there can be.
        limit: usize,
    },
}
