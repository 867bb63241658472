//! Stereolithography files (STL), binary or text.
//!
//! **STL holds f32.** Coordinates keep about seven digits: vertices move by up to 6·10⁻⁸ of the largest coordinate,
//! and thin triangles may fold over or vanish. STL shares no vertices either, so that a closed mesh is closed only for
//! a reader that welds equal positions; they stay equal, since equal f64 round to equal f32. Prefer
//! [PLY](crate::ply) where there is a choice. Vertex normals have no place in STL; the normal of each facet is
//! computed from its corners, zero for a facet without area.
//!
//! Source: 3D Systems, *StereoLithography Interface Specification*, 1989.

use std::io::Write;

use casteljau_mesh::TriangleMesh;
use casteljau_mesh::glam::DVec3;

use crate::error::STREAM;
use crate::{IoError, Place, Reason};

/// Writes a mesh in the binary form: 80 bytes of header, the count, 50 bytes a triangle.
///
/// Error: a position beyond the range of f32, or more than 2³² − 1 triangles.
///
/// ```
/// use casteljau_mesh::{TriangleMesh, glam::DVec3};
/// let mesh = TriangleMesh {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
///     triangles: vec![[0, 1, 2]],
///     ..Default::default()
/// };
/// let mut bytes = Vec::new();
/// casteljau_io::stl::write(&mesh, &mut bytes)?;
/// assert_eq!(bytes.len(), 84 + 50);
/// # Ok::<(), casteljau_io::IoError>(())
/// ```
pub fn write(mesh: &TriangleMesh, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    let count = check(mesh)?;
    // The header must not start with "solid", which is how readers tell the text form.
    let mut header = [b' '; 80];
    let title = b"casteljau, binary STL";
    header[..title.len()].copy_from_slice(title);
    out.write_all(&header)?;
    out.write_all(&count.to_le_bytes())?;
    for facet in facets(mesh) {
        for number in facet.into_iter().flatten() {
            out.write_all(&number.to_le_bytes())?;
        }
        out.write_all(&[0, 0])?;
    }
    Ok(())
}

/// Writes a mesh as text, numbers in the shortest form that reads back to the same f32. Error: as for [`write`](write()).
pub fn write_ascii(mesh: &TriangleMesh, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    check(mesh)?;
    writeln!(out, "solid casteljau")?;
    for [n, a, b, c] in facets(mesh) {
        writeln!(out, "facet normal {:?} {:?} {:?}\nouter loop", n[0], n[1], n[2])?;
        for p in [a, b, c] {
            writeln!(out, "vertex {:?} {:?} {:?}", p[0], p[1], p[2])?;
        }
        writeln!(out, "endloop\nendfacet")?;
    }
    writeln!(out, "endsolid casteljau")?;
    Ok(())
}

/// Everything fits; returns the number of triangles.
fn check(mesh: &TriangleMesh) -> Result<u32, IoError> {
    mesh.validate()?;
    let refuse = |reason| IoError::invalid(Place::file(STREAM), reason);
    for (vertex, p) in mesh.positions.iter().enumerate() {
        if let Some(value) = p.to_array().into_iter().find(|&c| !(c as f32).is_finite()) {
            return Err(refuse(Reason::BeyondF32 { vertex, value }));
        }
    }
    u32::try_from(mesh.triangles.len()).map_err(|_| {
        refuse(Reason::TooManyTriangles { count: mesh.triangles.len(), limit: u32::MAX as usize })
    })
}

/// Normal and corners of each triangle of a mesh that has been checked.
fn facets(mesh: &TriangleMesh) -> impl Iterator<Item = [[f32; 3]; 4]> {
    (0..mesh.triangles.len()).filter_map(|index| mesh.corners(index)).map(|[a, b, c]| {
        // Scaled, so that neither the product of tiny sides vanishes nor that of huge ones overflows.
        let (ab, ac) = (b - a, c - a);
        let size = ab.abs().max(ac.abs()).max_element();
        let normal = (ab / size).cross(ac / size).try_normalize().unwrap_or(DVec3::ZERO);
        [normal, a, b, c].map(|v| v.to_array().map(|c| c as f32))
    })
}
