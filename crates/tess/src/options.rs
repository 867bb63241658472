use std::ops::ControlFlow;

/// How dense a mesh is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Density {
    /// Chord tolerance: largest distance between the surface and its triangles, in model units.
    Tolerance(f64),
    /// Resolution: so many edges along each side, evenly spaced in the side's parameter; the interior follows.
    Resolution(usize),
}

/// What becomes of the vertices on a side that patches share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Seams {
    /// One vertex for all of them, its normal along the sum of theirs: a closed model gives a closed mesh.
    #[default]
    Merged,
    /// Every patch keeps its own, with its own normals, so that creases stay sharp. Positions are equal to the bit, and
    /// [`TriangleMesh::welded`](casteljau_mesh::TriangleMesh::welded) closes the mesh.
    Separate,
}

/// How to tessellate.
///
/// ```
/// use casteljau_tess::{Density, Seams, TessellationOptions};
/// let options = TessellationOptions { seams: Seams::Separate, ..TessellationOptions::tolerance(1e-3) };
/// assert_eq!(options.density, Density::Tolerance(1e-3));
/// assert!(options.normals);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TessellationOptions {
    /// Chord tolerance or resolution.
    pub density: Density,
    /// Most vertices of the mesh; beyond it is an error. [`DEFAULT_MAX_VERTICES`] by default.
    pub max_vertices: usize,
    /// What becomes of shared sides.
    pub seams: Seams,
    /// Whether vertices get normals; without them a mesh by resolution costs about half.
    pub normals: bool,
}

/// Default limit on vertices. Work takes about half a kilobyte a vertex.
pub const DEFAULT_MAX_VERTICES: usize = 5_000_000;

impl TessellationOptions {
    /// A mesh within a chord tolerance, in model units.
    pub fn tolerance(tolerance: f64) -> Self {
        Self::new(Density::Tolerance(tolerance))
    }

    /// A mesh with so many edges a side.
    pub fn resolution(resolution: usize) -> Self {
        Self::new(Density::Resolution(resolution))
    }

    /// The defaults at a density.
    pub fn new(density: Density) -> Self {
        Self { density, max_vertices: DEFAULT_MAX_VERTICES, seams: Seams::default(), normals: true }
    }
}

/// The progress callback for those who do not wait.
pub fn no_progress(_fraction: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
