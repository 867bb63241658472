//! Polynomials in two variables, cut off behind some order of the second: `a[k][m]` is the coefficient of hᵏ sᵐ.
//!
//! All ribbons of a face are cut out of one *guide surface*, a polynomial map (u, v) ↦ (x, y, z): along the plan of a side
//! runs (u(s, h), v(s, h)), h leading inward, and the ribbon takes the guide's Taylor expansion in h. So ribbons agree at
//! the corners in tangent planes and twists, and patches over neighbouring plans of one guide join smoothly.

/// A polynomial in s and h.
#[derive(Clone, Debug)]
pub struct Series(pub Vec<Vec<f64>>);

impl Series {
    /// The constant, with `orders` orders of h.
    pub fn constant(value: f64, orders: usize) -> Self {
        let mut rows = vec![vec![0.0]; orders];
        rows[0][0] = value;
        Self(rows)
    }

    pub fn add_scaled(&mut self, other: &Self, factor: f64) {
        for (row, more) in self.0.iter_mut().zip(&other.0) {
            row.resize(row.len().max(more.len()), 0.0);
            row.iter_mut().zip(more).for_each(|(a, b)| *a += factor * b);
        }
    }

    /// The product, orders of h beyond the factors' own left out.
    pub fn times(&self, other: &Self) -> Self {
        let orders = self.0.len();
        let mut product = vec![Vec::new(); orders];
        for (k, a) in self.0.iter().enumerate() {
            for (l, b) in other.0.iter().enumerate().take(orders - k) {
                let row: &mut Vec<f64> = &mut product[k + l];
                row.resize(row.len().max(a.len() + b.len() - 1), 0.0);
                for (i, x) in a.iter().enumerate() {
                    b.iter().enumerate().for_each(|(j, y)| row[i + j] += x * y);
                }
            }
        }
        Self(product)
    }

    /// Control values `[k][j]` of a ribbon of degree d and l layers, whose expansion in h this is:
    /// `c_j = Σ_m C(j,m)/C(d,m) a_m` turns power coefficients into Bernstein ones, in s of degree d, in h of degree 2l − 1.
    pub fn control_values(&self, degree: usize) -> Vec<Vec<f64>> {
        let layers = self.0.len();
        let along: Vec<Vec<f64>> = self
            .0
            .iter()
            .map(|row| {
                let negligible = row.iter().skip(degree + 1).all(|a| a.abs() < 1e-9);
                assert!(negligible, "degree {degree} is too low for {row:?}");
                (0..=degree).map(|j| bernstein(row, j, degree)).collect()
            })
            .collect();
        let column = |j: usize| along.iter().map(|row| row[j]).collect::<Vec<_>>();
        (0..layers)
            .map(|k| (0..=degree).map(|j| bernstein(&column(j), k, 2 * layers - 1)).collect())
            .collect()
    }
}

fn bernstein(power: &[f64], j: usize, degree: usize) -> f64 {
    let choose = |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
    power.iter().enumerate().take(j + 1).map(|(m, a)| choose(j, m) / choose(degree, m) * a).sum()
}

/// A polynomial map of the plane into space: terms (i, j, coefficient of uⁱ vʲ).
#[derive(Clone, Debug)]
pub struct Guide(pub Vec<(usize, usize, [f64; 3])>);

impl Guide {
    /// The three coordinates along a strip (u(s, h), v(s, h)).
    pub fn along(&self, strip: &[Series; 2]) -> [Series; 3] {
        let orders = strip[0].0.len();
        let mut result: [Series; 3] = std::array::from_fn(|_| Series::constant(0.0, orders));
        for &(i, j, coefficient) in &self.0 {
            let mut term = Series::constant(1.0, orders);
            (0..i).for_each(|_| term = term.times(&strip[0]));
            (0..j).for_each(|_| term = term.times(&strip[1]));
            result.iter_mut().zip(coefficient).for_each(|(sum, c)| sum.add_scaled(&term, c));
        }
        result
    }
}
