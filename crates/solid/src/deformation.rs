//! Free-form deformation: shapes in the parameter space of a solid, carried into space by it.

use casteljau_bernstein::{
    BernsteinError, BernsteinSpace, SimplexSpace, WedgeSpace, compose, compose_homogeneous, compose_simplex,
    compose_wedge, compose_wedge_homogeneous,
};
use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_shape::control_net::{check_points, homogeneous};
use casteljau_shape::{
    BezierCurve, BezierPatch, BezierTriangle, ControlPoint, Curve, Patch, RationalCurve, RationalPatch,
    RationalTriangle, Triangle,
};

use crate::{
    BezierHexahedron, BezierTetrahedron, BezierWedge, Hexahedron, ParametricSolid, RationalHexahedron,
    RationalTetrahedron, RationalWedge, SolidError, Tetrahedron, Wedge,
};

/// The highest degree that a composed shape may have.
pub const LARGEST_COMPOSED_DEGREE: usize = 200;

/// Control points that a composed shape may have, at most.
pub const MOST_COMPOSED_POINTS: usize = 1_000_000;

/// A solid as a deformation of space: a point (x, y, z) is taken for parameters, and goes to the solid's point there.
///
/// Whole shapes are carried over exactly: the composition of a shape of degree d with a solid of total degree D is of
/// degree d·D in each of its parameters. D is l + m + n for a hexahedron, n for a tetrahedron, n + o for a wedge; the
/// parameters of a tetrahedron are its first three barycentric coordinates. Shapes may leave the domain, where the solid
/// is continued. Polynomial shapes keep the kind of control points of the solid; rational ones become rational.
///
/// Error of each control point: that of [`compose`], at most 4(D(c + 2) + 2)·u times the composition of absolute values,
/// c being the number of control points of the shape less one. Cost: about D products of polynomials for each control
/// point of the solid.
///
/// Source: Sederberg and Parry, "Free-form deformation of solid geometric models", SIGGRAPH 1986; DeRose, Goldman,
/// Hagen and Mann, "Functional composition algorithms via blossoming", ACM Transactions on Graphics 12 (1993).
///
/// ```
/// use casteljau_solid::{Deformation, Hexahedron, shape::Curve, geom::glam::DVec3};
/// // Bends the cube: x grows with z².
/// let bend = Hexahedron::unit_cube().elevated([0, 0, 1])?;
/// let points: Vec<_> = bend.control_points().iter().map(|p| *p + DVec3::X * (p.z == 1.0) as u8 as f64).collect();
/// let bend = Hexahedron::new([1, 1, 2], points)?;
/// let line = Curve::new([DVec3::ZERO, DVec3::Z])?;
/// let bent = bend.deform_curve(&line)?;
/// assert_eq!(bent.degree(), 4);
/// assert_eq!(bent.point(0.5), DVec3::new(0.25, 0.0, 0.5));
/// # Ok::<(), casteljau_solid::SolidError>(())
/// ```
///
/// # Errors
/// All methods: [`SolidError::Kernel`] where a degree becomes larger than [`LARGEST_COMPOSED_DEGREE`],
/// [`SolidError::ComposedPoints`] above [`MOST_COMPOSED_POINTS`],
/// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where a number leaves the range.
pub trait Deformation: ParametricSolid {
    /// The control points of deformed polynomial shapes.
    type Point: ControlPoint;

    /// The total degree D of the solid.
    fn total_degree(&self) -> usize;

