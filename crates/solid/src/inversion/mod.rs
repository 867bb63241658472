//! Inversion: the parameter of a point in space.

mod domain;
mod search;

use std::fmt;

use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::DVec3;
use casteljau_shape::control_net::homogeneous;
use casteljau_shape::{ControlPoint, LARGEST_COORDINATE, ShapeError};

use self::domain::{Corner, Cube, Prism};
use self::search::{Hit, Search, Work};
use crate::{BezierHexahedron, BezierTetrahedron, BezierWedge, SolidDomain, SolidError};

/// The parameter of a point, within the tolerance asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preimage {
    /// Parameters in the domain of the solid.
    pub parameters: [f64; 3],
    /// Distance of the solid's point there from the point asked for.
    pub residual: f64,
}

/// Finds the parameters of points of one solid.
///
/// The solid is cut into cells with boxes once; a point is then sought by Newton's method from the cell that comes
/// nearest to it. Where that finds nothing, cells are left out by the signs of the Bernstein coefficients of
/// `M (wF − w·p)`, M being an inverse Jacobian, and the others are cut further and tried again: the answer is a
/// parameter, or a proof that there is none. Where the solid overlaps itself, one of the parameters is found.
///
/// ```
/// use casteljau_solid::{Hexahedron, SolidLocator, geom::glam::DVec3};
/// let cube = Hexahedron::unit_cube();
/// let mut locator = SolidLocator::of_hexahedron(&cube)?;
/// let found = locator.locate(DVec3::new(0.5, 0.25, 1.0))?.unwrap();
/// assert!(found.residual <= 1e-13 && (found.parameters[1] - 0.25).abs() < 1e-13);
/// assert_eq!(locator.locate(DVec3::new(0.5, 0.25, 1.001))?, None);
/// # Ok::<(), casteljau_solid::SolidError>(())
/// ```
pub struct SolidLocator {
    search: AnySearch,
    domain: SolidDomain,
    work: Work,
}

enum AnySearch {
    Cube(Search<Cube>),
    Corner(Search<Corner>),
    Prism(Search<Prism>),
}

impl fmt::Debug for SolidLocator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SolidLocator").field("domain", &self.domain).field("size", &self.size()).finish()
    }
}

impl SolidLocator {
    /// Makes ready to find points in a hexahedron.
    ///
    /// Cost: 64 restrictions of the net.
    ///
    /// # Errors
    /// [`ShapeError::Unbounded`] where no part of the solid has weights of one sign.
    pub fn of_hexahedron<P: ControlPoint>(solid: &BezierHexahedron<P>) -> Result<Self, SolidError> {
        let search = Search::new(Cube(solid.degrees()), &homogeneous(solid.control_points()))?;
        let domain = SolidDomain::Box(solid.intervals());
        Ok(Self { search: AnySearch::Cube(search), domain, work: Work::default() })
    }

    /// Makes ready to find points in a tetrahedron.
    ///
    /// # Errors
    /// Those of [`of_hexahedron`](Self::of_hexahedron).
    pub fn of_tetrahedron<P: ControlPoint>(solid: &BezierTetrahedron<P>) -> Result<Self, SolidError> {
        let search = Search::new(Corner(solid.degree()), &homogeneous(solid.control_points()))?;
        Ok(Self {
            search: AnySearch::Corner(search),
            domain: SolidDomain::Tetrahedron,
            work: Work::default(),
        })
    }

    /// Makes ready to find points in a wedge.
    ///
    /// # Errors
    /// Those of [`of_hexahedron`](Self::of_hexahedron).
    pub fn of_wedge<P: ControlPoint>(solid: &BezierWedge<P>) -> Result<Self, SolidError> {
        let search = Search::new(Prism(solid.degrees()), &homogeneous(solid.control_points()))?;
        let domain = SolidDomain::Wedge(solid.height());
        Ok(Self { search: AnySearch::Prism(search), domain, work: Work::default() })
    }

    /// The diagonal of a box around the solid.
    #[must_use]
    pub fn size(&self) -> f64 {
        match &self.search {
            AnySearch::Cube(search) => search.size(),
            AnySearch::Corner(search) => search.size(),
            AnySearch::Prism(search) => search.size(),
        }
    }

    /// A parameter whose point is within 1e-13 of the solid's size from p (and eight roundings of p itself); `None` is
    /// a proof that p is no point of the solid.
    ///
    /// # Errors
    /// Those of [`locate_within`](Self::locate_within).
    pub fn locate(&mut self, p: DVec3) -> Result<Option<Preimage>, SolidError> {
        let rounding = 8.0 * UNIT_ROUNDOFF * p.abs().max_element();
        self.locate_within(p, 1e-13 * self.size() + rounding)
    }

    /// A parameter whose point is within `tolerance`, in model units, from p; `None` is a proof that p is no point of
    /// the solid. Of points outside, but within the tolerance, either may be the answer.
    ///
    /// # Errors
    /// [`ShapeError::Query`] where p is not finite or out of range, [`SolidError::Construction`] unless the tolerance
    /// is positive, [`SolidError::Undecided`] where 5,000 cells were not enough, as may happen where the tolerance is
    /// below the rounding of the solid itself, and beside a control point of weight 0 at a corner, where the solid ends in
    /// a face of its own.
    pub fn locate_within(&mut self, p: DVec3, tolerance: f64) -> Result<Option<Preimage>, SolidError> {
        if let Some(axis) = (0..3).find(|&axis| p[axis].is_nan() || p[axis].abs() > LARGEST_COORDINATE) {
            return Err(ShapeError::Query { axis, value: p[axis] }.into());
        }
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(SolidError::Construction { what: "tolerance of the inversion", value: tolerance });
        }
        let work = &mut self.work;
        let hit = match &self.search {
            AnySearch::Cube(search) => search.locate(p, tolerance, work),
            AnySearch::Corner(search) => search.locate(p, tolerance, work),
            AnySearch::Prism(search) => search.locate(p, tolerance, work),
        }?;
        Ok(hit.map(|Hit { at, residual }| Preimage { parameters: self.global(at), residual }))
    }

    /// From parameters on unit intervals to those of the solid.
    fn global(&self, at: DVec3) -> [f64; 3] {
        match self.domain {
            SolidDomain::Box([u, v, w]) => [u.at(at.x), v.at(at.y), w.at(at.z)],
            SolidDomain::Tetrahedron => at.to_array(),
            SolidDomain::Wedge(height) => [at.x, at.y, height.at(at.z)],
        }
    }
}
