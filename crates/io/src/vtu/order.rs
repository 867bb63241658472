//! The order in which VTK keeps the control points of Bézier cells: corners, edges, interior.

/// Of a curve of degree n ≥ 1: the ends, then the points between.
///
/// ```
/// assert_eq!(casteljau_io::vtu::curve_order(3), [0, 3, 1, 2]);
/// ```
#[must_use]
pub fn curve_order(degree: usize) -> Vec<usize> {
    [0, degree].into_iter().chain(1..degree).collect()
}

/// Of a patch of degrees m, n ≥ 1, as indices (i, j) of its net: the corners around, the edges v = 0, u = 1, v = 1, u = 0, each
/// with rising parameter, then the interior, i fastest.
///
/// ```
/// let order = casteljau_io::vtu::quadrilateral_order([2, 1]);
/// assert_eq!(order, [[0, 0], [2, 0], [2, 1], [0, 1], [1, 0], [1, 1]]);
/// ```
#[must_use]
pub fn quadrilateral_order([m, n]: [usize; 2]) -> Vec<[usize; 2]> {
    let mut order = Vec::with_capacity((m + 1) * (n + 1));
    order.extend([[0, 0], [m, 0], [m, n], [0, n]]);
    order.extend((1..m).map(|i| [i, 0]));
    order.extend((1..n).map(|j| [m, j]));
    order.extend((1..m).map(|i| [i, n]));
    order.extend((1..n).map(|j| [0, j]));
    order.extend((1..n).flat_map(|j| (1..m).map(move |i| [i, j])));
    order
}

/// Of a triangle of degree n ≥ 1, as indices (i, j, k) of its net: VTK's parameters (r, s) are our (λ₁, λ₂), so that its
/// first vertex is our last.
///
/// The vertices λ₃ = 1, λ₁ = 1, λ₂ = 1, the edges in the same turn, then the triangle of degree n − 3 inside, likewise.
///
/// ```
/// let order = casteljau_io::vtu::triangle_order(2);
/// assert_eq!(order, [[0, 0, 2], [2, 0, 0], [0, 2, 0], [1, 0, 1], [1, 1, 0], [0, 1, 1]]);
/// ```
#[must_use]
pub fn triangle_order(degree: usize) -> Vec<[usize; 3]> {
    let mut order = Vec::with_capacity((degree + 1) * (degree + 2) / 2);
    let (mut n, mut ring) = (degree, 0);
    loop {
        let inside = |[i, j, k]: [usize; 3]| [i + ring, j + ring, k + ring];
        if n == 0 {
            order.push(inside([0; 3]));
            return order;
        }
        order.extend([[0, 0, n], [n, 0, 0], [0, n, 0]].map(inside));
        order.extend((1..n).map(|t| inside([t, 0, n - t])));
        order.extend((1..n).map(|t| inside([n - t, t, 0])));
        order.extend((1..n).map(|t| inside([0, n - t, t])));
        if n < 3 {
            return order;
        }
        (n, ring) = (n - 3, ring + 1);
    }
}

/// Of a tetrahedron of degree n ≥ 1, as indices (i, j, k, l) of its net: VTK's parameters (r, s, t) are our (λ₁, λ₂, λ₃),
/// so that its first vertex is our last.
///
/// The vertices λ₄ = 1, λ₁ = 1, λ₂ = 1, λ₃ = 1; the edges; inside the faces, triangles of degree n − 3 in their own
/// order; the tetrahedron of degree n − 4 inside, likewise.
///
/// ```
/// let order = casteljau_io::vtu::tetrahedron_order(1);
/// assert_eq!(order, [[0, 0, 0, 1], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]);
/// ```
#[must_use]
pub fn tetrahedron_order(degree: usize) -> Vec<[usize; 4]> {
    /// Which of our barycentric coordinates belongs to each of VTK's vertices.
    const VERTICES: [usize; 4] = [3, 0, 1, 2];
    const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
    const FACES: [[usize; 3]; 4] = [[0, 1, 3], [2, 3, 1], [0, 3, 2], [0, 2, 1]];
    let mut order = Vec::with_capacity((degree + 1) * (degree + 2) * (degree + 3) / 6);
    let (mut n, mut shell) = (degree, 0);
    loop {
        let at = |parts: &[(usize, usize)]| {
            let mut index = [shell; 4];
            parts.iter().for_each(|&(vertex, part)| index[VERTICES[vertex]] += part);
            index
        };
        if n == 0 {
            order.push(at(&[]));
            return order;
        }
        order.extend((0..4).map(|vertex| at(&[(vertex, n)])));
        for [a, b] in EDGES {
            order.extend((1..n).map(|t| at(&[(a, n - t), (b, t)])));
        }
        for [a, b, c] in FACES.into_iter().filter(|_| n >= 3) {
            // The first vertex of a triangle is the last of its indices.
            let face = triangle_order(n - 3);
            order.extend(face.iter().map(|&[i, j, k]| at(&[(a, k + 1), (b, i + 1), (c, j + 1)])));
        }
        if n < 4 {
            return order;
        }
        (n, shell) = (n - 4, shell + 1);
    }
}

