//! The search for a parameter of a point: Newton's method from the cells that may hold it, and a proof for the others.
//!
//! With the homogeneous net `(wF, w)` and the point p, a parameter of p is a zero of `wF − w·p`. A cell is left out
//! where the Bernstein coefficients of a combination of the three equations have one sign, whatever the signs of the
//! weights. The combinations tried are the equations themselves and those of the inverse Jacobian in the middle of
//! the cell, whose Jacobian is near the unit matrix on small cells. What is not left out is cut further, down to cells
//! whose image is a point within the tolerance.

use casteljau_geom::glam::{BVec3, DMat3, DVec3, DVec4, Vec4Swizzles};
use casteljau_geom::{UNIT_ROUNDOFF, rounding_bound};

use super::domain::Domain;
use crate::SolidError;
use crate::certificate::{exponent, scaled};

/// Cells looked at for one point, at most, beyond the first ones.
const MOST_CELLS: usize = 5_000;

/// Cells that a locator prepares, at least; fewer where their nets would hold more than [`MOST_POINTS`].
const PREPARED: usize = 64;

/// Control points of all prepared cells together, at most: 128 MB.
const MOST_POINTS: usize = 1 << 22;

/// Steps of Newton's method from one start.
const NEWTON_STEPS: usize = 12;

/// Damped steps for places where the Jacobian vanishes: each at least halves the error there.
const DAMPED_STEPS: usize = 80;

/// Weights and lengths are brought near 1 by no more than 2 to this power, so that points within `LARGEST_COORDINATE` stay in
/// range.
const MOST_DOUBLINGS: i32 = 500;

/// A cell of the first generation, made ready for many points.
struct Prepared<C> {
    cell: C,
    net: Vec<DVec4>,
    /// The box around the control points; everything where weights have both signs.
    low: DVec3,
    high: DVec3,
    center: DVec3,
    image: DVec3,
    /// From a way in space to one in the cell's own coordinates; zero where the Jacobian is singular.
    to_local: DMat3,
}

/// What the search keeps of a solid: coordinates and weights are brought near 1 by powers of two, so that no product of
/// three derivatives leaves the range of numbers.
pub(super) struct Search<D: Domain> {
    domain: D,
    net: Vec<DVec4>,
    /// The point that all coordinates are measured from.
    origin: DVec3,
    /// Lengths here are 2 to minus this power times those given.
    in_space: i32,
    /// The largest number in the net, by coordinates and by weight.
    largest: f64,
    heaviest: f64,
    /// What moving the origin may have done to a coefficient: the rounding of a product, where weights are not 1.
    shift: f64,
    size: f64,
    prepared: Vec<Prepared<D::Cell>>,
}

/// Buffers of a search, to be used again.
#[derive(Default)]
pub(super) struct Work {
    net: Vec<DVec4>,
    grown: Vec<DVec4>,
    scratch: Vec<DVec4>,
    order: Vec<(f64, usize)>,
}

/// A parameter with the residual of its point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hit {
    pub at: DVec3,
    pub residual: f64,
}

