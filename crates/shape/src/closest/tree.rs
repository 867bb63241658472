//! A shape cut into pieces once, and the search for the least distance over them.

use std::collections::BinaryHeap;

use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::{DVec3, DVec4};

use super::net::LocalNet;
use super::newton::{Stationary, descend, evaluate};
use super::piece::{Piece, PieceScratch, least_on};
use super::square::least_square;

/// Pieces of a tree by the number of parameters: enough that for most queries the piece with the answer is
/// convex.
const MOST_LEAVES: [usize; 3] = [0, 64, 512];
/// Cuts from the whole shape to a leaf, at most.
const MOST_CUTS: usize = 40;
/// Pieces whose nonlinearity is below this share of the shape's size are not cut when a tree is made.
const FLAT: f64 = 1e-3;
/// Pieces are not cut below this parameter width.
const LEAST_WIDTH: f64 = 1.0 / (1_u64 << 40) as f64;
/// Pieces looked at beyond the tree, at most, for one query.
pub(super) const MOST_EXTRA: usize = 1000;

/// A box of `[0, 1]ᴰ`.
pub(super) type Area<const D: usize> = [[f64; 2]; D];

#[derive(Debug, Clone)]
pub(super) struct Node<const D: usize> {
    pub piece: Piece<D>,
    pub area: Area<D>,
    /// Place of the first of the two halves; 0 for a leaf.
    pub halves: usize,
}

/// The binary tree of a shape's pieces, its root first.
#[derive(Debug, Clone)]
pub(super) struct Tree<const D: usize> {
    pub net: LocalNet,
    pub nodes: Vec<Node<D>>,
    corners: Vec<(DVec3, [f64; D])>,
    cuts: Cuts,
}

/// Which way pieces are cut: across the axis along which they are least like an affine map, but pieces at a side that
/// is one point always across the first axis. Then few pieces have that point, and the others are in good shape.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Cuts {
    /// Whether the shape is one point at the first and at the last value of the first axis.
    pub apices: [bool; 2],
}

impl Cuts {
    /// The axis to cut, from a number for each of them.
    pub fn axis<const D: usize>(self, area: &Area<D>, by_axis: [f64; D]) -> usize {
        let [first, last] = self.apices;
        let at_apex = (first && area[0][0] == 0.0) || (last && area[0][1] == 1.0);
        if D == 2 && by_axis[1] > by_axis[0] && !at_apex { 1 } else { 0 }
    }
}

/// The state of a search.
#[derive(Debug, Clone, Copy)]
pub(super) struct Best<const D: usize> {
    /// The least φ met.
    pub phi: f64,
    /// Where, if in this tree; and the last place where Newton's method stopped.
    at: Option<[f64; D]>,
    polished: Option<Stationary<D>>,
    /// φ is not smaller anywhere that was left aside.
    lower: f64,
    /// Pieces of no less than this are left aside: φ less what rounding makes of it.
    enough: f64,
    rounding: f64,
}

impl<const D: usize> Best<D> {
    pub fn new(phi: f64, rounding: f64) -> Self {
        let mut best =
            Self { phi, at: None, polished: None, lower: f64::INFINITY, enough: f64::INFINITY, rounding };
        best.lower_to(phi);
        best
    }

    /// Takes note of a smaller φ.
    fn lower_to(&mut self, phi: f64) {
        self.phi = phi;
        self.enough = phi - tolerance(phi, self.rounding);
    }

    /// A lower bound of φ over all that was searched.
    pub fn bound(&self) -> f64 {
        self.lower.min(self.enough)
    }

    /// The place of the least φ, if it is in this tree: where Newton's method came to rest.
    pub fn place(&self, net: &LocalNet, q: DVec3) -> Option<[f64; D]> {
        let at = self.at?;
        if self.polished.is_some_and(|known| known.at == at) {
            return Some(at);
        }
        let end = descend(net, q, at);
        Some(if end.phi <= self.phi { end.at } else { at })
    }

