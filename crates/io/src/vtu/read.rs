//! From the content of a file to shapes.

use roxmltree::{Document, Node};

use super::array::{Appended, Arrays, Fault, attribute, name, offset};
use super::cell::{Cell, CellKind, degrees_of};
use super::encoded::Packing;
use super::error::VtuError;
use crate::model::{Model, NamedShape, Shape};
use crate::place::excerpt;
use crate::{IoError, Place, Reason};

/// The highest degree of a shape.
const MAX_DEGREE: usize = casteljau_shape::bernstein::MAX_DEGREE;

/// Names of types that are no Bézier cells, for messages.
const OTHER_CELLS: [(i64, &str); 26] = [
    (1, "VTK_VERTEX"),
    (2, "VTK_POLY_VERTEX"),
    (3, "VTK_LINE"),
    (4, "VTK_POLY_LINE"),
    (5, "VTK_TRIANGLE"),
    (6, "VTK_TRIANGLE_STRIP"),
    (7, "VTK_POLYGON"),
    (8, "VTK_PIXEL"),
    (9, "VTK_QUAD"),
    (10, "VTK_TETRA"),
    (11, "VTK_VOXEL"),
    (12, "VTK_HEXAHEDRON"),
    (13, "VTK_WEDGE"),
    (14, "VTK_PYRAMID"),
    (21, "VTK_QUADRATIC_EDGE"),
    (22, "VTK_QUADRATIC_TRIANGLE"),
    (23, "VTK_QUADRATIC_QUAD"),
    (24, "VTK_QUADRATIC_TETRA"),
    (25, "VTK_QUADRATIC_HEXAHEDRON"),
    (42, "VTK_POLYHEDRON"),
    (68, "VTK_LAGRANGE_CURVE"),
    (69, "VTK_LAGRANGE_TRIANGLE"),
    (70, "VTK_LAGRANGE_QUADRILATERAL"),
    (71, "VTK_LAGRANGE_TETRAHEDRON"),
    (72, "VTK_LAGRANGE_HEXAHEDRON"),
    (81, "VTK_BEZIER_PYRAMID"),
];

