//! The same tetrahedron with other control points: permuted, elevated, reduced, cut; its faces, edges and sections.

use casteljau_bernstein::{BernsteinError, MAX_DEGREE, TETRAHEDRON_FACES, TetrahedronNet, simplex_count};
use casteljau_geom::Interval;
use casteljau_shape::control_net::{check_points, distance_bound};
use casteljau_shape::{BezierCurve, BezierTriangle, ControlPoint, Parameters};

use crate::tetrahedron::barycentric;
use crate::{BezierTetrahedron, SolidError};

impl<P: ControlPoint> BezierTetrahedron<P> {
    /// The face on which the barycentric coordinate `opposite` (0 to 3) vanishes, counter-clockwise seen from outside
    /// where the Jacobian is positive: its vertices are those of [`TETRAHEDRON_FACES`]. Control points to the bit.
    ///
    /// ```
    /// use casteljau_solid::{Tetrahedron, geom::glam::DVec3};
    /// let corner = Tetrahedron::new(1, [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO])?;
    /// assert_eq!(corner.face(2)?.normal(0.2, 0.2), Some(-DVec3::Z));
    /// # Ok::<(), casteljau_solid::SolidError>(())
    /// ```
    ///
    /// # Errors
    /// [`SolidError::Kernel`] for another number, [`ShapeError::NoWeight`](casteljau_shape::ShapeError::NoWeight) where
    /// all weights of the face are zero.
    pub fn face(&self, opposite: usize) -> Result<BezierTriangle<P>, SolidError> {
        let face = TETRAHEDRON_FACES.get(opposite);
        let face = face.ok_or(BernsteinError::Vertices { vertex: opposite, vertices: 4 })?;
        let mut points = vec![P::ZERO; simplex_count::<3>(self.degree())];
        self.net().face(*face, &mut points)?;
        Ok(BezierTriangle::from_net(self.degree(), points)?)
    }

    /// The edge from vertex a to vertex b over `[0, 1]`; control points to the bit.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] unless these are two of 0 to 3,
    /// [`ShapeError::NoWeight`](casteljau_shape::ShapeError::NoWeight) where all weights of the edge are zero.
    pub fn edge(&self, vertices: [usize; 2]) -> Result<BezierCurve<P>, SolidError> {
        let mut points = vec![P::ZERO; self.degree() + 1];
        self.net().face(vertices, &mut points)?;
        Ok(BezierCurve::from_net(Interval::UNIT, points)?)
    }

