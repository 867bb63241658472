//! Real roots of a scalar polynomial on the interval, in certified enclosures.

use crate::bounds::{check_finite, check_tolerance, halving_error};
use crate::line::degree_of;
use crate::{BernsteinError, restrict, subdivide, value};

/// Unit roundoff.
const U: f64 = f64::EPSILON / 2.0;

/// What is certain about the roots in an enclosure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RootKind {
    /// Exactly one root, where the polynomial changes its sign with a slope that is not 0.
    Simple,
    /// A root at an end of the interval, exactly there, of this multiplicity.
    End(usize),
    /// An odd number of roots, counted with multiplicity: the sign changes from one end to the other.
    SignChange,
    /// The polynomial is 0 within rounding; there may be roots of even number, or none.
    Touch,
}

/// An enclosure `[start, end]` of roots in `[0, 1]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// The lower end of the enclosure.
    pub start: f64,
    /// The upper end of the enclosure.
    pub end: f64,
    /// What it holds for certain.
    pub kind: RootKind,
}

impl Root {
    /// The middle of the enclosure.
    #[must_use]
    pub fn middle(&self) -> f64 {
        0.5 * (self.start + self.end)
    }
}

/// All real roots in `[0, 1]`, in ascending order, in enclosures no longer than `tolerance` in the parameter where
/// rounding allows it.
///
/// Every root of the polynomial with the given coefficients, as they are, lies in one of the enclosures: pieces
/// are discarded only where all coefficients have the same sign by more than the rounding error that they carry,
/// at most `n·u` times the largest coefficient for each halving. By Descartes' rule of signs a piece with
/// one certain change of sign holds one simple root; it is then enclosed by regula falsi with
/// certified signs. Roots that cannot be told apart, because they are closer than `tolerance` or because the
/// polynomial between them is 0 within rounding (a root of multiplicity m is blurred to about `u^(1/m)`), share
/// an enclosure.
///
/// Cost: for a simple root a few halvings, 2n² operations each, and some ten evaluations; for a root that is not
/// simple log₂(1/tolerance) halvings. The result and the pieces are allocated.
///
/// ```
/// use casteljau_bernstein::{RootKind, roots};
/// let found = roots(&[-0.25, -0.25, 0.75], 1e-12)?; // t² − ¼
/// assert_eq!(found.len(), 1);
/// assert_eq!(found[0].kind, RootKind::Simple);
/// assert!(found[0].start <= 0.5 && 0.5 <= found[0].end && found[0].end - found[0].start <= 1e-12);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::NoPoints`]; [`BernsteinError::Degree`]; [`BernsteinError::Coefficient`] where one is not
/// finite; [`BernsteinError::Tolerance`] unless the tolerance is positive;
/// [`BernsteinError::ZeroPolynomial`] where all coefficients are 0 and every parameter is a root.
///
/// Source: Lane and Riesenfeld, *Bounds on a polynomial*, BIT 21, 1981.
pub fn roots(coefficients: &[f64], tolerance: f64) -> Result<Vec<Root>, BernsteinError> {
    degree_of(coefficients)?;
    check_finite(coefficients)?;
    check_tolerance(tolerance)?;
    let Some(first) = coefficients.iter().position(|&c| c != 0.0) else {
        return Err(BernsteinError::ZeroPolynomial);
    };
    let behind = coefficients.iter().rev().take_while(|&&c| c == 0.0).count();
    let inner = deflated(coefficients, first, behind);
    // Deflation rounds each coefficient a few times, once or twice for each factor of its ratio.
    let size = inner.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    let error = if first + behind > 0 { 4.0 * inner.len() as f64 * U * size } else { 0.0 };
    let search =
        Search { whole: &inner, absolute: &inner.iter().map(|c| c.abs()).collect::<Vec<_>>(), tolerance };

    let end = |at: f64, multiplicity: usize| {
        (multiplicity > 0).then_some(Root { start: at, end: at, kind: RootKind::End(multiplicity) })
    };
    let mut found: Vec<Root> = end(0.0, first).into_iter().collect();
    found.extend(search.run(error)?);
    found.extend(end(1.0, behind));
    Ok(found)
}

