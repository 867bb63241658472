//! What all curves, and all surfaces, answer.

use std::fmt;

use casteljau_geom::glam::{DVec2, DVec3};
use casteljau_geom::{Curvatures, CurveJet, FrenetFrame, Interval, Partials, SurfaceJet, TangentPlane};

use crate::ShapeError;
use crate::area::{MeasuredArea, area};
use crate::error::check_order;

/// The parameters at which something happened to a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Parameters {
    /// t on a curve.
    Curve(f64),
    /// (u, v) on a patch, (λ₁, λ₂) on a triangle.
    Surface([f64; 2]),
    /// (u, v, w) in a hexahedron, (λ₁, λ₂, λ₃) in a tetrahedron, (λ₁, λ₂, w) in a wedge.
    Solid([f64; 3]),
}

impl Parameters {
    /// The parameters, unless one of them is not finite.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] with the first one that is not.
    pub fn finite(self) -> Result<Self, ShapeError> {
        let values = match self {
            Self::Curve(t) => [t, 0.0, 0.0],
            Self::Surface([u, v]) => [u, v, 0.0],
            Self::Solid(uvw) => uvw,
        };
        match values.into_iter().find(|x| !x.is_finite()) {
            Some(value) => Err(ShapeError::Parameter { value }),
            None => Ok(self),
        }
    }
}

impl fmt::Display for Parameters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Curve(t) => write!(f, "t = {t}"),
            Self::Surface([u, v]) => write!(f, "({u}, {v})"),
            Self::Solid([u, v, w]) => write!(f, "({u}, {v}, {w})"),
        }
    }
}

/// A curve over an interval: polynomial or rational, in Bernstein or power form.
///
/// Programs that treat all kinds alike are written against this trait. The methods here can fail, as rational
/// curves have poles; the types' own methods say where they cannot.
///
/// ```
/// use casteljau_shape::{Curve, ParametricCurve, RationalCurve, geom::glam::DVec3};
/// let net = [DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
/// let (parabola, circle) = (Curve::new(net)?, RationalCurve::new(&net, &[1.0, 1.0, 2.0])?);
/// let kinds: [&dyn ParametricCurve; 2] = [&parabola, &circle];
/// for curve in kinds {
///     assert_eq!(curve.try_point(0.0)?, DVec3::X);
/// }
/// let frame = circle.try_frenet_frame(0.3)?;
/// assert!((frame.curvature - 1.0).abs() < 1e-14);
/// # Ok::<(), casteljau_shape::ShapeError>(())
/// ```
pub trait ParametricCurve {
    /// The interval that the parameter runs over.
    fn interval(&self) -> Interval;

    /// Point and derivatives with respect to the parameter, `out[k] = dᵏC/dtᵏ`, up to the order that fits.
    ///
    /// The curve is continued beyond its interval. Error: as the type states.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where `t` is not finite, [`ShapeError::Evaluation`] at a pole, and where an
    /// answer would leave the range of numbers; `out` is then not to be used.
    fn try_partials(&self, t: f64, out: &mut [DVec3]) -> Result<(), ShapeError> {
        self.extended_partials(t, out)?;
        if out.iter().all(|d| d.is_finite()) {
            Ok(())
        } else {
            Err(ShapeError::overflow(Parameters::Curve(t), self.weight(t)))
        }
    }

    /// As [`try_partials`](Self::try_partials), but a derivative that leaves the range of numbers is infinite or NaN
    /// in `out`, and the others stand.
    ///
    /// This is what a kind of curve implements; [`try_existing_partials`](Self::try_existing_partials) is the
    /// one to ask.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] at a pole.
    fn extended_partials(&self, t: f64, out: &mut [DVec3]) -> Result<(), ShapeError>;

