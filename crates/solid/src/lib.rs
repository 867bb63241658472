//! Bézier solids, polynomial and rational: tetrahedra, hexahedra and wedges.

pub use casteljau_bernstein as bernstein;
pub use casteljau_geom as geom;
pub use casteljau_shape as shape;

mod error;

pub use error::SolidError;
