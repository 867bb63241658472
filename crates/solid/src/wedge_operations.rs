//! The same wedge with other control points: turned, elevated, reduced, cut; its faces, edges and sections.

use casteljau_bernstein::{
    BernsteinError, MAX_DEGREE, TRIANGLE_EDGES, WedgeNet, last_barycentric, simplex_count, value,
};
use casteljau_geom::Interval;
use casteljau_shape::control_net::{check_points, distance_bound};
use casteljau_shape::{BezierCurve, BezierPatch, BezierTriangle, ControlPoint, Parameters};

use crate::{BezierWedge, SolidError};

impl<P: ControlPoint> BezierWedge<P> {
    /// The triangle of constant w. Its normal points along rising w where the Jacobian is positive.
    ///
    /// Error of each control point: at most 4(o+2)·u times its combination of absolute values; exact to the bit at the
    /// ends of the height.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`](casteljau_shape::ShapeError::Parameter),
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where a far continuation leaves the range,
    /// [`ShapeError::NoWeight`](casteljau_shape::ShapeError::NoWeight) where all weights on it vanish.
    pub fn triangle_at(&self, w: f64) -> Result<BezierTriangle<P>, SolidError> {
        Parameters::Curve(w).finite()?;
        let ([n, o], z) = (self.degrees(), self.height().local(w));
        let points: Vec<P> = self.control_points().chunks(o + 1).map(|column| value(column, z)).collect();
        Ok(BezierTriangle::from_net(n, points)?)
    }

    /// The triangle at the start or, with `top`, at the end of the height; see [`triangle_at`](Self::triangle_at).
    ///
    /// # Errors
    /// [`ShapeError::NoWeight`](casteljau_shape::ShapeError::NoWeight) where all its weights are zero.
    pub fn triangle_face(&self, top: bool) -> Result<BezierTriangle<P>, SolidError> {
        self.triangle_at(if top { self.height().end() } else { self.height().start() })
    }

    /// The patch on which the barycentric coordinate `opposite` (0, 1 or 2) vanishes, with u from the next vertex to the
    /// one after it and v = w; its normal points outward where the Jacobian is positive. Control points to the bit.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] for another number, [`ShapeError::NoWeight`](casteljau_shape::ShapeError::NoWeight) where
    /// all its weights are zero.
    pub fn quad_face(&self, opposite: usize) -> Result<BezierPatch<P>, SolidError> {
        let edge = TRIANGLE_EDGES.get(opposite);
        let edge = edge.ok_or(BernsteinError::Vertices { vertex: opposite, vertices: 3 })?;
        let [n, o] = self.degrees();
        let mut points = vec![P::ZERO; (n + 1) * (o + 1)];
        self.net().quad_face(*edge, &mut points)?;
        Ok(BezierPatch::from_net([Interval::UNIT, self.height()], [n, o], points)?)
    }

    /// The patch over the straight line from one point (λ₁, λ₂) of the triangle to another, of degrees n and o: u runs over
    /// `[0, 1]` from the first to the second, v is w.
    ///
    /// With points where one coordinate is c it is the iso-parametric patch λₐ = c.
    ///
    /// # Errors
    /// Those of [`triangle_at`](Self::triangle_at).
    pub fn patch_between(&self, [a, b]: [[f64; 2]; 2]) -> Result<BezierPatch<P>, SolidError> {
        let part = self.restricted([a, b, b], self.height())?;
        let [n, o] = self.degrees();
        let mut points = vec![P::ZERO; (n + 1) * (o + 1)];
        part.net().quad_face([0, 1], &mut points)?;
        Ok(BezierPatch::from_net([Interval::UNIT, self.height()], [n, o], points)?)
    }

    /// The curve along the height over the point (λ₁, λ₂) of the triangle; at a vertex, an edge of the wedge to the bit.
    ///
    /// # Errors
    /// Those of [`triangle_at`](Self::triangle_at).
    pub fn curve_at(&self, [a, b]: [f64; 2]) -> Result<BezierCurve<P>, SolidError> {
        Parameters::Surface([a, b]).finite()?;
        let [n, o] = self.degrees();
        let lambda = [a, b, last_barycentric(&[a, b])];
        let mut layer = vec![P::ZERO; simplex_count::<3>(n)];
        let mut points = Vec::with_capacity(o + 1);
        for k in 0..=o {
            for (p, column) in layer.iter_mut().zip(self.control_points().chunks(o + 1)) {
                *p = column[k];
            }
            points.push(casteljau_bernstein::TriangleNet::validated(&layer, n).value(lambda));
        }
        Ok(BezierCurve::from_net(self.height(), points)?)
    }

