//! Cells: the polygon, or the parts into which chords cut it.

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use super::outline::{Outline, cross, dot, segment_distance};

/// What an edge of a cell lies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Edge {
    /// The side from vertex k to vertex k + 1, or a part of it.
    Side(usize),
    /// A chord, or a part of it.
    Chord(usize),
}

/// A simple counter-clockwise polygon within the outline.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub(super) points: Vec<Complex64>,
    /// `edges[i]` leaves `points[i]`.
    pub(super) edges: Vec<Edge>,
    /// The polygon's corner that `points[i]` is.
    pub(super) corners: Vec<Option<usize>>,
}

/// A place on an edge of a cell: which edge, and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgePoint {
    pub(super) edge: usize,
    pub(super) z: Complex64,
}

impl Cell {
    /// The whole polygon.
    pub(super) fn whole(outline: &Outline) -> Self {
        let n = outline.len();
        Self {
            points: outline.vertices.clone(),
            edges: (0..n).map(Edge::Side).collect(),
            corners: (0..n).map(Some).collect(),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    /// Ends of edge i.
    pub(super) fn ends(&self, i: usize) -> (Complex64, Complex64) {
        (self.points[i], self.points[(i + 1) % self.len()])
    }

    /// Largest distance of two points.
    pub(super) fn diameter(&self) -> f64 {
        let p = &self.points;
        (0..p.len()).flat_map(|i| (0..i).map(move |j| (p[i] - p[j]).norm())).fold(0.0, f64::max)
    }

    pub(super) fn area(&self) -> f64 {
        let o = self.points[0];
        0.5 * self.points.windows(2).map(|w| cross(w[0] - o, w[1] - o)).sum::<f64>()
    }

    /// Area by the square of the diameter: π/4 for a disc, small for thin cells.
    pub(super) fn fatness(&self) -> f64 {
        self.area() / self.diameter().powi(2)
    }

    /// Centre of the bounding box, and the distance of the farthest point from it.
    pub(super) fn centre_and_radius(&self) -> (Complex64, f64) {
        let fold = |f: fn(f64, f64) -> f64, from: f64, part: fn(&Complex64) -> f64| {
            self.points.iter().map(part).fold(from, f)
        };
        let lo =
            Complex64::new(fold(f64::min, f64::INFINITY, |z| z.re), fold(f64::min, f64::INFINITY, |z| z.im));
        let hi = Complex64::new(
            fold(f64::max, f64::NEG_INFINITY, |z| z.re),
            fold(f64::max, f64::NEG_INFINITY, |z| z.im),
        );
        let centre = 0.5 * (lo + hi);
        (centre, self.points.iter().map(|z| (z - centre).norm()).fold(0.0, f64::max))
    }

    /// Whether `p` lies inside, by the parity of crossings; on the boundary either answer may come.
    pub(super) fn contains(&self, p: Complex64) -> bool {
        let mut inside = false;
        for i in 0..self.len() {
            let (a, b) = self.ends(i);
            if (a.im > p.im) != (b.im > p.im) && p.re < (b.re - a.re) * (p.im - a.im) / (b.im - a.im) + a.re {
                inside = !inside;
            }
        }
        inside
    }

    /// Distance of `p` from the boundary.
    pub(super) fn boundary_distance(&self, p: Complex64) -> f64 {
        (0..self.len())
            .map(|i| {
                let (a, b) = self.ends(i);
                segment_distance(p, a, b)
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// Length of the ray from `z` along the unit vector `d` to the first edge it meets, and that edge; infinite if none.
    ///
    /// Edges that begin within `skip` of `z` are not seen, so that a ray may start on the boundary.
    pub(super) fn ray(&self, z: Complex64, d: Complex64, skip: f64) -> (f64, usize) {
        let mut best = (f64::INFINITY, 0);
        for i in 0..self.len() {
            let (a, b) = self.ends(i);
            let e = b - a;
            let den = cross(d, e);
            if den.abs() < 1e-14 * e.norm() {
                continue;
            }
            let (s, t) = (cross(a - z, e) / den, cross(a - z, d) / den);
            if s > skip && s < best.0 && (-1e-9..=1.0 + 1e-9).contains(&t) {
                best = (s, i);
            }
        }
        best
    }

    /// The arc around `direction` of the circle about `centre` that no edge cuts: its ends, as angles.
    pub(super) fn arc(&self, centre: Complex64, radius: f64, direction: f64) -> [f64; 2] {
        let (mut back, mut forth) = (PI, PI);
        for i in 0..self.len() {
            let (a, b) = self.ends(i);
            let (d, o) = (b - a, a - centre);
            // |o + t·d| = radius
            let (qa, qb, qc) = (d.norm_sqr(), dot(o, d), o.norm_sqr() - radius * radius);
            let root = qb * qb - qa * qc;
            if root < 0.0 {
                continue;
            }
            for t in [(-qb - root.sqrt()) / qa, (-qb + root.sqrt()) / qa] {
                if (-1e-12..=1.0 + 1e-12).contains(&t) {
                    let turn = ((o + d * t) * Complex64::from_polar(1.0, -direction)).arg();
                    if turn > 0.0 {
                        forth = forth.min(turn);
                        back = back.min(TAU - turn);
                    } else {
                        back = back.min(-turn);
                        forth = forth.min(TAU + turn);
                    }
                }
            }
        }
        [direction - back, direction + forth]
    }

    /// Whether the open segment between two places on different edges stays inside.
    pub(super) fn sees(&self, p: &EdgePoint, q: &EdgePoint) -> bool {
        let n = self.len();
        if !self.contains(0.5 * (p.z + q.z)) {
            return false;
        }
        (0..n).all(|i| {
            if i == p.edge || i == q.edge {
                return true;
            }
            let (a, b) = self.ends(i);
            let (r, e) = (q.z - p.z, b - a);
            let den = cross(r, e);
            if den == 0.0 {
                return true;
            }
            let (t, u) = (cross(a - p.z, e) / den, cross(a - p.z, r) / den);
            !((1e-12..=1.0 - 1e-12).contains(&t) && (-1e-12..=1.0 + 1e-12).contains(&u))
        })
    }

    /// The two cells on the left and right of the chord from `p` to `q`, where `p.edge < q.edge`.
    pub(super) fn split(&self, p: &EdgePoint, q: &EdgePoint, chord: usize) -> (Self, Self) {
        let n = self.len();
        let part = |from: &EdgePoint, to: &EdgePoint, between: Vec<usize>| {
            let mut cell =
                Self { points: vec![from.z], edges: vec![self.edges[from.edge]], corners: vec![None] };
            for i in between {
                cell.points.push(self.points[i]);
                cell.edges.push(self.edges[i]);
                cell.corners.push(self.corners[i]);
            }
            cell.points.push(to.z);
            cell.edges.push(Edge::Chord(chord));
            cell.corners.push(None);
            cell
        };
        let left = part(p, q, (p.edge + 1..=q.edge).collect());
        let right = part(q, p, (q.edge + 1..n).chain(0..=p.edge).collect());
        (left, right)
    }

    /// Parameters of edge i on the side k of the outline that it lies on: 0 at vertex k, 1 at vertex k + 1.
    pub(super) fn side_range(&self, outline: &Outline, i: usize, k: usize) -> [f64; 2] {
        let (start, d) = (outline.vertices[k], outline.vertex(k + 1) - outline.vertices[k]);
        let place = |j: usize| match self.corners[j % self.len()] {
            Some(c) if c == k => 0.0,
            Some(c) if c == (k + 1) % outline.len() => 1.0,
            _ => dot(d, self.points[j % self.len()] - start) / d.norm_sqr(),
        };
        [place(i), place(i + 1)]
    }
}
