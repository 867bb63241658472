//! Bernstein kernels over slices of control points.
//!
//! A polynomial of degree n is held by its control points, `p(t) = Σ Bᵢⁿ(t) Pᵢ` with
//! `Bᵢⁿ(t) = C(n,i) tⁱ (1−t)ⁿ⁻ⁱ`. Every kernel is generic in the kind of [`Point`] (numbers, or glam's vectors;
//! rational shapes use `DVec4`) and writes into buffers that the caller owns. Kernels allocate nothing, but for
//! those that say so: composition, extremes, roots, matrices, and products from degree 32 on.
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
//!
//! # Where to find what
//!
//! Functions for the interval have plain names; the same for a net along one axis ends in `_along`, for a net as
//! a whole in `_tensor`, and takes its degrees: `[m, n]` for a net in the order of [`TensorNet`], `[l, m, n]` for
//! one in the order of [`BoxNet`]. Over triangles and tetrahedra kernels are methods of [`SimplexNet`], over wedges of
//! [`WedgeNet`].
//!
//! | task | functions |
//! | --- | --- |
//! | basis functions and their derivatives | [`basis`], [`basis_derivatives`], [`basis_barycentric`] |
//! | values and derivatives | [`value`], [`derivatives`], [`TensorNet`], [`BoxNet`], [`SimplexNet`], [`WedgeNet`] |
//! | de Casteljau's schemes, blossoms | [`de_casteljau_scheme`], [`TensorNet::scheme`], [`blossom`], [`blossom_tensor`] |
//! | change of degree | [`elevate`], [`elevate_along`], [`elevate_tensor`], [`reduce`], [`reduce_along`] |
//! | parts of the domain | [`subdivide`], [`subdivide_along`], [`restrict`], [`restrict_along`], [`restrict_tensor`] |
//! | arithmetic | [`sum`], [`product`], [`sum_tensor`], [`product_tensor`] |
//! | composition | [`compose`], [`compose_homogeneous`], [`compose_simplex`], [`compose_wedge`], [`compose_wedge_homogeneous`], [`BernsteinSpace`] |
//! | power basis | [`from_power`], [`to_power`], [`power_matrix`], [`inverse_power_matrix`] |
//! | integrals | [`integral`], [`integral_over`], [`moment`], [`antiderivative`] |
//! | triangles and tetrahedra | [`SimplexNet`]: all of this as methods; [`simplex_basis`], [`simplex_basis_partials`], [`simplex_index`], [`multi_indices`], [`last_barycentric`], [`simplex_from_power`], [`simplex_power_matrix`], [`SimplexSpace`] |
//! | wedges | [`WedgeNet`], [`wedge_from_power`], [`WedgeSpace`] |
//! | bounds and roots | [`hull_bounds`], [`extremes`], [`roots`] |
//!
//! # Accuracy and range
//!
//! With u = 2⁻⁵³, values and derivatives are within `4(n + 2k + 2)·u·scale` of the exact ones, k being the order
//! of derivative and *scale* the sum of the absolute values of everything that is added up. That holds for
//! parameters outside `[0, 1]` too: the polynomial is continued, never clamped. Each kernel states its bound
//! and its scale.
//!
//! Degrees go up to [`MAX_DEGREE`]. Kernels that check their buffers refuse higher ones; from those that do not, a
//! longer slice gives NaN where binomial coefficients overflow: refuse such degrees where a shape is
//! constructed.
//!
//! # Which way of evaluating
//!
//! Three ways lead to `p(t)`, and all keep the bound above where they apply.
//!
//! * *Nested multiplication* ([`value`], [`derivatives`], the nets): Horner's rule with the factors `C(n,i) tⁱ`.
//!   Linear time, no division, no scratch, any parameter and any weights: what everything here evaluates with. The
//!   binomial coefficients are why the degree is limited.
//! * *De Casteljau's algorithm* ([`de_casteljau`]): quadratic time, affine combinations only, any parameter, any
//!   degree. The reference that the others are tested with, and the way to go when the scheme is wanted: it holds
//!   the two halves of the curve ([`subdivide`]) and, with other parameters at other levels, blossoms and
//!   restrictions. It takes 3n(n+1)/2 operations a component, nested multiplication 3n.
//! * *The linear-time method of Woźny and Chudy* (CAGD 80, 2020): convex combinations with
//!   `hₖ = 1/(1 + k (1−t) wₖ₋₁ / ((n+1−k) t wₖ hₖ₋₁))`, one division a point, without binomial coefficients. The
//!   factors depend on t alone when all weights are 1, so batches inside `[0, 1]` share them. Outside `[0, 1]` and
//!   at interior zero weights the divisor may vanish, unless rational shapes are held homogeneously, as they are
//!   here. No kernel for single parameters uses it: it does not serve every parameter, and saves nothing where a
//!   table has the binomial coefficients.

pub use glam;

mod basis;
pub mod batch;
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
pub use batch::{
    BatchPoint, BoxBatch, BoxGridBatch, CurveBatch, GridBatch, PatchBatch, TetrahedronBatch, TriangleBatch,
    WedgeBatch, elevate_many, subdivide_many, to_power_many,
};
pub use binomial::{MAX_DEGREE, binomial};
pub use blossom::{blossom, blossom_tensor};
pub use bounds::{Extremes, extremes, hull_bounds};
pub use box_net::{BoxNet, box_partial_count, box_partial_index};
pub use compose::{
    compose, compose_homogeneous, compose_simplex, compose_wedge, compose_wedge_homogeneous, last_coordinate,
};
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
    MultiIndices, SimplexNet, SimplexSpace, TETRAHEDRON_EIGHTHS, TETRAHEDRON_FACES, TRIANGLE_EDGES,
    TRIANGLE_QUARTERS, TetrahedronNet, TriangleNet, last_barycentric, multi_indices, simplex_basis,
    simplex_basis_partials, simplex_count, simplex_from_power, simplex_index, simplex_partial_index,
    simplex_power_matrix, simplex_power_matrix_inverse,
};
pub use space::BernsteinSpace;
pub use subdivision::{subdivide, subdivide_along};
pub use tensor::{TensorNet, partial_count, partial_index};
pub use wedge::{WedgeNet, WedgeSpace, wedge_from_power};
