use casteljau_geom::glam::DVec3;

use crate::{GbError, MAX_COORDINATE, MAX_DEGREE, MAX_LAYERS, Place};

/// One side's control points: `C_{j,k}`, j = 0…d along the side, k = 0…l−1 across it.
///
/// Row k = 0 is the Bézier curve of the side itself, the further rows prescribe the cross derivatives. Memory is row by
/// row, `[k][j]`. A ribbon defines the surface
///
/// `R(s, h) = Σ_{k<l} Σ_j C_{j,k} B_j^d(s) B_k^{2l−1}(h) / Σ_{k<l} B_k^{2l−1}(h)`,
///
/// which the patch meets along the side. `d` is 1 to [`MAX_DEGREE`], `l` is 1 to [`MAX_LAYERS`].
#[derive(Debug, Clone, PartialEq)]
pub struct Ribbon {
    degree: usize,
    layers: usize,
    points: Vec<DVec3>,
}

impl Ribbon {
    /// A ribbon from its control points, `control_points[k·(degree + 1) + j] = C_{j,k}`.
    ///
    /// # Errors
    /// Degree, layers or the number of points out of range; a point that is not finite or larger than
    /// [`MAX_COORDINATE`].
    ///
    /// ```
    /// use casteljau_gb::{GbError, Ribbon, glam::DVec3};
    /// let side = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE];
    /// assert_eq!(Ribbon::new(3, 1, side.to_vec())?.row(0), side);
    /// assert!(matches!(Ribbon::new(3, 2, side.to_vec()), Err(GbError::PointCount { expected: 8, found: 4, .. })));
    /// assert!(matches!(Ribbon::new(0, 1, side.to_vec()), Err(GbError::Degree { degree: 0 })));
    /// assert!(matches!(Ribbon::new(3, 7, side.to_vec()), Err(GbError::Layers { layers: 7 })));
    /// assert!(matches!(Ribbon::new(1, 1, vec![DVec3::ZERO, DVec3::NAN]), Err(GbError::Point { .. })));
    /// # Ok::<(), GbError>(())
    /// ```
    pub fn new(degree: usize, layers: usize, control_points: Vec<DVec3>) -> Result<Self, GbError> {
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(GbError::Degree { degree });
        }
        if !(1..=MAX_LAYERS).contains(&layers) {
            return Err(GbError::Layers { layers });
        }
        let (expected, found) = (layers * (degree + 1), control_points.len());
        if found != expected {
            return Err(GbError::PointCount { degree, layers, expected, found });
        }
        for (index, &point) in control_points.iter().enumerate() {
            check_point(Place::Ribbon { j: index % (degree + 1), k: index / (degree + 1) }, point)?;
        }
        Ok(Self { degree, layers, points: control_points })
    }

    /// Degree `d` along the side.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Layers `l` across the side; the blends across it have degree 2l − 1.
    pub fn layers(&self) -> usize {
        self.layers
    }

    /// All control points, row by row.
    pub fn control_points(&self) -> &[DVec3] {
        &self.points
    }

    /// The d + 1 points of layer `k`, none if there is no such layer.
    pub fn row(&self, k: usize) -> &[DVec3] {
        let width = self.degree + 1;
        self.points.get(k.saturating_mul(width)..(k.saturating_add(1)).saturating_mul(width)).unwrap_or(&[])
    }

    /// `C_{j,k}`.
    pub fn point(&self, j: usize, k: usize) -> Option<DVec3> {
        self.row(k).get(j).copied()
    }

    /// Moves `C_{j,k}`.
    ///
    /// # Errors
    /// No such point, or a point that [`Ribbon::new`] would refuse; the ribbon is then unchanged.
    pub fn set_point(&mut self, j: usize, k: usize, point: DVec3) -> Result<(), GbError> {
        if j > self.degree || k >= self.layers {
            return Err(GbError::NoSuchPoint { j, k, degree: self.degree, layers: self.layers });
        }
        check_point(Place::Ribbon { j, k }, point)?;
        self.points[k * (self.degree + 1) + j] = point;
        Ok(())
    }

    /// The same ribbon run from its other end, j ↦ d − j.
    pub fn reversed(&self) -> Self {
        let points = self.points.chunks_exact(self.degree + 1).flat_map(|row| row.iter().rev().copied());
        Self { degree: self.degree, layers: self.layers, points: points.collect() }
    }

    pub(crate) fn start(&self) -> DVec3 {
        self.points[0]
    }

    pub(crate) fn end(&self) -> DVec3 {
        self.points[self.degree]
    }

    /// Every point of row 0 is the same: the side has no length.
    pub(crate) fn collapsed(&self) -> bool {
        self.row(0).iter().all(|&p| p == self.start())
    }
}

/// Refuses what cannot be computed with.
pub(crate) fn check_point(place: Place, point: DVec3) -> Result<(), GbError> {
    let ordinary = point.to_array().iter().all(|x| x.abs() <= MAX_COORDINATE);
    if ordinary { Ok(()) } else { Err(GbError::Point { place, point }) }
}