/// Reads Bézier cells, one shape a cell; see the [module](super).
///
/// `file` is the name for messages. Numbers may be text, base64 or raw bytes, inside the arrays or behind them, compressed by
/// zlib or not, in either order of bytes. A cell whose weights are all 1 is polynomial.
///
/// ```
/// use casteljau_io::{model::Model, vtu};
/// let text = r#"{"casteljau": 1, "shapes": [{"kind": "curve", "degree": 2,
///   "control_points": [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], "weights": [1.0, 1.0, 2.0]}]}"#;
/// let model = Model::read(text, "arc.json")?;
/// let mut file = Vec::new();
/// vtu::write(&model, &mut file)?;
/// assert_eq!(vtu::read(&file, "arc.vtu")?, model);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`IoError::Invalid`] with the line; of what is wrong with the format [`Reason::Vtu`].
pub fn read(bytes: &[u8], file: &str) -> Result<Model, IoError> {
    let (document, appended) = split(bytes);
    let text = str::from_utf8(&document).map_err(|error| {
        let offset = error.valid_up_to();
        let byte = document.get(offset).copied().unwrap_or_default();
        IoError::invalid(Place::line(file, line_of(&document, offset)), Reason::NotText { offset, byte })
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim_ascii().is_empty() {
        return Err(IoError::invalid(Place::line(file, 1), Reason::Empty));
    }
    let document = Document::parse(text).map_err(|error| {
        let at = error.pos();
        let position = format!(" at {}:{}", at.row, at.col);
        let message = error.to_string();
        let message = message.strip_suffix(&position).unwrap_or(&message);
        let message = crate::place::shorten(message, 200);
        let place = Place { column: Some(at.col as usize), ..Place::line(file, at.row as usize) };
        IoError::invalid(place, Reason::Vtu(VtuError::Xml { message }))
    })?;
    let cells = cells(&document, appended).map_err(|(offset, error)| {
        let line = line_of(text.as_bytes(), offset);
        IoError::invalid(Place::line(file, line), Reason::Vtu(error))
    })?;
    // All cells of a piece have one place; lines are counted once a piece.
    let mut last = (usize::MAX, 0);
    let shapes = cells.into_iter().enumerate().map(|(cell, (offset, shape))| {
        if last.0 != offset {
            last = (offset, line_of(text.as_bytes(), offset));
        }
        NamedShape::from_vtu(shape, file, last.1, cell)
    });
    Model::checked(shapes.collect())
}

fn line_of(text: &[u8], offset: usize) -> usize {
    1 + text.iter().take(offset).filter(|&&byte| byte == b'\n').count()
}

/// The document, closed before appended data, which may be anything, and these.
fn split(bytes: &[u8]) -> (std::borrow::Cow<'_, [u8]>, Option<&[u8]>) {
    const START: &[u8] = b"<AppendedData";
    let found = bytes.windows(START.len()).position(|window| window == START);
    let parts = found.and_then(|start| {
        let end = start + bytes[start..].iter().position(|&byte| byte == b'>')?;
        // `<AppendedData/>` has none.
        (bytes[end - 1] != b'/').then(|| bytes.split_at(end + 1))
    });
    let Some((document, data)) = parts else { return (bytes.into(), None) };
    let data = data.iter().position(|&byte| byte == b'_').map_or(&data[data.len()..], |at| &data[at + 1..]);
    ([document, b"</AppendedData></VTKFile>"].concat().into(), Some(data))
}

/// Shapes in order, each with the byte where the points of its piece stand.
fn cells(document: &Document<'_>, appended: Option<&[u8]>) -> Result<Vec<(usize, Shape)>, Fault> {
    let root = document.root_element();
    if root.tag_name().name() != "VTKFile" {
        return Err((root.range().start, VtuError::Root { found: excerpt(root.tag_name().name()) }));
    }
    known(root, "type", "UnstructuredGrid", None)?;
    let old = is_old(root)?;
    let packing = Packing {
        big_endian: known(root, "byte_order", "LittleEndian", Some("BigEndian"))?,
        long_lengths: root.attribute("header_type").is_some()
            && known(root, "header_type", "UInt32", Some("UInt64"))?,
        compressed: match root.attribute("compressor") {
            None | Some("") => false,
            Some(_) => {
                known(root, "compressor", "vtkZLibDataCompressor", None)?;
                true
            }
        },
    };
    let arrays = Arrays { packing, appended: appended.map(|data| behind(root, data)).transpose()? };
    let grid = child(root, "UnstructuredGrid")?;
    let mut shapes = Vec::new();
    for piece in grid.children().filter(|node| node.has_tag_name("Piece")) {
        piece_cells(&arrays, piece, old, &mut shapes)?;
    }
    Ok(shapes)
}

/// Whether an attribute has the second of two values; an error for a third one.
fn known(
    node: Node<'_, '_>,
    name: &'static str,
    first: &'static str,
    second: Option<&'static str>,
) -> Result<bool, Fault> {
    let value = attribute(node, name)?;
    let known = match name {
        "byte_order" => "LittleEndian, BigEndian",
        "header_type" => "UInt32, UInt64",
        _ => first,
    };
    match value {
        _ if value == first => Ok(false),
        _ if Some(value) == second => Ok(true),
        _ => {
            let error = VtuError::Attribute { attribute: name, found: excerpt(value), known };
            Err((node.range().start, error))
        }
    }
}

/// Whether the file is of a version before 2.1, in which hexahedra have two edges the other way around.
fn is_old(root: Node<'_, '_>) -> Result<bool, Fault> {
    let text = attribute(root, "version")?;
    let version = text.split_once('.').and_then(|(major, minor)| {
        Some((major.trim().parse::<u32>().ok()?, minor.trim().parse::<u32>().ok()?))
    });
    match version {
        Some(version @ (0..=2, _)) => Ok(version < (2, 1)),
        _ => {
            let known = "0.1 to 2.x";
            let error = VtuError::Attribute { attribute: "version", found: excerpt(text), known };
            Err((root.range().start, error))
        }
    }
}

fn behind<'b>(root: Node<'_, '_>, bytes: &'b [u8]) -> Result<Appended<'b>, Fault> {
    let node = child(root, "AppendedData")?;
    let base64 = match node.attribute("encoding") {
        None | Some("base64") => true,
        Some("raw") => false,
        Some(other) => {
            let (attribute, known) = ("encoding", "base64, raw");
            let error = VtuError::Attribute { attribute, found: excerpt(other), known };
            return Err((node.range().start, error));
        }
    };
    let end = bytes.iter().position(|&byte| byte == b'<').filter(|_| base64).unwrap_or(bytes.len());
    let arrays = root.descendants().filter(|node| node.attribute("format") == Some("appended"));
    let mut offsets = arrays.map(offset).collect::<Result<Vec<_>, _>>()?;
    offsets.sort_unstable();
    Ok(Appended { bytes: &bytes[..end], base64, offsets })
}

fn child<'a, 'i>(node: Node<'a, 'i>, element: &'static str) -> Result<Node<'a, 'i>, Fault> {
    node.children().find(|child| child.has_tag_name(element)).ok_or_else(|| {
        (node.range().start, VtuError::NoElement { element, within: node.tag_name().name().into() })
    })
}

/// The array of a name.
fn array<'a, 'i>(node: Node<'a, 'i>, name: &str, within: &'static str) -> Result<Node<'a, 'i>, Fault> {
    named(node, name).ok_or_else(|| (node.range().start, VtuError::NoArray { array: excerpt(name), within }))
}

fn named<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    let mut arrays = node.children().filter(|child| child.has_tag_name("DataArray"));
    arrays.find(|child| child.attribute("Name") == Some(name))
}

/// The array with a special meaning: the one that the attribute of this name names, or the one of this name.
fn meaning<'a, 'i>(
    piece: Node<'a, 'i>,
    section: &'static str,
    meaning: &'static str,
) -> Result<Option<Node<'a, 'i>>, Fault> {
    let Some(section_node) = piece.children().find(|child| child.has_tag_name(section)) else {
        return Ok(None);
    };
    match section_node.attribute(meaning) {
        Some(name) => array(section_node, name, section).map(Some),
        None => Ok(named(section_node, meaning)),
    }
}