    /// Point and derivatives up to an order, `None` for those that leave the range of numbers.
    ///
    /// The first one is the point, which exists. Near a pole, and over short intervals, higher derivatives may not.
    ///
    /// # Errors
    /// [`ShapeError::Order`], [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] where
    /// there is no point.
    fn try_existing_partials(&self, t: f64, order: usize) -> Result<Vec<Option<DVec3>>, ShapeError> {
        check_order(order)?;
        let mut jet = Partials::<1>::zero(order);
        self.extended_partials(t, jet.as_mut_slice())?;
        let all: Vec<_> = jet.as_slice().iter().map(|d| d.is_finite().then_some(*d)).collect();
        match all.first() {
            Some(None) => Err(ShapeError::overflow(Parameters::Curve(t), self.weight(t))),
            _ => Ok(all),
        }
    }

    /// The denominator w(t); 1 for a polynomial curve.
    fn weight(&self, t: f64) -> f64;

    /// Point `C(t)`.
    ///
    /// # Errors
    /// Those of [`try_partials`](Self::try_partials).
    fn try_point(&self, t: f64) -> Result<DVec3, ShapeError> {
        let mut out = [DVec3::ZERO];
        self.try_partials(t, &mut out)?;
        Ok(out[0])
    }

    /// Point and derivatives up to order 3: tangent, curvature and torsion are computed from it.
    ///
    /// # Errors
    /// Those of [`try_partials`](Self::try_partials).
    fn try_jet(&self, t: f64) -> Result<CurveJet, ShapeError> {
        let mut out = [DVec3::ZERO; 4];
        self.try_partials(t, &mut out)?;
        Ok(out.into())
    }

    /// Point and derivatives of any order.
    ///
    /// # Errors
    /// [`ShapeError::Order`], and those of [`try_partials`](Self::try_partials).
    fn try_jet_of_order(&self, t: f64, order: usize) -> Result<Partials<1>, ShapeError> {
        check_order(order)?;
        let mut jet = Partials::zero(order);
        self.try_partials(t, jet.as_mut_slice())?;
        Ok(jet)
    }

    /// Tangent, principal normal and binormal with curvature and torsion.
    ///
    /// # Errors
    /// [`ShapeError::NoFrame`] where C′ × C″ vanishes, and those of [`try_partials`](Self::try_partials).
    fn try_frenet_frame(&self, t: f64) -> Result<FrenetFrame, ShapeError> {
        self.try_jet(t)?.frenet_frame().ok_or(ShapeError::NoFrame { at: Parameters::Curve(t) })
    }
}

/// The parameters of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SurfaceDomain {
    /// (u, v) in a rectangle.
    Rectangle([Interval; 2]),
    /// The first two barycentric coordinates, `λ₁, λ₂ ≥ 0`, `λ₁ + λ₂ ≤ 1`.
    Triangle,
}

impl SurfaceDomain {
    /// The middle of the domain.
    #[must_use]
    pub fn center(&self) -> [f64; 2] {
        match self {
            Self::Rectangle(intervals) => intervals.map(|i| i.at(0.5)),
            Self::Triangle => [1.0 / 3.0; 2],
        }
    }

    /// Whether the parameters lie in the domain, its boundary included.
    #[must_use]
    pub fn contains(&self, [u, v]: [f64; 2]) -> bool {
        match self {
            Self::Rectangle(intervals) => intervals[0].contains(u) && intervals[1].contains(v),
            Self::Triangle => u >= 0.0 && v >= 0.0 && u + v <= 1.0,
        }
    }

    /// Extent in each parameter.
    #[must_use]
    pub fn lengths(&self) -> [f64; 2] {
        match self {
            Self::Rectangle(intervals) => intervals.map(|i| i.length()),
            Self::Triangle => [1.0; 2],
        }
    }

    /// The direction to the middle, in units of [`lengths`](Self::lengths).
    fn inward(&self, [u, v]: [f64; 2]) -> DVec2 {
        let ([cu, cv], [a, b]) = (self.center(), self.lengths());
        DVec2::new((cu - u) / a, (cv - v) / b)
    }
}

/// A surface over a rectangle or a triangle: polynomial or rational, in Bernstein or power form.
///
/// Programs that treat all kinds alike are written against this trait. The methods here can fail, as rational
/// surfaces have poles and edges may collapse.
pub trait ParametricSurface {
    /// The domain of the parameters.
    fn domain(&self) -> SurfaceDomain;

