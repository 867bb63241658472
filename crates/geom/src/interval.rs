//! Parameter intervals.

use crate::GeomError;

/// A parameter interval `[a, b]`, with finite a < b and finite length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    start: f64,
    end: f64,
}

impl Interval {
    /// The interval `[0, 1]`, on which Bézier shapes live.
    pub const UNIT: Self = Self { start: 0.0, end: 1.0 };

    /// The interval `[start, end]`.
    ///
    /// # Errors
    /// [`GeomError::Interval`] unless `start < end`, both and their difference finite.
    pub fn new(start: f64, end: f64) -> Result<Self, GeomError> {
        if start < end && (end - start).is_finite() {
            Ok(Self { start, end })
        } else {
            Err(GeomError::Interval { start, end })
        }
    }

    /// The first end, a.
    #[must_use]
    pub const fn start(&self) -> f64 {
        self.start
    }

    /// The second end, b.
    #[must_use]
    pub const fn end(&self) -> f64 {
        self.end
    }

    /// `b − a`, positive.
    #[must_use]
    pub const fn length(&self) -> f64 {
        self.end - self.start
    }

    /// Whether `a ≤ t ≤ b`.
    #[must_use]
    pub fn contains(&self, t: f64) -> bool {
        (self.start..=self.end).contains(&t)
    }

    /// `(1−s) a + s b`: from `[0, 1]` to this interval; the ends are met to the bit.
    #[must_use]
    pub fn at(&self, s: f64) -> f64 {
        self.start * (1.0 - s) + self.end * s
    }

    /// `(t − a)/(b − a)`: from this interval to `[0, 1]`, the inverse of [`at`](Self::at).
    #[must_use]
    pub fn local(&self, t: f64) -> f64 {
        (t - self.start) / self.length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_exact_and_nonsense_is_refused() {
        let i = Interval::new(0.1, 0.7).unwrap();
        assert_eq!((i.at(0.0), i.at(1.0), i.local(0.1), i.local(0.7)), (0.1, 0.7, 0.0, 1.0));
        assert!(i.contains(0.7) && !i.contains(f64::NAN) && !i.contains(0.8));
        for (a, b) in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (-1e308, 1e308)] {
            assert!(Interval::new(a, b).is_err(), "[{a}, {b}]");
        }
    }
}
