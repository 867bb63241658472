//! The closest point of a patch.

use casteljau_bernstein::{TensorNet, value};
use casteljau_geom::Interval;
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};

use super::minima::{Found, clusters, over, sign};
use super::net::{LocalNet, positive};
use super::newton::{descend, evaluate};
use super::tree::{Best, Cuts, Tree};
use super::{LocalMinima, LocalMinimum, LocalProjection, Projection, check_query};
use crate::{BezierPatch, ControlPoint, ShapeError};

/// A patch prepared for questions about its closest points, `min |S(u,v) − q|` over its intervals.
///
/// ```
/// use casteljau_shape::{Patch, PatchProjector, geom::glam::DVec3};
/// let net = [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 1.]].map(DVec3::from_array); // z = xy
/// let projector = PatchProjector::new(&Patch::new([1, 1], net)?)?;
/// let foot = projector.closest_point(DVec3::new(-1.0, 0.5, 0.0))?; // beside the side u = 0
/// assert_eq!((foot.parameters, foot.distance), ([0.0, 0.5], 1.0));
/// assert!(foot.lower_bound > 1.0 - 1e-12);
/// # Ok::<(), casteljau_shape::ShapeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct PatchProjector {
    control_points: Vec<DVec4>,
    degrees: [usize; 2],
    intervals: [Interval; 2],
    pub(super) interior: Tree<2>,
    pub(super) sides: [Side; 4],
}

/// One side of the square: the tree of its curve, which axis is held there, and at what.
#[derive(Debug, Clone)]
pub(super) struct Side {
    pub tree: Tree<1>,
    pub held: usize,
    pub value: f64,
}

impl Side {
    /// The parameters of the patch at a parameter of the side.
    pub fn parameters(&self, t: f64) -> [f64; 2] {
        if self.held == 0 { [self.value, t] } else { [t, self.value] }
    }

    /// The box of the patch's parameters that belongs to a stretch of the side.
    fn area(&self, stretch: [f64; 2]) -> [[f64; 2]; 2] {
        let held = [self.value; 2];
        if self.held == 0 { [held, stretch] } else { [stretch, held] }
    }

    /// An uncertainty along the side, as one of the patch's parameters.
    fn extent(&self, radius: f64) -> [f64; 2] {
        if self.held == 0 { [0.0, radius] } else { [radius, 0.0] }
    }
}

/// The place of a local minimum on `[0, 1]²`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub at: [f64; 2],
    /// The exact minimum lies within so much of `at`.
    pub radius: [f64; 2],
}

/// All local minima of the distance on `[0, 1]²`.
#[derive(Debug, Clone)]
pub(super) struct Places {
    /// Those at which the gradient vanishes.
    pub inside: Vec<Place>,
    /// Those at sides and corners, with a gradient that leads inwards.
    pub on_sides: Vec<Place>,
    pub unresolved: Vec<[[f64; 2]; 2]>,
    /// Knows the boxes in which there is one minimum only.
    pub convex: Found<2>,
}

/// The place of a corner among four.
fn corner_place([u, v]: [f64; 2]) -> usize {
    usize::from(u > 0.5) + 2 * usize::from(v > 0.5)
}

impl PatchProjector {
    /// Prepares a polynomial or rational patch: cuts it into at most 512 pieces, and each side into at most 64.
    ///
    /// Cost: some 1500 restrictions of the net, 3 ms for a bicubic patch; 0.5 MB at most, whatever the degree.
    ///
    /// # Errors
    /// [`ShapeError::Weight`] unless all weights have one sign.
    pub fn new<P: ControlPoint>(patch: &BezierPatch<P>) -> Result<Self, ShapeError> {
        Self::of_net(positive(patch.control_points()), patch.degrees(), patch.intervals(), Cuts::default())
    }

    /// The same from homogeneous control points.
    pub(super) fn of_net(
        control_points: Vec<DVec4>,
        degrees: [usize; 2],
        intervals: [Interval; 2],
        cuts: Cuts,
    ) -> Result<Self, ShapeError> {
        let net = LocalNet::new(&control_points, degrees)?;
        let side = |(held, last)| Side {
            tree: Tree::new(net.side(held, last), Cuts::default()),
            held,
            value: if last { 1.0 } else { 0.0 },
        };
        let sides = [(0, false), (0, true), (1, false), (1, true)].map(side);
        Ok(Self { control_points, degrees, intervals, interior: Tree::new(net, cuts), sides })
    }

