//! How two curves, or two surfaces along an edge, meet.

use std::f64::consts::PI;

use casteljau_geom::glam::{DVec2, DVec3};
use casteljau_geom::{COLLAPSE, angle_degrees};

use crate::{ParametricCurve, ParametricSurface, PatchEdge, ShapeError, SurfaceDomain};

/// A largest value, and where it was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Maximum {
    /// The value.
    pub value: f64,
    /// Where: on an edge the share of the way along it, from 0 to 1; 0 for curves.
    pub at: f64,
}

/// The ratio α of the derivatives across, over the samples of an edge.
///
/// With D₁ the derivative of the first surface across the edge and out of it, D₂ that of the second across and into it,
/// and T the derivative along the edge, tangent planes agree where `D₂ = αD₁ + βT`. Of the parts of D₁ and D₂ across
/// T, `D⊥ = D − T(T·D)/|T|²`, it is `α = D₁⊥·D₂⊥/|D₁⊥|²`, which is the nearest ratio where the planes do not agree.
/// α > 0 is a smooth joint, α < 0 a fold. It depends on the parameters across, on a triangle that from the middle of
/// the edge to the opposite vertex; whether it is constant does not. At a joint of curves there is no T.
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., the chapter on geometric continuity of surfaces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrossRatio {
    /// The least α.
    pub least: f64,
    /// Where it was found, the share of the way along the edge.
    pub least_at: f64,
    /// The largest α.
    pub largest: f64,
    /// Where it was found.
    pub largest_at: f64,
}

impl CrossRatio {
    /// Whether α is the same at all samples, `largest − least` being at most `relative` times the larger of their
    /// absolute values.
    #[must_use]
    pub fn is_constant(&self, relative: f64) -> bool {
        self.largest - self.least <= relative * self.least.abs().max(self.largest.abs())
    }
}

/// How closely two shapes meet, in figures.
///
/// A figure is missing where derivatives vanish all along, so that nothing can be said. Along an edge they are
/// largest values of samples: nothing is proved about what lies between.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JoinReport {
    /// Distance, in model units: C⁰ and G⁰.
    pub gap: Maximum,
    /// Distance of the first derivatives across, relative to the longer of them: C¹.
    pub first: Option<Maximum>,
    /// Angle of the tangents, or of the tangent planes, in degrees from 0 to 180 (a cusp, a fold): G¹.
    pub angle: Option<Maximum>,
    /// Distance of the second derivatives across, relative to the longest of them and of the first derivatives
    /// over the length of the interval: C².
    pub second: Option<Maximum>,
    /// Distance of the curvature vectors, or difference of the normal curvatures across the edge, relative to the
    /// larger of them and 1/size, size being the extent of the shapes at the joint: G².
    pub curvature: Option<Maximum>,
    /// The least and largest ratio of the derivatives across; missing where at every sample the edge's own derivative
    /// vanishes, or that of the first shape across it.
    pub ratio: Option<CrossRatio>,
    /// The number of samples.
    pub samples: usize,
    /// The number of samples at which some figure could not be taken.
    pub undecided: usize,
}

/// What counts as met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JoinTolerance {
    /// Largest gap, in model units.
    pub gap: f64,
    /// Largest angle, in degrees.
    pub angle: f64,
    /// Largest relative difference of derivatives and curvatures.
    pub relative: f64,
}

/// Which continuities hold. Each includes those below it: C² ⇒ C¹ ⇒ C⁰, C² ⇒ G² ⇒ G¹ ⇒ G⁰ = C⁰ (C¹ ⇒ G¹ where
/// derivatives do not vanish).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Continuity {
    /// The points agree.
    pub c0: bool,
    /// The first derivatives agree.
    pub c1: bool,
    /// The tangents or tangent planes agree.
    pub g1: bool,
    /// The second derivatives agree.
    pub c2: bool,
    /// The curvatures agree.
    pub g2: bool,
}