    /// Point and partial derivatives with respect to the parameters, at the places
    /// [`partial_index`](casteljau_geom::partial_index)`([a, b])` of `out`, up to the total order that fits.
    ///
    /// The surface is continued beyond its domain. Error: as the type states.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] at a pole, and
    /// where an answer would leave the range of numbers; `out` is then not to be used.
    fn try_partials(&self, u: f64, v: f64, out: &mut [DVec3]) -> Result<(), ShapeError> {
        self.extended_partials(u, v, out)?;
        if out.iter().all(|d| d.is_finite()) {
            Ok(())
        } else {
            Err(ShapeError::overflow(Parameters::Surface([u, v]), self.weight(u, v)))
        }
    }

    /// As [`try_partials`](Self::try_partials), but a derivative that leaves the range of numbers is infinite or NaN
    /// in `out`, and the others stand.
    ///
    /// This is what a kind of surface implements; [`try_existing_partials`](Self::try_existing_partials) is the
    /// one to ask.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] at a pole.
    fn extended_partials(&self, u: f64, v: f64, out: &mut [DVec3]) -> Result<(), ShapeError>;

    /// Point and partial derivatives up to an order, `None` for those that leave the range of numbers.
    ///
    /// The first one is the point, which exists. Near a pole, and over short intervals, higher derivatives may not.
    ///
    /// # Errors
    /// [`ShapeError::Order`], [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] where
    /// there is no point.
    fn try_existing_partials(&self, u: f64, v: f64, order: usize) -> Result<Vec<Option<DVec3>>, ShapeError> {
        check_order(order)?;
        let mut jet = Partials::<2>::zero(order);
        self.extended_partials(u, v, jet.as_mut_slice())?;
        let all: Vec<_> = jet.as_slice().iter().map(|d| d.is_finite().then_some(*d)).collect();
        match all.first() {
            Some(None) => Err(ShapeError::overflow(Parameters::Surface([u, v]), self.weight(u, v))),
            _ => Ok(all),
        }
    }

    /// The denominator w(u,v); 1 for a polynomial surface.
    fn weight(&self, u: f64, v: f64) -> f64;

    /// Point `S(u,v)`.
    ///
    /// # Errors
    /// Those of [`try_partials`](Self::try_partials).
    fn try_point(&self, u: f64, v: f64) -> Result<DVec3, ShapeError> {
        let mut out = [DVec3::ZERO];
        self.try_partials(u, v, &mut out)?;
        Ok(out[0])
    }

    /// Point and partial derivatives up to order 2: the fundamental forms are computed from it.
    ///
    /// # Errors
    /// Those of [`try_partials`](Self::try_partials).
    fn try_jet(&self, u: f64, v: f64) -> Result<SurfaceJet, ShapeError> {
        let mut out = [DVec3::ZERO; 6];
        self.try_partials(u, v, &mut out)?;
        Ok(out.into())
    }

    /// Point and partial derivatives of any total order.
    ///
    /// # Errors
    /// Those of [`try_partials`](Self::try_partials).
    fn try_jet_of_order(&self, u: f64, v: f64, order: usize) -> Result<Partials<2>, ShapeError> {
        check_order(order)?;
        let mut jet = Partials::zero(order);
        self.try_partials(u, v, jet.as_mut_slice())?;
        Ok(jet)
    }

    /// Unit normal `∂u × ∂v / |∂u × ∂v|`; where that collapses, its limit on the way to the middle of the
    /// domain, see [`SurfaceJet::normal_toward`]. Where second derivatives leave the range of numbers the first ones
    /// alone decide.
    ///
    /// # Errors
    /// [`ShapeError::NoTangentPlane`] where derivatives up to order 2 do not decide, and those of
    /// [`try_partials`](Self::try_partials).
    fn try_normal(&self, u: f64, v: f64) -> Result<DVec3, ShapeError> {
        let (domain, at) = (self.domain(), Parameters::Surface([u, v]));
        let mut out = [DVec3::ZERO; 6];
        self.extended_partials(u, v, &mut out)?;
        let (first, second) = out.split_at_mut(3);
        if !first.iter().all(|d| d.is_finite()) {
            return Err(ShapeError::overflow(at, self.weight(u, v)));
        }
        if !second.iter().all(|d| d.is_finite()) {
            second.fill(DVec3::ZERO);
        }
        let jet = SurfaceJet::from(out).rescaled(domain.lengths());
        jet.normal_toward(domain.inward([u, v])).ok_or(ShapeError::NoTangentPlane { at })
    }

