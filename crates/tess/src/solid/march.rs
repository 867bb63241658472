//! Marching tetrahedra in the parameters: where a polynomial over solids vanishes, on the tetrahedra of their lattices.

use std::collections::HashMap;

use casteljau_geom::glam::DVec3;
use casteljau_mesh::Cell;

use super::complex::{Complex, Place};
use super::field::Level;
use super::lattice::{LatticeCell, cube_tetrahedra, hexahedron, wedges};
use super::net::{Degrees, Local};
use super::section_error::Gauge;
use crate::TessError;
use crate::progress::Progress;

/// Blocks of the lattice are halved down to cubes of this edge before their cells are looked at.
const LEAF: u32 = 2;
/// Steps of the search for a crossing.
const STEPS: usize = 80;

/// Values within so many times their rounding bound are zero.
const SNAP: f64 = 16.0;
/// At most so many places of the lattices are looked at for each vertex that is allowed; a surface has a handful of them around a vertex.
const PLACES_PER_VERTEX: usize = 8;
/// As many are looked at in any case.
const FEWEST_PLACES: usize = 1 << 22;

/// Even orders of a tetrahedron's corners that begin with each one, and with each pair.
const ALONE: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 0, 1, 3], [3, 0, 2, 1]];
const PAIRS: [[usize; 4]; 6] =
    [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 2, 0, 3], [1, 3, 2, 0], [2, 3, 0, 1]];

/// A vertex of the lattices: its number, and the level's value.
#[derive(Clone, Copy)]
struct Node {
    number: u32,
    value: f64,
}

/// A corner of a tetrahedron in work.
#[derive(Clone, Copy)]
struct Corner {
    node: Node,
    place: Place,
    at: [u32; 4],
    local: Local,
}

/// A vertex of the surface and where it is in the solid in work.
#[derive(Clone, Copy)]
pub(crate) struct Crossing {
    pub vertex: u32,
    pub local: Local,
    /// It is a node of the lattice.
    snapped: bool,
}

/// The surface, as far as it is found.
#[derive(Default)]
pub(crate) struct Surface {
    pub points: Vec<DVec3>,
    /// The solid that each vertex was found in, and where.
    pub origins: Vec<(usize, Local)>,
    pub triangles: Vec<[u32; 3]>,
    /// For each solid the largest chord error that was measured in it.
    pub errors: Vec<f64>,
}

impl Surface {
    /// Leaves out the vertices that no triangle names: where the surface only touches a node or an edge.
    fn compact(&mut self) {
        let mut number = vec![u32::MAX; self.points.len()];
        self.triangles.iter().flatten().for_each(|&v| number[v as usize] = 0);
        let mut count = 0;
        for (vertex, number) in number.iter_mut().enumerate() {
            if *number == 0 {
                *number = count as u32;
                self.points[count] = self.points[vertex];
                self.origins[count] = self.origins[vertex];
                count += 1;
            }
        }
        self.points.truncate(count);
        self.origins.truncate(count);
        self.triangles.iter_mut().for_each(|t| *t = t.map(|v| number[v as usize]));
    }
}

/// What a march needs.
pub(crate) struct March<'a> {
    pub complex: &'a Complex,
    pub levels: &'a [Level],
    pub counts: &'a [u32],
    pub limit: usize,
    /// Moves a point onto the surface where the surface is known, as a plane is.
    pub pull: &'a dyn Fn(DVec3) -> DVec3,
    pub gauge: &'a Gauge<'a>,
}

struct State {
    nodes: HashMap<Place, Node>,
    /// By the numbers of the nodes below and above: the vertex, and how far along the edge it is.
    crossings: HashMap<[u32; 2], (u32, f64)>,
    surface: Surface,
    /// Triangles of three nodes each, by their nodes in order: two of them cancel.
    flat: HashMap<[u32; 3], usize>,
}

