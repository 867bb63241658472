//! Bernstein kernels over slices of control points.
//!
//! A polynomial of degree n is held by its control points, `p(t) = Σ Bᵢⁿ(t) Pᵢ` with
//! `Bᵢⁿ(t) = C(n,i) tⁱ (1−t)ⁿ⁻ⁱ`. Every kernel is generic in the kind of [`Point`] (numbers, or glam's vectors;
//! rational shapes use `DVec4`), writes into buffers that the caller owns, and allocates nothing.
//!
//! **Accuracy.** With u = 2⁻⁵³, values and derivatives are within `4(n + 2k + 2)·u·scale` of the exact ones,
//! k being the order of derivative and *scale* the sum of the absolute values of everything that is added up.
//! That holds for parameters outside `[0, 1]` too: the polynomial is continued, never clamped.
//!
//! **Range.** Degrees up to [`MAX_DEGREE`]. A longer slice gives NaN from the kernels that multiply by binomial
//! coefficients, because these overflow; refuse such degrees where a shape is constructed.
//!
//! **Batches.** Thousands of parameters or nets at once go through [`batch`], with vector instructions and on all cores.
//!
//! ```
//! use casteljau_bernstein::{basis, value};
//! let mut b = [0.0; 4];
//! basis(0.5, &mut b);
//! assert_eq!(b, [0.125, 0.375, 0.375, 0.125]);
//! assert_eq!(value(&[0.0, 0.0, 4.0], 0.5), 1.0);
//! ```

pub use glam;

mod basis;
pub mod batch;
mod binomial;
mod elevation;
mod error;
mod interval;
mod point;
mod subdivision;
mod tensor;

pub use basis::{basis, basis_barycentric, basis_derivatives};
pub use batch::{BatchPoint, CurveBatch, GridBatch, PatchBatch, elevate_many, subdivide_many, to_power_many};
pub use binomial::{MAX_DEGREE, binomial};
pub use elevation::elevate;
pub use error::BernsteinError;
pub use interval::{de_casteljau, de_casteljau_scheme, derivative, derivatives, value};
pub use point::Point;
pub use subdivision::subdivide;
pub use tensor::{TensorNet, partial_count, partial_index};
