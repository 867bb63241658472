//! Domain polygons, their layout, triangulation and generalized barycentric coordinates.

pub use casteljau_geom::glam;

mod coordinates;
mod error;
pub mod layout;
mod polygon;
pub mod triangulation;

pub use coordinates::{CoordinateKind, Coordinates, HarmonicOptions};
pub use error::DomainError;
pub use polygon::{Location, Orientation, Polygon};