impl March<'_> {
    /// Finds the surface in all solids.
    pub fn run(&self, progress: &Progress<'_>) -> Result<Surface, TessError> {
        let surface = Surface { errors: vec![0.0; self.complex.len()], ..Surface::default() };
        let mut state =
            State { nodes: HashMap::new(), crossings: HashMap::new(), surface, flat: HashMap::new() };
        let total = self.complex.len();
        for solid in 0..total {
            progress.part(solid, total);
            self.solid(solid, &mut state, progress)?;
        }
        let mut surface = state.surface;
        surface.triangles.retain(|t| *t != GONE);
        surface.compact();
        Ok(surface)
    }

    /// All blocks of a solid that the surface may pass through.
    fn solid(&self, solid: usize, state: &mut State, progress: &Progress<'_>) -> Result<(), TessError> {
        let degrees = self.complex.degrees(solid);
        let counts = self.complex.counts_of(solid, self.counts);
        let steps = degrees.steps(counts);
        let level = &self.levels[solid];
        // By the convex hull property no place is below; where the level is zero all over the solid, every place would be looked at.
        if level.coefficients.iter().all(|&c| c >= 0.0) {
            return Ok(());
        }
        let most = self.limit.saturating_mul(PLACES_PER_VERTEX).max(FEWEST_PLACES);
        let mut todo = vec![[[0, steps[0]], [0, steps[1]], [0, steps[2]]]];
        let mut done = 0.0;
        let whole: f64 = steps.iter().map(|&n| f64::from(n)).product();
        while let Some(block) = todo.pop() {
            let volume: f64 = block.iter().map(|[a, b]| f64::from(b - a)).product();
            let Some((at, widths)) = representative(degrees, block, counts) else {
                done += volume;
                continue;
            };
            let value = level.degrees.value(&level.coefficients, degrees.local(at, counts)).abs();
            // Between two places of the domain a value changes by no more than the slopes allow.
            let change: f64 =
                (0..3).map(|a| level.slopes[a] * f64::from(widths[a]) / f64::from(steps[a])).sum();
            if value > change + 2.0 * SNAP * level.rounding {
                done += volume;
                continue;
            }
            let longest = (0..3).max_by_key(|&a| block[a][1] - block[a][0]).unwrap_or(0);
            let [low, high] = block[longest];
            if high - low > LEAF {
                let middle = low + (high - low) / 2;
                for half in [[middle, high], [low, middle]] {
                    let mut part = block;
                    part[longest] = half;
                    todo.push(part);
                }
                continue;
            }
            self.block(solid, block, counts, state)?;
            if state.nodes.len() > most {
                let needed = state.nodes.len() as f64;
                return Err(TessError::TooManySolidVertices { solid, needed, limit: most });
            }
            done += volume;
            progress.tell(done / whole)?;
        }
        Ok(())
    }

    fn block(
        &self,
        solid: usize,
        block: [[u32; 2]; 3],
        counts: [u32; 3],
        state: &mut State,
    ) -> Result<(), TessError> {
        let degrees = self.complex.degrees(solid);
        let [[a, a_end], [b, b_end], [c, c_end]] = block;
        for i in a..a_end {
            for j in b..b_end {
                for k in c..c_end {
                    match degrees {
                        Degrees::Hexahedron(_) => self.cell(solid, hexahedron([i, j, k]), counts, state)?,
                        Degrees::Tetrahedron(_) if i >= j && j >= k => {
                            for cell in cube_tetrahedra([i, j, k], counts[0]) {
                                self.cell(solid, cell, counts, state)?;
                            }
                        }
                        Degrees::Wedge(_) if i + j < counts[0] => {
                            for cell in wedges(i, j, counts[0] - i - j, k).into_iter().flatten() {
                                self.cell(solid, cell, counts, state)?;
                            }
                        }
                        _ => {}
                    }
                }
            }
        }
        Ok(())
    }

    fn cell(
        &self,
        solid: usize,
        cell: LatticeCell,
        counts: [u32; 3],
        state: &mut State,
    ) -> Result<(), TessError> {
        let degrees = self.complex.degrees(solid);
        let corners: Vec<Corner> = cell
            .places()
            .iter()
            .map(|&at| {
                let place = self.complex.place(solid, at, counts);
                let local = degrees.local(at, counts);
                Corner { node: self.node(solid, place, local, state), place, at, local }
            })
            .collect();
        let below = corners.iter().filter(|c| c.node.value < 0.0).count();
        if below == 0 || below == corners.len() {
            return Ok(());
        }
        // Tetrahedra by the order of places, which neighbours share; a place that is met twice has one rank.
        let mut sorted: Vec<Place> = corners.iter().map(|c| c.place).collect();
        sorted.sort_unstable();
        sorted.dedup();
        let rank = |i: usize| sorted.partition_point(|&place| place < corners[i].place) as u32;
        let ranked = match cell {
            LatticeCell::Hexahedron(_) => Cell::Hexahedron(std::array::from_fn(rank)),
            LatticeCell::Tetrahedron(_) => Cell::Tetrahedron(std::array::from_fn(rank)),
            LatticeCell::Wedge(_) => Cell::Wedge(std::array::from_fn(rank)),
        };
        for tetrahedron in ranked.tetrahedra() {
            let corner = |rank: u32| corners.iter().find(|c| c.place == sorted[rank as usize]);
            if let [Some(a), Some(b), Some(c), Some(d)] = tetrahedron.map(corner) {
                self.tetrahedron(solid, [*a, *b, *c, *d], counts, state)?;
            }
        }
        Ok(())
    }

    /// The node at a place. Values within a few roundings are zero, and count as above: crossings so near would be places of one point.
    fn node(&self, solid: usize, place: Place, local: Local, state: &mut State) -> Node {
        let fresh = state.nodes.len() as u32;
        *state.nodes.entry(place).or_insert_with(|| {
            let level = &self.levels[solid];
            let value = level.degrees.value(&level.coefficients, local);
            Node { number: fresh, value: if value.abs() <= SNAP * level.rounding { 0.0 } else { value } }
        })
    }

    /// One or two triangles, counter-clockwise seen from where the level rises to; the corners are right side out in the parameters.
    fn tetrahedron(
        &self,
        solid: usize,
        corners: [Corner; 4],
        counts: [u32; 3],
        state: &mut State,
    ) -> Result<(), TessError> {
        let below = corners.map(|c| c.node.value < 0.0);
        let mut cross = |a: Corner, b: Corner| self.crossing(solid, a, b, counts, state);
        let mut triangles: Vec<[Crossing; 3]> = Vec::with_capacity(2);
        match below.iter().filter(|b| **b).count() {
            count @ (1 | 3) => {
                let alone = below.iter().position(|&b| b == (count == 1)).unwrap_or(0);
                let [p, q, r, s] = ALONE[alone].map(|i| corners[i]);
                let around = if count == 1 {
                    [cross(p, q)?, cross(p, r)?, cross(p, s)?]
                } else {
                    [cross(q, p)?, cross(s, p)?, cross(r, p)?]
                };
                triangles.push(around);
            }
            2 => {
                let order =
                    PAIRS.iter().find(|order| below[order[0]] && below[order[1]]).unwrap_or(&PAIRS[0]);
                let [p, q, r, s] = order.map(|i| corners[i]);
                let [a, b, c, d] = [cross(p, r)?, cross(p, s)?, cross(q, s)?, cross(q, r)?];
                let at = |c: Crossing| state.surface.points[c.vertex as usize];
                if at(a).distance_squared(at(c)) <= at(b).distance_squared(at(d)) {
                    triangles.extend([[a, b, c], [a, c, d]]);
                } else {
                    triangles.extend([[a, b, d], [b, c, d]]);
                }
            }
            _ => {}
        }
        for triangle in triangles {
            self.triangle(solid, triangle, state);
        }
        Ok(())
    }

    fn triangle(&self, solid: usize, corners: [Crossing; 3], state: &mut State) {
        let [a, b, c] = corners.map(|c| c.vertex);
        if a == b || b == c || c == a {
            return;
        }
        if corners.iter().all(|c| c.snapped) {
            let mut key = [a, b, c];
            key.sort_unstable();
            // A wall of nodes with the level below on both sides: the surface only touches it.
            if let Some(other) = state.flat.remove(&key) {
                state.surface.triangles[other] = GONE;
                return;
            }
            state.flat.insert(key, state.surface.triangles.len());
        }
        let error = &mut state.surface.errors[solid];
        *error = error.max(self.gauge.error(solid, corners, &state.surface.points));
        let inverted = self.complex.is_inverted(solid);
        state.surface.triangles.push(if inverted { [a, c, b] } else { [a, b, c] });
    }

    /// Where the level passes zero between a corner below and one above.
    fn crossing(
        &self,
        solid: usize,
        below: Corner,
        above: Corner,
        counts: [u32; 3],
        state: &mut State,
    ) -> Result<Crossing, TessError> {
        let snapped = above.node.value == 0.0;
        let key = if snapped { [above.node.number; 2] } else { [below.node.number, above.node.number] };
        let (from, to) = (self.facing(solid, below, above, counts), self.facing(solid, above, below, counts));
        let known = state.crossings.get(&key).copied();
        let at = |t: f64| -> Local { std::array::from_fn(|a| from[a] + t * (to[a] - from[a])) };
        let t = match known {
            Some((_, t)) => t,
            None if snapped => 1.0,
            None => self.root(solid, &at, below.node.value, above.node.value),
        };
        let local = if snapped { above.local } else { at(t) };
        let vertex = match known {
            Some((vertex, _)) => vertex,
            None => {
                let surface = &mut state.surface;
                if surface.points.len() >= self.limit {
                    let (needed, limit) = (surface.points.len() as f64 + 1.0, self.limit);
                    return Err(TessError::TooManySolidVertices { solid, needed, limit });
                }
                let point = if snapped {
                    self.complex.point(above.place, solid, above.at, counts)?
                } else {
                    self.complex.net(solid).point(local)
                };
                let vertex = surface.points.len() as u32;
                surface.points.push((self.pull)(point) + DVec3::ZERO);
                surface.origins.push((solid, local));
                state.crossings.insert(key, (vertex, t));
                vertex
            }
        };
        Ok(Crossing { vertex, local, snapped })
    }

    /// The parameters of a corner as the other end of its edge sees it: where a face or an edge is one point or one curve, that of its
    /// parameters which lies across from the other end, so that the edge stays on the faces that both are on.
    fn facing(&self, solid: usize, corner: Corner, other: Corner, counts: [u32; 3]) -> Local {
        let degrees = self.complex.degrees(solid);
        if corner.place.dimension() == degrees.carrier(corner.at, counts).dimension() {
            return corner.local;
        }
        let axes: &[usize] = match degrees {
            Degrees::Hexahedron(_) => &[0, 1, 2],
            Degrees::Tetrahedron(_) => &[],
            Degrees::Wedge(_) => &[3],
        };
        let mut at = corner.at;
        for &axis in axes {
            let mut moved = at;
            moved[axis] = other.at[axis];
            if self.complex.place(solid, moved, counts) == corner.place {
                at = moved;
            }
        }
        degrees.local(at, counts)
    }

    /// The parameter between 0 and 1 where the level is zero, from the values below and above it there, to all figures.
    ///
    /// By false position, halving the weight of an end that stays (Illinois), and by bisection where that is slow.
    fn root(&self, solid: usize, at: &dyn Fn(f64) -> Local, below: f64, above: f64) -> f64 {
        let level = &self.levels[solid];
        let (mut low, mut high) = ((0.0, below), (1.0, above));
        let mut side = 0i8;
        for step in 0..STEPS {
            let width = high.0 - low.0;
            let t = if step % 4 == 3 {
                low.0 + 0.5 * width
            } else {
                (low.0 - low.1 * width / (high.1 - low.1)).clamp(low.0, high.0)
            };
            if !(t > low.0 && t < high.0) {
                break;
            }
            let value = level.degrees.value(&level.coefficients, at(t));
            if value.abs() <= 0.125 * level.rounding {
                return t;
            }
            if value < 0.0 {
                low = (t, value);
                if side < 0 {
                    high.1 *= 0.5;
                }
                side = -1;
            } else {
                high = (t, value);
                if side > 0 {
                    low.1 *= 0.5;
                }
                side = 1;
            }
        }
        0.5 * (low.0 + high.0)
    }
}

/// A triangle that was cancelled.
const GONE: [u32; 3] = [u32::MAX; 3];

/// A place of the lattice in a block of cells, and how far others of the block may be from it; `None` where the block has
/// no place in the domain.
fn representative(degrees: Degrees, block: [[u32; 2]; 3], counts: [u32; 3]) -> Option<([u32; 4], [u32; 3])> {
    let [[a, a_end], [b, b_end], [c, c_end]] = block;
    let widths = [a_end - a, b_end - b, c_end - c];
    let n = counts[0];
    let at = match degrees {
        Degrees::Hexahedron(_) => [a, b, c, 0],
        Degrees::Wedge(_) if a + b <= n => [a, b, n - a - b, c],
        Degrees::Tetrahedron(_) if c <= b_end && b.max(c) <= a_end => {
            // n ≥ x ≥ y ≥ z ≥ 0.
            let (x, y, z) = (a_end, b.max(c), c);
            [n - x, x - y, y - z, z]
        }
        _ => return None,
    };
    Some((at, widths))
}
