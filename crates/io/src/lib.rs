//! Model and mesh files.
//!
//! | format | module | reads | writes |
//! | --- | --- | --- | --- |
//! | model file, `.json` | [`model`] | yes | yes |
//! | concave GB patch, `.cgb` | [`cgb`] | yes | yes |
//! | Bézier cells of VTK, `.vtu` | [`vtu`] | yes | yes |
//! | OBJ, OFF, PLY, STL meshes | [`obj`], [`off`], [`ply`], [`stl`] | no | yes |
//!
//! [`read_model_file`] and [`write_mesh_file`] choose by the ending of the path. Text has its numbers in the shortest
//! form that reads back to the same bits. A file is written beside its target and renamed, so that nobody ever sees
//! half of one. Every [`IoError`] names the file, and the line or the path inside it where there is one; its
//! `Display` is `FILE:LINE: what and why`.
//!
//! Memory: nothing is allocated because a file promises it, only because it is there.

pub mod cgb;
mod construction_record;
mod error;
mod geometry;
mod mesh_file;
pub mod model;
mod model_file;
mod net_record;
pub mod obj;
pub mod off;
mod patch;
mod place;
pub mod ply;
mod reason;
mod record;
mod replace;
mod shape_record;
mod solid_record;
pub mod stl;
pub mod vtu;
pub mod vtu_mesh;

pub use construction_record::{Part, RotationalRecord, TransitionalRecord, TwistedRecord};
pub use error::IoError;
pub use geometry::Geometry;
pub use mesh_file::{MESH_ENDINGS, MeshFormat, write_mesh_file};
pub use model_file::{
    MAX_FILE_BYTES, MODEL_ENDINGS, ModelFormat, read_model_bytes, read_model_file, write_model,
    write_model_file,
};
pub use net_record::NetRecord;
pub use place::{Place, Step};
pub use reason::Reason;
pub use record::{
    CenterWeightName, CoordinatesName, CornerPointRecord, GbPatchRecord, LayoutRecord, RibbonRecord,
};
pub use replace::replace_file;
pub use shape_record::{CurveRecord, PatchRecord, PowerCurveRecord, PowerPatchRecord, TriangleRecord};
pub use solid_record::{HexahedronRecord, TetrahedronRecord, WedgeRecord};
