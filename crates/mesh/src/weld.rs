use std::collections::HashMap;

use casteljau_geom::glam::DVec3;

use crate::{MeshError, TriangleMesh};

/// A mesh whose vertices all lie in different places, and where the vertices of the original went.
#[derive(Clone, Debug, PartialEq)]
pub struct Welded {
    /// The mesh of the merged vertices.
    pub mesh: TriangleMesh,
    /// For each vertex of the original, its index in [`mesh`](Self::mesh).
    pub map: Vec<u32>,
}

impl TriangleMesh {
    /// Merges the vertices whose positions are equal to the bit (−0 counts as 0).
    ///
    /// No tolerance: neighbouring patches give the same bits on a shared side, and what merely lies near is left
    /// apart. The first of equal vertices stays, in its order; its normal becomes the unit vector along the sum of
    /// theirs, or stays its own where they cancel or are all the same. No triangle is dropped: one that becomes degenerate shows in the
    /// [audit](Self::audit). Error: the mesh does not [hold together](Self::validate). Cost: O(V), one hash map.
    ///
    /// ```
    /// use casteljau_mesh::{TriangleMesh, glam::dvec3};
    /// let mesh = TriangleMesh { positions: vec![dvec3(0.0, 1.0, 2.0), dvec3(-0.0, 1.0, 2.0)], ..Default::default() };
    /// assert_eq!(mesh.welded()?.map, [0, 0]);
    /// # Ok::<(), casteljau_mesh::MeshError>(())
    /// ```
    pub fn welded(&self) -> Result<Welded, MeshError> {
        self.validate()?;
        let mut first: HashMap<[u64; 3], u32> = HashMap::with_capacity(self.positions.len());
        let mut map = Vec::with_capacity(self.positions.len());
        let mut mesh = TriangleMesh::default();
        let mut sums: Vec<DVec3> = Vec::new();
        let mut differ: Vec<bool> = Vec::new();
        for (index, &position) in self.positions.iter().enumerate() {
            // Adding 0 turns −0 into 0 and leaves everything else alone.
            let key = (position + DVec3::ZERO).to_array().map(f64::to_bits);
            let target = *first.entry(key).or_insert(mesh.positions.len() as u32);
            let known = (target as usize) < mesh.positions.len();
            if !known {
                mesh.positions.push(position);
            }
            if let Some(&normal) = self.normals.get(index) {
                if known {
                    sums[target as usize] += normal;
                    differ[target as usize] |= normal != mesh.normals[target as usize];
                } else {
                    mesh.normals.push(normal);
                    sums.push(normal);
                    differ.push(false);
                }
            }
            map.push(target);
        }
        for ((normal, sum), differ) in mesh.normals.iter_mut().zip(sums).zip(differ) {
            if differ {
                *normal = sum.try_normalize().unwrap_or(*normal);
            }
        }
        mesh.triangles =
            self.triangles.iter().map(|corners| corners.map(|index| map[index as usize])).collect();
        Ok(Welded { mesh, map })
    }
}
