//! The oracle: sampling on a grid, then searching around the best samples by ever smaller steps.

use casteljau_shape::bernstein::TensorNet;
use casteljau_shape::geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_shape::{CurveProjector, PatchProjector, RationalCurve, RationalPatch};

/// A projector for the rational patch with such a net.
pub fn patch(degrees: [usize; 2], points: &[DVec4]) -> PatchProjector {
    PatchProjector::new(&RationalPatch::from_homogeneous(degrees, points).unwrap()).unwrap()
}

/// A projector for the rational curve with such control points.
pub fn curve(points: &[DVec4]) -> CurveProjector {
    CurveProjector::new(&RationalCurve::from_homogeneous(points).unwrap()).unwrap()
}

/// Samples along each axis of a patch; a curve gets the square of it.
const GRID: usize = 24;
/// Steps of a refinement, at most: on a plateau of rounding it would not end.
const STEPS: usize = 400;
/// So many of the best samples are refined.
const REFINED: usize = 4;

/// A homogeneous net; curves have the degrees (n, 0).
#[derive(Debug, Clone)]
pub struct Net {
    pub degrees: [usize; 2],
    pub points: Vec<DVec4>,
}

impl Net {
    pub fn point(&self, at: [f64; 2]) -> DVec3 {
        let p = TensorNet::validated(&self.points, self.degrees).value(at[0], at[1]);
        p.xyz() / p.w
    }

    /// Largest coordinate of a control point.
    pub fn largest(&self) -> f64 {
        self.points.iter().map(|p| (p.xyz() / p.w).abs().max_element()).fold(0.0, f64::max)
    }

    pub fn transformed(&self, scale: f64, shift: DVec3) -> Self {
        let map = |p: &DVec4| (p.xyz() * scale + shift * p.w).extend(p.w);
        Self { points: self.points.iter().map(map).collect(), ..*self }
    }

    /// The least distance that brute force finds.
    pub fn least_distance(&self, q: DVec3) -> f64 {
        let samples = if self.degrees[1] == 0 { [GRID * GRID, 0] } else { [GRID, GRID] };
        let step = samples.map(|n| if n == 0 { 0.0 } else { 1.0 / n as f64 });
        let mut found: Vec<(f64, [f64; 2])> = Vec::new();
        for i in 0..=samples[0] {
            for j in 0..=samples[1] {
                let at = [(i as f64 * step[0]).min(1.0), (j as f64 * step[1]).min(1.0)];
                found.push((self.point(at).distance(q), at));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found
            .iter()
            .take(REFINED)
            .map(|&start| self.refined(q, start, step, STEPS).0)
            .fold(f64::INFINITY, f64::min)
    }

    /// Moves to better neighbours, and halves the step where there is none.
    pub fn refined(
        &self,
        q: DVec3,
        start: (f64, [f64; 2]),
        mut step: [f64; 2],
        steps: usize,
    ) -> (f64, [f64; 2]) {
        let (mut least, mut at) = start;
        for _ in 0..steps {
            if step[0].max(step[1]) <= 1e-9 {
                break;
            }
            let mut moved = false;
            for [a, b] in [
                [-1.0, 0.0],
                [1.0, 0.0],
                [0.0, -1.0],
                [0.0, 1.0],
                [1.0, 1.0],
                [-1.0, -1.0],
                [1.0, -1.0],
                [-1.0, 1.0],
            ] {
                let next = [(at[0] + a * step[0]).clamp(0.0, 1.0), (at[1] + b * step[1]).clamp(0.0, 1.0)];
                let distance = self.point(next).distance(q);
                if distance < least {
                    (least, at, moved) = (distance, next, true);
                }
            }
            if !moved {
                step = step.map(|s| 0.5 * s);
            }
        }
        (least, at)
    }
}
