//! Bounds of scalar polynomials: by the hull at once, by their extremes to a wanted width.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use crate::line::{check_length, counts, line_starts, net_size, strides};
use crate::{BernsteinError, subdivide_along};

/// Unit roundoff.
const U: f64 = f64::EPSILON / 2.0;

/// So many coefficients are made by subdivision, and no more, in the search for one extreme.
const WORK_LIMIT: usize = 1 << 26;

/// The least and the largest coefficient: by the convex hull property all values over the domain lie between
/// them. `None` without coefficients, or where one is NaN.
///
/// For the bounds of a shape give the coefficients of one component after another. Cost: one pass.
///
/// ```
/// use casteljau_bernstein::hull_bounds;
/// assert_eq!(hull_bounds([1.0, -1.0, 3.0]), Some([-1.0, 3.0]));
/// ```
pub fn hull_bounds(coefficients: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let mut bounds: Option<[f64; 2]> = None;
    for x in coefficients {
        if x.is_nan() {
            return None;
        }
        let [low, high] = bounds.unwrap_or([x, x]);
        bounds = Some([low.min(x), high.max(x)]);
    }
    bounds
}

/// Certified enclosures of the extremes of a polynomial; see [`extremes`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremes {
    /// The least value lies between these two.
    pub minimum: [f64; 2],
    /// The largest value lies between these two.
    pub maximum: [f64; 2],
}

/// The minimum and maximum of a scalar polynomial over `[0, 1]ᴰ`, each enclosed within `tolerance`.
///
/// Branch and bound: the domain is halved where the least coefficient promises the least value, until values
/// found at corners prove that nothing smaller than that minus `tolerance` is left. Along axes on which a
/// piece is monotone only its face is kept. `D` = 1 is a polynomial on the interval, 2 and 3 are tensor products
/// in the order of their nets.
///
/// The enclosures are certified: rounding in the subdivision, `n·u` times the piece's largest coefficient for
/// each halving, is in them. They are wider than `tolerance` where that is below the rounding error, or where
/// an extreme is taken along whole curves or surfaces and the limit of 2²⁶ coefficients is reached; look at
/// their width. Cost: near a simple extreme each halving gains a factor 4; pieces are allocated.
///
/// ```
/// use casteljau_bernstein::extremes;
/// let wave = [0.0, 1.0, -1.0, 0.0]; // 3t(1−t)(1−2t), extremes ±√3/6
/// let found = extremes(&wave, [3], 1e-9)?;
/// assert!((found.maximum[0] - 3_f64.sqrt() / 6.0).abs() < 1e-9);
/// assert!(found.maximum[1] - found.maximum[0] <= 1e-9);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::Degree`]; [`BernsteinError::BufferLength`]; [`BernsteinError::Tolerance`] unless the
/// tolerance is positive; [`BernsteinError::Coefficient`] where one is not finite.
///
/// Source: Garloff, *The Bernstein algorithm*, Interval Computations 2, 1993.
pub fn extremes<const D: usize>(
    coefficients: &[f64],
    degrees: [usize; D],
    tolerance: f64,
) -> Result<Extremes, BernsteinError> {
    check_length("coefficients", coefficients.len(), net_size(degrees)?)?;
    check_finite(coefficients)?;
    check_tolerance(tolerance)?;
    let minimum = minimum(coefficients.to_vec(), degrees, tolerance)?;
    let negated = coefficients.iter().map(|c| -c).collect();
    let [low, high] = self::minimum(negated, degrees, tolerance)?;
    Ok(Extremes { minimum, maximum: [-high, -low] })
}

pub(crate) fn check_tolerance(tolerance: f64) -> Result<(), BernsteinError> {
    if tolerance > 0.0 { Ok(()) } else { Err(BernsteinError::Tolerance { tolerance }) }
}

pub(crate) fn check_finite(coefficients: &[f64]) -> Result<(), BernsteinError> {
    match coefficients.iter().position(|c| !c.is_finite()) {
        None => Ok(()),
        Some(place) => Err(BernsteinError::Coefficient { place, value: coefficients[place] }),
    }
}

/// A part of the domain, and the polynomial over it; degree 0 along axes that were given up.
struct Piece<const D: usize> {
    degrees: [usize; D],
    net: Vec<f64>,
    /// Every coefficient is so far from the true one at most.
    error: f64,
    /// No value on the piece is below this.
    lower: f64,
}

impl<const D: usize> Piece<D> {
    fn new(degrees: [usize; D], net: Vec<f64>, error: f64) -> Self {
        let lower = net.iter().copied().fold(f64::INFINITY, f64::min) - error;
        Self { degrees, net, error, lower }
    }

