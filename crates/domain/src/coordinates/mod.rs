//! Generalized barycentric coordinates λ₀ … λₙ₋₁ of a polygon, with first and second derivatives.
//!
//! All kinds satisfy Σ λᵢ = 1, Σ λᵢvᵢ = x, λᵢ(vⱼ) = δᵢⱼ, and are linear on each side.

mod harmonic;
mod lanes;
mod mean_value;
mod wachspress;
mod weights;

use casteljau_geom::glam::DVec2;

use self::harmonic::HarmonicCoordinates;
pub use self::harmonic::HarmonicOptions;
use self::mean_value::MeanValueCoordinates;
use self::wachspress::WachspressCoordinates;
use crate::{DomainError, Location, Polygon};

/// Highest order of derivatives.
pub(crate) const MAX_ORDER: usize = 2;

/// Rows a point has: 1, 3 or 6, in the order 1, u, v, uu, uv, vv.
#[inline(always)]
pub(crate) const fn rows(order: usize) -> usize {
    (order + 1) * (order + 2) / 2
}

/// Which coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum CoordinateKind {
    /// Wachspress: rational, positive, on convex polygons.
    Wachspress,
    /// Mean value: closed form on every simple polygon, may be negative on concave ones.
    MeanValue,
    /// Harmonic: the solution of Laplace's equation with linear boundary values; positive on every simple polygon.
    Harmonic,
}

/// Coordinates of one polygon, ready to be evaluated from any number of threads.
///
/// λᵢ is 1 at vertex i and linear on every side; side i runs from vertex i−1 to vertex i. Results are written point
/// after point into the caller's buffer: each point has 1, 3 or 6 rows (order 0, 1, 2) of n values, in the order
/// 1, ∂u, ∂v, ∂uu, ∂uv, ∂vv. Derivatives are with respect to the polygon's plane, in its unit of length.
/// A point's result has the same bits whatever the batch it is in, its place there, and the processor.
///
/// ```
/// use casteljau_domain::{Coordinates, Polygon, glam::dvec2};
/// let square = Polygon::new(vec![dvec2(0., 0.), dvec2(1., 0.), dvec2(1., 1.), dvec2(0., 1.)])?;
/// let coordinates = Coordinates::wachspress(square)?;
/// let mut rows = [0.0; 12];
/// coordinates.evaluate(&[dvec2(0.5, 0.25)], 1, &mut rows)?;
/// let expected = [0.375, 0.375, 0.125, 0.125, -0.75, 0.75, 0.25, -0.25, -0.5, -0.5, 0.5, 0.5];
/// assert!(rows.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15));
/// # Ok::<(), casteljau_domain::DomainError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Coordinates {
    polygon: Polygon,
    scheme: Scheme,
}

#[derive(Clone, Debug)]
enum Scheme {
    Wachspress(WachspressCoordinates),
    MeanValue(MeanValueCoordinates),
    Harmonic(Box<HarmonicCoordinates>),
}

impl Coordinates {
    /// Wachspress coordinates, `wᵢ = area(vᵢ₋₁, vᵢ, vᵢ₊₁) / (area(vᵢ₋₁, vᵢ, x)·area(vᵢ, vᵢ₊₁, x))`, normalised.
    ///
    /// Invariant under affine maps; derivatives exist everywhere, corners included.
    /// Error: [`DomainError::NotConvex`] with the corner; [`DomainError::StraightCorner`] where the interior angle is
    /// within 1e-8 of π, since the coordinate of such a corner vanishes inside the polygon.
    /// Cost of values: n divisions and 11n other operations a point.
    ///
    /// ```
    /// use casteljau_domain::{Coordinates, DomainError, Polygon, glam::dvec2};
    /// let dart = Polygon::new(vec![dvec2(0., 0.), dvec2(2., -1.), dvec2(1., 0.), dvec2(2., 1.)])?;
    /// assert!(matches!(Coordinates::wachspress(dart), Err(DomainError::NotConvex { corner: 2, .. })));
    /// let extra = Polygon::new(vec![dvec2(0., 0.), dvec2(1., 0.), dvec2(2., 0.), dvec2(0., 1.)])?;
    /// assert!(matches!(Coordinates::wachspress(extra), Err(DomainError::StraightCorner { corner: 1, .. })));
    /// # Ok::<(), DomainError>(())
    /// ```
    pub fn wachspress(polygon: Polygon) -> Result<Self, DomainError> {
        let scheme = Scheme::Wachspress(WachspressCoordinates::new(&polygon)?);
        Ok(Self { polygon, scheme })
    }

