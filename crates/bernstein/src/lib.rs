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
//! ```
//! use casteljau_bernstein::{basis, value};
//! let mut b = [0.0; 4];
//! basis(0.5, &mut b);
//! assert_eq!(b, [0.125, 0.375, 0.375, 0.125]);
//! assert_eq!(value(&[0.0, 0.0, 4.0], 0.5), 1.0);
//! ```

pub use glam;

mod basis;
mod binomial;
mod blossom;
mod bounds;
mod box_net;
mod compose;
mod elevation;
mod error;
mod integral;
mod interval;
mod line;
mod matrix;
mod point;
mod power;
mod product;
mod reduction;
mod restriction;
mod roots;
mod scheme;
mod simplex;
mod space;
mod subdivision;
mod tensor;
mod wedge;

pub use basis::{basis, basis_barycentric, basis_derivatives};
pub use binomial::{MAX_DEGREE, binomial};
pub use blossom::{blossom, blossom_tensor};
pub use bounds::{Extremes, extremes, hull_bounds};
pub use box_net::{BoxNet, box_partial_count, box_partial_index};
pub use compose::{compose, compose_homogeneous, compose_simplex, last_coordinate};
pub use elevation::{elevate, elevate_along, elevate_tensor};
pub use error::BernsteinError;
pub use integral::{
    antiderivative, antiderivative_along, integral, integral_over, integral_over_tensor, moment,
    moment_tensor,
};
pub use interval::{de_casteljau, de_casteljau_scheme, derivative, derivatives, value};
pub use matrix::{elevation_matrix, inverse_power_matrix, power_matrix, restriction_matrix};
pub use point::Point;
pub use power::{from_power, from_power_tensor, to_power, to_power_tensor};
pub use product::{product, product_tensor, sum, sum_tensor};
pub use reduction::{reduce, reduce_along};
pub use restriction::{restrict, restrict_along, restrict_tensor};
pub use roots::{Root, RootKind, roots};
pub use scheme::{scheme_count, tensor_scheme_count};
pub use simplex::{
    MultiIndices, SimplexNet, TetrahedronNet, TriangleNet, last_barycentric, multi_indices, simplex_basis,
    simplex_basis_partials, simplex_count, simplex_index, simplex_partial_index,
};
pub use space::BernsteinSpace;
pub use subdivision::{subdivide, subdivide_along};
pub use tensor::{TensorNet, partial_count, partial_index};
pub use wedge::WedgeNet;