    /// The closest point of the whole patch, sides and corners included, with a lower bound of the distance
    /// as its certificate.
    ///
    /// Of several closest points one is given, always the same. Cost: 5 µs for a bicubic patch, more where
    /// the tree does not decide.
    ///
    /// # Errors
    /// [`ShapeError::Query`] for a q that is not finite or beyond
    /// [`LARGEST_COORDINATE`](crate::LARGEST_COORDINATE), in itself or measured by the patch's size.
    pub fn closest_point(&self, q: DVec3) -> Result<Projection<2>, ShapeError> {
        let (at, lower) = self.nearest(q)?;
        let (point, distance) = self.measured(q, at);
        let lower_bound = self.interior.net.certified(lower, distance);
        Ok(Projection { parameters: self.parameters(at), point, distance, lower_bound })
    }

    /// Where on `[0, 1]²` the closest point is, and a lower bound of `φ = ½|S − q|²` in local coordinates.
    pub(super) fn nearest(&self, q: DVec3) -> Result<([f64; 2], f64), ShapeError> {
        let net = &self.interior.net;
        let local = net.local(q);
        check_query(q, local)?;
        let mut best = Best::new(f64::INFINITY, net.rounding());
        self.interior.search(local, &mut best);
        let mut at = best.place(net, local).unwrap_or_default();
        let (mut phi, mut lower) = (best.phi, best.bound());
        for side in &self.sides {
            let mut best = Best::new(phi, net.rounding());
            side.tree.search(local, &mut best);
            lower = lower.min(best.bound());
            if let Some([t]) = best.place(&side.tree.net, local) {
                (at, phi) = (side.parameters(t), best.phi);
            }
        }
        Ok((at, lower))
    }

    /// The local minimum of the distance that Newton's method reaches from `start`.
    ///
    /// Kept inside the intervals and from climbing; says whether it converged. For a start close to the closest
    /// point. Cost: a jet of order 2 a step, under 1 µs for a bicubic patch.
    ///
    /// # Errors
    /// [`ShapeError::Query`] as for [`closest_point`](Self::closest_point), [`ShapeError::Parameter`] for a
    /// start that is not finite.
    pub fn closest_point_from(&self, q: DVec3, start: [f64; 2]) -> Result<LocalProjection<2>, ShapeError> {
        let net = &self.interior.net;
        let local = net.local(q);
        check_query(q, local)?;
        if let Some(&value) = start.iter().find(|x| !x.is_finite()) {
            return Err(ShapeError::Parameter { value });
        }
        let end = descend(net, local, [0, 1].map(|k| self.intervals[k].local(start[k])));
        let (point, distance) = self.measured(q, end.at);
        let parameters = self.parameters(end.at);
        Ok(LocalProjection { parameters, point, distance, converged: end.converged })
    }

    /// All local minima of the distance over the patch, sides and corners included, each proved and isolated.
    ///
    /// A side that is collapsed to a point counts as one minimum, given at its middle, if every direction
    /// leads away from q there. Cost: some 100 µs for a bicubic patch; up to 20,000 pieces are looked at, and
    /// as many on each side.
    ///
    /// # Errors
    /// [`ShapeError::Query`] as for [`closest_point`](Self::closest_point).
    pub fn local_minima(&self, q: DVec3) -> Result<LocalMinima<2>, ShapeError> {
        let found = self.minima(q)?;
        let minimum = |&Place { at, radius }: &Place| {
            let (point, distance) = self.measured(q, at);
            LocalMinimum { parameters: at, uncertainty: radius, point, distance }.over(self.intervals)
        };
        let mut minima: Vec<_> = found.inside.iter().chain(&found.on_sides).map(minimum).collect();
        minima.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        Ok(LocalMinima { minima, unresolved: over(found.unresolved, self.intervals) })
    }

