//! Polygon File Format (Stanford PLY 1.0), binary little-endian or text, coordinates and normals as `double`.
//!
//! Source: Greg Turk, *The PLY Polygon File Format*, 1994.

use std::io::Write;

use casteljau_mesh::TriangleMesh;

use crate::IoError;

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
