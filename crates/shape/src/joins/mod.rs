//! How neighbouring curves and patches meet, measured; and neighbours that meet as wanted.

mod condition;
mod construction;
mod report;

pub use condition::CurvatureCondition;
pub use report::{Continuity, JoinReport, JoinTolerance, Maximum, SurfaceEdge};
