//! Conics: arcs of circles and ellipses, and conic sections by their tangents and a point.

use std::f64::consts::{FRAC_PI_2, PI};

use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_geom::{COLLAPSE, Interval, angle_degrees};

use crate::control_point::checked;
use crate::{RationalCurve, ShapeError};

/// An arc in one piece spans at most a right angle, up to rounding: its weights stay above √½.
const LARGEST_PIECE: f64 = FRAC_PI_2 * (1.0 + 1e-12);

impl RationalCurve {
    /// The conic from `start` to `end` whose tangents there meet in `corner`, in standard form, weights 1, w, 1.
    ///
    /// w < 1 gives an ellipse, w = 1 a parabola, w > 1 a hyperbola, w = 0 the chord; a negative w gives the
    /// complementary arc, with a pole for w ≤ −1. The shoulder point is `(M + w·corner)/(1 + w)`, M being the
    /// middle of the chord.
    ///
    /// ```
    /// use casteljau_shape::{RationalCurve, geom::glam::DVec3};
    /// let corner = DVec3::new(1.0, 1.0, 0.0);
    /// let circle = RationalCurve::conic(DVec3::X, corner, DVec3::Y, 0.5_f64.sqrt())?;
    /// assert!((circle.point(0.3)?.length() - 1.0).abs() < 1e-15);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`].
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 12.3.
    pub fn conic(start: DVec3, corner: DVec3, end: DVec3, weight: f64) -> Result<Self, ShapeError> {
        Self::new(&[start, corner, end], &[1.0, weight, 1.0])
    }

    /// The conic from `start` to `end`, tangents meeting in `corner`, that passes through `point`.
    ///
    /// With `point = τ₀ start + τ₁ corner + τ₂ end`, τ barycentric, `w = τ₁ / (2√(τ₀τ₂))`. Of a point off the
    /// plane its foot counts. The shoulder point gives the weight most accurately.
    ///
    /// # Errors
    /// [`ShapeError::Construction`] unless `start`, `corner` and `end` span a plane, and where τ₀τ₂ ≤ 0 (the
    /// point lies beyond the tangents), [`ShapeError::Coordinate`].
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 12.5.
    pub fn conic_through(start: DVec3, corner: DVec3, end: DVec3, point: DVec3) -> Result<Self, ShapeError> {
        let (a, b, q) = (start - corner, end - corner, point - corner);
        // q = τ₀ a + τ₂ b; the dual basis of (a, b) in their plane gives τ₀ and τ₂.
        let normal = a.cross(b);
        let square = normal.length_squared();
        let sine = normal.length() / (a.length() * b.length());
        if sine.is_nan() || sine <= COLLAPSE {
            return Err(ShapeError::Construction {
                what: "sine of the angle between the tangents",
                value: sine,
            });
        }
        let (t0, t2) = (q.cross(b).dot(normal) / square, a.cross(q).dot(normal) / square);
        let product = t0 * t2;
        if product.is_nan() || product <= 0.0 {
            return Err(ShapeError::Construction { what: "product τ₀τ₂ of the point", value: product });
        }
        Self::conic(start, corner, end, (1.0 - t0 - t2) / (2.0 * product.sqrt()))
    }

    /// The arc `center + cos θ x + sin θ y` for θ from 0 to `sweep`, in pieces of at most a right angle.
    ///
    /// `x` and `y` orthogonal and of one length r give a circle of radius r, other vectors an ellipse. Each
    /// piece is a quadratic in standard form over its share of `[0, 1]`, weights 1, cos(half its angle), 1;
    /// neighbours share their ends to the bit. A negative sweep runs the other way, one beyond 2π goes on.
    /// Error: the distance from the conic is at most 32u·(|x| + |y|), plus u·|center|.
    ///
    /// ```
    /// use casteljau_shape::{ParametricCurve, RationalCurve, geom::glam::DVec3};
    /// let arcs = RationalCurve::arc(DVec3::ZERO, DVec3::X, DVec3::Y, 3.0)?;
    /// assert_eq!(arcs.len(), 2);
    /// assert!(arcs[1].end().unwrap().distance(DVec3::new(3_f64.cos(), 3_f64.sin(), 0.0)) < 1e-15);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Construction`] unless `sweep` is finite, not 0, and at most 1000 turns;
    /// [`ShapeError::Coordinate`].
    pub fn arc(center: DVec3, x: DVec3, y: DVec3, sweep: f64) -> Result<Vec<Self>, ShapeError> {
        let pieces = piece_count(sweep)?;
        let at = |angle: f64| {
            let (sin, cos) = sin_cos(angle);
            center + x * cos + y * sin
        };
        let ends: Vec<DVec3> = (0..=pieces).map(|k| at(sweep * k as f64 / pieces as f64)).collect();
        let half = 0.5 * sweep / pieces as f64;
        let weight = half.cos();
        let piece = |k: usize| {
            let (sin, cos) = sin_cos(sweep * (k as f64 + 0.5) / pieces as f64);
            // The corner lies at distance 1/weight: times the weight, its homogeneous form needs no division.
            let corner = (center * weight + x * cos + y * sin).extend(weight);
            let net = checked(vec![ends[k].extend(1.0), corner, ends[k + 1].extend(1.0)])?;
            let interval = Interval::new(k as f64 / pieces as f64, (k + 1) as f64 / pieces as f64);
            Ok(Self::checked(interval.unwrap_or(Interval::UNIT), net))
        };
        (0..pieces).map(piece).collect()
    }

