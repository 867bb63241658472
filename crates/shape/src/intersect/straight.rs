//! Lines, rays and segments.

use casteljau_geom::glam::DVec3;

use crate::{LARGEST_COORDINATE, ShapeError};

/// A straight line `p + s·d`, for s in a range: all of it, a ray, or a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StraightLine {
    origin: DVec3,
    direction: DVec3,
    range: [f64; 2],
}

impl StraightLine {
    /// The whole line through a point, in both directions.
    ///
    /// # Errors
    /// [`ShapeError::Direction`] for a direction that is zero or not finite, [`ShapeError::Query`] for a point out
    /// of range.
    pub fn line(origin: DVec3, direction: DVec3) -> Result<Self, ShapeError> {
        Self::new(origin, direction, [f64::NEG_INFINITY, f64::INFINITY])
    }

    /// The ray from a point, s ≥ 0.
    ///
    /// # Errors
    /// As for [`line`](Self::line).
    pub fn ray(origin: DVec3, direction: DVec3) -> Result<Self, ShapeError> {
        Self::new(origin, direction, [0.0, f64::INFINITY])
    }

    /// The segment between two points, 0 ≤ s ≤ 1.
    ///
    /// # Errors
    /// As for [`line`](Self::line); the points must differ.
    pub fn segment(start: DVec3, end: DVec3) -> Result<Self, ShapeError> {
        Self::new(start, end - start, [0.0, 1.0])
    }

    fn new(origin: DVec3, direction: DVec3, range: [f64; 2]) -> Result<Self, ShapeError> {
        for (axis, value) in origin.to_array().into_iter().enumerate() {
            if value.is_nan() || value.abs() > LARGEST_COORDINATE {
                return Err(ShapeError::Query { axis, value });
            }
        }
        let size = direction.abs().max_element();
        if direction.is_finite() && size > 0.0 && size <= LARGEST_COORDINATE {
            Ok(Self { origin, direction, range })
        } else {
            Err(ShapeError::Direction { direction })
        }
    }

    /// The point p at s = 0.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The direction d, by which s is measured.
    #[must_use]
    pub fn direction(&self) -> DVec3 {
        self.direction
    }

    /// `p + s·d`.
    #[must_use]
    pub fn point(&self, s: f64) -> DVec3 {
        self.origin + self.direction * s
    }

    /// The s of the foot of a point on the line.
    pub(super) fn parameter(&self, p: DVec3) -> f64 {
        // Scaled, so that squares stay in range.
        let size = self.direction.abs().max_element();
        let along = self.direction / size;
        (p - self.origin).dot(along) / along.length_squared() / size
    }

    /// Whether s is in the range, by at most `slack` beyond its ends.
    pub(super) fn reaches(&self, s: f64, slack: f64) -> bool {
        self.range[0] - slack <= s && s <= self.range[1] + slack
    }

    /// Two unit normals, orthogonal to the direction and to each other.
    pub(super) fn normals(&self) -> [DVec3; 2] {
        let along = (self.direction / self.direction.abs().max_element()).normalize();
        let first = along.any_orthonormal_vector();
        [first, along.cross(first)]
    }
}
