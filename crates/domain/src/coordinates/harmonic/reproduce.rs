//! Σ λ_j = 1 and Σ λ_j v_j = x to rounding.
//!
//! Both hold for the fit up to its residual only. The least change of the λ_j that makes them hold exactly is a linear
//! map of their values, the same everywhere, so the functions stay harmonic.

use num_complex::Complex64;

use super::{outline::Outline, solve::dual};

/// λ ↦ λ − V (VᵀV)⁻¹ (Vᵀλ − (1, x, y)), the rows of V being (1, x_j, y_j).
#[derive(Clone, Debug)]
pub(super) struct Reproduction {
    vertices: Vec<[f64; 3]>,
    dual: Vec<[f64; 3]>,
    norm: f64,
}

impl Reproduction {
    pub(super) fn new(outline: &Outline) -> Self {
        let vertices: Vec<[f64; 3]> = outline.vertices.iter().map(|z| [1.0, z.re, z.im]).collect();
        let dual = dual(&vertices);
        let entry = |i: usize, j: usize| -> f64 {
            let along: f64 = (0..3).map(|k| dual[i][k] * vertices[j][k]).sum();
            (if i == j { 1.0 } else { 0.0 }) - along
        };
        let n = vertices.len();
        let norm = (0..n).map(|i| (0..n).map(|j| entry(i, j).abs()).sum::<f64>()).fold(0.0, f64::max);
        Self { vertices, dual, norm }
    }

    /// Largest factor by which the map enlarges an error.
    pub(super) fn norm(&self) -> f64 {
        self.norm
    }

    /// Corrects a row of n values whose moments Σ λ_j (1, x_j, y_j) should be `moments`.
    #[inline(always)]
    pub(super) fn correct(&self, row: &mut [f64], moments: [f64; 3]) {
        let mut excess = moments.map(|m| -m);
        for (value, v) in row.iter().zip(&self.vertices) {
            for (e, v) in excess.iter_mut().zip(v) {
                *e += value * v;
            }
        }
        for (value, w) in row.iter_mut().zip(&self.dual) {
            *value -= excess[0] * w[0] + excess[1] * w[1] + excess[2] * w[2];
        }
    }

    /// Corrects values at z.
    #[inline(always)]
    pub(super) fn correct_values(&self, row: &mut [f64], z: Complex64) {
        self.correct(row, [1.0, z.re, z.im]);
    }
}
