//! What can be wrong with a solid, or with a question about it.

use casteljau_bernstein::BernsteinError;
use casteljau_shape::ShapeError;
use thiserror::Error;

/// Why a solid could not be made, or a question about it not be answered.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SolidError {
    /// What is wrong with control points, weights or parameters of every kind of shape.
    #[error(transparent)]
    Shape(#[from] ShapeError),

    /// A kernel refused.
    #[error(transparent)]
    Kernel(#[from] BernsteinError),
}
