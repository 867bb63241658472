//! Arc length of curves, `L = ∫₀¹ |C′(t)| dt`, to a stated relative accuracy.
//!
//! The control vectors of C′ are halved again and again. A piece is settled in one of two ways:
//!
//! * *flat*: the length lies between that of the chord and that of the control polygon, whatever the curve
//!   does there. Once the two agree, or the polygon is too short to matter, their mean is the answer. Cusps
//!   end here: toward a root of C′ the pieces' lengths fall at least by four with each halving.
//! * *smooth*: all control vectors of C′ lie in a ball that keeps away from 0, so the speed is analytic
//!   around the piece. There Gauss's rule of 16 points converges by a constant factor a point, and the change
//!   from one application to two, one a half, bounds the error of the two by a wide margin.
//!
//! The errors of all pieces and a bound on the rounding are added up and compared with what was asked for.

use casteljau_bernstein::{derivative, subdivide, value};
use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::DVec3;

use crate::quadrature::gauss;
use crate::{Curve, ShapeError};

/// At most so many pieces are looked at. Cusps take about 60 each at 1e-12; the other pieces are few.
const MOST_PIECES: usize = 20_000;

/// Pieces are halved until the polynomials are this simple: the degree, divided by the number of pieces.
const DEGREE_A_PIECE: usize = 8;

impl Curve {
    /// Arc length `L = ∫₀¹ |C′(t)| dt`, with an error of at most `relative · L`.
    ///
    /// Works for every curve whose control points do not all coincide: with cusps, with C′ nearly 0, running
    /// back on itself. The unit is that of the control points. Halves the curve where it must; no piece is
    /// larger than its error allows, and at most 20,000 pieces are looked at. Cost: 2 µs for a smooth cubic
    /// at 1e-10, 7 µs with a cusp. The least `relative` that can be reached is some 20(n + 4)·u, u = 2⁻⁵³.
    ///
    /// # Errors
    /// [`ShapeError::Accuracy`] unless 0 < `relative` < 1, [`ShapeError::ZeroLength`] for a single point,
    /// [`ShapeError::ArcLength`] where the accuracy was not reached; it carries the one that was.
    ///
    /// Source: Gravesen, *Adaptive subdivision and the length and energy of Bézier curves*, 1997 (chord and
    /// polygon).
    pub fn arc_length(&self, relative: f64) -> Result<f64, ShapeError> {
        check_accuracy(relative)?;
        let differences: Vec<DVec3> = self.control_points().windows(2).map(|p| p[1] - p[0]).collect();
        let largest = differences.iter().map(|d| d.abs().max_element()).fold(0.0, f64::max);
        if largest == 0.0 {
            return Err(ShapeError::ZeroLength { control_points: self.control_points().len() });
        }
        // |C′| in units of the longest difference: lengths far from 1 neither overflow nor vanish when squared.
        let factor = self.degree() as f64;
        let hodograph: Vec<DVec3> = differences.iter().map(|&d| d / largest).collect();
        let (count, lower) = (hodograph.len(), lower_bound(&hodograph));
        let sum = Integral::new(relative, Piece::new(hodograph, 1.0), count, lower).run();
        let Some(sum) = sum else { return Err(ShapeError::Unbounded) };
        let rounding = (16.0 * (count + 4) as f64 + sum.pieces as f64) * UNIT_ROUNDOFF * sum.length;
        verdict(relative, factor * largest, &sum, rounding)
    }

    /// The integral of the speed by one quadrature rule over the whole curve, `Σ ½wᵢ |C′(½(1 + xᵢ))|`.
    ///
    /// The rule's (node, weight) pairs (xᵢ, wᵢ) live on [−1, 1]. There is no statement of error: this is for
    /// comparing with programs that use a fixed rule. [`arc_length`](Self::arc_length) is the one to trust.
    ///
    /// ```
    /// use casteljau_shape::{Curve, geom::glam::DVec3};
    /// let line = Curve::new(vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X])?;
    /// assert_eq!(line.arc_length_by_rule(&[(0.0, 2.0)]), 2.0); // the midpoint rule
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    #[must_use]
    pub fn arc_length_by_rule(&self, rule: &[(f64, f64)]) -> f64 {
        // Over [0, 1]: the length does not depend on the interval of the parameter.
        let speed = |s| derivative(self.control_points(), s, &mut [DVec3::ZERO]).length();
        rule.iter().map(|&(x, w)| 0.5 * w * speed(0.5 * (1.0 + x))).sum()
    }
}

