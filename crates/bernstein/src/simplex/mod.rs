//! Polynomials over triangles and tetrahedra, in barycentric coordinates.

mod index;
mod net;

pub use index::{MultiIndices, multi_indices, simplex_count, simplex_index, simplex_partial_index};
pub use net::{SimplexNet, TetrahedronNet, TriangleNet, last_barycentric};
