use std::collections::HashMap;

use crate::edges::{Edges, HalfEdge};
use crate::{MeshError, TriangleMesh};

impl TriangleMesh {
    /// The closed chains of edges that belong to one triangle only, as vertex indices.
    ///
    /// A loop starts at its least vertex and runs as the triangle beside its first edge does: about a patch whose
    /// normal points at the reader, counter-clockwise outside and clockwise around holes. Loops come in the order of
    /// their first vertices. Where two fans of triangles touch in one vertex only, each fan is rounded by itself and
    /// the vertex is visited once a fan. Triangles that name a vertex twice are ignored.
    ///
    /// Error: an index out of range, or an edge of more than two triangles, where "the next edge of the boundary" has
    /// no meaning. Cost: O(T log T).
    ///
    /// ```
    /// use casteljau_mesh::{TriangleMesh, glam::DVec3};
    /// let mesh = TriangleMesh {
    ///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y],
    ///     triangles: vec![[0, 1, 2], [0, 2, 3]],
    ///     ..Default::default()
    /// };
    /// assert_eq!(mesh.boundary_loops()?, [[0, 1, 2, 3]]);
    /// # Ok::<(), casteljau_mesh::MeshError>(())
    /// ```
    pub fn boundary_loops(&self) -> Result<Vec<Vec<u32>>, MeshError> {
        let edges = Edges::new(self)?;
        let mut boundary: Vec<HalfEdge> = Vec::new();
        for edge in edges.iter() {
            match edge {
                [side] => boundary.push(*side),
                [_, _] => {}
                _ => {
                    return Err(MeshError::NonManifoldEdge {
                        from: edge[0].low,
                        to: edge[0].high,
                        triangles: edge.len(),
                    });
                }
            }
        }
        // In each fan about a vertex exactly two boundary edges end, the first and the last of the fan.
        let mut fans = edges.fans(self);
        let mut ends: HashMap<u32, [usize; 2]> = HashMap::with_capacity(boundary.len());
        let mut fan_of = Vec::with_capacity(boundary.len());
        for (number, side) in boundary.iter().enumerate() {
            let [low, high] = side.corners().map(|corner| fans.root(corner as u32));
            for fan in [low, high] {
                ends.entry(fan).or_insert([number, number])[1] = number;
            }
            fan_of.push(if side.backward { [high, low] } else { [low, high] });
        }
        let mut loops = Vec::new();
        let mut visited = vec![false; boundary.len()];
        for start in 0..boundary.len() {
            if visited[start] {
                continue;
            }
            let mut chain = Vec::new();
            let mut number = start;
            let mut entry = fan_of[start][0];
            while !visited[number] {
                visited[number] = true;
                let forward = fan_of[number][0] == entry;
                let [from, to] = boundary[number].ends();
                chain.push(if forward { from } else { to });
                entry = fan_of[number][usize::from(forward)];
                let [first, last] = ends[&entry];
                number = if first == number { last } else { first };
            }
            loops.push(from_least(chain));
        }
        loops.sort_unstable();
        Ok(loops)
    }
}

/// The same loop, started at its least vertex.
fn from_least(mut chain: Vec<u32>) -> Vec<u32> {
    let least = chain.iter().enumerate().min_by_key(|&(place, &vertex)| (vertex, place));
    if let Some((place, _)) = least {
        chain.rotate_left(place);
    }
    chain
}
