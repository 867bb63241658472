/// An error of any crate of the kernel.
///
/// ```
/// let error: casteljau::Error = casteljau::shape::Curve::new(vec![]).unwrap_err().into();
/// assert!(matches!(error, casteljau::Error::Shape(_)));
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Bernstein kernels.
    #[error(transparent)]
    Bernstein(#[from] casteljau_bernstein::BernsteinError),
    /// Jets and intervals.
    #[error(transparent)]
    Geom(#[from] casteljau_geom::GeomError),
    /// Meshes.
    #[error(transparent)]
    Mesh(#[from] casteljau_mesh::MeshError),
    /// Curves, patches and triangles.
    #[error(transparent)]
    Shape(#[from] casteljau_shape::ShapeError),
    /// Solids.
    #[error(transparent)]
    Solid(#[from] casteljau_solid::SolidError),
    /// Polygons, layouts, coordinates.
    #[error(transparent)]
    Domain(#[from] casteljau_domain::DomainError),
    /// Generalized Bézier patches.
    #[error(transparent)]
    Gb(#[from] casteljau_gb::GbError),
    /// Tessellation.
    #[error(transparent)]
    Tess(#[from] casteljau_tess::TessError),
    /// Files.
    #[error(transparent)]
    Io(#[from] casteljau_io::IoError),
    /// Pictures.
    #[error(transparent)]
    Plot(#[from] casteljau_plot::PlotError),
}
