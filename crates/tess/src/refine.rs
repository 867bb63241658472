//! Refinement until the triangles are within the chord tolerance of the surface, as measured.

use casteljau_geom::glam::{DVec2, DVec3};

use crate::TessError;
use crate::draft::Draft;
use crate::measure::{bulge, distance_to_triangle, is_bend};
use crate::topology::NONE;

/// Rounds of measuring and splitting.
const ROUNDS: usize = 80;
/// Rounds in which triangles with poor angles are split too.
const ANGLE_ROUNDS: usize = 4;
/// Rounds in which edges are flipped and vertices moved; later ones split only.
const SHAPE_ROUNDS: usize = 10;
/// The part of the tolerance that the measured places are kept to, for the sake of those between them.
const MARGIN: f64 = 0.93;
/// A triangle with a corner on the outline, beside which the surface is least like a quadratic one, is measured at more places
/// where more than this part of the tolerance is foretold.
const CLOSE: f64 = 0.7;
/// A triangle without boundary vertices is measured where the normals foretell more than this part of the tolerance.
const CLEAR: f64 = 0.5;
/// An edge is measured where they foretell more than this part, or where they were wrong about the centroid.
const SAFE: f64 = 0.8;
/// Largest difference, as a part of the tolerance, between what the normals foretell and what is measured.
const TRUST: f64 = 0.15;

/// Further places beside an edge, in triangles whose surface may rise steeply there: weights of the corner opposite the edge
/// and of its ends.
const BESIDE: [[f64; 3]; 3] = [[0.1, 0.45, 0.45], [0.1, 0.75, 0.15], [0.1, 0.15, 0.75]];

/// What is wrong with a triangle.
#[derive(Clone, Copy)]
enum Fault {
    /// The edge opposite this corner.
    Edge(usize),
    Center,
}

/// What the normals at the corners foretell of a triangle.
struct Forecast {
    /// Bulges along the normals at the middles of the edges opposite each corner.
    bulges: [f64; 3],
    /// By how much the surface may be further off beside an edge's middle than at it.
    skew: f64,
    /// Whether the triangle need not be measured.
    clear: bool,
    /// Whether all corners have normals that are not too far apart.
    known: bool,
}

/// Chord errors of one triangle.
struct Suspect {
    triangle: u32,
    /// The surface at the centroid.
    at: DVec3,
    /// Its distance, or that of a place beside the outline.
    center: f64,
    /// Errors foretold at the edges' middles; zero on the outline, where the curve's own bound holds.
    edges: [f64; 3],
    /// Edges to measure.
    measure: [bool; 3],
    /// Edges to measure places beside of: those on the outline, and all where the surface may bend too much for a few places
    /// to tell.
    beside: [bool; 3],
    /// By how much other places may be further off.
    skew: f64,
}

