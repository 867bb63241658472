//! The sign of a Bernstein polynomial over the whole of its domain.
//!
//! A polynomial lies between the least and the largest of its Bernstein coefficients, and at a corner it is one of them.
//! If none is negative, then it is zero on a face of the domain exactly where all coefficients of that face are, and
//! positive everywhere else. Where some are negative the domain is cut, the worst part first: the coefficients come to the
//! values as the square of the width.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use casteljau_bernstein::glam::DVec2;
use casteljau_geom::UNIT_ROUNDOFF;

use super::feature::{Feature, vanishing};
use super::net::SolidDegrees;
use super::subdivision::{Cell, Place};
use crate::SolidError;

/// A polynomial with the errors of its coefficients.
pub(super) struct Coefficients<'a> {
    pub degrees: SolidDegrees,
    pub values: &'a [f64],
    /// Bounds on the errors.
    pub rounding: &'a [f64],
    /// What is this near to zero counts as zero.
    pub tolerances: &'a [f64],
}

/// What is known of the sign.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Sign {
    Positive,
    /// Zero on these features, positive elsewhere.
    PositiveExcept(Vec<Feature>),
    /// Certainly negative there; or zero everywhere, when `value` is 0.
    NotPositive {
        witness: [f64; 3],
        value: f64,
    },
    /// Between these in the worst part that is left.
    Undecided {
        near: [f64; 3],
        least: f64,
        largest: f64,
    },
}

impl Coefficients<'_> {
    /// The sign, for at most so many operations.
    pub fn sign(&self, operations: u64) -> Result<Sign, SolidError> {
        if self.values.iter().zip(self.rounding).all(|(v, r)| v > r) {
            return Ok(Sign::Positive);
        }
        let whole = Place::whole(self.degrees);
        let indices = self.degrees.indices();
        let zero = |place: usize| self.values[place].abs() <= self.tolerances[place];
        let mut present = 0_u64;
        for (_, &index) in indices.iter().enumerate().filter(|&(place, _)| !zero(place)) {
            present |= 1 << self.degrees.support(index);
        }
        if present == 0 {
            return Ok(Sign::NotPositive { witness: whole.center(), value: 0.0 });
        }
        let features = vanishing(self.degrees, present);
        // With zeros on the boundary nothing but a polynomial that is exactly zero there can be positive elsewhere;
        // without them there is nothing to round.
        let rounds = !features.is_empty();
        // One scale for a coefficient, so that its error stays in proportion: the tolerance, or its own size.
        let unit = 64.0 * UNIT_ROUNDOFF;
        let mut taken_for_zero = 0.0_f64;
        let root = self.values.iter().zip(self.tolerances).enumerate().map(|(place, (&v, &t))| {
            if rounds && zero(place) {
                taken_for_zero = taken_for_zero.max(v.abs() + self.rounding[place]);
                DVec2::ZERO
            } else {
                DVec2::new(v, (t / unit).max(v.abs()))
            }
        });
        let root = Cell { place: whole, coefficients: root.collect(), cuts: 0 };
        let search = Search { degrees: self.degrees, unit, taken_for_zero, features };
        search.run(root, operations)
    }
}

struct Search {
    degrees: SolidDegrees,
    /// Relative to its scale, a coefficient of the whole is within this.
    unit: f64,
    /// No coefficient larger than this was.
    taken_for_zero: f64,
    features: Vec<Feature>,
}

impl Search {
    fn run(self, root: Cell, operations: u64) -> Result<Sign, SolidError> {
        let mut waiting = BinaryHeap::new();
        let mut spent = 0_u64;
        let mut made = 0;
        // Halving a net reads it once for each of its degrees; looking at it once more for each axis.
        let highest = self.degrees.along().into_iter().fold(1, usize::max);
        let price = (4 * root.coefficients.len() * (highest + 8)) as u64;
        if let Some(sign) = self.judge(root, &mut waiting, &mut made) {
            return Ok(sign);
        }
        while let Some(worst) = waiting.pop() {
            spent += price;
            if spent > operations || worst.cell.cuts > MOST_CUTS {
                let cell = &worst.cell;
                let least =
                    cell.coefficients.iter().map(|c| c.x - self.error(cell, c)).fold(f64::INFINITY, f64::min);
                let largest =
                    cell.coefficients.iter().map(|c| c.x + self.error(cell, c)).fold(f64::MIN, f64::max);
                return Ok(Sign::Undecided { near: cell.place.center(), least, largest });
            }
            for half in worst.cell.halves(self.degrees)? {
                if let Some(sign) = self.judge(half, &mut waiting, &mut made) {
                    return Ok(sign);
                }
            }
        }
        Ok(if self.features.is_empty() { Sign::Positive } else { Sign::PositiveExcept(self.features) })
    }

    /// A negative corner ends the search; a cell with negative coefficients waits; one without is done.
    fn judge(&self, cell: Cell, waiting: &mut BinaryHeap<Waiting>, made: &mut usize) -> Option<Sign> {
        let certain = |c: &DVec2| c.x > self.error(&cell, c);
        let done = cell.coefficients.iter().all(|c| certain(c) || *c == DVec2::ZERO)
            && cell.coefficients.iter().any(certain);
        if done {
            return None;
        }
        for (index, at) in cell.place.corners(self.degrees) {
            let c = cell.coefficients[self.degrees.place(index)];
            if c.x < -self.error(&cell, &c) - self.taken_for_zero {
                return Some(Sign::NotPositive { witness: at, value: c.x });
            }
        }
        let least = cell.coefficients.iter().map(|c| c.x).fold(f64::INFINITY, f64::min);
        *made += 1;
        waiting.push(Waiting { least, number: *made, cell });
        None
    }

    /// A bound on the error of a coefficient: that of the whole, and one rounding for each step since.
    fn error(&self, cell: &Cell, c: &DVec2) -> f64 {
        let highest = self.degrees.along().into_iter().fold(0, usize::max);
        let steps = f64::from(cell.cuts) * highest as f64;
        1.001 * (self.unit + steps * UNIT_ROUNDOFF) * c.y
    }
}

/// Halves of halves of intervals are exact up to here in every direction.
const MOST_CUTS: u32 = 150;

/// A cell to be cut; the one with the most negative coefficient comes first, of equal ones the older.
struct Waiting {
    least: f64,
    number: usize,
    cell: Cell,
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        other.least.total_cmp(&self.least).then_with(|| other.number.cmp(&self.number))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Waiting {}