    /// All local minima of the distance on `[0, 1]²`.
    pub(super) fn minima(&self, q: DVec3) -> Result<Places, ShapeError> {
        let local = self.interior.net.local(q);
        check_query(q, local)?;
        let found = self.interior.minima(local);
        let inside =
            found.isolated.iter().map(|known| Place { at: known.at.at, radius: known.radius }).collect();
        let mut on_sides = Vec::new();
        let mut keep = |at, radius| on_sides.push(Place { at, radius });
        let mut unresolved = found.unresolved.clone();
        let mut open_corners = [true; 4];
        for side in &self.sides {
            if side.tree.is_point() {
                match self.collapsed(local, side) {
                    Some(true) => keep(side.parameters(0.5), side.extent(0.5)),
                    Some(false) => {}
                    None => unresolved.push(side.area([0.0, 1.0])),
                }
                for t in [0.0, 1.0] {
                    open_corners[corner_place(side.parameters(t))] = false;
                }
                continue;
            }
            let on_side = side.tree.minima(local);
            for known in &on_side.isolated {
                let ([t], [radius]) = (known.at.at, known.radius);
                if t - radius <= 0.0 || t + radius >= 1.0 {
                    continue; // a corner, if anything
                }
                let area = side.area([t - radius, t + radius]);
                if !found.covers(&area) {
                    match self.leads_away(local, side, t, radius) {
                        Some(true) => keep(side.parameters(t), side.extent(radius)),
                        Some(false) => {}
                        None => unresolved.push(area),
                    }
                }
            }
            for &[[from, to]] in &on_side.unresolved {
                let (middle, radius) = (0.5 * (from + to), 0.5 * (to - from));
                let area = side.area([from, to]);
                if !found.covers(&area) && self.leads_away(local, side, middle, radius) != Some(false) {
                    unresolved.push(area);
                }
            }
        }
        for (place, _) in open_corners.iter().enumerate().filter(|(_, open)| **open) {
            let corner = [(place & 1) as f64, (place >> 1) as f64];
            let area = corner.map(|x| [x, x]);
            if found.covers(&area) {
                continue;
            }
            let at = evaluate(&self.interior.net, local, corner);
            let signs = [0, 1].map(|k| {
                let inward = if corner[k] == 0.0 { at.gradient[k] } else { -at.gradient[k] };
                sign(inward, self.interior.gradient_rounding(&at, k))
            });
            if signs == [Some(true); 2] {
                keep(corner, [0.0; 2]);
            } else if !signs.contains(&Some(false)) {
                unresolved.push(area);
            }
        }
        Ok(Places { inside, on_sides, unresolved: clusters(unresolved), convex: found })
    }

    /// Whether φ grows inwards on all of a side within `radius` of t.
    fn leads_away(&self, q: DVec3, side: &Side, t: f64, radius: f64) -> Option<bool> {
        let at = evaluate(&self.interior.net, q, side.parameters(t));
        let jet = self.interior.net.jet(at.at);
        let k = side.held;
        let inward = if side.value == 0.0 { at.gradient[k] } else { -at.gradient[k] };
        // φ_uv changes by less than itself over so short a stretch.
        let mixed = at.speed[0] * at.speed[1] + at.distance * jet.second[1].length();
        sign(inward, self.interior.gradient_rounding(&at, k) + 2.0 * mixed * radius)
    }

    /// Whether φ grows inwards all along a side that is collapsed to the point P.
    ///
    /// There S_n = m Σ Bⱼ (A₁ⱼ − P w₁ⱼ) / Σ Bⱼ w₀ⱼ, with the net's row beside the side.
    fn collapsed(&self, q: DVec3, side: &Side) -> Option<bool> {
        let net = &self.interior.net;
        let degree = net.degrees()[side.held];
        if degree == 0 {
            return None;
        }
        let pole = net.jet(side.parameters(0.5)).point;
        let next = net.line(side.held, if side.value == 0.0 { 1 } else { degree - 1 });
        let away: Vec<f64> = next.iter().map(|p| (pole - q).dot(p.xyz() - pole * p.w)).collect();
        let unsure = |w: f64| 4.0 * net.rounding() * w * (pole.distance(q) + 1.0);
        if away.iter().zip(&next).all(|(&x, p)| x > unsure(p.w)) {
            return Some(true);
        }
        let heaviest = next.iter().map(|p| p.w).fold(0.0, f64::max);
        let samples = 4 * next.len();
        let toward = |i: usize| value(&away, i as f64 / samples as f64) < -unsure(heaviest);
        (0..=samples).any(toward).then_some(false)
    }

    /// The patch's parameters at a place of `[0, 1]²`.
    fn parameters(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.intervals[k].at(at[k]))
    }

    pub(super) fn measured(&self, q: DVec3, [u, v]: [f64; 2]) -> (DVec3, f64) {
        let p = TensorNet::validated(&self.control_points, self.degrees).value(u, v);
        let point = p.xyz() / p.w;
        (point, self.interior.net.distance(point, q))
    }
}
