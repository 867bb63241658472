//! Polynomial tensor-product Bézier patches.

use casteljau_bernstein::TensorNet;
use casteljau_geom::glam::{DVec2, DVec3};
use casteljau_geom::{BoundingBox, SurfaceJet};

use crate::ShapeError;
use crate::error::{check_degree, check_points};

/// A polynomial tensor-product Bézier patch over `[0, 1]²`, `S(u,v) = Σᵢ Σⱼ Bᵢᵐ(u) Bⱼⁿ(v) Pᵢⱼ`.
///
/// The control points stand in memory with j, which runs with v, fastest. All are finite, and the degrees at
/// most [`MAX_DEGREE`](casteljau_bernstein::MAX_DEGREE).
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    degrees: [usize; 2],
    control_points: Vec<DVec3>,
}

impl Patch {
    /// The patch of degrees m with u and n with v; `Pᵢⱼ` is `control_points[i·(n+1) + j]`.
    ///
    /// # Errors
    /// [`ShapeError::Degree`], [`ShapeError::NetSize`], [`ShapeError::Coordinate`].
    pub fn new(degrees: [usize; 2], control_points: impl Into<Vec<DVec3>>) -> Result<Self, ShapeError> {
        let control_points = control_points.into();
        for degree in degrees {
            check_degree(degree)?;
        }
        let (needed, given) = ((degrees[0] + 1) * (degrees[1] + 1), control_points.len());
        if needed != given {
            return Err(ShapeError::NetSize { degrees, needed, given });
        }
        check_points(&control_points)?;
        Ok(Self { degrees, control_points })
    }

    /// Degrees m with u and n with v.
    #[must_use]
    pub fn degrees(&self) -> [usize; 2] {
        self.degrees
    }

    /// All control points, j fastest.
    #[must_use]
    pub fn control_points(&self) -> &[DVec3] {
        &self.control_points
    }

    /// Control point `Pᵢⱼ`; `None` beyond the net.
    #[must_use]
    pub fn control_point(&self, i: usize, j: usize) -> Option<DVec3> {
        let [m, n] = self.degrees;
        if i <= m && j <= n { self.control_points.get(i * (n + 1) + j).copied() } else { None }
    }

    /// Point `S(u,v)`; parameters outside the square continue the polynomial.
    ///
    /// Error: at most 4(m+n+2)·u·ΣΣ|Bᵢᵐ Bⱼⁿ Pᵢⱼ|, u = 2⁻⁵³. Cost: O(mn), no allocation.
    #[must_use]
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        self.net().value(u, v)
    }

    /// Point and partial derivatives up to order 2.
    ///
    /// Error: at most 4(m+n+2k+2)·u times the sum of the absolute contributions, k being the order. Cost:
    /// O(mn), no allocation.
    #[must_use]
    pub fn jet(&self, u: f64, v: f64) -> SurfaceJet {
        let mut partials = [DVec3::ZERO; 6];
        self.net().partials(u, v, &mut partials);
        let [point, du, dv, duu, duv, dvv] = partials;
        SurfaceJet { point, du, dv, duu, duv, dvv }
    }

    /// Unit normal `∂u × ∂v / |∂u × ∂v|`; where that collapses, its limit on the way to the middle of the
    /// square.
    ///
    /// `None` where derivatives up to order 2 do not decide; see [`SurfaceJet::normal_toward`].
    #[must_use]
    pub fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        self.jet(u, v).normal_toward(DVec2::new(0.5 - u, 0.5 - v))
    }

    /// The box around the control points; by the convex hull property it contains the patch over the square.
    #[must_use]
    pub fn bounding_box(&self) -> BoundingBox {
        let first = self.control_points[0];
        let point = BoundingBox { min: first, max: first };
        self.control_points.iter().fold(point, |b, &p| BoundingBox { min: b.min.min(p), max: b.max.max(p) })
    }

    fn net(&self) -> TensorNet<'_, DVec3> {
        TensorNet::validated(&self.control_points, self.degrees)
    }
}
