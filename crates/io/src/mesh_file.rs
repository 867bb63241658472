use std::path::Path;

use casteljau_mesh::TriangleMesh;

use crate::{IoError, obj, off, ply, replace_file, stl};

/// The endings that [`write_mesh_file`] knows.
pub const MESH_ENDINGS: &str = "obj, off, ply, stl";

/// A mesh format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshFormat {
    /// [`obj`]: text, f64, normals.
    Obj,
    /// [`off`]: text, f64, normals.
    Off,
    /// [`ply`]: binary, f64, normals.
    Ply,
    /// [`stl`]: binary, f32 only, no shared vertices.
    Stl,
}

impl MeshFormat {
    /// The format that the ending of a path names, in either case of letters.
    ///
    /// ```
    /// use casteljau_io::{IoError, MeshFormat};
    /// assert_eq!(MeshFormat::of_path("a/B.PLY".as_ref())?, MeshFormat::Ply);
    /// let error = MeshFormat::of_path("b.step".as_ref()).unwrap_err();
    /// assert_eq!(error.to_string(), "b.step: the ending `step` is not known; known endings: obj, off, ply, stl");
    /// # Ok::<(), IoError>(())
    /// ```
    pub fn of_path(path: &Path) -> Result<Self, IoError> {
        let ending = ending(path);
        match ending.to_ascii_lowercase().as_str() {
            "obj" => Ok(Self::Obj),
            "off" => Ok(Self::Off),
            "ply" => Ok(Self::Ply),
            "stl" => Ok(Self::Stl),
            _ => {
                Err(IoError::Ending { file: path.display().to_string(), ending, known: MESH_ENDINGS.into() })
            }
        }
    }
}

/// Writes a mesh in the format that the path's ending names: the binary form of PLY and STL.
///
/// The file is written [whole or not at all](replace_file). Error: unknown ending, a mesh that does not
/// [hold together](TriangleMesh::validate), a number beyond f32 in STL, or what the system says; each names the path.
/// Cost: linear, and no copy of the mesh.
pub fn write_mesh_file(path: &Path, mesh: &TriangleMesh) -> Result<(), IoError> {
    let format = MeshFormat::of_path(path)?;
    replace_file(path, |out| match format {
        MeshFormat::Obj => obj::write(mesh, out),
        MeshFormat::Off => off::write(mesh, out),
        MeshFormat::Ply => ply::write(mesh, out),
        MeshFormat::Stl => stl::write(mesh, out),
    })
}

/// What stands after the last dot of the file's name, or nothing.
pub(crate) fn ending(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().into_owned()).unwrap_or_default()
}