    /// Mean value coordinates, `wᵢ = (tan(αᵢ₋₁/2) + tan(αᵢ/2)) / |vᵢ − x|`, normalised.
    ///
    /// αᵢ is the signed angle from vᵢ to vᵢ₊₁ seen from x. Invariant under similarities, smooth except at the vertices
    /// (across open sides too), negative in parts of concave polygons. Never fails; a `Result` like its siblings.
    /// Error of values: about [`Coordinates::certificate`], up to the boundary. Error of k-th derivatives: about
    /// (size/r)ᵏ times that over sizeᵏ, r the distance to the nearest vertex; sides do no harm.
    /// Cost of values: n+1 square roots, 2n+1 divisions and 20n other operations a point.
    pub fn mean_value(polygon: Polygon) -> Result<Self, DomainError> {
        let scheme = Scheme::MeanValue(MeanValueCoordinates::new(&polygon));
        Ok(Self { polygon, scheme })
    }

    /// Harmonic coordinates, `Δλᵢ = 0` inside, linear on every side.
    ///
    /// Solved by least squares in analytic functions, enlarged until the certificate reaches `options.target`: poles,
    /// polynomials and the corner functions r^(jπ/ω) sin(jπθ/ω), on the polygon or on the parts into which it is cut.
    /// Non-negative up to the certificate. Values are exact on the sides; Σ λᵢ = 1 and Σ λᵢvᵢ = x hold to rounding.
    /// Error: [`DomainError::HarmonicAccuracy`] where the certificate stays above `options.limit`;
    /// [`DomainError::TooManySides`] above 64 sides; [`DomainError::BadOption`].
    /// Cost: milliseconds for polygons of up to ten sides of like length, up to seconds for folded and thin ones.
    ///
    /// ```
    /// use casteljau_domain::{Coordinates, HarmonicOptions, Polygon, glam::dvec2};
    /// let l = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)].map(|(u, v)| dvec2(u, v));
    /// let coordinates = Coordinates::harmonic(Polygon::new(l.to_vec())?, &HarmonicOptions::default())?;
    /// assert!(coordinates.certificate() <= 1e-8);
    /// let mut row = [0.0; 6];
    /// coordinates.evaluate(&[dvec2(0.5, 0.5)], 0, &mut row)?;
    /// assert!((row[2] - row[4]).abs() < 1e-8, "the L is symmetric about its diagonal");
    /// # Ok::<(), casteljau_domain::DomainError>(())
    /// ```
    pub fn harmonic(polygon: Polygon, options: &HarmonicOptions) -> Result<Self, DomainError> {
        let scheme = Scheme::Harmonic(Box::new(HarmonicCoordinates::new(&polygon, options)?));
        Ok(Self { polygon, scheme })
    }

    /// Largest difference from the linear boundary values that was found; 0 for closed forms.
    pub fn boundary_residual(&self) -> f64 {
        match &self.scheme {
            Scheme::Harmonic(c) => c.boundary_residual(),
            _ => 0.0,
        }
    }

    /// Which coordinates these are.
    pub fn kind(&self) -> CoordinateKind {
        match &self.scheme {
            Scheme::Wachspress(_) => CoordinateKind::Wachspress,
            Scheme::MeanValue(_) => CoordinateKind::MeanValue,
            Scheme::Harmonic(_) => CoordinateKind::Harmonic,
        }
    }

    /// The polygon.
    pub fn polygon(&self) -> &Polygon {
        &self.polygon
    }

