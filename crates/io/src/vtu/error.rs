use thiserror::Error;

/// What is wrong inside a `.vtu` file, and why. Cells and points count from 0, in the order of the piece.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum VtuError {
    /// No XML.
    #[error("{message}")]
    Xml {
        /// What the parser says.
        message: String,
    },
    /// XML of something else.
    #[error("the root element is <{found}>, not <VTKFile>")]
    Root {
        /// The root element.
        found: String,
    },
    /// An element that has to be there.
    #[error("there is no <{element}> in <{within}>")]
    NoElement {
        /// The element.
        element: &'static str,
        /// What should hold it.
        within: String,
    },
    /// An attribute that has to be there.
    #[error("<{element}> has no attribute `{attribute}`")]
    NoAttribute {
        /// The element.
        element: String,
        /// The attribute.
        attribute: &'static str,
    },
    /// An attribute of a value that means nothing here.
    #[error("`{attribute}` is `{found}`; what is read: {known}")]
    Attribute {
        /// The attribute.
        attribute: &'static str,
        /// What stands there.
        found: String,
        /// What can stand there.
        known: &'static str,
    },
    /// An array that has to be there.
    #[error("there is no array `{array}` in <{within}>")]
    NoArray {
        /// The array.
        array: String,
        /// What should hold it.
        within: &'static str,
    },
    /// Something else where a number is expected.
    #[error("array `{array}`: `{found}` is no number of type {number}")]
    Number {
        /// The array.
        array: String,
        /// What stands there.
        found: String,
        /// The type that the file says.
        number: &'static str,
    },
    /// An array with fewer or more numbers than are needed.
    #[error("array `{array}` has {found} numbers, not {expected}")]
    Size {
        /// The array.
        array: String,
        /// How many there have to be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// Binary data that cannot be decoded.
    #[error("array `{array}`: {why}")]
    Encoded {
        /// The array.
        array: String,
        /// What is wrong with it.
        why: String,
    },
    /// An array that unpacks to more than [`MAX_FILE_BYTES`](crate::MAX_FILE_BYTES).
    #[error("array `{array}` unpacks to more than {limit} bytes, the largest that is read")]
    TooLong {
        /// The array.
        array: String,
        /// The limit.
        limit: u64,
    },
    /// A cell that is no Bézier cell.
    #[error(
        "cell {cell} is of type {code}{}, which is no Bézier cell; those are read: 75 to 80 (curve, triangle, quadrilateral, tetrahedron, hexahedron, wedge)",
        name.map_or_else(String::new, |name| format!(" ({name})"))
    )]
    CellType {
        /// The cell.
        cell: usize,
        /// VTK's number for its type.
        code: i64,
        /// VTK's name for it, if it is known here.
        name: Option<&'static str>,
    },
    /// A cell whose number of points does not fit its degrees.
    #[error("cell {cell}, {kind} of degrees {degrees:?}, has {found} points{}",
        expected.map_or_else(String::new, |expected| format!(", not {expected}")))]
    CellSize {
        /// The cell.
        cell: usize,
        /// VTK's name for its type.
        kind: &'static str,
        /// The degrees that the file gives.
        degrees: [usize; 3],
        /// How many there have to be; `None` beyond counting.
        expected: Option<usize>,
        /// How many there are.
        found: usize,
    },
    /// A cell without degrees whose number of points is that of no degree.
    #[error("cell {cell}, {kind}, has no degrees, and its {found} points are those of no degree")]
    NoDegrees {
        /// The cell.
        cell: usize,
        /// VTK's name for its type.
        kind: &'static str,
        /// How many points it has.
        found: usize,
    },
    /// A degree that is none.
    #[error("cell {cell} has the degree {value}, which is not an integer from 1 to {limit}")]
    Degree {
        /// The cell.
        cell: usize,
        /// The value.
        value: f64,
        /// The highest degree.
        limit: usize,
    },
    /// A cell that ends before it begins, or behind the last point of all cells.
    #[error("cell {cell} ends at {end} of the {count} numbers of `connectivity`, and begins at {start}")]
    Offset {
        /// The cell.
        cell: usize,
        /// Where it begins.
        start: usize,
        /// Where it ends.
        end: i64,
        /// Length of `connectivity`.
        count: usize,
    },
    /// A point that does not exist.
    #[error("cell {cell} names point {point}; there are {count}")]
    NoPoint {
        /// The cell.
        cell: usize,
        /// The point.
        point: i64,
        /// How many there are.
        count: usize,
    },
}