    /// The composition with three parameters that are polynomials of the space `inner`.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn compose_net<S: BernsteinSpace>(
        &self,
        arguments: [&[f64]; 3],
        inner: S,
    ) -> Result<Vec<Self::Point>, SolidError>;

    /// The composition with three parameters `argument/weight`, homogeneous.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn compose_rational_net<S: BernsteinSpace>(
        &self,
        arguments: [&[f64]; 3],
        weight: &[f64],
        inner: S,
    ) -> Result<Vec<DVec4>, SolidError>;

    /// Points, one by one.
    ///
    /// # Errors
    /// Those of [`try_point`](ParametricSolid::try_point); the points before the one that failed are deformed.
    fn deform_points(&self, points: &mut [DVec3]) -> Result<(), SolidError> {
        for p in points {
            *p = self.try_point(p.to_array())?;
        }
        Ok(())
    }

    /// A polynomial curve.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_curve(&self, curve: &Curve) -> Result<BezierCurve<Self::Point>, SolidError> {
        check_degree(self.total_degree(), &[curve.degree()])?;
        let net = polynomial_net(self, curve.control_points(), [curve.degree()])?;
        Ok(BezierCurve::from_net(curve.interval(), net)?)
    }

    /// A rational curve.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_rational_curve(&self, curve: &RationalCurve) -> Result<RationalCurve, SolidError> {
        check_degree(self.total_degree(), &[curve.degree()])?;
        let net = rational_net(self, curve.control_points(), [curve.degree()])?;
        Ok(BezierCurve::from_net(curve.interval(), net)?)
    }

    /// A polynomial patch.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_patch(&self, patch: &Patch) -> Result<BezierPatch<Self::Point>, SolidError> {
        let degrees = check_degree(self.total_degree(), &patch.degrees()).map(|_| patch.degrees())?;
        let net = polynomial_net(self, patch.control_points(), degrees)?;
        Ok(BezierPatch::from_net(patch.intervals(), degrees.power(self.total_degree()), net)?)
    }

    /// A rational patch.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_rational_patch(&self, patch: &RationalPatch) -> Result<RationalPatch, SolidError> {
        let degrees = check_degree(self.total_degree(), &patch.degrees()).map(|_| patch.degrees())?;
        let net = rational_net(self, patch.control_points(), degrees)?;
        Ok(BezierPatch::from_net(patch.intervals(), degrees.power(self.total_degree()), net)?)
    }

    /// A polynomial triangle.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_triangle(&self, triangle: &Triangle) -> Result<BezierTriangle<Self::Point>, SolidError> {
        check_degree(self.total_degree(), &[triangle.degree()])?;
        let net = polynomial_net(self, triangle.control_points(), SimplexSpace::<3>(triangle.degree()))?;
        Ok(BezierTriangle::from_net(triangle.degree() * self.total_degree(), net)?)
    }

    /// A rational triangle.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_rational_triangle(&self, triangle: &RationalTriangle) -> Result<RationalTriangle, SolidError> {
        check_degree(self.total_degree(), &[triangle.degree()])?;
        let net = rational_net(self, triangle.control_points(), SimplexSpace::<3>(triangle.degree()))?;
        Ok(BezierTriangle::from_net(triangle.degree() * self.total_degree(), net)?)
    }

    /// A polynomial hexahedron.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_hexahedron(&self, solid: &Hexahedron) -> Result<BezierHexahedron<Self::Point>, SolidError> {
        check_degree(self.total_degree(), &solid.degrees())?;
        let net = polynomial_net(self, solid.control_points(), solid.degrees())?;
        BezierHexahedron::from_net(solid.intervals(), solid.degrees().power(self.total_degree()), net)
    }

    /// A rational hexahedron.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_rational_hexahedron(
        &self,
        solid: &RationalHexahedron,
    ) -> Result<RationalHexahedron, SolidError> {
        check_degree(self.total_degree(), &solid.degrees())?;
        let net = rational_net(self, solid.control_points(), solid.degrees())?;
        BezierHexahedron::from_net(solid.intervals(), solid.degrees().power(self.total_degree()), net)
    }

    /// A polynomial tetrahedron.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_tetrahedron(&self, solid: &Tetrahedron) -> Result<BezierTetrahedron<Self::Point>, SolidError> {
        check_degree(self.total_degree(), &[solid.degree()])?;
        let net = polynomial_net(self, solid.control_points(), SimplexSpace::<4>(solid.degree()))?;
        BezierTetrahedron::from_net(solid.degree() * self.total_degree(), net)
    }

    /// A rational tetrahedron.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_rational_tetrahedron(
        &self,
        solid: &RationalTetrahedron,
    ) -> Result<RationalTetrahedron, SolidError> {
        check_degree(self.total_degree(), &[solid.degree()])?;
        let net = rational_net(self, solid.control_points(), SimplexSpace::<4>(solid.degree()))?;
        BezierTetrahedron::from_net(solid.degree() * self.total_degree(), net)
    }

    /// A polynomial wedge.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_wedge(&self, solid: &Wedge) -> Result<BezierWedge<Self::Point>, SolidError> {
        check_degree(self.total_degree(), &solid.degrees())?;
        let net = polynomial_net(self, solid.control_points(), WedgeSpace(solid.degrees()))?;
        BezierWedge::from_net(solid.height(), WedgeSpace(solid.degrees()).power(self.total_degree()).0, net)
    }

    /// A rational wedge.
    ///
    /// # Errors
    /// See [`Deformation`].
    fn deform_rational_wedge(&self, solid: &RationalWedge) -> Result<RationalWedge, SolidError> {
        check_degree(self.total_degree(), &solid.degrees())?;
        let net = rational_net(self, solid.control_points(), WedgeSpace(solid.degrees()))?;
        BezierWedge::from_net(solid.height(), WedgeSpace(solid.degrees()).power(self.total_degree()).0, net)
    }
}