impl JoinReport {
    /// How the end of `first` and the start of `second` meet.
    ///
    /// For other ends reverse a curve first.
    ///
    /// ```
    /// use casteljau_shape::{Curve, JoinReport, JoinTolerance, geom::glam::DVec3};
    /// let line = Curve::new([DVec3::NEG_X, DVec3::ZERO])?;
    /// let bend = Curve::new([DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)])?;
    /// let report = JoinReport::of_curves(&line, &bend)?;
    /// let met = report.continuity(&JoinTolerance { gap: 1e-9, angle: 1e-6, relative: 1e-9 });
    /// assert!(met.c0 && met.g1 && !met.c1 && !met.g2);
    /// assert_eq!(report.first.unwrap().value, 0.5);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`try_jet`](ParametricCurve::try_jet): a pole at the joint.
    pub fn of_curves(first: &dyn ParametricCurve, second: &dyn ParametricCurve) -> Result<Self, ShapeError> {
        let (before, after) = (first.interval(), second.interval());
        let (a, b) = (first.try_jet(before.end())?, second.try_jet(after.start())?);
        let mut figures = Figures::default();
        figures.gap.raise(a.point.distance(b.point), 0.0);
        let lengths = [before.length(), after.length()];
        figures.derivatives([a.d1, b.d1], [a.d2, b.d2], lengths, 0.0);
        figures.ratio(nearest_ratio(a.d1, b.d1), 0.0);
        let size = (a.d1.length() * lengths[0]).max(b.d1.length() * lengths[1]);
        let (tangents, bends) = ((a.tangent(), b.tangent()), (bend(&a), bend(&b)));
        if let (Some(s), Some(t)) = tangents {
            figures.angle.raise(angle_degrees(s, t), 0.0);
        }
        if let (Some(s), Some(t)) = bends {
            figures.curvature.raise(s.distance(t) / s.length().max(t.length()).max(1.0 / size), 0.0);
        }
        figures.undecided = usize::from(figures.angle.0.is_none() || figures.curvature.0.is_none());
        Ok(figures.report(1))
    }

    /// How two surfaces meet along an edge that both have, at `samples` places, at least 2, which are denser toward
    /// the ends and include them.
    ///
    /// Both edges must run the same way: see [`SurfaceEdge::reversed`]. Derivatives across are taken with respect
    /// to the surfaces' own parameters, out of the first and into the second. Where two surfaces share a curve and
    /// its tangent planes, equal normal curvature across the curve is equal curvature in every direction.
    ///
    /// # Errors
    /// Those of [`try_jet`](ParametricSurface::try_jet): a pole on the edge.
    ///
    /// Source: Pegna and Wolter, "Geometrical criteria to guarantee curvature continuity of blend surfaces", J.
    /// Mech. Design 114 (1992).
    pub fn along_edge(
        first: &SurfaceEdge<'_>,
        second: &SurfaceEdge<'_>,
        samples: usize,
    ) -> Result<Self, ShapeError> {
        let count = samples.max(2);
        let mut figures = Figures::default();
        for k in 0..count {
            let s = (0.5 * PI * k as f64 / (count - 1) as f64).sin().powi(2);
            let (a, b) = (first.sample(s, -1.0)?, second.sample(s, 1.0)?);
            figures.gap.raise(a.point.distance(b.point), s);
            if first.across.is_some() && second.across.is_some() {
                figures.derivatives([a.first, b.first], [a.second, b.second], [a.extent, b.extent], s);
            }
            figures.ratio(across(a.first, a.along).and_then(|d| nearest_ratio(d, b.first)), s);
            let (Some(normal), Some(other)) = (a.normal, b.normal) else {
                figures.undecided += 1;
                continue;
            };
            figures.angle.raise(angle_degrees(normal, other), s);
            let (Some(k), Some(l)) = (a.curvature, b.curvature) else {
                figures.undecided += 1;
                continue;
            };
            let size = (a.first.length() * a.extent).max(b.first.length() * b.extent);
            figures.curvature.raise((k - l).abs() / k.abs().max(l.abs()).max(1.0 / size), s);
        }
        Ok(figures.report(count))
    }

