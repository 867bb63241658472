//! How neighbouring curves and patches meet, measured; and neighbours that meet as wanted.

mod condition;
mod construction;
mod positive;
mod report;

pub use condition::CurvatureCondition;
pub use report::{Continuity, CrossRatio, JoinReport, JoinTolerance, Maximum, SurfaceEdge};
