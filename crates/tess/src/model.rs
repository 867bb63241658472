//! What the patches of a model share: sides, and the vertices on them.

use std::collections::{HashMap, HashSet};

use casteljau_gb::Location;
use casteljau_geom::glam::DVec3;

use crate::draft::Outline;
use crate::report::{Report, SideId};
use crate::side::{NoSamples, SideSamples};
use crate::side_key::SideKey;
use crate::surface::{Fault, Surface};
use crate::{Density, TessError};

/// One curve, and the sides along it.
struct SharedSide {
    samples: SideSamples,
    symmetric: bool,
    collapsed: bool,
    uses: Vec<(SideId, bool)>,
}

/// The sides of all patches, sampled once a curve.
pub(crate) struct Model {
    pub outlines: Vec<Outline>,
    /// For each patch and each sample of its outline a vertex; merged where sides are shared.
    pub vertices: Vec<Vec<u32>>,
    /// Number of those vertices.
    pub count: usize,
    shared: Vec<SharedSide>,
}

impl Model {
    /// Samples all sides. `merge` makes one vertex of the samples that shared sides have in common.
    pub fn new(
        surfaces: &[Box<dyn Surface + '_>],
        density: Density,
        limit: usize,
        merge: bool,
    ) -> Result<Self, TessError> {
        let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
        let mut shared: Vec<SharedSide> = Vec::new();
        let mut outlines = Vec::with_capacity(surfaces.len());
        let mut total = 0usize;
        for (patch, surface) in surfaces.iter().enumerate() {
            let mut outline = Outline::default();
            let n = surface.domain().len();
            for side in 0..n {
                let key = SideKey::new(&surface.side_net(side));
                let place = match known.get(&key.bits()) {
                    Some(&place) => place,
                    None => {
                        known.insert(key.bits(), shared.len());
                        let samples =
                            SideSamples::canonical(&key, density, limit).map_err(|why| match why {
                                NoSamples::TooMany(needed) => {
                                    TessError::TooManyVertices { patch, needed, limit }
                                }
                                NoSamples::Shape(source) => Fault::Shape(source).of(patch),
                            })?;
                        let SideKey { symmetric, collapsed, .. } = key;
                        shared.push(SharedSide { samples, symmetric, collapsed, uses: Vec::new() });
                        shared.len() - 1
                    }
                };
                shared[place].uses.push((SideId { patch, side }, key.reversed));
                let canonical = &shared[place].samples;
                // A shared side counts with each patch; the limit is on what is at work.
                total = total.saturating_add(canonical.points().len() - 1);
                if total > limit.saturating_mul(2) {
                    return Err(TessError::TooManyVertices { patch, needed: total as f64, limit });
                }
                let reversed;
                let samples = if key.reversed {
                    reversed = canonical.reversed();
                    &reversed
                } else {
                    canonical
                };
                outline.starts.push(outline.points.len());
                let own = samples.points().len() - 1;
                outline.points.extend_from_slice(&samples.points()[..own]);
                let at = |&t: &f64| match t {
                    0.0 => Location::Corner((side + n - 1) % n),
                    t => Location::Side { side, t },
                };
                outline.locations.extend(samples.parameters()[..own].iter().map(at));
                outline.chord_error = outline.chord_error.max(samples.chord_error());
            }
            outlines.push(outline);
        }
        let mut model = Self { outlines, vertices: Vec::new(), count: 0, shared };
        model.number(merge);
        if model.count > limit {
            let (patch, needed) = (surfaces.len() - 1, model.count as f64);
            return Err(TessError::TooManyVertices { patch, needed, limit });
        }
        Ok(model)
    }

    /// Numbers the samples, and gives those that are one vertex one point and, with `merge`, one number.
    ///
    /// The points of shared sides are the same already, but for ends that are the same to rounding only, as there are at
    /// collapsed edges.
    fn number(&mut self, merge: bool) {
        let mut offsets = Vec::with_capacity(self.outlines.len());
        let mut total = 0;
        for outline in &self.outlines {
            offsets.push(total);
            total += outline.points.len();
        }
        // A collapsed side is one vertex of its patch even where patches keep their own.
        let mut apart: Vec<usize> = (0..total).collect();
        for side in self.shared.iter().filter(|side| side.collapsed) {
            for &(id, _) in &side.uses {
                let [start, end] = [0, side.samples.points().len() - 1];
                let [start, end] = [start, end].map(|j| offsets[id.patch] + self.sample_of(id, j));
                join(&mut apart, start, end);
            }
        }
        let mut together = apart.clone();
        for side in &self.shared {
            let count = side.samples.points().len();
            let Some((&(first, first_reversed), others)) = side.uses.split_first() else { continue };
            for &(other, reversed) in others {
                for j in 0..count {
                    let twin = if reversed == first_reversed { j } else { count - 1 - j };
                    let a = offsets[first.patch] + self.sample_of(first, j);
                    let b = offsets[other.patch] + self.sample_of(other, twin);
                    join(&mut together, a, b);
                }
            }
        }
        let points: Vec<DVec3> = self.outlines.iter().flat_map(|o| o.points.iter().copied()).collect();
        for (outline, &offset) in self.outlines.iter_mut().zip(&offsets) {
            for (sample, point) in outline.points.iter_mut().enumerate() {
                *point = points[root(&mut together, offset + sample)];
            }
        }
        let parent = if merge { &mut together } else { &mut apart };
        let mut numbers = vec![u32::MAX; total];
        let mut count = 0u32;
        for sample in 0..total {
            let root = root(parent, sample);
            if numbers[root] == u32::MAX {
                numbers[root] = count;
                count += 1;
            }
            numbers[sample] = numbers[root];
        }
        self.vertices = offsets
            .iter()
            .zip(&self.outlines)
            .map(|(&offset, outline)| numbers[offset..offset + outline.points.len()].to_vec())
            .collect();
        self.count = count as usize;
    }

    /// Index in its patch's outline of sample `j` along a side.
    fn sample_of(&self, id: SideId, j: usize) -> usize {
        let outline = &self.outlines[id.patch];
        (outline.starts[id.side] + j) % outline.points.len()
    }

    /// Edges along all sides, between the numbers of their ends.
    pub fn side_edges(&self) -> HashSet<[u32; 2]> {
        let around = |numbers: &Vec<u32>| {
            let next = numbers.iter().cycle().skip(1);
            numbers.iter().zip(next).map(|(&a, &b)| [a.min(b), a.max(b)]).collect::<Vec<_>>()
        };
        self.vertices.iter().flat_map(around).collect()
    }

    /// Says which sides are open, crowded or run the wrong way, by the names that the shapes give them.
    pub fn report(&self, surfaces: &[Box<dyn Surface + '_>], report: &mut Report) {
        let name = |id: SideId| SideId { side: surfaces[id.patch].side_name(id.side), ..id };
        for side in self.shared.iter().filter(|side| !side.collapsed) {
            let uses: Vec<_> = side.uses.iter().map(|&(id, reversed)| (name(id), reversed)).collect();
            match uses[..] {
                [(only, _)] => report.open_sides.push(only),
                [(first, a), (second, b)] if a == b && !side.symmetric => {
                    report.misoriented.push([first, second]);
                }
                [_, _] => {}
                _ => report.crowded_sides.extend(uses.iter().map(|u| u.0)),
            }
        }
        report.open_sides.sort_unstable();
        report.crowded_sides.sort_unstable();
    }
}

fn root(parent: &mut [usize], mut x: usize) -> usize {
    while parent[x] != x {
        parent[x] = parent[parent[x]];
        x = parent[x];
    }
    x
}

/// The lesser number stays the root, so that the outcome does not depend on the order.
fn join(parent: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(parent, a), root(parent, b));
    parent[a.max(b)] = a.min(b);
}

/// The unit normal of vertices that got none from the surface: along the sum of the triangles' area vectors.
pub(crate) fn fill_in_normals(normals: &mut [DVec3], points: &[DVec3], triangles: &[[u32; 3]]) -> usize {
    let missing: Vec<usize> = (0..normals.len()).filter(|&v| normals[v] == DVec3::ZERO).collect();
    if missing.is_empty() {
        return 0;
    }
    let mut sums: HashMap<usize, DVec3> = missing.iter().map(|&v| (v, DVec3::ZERO)).collect();
    for t in triangles {
        if t.iter().any(|&v| normals[v as usize] == DVec3::ZERO) {
            let [a, b, c] = t.map(|v| points[v as usize]);
            for v in t {
                if let Some(sum) = sums.get_mut(&(*v as usize)) {
                    *sum += (b - a).cross(c - a);
                }
            }
        }
    }
    let mut without = 0;
    for v in missing {
        let sum = sums.get(&v).copied().unwrap_or(DVec3::ZERO);
        // Scaled first: squares of small areas vanish.
        let scaled = sum / sum.abs().max_element();
        normals[v] = scaled.try_normalize().unwrap_or_else(|| {
            without += 1;
            DVec3::Z
        });
    }
    without
}