    /// Which continuities the figures amount to, within a tolerance. A missing figure counts as not met.
    #[must_use]
    pub fn continuity(&self, tolerance: &JoinTolerance) -> Continuity {
        let within = |figure: Option<Maximum>, most: f64| figure.is_some_and(|m| m.value <= most);
        let c0 = self.gap.value <= tolerance.gap;
        let g1 = c0 && within(self.angle, tolerance.angle);
        let c1 = c0 && within(self.first, tolerance.relative);
        let c2 = c1 && within(self.second, tolerance.relative);
        let g2 = g1 && within(self.curvature, tolerance.relative);
        Continuity { c0, c1, g1, c2, g2 }
    }
}

/// Curvature vector `κN = (C″ − T(T·C″))/|C′|²`.
fn bend(jet: &casteljau_geom::CurveJet) -> Option<DVec3> {
    let (tangent, speed) = (jet.tangent()?, jet.d1.length());
    let bend = (jet.d2 - tangent * tangent.dot(jet.d2)) / speed / speed;
    bend.is_finite().then_some(bend)
}

/// The part of d across a tangent; `None` where the tangent vanishes, or the part is rounding.
fn across(d: DVec3, along: DVec3) -> Option<DVec3> {
    let tangent = along.try_normalize()?;
    let part = d - tangent * tangent.dot(d);
    (part.length() > COLLAPSE * d.length()).then_some(part)
}

/// The α for which αd is nearest to e; `None` where there is none.
fn nearest_ratio(d: DVec3, e: DVec3) -> Option<f64> {
    let ratio = d.try_normalize()?.dot(e) / d.length();
    ratio.is_finite().then_some(ratio)
}

/// Largest values in the making.
#[derive(Default)]
struct Figures {
    gap: Largest,
    first: Largest,
    angle: Largest,
    second: Largest,
    curvature: Largest,
    ratio: Option<CrossRatio>,
    undecided: usize,
}

#[derive(Default)]
struct Largest(Option<Maximum>);

impl Largest {
    fn raise(&mut self, value: f64, at: f64) {
        if self.0.is_none_or(|m| value > m.value) {
            self.0 = Some(Maximum { value, at });
        }
    }
}

impl Figures {
    fn derivatives(&mut self, [d, e]: [DVec3; 2], [dd, ee]: [DVec3; 2], lengths: [f64; 2], at: f64) {
        let longest = d.length().max(e.length());
        if longest > 0.0 {
            self.first.raise(d.distance(e) / longest, at);
        }
        let extent = (d.length() / lengths[0]).max(e.length() / lengths[1]);
        let longest = dd.length().max(ee.length()).max(extent);
        if longest > 0.0 {
            self.second.raise(dd.distance(ee) / longest, at);
        }
    }

    fn ratio(&mut self, ratio: Option<f64>, at: f64) {
        let Some(alpha) = ratio else { return };
        let only = CrossRatio { least: alpha, least_at: at, largest: alpha, largest_at: at };
        let range = self.ratio.get_or_insert(only);
        if alpha < range.least {
            (range.least, range.least_at) = (alpha, at);
        }
        if alpha > range.largest {
            (range.largest, range.largest_at) = (alpha, at);
        }
    }

    fn report(self, samples: usize) -> JoinReport {
        JoinReport {
            gap: self.gap.0.unwrap_or(Maximum { value: 0.0, at: 0.0 }),
            first: self.first.0,
            angle: self.angle.0,
            second: self.second.0,
            curvature: self.curvature.0,
            ratio: self.ratio,
            samples,
            undecided: self.undecided,
        }
    }
}

/// An edge of a surface, with the direction it is run through.
#[derive(Clone, Copy)]
pub struct SurfaceEdge<'a> {
    surface: &'a dyn ParametricSurface,
    start: DVec2,
    end: DVec2,
    /// A direction in the parameter plane that leads into the surface.
    inward: DVec2,
    /// The extent of the parameter across the edge; none on triangles, where no parameter runs across.
    across: Option<f64>,
}