    #[inline]
    fn offer(&mut self, phi: f64, at: [f64; D]) {
        if phi < self.phi {
            self.lower_to(phi);
            self.at = Some(at);
        }
    }
}

/// What φ can be off by when distances are off by a few `rounding`.
pub(super) fn tolerance(phi: f64, rounding: f64) -> f64 {
    if phi == f64::INFINITY {
        return 0.0;
    }
    2.0 * rounding * (2.0 * phi).sqrt() + 8.0 * rounding * rounding + 32.0 * UNIT_ROUNDOFF * phi
}

/// A piece beyond the tree that waits to be cut; the one of least φ comes first.
struct Open<const D: usize> {
    lower: f64,
    area: Area<D>,
    axis: usize,
    /// Whether the coefficients of the squared distance have been looked at.
    squared: bool,
}

impl<const D: usize> PartialEq for Open<D> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl<const D: usize> Eq for Open<D> {}
impl<const D: usize> PartialOrd for Open<D> {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl<const D: usize> Ord for Open<D> {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let ends = |a: &Area<D>, b: &Area<D>| {
            (0..D)
                .map(|k| a[k][0].total_cmp(&b[k][0]))
                .find(|o| o.is_ne())
                .unwrap_or(std::cmp::Ordering::Equal)
        };
        other.lower.total_cmp(&self.lower).then_with(|| ends(&other.area, &self.area))
    }
}

impl<const D: usize> Tree<D> {
    /// Cuts the shape where it is least like an affine map, up to the allowed number of pieces.
    pub fn new(net: LocalNet, cuts: Cuts) -> Self {
        let mut work = Workshop::default();
        let mut nodes: Vec<Node<D>> = Vec::new();
        let mut waiting = BinaryHeap::new();
        let whole = [[0.0, 1.0]; D];
        if let Some(piece) = work.piece(&net, &whole) {
            waiting.extend(Waiting::new(&piece, cuts.axis(&whole, piece.nonlinearity()), 0, 0));
            nodes.push(Node { piece, area: whole, halves: 0 });
        }
        while nodes.len() + 2 < 2 * MOST_LEAVES[D] {
            let Some(next) = waiting.pop() else { break };
            let areas = halves(nodes[next.node].area, next.axis);
            let [Some(first), Some(second)] = areas.map(|area| work.piece(&net, &area)) else { continue };
            nodes[next.node].halves = nodes.len();
            for (piece, area) in [first, second].into_iter().zip(areas) {
                let axis = cuts.axis(&area, piece.nonlinearity());
                waiting.extend(Waiting::new(&piece, axis, nodes.len(), next.cuts + 1));
                nodes.push(Node { piece, area, halves: 0 });
            }
        }
        let corners = (0..1_usize << D)
            .map(|bits| {
                let at: [f64; D] = std::array::from_fn(|k| (bits >> k & 1) as f64);
                let mut place = [0.0; 2];
                place[..D].copy_from_slice(&at);
                (net.jet(place).point, at)
            })
            .collect();
        Self { net, nodes, corners, cuts }
    }

    /// The axis across which to cut a piece.
    pub fn axis(&self, area: &Area<D>, by_axis: [f64; D]) -> usize {
        self.cuts.axis(area, by_axis)
    }

    /// Whether all points are one, to rounding.
    pub fn is_point(&self) -> bool {
        self.nodes.first().is_some_and(|root| root.piece.radius() <= 4.0 * self.net.rounding_of_points())
    }

