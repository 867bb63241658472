//! Meshes of linear cells as VTK's XML format for unstructured grids, text, to the bit.
//!
//! File version 2.2; cells `VTK_TETRA` (10), `VTK_HEXAHEDRON` (12), `VTK_WEDGE` (13), `VTK_PYRAMID` (14); points as Float64.
//!
//! Source: *VTK File Formats*.

use std::io::Write;

use casteljau_mesh::{Cell, VolumeMesh};

use crate::IoError;

/// Writes a mesh of cells.
///
/// The order of a cell's vertices is VTK's; only of wedges VTK wants the other triangle first.
///
/// ```
/// use casteljau_io::vtu_mesh;
/// use casteljau_mesh::{Cell, VolumeMesh, glam::DVec3};
/// let mesh = VolumeMesh {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
///     cells: vec![Cell::Tetrahedron([0, 1, 2, 3])],
/// };
/// let mut file = Vec::new();
/// vtu_mesh::write(&mesh, &mut file)?;
/// assert!(String::from_utf8(file)?.contains("\n0 1 2 3\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`IoError::Mesh`] where the mesh does not hold together; what the stream says.
pub fn write(mesh: &VolumeMesh, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    mesh.validate()?;
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(
        out,
        "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\" header_type=\"UInt64\">"
    )?;
    writeln!(out, "<UnstructuredGrid>")?;
    let (points, cells) = (mesh.positions.len(), mesh.cells.len());
    writeln!(out, "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">")?;
    writeln!(out, "<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">")?;
    for p in &mesh.positions {
        writeln!(out, "{:?} {:?} {:?}", p.x, p.y, p.z)?;
    }
    writeln!(out, "</DataArray>\n</Points>\n<Cells>")?;
    writeln!(out, "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">")?;
    for cell in &mesh.cells {
        let cell = match *cell {
            Cell::Wedge([a, b, c, d, e, f]) => Cell::Wedge([d, e, f, a, b, c]),
            cell => cell,
        };
        let row: Vec<String> = cell.vertices().iter().map(u32::to_string).collect();
        writeln!(out, "{}", row.join(" "))?;
    }
    writeln!(out, "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">")?;
    let mut offset = 0;
    for cell in &mesh.cells {
        offset += cell.vertices().len();
        writeln!(out, "{offset}")?;
    }
    writeln!(out, "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">")?;
    for cell in &mesh.cells {
        let kind = match cell {
            Cell::Tetrahedron(_) => 10,
            Cell::Hexahedron(_) => 12,
            Cell::Wedge(_) => 13,
            Cell::Pyramid(_) => 14,
        };
        writeln!(out, "{kind}")?;
    }
    writeln!(out, "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")?;
    Ok(())
}
