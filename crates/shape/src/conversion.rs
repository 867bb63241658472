//! Between the Bernstein and the power basis.

use casteljau_bernstein::{from_power, from_power_tensor, to_power, to_power_tensor};
use casteljau_geom::glam::DVec3;

use crate::error::check_points;
use crate::{Curve, Patch, PowerCurve, PowerPatch, ShapeError};

impl PowerCurve {
    /// The same curve over its interval in Bernstein form.
    ///
    /// Error of each control point: at most 4(n+2)·u times the sum of the absolute contributions of the coefficients;
    /// see [`from_power`].
    ///
    /// ```
    /// use casteljau_shape::{PowerCurve, geom::{Interval, glam::DVec3}};
    /// let parabola = PowerCurve::new([DVec3::ZERO, DVec3::X, DVec3::Y])?.with_interval(Interval::new(-1.0, 1.0)?);
    /// let curve = parabola.to_bezier()?;
    /// assert_eq!(curve.control_points(), [DVec3::new(-1., 1., 0.), DVec3::new(0., -1., 0.), DVec3::new(1., 1., 0.)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`] where a control point leaves the range.
    pub fn to_bezier(&self) -> Result<Curve, ShapeError> {
        let mut points = vec![DVec3::ZERO; self.coefficients().len()];
        let interval = self.interval();
        from_power(self.coefficients(), [interval.start(), interval.end()], &mut points)?;
        check_points(&points)?;
        Ok(Curve::checked(interval, points))
    }
}

impl Curve {
    /// The same curve over its interval in power form, `Σ aᵢ tⁱ`.
    ///
    /// Error of each coefficient: at most 4(n+2)·u times the sum of the absolute contributions of the control points,
    /// which grows as 3ⁿ over `[0, 1]` and faster where the interval is far from 0 for its length; see [`to_power`].
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`] where a coefficient leaves the range.
    pub fn to_power(&self) -> Result<PowerCurve, ShapeError> {
        let mut coefficients = vec![DVec3::ZERO; self.control_points().len()];
        let interval = self.interval();
        to_power(self.control_points(), [interval.start(), interval.end()], &mut coefficients)?;
        Ok(PowerCurve::new(coefficients)?.with_interval(interval))
    }
}

impl PowerPatch {
    /// The same patch over its rectangle in Bernstein form. Error as for [`PowerCurve::to_bezier`], with
    /// 4(m+n+4)·u.
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`] where a control point leaves the range.
    pub fn to_bezier(&self) -> Result<Patch, ShapeError> {
        let mut points = vec![DVec3::ZERO; self.coefficients().len()];
        let ends = self.intervals().map(|i| [i.start(), i.end()]);
        from_power_tensor(self.coefficients(), self.degrees(), ends, &mut points)?;
        check_points(&points)?;
        Ok(Patch::checked(self.intervals(), self.degrees(), points))
    }
}

impl Patch {
    /// The same patch over its rectangle in power form, `ΣΣ aᵢⱼ uⁱ vʲ`. Error as for [`Curve::to_power`], with
    /// 4(m+n+4)·u.
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`] where a coefficient leaves the range.
    pub fn to_power(&self) -> Result<PowerPatch, ShapeError> {
        let mut coefficients = vec![DVec3::ZERO; self.control_points().len()];
        let ends = self.intervals().map(|i| [i.start(), i.end()]);
        to_power_tensor(self.control_points(), self.degrees(), ends, &mut coefficients)?;
        Ok(PowerPatch::new(self.degrees(), coefficients)?.with_intervals(self.intervals()))
    }
}