    /// The least value at a corner, which the polynomial does take but for `error`.
    fn at_corners(&self) -> f64 {
        let strides = strides(counts(self.degrees));
        (0..1_usize << D).fold(f64::INFINITY, |least, corner| {
            let place: usize =
                (0..D).map(|axis| (corner >> axis & 1) * self.degrees[axis] * strides[axis]).sum();
            least.min(self.net[place])
        })
    }

    /// Gives up the axes on which the coefficients only rise or only fall: the minimum is on a face.
    fn onto_faces(mut self) -> Self {
        for axis in 0..D {
            let (counts, n) = (counts(self.degrees), self.degrees[axis]);
            let stride = strides(counts)[axis];
            let (mut rises, mut falls) = (n > 0, n > 0);
            for start in line_starts(counts, counts, axis) {
                for i in 0..n {
                    let step = self.net[start + (i + 1) * stride] - self.net[start + i * stride];
                    rises &= step >= 0.0;
                    falls &= step <= 0.0;
                }
            }
            if rises || falls {
                let shift = if rises { 0 } else { n * stride };
                let face = line_starts(counts, counts, axis).map(|start| self.net[start + shift]).collect();
                let mut degrees = self.degrees;
                degrees[axis] = 0;
                self = Self::new(degrees, face, self.error);
            }
        }
        self
    }

    /// The axis along which neighbours differ most, and how large coefficients are.
    fn steepest(&self) -> (usize, f64) {
        let counts = counts(self.degrees);
        let (mut best, mut most) = (0, -1.0);
        for axis in (0..D).filter(|&axis| self.degrees[axis] > 0) {
            let stride = strides(counts)[axis];
            let variation = |start: usize| {
                (0..self.degrees[axis])
                    .map(|i| (self.net[start + (i + 1) * stride] - self.net[start + i * stride]).abs())
                    .sum::<f64>()
            };
            let steepest = line_starts(counts, counts, axis).map(variation).fold(0.0, f64::max);
            if steepest > most {
                (best, most) = (axis, steepest);
            }
        }
        (best, self.net.iter().fold(0.0, |m: f64, c| m.max(c.abs())))
    }

    fn halves(&self) -> Result<[Self; 2], BernsteinError> {
        let (axis, largest) = self.steepest();
        let (mut left, mut right) = (vec![0.0; self.net.len()], vec![0.0; self.net.len()]);
        subdivide_along(&self.net, self.degrees, axis, 0.5, &mut left, &mut right)?;
        // One addition is rounded in each of n levels; the factor covers the products of roundings.
        let error = self.error + halving_error(self.degrees[axis], largest);
        Ok([left, right].map(|net| Self::new(self.degrees, net, error)))
    }
}

/// What rounding can do to a coefficient when a polynomial of degree n is halved.
pub(crate) fn halving_error(degree: usize, largest: f64) -> f64 {
    (degree as f64 * U * 1.01).mul_add(largest, degree as f64 * f64::MIN_POSITIVE)
}

/// The heap gives the piece with the least lower bound first.
impl<const D: usize> Ord for Piece<D> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.lower.total_cmp(&self.lower)
    }
}

impl<const D: usize> PartialOrd for Piece<D> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<const D: usize> PartialEq for Piece<D> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<const D: usize> Eq for Piece<D> {}

fn minimum<const D: usize>(
    net: Vec<f64>,
    degrees: [usize; D],
    tolerance: f64,
) -> Result<[f64; 2], BernsteinError> {
    let whole = Piece::new(degrees, net, 0.0);
    let mut upper = whole.at_corners();
    // Lower bounds of pieces that rounding lets nothing more be known about.
    let mut settled = f64::INFINITY;
    let mut heap = BinaryHeap::from([whole.onto_faces()]);
    let mut work = 0;
    while let Some(piece) = heap.pop() {
        let lower = settled.min(piece.lower);
        let least = piece.at_corners();
        if upper - lower <= tolerance || work > WORK_LIMIT {
            return Ok([lower.min(upper), upper]);
        }
        if least - piece.lower <= 4.0 * piece.error || piece.degrees == [0; D] {
            settled = settled.min(piece.lower);
            continue;
        }
        work += 2 * piece.net.len();
        for half in piece.halves()? {
            upper = upper.min(half.at_corners() + half.error);
            if half.lower < upper.min(settled) {
                heap.push(half.onto_faces());
            }
        }
    }
    Ok([settled.min(upper), upper])
}
