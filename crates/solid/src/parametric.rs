//! What all solids answer.

use casteljau_geom::glam::DVec3;
use casteljau_geom::{Interval, Partials, SolidJet};
use casteljau_shape::control_net::check_order;
use casteljau_shape::{Parameters, ShapeError};

use crate::SolidError;

/// The parameters of a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SolidDomain {
    /// (u, v, w) in a box.
    Box([Interval; 3]),
    /// The first three barycentric coordinates, `λ₁, λ₂, λ₃ ≥ 0`, `λ₁ + λ₂ + λ₃ ≤ 1`.
    Tetrahedron,
    /// The first two barycentric coordinates of a triangle, `λ₁, λ₂ ≥ 0`, `λ₁ + λ₂ ≤ 1`, and w in an interval.
    Wedge(Interval),
}

impl SolidDomain {
    /// The middle of the domain.
    #[must_use]
    pub fn center(&self) -> [f64; 3] {
        match self {
            Self::Box(intervals) => intervals.map(|i| i.at(0.5)),
            Self::Tetrahedron => [0.25; 3],
            Self::Wedge(height) => [1.0 / 3.0, 1.0 / 3.0, height.at(0.5)],
        }
    }

    /// Whether the parameters lie in the domain, its boundary included.
    #[must_use]
    pub fn contains(&self, [u, v, w]: [f64; 3]) -> bool {
        match self {
            Self::Box(intervals) => intervals.iter().zip([u, v, w]).all(|(i, t)| i.contains(t)),
            Self::Tetrahedron => u >= 0.0 && v >= 0.0 && w >= 0.0 && u + v + w <= 1.0,
            Self::Wedge(height) => u >= 0.0 && v >= 0.0 && u + v <= 1.0 && height.contains(w),
        }
    }

    /// Volume of the domain: 1 for a unit box, 1/6 for a tetrahedron, 1/2 for a wedge of height 1.
    #[must_use]
    pub fn volume(&self) -> f64 {
        match self {
            Self::Box(intervals) => intervals.iter().map(Interval::length).product(),
            Self::Tetrahedron => 1.0 / 6.0,
            Self::Wedge(height) => 0.5 * height.length(),
        }
    }
}

/// A solid over a box, a tetrahedron or a wedge: polynomial or rational.
///
/// Programs that treat all kinds alike are written against this trait. The methods here can fail, as rational solids
/// have poles; the types' own methods say where they cannot.
///
/// ```
/// use casteljau_solid::{Hexahedron, ParametricSolid, Tetrahedron, geom::glam::DVec3};
/// let corners = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO];
/// let (tetrahedron, cube) = (Tetrahedron::new(1, corners)?, Hexahedron::unit_cube());
/// let kinds: [&dyn ParametricSolid; 2] = [&tetrahedron, &cube];
/// for solid in kinds {
///     assert_eq!(solid.try_point([0.25, 0.5, 0.125])?, DVec3::new(0.25, 0.5, 0.125));
///     assert_eq!(solid.try_jacobian([0.25, 0.5, 0.125])?, 1.0);
/// }
/// # Ok::<(), casteljau_solid::SolidError>(())
/// ```
pub trait ParametricSolid {
    /// The domain of the parameters.
    fn domain(&self) -> SolidDomain;

    /// As [`try_partials`](Self::try_partials), but a derivative that leaves the range of numbers is infinite or NaN
    /// in `out`, and the others stand.
    ///
    /// This is what a kind of solid implements; [`try_existing_partials`](Self::try_existing_partials) is the one to
    /// ask.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] at a pole, both as
    /// [`SolidError::Shape`].
    fn extended_partials(&self, at: [f64; 3], out: &mut [DVec3]) -> Result<(), SolidError>;

    /// The denominator; 1 for a polynomial solid.
    fn weight(&self, at: [f64; 3]) -> f64;

    /// Point and partial derivatives with respect to the parameters, at the places
    /// [`partial_index`](casteljau_geom::partial_index)`([a, b, c])` of `out`, up to the total order that fits.
    ///
    /// The solid is continued beyond its domain. Error: as the type states.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] at a pole, and where an
    /// answer would leave the range of numbers; `out` is then not to be used.
    fn try_partials(&self, at: [f64; 3], out: &mut [DVec3]) -> Result<(), SolidError> {
        self.extended_partials(at, out)?;
        if out.iter().all(|d| d.is_finite()) {
            Ok(())
        } else {
            Err(ShapeError::overflow(Parameters::Solid(at), self.weight(at)).into())
        }
    }

    /// Point and derivatives up to an order, `None` for those that leave the range of numbers.
    ///
    /// The first one is the point, which exists. Near a pole, and over short intervals, higher derivatives may not.
    ///
    /// # Errors
    /// [`ShapeError::Order`], [`ShapeError::Parameter`] where a parameter is not finite, [`ShapeError::Evaluation`] where
    /// there is no point.
    fn try_existing_partials(&self, at: [f64; 3], order: usize) -> Result<Vec<Option<DVec3>>, SolidError> {
        check_order(order)?;
        let mut jet = Partials::<3>::zero(order);
        self.extended_partials(at, jet.as_mut_slice())?;
        let all: Vec<_> = jet.as_slice().iter().map(|d| d.is_finite().then_some(*d)).collect();
        match all.first() {
            Some(None) => Err(ShapeError::overflow(Parameters::Solid(at), self.weight(at)).into()),
            _ => Ok(all),
        }
    }

    /// Point of the solid.
    ///
    /// # Errors
    /// Those of [`try_partials`](Self::try_partials).
    fn try_point(&self, at: [f64; 3]) -> Result<DVec3, SolidError> {
        let mut out = [DVec3::ZERO];
        self.try_partials(at, &mut out)?;
        Ok(out[0])
    }

    /// Point and first derivatives: the Jacobian matrix and its determinant are made of them.
    ///
    /// # Errors
    /// Those of [`try_partials`](Self::try_partials).
    fn try_jet(&self, at: [f64; 3]) -> Result<SolidJet, SolidError> {
        let mut out = [DVec3::ZERO; 4];
        self.try_partials(at, &mut out)?;
        let [point, du, dv, dw] = out;
        Ok(SolidJet { point, du, dv, dw })
    }

    /// Point and derivatives of any order.
    ///
    /// # Errors
    /// [`ShapeError::Order`], and those of [`try_partials`](Self::try_partials).
    fn try_jet_of_order(&self, at: [f64; 3], order: usize) -> Result<Partials<3>, SolidError> {
        check_order(order)?;
        let mut jet = Partials::zero(order);
        self.try_partials(at, jet.as_mut_slice())?;
        Ok(jet)
    }

    /// The Jacobian `det ∂(x,y,z)/∂(parameters)`, negative where the solid is turned inside out.
    ///
    /// # Errors
    /// Those of [`try_partials`](Self::try_partials), and where the determinant itself leaves the range of numbers.
    fn try_jacobian(&self, at: [f64; 3]) -> Result<f64, SolidError> {
        let jacobian = self.try_jet(at)?.jacobian();
        if jacobian.is_finite() {
            Ok(jacobian)
        } else {
            Err(ShapeError::overflow(Parameters::Solid(at), self.weight(at)).into())
        }
    }
}
