//! Polynomial curves and patches in the power basis.

use casteljau_bernstein::MAX_DEGREE;
use casteljau_geom::glam::DVec3;
use casteljau_geom::{CurveJet, Interval, SurfaceJet, multi_indices};

use crate::error::{check_degree, check_points};
use crate::{Parameters, ParametricCurve, ParametricSurface, ShapeError, SurfaceDomain};

/// A polynomial curve by its coefficients, `C(t) = Σ aᵢ tⁱ`, over an interval (`[0, 1]` unless given another).
///
/// The power basis serves exchange, not design: far from t = 0, and for high degrees, its coefficients cancel,
/// and that is what the error bound's scale says. Convert once and work with the [`Curve`](crate::Curve).
///
/// ```
/// use casteljau_shape::{PowerCurve, geom::glam::DVec3};
/// let parabola = PowerCurve::new([DVec3::ZERO, DVec3::X, DVec3::Y])?; // (t, t², 0)
/// assert_eq!(parabola.point(3.0), DVec3::new(3.0, 9.0, 0.0));
/// # Ok::<(), casteljau_shape::ShapeError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PowerCurve {
    interval: Interval,
    coefficients: Vec<DVec3>,
}

/// A polynomial patch by its coefficients, `S(u,v) = Σᵢ Σⱼ aᵢⱼ uⁱ vʲ`, over a rectangle (`[0, 1]²` unless given
/// another).
///
/// Coefficients stand in memory with j, which runs with v, fastest. See [`PowerCurve`] on its use.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerPatch {
    intervals: [Interval; 2],
    degrees: [usize; 2],
    coefficients: Vec<DVec3>,
}

impl PowerCurve {
    /// The curve with the coefficients `a₀ … aₙ` over `[0, 1]`.
    ///
    /// # Errors
    /// [`ShapeError::NoControlPoints`], [`ShapeError::Degree`], [`ShapeError::Coordinate`].
    pub fn new(coefficients: impl Into<Vec<DVec3>>) -> Result<Self, ShapeError> {
        let coefficients = coefficients.into();
        check_degree(coefficients.len().checked_sub(1).ok_or(ShapeError::NoControlPoints)?)?;
        check_points(&coefficients)?;
        Ok(Self { interval: Interval::UNIT, coefficients })
    }

    /// The same polynomial over another interval: another part of the same curve, at the same parameters.
    #[must_use]
    pub fn with_interval(self, interval: Interval) -> Self {
        Self { interval, ..self }
    }

    /// Degree n.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.coefficients.len() - 1
    }

    /// Coefficients `a₀ … aₙ`.
    #[must_use]
    pub fn coefficients(&self) -> &[DVec3] {
        &self.coefficients
    }

    /// The interval of the parameter.
    #[must_use]
    pub fn interval(&self) -> Interval {
        self.interval
    }

    /// Point `C(t)`, by Horner's rule.
    ///
    /// Error: at most 4(n+2)·u·Σ|aᵢ tⁱ|, u = 2⁻⁵³. Cost: O(n), no allocation.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec3 {
        horner(&self.coefficients, t, 0)
    }

    /// Point and derivatives up to order 3, `dᵏC/dtᵏ = Σ i!/(i−k)! aᵢ tⁱ⁻ᵏ`.
    ///
    /// Error: at most 4(n+2k+2)·u times the sum of the absolute terms. Cost: O(n), no allocation.
    #[must_use]
    pub fn jet(&self, t: f64) -> CurveJet {
        [0, 1, 2, 3].map(|order| horner(&self.coefficients, t, order)).into()
    }
}

impl ParametricCurve for PowerCurve {
    fn interval(&self) -> Interval {
        self.interval
    }

    fn extended_partials(&self, t: f64, out: &mut [DVec3]) -> Result<(), ShapeError> {
        Parameters::Curve(t).finite()?;
        for (order, derivative) in out.iter_mut().enumerate() {
            *derivative = horner(&self.coefficients, t, order);
        }
        Ok(())
    }

