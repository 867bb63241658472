//! Object File Format, written as text: `OFF`, or `NOFF` where the mesh has normals.
//!
//! Numbers are in the shortest form that reads back to the same f64. Source: the Geomview manual, "OFF Files".

use std::io::Write;

use casteljau_mesh::TriangleMesh;

use crate::IoError;

/// Writes a mesh: the counts of vertices and triangles (edges are given as 0, as is the custom), a vertex a line with
/// its normal behind it, a triangle a line.
///
/// ```
/// use casteljau_mesh::{TriangleMesh, glam::DVec3};
/// let mesh = TriangleMesh {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
///     triangles: vec![[0, 1, 2]],
///     ..Default::default()
/// };
/// let mut text = Vec::new();
/// casteljau_io::off::write(&mesh, &mut text)?;
/// assert_eq!(text, b"OFF\n3 1 0\n0.0 0.0 0.0\n1.0 0.0 0.0\n0.0 1.0 0.0\n3 0 1 2\n");
/// # Ok::<(), casteljau_io::IoError>(())
/// ```
pub fn write(mesh: &TriangleMesh, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    mesh.validate()?;
    writeln!(out, "{}", if mesh.normals.is_empty() { "OFF" } else { "NOFF" })?;
    writeln!(out, "{} {} 0", mesh.positions.len(), mesh.triangles.len())?;
    for (index, p) in mesh.positions.iter().enumerate() {
        write!(out, "{:?} {:?} {:?}", p.x, p.y, p.z)?;
        match mesh.normals.get(index) {
            Some(n) => writeln!(out, " {:?} {:?} {:?}", n.x, n.y, n.z)?,
            None => writeln!(out)?,
        }
    }
    for [a, b, c] in &mesh.triangles {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    Ok(())
}
