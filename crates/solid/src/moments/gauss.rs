//! Gauss's rule on a box of the parameters of a rational hexahedron.

use casteljau_bernstein::basis_derivatives;
use casteljau_bernstein::glam::{DVec3, DVec4};
use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_shape::gauss_rule;

use super::Integrals;

/// The ten integrals over a cell and what is needed to judge them.
#[derive(Debug, Clone)]
pub(super) struct Cell {
    pub bounds: [[f64; 2]; 3],
    pub sums: Integrals,
    /// `∫|det J|`, `∫|x||det J|`, `∫|x|²|det J|`.
    pub sizes: [f64; 3],
    /// What rounding does to those.
    pub rounding: [f64; 3],
    /// How much of det J varies like Legendre's polynomials of the highest degrees, along each axis.
    pub roughness: [f64; 3],
}

/// A rational net with the rule.
pub(super) struct Integrand {
    points: Vec<DVec4>,
    degrees: [usize; 3],
    rule: Vec<(f64, f64)>,
    /// Legendre's polynomials of the two highest degrees that the rule can tell apart, at its nodes.
    highest: [Vec<f64>; 2],
}

/// A basis and its derivatives at the nodes of a cell.
struct Basis {
    values: Vec<f64>,
    slopes: Vec<f64>,
    width: usize,
}

impl Basis {
    fn new(degree: usize, [a, b]: [f64; 2], rule: &[(f64, f64)]) -> Self {
        let width = degree + 1;
        let (mut values, mut slopes) = (Vec::new(), Vec::new());
        let mut rows = vec![0.0; 2 * width];
        for &(node, _) in rule {
            basis_derivatives(a + (b - a) * node, 1, &mut rows);
            values.extend_from_slice(&rows[..width]);
            slopes.extend_from_slice(&rows[width..]);
        }
        Self { values, slopes, width }
    }

    fn at(&self, node: usize) -> (&[f64], &[f64]) {
        let range = node * self.width..(node + 1) * self.width;
        (&self.values[range.clone()], &self.slopes[range])
    }
}

impl Integrand {
    pub fn new(points: Vec<DVec4>, degrees: [usize; 3]) -> Self {
        let rule: Vec<(f64, f64)> = gauss_rule().collect();
        let top = rule.len() - 1;
        let highest = [top - 1, top].map(|k| rule.iter().map(|&(t, _)| legendre(k, 2.0 * t - 1.0)).collect());
        Self { points, degrees, rule, highest }
    }

    /// The rule on a cell.
    pub fn cell(&self, bounds: [[f64; 2]; 3]) -> Cell {
        let [l, m, n] = self.degrees;
        let [in_u, in_v, in_w] = [(l, 0), (m, 1), (n, 2)].map(|(d, a)| Basis::new(d, bounds[a], &self.rule));
        let measure: f64 = bounds.iter().map(|[a, b]| b - a).product();
        let mut cell =
            Cell { bounds, sums: [0.0; 10], sizes: [0.0; 3], rounding: [0.0; 3], roughness: [0.0; 3] };
        let mut modes = [[0.0; 2]; 3];
        let layer = (m + 1) * (n + 1);
        let mut slab = vec![[DVec4::ZERO; 2]; layer];
        let mut line = vec![[DVec4::ZERO; 3]; n + 1];
        for (p, &(_, weight_u)) in self.rule.iter().enumerate() {
            let (values, slopes) = in_u.at(p);
            for (place, sum) in slab.iter_mut().enumerate() {
                *sum = [DVec4::ZERO; 2];
                for (i, (value, slope)) in values.iter().zip(slopes).enumerate() {
                    let point = self.points[i * layer + place];
                    sum[0] += point * *value;
                    sum[1] += point * *slope;
                }
            }
            for (q, &(_, weight_v)) in self.rule.iter().enumerate() {
                let (values, slopes) = in_v.at(q);
                for (place, sum) in line.iter_mut().enumerate() {
                    *sum = [DVec4::ZERO; 3];
                    for (j, (value, slope)) in values.iter().zip(slopes).enumerate() {
                        let [point, along_u] = slab[j * (n + 1) + place];
                        sum[0] += point * *value;
                        sum[1] += along_u * *value;
                        sum[2] += point * *slope;
                    }
                }
                for (r, &(_, weight_w)) in self.rule.iter().enumerate() {
                    let (values, slopes) = in_w.at(r);
                    let mut jet = [DVec4::ZERO; 4];
                    for ((points, value), slope) in line.iter().zip(values).zip(slopes) {
                        jet[0] += points[0] * *value;
                        jet[1] += points[1] * *value;
                        jet[2] += points[2] * *value;
                        jet[3] += points[0] * *slope;
                    }
                    let weight = weight_u * weight_v * weight_w * measure;
                    let share = cell.add(jet, weight);
                    for (axis, node) in [p, q, r].into_iter().enumerate() {
                        modes[axis][0] += share * self.highest[0][node];
                        modes[axis][1] += share * self.highest[1][node];
                    }
                }
            }
        }
        cell.roughness = modes.map(|[a, b]| a.abs() + b.abs());
        cell
    }
}

impl Cell {
    /// Adds a node to the sums; returns `det J` times its weight, with what it is worth in the moments.
    fn add(&mut self, [h, hu, hv, hw]: [DVec4; 4], weight: f64) -> f64 {
        let x = h.truncate() / h.w;
        let tangent = |d: DVec4| (d.truncate() - x * d.w) / h.w;
        let size = |d: DVec4| (d.truncate().length() + x.length() * d.w.abs()) / h.w.abs();
        let share = tangent(hu).dot(tangent(hv).cross(tangent(hw))) * weight;
        // Some roundings a factor; those of thousands of nodes mostly cancel.
        let rounding = 2.0 * UNIT_ROUNDOFF * size(hu) * size(hv) * size(hw) * weight;
        let products = [1.0, x.x, x.y, x.z, x.x * x.x, x.x * x.y, x.x * x.z, x.y * x.y, x.y * x.z, x.z * x.z];
        for (sum, product) in self.sums.iter_mut().zip(products) {
            *sum += product * share;
        }
        let far = [1.0, x.length(), x.length_squared()];
        for (k, far) in far.into_iter().enumerate() {
            self.sizes[k] += far * share.abs();
            self.rounding[k] += far * rounding;
        }
        share * (1.0 + DVec3::dot(x, x))
    }
}

/// Legendre's polynomial by its recurrence.
fn legendre(k: usize, x: f64) -> f64 {
    let (mut before, mut now) = (0.0, 1.0);
    for j in 0..k {
        let j = j as f64;
        (before, now) = (now, ((2.0 * j + 1.0) * x * now - j * before) / (j + 1.0));
    }
    now
}