/// Of a hexahedron of degrees l, m, n ≥ 1, as indices (i, j, k) of its net, in files of version 2.1 and later.
///
/// The corners around w = 0 and around w = 1; the edges likewise, and those along w over the corners in their order; the
/// faces u = 0, u = 1, v = 0, v = 1, w = 0, w = 1; the interior. Inside, i is faster than j, and j than k.
///
/// ```
/// let order = casteljau_io::vtu::hexahedron_order([1, 1, 2]);
/// assert_eq!(order[6], [1, 1, 2]);
/// assert_eq!(order[8..], [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]);
/// ```
#[must_use]
pub fn hexahedron_order([l, m, n]: [usize; 3]) -> Vec<[usize; 3]> {
    hexahedron(l, m, n, [[0, 0], [l, 0], [l, m], [0, m]])
}

/// The same in files of earlier versions, where the last two of the edges along w stand the other way around.
///
/// ```
/// let order = casteljau_io::vtu::old_hexahedron_order([1, 1, 2]);
/// assert_eq!(order[8..], [[0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]]);
/// ```
#[must_use]
pub fn old_hexahedron_order([l, m, n]: [usize; 3]) -> Vec<[usize; 3]> {
    hexahedron(l, m, n, [[0, 0], [l, 0], [0, m], [l, m]])
}

/// `along` are the places of the edges along w.
fn hexahedron(l: usize, m: usize, n: usize, along: [[usize; 2]; 4]) -> Vec<[usize; 3]> {
    let mut order = Vec::with_capacity((l + 1) * (m + 1) * (n + 1));
    for k in [0, n] {
        order.extend([[0, 0, k], [l, 0, k], [l, m, k], [0, m, k]]);
    }
    for k in [0, n] {
        order.extend((1..l).map(|i| [i, 0, k]));
        order.extend((1..m).map(|j| [l, j, k]));
        order.extend((1..l).map(|i| [i, m, k]));
        order.extend((1..m).map(|j| [0, j, k]));
    }
    for [i, j] in along {
        order.extend((1..n).map(|k| [i, j, k]));
    }
    for i in [0, l] {
        order.extend((1..n).flat_map(|k| (1..m).map(move |j| [i, j, k])));
    }
    for j in [0, m] {
        order.extend((1..n).flat_map(|k| (1..l).map(move |i| [i, j, k])));
    }
    for k in [0, n] {
        order.extend((1..m).flat_map(|j| (1..l).map(move |i| [i, j, k])));
    }
    order.extend((1..n).flat_map(|k| (1..m).flat_map(move |j| (1..l).map(move |i| [i, j, k]))));
    order
}

/// Of a wedge of degrees n of the triangle and o of the height, both ≥ 1, as indices (i, j, n − i − j) of the triangle and
/// k along the height: VTK's parameters (r, s, t) are our (λ₁, λ₂, w).
///
/// The vertices λ₃ = 1, λ₁ = 1, λ₂ = 1 of the lower and of the upper triangle; the edges of both in the same turn, and
/// those along the height; the insides of both triangles, of the three quadrilaterals over the edges, and of the whole.
///
/// ```
/// let order = casteljau_io::vtu::wedge_order([1, 1]);
/// assert_eq!(order[..3], [([0, 0, 1], 0), ([1, 0, 0], 0), ([0, 1, 0], 0)]);
/// ```
#[must_use]
pub fn wedge_order([n, o]: [usize; 2]) -> Vec<([usize; 3], usize)> {
    let vertices = [[0, 0, n], [n, 0, 0], [0, n, 0]];
    let edges = |t: usize| [[t, 0, n - t], [n - t, t, 0], [0, n - t, t]];
    let inside = || (1..n).flat_map(move |j| (1..n.saturating_sub(j)).map(move |i| [i, j, n - i - j]));
    let mut order = Vec::with_capacity((n + 1) * (n + 2) / 2 * (o + 1));
    for k in [0, o] {
        order.extend(vertices.map(|vertex| (vertex, k)));
    }
    for k in [0, o] {
        (0..3).for_each(|edge| order.extend((1..n).map(|t| (edges(t)[edge], k))));
    }
    for vertex in vertices {
        order.extend((1..o).map(|k| (vertex, k)));
    }
    for k in [0, o] {
        order.extend(inside().map(|index| (index, k)));
    }
    for edge in 0..3 {
        order.extend((1..o).flat_map(|k| (1..n).map(move |t| (edges(t)[edge], k))));
    }
    order.extend((1..o).flat_map(|k| inside().map(move |index| (index, k))));
    order
}
