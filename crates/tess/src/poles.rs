//! Whether the denominator of a rational surface vanishes, proved on cells.

use casteljau_geom::GeomError;
use casteljau_shape::bernstein::{TriangleNet, multi_indices, restrict_tensor};
use casteljau_shape::{Parameters, ParametricSurface, RationalPatch, RationalTriangle, ShapeError};

/// A cell of this size whose weights have two signs is taken for a pole.
const SMALLEST: f64 = 1.0 / (1u64 << 20) as f64;
/// Cells looked at; beyond it evaluation must find out.
const MOST_CELLS: usize = 20_000;

/// Refuses a patch whose denominator vanishes somewhere in its rectangle.
///
/// Where all weights have one sign it does not. Otherwise the rectangle is quartered until that holds of every cell's
/// net, or a cell is smaller than 2⁻²⁰ of it.
pub(crate) fn refuse_in_patch(patch: &RationalPatch) -> Result<(), ShapeError> {
    let weights: Vec<f64> = patch.weights().collect();
    let mut net = weights.clone();
    let mut todo = vec![[[0.0, 1.0]; 2]];
    let mut count = 0;
    while let Some(cell) = todo.pop() {
        restrict_tensor(&weights, patch.degrees(), cell, &mut net)?;
        if one_sign(&net) {
            continue;
        }
        let [[a, b], [c, d]] = cell;
        let (u, v): (f64, f64) = (0.5 * (a + b), 0.5 * (c + d));
        if b - a <= SMALLEST {
            let [in_u, in_v] = patch.intervals();
            return Err(pole(patch, [in_u.at(u), in_v.at(v)]));
        }
        let quarters = [[[a, u], [c, v]], [[a, u], [v, d]], [[u, b], [c, v]], [[u, b], [v, d]]];
        todo.extend(quarters);
        count += 1;
        if count > MOST_CELLS {
            return Ok(());
        }
    }
    Ok(())
}

/// As [`refuse_in_patch`], for a triangle.
pub(crate) fn refuse_in_triangle(triangle: &RationalTriangle) -> Result<(), ShapeError> {
    let n = triangle.degree();
    let weights: Vec<f64> = triangle.weights().collect();
    let net = TriangleNet::new(&weights, n)?;
    let mut scratch = weights.clone();
    let mut todo = vec![[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]];
    let mut count = 0;
    while let Some(corners) = todo.pop() {
        let mut cell = Vec::with_capacity(weights.len());
        for index in multi_indices::<3>(n) {
            let repeated =
                corners.iter().zip(index).flat_map(|(&corner, times)| std::iter::repeat_n(corner, times));
            let arguments: Vec<[f64; 3]> = repeated.collect();
            cell.push(net.blossom(&arguments, &mut scratch)?);
        }
        if one_sign(&cell) {
            continue;
        }
        let [a, b, c] = corners;
        let middle = |p: [f64; 3], q: [f64; 3]| std::array::from_fn(|i| 0.5 * (p[i] + q[i]));
        if (0..3).all(|i| (a[i] - b[i]).abs() <= SMALLEST) {
            return Err(pole(triangle, [(a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0]));
        }
        let (ab, bc, ca): ([f64; 3], [f64; 3], [f64; 3]) = (middle(a, b), middle(b, c), middle(c, a));
        todo.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        count += 1;
        if count > MOST_CELLS {
            return Ok(());
        }
    }
    Ok(())
}

fn one_sign(weights: &[f64]) -> bool {
    weights.iter().all(|&w| w > 0.0) || weights.iter().all(|&w| w < 0.0)
}

fn pole(surface: &dyn ParametricSurface, [u, v]: [f64; 2]) -> ShapeError {
    let source = GeomError::Pole { denominator: surface.weight(u, v), uncertainty: SMALLEST };
    ShapeError::Evaluation { at: Parameters::Surface([u, v]), source }
}