    /// Number n of coordinates.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.polygon.len()
    }

    /// Bound on |computed λᵢ(x) − λᵢ(x)| for all i and all x inside; on sides and corners values are exact to 2u.
    ///
    /// For closed forms it bounds rounding alone, 32·n·u·extent/clearance
    /// ([`Polygon::clearance`]), for Wachspress divided by the sine of the least turn at a corner.
    pub fn certificate(&self) -> f64 {
        match &self.scheme {
            Scheme::Wachspress(c) => c.certificate(),
            Scheme::MeanValue(c) => c.certificate(),
            Scheme::Harmonic(c) => c.certificate(),
        }
    }

    /// Length of the part of a buffer that belongs to one point: rows(order)·n.
    pub fn stride(&self, order: usize) -> usize {
        rows(order.min(MAX_ORDER)) * self.len()
    }

    /// Coordinates and derivatives up to `order` at points of the closed polygon.
    ///
    /// Each point is located first ([`Polygon::locate`]). On a side and at a corner the values are the exact linear
    /// ones. Derivatives on a side are one-sided limits from inside.
    /// Error: a point outside, or not finite, with its index; derivatives at a corner (Wachspress excepted, which has
    /// them); order above 2; a buffer of the wrong length. After an error the buffer's contents are of no use.
    /// Cost: as [`Coordinates::evaluate_inside`] plus the location.
    ///
    /// ```
    /// use casteljau_domain::{Coordinates, DomainError, Polygon, glam::dvec2};
    /// let triangle = Polygon::new(vec![dvec2(0., 0.), dvec2(1., 0.), dvec2(0., 1.)])?;
    /// let coordinates = Coordinates::mean_value(triangle)?;
    /// let mut row = [0.0; 3];
    /// coordinates.evaluate(&[dvec2(0.25, 0.0)], 0, &mut row)?;
    /// assert_eq!(row, [0.75, 0.25, 0.0]);
    /// let wrong = coordinates.evaluate(&[dvec2(1.0, 1.0)], 0, &mut row).unwrap_err();
    /// assert_eq!(wrong, DomainError::OutsidePolygon { index: 0, point: [1.0, 1.0] });
    /// let wrong = coordinates.evaluate(&[dvec2(0.0, 0.0)], 1, &mut [0.0; 9]).unwrap_err();
    /// assert_eq!(wrong, DomainError::DerivativeAtCorner { corner: 0, position: [0.0, 0.0] });
    /// # Ok::<(), DomainError>(())
    /// ```
    pub fn evaluate(&self, points: &[DVec2], order: usize, out: &mut [f64]) -> Result<(), DomainError> {
        self.evaluate_inside(points, order, out)?;
        for (index, (&p, out)) in points.iter().zip(out.chunks_exact_mut(self.stride(order))).enumerate() {
            match self.polygon.locate(p) {
                Location::Inside(_) => {}
                Location::Side { side, t } => self.evaluate_side(side, t, order, out)?,
                Location::Corner(corner) => self.evaluate_corner(corner, order, out)?,
                Location::Outside => {
                    return Err(DomainError::OutsidePolygon { index, point: p.to_array() });
                }
            }
        }
        Ok(())
    }

    /// As [`Coordinates::evaluate`], for points that the caller knows to be inside: nothing is located.
    ///
    /// Finite at every finite point of the closed polygon: at a corner and on a side the values are exact to
    /// rounding, and derivatives at a corner are finite numbers without meaning. Outside the polygon the formulas
    /// are continued or not, without promise.
    /// Error: order above 2; a buffer of the wrong length. Allocates one work area a call.
    ///
    /// ```
    /// use casteljau_domain::{Coordinates, DomainError, Polygon, glam::dvec2};
    /// let triangle = Polygon::new(vec![dvec2(0., 0.), dvec2(1., 0.), dvec2(0., 1.)])?;
    /// let coordinates = Coordinates::mean_value(triangle)?;
    /// let wrong = coordinates.evaluate_inside(&[dvec2(0.2, 0.2)], 0, &mut [0.0; 4]).unwrap_err();
    /// assert_eq!(wrong, DomainError::CountMismatch { what: "numbers of room", given: 4, wanted: 3 });
    /// # Ok::<(), DomainError>(())
    /// ```
    pub fn evaluate_inside(
        &self,
        points: &[DVec2],
        order: usize,
        out: &mut [f64],
    ) -> Result<(), DomainError> {
        self.check_buffer(points.len(), order, out)?;
        match &self.scheme {
            Scheme::Wachspress(c) => weights::evaluate(c, points, order, out),
            Scheme::MeanValue(c) => weights::evaluate(c, points, order, out),
            Scheme::Harmonic(c) => c.evaluate_inside(points, order, out),
        }
        Ok(())
    }

    /// Coordinates and derivatives up to `order` at the place t on a side, 0 at vertex `side − 1`, 1 at vertex `side`.
    ///
    /// The values are exactly 1−t and t; derivatives are limits from inside.
    /// Error: a side or order that does not exist, t outside [0, 1], derivatives at a corner (t = 0 or 1; Wachspress
    /// excepted), a buffer of the wrong length.
    pub fn evaluate_side(
        &self,
        side: usize,
        t: f64,
        order: usize,
        out: &mut [f64],
    ) -> Result<(), DomainError> {
        let n = self.len();
        check_side(side, n)?;
        if !(0.0..=1.0).contains(&t) {
            return Err(DomainError::BadOption { option: "t", value: t, least: 0.0, most: 1.0 });
        }
        let start = (side + n - 1) % n;
        if t == 0.0 || t == 1.0 {
            return self.evaluate_corner(if t == 0.0 { start } else { side }, order, out);
        }
        self.evaluate_sides(&[(side, t)], order, out)
    }

    /// As [`Coordinates::evaluate_side`] at many places, each a side and a parameter strictly between its ends.
    ///
    /// Error: as there, and [`DomainError::BadOption`] for t = 0 and t = 1.
    pub fn evaluate_sides(
        &self,
        places: &[(usize, f64)],
        order: usize,
        out: &mut [f64],
    ) -> Result<(), DomainError> {
        let n = self.len();
        self.check_buffer(places.len(), order, out)?;
        for &(side, t) in places {
            check_side(side, n)?;
            if !(0.0 < t && t < 1.0) {
                return Err(DomainError::BadOption { option: "t", value: t, least: 0.0, most: 1.0 });
            }
        }
        if order > 0 {
            match &self.scheme {
                Scheme::Wachspress(c) => weights::evaluate(c, &self.places_on_sides(places), order, out),
                Scheme::MeanValue(c) => weights::evaluate(c, &self.places_on_sides(places), order, out),
                Scheme::Harmonic(c) => c.evaluate_sides(&self.polygon, places, order, out),
            }
        }
        for (&(side, t), out) in places.iter().zip(out.chunks_exact_mut(self.stride(order))) {
            out[..n].fill(0.0);
            out[(side + n - 1) % n] = 1.0 - t;
            out[side] = t;
        }
        Ok(())
    }

    fn places_on_sides(&self, places: &[(usize, f64)]) -> Vec<DVec2> {
        let place = |&(side, t): &(usize, f64)| {
            let [a, b] = self.polygon.side(side);
            a * (1.0 - t) + b * t
        };
        places.iter().map(place).collect()
    }

    /// Coordinates at a corner: 1 for the corner, 0 for the others.
    fn evaluate_corner(&self, corner: usize, order: usize, out: &mut [f64]) -> Result<(), DomainError> {
        self.check_buffer(1, order, out)?;
        let position = self.polygon.vertex(corner);
        if order > 0 {
            match &self.scheme {
                Scheme::Wachspress(c) => weights::evaluate(c, &[position], order, out),
                Scheme::MeanValue(_) | Scheme::Harmonic(_) => {
                    return Err(DomainError::DerivativeAtCorner { corner, position: position.to_array() });
                }
            }
        }
        out[..self.len()].fill(0.0);
        out[corner] = 1.0;
        Ok(())
    }

    fn check_buffer(&self, points: usize, order: usize, out: &[f64]) -> Result<(), DomainError> {
        if order > MAX_ORDER {
            let (value, most) = (order as f64, MAX_ORDER as f64);
            return Err(DomainError::BadOption { option: "order", value, least: 0.0, most });
        }
        let wanted = points.saturating_mul(self.stride(order));
        if out.len() != wanted {
            return Err(DomainError::CountMismatch { what: "numbers of room", given: out.len(), wanted });
        }
        Ok(())
    }
}

fn check_side(side: usize, sides: usize) -> Result<(), DomainError> {
    if side < sides {
        return Ok(());
    }
    let (value, most) = (side as f64, (sides - 1) as f64);
    Err(DomainError::BadOption { option: "side", value, least: 0.0, most })
}

/// Bound on the rounding of values, 32·n·u·extent/clearance.
///
/// Areas are rounded by 2u·extent², which a feature of width w turns into a relative error of u·extent/w in the
/// weights that matter near it.
fn rounding_bound(polygon: &Polygon) -> f64 {
    let n = polygon.len();
    let [low, high] = polygon.bounding_box();
    16.0 * f64::EPSILON * n as f64 * (high - low).max_element() / polygon.clearance()
}
