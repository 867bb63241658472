//! An independent solution: the double-layer potential of the boundary, by Nyström's method.
//!
//! u = Re F, F(z) = (1/2πi) ∮ μ(y) dy/(y − z), where μ/2 + K μ = hat function on the boundary. Each side is cut into
//! equal panels, the first and last of which are halved toward the corners again and again; Gauss points on each panel.
//! The kernel Im(dy/(y − x))/2π vanishes along one's own side and is smooth elsewhere.

use std::f64::consts::TAU;

use casteljau_domain::glam::DVec2;
use casteljau_domain::{Coordinates, HarmonicOptions, Orientation, Polygon};
use faer::Mat;
use faer::prelude::Solve;
use num_complex::Complex64;

use crate::shapes::{clearance, polygon, rows};
use crate::support::{Random, inside};

/// Nodes and weights of Gauss and Legendre on [0, 1], by Newton's method on the Legendre polynomial.
fn gauss(count: usize) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..10 {
            let (mut before, mut p) = (1.0, x);
            for k in 2..=count {
                let k = k as f64;
                (before, p) = (p, ((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k);
            }
            slope = count as f64 * (before - x * p) / (1.0 - x * x);
            x -= p / slope;
        }
        (0.5 + 0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(node).collect()
}

struct Node {
    side: usize,
    t: f64,
    at: Complex64,
    /// dy times the weight.
    step: Complex64,
}

struct Truth {
    nodes: Vec<Node>,
    density: Mat<f64>,
    n: usize,
}

impl Truth {
    fn new(polygon: &Polygon, panels: usize, halvings: usize, order: usize) -> Self {
        assert_eq!(polygon.orientation(), Orientation::CounterClockwise);
        let n = polygon.len();
        let mut cuts: Vec<f64> = (0..=panels).map(|i| i as f64 / panels as f64).collect();
        for k in 1..=halvings {
            let near = 0.5f64.powi(k as i32) / panels as f64;
            cuts.extend([near, 1.0 - near]);
        }
        cuts.sort_by(f64::total_cmp);
        let rule = gauss(order);
        let mut nodes = Vec::new();
        for side in 0..n {
            let [a, b] = polygon.side(side).map(|p| Complex64::new(p.x, p.y));
            for panel in cuts.windows(2) {
                nodes.extend(rule.iter().map(|(x, w)| {
                    let t = panel[0] + (panel[1] - panel[0]) * x;
                    Node { side, t, at: a + (b - a) * t, step: (b - a) * (panel[1] - panel[0]) * w }
                }));
            }
        }
        let kernel = |x: &Node, y: &Node| {
            if x.side == y.side { 0.0 } else { (y.step / (y.at - x.at)).im / TAU }
        };
        let count = nodes.len();
        let matrix =
            Mat::from_fn(count, count, |i, j| kernel(&nodes[i], &nodes[j]) + if i == j { 0.5 } else { 0.0 });
        let hats = Mat::from_fn(count, n, |i, j| {
            let Node { side, t, .. } = nodes[i];
            if j == side {
                t
            } else if (j + 1) % n == side {
                1.0 - t
            } else {
                0.0
            }
        });
        let density = matrix.partial_piv_lu().solve(&hats);
        Self { nodes, density, n }
    }

    /// Rows 1, u, v, uu, uv, vv.
    fn rows(&self, p: DVec2) -> Vec<f64> {
        let z = Complex64::new(p.x, p.y);
        let mut f = vec![[Complex64::ZERO; 3]; self.n];
        for (i, node) in self.nodes.iter().enumerate() {
            let d = (node.at - z).inv();
            let k0 = node.step * d / Complex64::new(0.0, TAU);
            for j in 0..self.n {
                let mu = self.density[(i, j)];
                for (sum, k) in f[j].iter_mut().zip([k0, k0 * d, k0 * d * d * 2.0]) {
                    *sum += k * mu;
                }
            }
        }
        let row = |part: fn(&[Complex64; 3]) -> f64| f.iter().map(part).collect::<Vec<f64>>();
        [
            row(|f| f[0].re),
            row(|f| f[1].re),
            row(|f| -f[1].im),
            row(|f| f[2].re),
            row(|f| -f[2].im),
            row(|f| -f[2].re),
        ]
        .concat()
    }
}

/// Compares at points no closer to the boundary than the longest panel is long, where Gauss's rule has
/// converged; how well the slow solution has is measured by a coarser one.
fn agree(name: &str, outline: &Polygon, allowed: f64) {
    const PANELS: usize = 6;
    let coarse = Truth::new(outline, PANELS, 24, 7);
    let fine = Truth::new(outline, PANELS, 30, 8);
    let c = Coordinates::harmonic(outline.clone(), &HarmonicOptions::default()).unwrap();
    let longest = (0..outline.len()).map(|i| outline.side_length(i)).fold(0.0, f64::max) / PANELS as f64;
    let mut random = Random(41);
    let (mut own, mut largest, mut compared) = (0.0_f64, 0.0_f64, 0);
    for _ in 0..4000 {
        let Some(p) = inside(&mut random, outline) else { continue };
        let r = clearance(outline, p);
        if r < longest || compared == 60 {
            continue;
        }
        compared += 1;
        let (ours, slow, slower) = (rows(&c, p, 2), coarse.rows(p), fine.rows(p));
        for k in 0..ours.len() {
            // Derivatives of harmonic functions below M are at most 4M/(πr) and 8M/(πr²).
            let unit = [1.0, 1.3, 1.3, 2.6, 2.6, 2.6][k / outline.len()]
                / r.powi([0, 1, 1, 2, 2, 2][k / outline.len()]);
            own = own.max((slow[k] - slower[k]).abs() / unit);
            largest = largest.max((ours[k] - slower[k]).abs() / unit);
        }
    }
    println!("{name:20} slow solution good to {own:.1e}, difference {largest:.1e} at {compared} points");
    assert!(compared >= 20, "{name}: {compared} points only");
    assert!(own <= allowed, "{name}: the slow solution has not converged, {own:e}");
    assert!(largest <= allowed, "{name}: {largest:e}");
}

#[test]
fn agrees_with_a_boundary_integral_on_an_arrow() {
    agree(
        "arrow",
        &polygon(&[(0., 0.), (2., 0.3), (1.9, -0.5), (3.4, 0.9), (1.6, 2.1), (1.8, 1.2), (-0.1, 1.3)]),
        1e-6,
    );
}

#[test]
fn agrees_with_a_boundary_integral_on_a_bay() {
    agree(
        "bay",
        &polygon(&[(0., 0.), (3., -0.4), (3.3, 2.), (2.1, 2.4), (1.9, 1.1), (1.1, 1.2), (-0.3, 2.2)]),
        1e-6,
    );
}

#[test]
fn agrees_with_a_boundary_integral_on_collinear_vertices() {
    agree("collinear", &polygon(&[(0., 0.), (1., 0.), (2.5, 0.), (2., 2.), (1.25, 2.), (0.2, 2.)]), 1e-6);
}
