//! Polynomials over triangles and tetrahedra, in barycentric coordinates.

mod basis;
mod bounds;
mod de_casteljau;
mod elevation;
mod face;
mod index;
mod integral;
mod net;
mod power;
mod product;
mod reduction;
mod restriction;
mod space;

pub use basis::{simplex_basis, simplex_basis_partials};
pub use face::{TETRAHEDRON_FACES, TRIANGLE_EDGES};
pub use index::{MultiIndices, multi_indices, simplex_count, simplex_index, simplex_partial_index};
pub use net::{SimplexNet, TetrahedronNet, TriangleNet, last_barycentric};
pub use power::{simplex_from_power, simplex_power_matrix, simplex_power_matrix_inverse};
pub use restriction::{TETRAHEDRON_EIGHTHS, TRIANGLE_QUARTERS};
pub use space::SimplexSpace;

// What wedges are made of.
pub(crate) use bounds::{extremes, halves_across, steepest_edge};
pub(crate) use de_casteljau::{directional, raised, step};
pub(crate) use elevation::{check_elevation, elevate_step};
pub(crate) use face::face_indices;
pub(crate) use index::{step_back, vertex_place};
pub(crate) use integral::{Compensated, measure, moment_weight};
pub(crate) use net::{differentiate, partial, value};
pub(crate) use product::{product_degree, shares};
pub(crate) use restriction::{check_vertices, replace_vertex};