impl<D: Domain> Search<D> {
    /// Prepares the search in a solid with the homogeneous net `points`.
    pub fn new(domain: D, points: &[DVec4]) -> Result<Self, SolidError> {
        let origin = casteljau_shape::control_net::hull_box(points).map_or(DVec3::ZERO, |b| b.center());
        let mut net: Vec<DVec4> = points.iter().map(|p| (p.xyz() - origin * p.w).extend(p.w)).collect();
        let exact = net.iter().all(|p| p.w == 1.0);
        let most = |net: &[DVec4], of: fn(&DVec4) -> f64| net.iter().map(of).fold(0.0, f64::max);
        let coordinate = |p: &DVec4| p.xyz().abs().max_element();
        let in_weight = exponent(most(&net, |p| p.w.abs())).clamp(-MOST_DOUBLINGS, MOST_DOUBLINGS);
        let in_space = exponent(most(&net, coordinate)).saturating_sub(in_weight);
        let in_space = in_space.clamp(-MOST_DOUBLINGS, MOST_DOUBLINGS);
        for p in &mut net {
            let q = *p * 2_f64.powi(-in_weight);
            *p = (q.xyz() * 2_f64.powi(-in_space)).extend(q.w);
        }
        let (largest, heaviest) = (most(&net, coordinate), most(&net, |p| p.w.abs()));
        let far = scaled(origin.abs().max_element(), -in_space);
        let shift = if exact { 0.0 } else { 2.0 * UNIT_ROUNDOFF * far * heaviest };
        let mut search =
            Self { domain, net, origin, in_space, largest, heaviest, shift, size: 0.0, prepared: Vec::new() };
        let mut cells = vec![search.domain.whole()];
        let mut axis = 0;
        while cells.len() < PREPARED && 2 * cells.len() * points.len() <= MOST_POINTS {
            cells = cells.iter().flat_map(|cell| search.domain.halves(cell, axis)).collect();
            axis += 1;
        }
        let mut work = Work::default();
        for cell in cells {
            let prepared = search.prepare(cell, &mut work)?;
            search.prepared.push(prepared);
        }
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for cell in search.prepared.iter().filter(|c| c.low.is_finite() && c.high.is_finite()) {
            // Around the control points alone: what they may be wrong by is no size of the solid.
            for q in cell.net.iter().map(|p| p.xyz() / p.w) {
                (low, high) = (low.min(q), high.max(q));
            }
        }
        if !(low.is_finite() && high.is_finite()) {
            return Err(casteljau_shape::ShapeError::Unbounded.into());
        }
        search.size = scaled((high - low).length(), in_space);
        Ok(search)
    }

    /// The diagonal of the box around all cells.
    pub fn size(&self) -> f64 {
        self.size
    }

