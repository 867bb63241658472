//! Polygon File Format (Stanford PLY 1.0), binary little-endian or text, coordinates and normals as `double`.
//!
//! Source: Greg Turk, *The PLY Polygon File Format*, 1994.

use std::io::Write;

use casteljau_geom::glam::DVec3;
use casteljau_mesh::TriangleMesh;

use crate::error::STREAM;
use crate::{IoError, Place, Reason};

/// Writes a mesh in the binary little-endian form: 24 bytes a vertex, 48 with normals, 13 a triangle.
///
/// ```
/// use casteljau_mesh::{TriangleMesh, glam::DVec3};
/// let mesh = TriangleMesh {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
///     triangles: vec![[0, 1, 2]],
///     ..Default::default()
/// };
/// let mut bytes = Vec::new();
/// casteljau_io::ply::write(&mesh, &mut bytes)?;
/// assert!(bytes.starts_with(b"ply\nformat binary_little_endian 1.0\n"));
/// assert!(bytes.ends_with(&[3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]));
/// # Ok::<(), casteljau_io::IoError>(())
/// ```
pub fn write(mesh: &TriangleMesh, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    mesh.validate()?;
    header(mesh, "binary_little_endian", out)?;
    for (index, p) in mesh.positions.iter().enumerate() {
        for number in
            p.to_array().into_iter().chain(mesh.normals.get(index).into_iter().flat_map(|n| n.to_array()))
        {
            out.write_all(&number.to_le_bytes())?;
        }
    }
    for corners in &mesh.triangles {
        out.write_all(&[3])?;
        for index in corners {
            out.write_all(&index.to_le_bytes())?;
        }
    }
    Ok(())
}

/// Writes a mesh as text, numbers in the shortest form that reads back to the same f64.
pub fn write_ascii(mesh: &TriangleMesh, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    mesh.validate()?;
    header(mesh, "ascii", out)?;
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

/// Writes polylines in the binary little-endian form, as elements `edge` of two vertices: 24 bytes a vertex, 8 an edge.
///
/// ```
/// use casteljau_mesh::glam::DVec3;
/// let mut bytes = Vec::new();
/// casteljau_io::ply::write_polylines(&[vec![DVec3::ZERO, DVec3::X, DVec3::Y]], &mut bytes)?;
/// assert!(bytes.ends_with(&[0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]));
/// # Ok::<(), casteljau_io::IoError>(())
/// ```
///
/// # Errors
/// [`Reason::TooManyVertices`] beyond 2³¹ − 1 vertices; what the stream says.
pub fn write_polylines(lines: &[Vec<DVec3>], out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    let vertices: usize = lines.iter().map(Vec::len).sum();
    let edges: usize = lines.iter().map(|line| line.len().saturating_sub(1)).sum();
    // Indices are `int`, as the format's common readers have them.
    let limit = i32::MAX as usize;
    if vertices > limit {
        let reason = Reason::TooManyVertices { count: vertices, limit };
        return Err(IoError::invalid(Place::file(STREAM), reason));
    }
    writeln!(out, "ply\nformat binary_little_endian 1.0\ncomment casteljau\nelement vertex {vertices}")?;
    writeln!(out, "property double x\nproperty double y\nproperty double z\nelement edge {edges}")?;
    writeln!(out, "property int vertex1\nproperty int vertex2\nend_header")?;
    for number in lines.iter().flatten().flat_map(DVec3::to_array) {
        out.write_all(&number.to_le_bytes())?;
    }
    let mut first = 0_u32;
    for line in lines {
        let end = first + line.len() as u32;
        for index in first..end.saturating_sub(1).max(first) {
            out.write_all(&index.to_le_bytes())?;
            out.write_all(&(index + 1).to_le_bytes())?;
        }
        first = end;
    }
    Ok(())
}

fn header(mesh: &TriangleMesh, encoding: &str, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    writeln!(out, "ply\nformat {encoding} 1.0\ncomment casteljau")?;
    writeln!(out, "element vertex {}", mesh.positions.len())?;
    writeln!(out, "property double x\nproperty double y\nproperty double z")?;
    if !mesh.normals.is_empty() {
        writeln!(out, "property double nx\nproperty double ny\nproperty double nz")?;
    }
    writeln!(out, "element face {}", mesh.triangles.len())?;
    writeln!(out, "property list uchar uint vertex_indices\nend_header")?;
    Ok(())
}
