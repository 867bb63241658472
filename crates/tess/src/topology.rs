//! Triangles with their neighbours, for flips and splits.

/// No triangle.
pub(crate) const NONE: u32 = u32::MAX;

/// Triangles of a disc, counter-clockwise, with the triangles across their edges.
pub(crate) struct Topology {
    pub triangles: Vec<[u32; 3]>,
    /// `across[t][k]` is the triangle beyond the edge of t opposite its corner k, [`NONE`] at the boundary.
    pub across: Vec<[u32; 3]>,
    /// A triangle at each vertex.
    at: Vec<u32>,
}

impl Topology {
    /// Finds the neighbours. No edge may belong to more than two triangles. Cost: linear.
    pub fn new(triangles: Vec<[u32; 3]>, vertices: usize) -> Self {
        // Triangles around each vertex, one list after another.
        let mut start = vec![0u32; vertices + 1];
        triangles.iter().flatten().for_each(|&v| start[v as usize + 1] += 1);
        for v in 0..vertices {
            start[v + 1] += start[v];
        }
        let mut fill = start.clone();
        // The edge that leaves the vertex: where it goes, and the triangle and corner opposite it.
        let mut leaving = vec![(0u32, 0u32, 0u8); 3 * triangles.len()];
        for (t, corners) in triangles.iter().enumerate() {
            for k in 0..3 {
                let (from, to) = (corners[(k + 1) % 3] as usize, corners[(k + 2) % 3]);
                leaving[fill[from] as usize] = (to, t as u32, k as u8);
                fill[from] += 1;
            }
        }
        let mut across = vec![[NONE; 3]; triangles.len()];
        let mut at = vec![NONE; vertices];
        for (t, corners) in triangles.iter().enumerate() {
            for k in 0..3 {
                at[corners[k] as usize] = t as u32;
                let (from, to) = (corners[(k + 1) % 3], corners[(k + 2) % 3] as usize);
                let twins = &leaving[start[to] as usize..start[to + 1] as usize];
                if let Some(&(_, twin, _)) = twins.iter().find(|(end, _, _)| *end == from) {
                    across[t][k] = twin;
                }
            }
        }
        Self { triangles, across, at }
    }

    /// Which corner of `t` lies opposite the triangle `u`.
    pub fn corner_opposite(&self, t: u32, u: u32) -> usize {
        let across = self.across[t as usize];
        if across[0] == u {
            0
        } else if across[1] == u {
            1
        } else {
            2
        }
    }

    /// The corner of the triangle across the edge of `t` opposite corner `k`, and that triangle; `None` at the boundary.
    pub fn beyond(&self, t: u32, k: usize) -> Option<(u32, usize)> {
        let u = self.across[t as usize][k];
        (u != NONE).then(|| (u, self.corner_opposite(u, t)))
    }

    fn relink(&mut self, t: u32, old: u32, new: u32) {
        if t != NONE {
            let k = self.corner_opposite(t, old);
            self.across[t as usize][k] = new;
        }
    }

    /// Replaces the edge of `t` opposite corner `k` by the other diagonal; returns the two triangles.
    ///
    /// With t = (a, b, c) and u = (d, c, b) the triangles become t = (a, b, d) and u = (a, d, c).
    pub fn flip(&mut self, t: u32, k: usize) -> Option<[u32; 2]> {
        let (u, j) = self.beyond(t, k)?;
        let [a, b, c] = rotated(self.triangles[t as usize], k);
        let d = self.triangles[u as usize][j];
        let [_, beyond_ca, beyond_ab] = rotated(self.across[t as usize], k);
        let [_, beyond_bd, beyond_dc] = rotated(self.across[u as usize], j);
        self.triangles[t as usize] = [a, b, d];
        self.across[t as usize] = [beyond_bd, u, beyond_ab];
        self.triangles[u as usize] = [a, d, c];
        self.across[u as usize] = [beyond_dc, beyond_ca, t];
        self.relink(beyond_bd, u, t);
        self.relink(beyond_ca, t, u);
        for (vertex, triangle) in [(a, t), (b, t), (d, t), (c, u)] {
            self.at[vertex as usize] = triangle;
        }
        Some([t, u])
    }