impl Draft<'_> {
    /// Angles only: for a mesh by resolution.
    pub fn finish_angles(&mut self) -> Result<(), TessError> {
        for round in 0..ANGLE_ROUNDS {
            (self.tell)(0.8 + 0.05 * round as f64)?;
            self.improve()?;
            if self.split_poor()? == 0 {
                break;
            }
        }
        self.improve()?;
        self.split_forbidden()
    }

    /// Splits until the tolerance is kept; [`TessError::ToleranceMissed`] where that does not come to an end.
    pub fn refine(&mut self, tolerance: f64) -> Result<(), TessError> {
        let mut reached = f64::INFINITY;
        for round in 0..ROUNDS {
            (self.tell)(0.8 + 0.2 * round as f64 / ROUNDS as f64)?;
            // Where the surface folds over, angles in space and places in the plane pull against each other for ever.
            if round < SHAPE_ROUNDS {
                self.improve()?;
            }
            if round < ANGLE_ROUNDS && self.split_poor()? > 0 {
                self.improve()?;
            }
            self.split_forbidden()?;
            let (faults, largest) = self.faults(tolerance)?;
            if faults.is_empty() {
                self.chord_error = self.chord_error.max(largest);
                return Ok(());
            }
            reached = largest;
            if self.split_faulty(&faults, round < SHAPE_ROUNDS)? == 0 {
                break;
            }
        }
        let (patch, vertices) = (self.request.patch, self.points.len());
        Err(TessError::ToleranceMissed { patch, tolerance, reached, vertices })
    }

    /// Measures the triangles that changed; those beyond the tolerance, and the largest error met.
    fn faults(&mut self, tolerance: f64) -> Result<(Vec<(u32, Fault)>, f64), TessError> {
        let mut changed: Vec<u32> = Vec::new();
        for t in 0..self.topology.triangles.len() as u32 {
            if !self.passed[t as usize] {
                if self.forecast(t, tolerance).clear {
                    self.passed[t as usize] = true;
                } else {
                    changed.push(t);
                }
            }
        }
        let third = |t: &u32| {
            let [a, b, c] = self.topology.triangles[*t as usize].map(|v| self.plane[v as usize]);
            (a + b + c) / 3.0
        };
        let centers = self.surface(&changed.iter().map(third).collect::<Vec<_>>())?;
        let suspects: Vec<Suspect> =
            changed.iter().zip(centers).map(|(&t, center)| self.suspect(t, center, tolerance)).collect();

        let mut places: Vec<DVec2> = Vec::new();
        for s in &suspects {
            let corners = self.topology.triangles[s.triangle as usize].map(|v| self.plane[v as usize]);
            let middles = (0..3).filter(|&k| s.measure[k]);
            places.extend(middles.map(|k| corners[(k + 1) % 3].midpoint(corners[(k + 2) % 3])));
            for k in (0..3).filter(|&k| s.beside[k]) {
                let [a, b, c] = [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
                places.extend(BESIDE.map(|[x, y, z]| a * x + b * y + c * z));
            }
        }
        let mut more = self.surface(&places)?.into_iter();

        let (mut faults, mut largest) = (Vec::new(), 0.0f64);
        for mut s in suspects {
            for k in (0..3).filter(|&k| s.measure[k]) {
                s.edges[k] = more.next().map_or(0.0, |middle| self.distance(s.triangle, middle, 0.0));
            }
            let aim = MARGIN * tolerance - s.skew;
            s.center = self.distance(s.triangle, s.at, aim);
            let count = BESIDE.len() * s.beside.iter().filter(|&&beside| beside).count();
            for beside in more.by_ref().take(count) {
                s.center = s.center.max(self.distance(s.triangle, beside, aim));
            }
            let worst = (0..3).fold(0, |w, k| if s.edges[k] > s.edges[w] { k } else { w });
            largest = largest.max(s.edges[worst]).max(s.center);
            if s.edges[worst] > aim {
                faults.push((s.triangle, Fault::Edge(worst)));
            } else if s.center > aim {
                faults.push((s.triangle, Fault::Center));
            } else {
                self.passed[s.triangle as usize] = true;
            }
        }
        Ok((faults, largest))
    }

    /// Whether two corners' normals are too far apart to foretell anything.
    fn is_bent(&self, t: u32) -> bool {
        let [a, b, c] = self.topology.triangles[t as usize].map(|v| self.normals[v as usize]);
        is_bend(a, b) || is_bend(b, c) || is_bend(c, a)
    }

    /// Distance from a triangle, or from its neighbours where they are nearer and it is above `enough`: a place that slid
    /// along the surface is no error.
    fn distance(&self, t: u32, place: DVec3, enough: f64) -> f64 {
        let own = distance_to_triangle(place, self.corners(t));
        if own <= enough {
            return own;
        }
        let across = self.topology.across[t as usize].into_iter().filter(|&u| u != NONE);
        across.map(|u| distance_to_triangle(place, self.corners(u))).fold(own, f64::min)
    }

    fn forecast(&self, t: u32, tolerance: f64) -> Forecast {
        let vertices = self.topology.triangles[t as usize].map(|v| v as usize);
        let corners = self.corners(t);
        let mut bulges = [0.0; 3];
        let (mut most, mut skew) = (0.0f64, 0.0f64);
        for (k, out) in bulges.iter_mut().enumerate() {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (start, end) = (self.normals[vertices[i]], self.normals[vertices[j]]);
            *out = bulge(corners[i], start, corners[j], end);
            // Were the surface quadratic, both ends would say the same; the difference is of third order.
            let chord = corners[j] - corners[i];
            let difference = (chord.dot(start) + chord.dot(end)) / 8.0;
            most = most.max(out.abs() + difference.abs());
            // (1 − x²)(b + dx), the cubic along the edge, is largest near x = d/2b, and there b + d²/4b.
            let larger = out.abs().max(difference.abs());
            skew = skew.max(if larger > 0.0 { 0.25 * difference * difference / larger } else { 0.0 });
        }
        let known = vertices.iter().all(|&v| self.normals[v] != DVec3::ZERO) && !self.is_bent(t);
        let total = (4.0 / 9.0 * bulges.iter().sum::<f64>()).abs();
        let clear = known && !self.at_boundary(t) && most.max(total) <= CLEAR * tolerance;
        let skew = if known { skew } else { 0.0 };
        Forecast { bulges, skew, clear, known }
    }

    /// A triangle, with the surface at its centroid.
    fn suspect(&self, t: u32, at: DVec3, tolerance: f64) -> Suspect {
        let Forecast { bulges, skew, known, .. } = self.forecast(t, tolerance);
        let corners = self.corners(t);
        // A quadratic through the corners is 4/9 of the sum of its bulges at the centroid.
        let foretold = 4.0 / 9.0 * bulges.iter().sum::<f64>();
        let normals = self.topology.triangles[t as usize].map(|v| self.normals[v as usize]);
        let normal = (normals[0] + normals[1] + normals[2]).normalize_or_zero();
        let seen = (at - (corners[0] + corners[1] + corners[2]) / 3.0).dot(normal);
        let trusted = known && (seen - foretold).abs() <= TRUST * tolerance;
        let inner = |k: usize| self.topology.across[t as usize][k] != NONE;
        let edges: [f64; 3] = std::array::from_fn(|k| if inner(k) { bulges[k].abs() } else { 0.0 });
        let measure = std::array::from_fn(|k| inner(k) && (!trusted || bulges[k].abs() > SAFE * tolerance));
        let largest = edges.iter().copied().fold(seen.abs(), f64::max);
        let steep = self.is_bent(t) || self.at_boundary(t) && largest > CLOSE * tolerance;
        let beside = std::array::from_fn(|k| steep || !inner(k));
        Suspect { triangle: t, at, center: 0.0, edges, measure, beside, skew }
    }

    /// Splits each faulty triangle once; how many splits that made.
    ///
    /// Longest edges in space keep the shapes good. Longest edges in the plane bring every triangle's diameter there to
    /// zero, and with it, the surface being continuous, its error.
    fn split_faulty(&mut self, faults: &[(u32, Fault)], in_space: bool) -> Result<usize, TessError> {
        let mut touched = vec![false; self.topology.triangles.len()];
        let mut count = 0;
        for &(t, fault) in faults {
            // A triangle split on the way has corners without a point.
            if touched[t as usize] {
                continue;
            }
            let edge = match fault {
                Fault::Edge(k) if in_space => k,
                _ if in_space => self.longest_edge(t),
                _ => self.longest_edge_in_plane(t),
            };
            let done = if self.topology.across[t as usize][edge] == NONE {
                self.split_center(t, &mut touched)?
            } else {
                self.split_edge(t, edge, &mut touched)?
            };
            count += usize::from(done);
        }
        self.evaluate_new([0.8, 0.8])?;
        Ok(count)
    }
}