fn check_degree(total: usize, degrees: &[usize]) -> Result<(), SolidError> {
    let composed = degrees.iter().map(|d| d.saturating_mul(total)).max().unwrap_or(0);
    if composed > LARGEST_COMPOSED_DEGREE {
        return Err(BernsteinError::Degree { degree: composed, limit: LARGEST_COMPOSED_DEGREE }.into());
    }
    Ok(())
}

fn check_count<S: BernsteinSpace>(total: usize, space: S) -> Result<(), SolidError> {
    let (needed, limit) = (space.power(total).size()?, MOST_COMPOSED_POINTS);
    if needed > limit { Err(SolidError::ComposedPoints { needed, limit }) } else { Ok(()) }
}

/// One coordinate of all points.
fn column<const D: usize>(points: &[impl Into<[f64; D]> + Copy], axis: usize) -> Vec<f64> {
    points.iter().map(|&p| p.into()[axis]).collect()
}

fn polynomial_net<D: Deformation + ?Sized, S: BernsteinSpace>(
    solid: &D,
    points: &[DVec3],
    space: S,
) -> Result<Vec<D::Point>, SolidError> {
    let [x, y, z] = [0, 1, 2].map(|axis| column(points, axis));
    check_count(solid.total_degree(), space)?;
    checked(solid.compose_net([&x, &y, &z], space)?)
}

fn rational_net<D: Deformation + ?Sized, S: BernsteinSpace>(
    solid: &D,
    points: &[DVec4],
    space: S,
) -> Result<Vec<DVec4>, SolidError> {
    let [x, y, z, w] = [0, 1, 2, 3].map(|axis| column(points, axis));
    check_count(solid.total_degree(), space)?;
    checked(solid.compose_rational_net([&x, &y, &z], &w, space)?)
}

fn checked<P: ControlPoint>(points: Vec<P>) -> Result<Vec<P>, SolidError> {
    check_points(&points)?;
    Ok(points)
}

/// A difference, coefficient by coefficient.
fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

impl<P: ControlPoint> Deformation for BezierHexahedron<P> {
    type Point = P;

    fn total_degree(&self) -> usize {
        self.degrees().iter().sum()
    }

    fn compose_net<S: BernsteinSpace>(&self, arguments: [&[f64]; 3], inner: S) -> Result<Vec<P>, SolidError> {
        let local: [Vec<f64>; 3] = std::array::from_fn(|axis| {
            arguments[axis].iter().map(|&t| self.intervals()[axis].local(t)).collect()
        });
        let mut out = vec![P::ZERO; inner.power(self.total_degree()).size()?];
        compose(self.control_points(), self.degrees(), local.each_ref().map(Vec::as_slice), inner, &mut out)?;
        Ok(out)
    }