/// A stretch of a curve whose length is sought.
pub(crate) trait Stretch: Sized {
    /// The length by one application of Gauss's rule.
    fn gauss(&self) -> f64;
    /// The two halves.
    fn halves(&self) -> [Self; 2];
    /// Lengths of the chord and of the control polygon, below and above the piece's length; `None` where the
    /// polygon bounds nothing.
    fn bounds(&self) -> Option<(f64, f64)>;
    /// Whether the speed is analytic well around the piece, so that Gauss's rule converges.
    fn is_smooth(&self) -> bool;
    /// Whether halving has come to its end.
    fn is_point(&self) -> bool;
}

/// A stretch of a polynomial curve: the control vectors of C′ over it, its share of [0, 1], and the integral of |C′|
/// by Gauss's rule.
struct Piece {
    vectors: Vec<DVec3>,
    width: f64,
    gauss: f64,
}

impl Piece {
    fn new(vectors: Vec<DVec3>, width: f64) -> Self {
        let speed = |t| value(&vectors, t).length();
        let gauss = width * gauss().map(|(s, w)| w * speed(s)).sum::<f64>();
        Self { vectors, width, gauss }
    }
}

impl Stretch for Piece {
    fn gauss(&self) -> f64 {
        self.gauss
    }

    fn halves(&self) -> [Self; 2] {
        let mut left = vec![DVec3::ZERO; self.vectors.len()];
        let mut right = left.clone();
        // The lengths agree by construction.
        let done = subdivide(&self.vectors, 0.5, &mut left, &mut right);
        debug_assert!(done.is_ok());
        [left, right].map(|vectors| Self::new(vectors, 0.5 * self.width))
    }

    fn bounds(&self) -> Option<(f64, f64)> {
        let share = self.width / self.vectors.len() as f64;
        let chord = self.vectors.iter().sum::<DVec3>().length();
        let polygon = self.vectors.iter().map(|d| d.length()).sum::<f64>();
        Some((share * chord, share * polygon))
    }

    // Whether the control vectors lie in a ball around their mean of half the radius that would reach 0.
    fn is_smooth(&self) -> bool {
        let mean = self.vectors.iter().sum::<DVec3>() / self.vectors.len() as f64;
        let radius = self.vectors.iter().map(|&d| d.distance(mean)).fold(0.0, f64::max);
        2.0 * radius <= mean.length()
    }

    fn is_point(&self) -> bool {
        false
    }
}

/// The running sum over the pieces that are settled, and the pieces that are not.
pub(crate) struct Integral<S> {
    /// Relative error allowed to one smooth piece.
    smooth: f64,
    /// Length below which a piece is settled whatever its shape.
    negligible: f64,
    open: Vec<S>,
    pub(crate) length: f64,
    /// A bound on the error of the length, but for rounding.
    pub(crate) error: f64,
    pub(crate) pieces: usize,
}

impl<S: Stretch> Integral<S> {
    /// For a curve with `count` control vectors, of a length of at least `lower`.
    pub(crate) fn new(relative: f64, whole: S, count: usize, lower: f64) -> Self {
        // |C′|² has at most 2(count − 1) roots, real or nearly so; about as many pieces end up negligible,
        // from both sides.
        let mut open = vec![whole];
        while open.len() * DEGREE_A_PIECE < count {
            open = open.iter().flat_map(S::halves).collect();
        }
        open.reverse();
        Self {
            smooth: (0.25 * relative).max(32.0 * UNIT_ROUNDOFF),
            negligible: 0.25 * relative * lower / (4 * count) as f64,
            open,
            length: 0.0,
            error: 0.0,
            pieces: 0,
        }
    }