impl<'a> SurfaceEdge<'a> {
    /// An edge of a surface over a rectangle, run through with increasing parameter.
    ///
    /// # Errors
    /// [`ShapeError::Construction`] for a surface over a triangle.
    pub fn of_patch(surface: &'a dyn ParametricSurface, edge: PatchEdge) -> Result<Self, ShapeError> {
        let SurfaceDomain::Rectangle([u, v]) = surface.domain() else {
            return Err(ShapeError::Construction { what: "number of edges of the surface", value: 3.0 });
        };
        let corner = |i: f64, j: f64| DVec2::new(u.at(i), v.at(j));
        let (start, end, inward, extent) = match edge {
            PatchEdge::UStart => (corner(0.0, 0.0), corner(0.0, 1.0), DVec2::X, u.length()),
            PatchEdge::UEnd => (corner(1.0, 0.0), corner(1.0, 1.0), DVec2::NEG_X, u.length()),
            PatchEdge::VStart => (corner(0.0, 0.0), corner(1.0, 0.0), DVec2::Y, v.length()),
            PatchEdge::VEnd => (corner(0.0, 1.0), corner(1.0, 1.0), DVec2::NEG_Y, v.length()),
        };
        Ok(Self { surface, start, end, inward, across: Some(extent) })
    }

    /// The edge of a surface over a triangle on which the barycentric coordinate `opposite` (0, 1 or 2) vanishes,
    /// run through from the next vertex to the one after it.
    ///
    /// # Errors
    /// [`ShapeError::Construction`] for a surface over a rectangle, or another number.
    pub fn of_triangle(surface: &'a dyn ParametricSurface, opposite: usize) -> Result<Self, ShapeError> {
        let corners = [DVec2::X, DVec2::Y, DVec2::ZERO];
        if surface.domain() != SurfaceDomain::Triangle || opposite > 2 {
            return Err(ShapeError::Construction { what: "edge of a triangle", value: opposite as f64 });
        }
        let (start, end) = (corners[(opposite + 1) % 3], corners[(opposite + 2) % 3]);
        let inward = corners[opposite] - (start + end) * 0.5;
        Ok(Self { surface, start, end, inward, across: None })
    }

    /// The same edge run through the other way.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { start: self.end, end: self.start, ..self }
    }

    /// What the surface is at a share of the edge; derivatives across are taken along `sign` times the inward
    /// direction.
    fn sample(&self, s: f64, sign: f64) -> Result<Sample, ShapeError> {
        // Both terms: the ends are met to the bit.
        let p = self.start * (1.0 - s) + self.end * s;
        let jet = self.surface.try_jet(p.x, p.y)?;
        let across = self.inward * sign;
        let along = self.end - self.start;
        // The normal of (tangent, direction across) looks to the same side for both surfaces.
        let side = (along.x * across.y - along.y * across.x).signum();
        let normal = match self.surface.try_normal(p.x, p.y) {
            Ok(normal) => Some(normal * side),
            Err(ShapeError::NoTangentPlane { .. }) => None,
            Err(other) => return Err(other),
        };
        let tangent = jet.du * along.x + jet.dv * along.y;
        let scaled = jet.rescaled(self.surface.domain().lengths());
        let curvature = normal.and_then(|n| scaled.normal_curvature(n.cross(tangent)).map(|k| k * side));
        Ok(Sample {
            point: jet.point,
            first: jet.du * across.x + jet.dv * across.y,
            second: jet.duu * (across.x * across.x)
                + jet.duv * (2.0 * across.x * across.y)
                + jet.dvv * (across.y * across.y),
            along: tangent,
            normal,
            curvature,
            extent: self.across.unwrap_or(1.0),
        })
    }
}

struct Sample {
    point: DVec3,
    first: DVec3,
    second: DVec3,
    /// The derivative along the edge.
    along: DVec3,
    normal: Option<DVec3>,
    curvature: Option<f64>,
    extent: f64,
}