    /// Tangent plane, by the normal of [`try_normal`](Self::try_normal).
    ///
    /// # Errors
    /// Those of [`try_normal`](Self::try_normal).
    fn try_tangent_plane(&self, u: f64, v: f64) -> Result<TangentPlane, ShapeError> {
        let normal = self.try_normal(u, v)?;
        Ok(TangentPlane { normal, offset: normal.dot(self.try_point(u, v)?) })
    }

    /// Gaussian, mean and principal curvatures with their directions, at a regular point.
    ///
    /// # Errors
    /// [`ShapeError::NoTangentPlane`] where the first derivatives do not span a plane, and those of
    /// [`try_partials`](Self::try_partials).
    fn try_curvatures(&self, u: f64, v: f64) -> Result<Curvatures, ShapeError> {
        // In units of the domain, so that no interval makes a derivative look collapsed.
        let jet = self.try_jet(u, v)?.rescaled(self.domain().lengths());
        jet.curvatures().ok_or(ShapeError::NoTangentPlane { at: Parameters::Surface([u, v]) })
    }

    /// Area `∬ |∂u × ∂v| du dv` over the domain, to `relative` of itself: that of
    /// [`area_with_error`](Self::area_with_error), which says what the accuracy rests on.
    ///
    /// ```
    /// use casteljau_shape::{ParametricSurface, RationalPatch, geom::glam::DVec3};
    /// let octant = RationalPatch::sphere_octant(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z)?;
    /// assert!((octant.area(1e-12)? - std::f64::consts::FRAC_PI_2).abs() < 2e-12);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`area_with_error`](Self::area_with_error).
    fn area(&self, relative: f64) -> Result<f64, ShapeError> {
        Ok(self.area_with_error(relative)?.area)
    }

    /// Area `∬ |∂u × ∂v| du dv` over the domain with its error, which is at most `relative` times the area.
    ///
    /// The domain is cut into cells, worst first, until the stated error is no more than was asked for. It is four times
    /// the sum of the changes from Gauss's rule of 16 × 16 points on each cell to the same rule on its four quarters (or
    /// of a sixteenth of the change one level before, where that is larger, as two rules may agree by chance), and an
    /// allowance for rounding. *It is an estimate and no certificate*, unlike that of arc lengths: where the surface is
    /// smooth over the cells it is far on the safe side, as the finer rule is the one that is taken; where the normal
    /// turns over, the changes are of the size of the error; what is too small for the first cells to see goes unseen.
    /// The tests compare it with a quadrature of another rule on a finer grid, for random patches and triangles, polynomial
    /// and rational with weights from 0.1 to 10, with collapsed edges, cusps and folds.
    ///
    /// Creases cost cells, of which at most some 8,000 are looked at. Far from the origin rounding sets a limit: some
    /// 64·u times the distance over the size. The same surface over other intervals has the same area.
    ///
    /// ```
    /// use casteljau_shape::{ParametricSurface, Patch, geom::glam::DVec3};
    /// let square = Patch::new([1, 1], [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.0)])?;
    /// let measured = square.area_with_error(1e-9)?;
    /// assert!((measured.area - 1.0).abs() <= measured.error && measured.error <= 1e-9);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Accuracy`] unless 0 < `relative` < 1, [`ShapeError::Area`] where the accuracy was not reached,
    /// as it never is for a surface without area, with the one that was; those of [`try_partials`](Self::try_partials).
    fn area_with_error(&self, relative: f64) -> Result<MeasuredArea, ShapeError> {
        let tangents = |[u, v]: [f64; 2]| {
            let mut out = [DVec3::ZERO; 3];
            self.try_partials(u, v, &mut out)?;
            Ok(out)
        };
        area(&tangents, self.domain(), relative)
    }
}