    /// Settles piece after piece, from the start of the curve to its end.
    ///
    /// `None` where a piece has shrunk to a point and its control polygon still bounds nothing.
    pub(crate) fn run(mut self) -> Option<Self> {
        while let Some(piece) = self.open.pop() {
            self.pieces += 1;
            let bounds = piece.bounds();
            if let Some((chord, polygon)) = bounds {
                let spread = (polygon - chord).max(0.0);
                if spread <= self.negligible
                    || spread <= 4.0 * UNIT_ROUNDOFF * polygon
                    || self.pieces >= MOST_PIECES
                {
                    self.settle(0.5 * (chord + polygon), 0.5 * spread);
                    continue;
                }
            } else if piece.is_point() || self.pieces >= MOST_PIECES {
                return None;
            }
            let halves = piece.halves();
            let refined = halves[0].gauss() + halves[1].gauss();
            let change = (refined - piece.gauss()).abs();
            if bounds.is_some() && piece.is_smooth() && change <= self.smooth * refined {
                self.settle(refined, change);
            } else {
                let [first, second] = halves;
                self.open.extend([second, first]);
            }
        }
        Some(self)
    }

    fn settle(&mut self, length: f64, error: f64) {
        self.length += length;
        self.error += error;
    }
}

pub(crate) fn check_accuracy(relative: f64) -> Result<(), ShapeError> {
    if relative > 0.0 && relative < 1.0 { Ok(()) } else { Err(ShapeError::Accuracy { relative }) }
}

/// The length in model units, if it is as certain as was asked for.
pub(crate) fn verdict<S>(
    relative: f64,
    unit: f64,
    sum: &Integral<S>,
    rounding: f64,
) -> Result<f64, ShapeError> {
    let length = sum.length * unit;
    let reached = (sum.error + rounding) / sum.length;
    if reached <= relative {
        Ok(length)
    } else {
        Err(ShapeError::ArcLength { length, reached, relative, pieces: sum.pieces })
    }
}

/// A positive lower bound of ∫|C′|: the sum of the chords of 2(d+1) + 16 equal stretches, of which a curve of
/// degree d + 1 cannot make all vanish.
fn lower_bound(hodograph: &[DVec3]) -> f64 {
    // Control points of the curve itself, from those of its derivative.
    let mut point = DVec3::ZERO;
    let mut points = vec![point];
    for d in hodograph {
        point += d / hodograph.len() as f64;
        points.push(point);
    }
    let stretches = 2 * points.len() + 16;
    let mut last = DVec3::ZERO;
    let mut sum = 0.0;
    for i in 1..=stretches {
        let next = value(&points, i as f64 / stretches as f64);
        sum += next.distance(last);
        last = next;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A kink can lie where one application of the rule and two agree by chance, though both are wrong. The
    /// line that turns back at such a place must still get its length.
    #[test]
    fn agreement_by_chance_is_not_believed() {
        let hodograph = |turn: f64| vec![DVec3::X * -turn, DVec3::X * (1.0 - turn)];
        let change = |turn: f64| {
            let piece = Piece::new(hodograph(turn), 1.0);
            let [a, b] = piece.halves();
            a.gauss + b.gauss - piece.gauss
        };
        let mut met = 0;
        for k in 2..62 {
            let (mut a, mut b) = (f64::from(k) / 64.0, f64::from(k + 1) / 64.0);
            if change(a) * change(b) > 0.0 {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (a + b);
                if change(a) * change(middle) <= 0.0 { b = middle } else { a = middle }
            }
            let exact = 0.5 * (a * a + (1.0 - a) * (1.0 - a));
            let deceived = (Piece::new(hodograph(a), 1.0).gauss - exact).abs() > 1e-6 * exact;
            met += usize::from(deceived && change(a).abs() < 1e-12);
            let line = Curve::new(vec![DVec3::ZERO, DVec3::X * (-0.5 * a), DVec3::X * (0.5 - a)]);
            let length = line.and_then(|c| c.arc_length(1e-10)).unwrap();
            assert!((length - exact).abs() <= 1e-10 * exact, "turn at {a}: {length} instead of {exact}");
        }
        assert!(met > 0, "no deceptive place was met");
    }
}
