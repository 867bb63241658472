//! Patches and triangles as the mesher sees them: over a polygon.

use std::borrow::Cow;

use casteljau_domain::{DomainError, Polygon};
use casteljau_gb::{Location, SurfaceJet};
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_shape::{
    BezierPatch, BezierTriangle, ControlPoint, ParametricSurface, PatchEdge, ShapeError, SurfaceDomain,
};

use crate::chart::Chart;
use crate::surface::{Fault, Surface};

/// Control points closer than this times their largest coordinate are one point: an edge of such is collapsed.
const COINCIDENT: f64 = 16.0 * f64::EPSILON;

/// A control point of either kind as a homogeneous one.
pub(crate) trait Lift: ControlPoint {
    fn lift(self) -> DVec4;
}

impl Lift for DVec3 {
    fn lift(self) -> DVec4 {
        self.extend(1.0)
    }
}

impl Lift for DVec4 {
    fn lift(self) -> DVec4 {
        self
    }
}

/// A surface over its rectangle or triangle, drawn in a polygon.
pub(crate) struct Charted<'a, S: Clone> {
    surface: Cow<'a, S>,
    chart: Chart,
    /// Nets along the polygon's sides.
    sides: Vec<Vec<DVec4>>,
    largest: f64,
}

impl<'a, P: Lift> Charted<'a, BezierPatch<P>> {
    pub fn patch(patch: Cow<'a, BezierPatch<P>>) -> Result<Self, DomainError> {
        let edge = |edge, reversed| {
            let mut net: Vec<DVec4> = patch.edge(edge).control_points().iter().map(|&p| p.lift()).collect();
            if reversed {
                net.reverse();
            }
            net
        };
        let mut sides = vec![
            edge(PatchEdge::VStart, false),
            edge(PatchEdge::UEnd, false),
            edge(PatchEdge::VEnd, true),
            edge(PatchEdge::UStart, true),
        ];
        let points: Vec<Vec<DVec3>> = sides.iter().map(|net| euclidean(net)).collect();
        let collapsed: Vec<usize> = (0..4).filter(|&side| is_collapsed(&points[side])).collect();
        let chart = match collapsed[..] {
            [side] => {
                sides.rotate_left((side + 1) % 4);
                sides.pop();
                Chart::pole(side)?
            }
            _ => {
                let length = |side: usize| points[side].windows(2).map(|w| w[0].distance(w[1])).sum::<f64>();
                Chart::rectangle([length(0) + length(2), length(1) + length(3)])?
            }
        };
        let largest = largest(patch.control_points());
        Ok(Self { surface: patch, chart, sides, largest })
    }
}

impl<'a, P: Lift> Charted<'a, BezierTriangle<P>> {
    pub fn triangle(triangle: Cow<'a, BezierTriangle<P>>) -> Result<Self, DomainError> {
        let n = triangle.degree();
        let side = |index: &dyn Fn(usize) -> [usize; 3]| {
            let at = |i: usize| index(i);
            let points = (0..=n).filter_map(|i| triangle.control_point(at(i)[0], at(i)[1], at(i)[2]));
            points.map(Lift::lift).collect::<Vec<_>>()
        };
        let sides = vec![side(&|i| [i, 0, n - i]), side(&|i| [n - i, i, 0]), side(&|i| [0, n - i, i])];
        let largest = largest(triangle.control_points());
        Ok(Self { surface: triangle, chart: Chart::triangle()?, sides, largest })
    }
}

/// The points in space; those at infinity are left out.
fn euclidean(net: &[DVec4]) -> Vec<DVec3> {
    net.iter().map(|p| p.xyz() / p.w).filter(|p| p.is_finite()).collect()
}

/// Whether the points are one, but for rounding.
pub(crate) fn is_collapsed(points: &[DVec3]) -> bool {
    let Some(&first) = points.first() else { return false };
    let largest = points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    points.iter().all(|p| (*p - first).abs().max_element() <= COINCIDENT * largest)
}

fn largest<P: Lift>(points: &[P]) -> f64 {
    let net: Vec<DVec4> = points.iter().map(|&p| p.lift()).collect();
    euclidean(&net).iter().map(|p| p.abs().max_element()).fold(0.0, f64::max)
}

impl<S: ParametricSurface + Clone> Charted<'_, S> {
    /// The shape's parameters at a location.
    fn parameters(&self, location: Location) -> [f64; 2] {
        let [x, y] = self.chart.parameters(location);
        match self.surface.domain() {
            SurfaceDomain::Rectangle([u, v]) => [u.at(x), v.at(y)],
            SurfaceDomain::Triangle => [x, y],
        }
    }

    /// Point and unit normal; the normal is zero where there is none.
    fn point_and_normal(&self, [u, v]: [f64; 2]) -> Result<(DVec3, DVec3), ShapeError> {
        let mut partials = [DVec3::ZERO; 3];
        self.surface.try_partials(u, v, &mut partials)?;
        let [point, du, dv] = partials;
        let jet = SurfaceJet { point, du, dv, ..SurfaceJet::default() };
        // A derivative of second order is needed only where those of first order do not span a plane.
        let normal = jet.rescaled(self.surface.domain().lengths()).normal();
        let normal = normal.or_else(|| self.surface.try_normal(u, v).ok()).unwrap_or(DVec3::ZERO);
        Ok((point, normal))
    }
}

impl<S: ParametricSurface + Clone> Surface for Charted<'_, S> {
    fn domain(&self) -> &Polygon {
        &self.chart.polygon
    }

    fn side_name(&self, side: usize) -> usize {
        self.chart.side_name(side)
    }

    fn side_net(&self, side: usize) -> Vec<DVec4> {
        self.sides[side].clone()
    }

    fn largest(&self) -> f64 {
        self.largest
    }

    fn sample(
        &self,
        locations: &[Location],
        points: &mut [DVec3],
        normals: Option<&mut [DVec3]>,
    ) -> Result<(), Fault> {
        let places = locations.iter().map(|&location| self.parameters(location));
        match normals {
            Some(normals) => {
                for ((place, point), normal) in places.zip(points).zip(normals) {
                    (*point, *normal) = self.point_and_normal(place)?;
                }
            }
            None => {
                for ([u, v], point) in places.zip(points) {
                    *point = self.surface.try_point(u, v)?;
                }
            }
        }
        Ok(())
    }
}
