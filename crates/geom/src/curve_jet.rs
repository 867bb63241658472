//! A point of a curve with its derivatives.

use glam::DVec3;

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

impl CurveJet {
    /// Whether every number in the jet is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        [self.point, self.d1, self.d2, self.d3].iter().all(|v| v.is_finite())
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
        let binormal = self.d1.cross(self.d2);
        let square = binormal.length_squared();
        if square > 0.0 { finite(binormal.dot(self.d3) / square) } else { None }
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
