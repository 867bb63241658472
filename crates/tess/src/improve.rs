//! Better angles in space: flips, moved vertices, split edges. The triangles of the plane never turn over.

use casteljau_geom::glam::{DMat2, DVec2, DVec3};

use crate::TessError;
use crate::draft::Draft;
use crate::measure::{bulge, cotangent, cotangent_2d};
use crate::topology::NONE;

/// Cotangents of the least angles aimed at: 22° inside and 13° at the boundary, above what is promised by a margin.
const INNER_AIM: f64 = 2.475;
const BOUNDARY_AIM: f64 = 4.331;
/// Edges of triangles with a larger cotangent (an angle below 32°) are looked at for flips.
const FLIP_ABOVE: f64 = 1.6;
/// Largest cotangent (least angle 8°) that a flip or a move may leave in the plane, unless there was a larger one.
const PLANE_LIMIT: f64 = 7.1;
/// Least relative gain of a flip or a move, so that they come to an end.
const GAIN: f64 = 1e-3;
/// Rounds of moving vertices.
const ROUNDS: usize = 6;

impl Draft<'_> {
    /// Flips and moves until the angles are good or no better.
    pub fn improve(&mut self) -> Result<(), TessError> {
        self.flip_changed();
        for _ in 0..ROUNDS {
            if !self.move_vertices()? {
                break;
            }
            self.flip_changed();
        }
        Ok(())
    }

    pub fn cotangent_of(&self, t: u32) -> f64 {
        let [a, b, c] = self.corners(t);
        cotangent(a, b, c)
    }

    /// The cotangent in units of the one aimed at.
    fn poverty(&self, t: u32) -> f64 {
        self.cotangent_of(t) / self.aim(t)
    }

    fn aim(&self, t: u32) -> f64 {
        if self.at_boundary(t) { BOUNDARY_AIM } else { INNER_AIM }
    }

    /// Triangles not yet passed whose kept cotangent is above `limit`, in order.
    fn above(&mut self, limit: impl Fn(&Self, u32) -> f64) -> Vec<u32> {
        let mut found = Vec::new();
        for t in 0..self.topology.triangles.len() {
            if self.passed[t] {
                continue;
            }
            if self.kept_cotangent(t as u32) > limit(self, t as u32) {
                found.push(t as u32);
            }
        }
        found
    }

    fn kept_cotangent(&mut self, t: u32) -> f64 {
        if self.cotangents[t as usize].is_nan() {
            self.cotangents[t as usize] = self.cotangent_of(t);
        }
        self.cotangents[t as usize]
    }

    /// Says that a triangle has other corners, or corners elsewhere, than before.
    fn changed(&mut self, t: u32) {
        self.passed[t as usize] = false;
        self.cotangents[t as usize] = f64::NAN;
        self.settled[t as usize] = false;
        for u in self.topology.across[t as usize].into_iter().filter(|&u| u != NONE) {
            self.settled[u as usize] = false;
        }
        for v in self.topology.triangles[t as usize] {
            self.placed[v as usize] = false;
        }
    }

    /// Flips edges of changed triangles while that widens the least angle of the two triangles.
    fn flip_changed(&mut self) {
        let mut queue = self.above(|_, _| FLIP_ABOVE);
        // Every flip widens a least angle, so there is an end; this bounds it.
        let mut flips = 20 * queue.len() + 100;
        while let Some(t) = queue.pop() {
            if self.settled[t as usize] || flips == 0 {
                continue;
            }
            match (0..3).find(|&k| self.flip_helps(t, k)).and_then(|k| self.topology.flip(t, k)) {
                Some(changed) => {
                    flips -= 1;
                    changed.iter().for_each(|&t| self.changed(t));
                    queue.extend(changed);
                }
                None => self.settled[t as usize] = true,
            }
        }
    }

    fn flip_helps(&mut self, t: u32, k: usize) -> bool {
        let Some((u, j)) = self.topology.beyond(t, k) else { return false };
        let corners = self.topology.triangles[t as usize];
        let [a, b, c] = [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]].map(|v| v as usize);
        let d = self.topology.triangles[u as usize][j] as usize;
        let most = self.kept_cotangent(t).max(self.kept_cotangent(u)) * (1.0 - GAIN);
        let p = |v: usize| self.points[v];
        if cotangent(p(a), p(b), p(d)) > most || cotangent(p(a), p(d), p(c)) > most {
            return false;
        }
        if self.request.forbids(a, d) {
            return false;
        }
        let q = |v: usize| self.plane[v];
        let flat = |x: [usize; 3], y: [usize; 3]| {
            cotangent_2d(q(x[0]), q(x[1]), q(x[2])).max(cotangent_2d(q(y[0]), q(y[1]), q(y[2])))
        };
        if flat([a, b, d], [a, d, c]) > PLANE_LIMIT.max(flat([a, b, c], [d, c, b])) {
            return false;
        }
        // No flip may cost the chord tolerance.
        self.request.tolerance.is_none_or(|tolerance| {
            let across = |x: usize, y: usize| bulge(p(x), self.normals[x], p(y), self.normals[y]).abs();
            across(a, d) <= (0.8 * tolerance).max(across(b, c))
        })
    }

    /// Moves inner vertices of poor triangles, no two neighbours at a time; whether any moved.
    ///
    /// Candidates are judged on the linear map that fits the star best; then the surface is evaluated, and what is no
    /// better goes back.
    fn move_vertices(&mut self) -> Result<bool, TessError> {
        let mut candidates: Vec<u32> = self
            .above(Self::aim)
            .into_iter()
            .flat_map(|t| self.topology.triangles[t as usize])
            .filter(|&v| v as usize >= self.boundary && !self.placed[v as usize])
            .collect();
        candidates.sort_unstable();
        candidates.dedup();
        let mut resting = vec![false; self.points.len()];
        let (mut star, mut moved) = (Vec::new(), Vec::new());
        for vertex in candidates {
            if resting[vertex as usize] {
                continue;
            }
            self.topology.star(vertex, &mut star);
            let Some((place, before)) = self.better_place(vertex, &star) else {
                self.placed[vertex as usize] = true;
                continue;
            };
            for &t in &star {
                self.topology.triangles[t as usize].iter().for_each(|&v| resting[v as usize] = true);
            }
            let v = vertex as usize;
            moved.push((vertex, self.plane[v], self.points[v], self.normals[v], before));
            self.plane[v] = place;
        }
        let vertices: Vec<u32> = moved.iter().map(|m| m.0).collect();
        (self.tell)(0.0)?;
        self.evaluate(&vertices)?;
        let mut any = false;
        for (vertex, place, point, normal, before) in moved {
            self.topology.star(vertex, &mut star);
            if self.penalty(&star) < before * (1.0 - GAIN) {
                star.iter().for_each(|&t| self.changed(t));
                any = true;
            } else {
                let v = vertex as usize;
                (self.plane[v], self.points[v], self.normals[v]) = (place, point, normal);
                self.placed[v] = true;
            }
        }
        Ok(any)
    }

    /// How far the triangles miss the angles aimed at: Σ max(0, cot/aim − 1)².
    fn penalty(&self, star: &[u32]) -> f64 {
        star.iter().map(|&t| excess(self.poverty(t))).sum()
    }

    fn better_place(&self, vertex: u32, star: &[u32]) -> Option<(DVec2, f64)> {
        let before = self.penalty(star);
        let here = self.plane[vertex as usize];
        let origin = self.points[vertex as usize];
        // Each triangle of the star as (vertex, b, c).
        let ring: Vec<[usize; 2]> = star
            .iter()
            .map(|&t| {
                let corners = self.topology.triangles[t as usize].map(|v| v as usize);
                let k = corners.iter().position(|&v| v == vertex as usize).unwrap_or(0);
                [corners[(k + 1) % 3], corners[(k + 2) % 3]]
            })
            .collect();
        if ring.is_empty() || before == 0.0 {
            return None;
        }
        let (mut square, mut cross) = (DMat2::ZERO, [DVec3::ZERO; 2]);
        let (mut middle, mut reach) = (DVec2::ZERO, 0.0);
        for &[b, _] in &ring {
            let (dq, dp) = (self.plane[b] - here, self.points[b] - origin);
            square += DMat2::from_cols(dq * dq.x, dq * dq.y);
            cross[0] += dp * dq.x;
            cross[1] += dp * dq.y;
            middle += dq / ring.len() as f64;
            reach += dq.length() / ring.len() as f64;
        }
        let inverse = square.inverse();
        let jacobian = [
            cross[0] * inverse.x_axis.x + cross[1] * inverse.x_axis.y,
            cross[0] * inverse.y_axis.x + cross[1] * inverse.y_axis.y,
        ];
        let flat = |place: DVec2, [b, c]: [usize; 2]| cotangent_2d(place, self.plane[b], self.plane[c]);
        let limit = ring.iter().map(|&edge| flat(here, edge)).fold(PLANE_LIMIT, f64::max);
        // Given up once it exceeds `most`.
        let predicted = |step: DVec2, most: f64| {
            let (place, point) = (here + step, origin + jacobian[0] * step.x + jacobian[1] * step.y);
            let mut sum = 0.0;
            for &[b, c] in &ring {
                if flat(place, [b, c]) > limit {
                    return f64::INFINITY;
                }
                let touches = b < self.boundary || c < self.boundary;
                let aim = if touches { BOUNDARY_AIM } else { INNER_AIM };
                sum += excess(cotangent(point, self.points[b], self.points[c]) / aim);
                if sum >= most {
                    return f64::INFINITY;
                }
            }
            sum
        };
        let mut best = (before * (1.0 - GAIN), None);
        let mut consider = |step: DVec2| {
            let after = predicted(step, best.0);
            if after < best.0 {
                best = (after, Some(step));
            }
        };
        [1.0, 0.5, 0.25].iter().for_each(|part| consider(middle * *part));
        for step in [0.3, 0.1] {
            for eighth in 0..8 {
                let angle = f64::from(eighth) * std::f64::consts::FRAC_PI_4;
                consider(DVec2::from_angle(angle) * (step * reach));
            }
        }
        best.1.map(|step| (here + step, before))
    }

    /// Splits the longest edges of triangles that stayed poor; how many were split. The new vertices are evaluated.
    pub fn split_poor(&mut self) -> Result<usize, TessError> {
        let mut list = self.above(|draft, t| 1.1 * draft.aim(t));
        list.retain(|&t| !self.hopeless(t));
        let mut touched = vec![false; self.topology.triangles.len()];
        let mut count = 0;
        for t in list {
            // A triangle split on the way has corners without a point.
            if touched[t as usize] {
                continue;
            }
            let longest = self.longest_edge(t);
            count += usize::from(self.split_edge(t, longest, &mut touched)?);
        }
        self.evaluate_new([0.85, 0.9])?;
        Ok(count)
    }

    /// Splits the inner edges that other patches have too; the new vertices are evaluated.
    pub fn split_forbidden(&mut self) -> Result<(), TessError> {
        loop {
            let mut touched = vec![false; self.topology.triangles.len()];
            let mut count = 0;
            for t in 0..self.topology.triangles.len() as u32 {
                let corners = self.topology.triangles[t as usize].map(|v| v as usize);
                for k in 0..3 {
                    if self.request.forbids(corners[(k + 1) % 3], corners[(k + 2) % 3]) {
                        count += usize::from(self.split_edge(t, k, &mut touched)?);
                    }
                }
            }
            if count == 0 {
                return Ok(());
            }
            self.evaluate_new([0.9, 0.9])?;
        }
    }

    /// Whether a triangle's least angle is at a corner of the outline, or its longest edge on it.
    fn hopeless(&self, t: u32) -> bool {
        let k = self.longest_edge(t);
        let corners = self.topology.triangles[t as usize];
        self.topology.across[t as usize][k] == NONE
            || corners.iter().filter(|v| (**v as usize) < self.boundary).count() > 2
    }

    /// The corner opposite the longest edge in space.
    pub fn longest_edge(&self, t: u32) -> usize {
        let [a, b, c] = self.corners(t);
        longest([b.distance_squared(c), c.distance_squared(a), a.distance_squared(b)])
    }

    /// The corner opposite the longest edge in the plane.
    pub fn longest_edge_in_plane(&self, t: u32) -> usize {
        let [a, b, c] = self.topology.triangles[t as usize].map(|v| self.plane[v as usize]);
        longest([b.distance_squared(c), c.distance_squared(a), a.distance_squared(b)])
    }

    /// Splits an inner edge in the middle, unless one of its triangles was touched before; whether it did.
    pub fn split_edge(&mut self, t: u32, k: usize, touched: &mut Vec<bool>) -> Result<bool, TessError> {
        let Some((u, _)) = self.topology.beyond(t, k) else { return Ok(false) };
        if touched[t as usize] || touched[u as usize] {
            return Ok(false);
        }
        let corners = self.topology.triangles[t as usize];
        let [b, c] = [corners[(k + 1) % 3], corners[(k + 2) % 3]].map(|v| self.plane[v as usize]);
        let middle = b.midpoint(c);
        if middle == b || middle == c {
            return Ok(false);
        }
        self.add_vertex(middle)?;
        if let Some(changed) = self.topology.split_edge(t, k) {
            self.touch(&changed, touched);
        }
        Ok(true)
    }

    /// Splits a triangle at its centroid, unless it was touched before; whether it did.
    pub fn split_center(&mut self, t: u32, touched: &mut Vec<bool>) -> Result<bool, TessError> {
        if touched[t as usize] {
            return Ok(false);
        }
        let corners = self.topology.triangles[t as usize].map(|v| self.plane[v as usize]);
        let center = (corners[0] + corners[1] + corners[2]) / 3.0;
        if corners.contains(&center) {
            return Ok(false);
        }
        self.add_vertex(center)?;
        let changed = self.topology.split_triangle(t);
        self.touch(&changed, touched);
        Ok(true)
    }

    fn add_vertex(&mut self, place: DVec2) -> Result<(), TessError> {
        if self.plane.len() >= self.request.room {
            return Err(self.too_many(self.plane.len() as f64 + 1.0));
        }
        self.plane.push(place);
        self.placed.push(false);
        Ok(())
    }

    fn touch(&mut self, changed: &[u32], touched: &mut Vec<bool>) {
        touched.resize(self.topology.triangles.len(), true);
        self.passed.resize(self.topology.triangles.len(), false);
        self.cotangents.resize(self.topology.triangles.len(), f64::NAN);
        self.settled.resize(self.topology.triangles.len(), false);
        for &t in changed {
            touched[t as usize] = true;
            self.changed(t);
        }
    }
}

fn excess(poverty: f64) -> f64 {
    let over = (poverty - 1.0).max(0.0);
    over * over
}

fn longest([x, y, z]: [f64; 3]) -> usize {
    if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    }
}