fn sized<T>(numbers: Vec<T>, node: Node<'_, '_>, expected: usize) -> Result<Vec<T>, Fault> {
    match numbers.len() {
        found if found == expected => Ok(numbers),
        found => Err((node.range().start, VtuError::Size { array: name(node), expected, found })),
    }
}

fn piece_cells(
    arrays: &Arrays<'_>,
    piece: Node<'_, '_>,
    old: bool,
    shapes: &mut Vec<(usize, Shape)>,
) -> Result<(), Fault> {
    let count = |name| -> Result<usize, Fault> {
        let text = attribute(piece, name)?;
        text.trim().parse().map_err(|_| {
            let error = VtuError::Attribute { attribute: name, found: excerpt(text), known: "a number" };
            (piece.range().start, error)
        })
    };
    let (point_count, cell_count) = (count("NumberOfPoints")?, count("NumberOfCells")?);
    if cell_count == 0 {
        return Ok(());
    }
    let section = child(piece, "Points")?;
    let points_node = child(section, "DataArray")?;
    let points = sized(arrays.floats(points_node)?, points_node, point_count.saturating_mul(3))?;
    let weights = match meaning(piece, "PointData", "RationalWeights")? {
        Some(node) => Some(sized(arrays.floats(node)?, node, point_count)?),
        None => None,
    };
    let degrees = match meaning(piece, "CellData", "HigherOrderDegrees")? {
        Some(node) => Some((node, sized(arrays.floats(node)?, node, cell_count.saturating_mul(3))?)),
        None => None,
    };
    let section = child(piece, "Cells")?;
    let connectivity_node = array(section, "connectivity", "Cells")?;
    let connectivity = arrays.integers(connectivity_node)?;
    let offsets_node = array(section, "offsets", "Cells")?;
    let offsets = sized(arrays.integers(offsets_node)?, offsets_node, cell_count)?;
    let types_node = array(section, "types", "Cells")?;
    let types = sized(arrays.integers(types_node)?, types_node, cell_count)?;

    let mut start = 0;
    for (cell, (&code, &end)) in types.iter().zip(&offsets).enumerate() {
        let kind =
            CellKind::ALL.into_iter().find(|kind| i64::from(kind.code()) == code).ok_or_else(|| {
                let name = OTHER_CELLS.iter().find(|(other, _)| *other == code).map(|(_, name)| *name);
                (types_node.range().start, VtuError::CellType { cell, code, name })
            })?;
        let ids = usize::try_from(end).ok().and_then(|end| connectivity.get(start..end));
        let ids = ids.ok_or_else(|| {
            let error = VtuError::Offset { cell, start, end, count: connectivity.len() };
            (offsets_node.range().start, error)
        })?;
        start += ids.len();
        let degrees = match &degrees {
            Some((node, degrees)) => {
                let told = degrees.get(3 * cell..3 * cell + 3).unwrap_or_default();
                checked_degrees(kind, cell, told, ids.len()).map_err(|error| (node.range().start, error))?
            }
            None => degrees_of(kind, ids.len()).ok_or_else(|| {
                let error = VtuError::NoDegrees { cell, kind: kind.name(), found: ids.len() };
                (offsets_node.range().start, error)
            })?,
        };
        let nodes = ids.iter().map(|&id| {
            let index = usize::try_from(id).ok().filter(|&index| index < point_count);
            let point = index.and_then(|index| points.get(3 * index..3 * index + 3)?.first_chunk::<3>());
            let Some((index, point)) = index.zip(point) else {
                let error = VtuError::NoPoint { cell, point: id, count: point_count };
                return Err((connectivity_node.range().start, error));
            };
            Ok((*point, weights.as_ref().and_then(|w| w.get(index)).copied().unwrap_or(1.0)))
        });
        let cell = Cell { kind, degrees, nodes: nodes.collect::<Result<_, Fault>>()? };
        shapes.push((points_node.range().start, cell.into_shape(old)));
    }
    Ok(())
}

/// The degrees that the file gives, once they are some and fit the number of points.
fn checked_degrees(kind: CellKind, cell: usize, told: &[f64], found: usize) -> Result<[usize; 3], VtuError> {
    let mut degrees = [0; 3];
    // Those that a cell of this kind does not have may be anything.
    let needed = kind.told([1; 3]);
    for ((degree, &value), needed) in degrees.iter_mut().zip(told).zip(needed) {
        if needed == 1 {
            if value.fract() != 0.0 || !(1.0..=MAX_DEGREE as f64).contains(&value) {
                return Err(VtuError::Degree { cell, value, limit: MAX_DEGREE });
            }
            *degree = value as usize;
        }
    }
    let expected = kind.count(degrees);
    if expected != Some(found) {
        return Err(VtuError::CellSize { cell, kind: kind.name(), degrees, expected, found });
    }
    Ok(degrees)
}
