//! Bounds of scalar polynomials over a wedge.

use super::WedgeNet;
use crate::simplex::{SimplexExtremes, extremes, halves_across, hull, steepest_edge, vertex_place};
use crate::subdivide;

impl WedgeNet<'_, f64> {
    /// The least and the greatest control point: all values over the wedge lie between them.
    #[must_use]
    pub fn hull(&self) -> [f64; 2] {
        hull(self.points())
    }

    /// The least and the greatest value over the wedge, each enclosed in an interval no longer than `tolerance`, an
    /// absolute one; see [`SimplexNet::extremes`](crate::SimplexNet::extremes) for the method and for when they are
    /// longer. A net that does not fit its degrees gives its hull.
    #[must_use]
    pub fn extremes(&self, tolerance: f64) -> SimplexExtremes {
        let Ok(net) = self.checked() else {
            let [low, high] = self.hull();
            return SimplexExtremes { min: [low, high], max: [low, high] };
        };
        let [n, o] = net.degrees();
        let vertices: Vec<usize> =
            (0..3).flat_map(|vertex| [0, o].map(|k| vertex_place::<3>(n, vertex) * (o + 1) + k)).collect();
        extremes(self.points(), n.max(o), &vertices, tolerance, |net| halves(n, o, net))
    }
}

/// Halves across the triangle's edge or the height, wherever the control points differ most.
fn halves(n: usize, o: usize, net: &[f64]) -> [Vec<f64>; 2] {
    let width = o + 1;
    let (edge, in_triangle) = steepest_edge::<3>(n, width, net);
    let along_height = net.chunks_exact(width).flat_map(|row| row.windows(2));
    let along_height = along_height.fold(0.0, |most: f64, pair| most.max((pair[1] - pair[0]).abs()));
    if in_triangle >= along_height {
        return halves_across::<3>(n, width, edge, net);
    }
    let (mut below, mut above) = (net.to_vec(), net.to_vec());
    let halves = below.chunks_exact_mut(width).zip(above.chunks_exact_mut(width));
    for (row, (below, above)) in net.chunks_exact(width).zip(halves) {
        // Rows have one length, so that this cannot be refused.
        let _ = subdivide(row, 0.5, below, above);
    }
    [below, above]
}
