use casteljau_geom::glam::DVec3;

use crate::edges::Edges;
use crate::union_find::UnionFind;
use crate::{MeshError, TriangleMesh};

/// What [`TriangleMesh::audit`] found: topology by index, and the shape of the triangles.
///
/// Triangles that name a vertex twice count as [`degenerate`](Self::degenerate) and take no part in the topology.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Audit {
    /// Vertices, referenced or not.
    pub vertices: usize,
    /// Triangles, degenerate or not.
    pub triangles: usize,
    /// Edges.
    pub edges: usize,
    /// There are triangles, and every edge belongs to two or more of them.
    pub closed: bool,
    /// A surface, with or without boundary: [`edge_manifold`](Self::edge_manifold) and
    /// [`vertex_manifold`](Self::vertex_manifold).
    pub manifold: bool,
    /// No edge belongs to more than two triangles.
    pub edge_manifold: bool,
    /// The triangles about each vertex form one fan.
    pub vertex_manifold: bool,
    /// As many triangles run along each inner edge one way as the other.
    pub oriented: bool,
    /// Edges of one triangle.
    pub boundary_edges: usize,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Inner edges along which the directions of the triangles do not balance.
    pub misoriented_edges: usize,
    /// Vertices whose triangles form more than one fan.
    pub non_manifold_vertices: usize,
    /// Vertices that no triangle names.
    pub unreferenced_vertices: usize,
    /// Triangles that name a vertex twice, or whose height over the longest edge is at most 4u times the largest
    /// coordinate, which is what rounding the coordinates alone can make of a triangle without area.
    pub degenerate: usize,
    /// Pieces that hang together through shared vertices.
    pub components: usize,
    /// `V − E + F` over the referenced vertices: 2 for each closed piece without handles, 1 for a disc.
    pub euler_characteristic: i64,
    /// The least angle of a triangle that is not degenerate, in radians; `None` without such a triangle.
    pub min_angle: Option<f64>,
    /// The greatest such angle.
    pub max_angle: Option<f64>,
}

impl TriangleMesh {
    /// Audits topology and triangle shape. An empty mesh is manifold and oriented, and not closed.
    ///
    /// Error: the mesh does not [hold together](Self::validate), or a coordinate is beyond
    /// [`MAX_COORDINATE`](crate::MAX_COORDINATE). Angles are exact to a few u, however thin or small the triangle, as
    /// far as its edges are. Cost: O(T log T).
    ///
    /// ```
    /// # use casteljau_mesh::{TriangleMesh, glam::DVec3};
    /// # let mesh = TriangleMesh { positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y], triangles: vec![[0, 1, 2]], ..Default::default() };
    /// let audit = mesh.audit()?;
    /// assert!(audit.manifold && audit.oriented && !audit.closed);
    /// assert_eq!(audit.boundary_edges, 3);
    /// assert_eq!(audit.euler_characteristic, 1);
    /// # Ok::<(), casteljau_mesh::MeshError>(())
    /// ```
    pub fn audit(&self) -> Result<Audit, MeshError> {
        self.validate_measurable()?;
        let edges = Edges::new(self)?;
        let (mut count, mut boundary, mut non_manifold, mut misoriented) = (0, 0, 0, 0);
        for edge in edges.iter() {
            count += 1;
            boundary += usize::from(edge.len() == 1);
            non_manifold += usize::from(edge.len() > 2);
            let backward = edge.iter().filter(|side| side.backward).count();
            misoriented += usize::from(edge.len() > 1 && 2 * backward != edge.len());
        }
        let pieces = self.pieces(&edges);
        let shape = self.angles();
        Ok(Audit {
            vertices: self.positions.len(),
            triangles: self.triangles.len(),
            edges: count,
            closed: count > 0 && boundary == 0,
            manifold: non_manifold == 0 && pieces.pinched == 0,
            edge_manifold: non_manifold == 0,
            vertex_manifold: pieces.pinched == 0,
            oriented: misoriented == 0,
            boundary_edges: boundary,
            non_manifold_edges: non_manifold,
            misoriented_edges: misoriented,
            non_manifold_vertices: pieces.pinched,
            unreferenced_vertices: pieces.unreferenced,
            degenerate: shape.degenerate,
            components: pieces.components,
            euler_characteristic: pieces.vertices as i64 - count as i64 + pieces.triangles as i64,
            min_angle: shape.range.map(|range| range[0]),
            max_angle: shape.range.map(|range| range[1]),
        })
    }

