//! A point of a surface with its derivatives, its normal and its tangent plane.

use glam::{DVec2, DVec3};

use crate::COLLAPSE;

/// A point of a surface and its partial derivatives up to order 2.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SurfaceJet {
    /// S(u,v)
    pub point: DVec3,
    /// ∂S/∂u
    pub du: DVec3,
    /// ∂S/∂v
    pub dv: DVec3,
    /// ∂²S/∂u²
    pub duu: DVec3,
    /// ∂²S/∂u∂v
    pub duv: DVec3,
    /// ∂²S/∂v²
    pub dvv: DVec3,
}

/// The plane `{p : normal · p = offset}`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentPlane {
    /// Unit normal.
    pub normal: DVec3,
    /// Signed distance of the plane from the origin, along the normal.
    pub offset: f64,
}

impl TangentPlane {
    /// Signed distance `normal · p − offset` of a point, positive on the normal's side.
    #[must_use]
    pub fn distance(&self, p: DVec3) -> f64 {
        self.normal.dot(p) - self.offset
    }
}

impl From<[DVec3; 6]> for SurfaceJet {
    /// Point and derivatives in the order 1, u, v, uu, uv, vv.
    fn from([point, du, dv, duu, duv, dvv]: [DVec3; 6]) -> Self {
        Self { point, du, dv, duu, duv, dvv }
    }
}

impl SurfaceJet {
    /// The jet with respect to the parameters (u/a, v/b), `∂ʲ⁺ᵏ ↦ aʲbᵏ ∂ʲ⁺ᵏ`.
    ///
    /// With a and b the lengths of the parameter intervals all derivatives become comparable with each other,
    /// as [`normal`](Self::normal) takes them to be; normals and curvatures stay what they are.
    #[must_use]
    pub fn rescaled(&self, [a, b]: [f64; 2]) -> Self {
        Self {
            point: self.point,
            du: self.du * a,
            dv: self.dv * b,
            duu: self.duu * (a * a),
            duv: self.duv * (a * b),
            dvv: self.dvv * (b * b),
        }
    }

    /// Whether every number in the jet is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        [self.point, self.du, self.dv, self.duu, self.duv, self.dvv].iter().all(|v| v.is_finite())
    }

    /// Unit normal `∂u × ∂v / |∂u × ∂v|` of a regular point.
    ///
    /// `None` where the first derivatives do not span a plane: `|∂u × ∂v| ≤ COLLAPSE·|∂u||∂v|`, or one of
    /// them is at most [`COLLAPSE`] times the largest derivative. [`normal_toward`](Self::normal_toward) goes
    /// on from there.
    #[must_use]
    pub fn normal(&self) -> Option<DVec3> {
        let least = COLLAPSE * self.largest();
        if self.du.length() <= least || self.dv.length() <= least {
            return None;
        }
        direction(self.du, self.dv)
    }

    /// Unit normal, or its limit along `inward` where the derivatives collapse.
    ///
    /// `inward` is a direction (a, b) in the parameter plane that leads from this point into the domain: at
    /// the collapsed edge v = 0 of a patch (0, 1), at v = 1 (0, −1). With `D = a ∂u + b ∂v`, `∂u × ∂v` at
    /// distance ε is
    /// `c₀ + ε c₁ + ε² c₂ + …`, `c₁ = D∂u × ∂v + ∂u × D∂v`, `c₂ = D∂u × D∂v` (if ∂u = ∂v = 0): the first of
    /// these vectors that does not vanish gives the normal. For an edge collapsed to a point that is `b ∂uv ×
    /// ∂v`.
    /// `None` where derivatives up to order 2 do not decide.
    ///
    /// Error in angle: rounding, or about [`COLLAPSE`] where the limit stands in for a regular normal.
    #[must_use]
    pub fn normal_toward(&self, inward: DVec2) -> Option<DVec3> {
        if let Some(normal) = self.normal() {
            return Some(normal);
        }
        let along = inward.try_normalize()?;
        let least = COLLAPSE * self.largest();
        let [du, dv] = [self.du, self.dv].map(|d| if d.length() <= least { DVec3::ZERO } else { d });
        let du_along = self.duu * along.x + self.duv * along.y;
        let dv_along = self.duv * along.x + self.dvv * along.y;
        if du == DVec3::ZERO && dv == DVec3::ZERO {
            return direction(du_along, dv_along);
        }
        let (first, second) = (du_along.cross(dv), du.cross(dv_along));
        let size = du_along.length() * dv.length() + du.length() * dv_along.length();
        unit_above(first + second, COLLAPSE * size)
    }

    /// Tangent plane through the point; `None` where [`normal`](Self::normal) is.
    #[must_use]
    pub fn tangent_plane(&self) -> Option<TangentPlane> {
        self.normal().map(|normal| TangentPlane { normal, offset: normal.dot(self.point) })
    }

    /// Length of the longest derivative.
    fn largest(&self) -> f64 {
        [self.du, self.dv, self.duu, self.duv, self.dvv].iter().map(|d| d.length()).fold(0.0, f64::max)
    }
}

/// Direction of a × b, where the two are not parallel.
fn direction(a: DVec3, b: DVec3) -> Option<DVec3> {
    // Of unit vectors, so that the product can neither overflow nor vanish.
    unit_above(a.try_normalize()?.cross(b.try_normalize()?), COLLAPSE)
}

fn unit_above(v: DVec3, least: f64) -> Option<DVec3> {
    if v.length() > least { v.try_normalize() } else { None }
}
