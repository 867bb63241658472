//! The same triangle with other control points: permuted, elevated, cut; and its boundary curves.

use casteljau_bernstein::{BernsteinError, MAX_DEGREE, TRIANGLE_EDGES, last_barycentric, simplex_count};
use casteljau_geom::Interval;

use crate::control_point::distance_bound;
use crate::error::check_points;
use crate::{BezierCurve, BezierTriangle, ControlPoint, Parameters, ShapeError};

impl<P: ControlPoint> BezierTriangle<P> {
    /// The boundary curve on which the barycentric coordinate `opposite` (0, 1 or 2) vanishes, from the next vertex
    /// to the one after it, over `[0, 1]`; its control points are those of the net to the bit.
    ///
    /// ```
    /// use casteljau_shape::{Triangle, geom::glam::DVec3};
    /// let flat = Triangle::new(1, [DVec3::X, DVec3::Y, DVec3::ZERO])?;
    /// assert_eq!(flat.edge(2)?.control_points(), [DVec3::X, DVec3::Y]);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Kernel`] for another number.
    pub fn edge(&self, opposite: usize) -> Result<BezierCurve<P>, ShapeError> {
        let edge = TRIANGLE_EDGES.get(opposite);
        let edge = edge.ok_or(BernsteinError::Vertices { vertex: opposite, vertices: 3 })?;
        let mut points = vec![P::ZERO; self.degree() + 1];
        self.net().face(*edge, &mut points)?;
        Ok(BezierCurve::checked(Interval::UNIT, points))
    }

    /// The same triangle with its vertices in another order: vertex a of the new one is `vertices[a]` of this one.
    /// An odd permutation turns the normal around.
    ///
    /// # Errors
    /// [`ShapeError::Kernel`] unless these are 0, 1 and 2 in some order.
    pub fn permuted(&self, vertices: [usize; 3]) -> Result<Self, ShapeError> {
        let mut points = vec![P::ZERO; self.control_points().len()];
        self.net().face(vertices, &mut points)?;
        Ok(Self::checked(self.degree(), points))
    }

    /// The same triangle as one of degree n + `by`.
    ///
    /// Error of each control point: at most 4(n+by+2)·u times its convex combination of absolute values; the
    /// vertices are kept to the bit.
    ///
    /// # Errors
    /// [`ShapeError::Kernel`] where the degree becomes larger than [`MAX_DEGREE`].
    pub fn elevated(&self, by: usize) -> Result<Self, ShapeError> {
        let degree = self.degree().saturating_add(by);
        if degree > MAX_DEGREE {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE }.into());
        }
        let mut points = vec![P::ZERO; simplex_count::<3>(degree)];
        self.net().elevate(degree, &mut points)?;
        Ok(Self::checked(degree, points))
    }

    /// A near triangle of a lower degree with the same vertices, and a bound on its distance from this one at equal
    /// parameters, in model units: the least squares of the control points.
    ///
    /// A triangle that was elevated comes back as it was, up to rounding.
    ///
    /// # Errors
    /// [`ShapeError::Kernel`] where `degree` is above that of the triangle, [`ShapeError::Unbounded`] for a rational
    /// one whose weights, or whose reduced weights, do not all have one sign.
    pub fn reduced(&self, degree: usize) -> Result<(Self, f64), ShapeError> {
        let from = self.degree();
        if degree > from {
            return Err(BernsteinError::ReducedDegree { from, to: degree }.into());
        }
        let mut points = vec![P::ZERO; simplex_count::<3>(degree)];
        let mut scratch = vec![P::ZERO; 4 * self.control_points().len()];
        let deviation = self.net().reduce(degree, &mut points, &mut scratch)?;
        let reduced = Self::checked(degree, points);
        if !P::RATIONAL {
            return Ok((reduced, deviation));
        }
        let raised = reduced.elevated(from - degree)?;
        let error = distance_bound(self.control_points(), raised.control_points(), from)?;
        Ok((reduced, error))
    }

    /// The three triangles between a point and the edges: part a has the point (λ₁, λ₂) in place of vertex a.
    ///
    /// They share their edges to the bit. A point on an edge makes one of them degenerate.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Coordinate`] where a point far
    /// outside makes control points out of range.
    pub fn split_at(&self, lambda1: f64, lambda2: f64) -> Result<[Self; 3], ShapeError> {
        Parameters::Surface([lambda1, lambda2]).finite()?;
        let count = self.control_points().len();
        let mut points = vec![P::ZERO; 3 * count];
        self.net().split_at([lambda1, lambda2, last_barycentric(&[lambda1, lambda2])], &mut points)?;
        check_points(&points)?;
        Ok([0, 1, 2].map(|a| Self::checked(self.degree(), points[a * count..(a + 1) * count].to_vec())))
    }

    /// The two triangles made by cutting the edge from vertex a to vertex b at its share t: the first has the new
    /// point in place of b, the second in place of a.
    ///
    /// # Errors
    /// [`ShapeError::Kernel`] unless a and b are two of 0, 1 and 2; [`ShapeError::Parameter`],
    /// [`ShapeError::Coordinate`] as for [`split_at`](Self::split_at).
    pub fn split_edge(&self, vertices: [usize; 2], t: f64) -> Result<(Self, Self), ShapeError> {
        Parameters::Curve(t).finite()?;
        let mut near_a = vec![P::ZERO; self.control_points().len()];
        let mut near_b = near_a.clone();
        self.net().split_edge(vertices, t, &mut near_a, &mut near_b)?;
        check_points(&near_a)?;
        check_points(&near_b)?;
        Ok((Self::checked(self.degree(), near_a), Self::checked(self.degree(), near_b)))
    }

    /// The part of the triangle between three points (λ₁, λ₂), inside or outside of it, as a triangle of its own.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`], [`ShapeError::Coordinate`] as for [`split_at`](Self::split_at).
    pub fn restricted(&self, corners: [[f64; 2]; 3]) -> Result<Self, ShapeError> {
        for corner in corners {
            Parameters::Surface(corner).finite()?;
        }
        let count = self.control_points().len();
        let (mut points, mut scratch) = (vec![P::ZERO; count], vec![P::ZERO; 3 * count]);
        let corners = corners.map(|[u, v]| [u, v, last_barycentric(&[u, v])]);
        self.net().restrict(corners, &mut points, &mut scratch)?;
        check_points(&points)?;
        Ok(Self::checked(self.degree(), points))
    }
}