    /// Counts fans and connected pieces.
    fn pieces(&self, edges: &Edges) -> Pieces {
        let mut fans = edges.fans(self);
        let mut joined = UnionFind::new(self.positions.len());
        let mut named = vec![false; self.positions.len()];
        let mut fan_at: Vec<Option<u32>> = vec![None; self.positions.len()];
        let mut pinched = vec![false; self.positions.len()];
        let mut triangles = 0;
        for (index, &corners) in self.triangles.iter().enumerate() {
            let [a, b, c] = corners;
            corners.iter().for_each(|&vertex| named[vertex as usize] = true);
            if a == b || b == c || c == a {
                continue;
            }
            triangles += 1;
            joined.join(a, b);
            joined.join(b, c);
            for (place, vertex) in corners.into_iter().enumerate() {
                let fan = fans.root((3 * index + place) as u32);
                pinched[vertex as usize] |= *fan_at[vertex as usize].get_or_insert(fan) != fan;
            }
        }
        let in_surface = |vertex: &usize| fan_at[*vertex].is_some();
        let vertices = (0..self.positions.len()).filter(in_surface).count();
        let components = (0..self.positions.len())
            .filter(in_surface)
            .filter(|&v| joined.root(v as u32) as usize == v)
            .count();
        Pieces {
            vertices,
            triangles,
            components,
            pinched: pinched.into_iter().filter(|&p| p).count(),
            unreferenced: named.into_iter().filter(|&n| !n).count(),
        }
    }

    /// Angles of all triangles that have any.
    fn angles(&self) -> Shape {
        let largest = self.positions.iter().fold(0.0_f64, |max, p| max.max(p.abs().max_element()));
        let mut shape = Shape { degenerate: 0, range: None };
        for corners in self.triangle_corners() {
            match angles(corners, 2.0 * f64::EPSILON * largest) {
                None => shape.degenerate += 1,
                Some(angles) => {
                    let [min, max] = shape.range.unwrap_or([f64::INFINITY, 0.0]);
                    let least = angles.into_iter().fold(min, f64::min);
                    let greatest = angles.into_iter().fold(max, f64::max);
                    shape.range = Some([least, greatest]);
                }
            }
        }
        shape
    }
}

/// Connectivity, of the triangles with three different vertices.
struct Pieces {
    vertices: usize,
    triangles: usize,
    components: usize,
    pinched: usize,
    unreferenced: usize,
}

/// Degenerate triangles, and the range of the angles of the others.
struct Shape {
    degenerate: usize,
    range: Option<[f64; 2]>,
}

/// The three angles, or `None` where the height over the longest edge is at most `height`.
fn angles([a, b, c]: [DVec3; 3], height: f64) -> Option<[f64; 3]> {
    let sides = [b - a, c - b, a - c];
    let size = sides.iter().fold(0.0_f64, |max, side| max.max(side.abs().max_element()));
    if size == 0.0 {
        return None;
    }
    // Scaled to size 1, so that the squares of a tiny triangle do not vanish.
    let [p, q, r] = sides.map(|side| side / size);
    let area = p.cross(q).length();
    let longest = p.length().max(q.length()).max(r.length());
    if area * size <= height * longest {
        return None;
    }
    Some([area.atan2(-p.dot(r)), area.atan2(-q.dot(p)), area.atan2(-r.dot(q))])
}
