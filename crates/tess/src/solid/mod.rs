//! Solids → their surface, cells that fill them, and the surfaces on which a field has one value.

mod bends;
mod complex;
mod face_key;
mod lattice;
mod net;
mod skin;
#[allow(clippy::module_inception)]
mod solid;
mod volume;

pub use skin::{SharedFaces, Skin, SkinFace, tessellate_solids};
pub use solid::{AsSolid, FaceId, Solid};
pub use volume::{CellKind, VolumeOptions, VolumeReport, volume_mesh};