    fn prepare(&self, cell: D::Cell, work: &mut Work) -> Result<Prepared<D::Cell>, SolidError> {
        let mut net = vec![DVec4::ZERO; self.net.len()];
        self.domain.restrict(&self.net, &cell, &mut net, &mut work.scratch)?;
        let sign = net[0].w.signum();
        let bounded = net.iter().all(|p| p.w * sign > 0.0);
        let (mut low, mut high) = (DVec3::NEG_INFINITY, DVec3::INFINITY);
        if bounded {
            (low, high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for p in &net {
                let q = p.xyz() / p.w;
                (low, high) = (low.min(q), high.max(q));
            }
            let lightest = net.iter().map(|p| p.w.abs()).fold(f64::INFINITY, f64::min);
            let reach = low.abs().max(high.abs()).max_element();
            let unsure = self.net_error(reach) / lightest;
            (low, high) = (low - unsure, high + unsure);
        }
        let center = self.domain.center(&cell);
        let [value, ..] = self.domain.jet(&self.net, center);
        let jacobian = self.jacobian(center).map_or(DMat3::ZERO, |j| j * self.domain.frame(&cell));
        let to_local = inverse(jacobian).unwrap_or(DMat3::ZERO);
        Ok(Prepared { cell, net, low, high, center, image: value.xyz() / value.w, to_local })
    }

    /// A bound on the error of each coefficient of `wF − w·p` over a cell, for |p| ≤ `reach`.
    fn net_error(&self, reach: f64) -> f64 {
        self.shift + 2.0 * rounding_bound(self.domain.degree(), 0, self.largest + reach * self.heaviest)
    }

    /// The derivative of the point by the parameters.
    fn jacobian(&self, at: DVec3) -> Option<DMat3> {
        let [n, u, v, w] = self.domain.jet(&self.net, at);
        let point = n.xyz() / n.w;
        let column = |d: DVec4| (d.xyz() - point * d.w) / n.w;
        Some(DMat3::from_cols(column(u), column(v), column(w))).filter(|j| j.is_finite())
    }

    /// The nearest parameter that is found, if its point is within the tolerance; `None` is a proof that the solid does
    /// not reach p.
    pub fn locate(&self, p: DVec3, tolerance: f64, work: &mut Work) -> Result<Option<Hit>, SolidError> {
        let into = 2_f64.powi(-self.in_space);
        let found = self.locate_scaled((p - self.origin) * into, tolerance * into, work);
        match found {
            Ok(hit) => Ok(hit.map(|hit| Hit { residual: scaled(hit.residual, self.in_space), ..hit })),
            Err(SolidError::Undecided { cells, .. }) => {
                Err(SolidError::Undecided { point: p, tolerance, cells })
            }
            Err(other) => Err(other),
        }
    }

    /// [`locate`](Self::locate) for a point, a tolerance and a residual as the net has them.
    fn locate_scaled(&self, p: DVec3, tolerance: f64, work: &mut Work) -> Result<Option<Hit>, SolidError> {
        let unsure = self.net_error(p.abs().max_element());
        let mut order = std::mem::take(&mut work.order);
        order.clear();
        for (place, cell) in self.prepared.iter().enumerate() {
            if p.cmpge(cell.low - tolerance).all() && p.cmple(cell.high + tolerance).all() {
                let away = (cell.to_local * (p - cell.image)).abs().max_element();
                order.push((if away.is_finite() { away } else { f64::MAX }, place));
            }
        }
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let found = self.among(&order, p, tolerance, unsure, work);
        work.order = order;
        found
    }

    fn among(
        &self,
        order: &[(f64, usize)],
        p: DVec3,
        tolerance: f64,
        unsure: f64,
        work: &mut Work,
    ) -> Result<Option<Hit>, SolidError> {
        // The cell whose own map comes nearest to p is nearly always the right one.
        let root =
            order.first().and_then(|&(_, place)| self.newton(self.prepared[place].center, p, tolerance));
        if let Some(hit) = root.and_then(|at| self.within(at, p, tolerance)) {
            return Ok(Some(hit));
        }
        let mut open = Vec::new();
        for &(_, place) in order {
            let cell = &self.prepared[place];
            if self.excluded(&cell.net, p, DMat3::IDENTITY, unsure) {
                continue;
            }
            if self.middle(&cell.net, p).is_some_and(|m| self.excluded(&cell.net, p, m, unsure)) {
                continue;
            }
            if root.is_some_and(|root| self.holds_no_other(&cell.cell, root, p, unsure, work)) {
                continue;
            }
            open.push((cell.cell, 0));
        }
        // Damped steps where plain ones were of no use: the Jacobian vanishes nearby.
        if let Some((cell, _)) = open.first()
            && let Some(hit) = self.damped(self.domain.center(cell), p, tolerance)
        {
            return Ok(Some(hit));
        }
        // The nearest cell last, to be taken first.
        open.reverse();
        self.subdivide(open, p, tolerance, unsure, work)
    }

    fn subdivide(
        &self,
        mut open: Vec<(D::Cell, usize)>,
        p: DVec3,
        tolerance: f64,
        unsure: f64,
        work: &mut Work,
    ) -> Result<Option<Hit>, SolidError> {
        let mut looked = 0;
        let mut net = std::mem::take(&mut work.net);
        net.resize(self.net.len(), DVec4::ZERO);
        let outcome = loop {
            let Some((cell, depth)) = open.pop() else { break Ok(None) };
            for half in self.domain.halves(&cell, self.longest(&cell, depth)) {
                looked += 1;
                self.domain.restrict(&self.net, &half, &mut net, &mut work.scratch)?;
                if self.excluded(&net, p, DMat3::IDENTITY, unsure) {
                    continue;
                }
                if self.middle(&net, p).is_some_and(|m| self.excluded(&net, p, m, unsure)) {
                    continue;
                }
                let center = self.domain.center(&half);
                if let Some(hit) = self.hit(center, p).filter(|hit| hit.residual <= tolerance) {
                    work.net = net;
                    return Ok(Some(hit));
                }
                // Descents are dear: cells that hold no parameter of p are mostly left out a little later.
                let (mut hit, mut root) = (None, None);
                match depth % 4 {
                    1 => root = self.newton(center, p, tolerance),
                    3 => hit = self.damped(center, p, tolerance),
                    _ => {}
                }
                if let Some(root) = root {
                    hit = self.within(root, p, tolerance);
                }
                if hit.is_some() {
                    work.net = net;
                    return Ok(hit);
                }
                if root.is_some_and(|root| self.holds_no_other(&half, root, p, unsure, work)) {
                    continue;
                }
                open.push((half, depth + 1));
            }
            if looked > MOST_CELLS {
                break Err(SolidError::Undecided { point: p, tolerance, cells: looked });
            }
        };
        work.net = net;
        outcome
    }

    /// The direction in which the image of a cell is longest; every second time the directions take turns.
    fn longest(&self, cell: &D::Cell, depth: usize) -> usize {
        let count = self.domain.directions();
        if depth % 2 == 1 {
            return depth / 2 % count;
        }
        let Some(jacobian) = self.jacobian(self.domain.center(cell)) else { return depth / 2 % count };
        let length = |axis: usize| (jacobian * self.domain.edge(cell, axis)).length_squared();
        (0..count).max_by(|&a, &b| length(a).total_cmp(&length(b))).unwrap_or(0)
    }

    /// The inverse of the Jacobian of `wF − w·p` in the middle of a cell, by its own coordinates.
    fn middle(&self, net: &[DVec4], p: DVec3) -> Option<DMat3> {
        let whole = self.domain.whole();
        let [_, u, v, w] = self.domain.jet(net, self.domain.center(&whole));
        let column = |d: DVec4| d.xyz() - p * d.w;
        inverse(DMat3::from_cols(column(u), column(v), column(w)))
    }

    /// Whether a component of `M (wF − w·p)` has all its coefficients on one side of 0.
    fn excluded(&self, net: &[DVec4], p: DVec3, m: DMat3, unsure: f64) -> bool {
        let margin = (m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs()) * unsure;
        // Once for the net, and once for the product with M, which rounds less.
        let rounding = margin * 2.0;
        let (mut above, mut below) = (BVec3::TRUE, BVec3::TRUE);
        // A coefficient that is 0 by itself says nothing: where it stands alone the weight vanishes too, and there is no
        // point.
        for q in net.iter().filter(|q| **q != DVec4::ZERO) {
            // What is not a number is neither.
            let g = m * (q.xyz() - p * q.w);
            (above, below) = (above & g.cmpgt(rounding), below & g.cmplt(-rounding));
        }
        above.any() || below.any()
    }

    fn hit(&self, at: DVec3, p: DVec3) -> Option<Hit> {
        let [n, ..] = self.domain.jet(&self.net, at);
        let residual = (n.xyz() / n.w).distance(p);
        residual.is_finite().then_some(Hit { at, residual })
    }

    /// Whether a cell certainly holds no parameter of p, given one that is no parameter of the domain but was found to
    /// give p.
    ///
    /// With M the inverse Jacobian of g = wF − w·p in the middle of a larger cell that holds both, and ε < 1 a bound of
    /// |M ∂g − 1| on it, |M g(x) − M g(y)| ≥ (1−ε)|x−y|: a zero is no farther than |M g(root)|/(1−ε) from the root.
    fn holds_no_other(&self, cell: &D::Cell, root: DVec3, p: DVec3, unsure: f64, work: &mut Work) -> bool {
        let Some(grown) = [1.5, 3.0]
            .map(|factor| self.domain.grown(cell, factor))
            .into_iter()
            .find(|grown| self.domain.holds(grown, root, 0.0))
        else {
            return false;
        };
        work.grown.resize(self.net.len(), DVec4::ZERO);
        if self.domain.restrict(&self.net, &grown, &mut work.grown, &mut work.scratch).is_err() {
            return false;
        }
        // By half edges the Jacobian is half of that by the domain of the restricted net.
        let Some(m) = self.middle(&work.grown, p).map(|m| m * 2.0) else { return false };
        let error =
            (m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs()) * (unsure * self.domain.growth(&grown));
        let mut most = [DVec3::ZERO; 3];
        let mut seen = [false; 3];
        self.domain.slopes(&work.grown, |axis, slope| {
            let off = (m * (slope.xyz() - p * slope.w) - DVec3::AXES[axis]).abs();
            most[axis] = most[axis].max(off);
            seen[axis] = true;
        });
        if seen != [true; 3] {
            return false;
        }
        // A difference of two coefficients times half the degree; the product with M rounds less.
        let rounding = error * (6.0 * self.domain.degree() as f64);
        let deviation = (most[0] + most[1] + most[2] + rounding).max_element();
        let [value, ..] = self.domain.jet(&self.net, root);
        let step = ((m * (value.xyz() - p * value.w)).abs() + error * 2.0).max_element();
        let frame = self.domain.frame(&grown);
        let widest = (frame.x_axis.abs() + frame.y_axis.abs() + frame.z_axis.abs()).max_element();
        deviation < 1.0 && self.domain.is_outside(root, widest * step / (1.0 - deviation))
    }

    /// Newton's method, free to leave the domain: parameters that give p within the tolerance.
    fn newton(&self, start: DVec3, p: DVec3, tolerance: f64) -> Option<DVec3> {
        let (mut at, mut before) = (start, f64::INFINITY);
        for step in 0..NEWTON_STEPS {
            let [n, u, v, w] = self.domain.jet(&self.net, at);
            let point = n.xyz() / n.w;
            let away = point - p;
            let residual = away.length();
            if residual <= 0.25 * tolerance {
                return Some(at);
            }
            // Quadratic convergence, or none.
            if !residual.is_finite() || (step > 3 && residual > 0.5 * before) {
                break;
            }
            before = residual;
            let column = |d: DVec4| (d.xyz() - point * d.w) / n.w;
            let next = at - inverse(DMat3::from_cols(column(u), column(v), column(w)))? * away;
            // Far outside the map means nothing.
            if !(next.is_finite() && (next - self.domain.clamp(next)).abs().max_element() < 1.0) {
                return None;
            }
            at = next;
        }
        self.hit(at, p).filter(|hit| hit.residual <= tolerance).map(|_| at)
    }

    /// The nearest parameters of the domain, if they give p within the tolerance too.
    fn within(&self, at: DVec3, p: DVec3, tolerance: f64) -> Option<Hit> {
        self.hit(self.domain.clamp(at), p).filter(|hit| hit.residual <= tolerance)
    }

    /// Levenberg's damped steps within the domain.
    fn damped(&self, start: DVec3, p: DVec3, tolerance: f64) -> Option<Hit> {
        let (mut at, mut damping) = (self.domain.clamp(start), 1e-8);
        for _ in 0..DAMPED_STEPS {
            let [n, u, v, w] = self.domain.jet(&self.net, at);
            let point = n.xyz() / n.w;
            let away = point - p;
            let residual = away.length();
            if residual <= tolerance {
                return Some(Hit { at, residual });
            }
            let column = |d: DVec4| (d.xyz() - point * d.w) / n.w;
            let jacobian = DMat3::from_cols(column(u), column(v), column(w));
            let normal = jacobian.transpose() * jacobian;
            let trace = normal.x_axis.x + normal.y_axis.y + normal.z_axis.z;
            let damped = normal + DMat3::from_diagonal(DVec3::splat(damping * trace));
            let next = self.domain.clamp(at - damped.inverse() * (jacobian.transpose() * away));
            match self.hit(next, p) {
                Some(hit) if hit.residual < residual => (at, damping) = (next, damping * 0.1),
                _ => damping *= 10.0,
            }
            if damping > 1e8 {
                return None;
            }
        }
        None
    }
}

/// The inverse, unless the matrix is singular within rounding.
fn inverse(m: DMat3) -> Option<DMat3> {
    let size = m.x_axis.length() * m.y_axis.length() * m.z_axis.length();
    if m.determinant().abs() <= 64.0 * UNIT_ROUNDOFF * size {
        return None;
    }
    Some(m.inverse()).filter(|m| m.is_finite())
}
