//! Pictures of shapes and domains, as SVG.
//!
//! - [`domain_picture`]: a GB patch's domain polygon, its numbered corners, isolines of one barycentric coordinate and
//!   the triangulation they were found on.
//! - [`patch_picture`]: GB patches in an orthographic [`View`]: shaded or coloured by curvature, with isolines, side
//!   curves and control nets, what lies behind hidden by what lies in front.
//! - [`curve_picture`]: curves with control polygons, curvature combs, Frenet frames, and de Casteljau's construction.
//! - [`surface_picture`]: tensor-product patches and triangles in the same look, with de Casteljau's construction.
//! - [`solid_picture`]: hexahedra, tetrahedra and wedges by their faces, in the same look.
//!
//! Coordinates in the files are pixels with two decimals, always finite; the same input gives the same bytes.
//!
//! ```
//! use casteljau_gb::{ConcavePatch, CoordinateKind, Ribbon, glam::DVec3};
//! use casteljau_plot::{DomainStyle, PatchStyle, domain_picture, patch_picture};
//! let corners = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.3), DVec3::Y];
//! let ribbon = |i: usize| Ribbon::new(1, 1, vec![corners[(i + 3) % 4], corners[i]]);
//! let ribbons = (0..4).map(ribbon).collect::<Result<Vec<_>, _>>()?;
//! let patch = ConcavePatch::builder(ribbons).coordinates(CoordinateKind::MeanValue).build()?;
//! assert!(domain_picture(patch.coordinates(), &DomainStyle::default())?.starts_with("<svg"));
//! assert!(patch_picture(&[patch], &PatchStyle::default())?.ends_with("</svg>\n"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod canvas;
mod color;
mod construction;
mod contour;
mod curve_picture;
mod decoration;
mod domain_picture;
mod error;
mod patch_picture;
mod sampling;
mod scene;
mod shade;
mod shapes;
mod solid_picture;
mod surface_picture;
mod view;

pub use curve_picture::{CurveStyle, curve_picture};
pub use domain_picture::{DomainStyle, domain_picture};
pub use error::PlotError;
pub use patch_picture::{Isolines, PatchStyle, Shading, patch_picture};
pub use shapes::{CurveShape, SurfaceShape};
pub use solid_picture::{SolidShape, solid_picture};
pub use surface_picture::{SurfaceStyle, surface_picture};
pub use view::View;

/// Least and largest width of a picture, in pixels.
pub const WIDTHS: [usize; 2] = [100, 10_000];
/// Most isolines of a family.
pub const MOST_LEVELS: usize = 200;
/// Most triangles.
pub const MOST_TRIANGLES: usize = 200_000;