    /// The triangle over the plane section of the domain with the given corners, of degree n.
    ///
    /// With corners where one coordinate is c it is the iso-parametric triangle λₐ = c.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`](casteljau_shape::ShapeError::Parameter),
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate),
    /// [`ShapeError::NoWeight`](casteljau_shape::ShapeError::NoWeight).
    pub fn triangle_between(&self, corners: [[f64; 3]; 3]) -> Result<BezierTriangle<P>, SolidError> {
        let [a, b, c] = corners;
        let part = self.restricted_net([a, b, c, c])?;
        let mut points = vec![P::ZERO; simplex_count::<3>(self.degree())];
        TetrahedronNet::validated(&part, self.degree()).face([0, 1, 2], &mut points)?;
        Ok(BezierTriangle::from_net(self.degree(), points)?)
    }

    /// The curve over the straight line from one parameter point to another, of degree n over `[0, 1]`.
    ///
    /// # Errors
    /// Those of [`triangle_between`](Self::triangle_between).
    pub fn curve_between(&self, ends: [[f64; 3]; 2]) -> Result<BezierCurve<P>, SolidError> {
        let [a, b] = ends;
        let part = self.restricted_net([a, b, b, b])?;
        let mut points = vec![P::ZERO; self.degree() + 1];
        TetrahedronNet::validated(&part, self.degree()).face([0, 1], &mut points)?;
        Ok(BezierCurve::from_net(Interval::UNIT, points)?)
    }

    /// The same solid with its vertices in another order: vertex a of the new one is `vertices[a]` of this one. An odd
    /// permutation changes the sign of the Jacobian.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] unless these are 0 to 3 in some order.
    pub fn permuted(&self, vertices: [usize; 4]) -> Result<Self, SolidError> {
        let mut points = vec![P::ZERO; self.control_points().len()];
        self.net().face(vertices, &mut points)?;
        Ok(Self::checked(self.degree(), points))
    }

    /// The same solid as one of degree n + `by`.
    ///
    /// Error of each control point: at most 4(n+by+2)·u times its convex combination of absolute values; the vertices
    /// are kept to the bit.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] where the degree becomes larger than [`MAX_DEGREE`].
    pub fn elevated(&self, by: usize) -> Result<Self, SolidError> {
        let degree = self.degree().saturating_add(by);
        if degree > MAX_DEGREE {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE }.into());
        }
        let mut points = vec![P::ZERO; simplex_count::<4>(degree)];
        self.net().elevate(degree, &mut points)?;
        Ok(Self::checked(degree, points))
    }

    /// A near tetrahedron of a lower degree with the same vertices, and a bound on its distance from this one at equal
    /// parameters, in model units: the least squares of the control points.
    ///
    /// A tetrahedron that was elevated comes back as it was, up to rounding.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] where `degree` is above that of the solid,
    /// [`ShapeError::Unbounded`](casteljau_shape::ShapeError::Unbounded) for a rational one whose weights, or whose
    /// reduced weights, do not all have one sign.
    pub fn reduced(&self, degree: usize) -> Result<(Self, f64), SolidError> {
        let from = self.degree();
        if degree > from {
            return Err(BernsteinError::ReducedDegree { from, to: degree }.into());
        }
        let mut points = vec![P::ZERO; simplex_count::<4>(degree)];
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

    /// The four tetrahedra between a point and the faces: part a has the point in place of vertex a.
    ///
    /// They share their faces to the bit. A point on a face makes one of them degenerate.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`](casteljau_shape::ShapeError::Parameter),
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where a point far outside makes control
    /// points out of range.
    pub fn split_at(&self, at: [f64; 3]) -> Result<[Self; 4], SolidError> {
        Parameters::Solid(at).finite()?;
        let count = self.control_points().len();
        let mut points = vec![P::ZERO; 4 * count];
        self.net().split_at(barycentric(at), &mut points)?;
        check_points(&points)?;
        Ok([0, 1, 2, 3].map(|a| Self::checked(self.degree(), points[a * count..(a + 1) * count].to_vec())))
    }

    /// The two tetrahedra made by cutting the edge from vertex a to vertex b at its share t: the first has the new point
    /// in place of b, the second in place of a. They share the cut to the bit.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] unless a and b are two of 0 to 3, otherwise as for [`split_at`](Self::split_at).
    pub fn split_edge(&self, vertices: [usize; 2], t: f64) -> Result<(Self, Self), SolidError> {
        Parameters::Curve(t).finite()?;
        let mut near_a = vec![P::ZERO; self.control_points().len()];
        let mut near_b = near_a.clone();
        self.net().split_edge(vertices, t, &mut near_a, &mut near_b)?;
        check_points(&near_a)?;
        check_points(&near_b)?;
        Ok((Self::checked(self.degree(), near_a), Self::checked(self.degree(), near_b)))
    }

    /// The eight tetrahedra of equal volume in the domain, [`TETRAHEDRON_EIGHTHS`](casteljau_bernstein::TETRAHEDRON_EIGHTHS).
    ///
    /// # Errors
    /// None but those of the kernels, which a checked solid does not meet.
    pub fn split_uniform(&self) -> Result<[Self; 8], SolidError> {
        let count = self.control_points().len();
        let (mut points, mut scratch) = (vec![P::ZERO; 8 * count], vec![P::ZERO; 4 * count]);
        self.net().split_uniform(&mut points, &mut scratch)?;
        Ok(std::array::from_fn(|a| Self::checked(self.degree(), points[a * count..(a + 1) * count].to_vec())))
    }

    /// The part of the solid between four parameter points, inside or outside of it, as a solid of its own.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`](casteljau_shape::ShapeError::Parameter),
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) as for [`split_at`](Self::split_at).
    pub fn restricted(&self, corners: [[f64; 3]; 4]) -> Result<Self, SolidError> {
        Ok(Self::checked(self.degree(), self.restricted_net(corners)?))
    }

    fn restricted_net(&self, corners: [[f64; 3]; 4]) -> Result<Vec<P>, SolidError> {
        for corner in corners {
            Parameters::Solid(corner).finite()?;
        }
        let count = self.control_points().len();
        let (mut points, mut scratch) = (vec![P::ZERO; count], vec![P::ZERO; 4 * count]);
        self.net().restrict(corners.map(barycentric), &mut points, &mut scratch)?;
        check_points(&points)?;
        Ok(points)
    }
}
