//! The referee over simplices and wedges: sums over multi-indices in exact rational arithmetic.
#![allow(dead_code)] // every test file uses its own share of this

use num_bigint::BigInt;
use num_traits::Zero;

use casteljau_bernstein::last_barycentric;

use super::exact::{Hunter, Q, basis_of, dot, exact, integer, powers};

/// All multi-indices of a degree with so many entries, descending lexicographically.
pub fn indices(vertices: usize, degree: usize) -> Vec<Vec<usize>> {
    if vertices == 1 {
        return vec![vec![degree]];
    }
    let mut all = Vec::new();
    for first in (0..=degree).rev() {
        for mut rest in indices(vertices - 1, degree - first) {
            rest.insert(0, first);
            all.push(rest);
        }
    }
    all
}

/// The place of a multi-index among all of its degree: those before it have the same first entries and then a
/// larger one, `Σₐ C(βₐ + … + β_V + V − 1 − a, V − a)` many, a = 1, …, V − 1 counted from 0.
pub fn place(index: &[usize]) -> usize {
    let (mut tail, mut place) = (0, 0);
    for (below, entry) in (1..).zip(index[1..].iter().rev()) {
        tail += entry;
        place += (0..below).fold(1, |ways, j| ways * (tail + below - 1 - j) / (j + 1));
    }
    place
}

pub fn multinomial(index: &[usize]) -> Q {
    let (mut ways, mut total) = (BigInt::from(1), 0);
    for entry in index {
        for j in 1..=*entry {
            total += 1;
            ways = ways * total / j;
        }
    }
    Q::from_integer(ways)
}

/// All `n!/β! λ^β`.
pub fn basis(degree: usize, lambda: &[Q]) -> Vec<Q> {
    let powers: Vec<_> = lambda.iter().map(|l| powers(l, degree)).collect();
    let product = |index: &Vec<usize>| {
        index.iter().zip(&powers).fold(multinomial(index), |product, (&b, p)| product * &p[b])
    };
    indices(lambda.len(), degree).iter().map(product).collect()
}

/// Value of a wedge of degrees [n, o] at λ and, in the height, (1 − w, w), which need not add up to 1.
pub fn wedge_value(points: &[Q], [n, o]: [usize; 2], lambda: &[Q], (s, t): (&Q, &Q)) -> Q {
    let in_height = basis_of(o, s, t);
    let net: Vec<Q> = points.chunks(o + 1).map(|row| dot(row, &in_height)).collect();
    dot(&net, &basis(n, lambda))
}

pub fn absolute(lambda: &[Q]) -> Vec<Q> {
    lambda.iter().map(Q::abs).collect()
}

/// One level of a scheme: `Σ cₐ P_{β+eₐ}`.
pub fn step(points: &[Q], degree: usize, combination: &[Q]) -> Vec<Q> {
    let vertices = combination.len();
    indices(vertices, degree - 1)
        .into_iter()
        .map(|mut index| {
            let mut sum = Q::zero();
            for (vertex, c) in combination.iter().enumerate().filter(|(_, c)| !c.is_zero()) {
                index[vertex] += 1;
                sum += &points[place(&index)] * c;
                index[vertex] -= 1;
            }
            sum
        })
        .collect()
}

/// The blossom; with arguments and points taken absolutely its scale.
pub fn blossom(points: &[Q], degree: usize, arguments: &[Vec<Q>]) -> Q {
    assert_eq!(arguments.len(), degree);
    let mut net = points.to_vec();
    for (done, argument) in arguments.iter().enumerate() {
        net = step(&net, degree - done, argument);
    }
    net.remove(0)
}

/// The net of a partial derivative, and that of its scale if `sign` is 1 and the points are absolute; −1 else.
pub fn differentiated(points: &[Q], degree: usize, vertices: usize, orders: &[usize], sign: i64) -> Vec<Q> {
    let (mut net, mut degree) = (points.to_vec(), degree);
    for (axis, &order) in orders.iter().enumerate() {
        for _ in 0..order {
            if degree == 0 {
                return vec![Q::zero()];
            }
            let mut combination = vec![Q::zero(); vertices];
            combination[axis] = integer(degree);
            combination[vertices - 1] = integer(degree) * Q::from_integer(sign.into());
            net = step(&net, degree, &combination);
            degree -= 1;
        }
    }
    net
}

/// Contributions below this may vanish; expressed as an addition to a scale.
pub fn floor(points: &[Q]) -> Q {
    let largest = points.iter().map(Q::abs).max().unwrap_or_else(Q::zero);
    (largest + integer(1)) * exact(1e-290) / exact(super::U)
}

fn fit(x: f64) -> f64 {
    if x.abs() < 64.0 { x } else { x * 2_f64.powi(-40) }
}

impl Hunter {
    /// Barycentric coordinates: inside, on faces, at and near vertices, outside.
    pub fn barycentric<const V: usize>(&mut self) -> [f64; V] {
        let mut lambda = [0.0; V];
        match self.below(10) {
            0 => lambda[self.below(V)] = 1.0,
            1 => {
                // On an edge.
                let (a, b, t) = (self.below(V), self.below(V), self.parameter());
                lambda[a] += 1.0 - t;
                lambda[b] += t;
            }
            2 => {
                lambda.iter_mut().for_each(|l| *l = self.parameter() / V as f64);
                lambda[V - 1] = last_barycentric(&lambda[..V - 1]);
            }
            // Below 2⁶, so that their powers stay in range at the highest degrees.
            3 => lambda.iter_mut().for_each(|l| *l = fit(self.number())),
            _ => {
                let mut left = 1.0;
                for l in &mut lambda[..V - 1] {
                    *l = self.unit() * left;
                    left -= *l;
                }
                lambda[V - 1] = last_barycentric(&lambda[..V - 1]);
            }
        }
        lambda
    }
}
