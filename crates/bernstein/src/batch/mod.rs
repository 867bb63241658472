//! Many evaluations at once, into buffers that the caller owns.
//!
//! | what | where |
//! | --- | --- |
//! | one curve at many parameters | [`CurveBatch`] |
//! | patches, one or thousands, on a grid of parameters | [`GridBatch`] |
//! | one patch at many parameters without order | [`PatchBatch`] |
//! | one triangle at many parameters without order | [`TriangleBatch`] |
//! | tensor-product solids, one or many, on a grid of parameters | [`BoxGridBatch`] |
//! | one solid at many parameters without order | [`BoxBatch`], [`TetrahedronBatch`], [`WedgeBatch`] |
//! | many curves or nets cut, raised in degree, taken to the power basis | [`subdivide_many`], [`elevate_many`], [`to_power_many`] |
//!
//! **Layout.** Points are arrays of structures, `&mut [DVec3]` and the like, as callers hold them. Values and
//! each kind of derivatives have a buffer of their own, in the order 1, d, d² and 1; ∂u, ∂v; ∂uu, ∂uv, ∂vv, of
//! solids 1; ∂u, ∂v, ∂w: `evaluate` takes as many buffers as are wanted. Use the buffers again: writing into fresh memory costs ten
//! times the arithmetic.
//!
//! **Instructions.** The widest registers are chosen at run time: AVX-512, AVX2 with FMA, or none. All of
//! them do the same fused multiply-adds in the same order (without FMA by `f64::mul_add`, which is then
//! slow), so the bits are the same on every processor. A point's result depends on its parameters alone, not
//! on its place, on the length of the batch or the number of threads. With the feature `rayon` (default),
//! batches of more than 8192 points are spread over rayon's threads; install a pool of one thread where that
//! is not wanted.
//!
//! **Methods.** Chosen by what they cost a degree: the basis takes three multiplications, and one
//! multiply-add a component; nested multiplication and the linear-time scheme of Woźny and Chudy take two
//! operations a component and more; Horner's scheme in the quotient t/(1−t), or its inverse, takes one
//! multiply-add a component, and one division in all.
//! - Curves take Horner's scheme in t/(1−t), but in (1−t)/t near t = 1: where the power of the quotient would
//!   leave the range of numbers (up to degree 9 the last number below 1 alone, 2⁻¹⁸ about 1 at degree 25),
//!   and above degree 238 for all t > ½. Each parameter is decided on its own.
//! - Grids contract the net to one curve a row and evaluate it so, the quotients being made once for each
//!   column; polynomial curves in space of degree 3 by the basis, which has its place in the first cache. Those
//!   of solids contract twice, a layer first.
//! - Scattered points take the scheme in both parameters up to a total degree of 9, and the basis up to
//!   degree 31 in each; the basis, too, where u or v is 1 exactly. Above degree 31 they go one by one through
//!   [`TensorNet::partials`](crate::TensorNet::partials).
//! - Triangles take the powers of the barycentric coordinates up to degree 40, above go one by one through
//!   [`TriangleNet::partials`](crate::SimplexNet::partials).
//! - Solids take the scheme in three quotients up to a total degree of 60, but the powers of all coordinates
//!   where a quotient is so large that its powers might leave the range of numbers: up to degree 9 next to
//!   u = 1, v = 1, w = 1 of a box, λ₃ = 0 of a wedge and λ₄ = 0 of a tetrahedron alone. Such places are
//!   summed a second time: turn a simplex so that its last face is not the one looked at. Degrees above go one
//!   by one.
//!
//! **Limits.** Any finite parameter, degrees up to [`MAX_DEGREE`](crate::MAX_DEGREE), coordinates up to
//! 10¹⁵⁰. The error is the crate's, `4(n + 2k + 2)·u·scale`, for parameters outside `[0, 1]` too.

mod blocks;
mod box_grid;
mod box_grid_kernel;
mod coefficients;
mod curve;
mod grid;
mod grid_kernel;
mod grid_row;
mod grid_table;
mod horner;
mod many;
mod nets;
mod normal;
mod parallel;
mod patch;
mod patch_kernel;
mod quotient;
mod rational;
mod scattered;
mod simd;
mod solid;
mod solid_box;
mod solid_kernel;
mod solid_tetrahedron;
mod solid_wedge;
#[cfg(test)]
mod tests;
mod triangle;

use pulp::bytemuck::Pod;

pub use self::box_grid::BoxGridBatch;
pub use self::curve::CurveBatch;
pub use self::grid::GridBatch;
pub use self::many::{elevate_many, subdivide_many, to_power_many};
pub use self::patch::PatchBatch;
pub use self::solid_box::BoxBatch;
pub use self::solid_tetrahedron::TetrahedronBatch;
pub use self::solid_wedge::WedgeBatch;
pub use self::triangle::TriangleBatch;
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
