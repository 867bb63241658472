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
