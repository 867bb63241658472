//! What can go wrong with jets and intervals.

use thiserror::Error;

/// Why a quantity of differential geometry does not exist.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum GeomError {
    /// The denominator of a rational shape vanishes: the point is a pole, or 0/0.
    ///
    /// ```
    /// use casteljau_geom::{CurveJet, GeomError, quotient_curve_jet};
    /// let refused = quotient_curve_jet(&CurveJet::default(), [0.0, 1.0, 0.0, 0.0], 0.0);
    /// assert_eq!(refused, Err(GeomError::Pole { denominator: 0.0, uncertainty: 0.0 }));
    /// ```
    #[error("the denominator is {denominator:e}, zero within its uncertainty of {uncertainty:.1e}")]
    Pole {
        /// The denominator found.
        denominator: f64,
        /// The bound on its error that the caller stated.
        uncertainty: f64,
    },

    /// A quotient is too large for f64, or was made of numbers that are not finite.
    ///
    /// ```
    /// use casteljau_geom::{CurveJet, GeomError, glam::DVec3, quotient_curve_jet};
    /// let numerator = CurveJet { point: DVec3::X, ..CurveJet::default() };
    /// let refused = quotient_curve_jet(&numerator, [1e-309, 0.0, 0.0, 0.0], 0.0);
    /// assert_eq!(refused, Err(GeomError::Overflow { denominator: 1e-309 }));
    /// ```
    #[error("dividing by the denominator {denominator:e} leaves the range of numbers")]
    Overflow {
        /// The denominator found.
        denominator: f64,
    },

    /// An interval does not go upwards between two finite numbers.
    ///
    /// ```
    /// use casteljau_geom::{GeomError, Interval};
    /// assert_eq!(Interval::new(1.0, 1.0), Err(GeomError::Interval { start: 1.0, end: 1.0 }));
    /// ```
    #[error("[{start}, {end}] is no interval: its ends must be finite and the first the smaller")]
    Interval {
        /// The first end.
        start: f64,
        /// The second end.
        end: f64,
    },
}
