//! The curve along a side, polynomial or rational.

use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_geom::{CurveJet, GeomError};
use casteljau_shape::{Curve, Parameters, ParametricCurve, RationalCurve, ShapeError};

use crate::side_key::SideKey;

/// Two parameters closer than this are not told apart in the search for poles.
const CLOSEST: f64 = 1.0 / (1u64 << 40) as f64;

/// A curve over `[0, 1]`; a rational one has no pole there.
#[derive(Clone, Debug)]
pub(crate) enum SideCurve {
    Polynomial(Curve),
    Rational(RationalCurve),
}

impl SideCurve {
    /// The curve in its canonical direction.
    ///
    /// # Errors
    /// A pole, proved by intervals: over each of them the weights of the curve's part have one sign, or it is shorter
    /// than 2⁻⁴⁰.
    pub fn new(key: &SideKey) -> Result<Self, ShapeError> {
        if let Some(points) = key.polynomial() {
            return Ok(Self::Polynomial(Curve::new(points)?));
        }
        let curve = RationalCurve::from_homogeneous(key.net.clone())?;
        let mut todo = vec![(curve.clone(), 0.0, 1.0)];
        while let Some((part, a, b)) = todo.pop() {
            if one_sign(part.control_points()) {
                continue;
            }
            let middle: f64 = 0.5 * (a + b);
            if b - a < CLOSEST {
                let source = GeomError::Pole { denominator: curve.weight(middle), uncertainty: b - a };
                return Err(ShapeError::Evaluation { at: Parameters::Curve(middle), source });
            }
            let (left, right) = part.split(0.5)?;
            todo.extend([(right, middle, b), (left, a, middle)]);
        }
        Ok(Self::Rational(curve))
    }

    pub fn degree(&self) -> usize {
        match self {
            Self::Polynomial(curve) => curve.degree(),
            Self::Rational(curve) => curve.degree(),
        }
    }

    pub fn point(&self, t: f64) -> Result<DVec3, ShapeError> {
        match self {
            Self::Polynomial(curve) => Ok(curve.point(t)),
            Self::Rational(curve) => curve.point(t),
        }
    }

    pub fn jet(&self, t: f64) -> Result<CurveJet, ShapeError> {
        match self {
            Self::Polynomial(curve) => Ok(curve.jet(t)),
            Self::Rational(curve) => curve.try_jet(t),
        }
    }

    /// Bound on the distance of C([a, b]) from its chord: |Σ B_i(Q_i − foot_i)| with feet on the chord and the end terms
    /// zero. Infinite where the weights over the interval have two signs.
    pub fn segment_bound(&self, a: f64, b: f64) -> Result<f64, ShapeError> {
        match self {
            Self::Polynomial(curve) => {
                let head = if b < 1.0 { curve.split(b)?.0 } else { curve.clone() };
                let part = if a > 0.0 { head.split(a / b)?.1 } else { head };
                Ok(inner_share(part.degree()) * farthest(part.control_points()))
            }
            Self::Rational(curve) => {
                let head = if b < 1.0 { curve.split(b)?.0 } else { curve.clone() };
                let part = if a > 0.0 { head.split(a / b)?.1 } else { head };
                let net = part.control_points();
                if !one_sign(net) {
                    return Ok(f64::INFINITY);
                }
                let points: Vec<DVec3> = net.iter().map(|p| p.xyz() / p.w).collect();
                // The inner basis functions' share in the denominator, which grows with theirs without weights.
                let n = part.degree();
                let inner = net.get(1..n).unwrap_or(&[]).iter().map(|p| p.w.abs()).fold(0.0, f64::max);
                let outer = net[0].w.abs().min(net[n].w.abs());
                let share = inner_share(n);
                let weighted = inner * share / (inner * share + outer * (1.0 - share));
                Ok(if n < 2 { 0.0 } else { weighted * farthest(&points) })
            }
        }
    }
}

/// The greatest sum of the Bernstein polynomials between the first and the last, 1 − 2^{1−n}.
fn inner_share(degree: usize) -> f64 {
    1.0 - 2f64.powi(1 - degree as i32)
}

/// The largest distance of a point from the segment between the first and the last.
fn farthest(points: &[DVec3]) -> f64 {
    let (start, chord) = (points[0], points[points.len() - 1] - points[0]);
    let square = chord.length_squared();
    let away = points.iter().map(|&p| {
        let along = if square > 0.0 { ((p - start).dot(chord) / square).clamp(0.0, 1.0) } else { 0.0 };
        p.distance(start + chord * along)
    });
    away.fold(0.0, f64::max)
}

/// Whether all weights are positive, or all negative.
fn one_sign(net: &[DVec4]) -> bool {
    net.iter().all(|p| p.w > 0.0) || net.iter().all(|p| p.w < 0.0)
}
