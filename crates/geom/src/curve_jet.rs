//! A point of a curve with its derivatives.

use glam::DVec3;

use crate::COLLAPSE;

/// A point of a curve and its derivatives up to order 3.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CurveJet {
    /// C(t)
    pub point: DVec3,
    /// C′(t)
    pub d1: DVec3,
    /// C″(t)
    pub d2: DVec3,
    /// C‴(t)
    pub d3: DVec3,
}

/// The moving frame of a curve with its curvatures: `T′ = κ|C′| N`, `N′ = |C′|(−κT + τB)`, `B′ = −τ|C′| N`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrenetFrame {
    /// Unit tangent T.
    pub tangent: DVec3,
    /// Principal normal N = B × T, the side to which the curve bends.
    pub normal: DVec3,
    /// Binormal B, the direction of C′ × C″: the normal of the osculating plane.
    pub binormal: DVec3,
    /// Curvature κ, positive, in 1/length.
    pub curvature: f64,
    /// Torsion τ, positive for a right-handed screw, in 1/length.
    pub torsion: f64,
}

impl From<[DVec3; 4]> for CurveJet {
    /// Point and derivatives of orders 1, 2, 3.
    fn from([point, d1, d2, d3]: [DVec3; 4]) -> Self {
        Self { point, d1, d2, d3 }
    }
}

impl CurveJet {
    /// Whether every number in the jet is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        [self.point, self.d1, self.d2, self.d3].iter().all(|v| v.is_finite())
    }

    /// The jet with respect to the parameter t/a, `dᵏ ↦ aᵏ dᵏ`.
    ///
    /// With a the length of the parameter interval derivatives are of the size of the curve, whatever the interval;
    /// the frame and the curvatures stay what they are.
    #[must_use]
    pub fn rescaled(&self, a: f64) -> Self {
        Self { point: self.point, d1: self.d1 * a, d2: self.d2 * a * a, d3: self.d3 * a * a * a }
    }

    /// Unit tangent `C′/|C′|`; `None` where C′ = 0.
    #[must_use]
    pub fn tangent(&self) -> Option<DVec3> {
        self.d1.try_normalize()
    }

    /// Curvature `κ = |C′ × C″| / |C′|³`, in 1/length, non-negative; `None` where C′ = 0.
    #[must_use]
    pub fn curvature(&self) -> Option<f64> {
        let speed = self.d1.length();
        let tangent = self.tangent()?;
        finite(tangent.cross(self.d2).length() / speed / speed)
    }

    /// Torsion `τ = det(C′, C″, C‴) / |C′ × C″|²`, in 1/length; `None` where C′ × C″ = 0.
    #[must_use]
    pub fn torsion(&self) -> Option<f64> {
        // Of unit vectors, so that squares of lengths can neither overflow nor vanish.
        let (speed, bend) = (self.d1.length(), self.d2.length());
        let binormal = self.d1.try_normalize()?.cross(self.d2.try_normalize()?);
        let square = binormal.length_squared();
        if square > 0.0 { finite(binormal.dot(self.d3 / speed) / bend / square) } else { None }
    }

    /// Tangent, principal normal and binormal, with curvature and torsion.
    ///
    /// `None` where the curve has no osculating plane: C′ = 0, C″ = 0, or the sine of their angle at most
    /// [`COLLAPSE`] (a straight stretch, but for rounding).
    /// Error: rounding, magnified by 1/sin² of the angle between C′ and C″.
    ///
    /// ```
    /// use casteljau_geom::{CurveJet, glam::DVec3};
    /// let circle = CurveJet { d1: DVec3::Y, d2: -DVec3::X, d3: -DVec3::Y, point: DVec3::X };
    /// let frame = circle.frenet_frame().unwrap();
    /// assert_eq!((frame.normal, frame.binormal), (-DVec3::X, DVec3::Z));
    /// assert_eq!((frame.curvature, frame.torsion), (1.0, 0.0));
    /// ```
    ///
    /// Source: do Carmo, *Differential Geometry of Curves and Surfaces*, sec. 1.5.
    #[must_use]
    pub fn frenet_frame(&self) -> Option<FrenetFrame> {
        let tangent = self.tangent()?;
        let bend = tangent.cross(self.d2.try_normalize()?);
        if bend.length() <= COLLAPSE {
            return None;
        }
        let binormal = bend.try_normalize()?;
        let (curvature, torsion) = (self.curvature()?, self.torsion()?);
        Some(FrenetFrame { tangent, normal: binormal.cross(tangent), binormal, curvature, torsion })
    }
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn helix() {
        // (3 cos t, 3 sin t, 4t): κ = 3/25, τ = 4/25.
        let jet = CurveJet {
            point: DVec3::new(3.0, 0.0, 0.0),
            d1: DVec3::new(0.0, 3.0, 4.0),
            d2: DVec3::new(-3.0, 0.0, 0.0),
            d3: DVec3::new(0.0, -3.0, 0.0),
        };
        let close = |a: Option<f64>, b: f64| assert!((a.unwrap() - b).abs() < 1e-16, "{a:?} {b}");
        close(jet.curvature(), 3.0 / 25.0);
        close(jet.torsion(), 4.0 / 25.0);
        close(jet.tangent().map(|t| t.z), 0.8);
        let point = CurveJet { point: DVec3::X, ..CurveJet::default() };
        assert_eq!((point.tangent(), point.curvature(), point.torsion()), (None, None, None));
    }
}