    /// Looks for a φ below that of `best`, which is brought up to date.
    ///
    /// Pieces without a minimum in the interior are left aside: theirs lie on sides, which have trees of their
    /// own, or at corners, which are tried first.
    pub fn search(&self, q: DVec3, best: &mut Best<D>) {
        for &(corner, at) in &self.corners {
            best.offer(0.5 * corner.distance_squared(q), at);
        }
        let mut stack = [(0_usize, 0.0_f64); MOST_CUTS + 2];
        let mut depth = 0;
        let mut open = Vec::new();
        if let Some(root) = self.nodes.first()
            && let Some((lower, axis)) = self.consider(q, &root.piece, &root.area, best)
        {
            if root.halves == 0 {
                open.push(Open { lower, area: root.area, axis, squared: false });
            } else {
                (stack[0], depth) = ((0, lower), 1);
            }
        }
        while depth > 0 {
            depth -= 1;
            let (place, lower) = stack[depth];
            if lower >= best.enough {
                best.lower = best.lower.min(lower);
                continue;
            }
            let first = self.nodes[place].halves;
            let mut kept = [(0, 0.0); 2];
            let mut count = 0;
            for place in [first, first + 1] {
                let node = &self.nodes[place];
                let Some((lower, axis)) = self.consider(q, &node.piece, &node.area, best) else { continue };
                if node.halves == 0 {
                    open.push(Open { lower, area: node.area, axis, squared: false });
                } else {
                    kept[count] = (place, lower);
                    count += 1;
                }
            }
            if count == 2 && kept[0].1 < kept[1].1 {
                kept.swap(0, 1);
            }
            for &entry in &kept[..count] {
                stack[depth] = entry;
                depth += 1;
            }
        }
        if !open.is_empty() {
            self.search_further(q, open, best);
        }
    }

    /// Cuts the leaves that were not settled further and further, the most promising first.
    #[cold]
    fn search_further(&self, q: DVec3, open: Vec<Open<D>>, best: &mut Best<D>) {
        let mut work = Workshop::default();
        let mut heap = BinaryHeap::from(open);
        let mut looked = 0;
        while let Some(next) = heap.pop() {
            let width = next.area[next.axis][1] - next.area[next.axis][0];
            if next.lower >= best.enough || looked >= MOST_EXTRA {
                best.lower = best.lower.min(next.lower);
                return;
            }
            if width <= LEAST_WIDTH {
                best.lower = best.lower.min(next.lower);
                continue;
            }
            if !next.squared {
                self.net.restrict(&next.area, &mut work.net);
                let square = least_square(&work.net, self.net.degrees(), q, &mut work.square);
                if square >= best.enough {
                    best.lower = best.lower.min(square);
                    continue;
                }
            }
            // Without a convex piece nothing has been descended yet: along a valley that makes all the difference.
            if looked < 32 || looked % 32 == 0 {
                let end = descend(&self.net, q, next.area.map(|[a, b]| 0.5 * (a + b)));
                best.offer(end.phi, end.at);
            }
            for area in halves(next.area, next.axis) {
                looked += 1;
                let Some(piece) = work.piece(&self.net, &area) else {
                    best.lower = best.lower.min(next.lower);
                    continue;
                };
                let Some((lower, axis)) = self.consider(q, &piece, &area, best) else { continue };
                let square = least_square(&work.net, self.net.degrees(), q, &mut work.square);
                let lower = lower.max(square).max(next.lower);
                if lower >= best.enough {
                    best.lower = best.lower.min(lower);
                } else {
                    heap.push(Open { lower, area, axis, squared: true });
                }
            }
        }
    }

    /// Settles a piece if that can be done; otherwise the least that φ can be there, and the axis to cut.
    #[inline]
    fn consider(
        &self,
        q: DVec3,
        piece: &Piece<D>,
        area: &Area<D>,
        best: &mut Best<D>,
    ) -> Option<(f64, usize)> {
        let known = piece.assess(q, best.enough);
        if known.middle < best.phi {
            best.offer(known.middle, area.map(|[a, b]| 0.5 * (a + b)));
        }
        if known.lower >= best.enough {
            best.lower = best.lower.min(known.lower);
            return None;
        }
        if known.barren {
            return None;
        }
        if let Some(curvature) = known.convex
            && self.settle(q, area, curvature, known.start, best)
        {
            return None;
        }
        Some((known.lower, self.axis(area, known.spread)))
    }