/// The polynomial without its factors tᶠ and (1−t)ᵇ: `Pᵢ₊f C(n, i+f)/C(m, i)` with m = n − f − b, up to a constant
/// factor.
fn deflated(coefficients: &[f64], first: usize, behind: usize) -> Vec<f64> {
    let n = coefficients.len() - 1;
    let m = n - first - behind;
    let mut ratio = 1.0;
    let inner = &coefficients[first..=n - behind];
    if first + behind == 0 {
        return inner.to_vec();
    }
    let scaled = inner.iter().enumerate().map(|(i, c)| {
        if i > 0 {
            // C(n,i+f)/C(n,i+f−1) over C(m,i)/C(m,i−1)
            ratio *= ((n + 1 - i - first) * i) as f64 / ((i + first) * (m + 1 - i)) as f64;
        }
        c * ratio
    });
    scaled.collect()
}

/// A part of the interval, and the polynomial over it.
struct Piece {
    start: f64,
    end: f64,
    net: Vec<f64>,
    /// Every coefficient is so far from the true one at most.
    error: f64,
}

/// What the signs of the coefficients say.
enum Signs {
    /// No root.
    Same,
    /// One simple root.
    OneChange,
    /// All coefficients are 0 within rounding.
    Nothing,
    Unknown,
}

impl Piece {
    fn signs(&self) -> Signs {
        let (mut certain, mut changes, mut last) = (0, 0, 0.0);
        for &c in self.net.iter().filter(|c| c.abs() > self.error) {
            certain += 1;
            changes += usize::from(last * c.signum() < 0.0);
            last = c.signum();
        }
        match (certain, changes) {
            (0, _) => Signs::Nothing,
            (all, 0) if all == self.net.len() => Signs::Same,
            (all, 1) if all == self.net.len() => Signs::OneChange,
            _ => Signs::Unknown,
        }
    }

    fn halves(&self) -> Result<[Self; 2], BernsteinError> {
        let (mut left, mut right) = (self.net.clone(), self.net.clone());
        subdivide(&self.net, 0.5, &mut left, &mut right)?;
        let largest = self.net.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        let error = self.error + halving_error(self.net.len() - 1, largest);
        let middle = 0.5 * (self.start + self.end);
        Ok([
            Self { start: self.start, end: middle, net: left, error },
            Self { start: middle, end: self.end, net: right, error },
        ])
    }
}

struct Search<'a> {
    whole: &'a [f64],
    absolute: &'a [f64],
    tolerance: f64,
}

