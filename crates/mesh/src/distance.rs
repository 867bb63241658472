use casteljau_geom::glam::DVec3;

use crate::measure::check_range;
use crate::{MeshError, TriangleMesh};

/// Triangles in a leaf. Four fill two cache lines of centroids and keep the tree shallow.
const LEAF: usize = 4;

/// The squared sine of the angle below which a triangle is treated as a needle.
const NEEDLE: f64 = 1e-12;

/// The point of a mesh that lies nearest to a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// The nearest point of the mesh.
    pub point: DVec3,
    /// Its distance, in the unit of the coordinates.
    pub distance: f64,
    /// The triangle it lies on; the least number among equally near ones.
    pub triangle: u32,
    /// Its barycentric coordinates in that triangle: non-negative, of sum 1 to rounding.
    pub barycentric: [f64; 3],
}

/// How far a set of points lies from a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The largest distance.
    pub max: f64,
    /// Number of the point it belongs to; the first of equally distant ones.
    pub worst: usize,
    /// The mean of the distances.
    pub mean: f64,
    /// The root of the mean squared distance.
    pub rms: f64,
}

/// The triangles of a mesh in a tree of boxes, for questions of distance.
///
/// A balanced binary tree, split at the median centroid along the longest side of the box: depth ⌈log₂(T/4)⌉ whatever
/// the triangles are like. Building costs O(T log T) and a copy of the corners; a query O(log T) where the triangles
/// are spread like a surface, T at worst. Degenerate triangles count as the segments or points they are.
///
/// ```
/// use casteljau_mesh::{TriangleMesh, TriangleTree, glam::{DVec3, dvec3}};
/// let mesh = TriangleMesh {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
///     triangles: vec![[0, 1, 2]],
///     ..Default::default()
/// };
/// let closest = TriangleTree::new(&mesh)?.closest(dvec3(0.25, 0.25, 3.0))?;
/// assert_eq!((closest.distance, closest.point), (3.0, dvec3(0.25, 0.25, 0.0)));
/// # Ok::<(), casteljau_mesh::MeshError>(())
/// ```
#[derive(Clone, Debug)]
pub struct TriangleTree {
    /// Complete binary tree in depth-first order.
    nodes: Vec<Node>,
    /// Corners, in the order of the leaves.
    corners: Vec<[DVec3; 3]>,
    /// Their numbers in the mesh.
    numbers: Vec<u32>,
}

/// A box around the triangles `start..end`; the left child, if any, is the next node.
#[derive(Clone, Copy, Debug)]
struct Node {
    min: DVec3,
    max: DVec3,
    start: usize,
    end: usize,
    /// The right child, 0 in a leaf.
    right: usize,
}

impl Node {
    /// Squared distance of a point to the box, 0 inside.
    fn distance_squared(&self, p: DVec3) -> f64 {
        (self.min - p).max(p - self.max).max(DVec3::ZERO).length_squared()
    }
}

impl TriangleTree {
    /// Builds the tree.
    ///
    /// Error: [`MeshError::Empty`] without a triangle; the mesh does not [hold together](TriangleMesh::validate), or
    /// a coordinate is beyond [`MAX_COORDINATE`](crate::MAX_COORDINATE).
    pub fn new(mesh: &TriangleMesh) -> Result<Self, MeshError> {
        mesh.validate_measurable()?;
        let limit = u32::MAX as usize;
        if mesh.triangles.len() > limit {
            return Err(MeshError::TooManyTriangles { limit });
        }
        if mesh.triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        let corners: Vec<[DVec3; 3]> = mesh.triangle_corners().collect();
        let mut order: Vec<u32> = (0..corners.len() as u32).collect();
        let mut nodes = Vec::with_capacity(corners.len());
        split(&corners, &mut order, 0, &mut nodes);
        Ok(Self { corners: order.iter().map(|&i| corners[i as usize]).collect(), numbers: order, nodes })
    }

    /// The nearest point of the mesh.
    ///
    /// Error: the point is not finite or beyond [`MAX_COORDINATE`](crate::MAX_COORDINATE). Rounding: the distance is
    /// right to 32u times the size of the coordinates involved.
    pub fn closest(&self, point: DVec3) -> Result<Closest, MeshError> {
        check_range("point", 0, point)?;
        Ok(self.closest_checked(point))
    }

    /// Distances of many points: the largest, and where; mean; root mean square. All are 0 without points.
    ///
    /// With the vertices of another mesh this is the one-sided Hausdorff distance of its vertices.
    /// Error: as for [`closest`](Self::closest), with the number of the point.
    pub fn deviation(&self, points: &[DVec3]) -> Result<Deviation, MeshError> {
        let mut deviation = Deviation { max: 0.0, worst: 0, mean: 0.0, rms: 0.0 };
        for (index, &point) in points.iter().enumerate() {
            check_range("point", index, point)?;
            let distance = self.closest_checked(point).distance;
            if distance > deviation.max {
                (deviation.max, deviation.worst) = (distance, index);
            }
            deviation.mean += distance;
            deviation.rms += distance * distance;
        }
        let count = points.len().max(1) as f64;
        deviation.mean /= count;
        deviation.rms = (deviation.rms / count).sqrt();
        Ok(deviation)
    }

