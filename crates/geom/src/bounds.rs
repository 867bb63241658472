//! Axis-parallel boxes.

use glam::DVec3;

/// An axis-parallel box, `{p : min ≤ p ≤ max}`; it may be flat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundingBox {
    /// The corner with the smallest coordinates.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

impl BoundingBox {
    /// The smallest box around the points; `None` without points or where one of them is not finite.
    ///
    /// ```
    /// use casteljau_geom::{BoundingBox, glam::DVec3};
    /// let b = BoundingBox::from_points([DVec3::ZERO, DVec3::new(3.0, 4.0, 0.0)]).unwrap();
    /// assert_eq!((b.diagonal(), b.center()), (5.0, DVec3::new(1.5, 2.0, 0.0)));
    /// ```
    pub fn from_points(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        let mut points = points.into_iter();
        let first = points.next().filter(|p| p.is_finite())?;
        points.try_fold(Self { min: first, max: first }, |b, p| {
            p.is_finite().then(|| Self { min: b.min.min(p), max: b.max.max(p) })
        })
    }

    /// Length of the diagonal, `|max − min|`: the *size* that tolerances refer to.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        self.size().length()
    }

    /// Extent along each axis, `max − min`.
    #[must_use]
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }

    /// The middle, halfway from `min` to `max`.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        // Halved before adding: no overflow.
        self.min * 0.5 + self.max * 0.5
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether a point lies in the box, its faces included.
    #[must_use]
    pub fn contains(&self, p: DVec3) -> bool {
        p.cmpge(self.min).all() && p.cmple(self.max).all()
    }

    /// The box with every face moved outwards by `margin`.
    #[must_use]
    pub fn grown(&self, margin: f64) -> Self {
        Self { min: self.min - DVec3::splat(margin), max: self.max + DVec3::splat(margin) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes() {
        assert_eq!(BoundingBox::from_points([]), None);
        assert_eq!(BoundingBox::from_points([DVec3::ZERO, DVec3::NAN]), None);
        let a = BoundingBox::from_points([DVec3::ZERO, DVec3::ONE]).unwrap();
        let b = BoundingBox::from_points([-DVec3::X]).unwrap();
        let both = a.union(&b);
        assert!(both.contains(DVec3::ZERO) && both.contains(-DVec3::X) && !a.contains(-DVec3::X));
        assert_eq!(both.size(), DVec3::new(2.0, 1.0, 1.0));
        assert!(a.grown(1.0).contains(-DVec3::X));
    }
}
