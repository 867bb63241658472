//! Solids → their surface, cells that fill them, and the surfaces on which a field has one value.

mod bends;
mod complex;
mod face_key;
mod field;
mod lattice;
mod march;
mod net;
mod quotient;
mod section;
mod section_error;
mod skin;
#[allow(clippy::module_inception)]
mod solid;
mod unfold;
mod volume;

pub use field::SolidField;
pub use section::{SectionOptions, SectionReport, iso_surface, slice};
pub use skin::{SharedFaces, Skin, SkinFace, tessellate_solids};
pub use solid::{AsSolid, FaceId, Solid};
pub use volume::{CellKind, VolumeOptions, VolumeReport, volume_mesh};