    fn weight(&self, _: f64) -> f64 {
        1.0
    }
}

impl PowerPatch {
    /// The patch of degrees m with u and n with v over `[0, 1]²`; `aᵢⱼ` is `coefficients[i·(n+1) + j]`.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`ShapeError::NetSize`], [`ShapeError::Coordinate`].
    pub fn new(degrees: [usize; 2], coefficients: impl Into<Vec<DVec3>>) -> Result<Self, ShapeError> {
        let coefficients = coefficients.into();
        for degree in degrees {
            check_degree(degree)?;
        }
        let (needed, given) = ((degrees[0] + 1) * (degrees[1] + 1), coefficients.len());
        if needed != given {
            return Err(ShapeError::NetSize { degrees, needed, given });
        }
        check_points(&coefficients)?;
        Ok(Self { intervals: [Interval::UNIT; 2], degrees, coefficients })
    }

    /// The same polynomial over another rectangle: another part of the same surface, at the same parameters.
    #[must_use]
    pub fn with_intervals(self, intervals: [Interval; 2]) -> Self {
        Self { intervals, ..self }
    }

    /// Degrees m with u and n with v.
    #[must_use]
    pub fn degrees(&self) -> [usize; 2] {
        self.degrees
    }

    /// Coefficients, j fastest.
    #[must_use]
    pub fn coefficients(&self) -> &[DVec3] {
        &self.coefficients
    }

    /// The intervals of u and of v.
    #[must_use]
    pub fn intervals(&self) -> [Interval; 2] {
        self.intervals
    }

    /// Point `S(u,v)`, by Horner's rule in both variables.
    ///
    /// Error: at most 4(m+n+2)·u·ΣΣ|aᵢⱼ uⁱ vʲ|, u = 2⁻⁵³. Cost: O(mn), no allocation.
    #[must_use]
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        self.partial([u, v], [0, 0])
    }

    /// Point and partial derivatives up to order 2.
    ///
    /// Error: at most 4(m+n+2k+2)·u times the sum of the absolute terms. Cost: O(mn), no allocation.
    #[must_use]
    pub fn jet(&self, u: f64, v: f64) -> SurfaceJet {
        [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]].map(|orders| self.partial([u, v], orders)).into()
    }

    fn partial(&self, [u, v]: [f64; 2], [a, b]: [usize; 2]) -> DVec3 {
        let rows = self.coefficients.rchunks(self.degrees[1] + 1).zip((a..=self.degrees[0]).rev());
        rows.fold(DVec3::ZERO, |sum, (row, i)| sum * u + horner(row, v, b) * falling(i, a))
    }
}

impl ParametricSurface for PowerPatch {
    fn domain(&self) -> SurfaceDomain {
        SurfaceDomain::Rectangle(self.intervals)
    }

    fn extended_partials(&self, u: f64, v: f64, out: &mut [DVec3]) -> Result<(), ShapeError> {
        Parameters::Surface([u, v]).finite()?;
        let order = out.len();
        for (partial, orders) in out.iter_mut().zip(multi_indices::<2>(order)) {
            *partial = self.partial([u, v], orders);
        }
        Ok(())
    }

    fn weight(&self, _: f64, _: f64) -> f64 {
        1.0
    }
}

/// `Σ i!/(i−k)! aᵢ tⁱ⁻ᵏ`, k being the order.
fn horner(coefficients: &[DVec3], t: f64, order: usize) -> DVec3 {
    let terms = coefficients.iter().enumerate().skip(order).rev();
    terms.fold(DVec3::ZERO, |sum, (i, &a)| sum * t + a * falling(i, order))
}

/// `i!/(i−k)!`, which no degree makes infinite before the derivative vanishes.
fn falling(i: usize, k: usize) -> f64 {
    debug_assert!(i <= MAX_DEGREE);
    (0..k.min(i + 1)).map(|j| (i - j) as f64).product()
}
