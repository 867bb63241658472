//! Solids → their surface, cells that fill them, and the surfaces on which a field has one value.

mod face_key;
mod skin;
#[allow(clippy::module_inception)]
mod solid;

pub use skin::{SharedFaces, Skin, SkinFace, tessellate_solids};
pub use solid::{AsSolid, FaceId, Solid};