    /// The same solid with the vertices of its triangle in another order, vertex a of the new one being `vertices[a]` of
    /// this one, and with w run backwards if `flip`. An odd permutation, and a flip, change the sign of the Jacobian.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] unless these are 0, 1 and 2 in some order.
    pub fn reoriented(&self, vertices: [usize; 3], flip: bool) -> Result<Self, SolidError> {
        let mut points = vec![P::ZERO; self.control_points().len()];
        self.net().reoriented(vertices, flip, &mut points)?;
        Ok(Self::checked(self.height(), self.degrees(), points))
    }

    /// The same solid with its degrees raised by `by`.
    ///
    /// Error of each control point: at most 4(n+o+Σby+2)·u times its convex combination of absolute values; the vertices
    /// are kept to the bit.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] where a degree becomes larger than [`MAX_DEGREE`].
    pub fn elevated(&self, by: [usize; 2]) -> Result<Self, SolidError> {
        let [n, o] = self.degrees();
        let to = [n.saturating_add(by[0]), o.saturating_add(by[1])];
        if let Some(&degree) = to.iter().find(|&&d| d > MAX_DEGREE) {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE }.into());
        }
        let mut points = vec![P::ZERO; WedgeNet::<P>::count(to)];
        self.net().elevate(to, &mut points)?;
        Ok(Self::checked(self.height(), to, points))
    }

    /// A near wedge of lower degrees with the same vertices, and a bound on its distance from this one at equal
    /// parameters, in model units.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] where a degree is above that of the solid,
    /// [`ShapeError::Unbounded`](casteljau_shape::ShapeError::Unbounded) for a rational one whose weights, or whose
    /// reduced weights, do not all have one sign.
    pub fn reduced(&self, degrees: [usize; 2]) -> Result<(Self, f64), SolidError> {
        let [n, o] = self.degrees();
        for (from, to) in [(n, degrees[0]), (o, degrees[1])] {
            if to > from {
                return Err(BernsteinError::ReducedDegree { from, to }.into());
            }
        }
        let mut points = vec![P::ZERO; WedgeNet::<P>::count(degrees)];
        let mut scratch = vec![P::ZERO; simplex_count::<3>(n) * (o + 7) + o + 1];
        let deviation = self.net().reduce(degrees, &mut points, &mut scratch)?;
        let reduced = Self::checked(self.height(), degrees, points);
        if !P::RATIONAL {
            return Ok((reduced, deviation));
        }
        let raised = reduced.elevated([n - degrees[0], o - degrees[1]])?;
        let error = distance_bound(self.control_points(), raised.control_points(), n + o)?;
        Ok((reduced, error))
    }

    /// The wedge below and that above the parameter w, each over its own height `[0, 1]`; they share the triangle at w
    /// to the bit.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`](casteljau_shape::ShapeError::Parameter),
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where a w far outside makes points out of
    /// range.
    pub fn split_height(&self, w: f64) -> Result<(Self, Self), SolidError> {
        Parameters::Curve(w).finite()?;
        let mut below = vec![P::ZERO; self.control_points().len()];
        let mut above = below.clone();
        self.net().split_height(self.height().local(w), &mut below, &mut above)?;
        self.parts(below, above, Interval::UNIT)
    }

    /// The two wedges made by cutting the triangle's edge from vertex a to vertex b at its share t: the first has the new
    /// point in place of b, the second in place of a.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] unless a and b are two of 0, 1 and 2, otherwise as for
    /// [`split_height`](Self::split_height).
    pub fn split_edge(&self, vertices: [usize; 2], t: f64) -> Result<(Self, Self), SolidError> {
        Parameters::Curve(t).finite()?;
        let mut near_a = vec![P::ZERO; self.control_points().len()];
        let mut near_b = near_a.clone();
        self.net().split_edge(vertices, t, &mut near_a, &mut near_b)?;
        self.parts(near_a, near_b, self.height())
    }

    fn parts(&self, a: Vec<P>, b: Vec<P>, height: Interval) -> Result<(Self, Self), SolidError> {
        check_points(&a)?;
        check_points(&b)?;
        Ok((Self::checked(height, self.degrees(), a), Self::checked(height, self.degrees(), b)))
    }

    /// The part over the triangle between three points (λ₁, λ₂) and over another height, which keeps its parameter w.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`](casteljau_shape::ShapeError::Parameter),
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where a far continuation leaves the range.
    pub fn restricted(&self, corners: [[f64; 2]; 3], height: Interval) -> Result<Self, SolidError> {
        for corner in corners {
            Parameters::Surface(corner).finite()?;
        }
        let corners = corners.map(|[a, b]| [a, b, last_barycentric(&[a, b])]);
        let own = [self.height().local(height.start()), self.height().local(height.end())];
        let mut points = vec![P::ZERO; self.control_points().len()];
        let mut scratch = vec![P::ZERO; 5 * simplex_count::<3>(self.degrees()[0])];
        self.net().restrict(corners, own, &mut points, &mut scratch)?;
        check_points(&points)?;
        Ok(Self::checked(height, self.degrees(), points))
    }
}
