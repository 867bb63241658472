//! Barycentric coordinates in a tetrahedron of parameter space.

use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::{DMat3, DVec3};

use crate::SolidError;

/// A tetrahedron of parameter points with the vertices V₁ … V₄, over which a Bézier tetrahedron may be laid.
///
/// ```
/// use casteljau_solid::{DomainTetrahedron, geom::glam::DVec3};
/// let domain = DomainTetrahedron::new([2.0 * DVec3::X, 2.0 * DVec3::Y, 2.0 * DVec3::Z, DVec3::ZERO])?;
/// assert_eq!(domain.barycentric(DVec3::new(1.0, 0.5, 0.0)), [0.5, 0.25, 0.0]);
/// assert_eq!(domain.at([0.5, 0.25, 0.0]), DVec3::new(1.0, 0.5, 0.0));
/// # Ok::<(), casteljau_solid::SolidError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DomainTetrahedron {
    vertices: [DVec3; 4],
    to_barycentric: DMat3,
}

impl DomainTetrahedron {
    /// The tetrahedron with the given vertices.
    ///
    /// # Errors
    /// [`SolidError::Construction`] where it has no volume within the rounding of its vertices.
    pub fn new(vertices: [DVec3; 4]) -> Result<Self, SolidError> {
        let [a, b, c, d] = vertices;
        let edges = DMat3::from_cols(a - d, b - d, c - d);
        let volume = edges.determinant();
        // Subtractions and a determinant of products of edges: 16 roundings of their size.
        let size = [a, b, c, d].into_iter().map(DVec3::length).fold(0.0, f64::max);
        let edges_size = [a - d, b - d, c - d].into_iter().map(DVec3::length).fold(0.0, f64::max);
        let rounding = 16.0 * UNIT_ROUNDOFF * size * edges_size * edges_size;
        let to_barycentric = edges.inverse();
        if !volume.is_finite() || volume.abs() <= rounding || !to_barycentric.is_finite() {
            return Err(SolidError::Construction { what: "volume of the domain tetrahedron", value: volume });
        }
        Ok(Self { vertices, to_barycentric })
    }

    /// The vertices.
    #[must_use]
    pub fn vertices(&self) -> [DVec3; 4] {
        self.vertices
    }

    /// The first three barycentric coordinates of a parameter point: the parameters of a Bézier tetrahedron.
    #[must_use]
    pub fn barycentric(&self, p: DVec3) -> [f64; 3] {
        (self.to_barycentric * (p - self.vertices[3])).to_array()
    }

    /// The parameter point with the given first three barycentric coordinates.
    #[must_use]
    pub fn at(&self, lambda: [f64; 3]) -> DVec3 {
        let [a, b, c, d] = self.vertices;
        d + (a - d) * lambda[0] + (b - d) * lambda[1] + (c - d) * lambda[2]
    }

    /// From derivatives with respect to the barycentric coordinates to those with respect to the parameter point: the
    /// columns of the matrix are ∂/∂x, ∂/∂y, ∂/∂z.
    #[must_use]
    pub fn gradient(&self, by_barycentric: DMat3) -> DMat3 {
        by_barycentric * self.to_barycentric
    }
}