    /// Splits the inner edge of `t` opposite corner `k` at a new vertex; returns the four triangles.
    ///
    /// t = (a, b, c) and u = (d, c, b) become (a, b, v), (a, v, c) and (d, c, v), (d, v, b).
    pub fn split_edge(&mut self, t: u32, k: usize) -> Option<[u32; 4]> {
        let (u, j) = self.beyond(t, k)?;
        let [a, b, c] = rotated(self.triangles[t as usize], k);
        let d = self.triangles[u as usize][j];
        let [_, beyond_ca, beyond_ab] = rotated(self.across[t as usize], k);
        let [_, beyond_bd, beyond_dc] = rotated(self.across[u as usize], j);
        let v = self.at.len() as u32;
        let t2 = self.triangles.len() as u32;
        let u2 = t2 + 1;
        self.triangles[t as usize] = [a, b, v];
        self.across[t as usize] = [u2, t2, beyond_ab];
        self.triangles.push([a, v, c]);
        self.across.push([u, beyond_ca, t]);
        self.triangles[u as usize] = [d, c, v];
        self.across[u as usize] = [t2, u2, beyond_dc];
        self.triangles.push([d, v, b]);
        self.across.push([t, beyond_bd, u]);
        self.relink(beyond_ca, t, t2);
        self.relink(beyond_bd, u, u2);
        self.at.push(t);
        for (vertex, triangle) in [(a, t), (b, t), (c, t2), (d, u)] {
            self.at[vertex as usize] = triangle;
        }
        Some([t, t2, u, u2])
    }

    /// Splits `t` = (a, b, c) at a new vertex inside into (a, b, v), (b, c, v), (c, a, v).
    pub fn split_triangle(&mut self, t: u32) -> [u32; 3] {
        let [a, b, c] = self.triangles[t as usize];
        let [beyond_bc, beyond_ca, beyond_ab] = self.across[t as usize];
        let v = self.at.len() as u32;
        let second = self.triangles.len() as u32;
        let third = second + 1;
        self.triangles[t as usize] = [a, b, v];
        self.across[t as usize] = [second, third, beyond_ab];
        self.triangles.push([b, c, v]);
        self.across.push([third, t, beyond_bc]);
        self.triangles.push([c, a, v]);
        self.across.push([t, second, beyond_ca]);
        self.relink(beyond_bc, t, second);
        self.relink(beyond_ca, t, third);
        self.at.push(t);
        self.at[b as usize] = t;
        self.at[c as usize] = second;
        self.at[a as usize] = t;
        [t, second, third]
    }

    /// The triangles around an inner vertex, in order; empty for one on the boundary.
    pub fn star(&self, vertex: u32, out: &mut Vec<u32>) {
        out.clear();
        let first = self.at[vertex as usize];
        let mut t = first;
        loop {
            out.push(t);
            let corners = self.triangles[t as usize];
            let k = if corners[0] == vertex {
                0
            } else if corners[1] == vertex {
                1
            } else {
                2
            };
            t = self.across[t as usize][(k + 1) % 3];
            if t == first {
                return;
            }
            if t == NONE || out.len() > self.triangles.len() {
                out.clear();
                return;
            }
        }
    }
}

fn rotated(x: [u32; 3], k: usize) -> [u32; 3] {
    [x[k], x[(k + 1) % 3], x[(k + 2) % 3]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every neighbour knows its neighbour, and shares the edge in the opposite direction.
    fn check(topology: &Topology) {
        for (t, corners) in topology.triangles.iter().enumerate() {
            for k in 0..3 {
                let Some((u, j)) = topology.beyond(t as u32, k) else { continue };
                let other = topology.triangles[u as usize];
                assert_eq!(topology.across[u as usize][j], t as u32);
                assert_eq!(corners[(k + 1) % 3], other[(j + 2) % 3]);
                assert_eq!(corners[(k + 2) % 3], other[(j + 1) % 3]);
            }
        }
        for (v, &t) in topology.at.iter().enumerate() {
            assert!(topology.triangles[t as usize].contains(&(v as u32)));
        }
    }

    #[test]
    fn neighbours_survive_flips_and_splits() {
        // A hexagon around vertex 6.
        let fan: Vec<[u32; 3]> = (0..6).map(|i| [i, (i + 1) % 6, 6]).collect();
        let mut topology = Topology::new(fan, 7);
        check(&topology);
        let mut star = Vec::new();
        topology.star(6, &mut star);
        assert_eq!(star.len(), 6);
        topology.star(0, &mut star);
        assert!(star.is_empty());
        let mut inner = 6;
        for (round, step) in [0, 1, 2, 0, 1, 2, 2, 1, 0, 0, 2, 1].into_iter().enumerate() {
            let t = (7 * round as u32 + step) % topology.triangles.len() as u32;
            let k = (0..3).find(|k| topology.beyond(t, *k).is_some()).unwrap();
            match step {
                0 => drop(topology.flip(t, k).unwrap()),
                1 => inner += topology.split_edge(t, k).map_or(0, |_| 1),
                _ => inner += topology.split_triangle(t).len() - 2,
            }
            check(&topology);
            let vertices = topology.at.len();
            // Euler's formula for a disc with six boundary edges.
            assert_eq!(topology.triangles.len(), 2 * (vertices - 6) + 4);
        }
        assert!(inner > 6);
    }
}
