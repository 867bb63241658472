//! Wavefront OBJ, written as text: `v`, `vn`, `f` and `l`, indices from 1.
//!
//! Numbers are in the shortest form that reads back to the same f64. Source: the *Object Files* appendix of the
//! Advanced Visualizer manual, sections "Vertex data" and "Elements".

use std::io::Write;

use casteljau_geom::glam::DVec3;
use casteljau_mesh::TriangleMesh;

use crate::IoError;

/// Writes a mesh; a vertex and its normal have the same number.
///
/// ```
/// use casteljau_mesh::{TriangleMesh, glam::DVec3};
/// let mesh = TriangleMesh {
///     positions: vec![DVec3::ZERO, DVec3::X * 0.1, DVec3::Y],
///     normals: vec![DVec3::Z; 3],
///     triangles: vec![[0, 1, 2]],
/// };
/// let mut text = Vec::new();
/// casteljau_io::obj::write(&mesh, &mut text)?;
/// assert!(text.starts_with(b"v 0.0 0.0 0.0\nv 0.1 0.0 0.0\n"));
/// assert!(text.ends_with(b"f 1//1 2//2 3//3\n"));
/// # Ok::<(), casteljau_io::IoError>(())
/// ```
pub fn write(mesh: &TriangleMesh, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    mesh.validate()?;
    for p in &mesh.positions {
        writeln!(out, "v {:?} {:?} {:?}", p.x, p.y, p.z)?;
    }
    for n in &mesh.normals {
        writeln!(out, "vn {:?} {:?} {:?}", n.x, n.y, n.z)?;
    }
    for corners in &mesh.triangles {
        // In u64, because the last of 2³² − 1 vertices has the number 2³² − 1 and the arithmetic should not care.
        let [a, b, c] = corners.map(|index| u64::from(index) + 1);
        if mesh.normals.is_empty() {
            writeln!(out, "f {a} {b} {c}")?;
        } else {
            writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?;
        }
    }
    Ok(())
}

/// Writes polylines, one `l` element each.
///
/// ```
/// use casteljau_mesh::glam::DVec3;
/// let mut text = Vec::new();
/// casteljau_io::obj::write_polylines(&[vec![DVec3::ZERO, DVec3::X], vec![DVec3::X, DVec3::Y, DVec3::Z]], &mut text)?;
/// assert!(text.ends_with(b"l 1 2\nl 3 4 5\n"));
/// # Ok::<(), casteljau_io::IoError>(())
/// ```
pub fn write_polylines(lines: &[Vec<DVec3>], out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    for p in lines.iter().flatten() {
        writeln!(out, "v {:?} {:?} {:?}", p.x, p.y, p.z)?;
    }
    let mut next = 1_usize;
    for line in lines {
        write!(out, "l")?;
        for index in next..next + line.len() {
            write!(out, " {index}")?;
        }
        writeln!(out)?;
        next += line.len();
    }
    Ok(())
}
