//! VTK's XML format for unstructured grids, with Bézier cells, exact to the bit.
//!
//! | cell | type | shape |
//! | --- | --- | --- |
//! | `VTK_BEZIER_CURVE` | 75 | curve |
//! | `VTK_BEZIER_TRIANGLE` | 76 | triangle |
//! | `VTK_BEZIER_QUADRILATERAL` | 77 | patch |
//! | `VTK_BEZIER_TETRAHEDRON` | 78 | tetrahedron |
//! | `VTK_BEZIER_HEXAHEDRON` | 79 | hexahedron; transitional, rotational and twisted solids |
//! | `VTK_BEZIER_WEDGE` | 80 | wedge |
//!
//! Euclidean control points, the weights in the point array `RationalWeights`, the degrees in the cell array
//! `HigherOrderDegrees`. A control point has one weight, so cells share no points. Names and parameter intervals have no
//! place in the format: its parameters run over [0, 1].
//!
//! [`write()`] makes files of version 2.2 as text, Float64 in the shortest form that reads back to the same bits. What it
//! wrote, [`read`] and `write` reproduce byte by byte: points and weights of a cell stay apart, as they are in the file,
//! until a shape is evaluated. Homogeneous control points are divided by their weights on the way out, which rounds once,
//! so that they come back as points and weights whose products may differ from them in the last bit.
//!
//! [`read`] takes what VTK's own writer makes, in all its encodings; other cells are refused by name. Where no attribute names
//! the array of weights or of degrees, one of that name is it; where there are no degrees, all of a cell are equal. In
//! files before version 2.1 hexahedra have two edges the other way around, and are read so.
//!
//! Source: *VTK File Formats*, and VTK's classes `vtkBezierCurve`, `vtkBezierTriangle` and so on, whose order of nodes
//! [`curve_order`], [`triangle_order`], [`quadrilateral_order`], [`tetrahedron_order`], [`hexahedron_order`] and
//! [`wedge_order`] have.

use std::io::Write;

use crate::IoError;
use crate::model::Model;

mod array;
mod cell;
mod encoded;
mod error;
mod order;
mod read;

use cell::Cell;
pub use error::VtuError;
pub use order::{
    curve_order, hexahedron_order, old_hexahedron_order, quadrilateral_order, tetrahedron_order,
    triangle_order, wedge_order,
};
pub use read::read;

/// Writes curves, surfaces and solids, one cell a shape.
///
/// Power bases are converted, and solids made of patches and curves are the hexahedra that they are; degree 0, which VTK does not know, becomes degree 1, exactly. Homogeneous control points are
/// divided by their weights, which rounds once.
///
/// ```
/// use casteljau_io::{model::Model, vtu};
/// let text = r#"{"casteljau": 1, "shapes": [{"kind": "curve", "degree": 2,
///   "control_points": [[1, 0, 0], [1, 1, 0], [0, 1, 0]], "weights": [1, 1, 2]}]}"#;
/// let mut file = Vec::new();
/// vtu::write(&Model::read(text, "arc.json")?, &mut file)?;
/// let file = String::from_utf8(file)?;
/// assert!(file.contains("1.0 0.0 0.0\n0.0 1.0 0.0\n1.0 1.0 0.0\n")); // the ends come first
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Reason::Unwritable`](crate::Reason::Unwritable) for GB patches and for control points at infinity, at the shape's place; what the stream says.
pub fn write(model: &Model, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    let cells = model.shapes.iter().map(|shape| Cell::new(&shape.shape).map_err(|fault| shape.fault(fault)));
    let cells = cells.collect::<Result<Vec<_>, _>>()?;
    let nodes = || cells.iter().flat_map(|cell| &cell.nodes);
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(
        out,
        "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\" header_type=\"UInt64\">"
    )?;
    writeln!(out, "<UnstructuredGrid>")?;
    writeln!(out, "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", nodes().count(), cells.len())?;
    writeln!(out, "<PointData RationalWeights=\"RationalWeights\">")?;
    let weights = nodes().map(|(_, weight)| format!("{weight:?}"));
    array("Float64", "RationalWeights", 1, weights, out)?;
    writeln!(out, "</PointData>\n<CellData HigherOrderDegrees=\"HigherOrderDegrees\">")?;
    let degrees = cells.iter().map(|cell| cell.degrees.map(|degree| format!("{degree}.0")).join(" "));
    array("Float64", "HigherOrderDegrees", 3, degrees, out)?;
    writeln!(out, "</CellData>\n<Points>")?;
    array("Float64", "Points", 3, nodes().map(|([x, y, z], _)| format!("{x:?} {y:?} {z:?}")), out)?;
    writeln!(out, "</Points>\n<Cells>")?;
    array("Int64", "connectivity", 1, (0..nodes().count()).map(|node| node.to_string()), out)?;
    let ends = cells.iter().scan(0, |end, cell| {
        *end += cell.nodes.len();
        Some(end.to_string())
    });
    array("Int64", "offsets", 1, ends, out)?;
    array("UInt8", "types", 1, cells.iter().map(|cell| cell.kind.code().to_string()), out)?;
    writeln!(out, "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")?;
    Ok(())
}

/// An array, one tuple a line.
fn array(
    number: &str,
    name: &str,
    components: usize,
    tuples: impl Iterator<Item = String>,
    out: &mut (impl Write + ?Sized),
) -> Result<(), IoError> {
    writeln!(
        out,
        "<DataArray type=\"{number}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">"
    )?;
    for tuple in tuples {
        writeln!(out, "{tuple}")?;
    }
    writeln!(out, "</DataArray>")?;
    Ok(())
}
