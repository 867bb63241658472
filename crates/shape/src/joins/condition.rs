//! When two curves join with continuous curvature, read off their control points.

use casteljau_geom::glam::DVec3;
use casteljau_geom::{COLLAPSE, angle_degrees};

use crate::Curve;

/// The conditions on control points for continuous curvature where one curve ends and another starts.
///
/// For cubics P and Q with P₃ = Q₀ it is necessary that P₂, P₃, Q₁ are collinear and P₁, P₂, P₃, Q₁, Q₂ coplanar.
/// That is not sufficient: it leaves the curvatures free. With h and d the distances of P₁ and Q₂ from the common
/// tangent, on one side of it, they agree if and only if `d/|Q₁−Q₀|² = h/|P₃−P₂|²`; for degrees n and m the
/// distances carry the factors (n−1)/n and (m−1)/m.
///
/// ```
/// use casteljau_shape::{CurvatureCondition, Curve, geom::glam::DVec3};
/// let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
/// let first = Curve::new([p(-2., 3.), p(-2., 1.), p(-1., 0.), p(0., 0.)])?;
/// let coplanar = Curve::new([p(0., 0.), p(2., 0.), p(3., 1.), p(5., 5.)])?; // the distance should be 4
/// let condition = CurvatureCondition::measure(&first, &coplanar).unwrap();
/// assert!(condition.is_necessary(1e-9) && !condition.is_sufficient(1e-9));
/// let right = first.continued_with_curvature(2.0, 0.5, &[p(5., 5.)])?;
/// assert!(CurvatureCondition::measure(&first, &right).unwrap().is_sufficient(1e-9));
/// # Ok::<(), casteljau_shape::ShapeError>(())
/// ```
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 11.2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvatureCondition {
    /// Distance of the end of the first curve from the start of the second, relative to the longer leg there.
    pub gap: f64,
    /// Sine of the angle between the legs Pₙ − Pₙ₋₁ and Q₁ − Q₀, 1 where it is above 90°: three collinear points.
    pub collinear: f64,
    /// Sine of the angle between the offsets of Pₙ₋₂ and Q₂ from the tangent, 1 where they lie on opposite sides; 0
    /// where one of them vanishes: five coplanar points.
    pub coplanar: f64,
    /// Difference of the two curvatures, relative to the larger: the ratio. 0 where both vanish.
    pub ratio: f64,
}

impl CurvatureCondition {
    /// Measures how the end of `first` and the start of `second` meet; `None` where one of the legs there vanishes,
    /// or a curve has a degree below 2.
    #[must_use]
    pub fn measure(first: &Curve, second: &Curve) -> Option<Self> {
        let ([.., inner, before, end], [start, after, outer, ..]) =
            (first.control_points(), second.control_points())
        else {
            return None;
        };
        let (leg, next) = (end - before, after - start);
        let (tangent, direction) = (leg.try_normalize()?, next.try_normalize()?);
        let (h, d) = (offset(inner - before, tangent), offset(outer - after, direction));
        let curvature = |offset: DVec3, leg: DVec3, degree: usize| {
            offset.length() / leg.length() / leg.length() * (degree - 1) as f64 / degree as f64
        };
        let (k, l) = (curvature(h, leg, first.degree()), curvature(d, next, second.degree()));
        let largest = k.max(l);
        Some(Self {
            gap: end.distance(*start) / leg.length().max(next.length()),
            collinear: sine(tangent, direction),
            coplanar: sine(h, d),
            ratio: if largest > 0.0 { (k - l).abs() / largest } else { 0.0 },
        })
    }

    /// Whether the necessary conditions hold within a relative tolerance: three points collinear, five coplanar.
    #[must_use]
    pub fn is_necessary(&self, relative: f64) -> bool {
        self.gap.max(self.collinear).max(self.coplanar) <= relative
    }

    /// Whether the curvature is continuous within a relative tolerance: the ratio is right, too.
    #[must_use]
    pub fn is_sufficient(&self, relative: f64) -> bool {
        self.is_necessary(relative) && self.ratio <= relative
    }
}

/// The part of v across the tangent; zero where it is rounding.
fn offset(v: DVec3, tangent: DVec3) -> DVec3 {
    let across = v - tangent * tangent.dot(v);
    if across.length() <= COLLAPSE * v.length() { DVec3::ZERO } else { across }
}

fn sine(a: DVec3, b: DVec3) -> f64 {
    let angle = angle_degrees(a, b);
    if angle > 90.0 { 1.0 } else { angle.to_radians().sin() }
}