    /// A piece on which φ is convex: finds its minimum, and shows that φ is nowhere smaller.
    fn settle(
        &self,
        q: DVec3,
        area: &Area<D>,
        curvature: [f64; D],
        start: [f64; D],
        best: &mut Best<D>,
    ) -> bool {
        let inside = |p: &Stationary<D>| (0..D).all(|k| area[k][0] <= p.at[k] && p.at[k] <= area[k][1]);
        let mut found = match best.polished.filter(inside) {
            Some(known) => known,
            None => {
                let from = std::array::from_fn(|k| {
                    let [a, b] = area[k];
                    0.5 * (a + b) + 0.5 * (b - a) * start[k]
                });
                let found = descend(&self.net, q, from);
                best.offer(found.phi, found.at);
                best.polished = Some(found);
                found
            }
        };
        if !inside(&found) {
            found =
                evaluate(&self.net, q, std::array::from_fn(|k| found.at[k].clamp(area[k][0], area[k][1])));
        }
        let lower = self.convex_bound(&found, area, curvature);
        if lower >= best.enough {
            best.lower = best.lower.min(lower);
        }
        lower >= best.enough
    }

    /// The least that φ can be on a piece whose Hessian is above the diagonal matrix `curvature` (in the
    /// piece's local parameters), from value and gradient at one place of it.
    fn convex_bound(&self, at: &Stationary<D>, area: &Area<D>, curvature: [f64; D]) -> f64 {
        let mut lower = at.phi;
        for k in 0..D {
            let [a, b] = area[k];
            let half = 0.5 * (b - a);
            let x = [(a - at.at[k]) / half, (b - at.at[k]) / half];
            let gradient = at.gradient[k] * half;
            let unsure = half * self.gradient_rounding(at, k);
            let least = |g: f64| least_on(g, curvature[k], x).1;
            // The least value is concave in the gradient: one of the two ends is the worst.
            lower += least(gradient - unsure).min(least(gradient + unsure));
        }
        lower - 8.0 * UNIT_ROUNDOFF * at.phi
    }

    /// A bound on the error of component k of φ's gradient by the parameters of `[0, 1]ᴰ`.
    pub fn gradient_rounding(&self, at: &Stationary<D>, k: usize) -> f64 {
        self.net.rounding() * at.speed[k] + self.net.slope_rounding(k, at.at[k]) * at.distance
    }
}

/// The two halves of a box along an axis.
pub(super) fn halves<const D: usize>(area: Area<D>, axis: usize) -> [Area<D>; 2] {
    let [a, b] = area[axis];
    let middle = 0.5 * (a + b);
    let (mut first, mut second) = (area, area);
    first[axis] = [a, middle];
    second[axis] = [middle, b];
    [first, second]
}

/// Buffers for making pieces.
#[derive(Debug, Default)]
pub(super) struct Workshop {
    pub net: Vec<DVec4>,
    pub square: Vec<DVec4>,
    scratch: PieceScratch,
}

impl Workshop {
    pub fn piece<const D: usize>(&mut self, net: &LocalNet, area: &Area<D>) -> Option<Piece<D>> {
        net.restrict(area, &mut self.net);
        Piece::new(&self.net, net.degrees(), net.rounding(), &mut self.scratch)
    }
}

/// A node of a tree in the making that may be cut; the least affine one comes first.
struct Waiting {
    nonlinearity: f64,
    node: usize,
    axis: usize,
    cuts: usize,
}

impl Waiting {
    fn new<const D: usize>(piece: &Piece<D>, axis: usize, node: usize, cuts: usize) -> Option<Self> {
        let nonlinearity = piece.nonlinearity()[axis];
        (nonlinearity > FLAT && cuts < MOST_CUTS).then_some(Self { nonlinearity, node, axis, cuts })
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Waiting {}
impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.nonlinearity.total_cmp(&other.nonlinearity).then_with(|| other.node.cmp(&self.node))
    }
}