    /// The whole circle around `center` in the plane of `x` and `y`, as four quadratic arcs: [`arc`](Self::arc)
    /// of one turn. It closes to the bit.
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`].
    pub fn circle(center: DVec3, x: DVec3, y: DVec3) -> Result<Vec<Self>, ShapeError> {
        Self::arc(center, x, y, 2.0 * PI)
    }

    /// The whole circle (or ellipse) in one piece, a quintic with positive weights 5, 1, 1, 1, 1, 5.
    ///
    /// It runs from `center − y` through `center + x`, once around. The quintic is the lowest degree at which a full circle has
    /// positive weights.
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`].
    ///
    /// Source: Chou, "Higher order Bézier circles", Computer-Aided Design 27 (1995).
    pub fn full_circle(center: DVec3, x: DVec3, y: DVec3) -> Result<Self, ShapeError> {
        let net = [[0., -1., 5.], [4., -1., 1.], [2., 3., 1.], [-2., 3., 1.], [-4., -1., 1.], [0., -1., 5.]];
        let homogeneous =
            net.map(|[a, b, w]: [f64; 3]| -> DVec4 { ((center + x * a + y * b) * w).extend(w) });
        Self::from_homogeneous(homogeneous)
    }

    /// The circle arc through three points, from the first over the second to the third, in pieces of at most
    /// a right angle.
    ///
    /// # Errors
    /// [`ShapeError::Construction`] where the points lie on a line within rounding, [`ShapeError::Coordinate`].
    pub fn arc_through(start: DVec3, middle: DVec3, end: DVec3) -> Result<Vec<Self>, ShapeError> {
        let (a, b) = (middle - start, end - start);
        let normal = a.cross(b);
        let sine = normal.length() / (a.length() * b.length());
        if sine.is_nan() || sine <= COLLAPSE {
            return Err(ShapeError::Construction {
                what: "sine of the angle at the first point",
                value: sine,
            });
        }
        // The circumcentre relative to the first point.
        let offset =
            (b * a.length_squared() - a * b.length_squared()).cross(normal) / (2.0 * normal.length_squared());
        let (x, unit) = (-offset, normal.normalize());
        let y = unit.cross(x);
        let to_end = b - offset;
        let swept = angle_degrees(x, to_end).to_radians();
        let sweep = if y.dot(to_end) >= 0.0 { swept } else { 2.0 * PI - swept };
        Self::arc(start + offset, x, y, sweep)
    }
}

/// The number of equal pieces of at most a right angle.
pub(crate) fn piece_count(sweep: f64) -> Result<usize, ShapeError> {
    const MOST_TURNS: f64 = 1000.0;
    if sweep == 0.0 || !sweep.is_finite() || sweep.abs() > MOST_TURNS * 2.0 * PI {
        return Err(ShapeError::Construction { what: "sweep in radians", value: sweep });
    }
    Ok((sweep.abs() / LARGEST_PIECE).ceil() as usize)
}

/// Sine and cosine, exact at multiples of a right angle as f64 has them, so that circles close.
pub(crate) fn sin_cos(angle: f64) -> (f64, f64) {
    let quarters = (angle / FRAC_PI_2).round();
    if (angle - quarters * FRAC_PI_2).abs() > 4.0 * f64::EPSILON * angle.abs() {
        return angle.sin_cos();
    }
    match quarters.rem_euclid(4.0) as u8 {
        0 => (0.0, 1.0),
        1 => (1.0, 0.0),
        2 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}
