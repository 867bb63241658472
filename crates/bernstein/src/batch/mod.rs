//! Batch evaluation.

mod blocks;
mod coefficients;
mod curve;
mod grid;
mod grid_table;
mod horner;
mod nets;
mod normal;
mod parallel;
mod patch;
mod quotient;
mod rational;
mod simd;

use pulp::bytemuck::Pod;

pub use self::curve::CurveBatch;
pub use self::grid::GridBatch;
pub use self::patch::PatchBatch;
use crate::glam::{DVec2, DVec3, DVec4};
use crate::{BernsteinError, Point};

/// A control point that batches can be made of: `f64`, [`DVec2`], [`DVec3`] and [`DVec4`].
pub trait BatchPoint: Point + Pod + Send + Sync {
    /// Numbers a point.
    const DIMENSION: usize;
}

impl BatchPoint for f64 {
    const DIMENSION: usize = 1;
}

impl BatchPoint for DVec2 {
    const DIMENSION: usize = 2;
}

impl BatchPoint for DVec3 {
    const DIMENSION: usize = 3;
}

impl BatchPoint for DVec4 {
    const DIMENSION: usize = 4;
}

fn check_length(buffer: &'static str, needed: usize, given: usize) -> Result<(), BernsteinError> {
    if needed == given { Ok(()) } else { Err(BernsteinError::BufferLength { buffer, needed, given }) }
}
