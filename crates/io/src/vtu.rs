//! VTK's XML format for unstructured grids, written as text: Bézier cells, exact to the bit.
//!
//! File version 2.2; cells `VTK_BEZIER_CURVE` (75), `VTK_BEZIER_TRIANGLE` (76), `VTK_BEZIER_QUADRILATERAL` (77); Euclidean
//! control points as Float64, the weights in the point array `RationalWeights`, the degrees in the cell array
//! `HigherOrderDegrees`. A control point has one weight, so cells share no points. Parameter intervals have no place in the
//! format: its parameters run over [0, 1].
//!
//! Source: *VTK File Formats*, and VTK's classes `vtkBezierCurve`, `vtkBezierTriangle`, `vtkBezierQuadrilateral`, whose order
//! of nodes [`curve_order`], [`triangle_order`] and [`quadrilateral_order`] have.

use std::io::Write;

use casteljau_shape::bernstein::simplex_index;

use crate::model::{Model, NamedShape, Shape};
use crate::place::Step;
use crate::record::Fault;
use crate::{Geometry, IoError, NetRecord, Reason};

mod order;

pub use order::{curve_order, quadrilateral_order, triangle_order};

const CURVE: u8 = 75;
const TRIANGLE: u8 = 76;
const QUADRILATERAL: u8 = 77;

/// A cell: its points, with their weights, in VTK's order.
struct Cell {
    kind: u8,
    degrees: [usize; 3],
    nodes: Vec<([f64; 3], f64)>,
}

/// Writes curves, patches and triangles, one cell a shape.
///
/// Power bases are converted; degree 0, which VTK does not know, becomes degree 1, exactly. Homogeneous control points are
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
/// [`Reason::Unwritable`] for GB patches and for control points at infinity, at the shape's place; what the stream says.
pub fn write(model: &Model, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    let cells = model.shapes.iter().map(|shape| cell(shape).map_err(|fault| shape.fault(fault)));
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
    array("UInt8", "types", 1, cells.iter().map(|cell| cell.kind.to_string()), out)?;
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

fn cell(shape: &NamedShape) -> Result<Cell, Fault> {
    match &shape.shape {
        Shape::Curve(curve) => curve_cell(&curve.net),
        Shape::PowerCurve(_) | Shape::PowerPatch(_) => converted(shape),
        Shape::Patch(patch) => patch_cell(patch.degrees, &patch.net),
        Shape::Triangle(triangle) => triangle_cell(triangle.degree, &triangle.net),
        Shape::GbPatch(_) => {
            let what = "GB patches: they are no Bézier cells; mesh them".into();
            Err((vec![Step::Field("kind")], Reason::Unwritable { format: "vtu", what }))
        }
    }
}

/// A power basis, in Bernstein form.
fn converted(shape: &NamedShape) -> Result<Cell, Fault> {
    let refused = |error| (vec![Step::Field("coefficients")], Reason::Shape(Box::new(error)));
    match &shape.shape {
        Shape::PowerCurve(record) => match record.build()? {
            Geometry::PowerCurve(curve) => curve_cell(&NetRecord::from(&curve.to_bezier().map_err(refused)?)),
            _ => curve_cell(&NetRecord::Points(record.coefficients.clone())),
        },
        Shape::PowerPatch(record) => match record.build()? {
            Geometry::PowerPatch(patch) => {
                patch_cell(record.degrees, &NetRecord::from(&patch.to_bezier().map_err(refused)?))
            }
            _ => patch_cell(record.degrees, &NetRecord::Points(record.coefficients.clone())),
        },
        _ => cell(shape),
    }
}

fn curve_cell(net: &NetRecord) -> Result<Cell, Fault> {
    let last = net.len().saturating_sub(1);
    let degree = last.max(1);
    // Of degree 0 the one control point is both ends; likewise below.
    let nodes = curve_order(degree).into_iter().map(|i| node(net, i.min(last), None));
    Ok(Cell { kind: CURVE, degrees: [degree, 0, 0], nodes: nodes.collect::<Result<_, _>>()? })
}

fn patch_cell([m, n]: [usize; 2], net: &NetRecord) -> Result<Cell, Fault> {
    let degrees = [m.max(1), n.max(1)];
    let place = |[i, j]: [usize; 2]| i.min(m) * (n + 1) + j.min(n);
    let nodes = quadrilateral_order(degrees).into_iter().map(|ij| node(net, place(ij), Some(n + 1)));
    Ok(Cell {
        kind: QUADRILATERAL,
        degrees: [degrees[0], degrees[1], 0],
        nodes: nodes.collect::<Result<_, _>>()?,
    })
}

fn triangle_cell(degree: usize, net: &NetRecord) -> Result<Cell, Fault> {
    let place = |index: [usize; 3]| if degree == 0 { 0 } else { simplex_index(index) };
    let nodes = triangle_order(degree.max(1)).into_iter().map(|index| node(net, place(index), None));
    Ok(Cell {
        kind: TRIANGLE,
        degrees: [degree.max(1), degree.max(1), 0],
        nodes: nodes.collect::<Result<_, _>>()?,
    })
}

/// A control point with its weight; `row` is the length of a row where the file nests them.
fn node(net: &NetRecord, place: usize, row: Option<usize>) -> Result<([f64; 3], f64), Fault> {
    let missing = ([0.0; 3], 0.0);
    Ok(match net {
        NetRecord::Points(points) => points.get(place).map_or(missing, |p| (*p, 1.0)),
        NetRecord::Weighted { points, weights } => {
            points.get(place).zip(weights.get(place)).map_or(missing, |(p, w)| (*p, *w))
        }
        NetRecord::Homogeneous(points) => match points.get(place) {
            // It contributes nothing, wherever it is.
            None | Some([0.0, 0.0, 0.0, 0.0]) => missing,
            Some([x, y, z, w]) => {
                let point = [x / w, y / w, z / w];
                if !point.iter().all(|c| c.is_finite()) {
                    let nested = row.map(|row| [Step::Index(place / row), Step::Index(place % row)]);
                    let mut steps = vec![Step::Field("homogeneous")];
                    steps.extend(nested.map_or(vec![Step::Index(place)], Vec::from));
                    let what = "a control point at infinity".into();
                    return Err((steps, Reason::Unwritable { format: "vtu", what }));
                }
                (point, *w)
            }
        },
    })
}