    fn compose_rational_net<S: BernsteinSpace>(
        &self,
        arguments: [&[f64]; 3],
        weight: &[f64],
        inner: S,
    ) -> Result<Vec<DVec4>, SolidError> {
        // x/w in [a, b] is (x − a w)/(b − a), over w.
        let local: [Vec<f64>; 3] = std::array::from_fn(|axis| {
            let interval = self.intervals()[axis];
            let from_start = arguments[axis].iter().zip(weight).map(|(x, w)| x - interval.start() * w);
            from_start.map(|x| x / interval.length()).collect()
        });
        let rest = local.each_ref().map(|x| difference(weight, x));
        let pairs = std::array::from_fn(|axis| [rest[axis].as_slice(), local[axis].as_slice()]);
        let mut out = vec![DVec4::ZERO; inner.power(self.total_degree()).size()?];
        compose_homogeneous(&homogeneous(self.control_points()), self.degrees(), pairs, inner, &mut out)?;
        Ok(out)
    }
}

impl<P: ControlPoint> Deformation for BezierTetrahedron<P> {
    type Point = P;

    fn total_degree(&self) -> usize {
        self.degree()
    }

    fn compose_net<S: BernsteinSpace>(&self, [x, y, z]: [&[f64]; 3], inner: S) -> Result<Vec<P>, SolidError> {
        let ones = vec![1.0; x.len()];
        let rest = difference(&difference(&difference(&ones, x), y), z);
        let mut out = vec![P::ZERO; inner.power(self.degree()).size()?];
        compose_simplex(self.control_points(), self.degree(), &[x, y, z, &rest], inner, &mut out)?;
        Ok(out)
    }

    fn compose_rational_net<S: BernsteinSpace>(
        &self,
        [x, y, z]: [&[f64]; 3],
        weight: &[f64],
        inner: S,
    ) -> Result<Vec<DVec4>, SolidError> {
        let rest = difference(&difference(&difference(weight, x), y), z);
        let mut out = vec![DVec4::ZERO; inner.power(self.degree()).size()?];
        let outer = homogeneous(self.control_points());
        compose_simplex(&outer, self.degree(), &[x, y, z, &rest], inner, &mut out)?;
        Ok(out)
    }
}

impl<P: ControlPoint> Deformation for BezierWedge<P> {
    type Point = P;

    fn total_degree(&self) -> usize {
        self.degrees().iter().sum()
    }

    fn compose_net<S: BernsteinSpace>(&self, [x, y, z]: [&[f64]; 3], inner: S) -> Result<Vec<P>, SolidError> {
        let ones = vec![1.0; x.len()];
        let rest = difference(&difference(&ones, x), y);
        let height: Vec<f64> = z.iter().map(|&z| self.height().local(z)).collect();
        let mut out = vec![P::ZERO; inner.power(self.total_degree()).size()?];
        compose_wedge(self.control_points(), self.degrees(), [x, y, &rest], &height, inner, &mut out)?;
        Ok(out)
    }

    fn compose_rational_net<S: BernsteinSpace>(
        &self,
        [x, y, z]: [&[f64]; 3],
        weight: &[f64],
        inner: S,
    ) -> Result<Vec<DVec4>, SolidError> {
        let rest = difference(&difference(weight, x), y);
        let interval = self.height();
        let height: Vec<f64> =
            z.iter().zip(weight).map(|(z, w)| (z - interval.start() * w) / interval.length()).collect();
        let below = difference(weight, &height);
        let mut out = vec![DVec4::ZERO; inner.power(self.total_degree()).size()?];
        let outer = homogeneous(self.control_points());
        compose_wedge_homogeneous(&outer, self.degrees(), [x, y, &rest], [&below, &height], inner, &mut out)?;
        Ok(out)
    }
}