    /// Depth first, the nearer child first, leaving out boxes farther than the best so far.
    fn closest_checked(&self, p: DVec3) -> Closest {
        let mut best =
            Closest { point: p, distance: f64::INFINITY, triangle: u32::MAX, barycentric: [f64::NAN; 3] };
        let mut best_squared = f64::INFINITY;
        // The tree is balanced: its depth, and so the stack, stays below 64.
        let mut stack = [(0, 0.0); 64];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (index, squared): (usize, f64) = stack[height];
            // Equally distant boxes are opened: the least triangle number must win.
            if squared > best_squared {
                continue;
            }
            let node = &self.nodes[index];
            if node.right == 0 {
                for (corners, &triangle) in
                    self.corners[node.start..node.end].iter().zip(&self.numbers[node.start..node.end])
                {
                    let (point, barycentric) = closest_on_triangle(p, corners);
                    let squared = (point - p).length_squared();
                    if squared < best_squared || squared == best_squared && triangle < best.triangle {
                        best_squared = squared;
                        best = Closest { point, distance: squared.sqrt(), triangle, barycentric };
                    }
                }
                continue;
            }
            let (left, right) = (index + 1, node.right);
            let (to_left, to_right) =
                (self.nodes[left].distance_squared(p), self.nodes[right].distance_squared(p));
            let near_last = if to_left <= to_right {
                [(right, to_right), (left, to_left)]
            } else {
                [(left, to_left), (right, to_right)]
            };
            stack[height..height + 2].copy_from_slice(&near_last);
            height += 2;
        }
        best
    }
}

impl TriangleMesh {
    /// The nearest point of the mesh to one point, by looking at every triangle once.
    ///
    /// For many points build a [`TriangleTree`]. Error: as there.
    pub fn closest(&self, point: DVec3) -> Result<Closest, MeshError> {
        self.validate_measurable()?;
        check_range("point", 0, point)?;
        let candidates = self.triangle_corners().zip(0_u32..).map(|(corners, triangle)| {
            let (nearest, barycentric) = closest_on_triangle(point, &corners);
            Closest { point: nearest, distance: nearest.distance(point), triangle, barycentric }
        });
        candidates.min_by(|a, b| a.distance.total_cmp(&b.distance)).ok_or(MeshError::Empty)
    }
}

/// Appends the subtree of `order`, whose first triangle stands at `offset`, and returns its node.
fn split(corners: &[[DVec3; 3]], order: &mut [u32], offset: usize, nodes: &mut Vec<Node>) -> usize {
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &triangle in order.iter() {
        for &corner in &corners[triangle as usize] {
            (min, max) = (min.min(corner), max.max(corner));
        }
    }
    let index = nodes.len();
    nodes.push(Node { min, max, start: offset, end: offset + order.len(), right: 0 });
    if order.len() > LEAF {
        let size = max - min;
        let axis = if size.x >= size.y.max(size.z) { 0 } else { 1 + usize::from(size.z > size.y) };
        // Three times the centroid's coordinate; ties are broken by number, so that the tree is always the same one.
        let key = |triangle: u32| corners[triangle as usize].iter().map(|corner| corner[axis]).sum::<f64>();
        let middle = order.len() / 2;
        order.select_nth_unstable_by(middle, |&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
        let (left, right) = order.split_at_mut(middle);
        split(corners, left, offset, nodes);
        nodes[index].right = split(corners, right, offset + middle, nodes);
    }
    index
}

/// The nearest point of a triangle, and its barycentric coordinates.
///
/// The foot of the perpendicular where it falls inside, else the nearest point of the three sides: right for needles
/// and points too, whose perpendicular has no direction.
fn closest_on_triangle(p: DVec3, &[a, b, c]: &[DVec3; 3]) -> (DVec3, [f64; 3]) {
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let squared = normal.length_squared();
    // Coordinates beside b and c of the part of a vector that lies in the plane: twice signed areas, over the whole.
    let in_plane = |v: DVec3| (v.cross(ac).dot(normal) / squared, ab.cross(v).dot(normal) / squared);
    // In a needle the quotients are only good to u over its least angle: they are refined by what is left over, and,
    // since nothing helps where the normal is noise, compared with the sides.
    let needle = squared <= NEEDLE * ab.length_squared() * ac.length_squared();
    let (mut beta, mut gamma) = in_plane(p - a);
    let mut foot = None;
    // False where the triangle has no area and the quotients are not numbers.
    if beta >= 0.0 && gamma >= 0.0 && beta + gamma <= 1.0 {
        for _ in 0..if needle { 4 } else { 1 } {
            let (more_beta, more_gamma) = in_plane(p - (a + beta * ab + gamma * ac));
            (beta, gamma) = ((beta + more_beta).clamp(0.0, 1.0), (gamma + more_gamma).clamp(0.0, 1.0));
        }
        // Refining may overstep the far side.
        let over = (beta + gamma).max(1.0);
        (beta, gamma) = (beta / over, gamma / over);
        let inside = (a + beta * ab + gamma * ac, [(1.0 - beta - gamma).max(0.0), beta, gamma]);
        if !needle {
            return inside;
        }
        foot = Some(inside);
    }
    let on_side = |from: DVec3, to: DVec3| {
        let along = to - from;
        let t = (p - from).dot(along) / along.length_squared();
        // A side without length gives NaN: its start will do.
        let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
        (if t == 1.0 { to } else { from + t * along }, t)
    };
    let (on_ab, t_ab) = on_side(a, b);
    let (on_bc, t_bc) = on_side(b, c);
    let (on_ca, t_ca) = on_side(c, a);
    let sides = [
        (on_ab, [1.0 - t_ab, t_ab, 0.0]),
        (on_bc, [0.0, 1.0 - t_bc, t_bc]),
        (on_ca, [t_ca, 0.0, 1.0 - t_ca]),
    ];
    let mut best = sides[0];
    for side in sides[1..].iter().chain(&foot) {
        if side.0.distance_squared(p) < best.0.distance_squared(p) {
            best = *side;
        }
    }
    best
}
