//! Arc length of rational curves, `L = ∫ |C′(t)| dt`, to a stated relative accuracy.
//!
//! As for polynomial curves a piece is settled when chord and control polygon agree, which bound its length where
//! its weights have one sign, or when it is smooth and two applications of Gauss's rule agree. `C′ = (N′w − Nw′)/w²`
//! is taken of N − cw, c being a point of the piece, so that nothing is lost far from the origin.

use casteljau_bernstein::{derivatives, subdivide, value};
use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};

use crate::arc_length::{Integral, Stretch, check_accuracy, verdict};
use crate::control_point::{has_hull, hull_box};
use crate::quadrature::gauss;
use crate::{ControlPoint, RationalCurve, ShapeError};

/// Pieces of this share of the interval are points.
const POINT: f64 = 1e-18;

impl RationalCurve {
    /// Arc length `L = ∫ |C′(t)| dt`, with an error of at most `relative · L`.
    ///
    /// Weights may be zero or negative, as long as there is no pole on the interval. The unit is that of the control
    /// points. Halves the curve where it must; at most 20,000 pieces are looked at. What rounding allows is some
    /// `20(n + 4)·u` of the length and `16(n + 2)·u` of the control polygon's extent a piece.
    ///
    /// ```
    /// use casteljau_shape::{RationalCurve, geom::glam::DVec3};
    /// let quarter = RationalCurve::new(&[DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y], &[1.0, 1.0, 2.0])?;
    /// assert!((quarter.arc_length(1e-12)? - std::f64::consts::FRAC_PI_2).abs() < 2e-12);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::Accuracy`] unless 0 < `relative` < 1, [`ShapeError::ZeroLength`] for a single point,
    /// [`ShapeError::Unbounded`] for a curve that has a pole, [`ShapeError::ArcLength`] where the accuracy was not
    /// reached; it carries the one that was.
    pub fn arc_length(&self, relative: f64) -> Result<f64, ShapeError> {
        check_accuracy(relative)?;
        let points = self.control_points();
        let count = points.len();
        // Seen from a point of the curve, or of its polygon; each coordinate is rounded once.
        let center = points.iter().find_map(|&p| p.euclidean()).ok_or(ShapeError::Unbounded)?;
        let seen = |p: &DVec4| (-center).extend(0.0).mul_add(DVec4::splat(p.w), *p);
        let net: Vec<DVec4> = points.iter().map(seen).collect();
        let extent = |net: &[DVec4]| {
            let distances = net.iter().filter(|p| p.w != 0.0).map(|p| (p.xyz() / p.w).length());
            distances.fold(0.0, f64::max)
        };
        let size =
            extent(&net).max(net.iter().map(|p| p.xyz().length()).fold(0.0, f64::max) * f64::MIN_POSITIVE);
        if size == 0.0 {
            return Err(ShapeError::ZeroLength { control_points: count });
        }
        // Lengths in units of the extent, weights in units of the largest: neither overflows nor vanishes.
        let largest = net.iter().map(|p| p.w.abs()).fold(0.0, f64::max);
        let scale = DVec3::splat(1.0 / size).extend(1.0) / largest;
        let net: Vec<DVec4> = net.iter().map(|&p| p * scale).collect();
        let lower = lower_bound(&net);
        let sum = Integral::new(relative, Piece::new(net, 1.0), count, lower).run();
        let Some(sum) = sum else { return Err(ShapeError::Unbounded) };
        if sum.length == 0.0 {
            return Err(ShapeError::ZeroLength { control_points: count });
        }
        let of_length = (16.0 * (count + 4) as f64 + sum.pieces as f64) * sum.length;
        let of_places = 16.0 * ((count + 1) * sum.pieces) as f64;
        verdict(relative, size, &sum, (of_length + of_places) * UNIT_ROUNDOFF)
    }
}

/// A stretch of a rational curve: its homogeneous control points, its share of the interval, and the integral of |C′|
/// by Gauss's rule.
struct Piece {
    points: Vec<DVec4>,
    width: f64,
    gauss: f64,
}

impl Piece {
    fn new(points: Vec<DVec4>, width: f64) -> Self {
        let gauss = if has_hull(&points) { gauss().map(|(s, w)| w * speed(&points, s)).sum() } else { 0.0 };
        Self { points, width, gauss }
    }
}

/// `|C′(s)| = |N′ − Cw′|/|w|`.
fn speed(points: &[DVec4], s: f64) -> f64 {
    let mut jet = [DVec4::ZERO; 2];
    derivatives(points, s, &mut jet);
    let [n, d] = jet;
    let p = n.xyz() / n.w;
    ((d.xyz() - p * d.w) / n.w).length()
}

impl Stretch for Piece {
    fn gauss(&self) -> f64 {
        self.gauss
    }

    fn halves(&self) -> [Self; 2] {
        let mut left = vec![DVec4::ZERO; self.points.len()];
        let mut right = left.clone();
        // The lengths agree by construction.
        let done = subdivide(&self.points, 0.5, &mut left, &mut right);
        debug_assert!(done.is_ok());
        [left, right].map(|points| Self::new(points, 0.5 * self.width))
    }

    fn bounds(&self) -> Option<(f64, f64)> {
        hull_box(&self.points)?;
        let place = |p: &DVec4| p.xyz() / p.w;
        let polygon = self.points.windows(2).map(|w| place(&w[0]).distance(place(&w[1]))).sum();
        let (first, last) = (self.points.first()?, self.points.last()?);
        Some((place(first).distance(place(last)), polygon))
    }

    // With D = ΔN − cΔw, all of `(N′w − Nw′)/n` lies in the ball around D̄w̄ whose radius is estimated here; half
    // the way to 0 at most, and the weights no farther from their mean.
    fn is_smooth(&self) -> bool {
        let count = self.points.len() as f64;
        let Some(bounds) = hull_box(&self.points) else { return false };
        let center = bounds.center();
        let differences = || self.points.windows(2).map(|p| p[1] - p[0]);
        let across = |d: DVec4| d.xyz() - center * d.w;
        let mean = differences().map(across).sum::<DVec3>() / (count - 1.0);
        let weight = self.points.iter().map(|p| p.w.abs()).sum::<f64>() / count;
        let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let spread = most(&mut differences().map(|d| across(d).distance(mean)));
        let uneven = most(&mut self.points.iter().map(|p| (p.w.abs() - weight).abs()));
        let steps = most(&mut differences().map(|d| d.w.abs()));
        let radius = spread * (weight + uneven)
            + mean.length() * uneven
            + bounds.diagonal() * (weight + uneven) * steps;
        2.0 * radius <= mean.length() * weight && 2.0 * uneven <= weight
    }

    fn is_point(&self) -> bool {
        self.width < POINT
    }
}

/// A lower bound of the length: the sum of the chords of 2n + 16 equal stretches, poles left out.
fn lower_bound(net: &[DVec4]) -> f64 {
    let stretches = 2 * net.len() + 16;
    let points = (0..=stretches).filter_map(|i| value(net, i as f64 / stretches as f64).euclidean());
    let places: Vec<DVec3> = points.collect();
    places.windows(2).map(|p| p[0].distance(p[1])).sum()
}
