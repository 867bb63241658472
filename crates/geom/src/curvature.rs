//! Fundamental forms and curvatures, from a surface jet.

use glam::DVec3;

use crate::SurfaceJet;

/// First fundamental form `E du² + 2F du dv + G dv²`, in length².
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstForm {
    /// E = ∂u · ∂u
    pub e: f64,
    /// F = ∂u · ∂v
    pub f: f64,
    /// G = ∂v · ∂v
    pub g: f64,
}

/// Second fundamental form `L du² + 2M du dv + N dv²`, in length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SecondForm {
    /// L = n · ∂uu
    pub l: f64,
    /// M = n · ∂uv
    pub m: f64,
    /// N = n · ∂vv
    pub n: f64,
}

/// The curvatures of a surface at a regular point. Signs follow the normal `∂u × ∂v`: a sphere seen from
/// inside is positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curvatures {
    /// Gaussian curvature `K = κ₁κ₂`, in 1/length².
    pub gaussian: f64,
    /// Mean curvature `H = (κ₁ + κ₂)/2`, in 1/length.
    pub mean: f64,
    /// Principal curvatures κ₁ ≤ κ₂, in 1/length.
    pub principal: [f64; 2],
    /// Unit principal directions in space, orthogonal, with `directions[0] × directions[1]` the normal.
    /// At an umbilic (κ₁ = κ₂) every direction is principal, and `directions[1]` is that of ∂u.
    pub directions: [DVec3; 2],
}

impl SurfaceJet {
    /// First fundamental form, at any point.
    #[must_use]
    pub fn first_form(&self) -> FirstForm {
        FirstForm { e: self.du.dot(self.du), f: self.du.dot(self.dv), g: self.dv.dot(self.dv) }
    }

    /// Second fundamental form; `None` where [`normal`](SurfaceJet::normal) is.
    #[must_use]
    pub fn second_form(&self) -> Option<SecondForm> {
        let n = self.normal()?;
        Some(SecondForm { l: n.dot(self.duu), m: n.dot(self.duv), n: n.dot(self.dvv) })
    }

    /// Normal curvature `II(x)/I(x)` in the direction of a tangent vector, in 1/length, positive where the surface
    /// bends to the side of the normal `∂u × ∂v`.
    ///
    /// Of a direction off the tangent plane its foot counts. `None` where the normal is, where the foot vanishes,
    /// or where the answer leaves the range of numbers.
    ///
    /// ```
    /// use casteljau_geom::{SurfaceJet, glam::DVec3};
    /// let cylinder = SurfaceJet { du: DVec3::X, dv: DVec3::Y, duu: DVec3::Z, ..SurfaceJet::default() };
    /// assert_eq!(cylinder.normal_curvature(DVec3::X), Some(1.0));
    /// ```
    #[must_use]
    pub fn normal_curvature(&self, direction: DVec3) -> Option<f64> {
        let normal = self.normal()?;
        let along = (direction - normal * normal.dot(direction)).try_normalize()?;
        // The dual basis of (∂u, ∂v) in the tangent plane gives `along = a ∂u + b ∂v`.
        let area = self.du.cross(self.dv).dot(normal);
        let (a, b) = (along.cross(self.dv).dot(normal) / area, self.du.cross(along).dot(normal) / area);
        let bend = (self.duu * (a * a) + self.duv * (2.0 * a * b) + self.dvv * (b * b)).dot(normal);
        bend.is_finite().then_some(bend)
    }

    /// Gaussian, mean and principal curvatures with their directions, `κ = II(x)/I(x)` at its extremes.
    ///
    /// The second form is written in an orthonormal frame of the tangent plane, `e₁ = ∂u/|∂u|`, `e₂ = n ×
    /// e₁`, where it is the symmetric matrix (a b; b c); then `κ = (a+c)/2 ∓ √(((a−c)/2)² + b²)`. Error: a
    /// few u times (|a| + |b| + |c|), magnified by 1/sin² of the angle between ∂u and ∂v. `None` where the
    /// normal is, or where a curvature leaves the range of numbers.
    ///
    /// Source: do Carmo, *Differential Geometry of Curves and Surfaces*, sec. 3.3.
    #[must_use]
    pub fn curvatures(&self) -> Option<Curvatures> {
        let normal = self.normal()?;
        let SecondForm { l, m, n } = self.second_form()?;
        let length = self.du.length();
        let e1 = self.du.try_normalize()?;
        let e2 = normal.cross(e1);
        // ∂v = p e₁ + q e₂, hence e₂ = (∂v − (p/|∂u|) ∂u)/q.
        let (p, q) = (self.dv.dot(e1), self.dv.dot(e2));
        let r = p / length;
        let a = l / length / length;
        let b = (m - r * l) / length / q;
        let c = (n - 2.0 * r * m + r * r * l) / q / q;

        let mean = 0.5 * (a + c);
        let half = 0.5 * (a - c);
        let radius = half.hypot(b);
        let gaussian = a * c - b * b;
        // Angle of the direction of κ₂ from e₁: cos 2θ = half/radius, sin 2θ = b/radius.
        let (sin, cos) = (0.5 * b.atan2(half)).sin_cos();
        let second = e1 * cos + e2 * sin;
        let first = e1 * sin - e2 * cos;
        let curvatures = Curvatures {
            gaussian,
            mean,
            principal: [mean - radius, mean + radius],
            directions: [first, second],
        };
        let finite = gaussian.is_finite() && radius.is_finite() && mean.is_finite();
        finite.then_some(curvatures)
    }
}
