//! Differences of control points with their binomial factors, as the kernels of this module want them.

use crate::binomial::Row;

/// `n!/(n−k)! · C(n−k,i) · Δᵏ Pᵢ`, i = 0…n−k, for points of `dimension` numbers; none for k > n.
pub(super) fn scaled_differences(points: &[f64], dimension: usize, order: usize) -> Vec<f64> {
    let mut q = points.to_vec();
    let mut factor = 1.0;
    for _ in 0..order {
        let Some(degree) = (q.len() / dimension).checked_sub(1) else { break };
        factor *= degree as f64;
        for i in 0..degree * dimension {
            q[i] = q[i + dimension] - q[i];
        }
        q.truncate(degree * dimension);
    }
    let Some(degree) = (q.len() / dimension).checked_sub(1) else { return q };
    let mut row = Row::new(degree);
    for (i, point) in q.chunks_exact_mut(dimension).enumerate() {
        let binomial = if i == 0 { 1.0 } else { row.coefficient(i) };
        point.iter_mut().for_each(|x| *x *= factor * binomial);
    }
    q
}
