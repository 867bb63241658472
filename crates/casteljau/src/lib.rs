//! Casteljau: a geometry kernel for Bézier shapes, in one dependency.
//!
//! Each crate of the kernel is a module here. Data flows one way: model file ([`io`]) → control nets → shape ([`shape`],
//! [`solid`], [`gb`] over a [`domain`]) → jets ([`geom`], computed by [`bernstein`]) → mesh ([`tess`], [`mesh`]), report or picture
//! ([`plot`]).
//!
//! ```
//! use casteljau::prelude::*;
//! // A triangle of straight sides, bent up at one corner.
//! let corners = [DVec3::ZERO, DVec3::X, DVec3::new(0.0, 1.0, 0.2)];
//! let ribbon = |i: usize| Ribbon::new(1, 1, vec![corners[(i + 2) % 3], corners[i]]);
//! let ribbons = (0..3).map(ribbon).collect::<Result<Vec<_>, _>>()?;
//! let patch = ConcavePatch::builder(ribbons).coordinates(CoordinateKind::MeanValue).build()?;
//! assert_eq!(patch.point(patch.domain().vertex(2))?, corners[2]);
//! # Ok::<(), casteljau::Error>(())
//! ```

pub use casteljau_bernstein as bernstein;
pub use casteljau_domain as domain;
pub use casteljau_gb as gb;
pub use casteljau_geom as geom;
pub use casteljau_geom::glam;
pub use casteljau_io as io;
pub use casteljau_mesh as mesh;
pub use casteljau_plot as plot;
pub use casteljau_shape as shape;
pub use casteljau_solid as solid;
pub use casteljau_tess as tess;

mod error;
pub mod prelude;

pub use error::Error;