impl Search<'_> {
    fn run(&self, error: f64) -> Result<Vec<Root>, BernsteinError> {
        let mut found: Vec<Root> = Vec::new();
        let mut stack = vec![Piece { start: 0.0, end: 1.0, net: self.whole.to_vec(), error }];
        // The sign before the pieces that are left, and the undecided ones next to each other.
        let mut before = self.sign(0.0);
        let mut cell: Option<[f64; 2]> = None;
        while let Some(piece) = stack.pop() {
            let signs = piece.signs();
            match signs {
                Signs::Same | Signs::OneChange => {
                    self.close(&mut cell, [before, piece.net[0]], &mut found)?;
                    before = piece.net[piece.net.len() - 1];
                    if matches!(signs, Signs::OneChange) {
                        found.push(self.refined(&piece));
                    }
                    continue;
                }
                // A root where two pieces meet leaves both: together they must not be too long.
                Signs::Unknown if piece.end - piece.start > (0.5 * self.tolerance).max(2.0 * U) => {
                    let [left, right] = piece.halves()?;
                    stack.push(right);
                    stack.push(left);
                    continue;
                }
                Signs::Unknown | Signs::Nothing => {}
            }
            // The stack gives the pieces from left to right, without gaps.
            let start = cell.map_or(piece.start, |[start, _]| start);
            cell = Some([start, piece.end]);
        }
        self.close(&mut cell, [before, self.sign(1.0)], &mut found)?;
        Ok(found)
    }

    /// Says what is certain about a cell, between two values of known sign, and appends it.
    fn close(
        &self,
        cell: &mut Option<[f64; 2]>,
        [before, after]: [f64; 2],
        found: &mut Vec<Root>,
    ) -> Result<(), BernsteinError> {
        let Some([start, end]) = cell.take() else { return Ok(()) };
        let changes = before < 0.0 && after > 0.0 || before > 0.0 && after < 0.0;
        let kind = if !changes {
            RootKind::Touch
        } else if self.is_monotone(start, end)? {
            RootKind::Simple
        } else {
            RootKind::SignChange
        };
        found.push(Root { start, end, kind });
        Ok(())
    }

    /// The sign at t where it is certain, otherwise 0.
    fn sign(&self, t: f64) -> f64 {
        let p = value(self.whole, t);
        if p.abs() > self.value_error(t) { p.signum() } else { 0.0 }
    }

    /// Deflation and evaluation together, `(4(n+1) + 4(n+2))·u·Σ|Bᵢ||Pᵢ|`.
    fn value_error(&self, t: f64) -> f64 {
        let n = self.whole.len() as f64;
        (8.0 * n + 8.0) * U * value(self.absolute, t) + n * f64::MIN_POSITIVE
    }

    /// Whether the derivative certainly keeps its sign.
    fn is_monotone(&self, start: f64, end: f64) -> Result<bool, BernsteinError> {
        let differences: Vec<f64> = self.whole.windows(2).map(|w| w[1] - w[0]).collect();
        let sums: Vec<f64> = self.absolute.windows(2).map(|w| w[1] + w[0]).collect();
        let (mut slope, mut scale) = (differences.clone(), sums.clone());
        restrict(&differences, [start, end], &mut slope)?;
        restrict(&sums, [start, end], &mut scale)?;
        let n = self.whole.len() as f64;
        let certain = |d: &f64, s: &f64| d.abs() > (8.0 * n + 8.0) * U * s;
        Ok(slope.iter().zip(&scale).all(|(d, s)| certain(d, s) && d.signum() == slope[0].signum()))
    }

    /// The one root of a piece, between ends of certain and opposite signs.
    fn refined(&self, piece: &Piece) -> Root {
        let n = piece.net.len() - 1;
        let ([mut low, mut high], [mut at_low, mut at_high]) =
            ([piece.start, piece.end], [piece.net[0], piece.net[n]]);
        let rising = at_low < 0.0;
        let mut side = 0.0;
        for round in 0..200 {
            let width = high - low;
            if width <= self.tolerance {
                break;
            }
            // Regula falsi, halved in the manner of Illinois; each third time the middle. Half the tolerance from an
            // end, so that a root at that end is closed in from its other side.
            let secant = low + width * (at_low / (at_low - at_high));
            let margin = 0.5 * self.tolerance.min(width);
            let t =
                if round % 3 == 2 { low + 0.5 * width } else { secant.clamp(low + margin, high - margin) };
            if t <= low || t >= high {
                break;
            }
            let p = value(self.whole, t);
            if p.abs() <= self.value_error(t) {
                [low, high] = self.around(t, low, high);
                break;
            }
            if (p < 0.0) == rising {
                (low, at_low) = (t, p);
                if side < 0.0 {
                    at_high *= 0.5;
                }
                side = -1.0;
            } else {
                (high, at_high) = (t, p);
                if side > 0.0 {
                    at_low *= 0.5;
                }
                side = 1.0;
            }
        }
        Root { start: low, end: high, kind: RootKind::Simple }
    }

    /// The least neighbourhood of t, by doubling, at whose ends the signs are certain.
    fn around(&self, t: f64, low: f64, high: f64) -> [f64; 2] {
        let mut radius = (0.25 * self.tolerance).max(2.0 * U);
        loop {
            let (a, b) = ((t - radius).max(low), (t + radius).min(high));
            let known = |x: f64, end: f64| x == end || self.sign(x) != 0.0;
            if known(a, low) && known(b, high) {
                return [a, b];
            }
            radius *= 2.0;
        }
    }
}
