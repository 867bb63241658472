//! Polynomials in the power basis with integer coefficients.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use casteljau_solid::SolidDegrees;

/// A polynomial in three variables with integer coefficients, `Σ aᵢⱼₖ xⁱ yʲ zᵏ`.
#[derive(Clone, Debug)]
pub struct Polynomial {
    pub degrees: [usize; 3],
    pub a: Vec<BigInt>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Truth {
    /// Everywhere, boundary included.
    Positive,
    /// Nowhere negative, not everywhere positive.
    NonNegative,
    /// Negative somewhere.
    Negative,
    Zero,
    /// Not found out at the depth allowed.
    Unknown,
}

impl Polynomial {
    pub fn zero(degrees: [usize; 3]) -> Self {
        Self { degrees, a: vec![BigInt::zero(); degrees.iter().map(|d| d + 1).product()] }
    }

    pub fn place(&self, [i, j, k]: [usize; 3]) -> usize {
        (i * (self.degrees[1] + 1) + j) * (self.degrees[2] + 1) + k
    }

    pub fn indices(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let [l, m, n] = self.degrees;
        (0..=l).flat_map(move |i| (0..=m).flat_map(move |j| (0..=n).map(move |k| [i, j, k])))
    }

    pub fn add(&self, other: &Self) -> Self {
        let mut sum = Self::zero(std::array::from_fn(|x| self.degrees[x].max(other.degrees[x])));
        for p in [self, other] {
            for index in p.indices() {
                let place = sum.place(index);
                sum.a[place] += &p.a[p.place(index)];
            }
        }
        sum
    }

    pub fn scaled(&self, factor: &BigInt) -> Self {
        Self { degrees: self.degrees, a: self.a.iter().map(|a| a * factor).collect() }
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut product = Self::zero(std::array::from_fn(|x| self.degrees[x] + other.degrees[x]));
        for i in self.indices() {
            let a = &self.a[self.place(i)];
            if a.is_zero() {
                continue;
            }
            for j in other.indices() {
                let b = &other.a[other.place(j)];
                if !b.is_zero() {
                    let place = product.place(std::array::from_fn(|x| i[x] + j[x]));
                    product.a[place] += a * b;
                }
            }
        }
        product
    }

    pub fn derivative(&self, axis: usize) -> Self {
        let mut degrees = self.degrees;
        degrees[axis] = degrees[axis].saturating_sub(1);
        let mut out = Self::zero(degrees);
        for index in self.indices().filter(|index| index[axis] > 0) {
            let mut lower = index;
            lower[axis] -= 1;
            let place = out.place(lower);
            out.a[place] = &self.a[self.place(index)] * index[axis];
        }
        out
    }

    pub fn determinant(rows: &[Vec<Self>]) -> Self {
        if rows.len() == 1 {
            return rows[0][0].clone();
        }
        let mut sum = Self::zero([0; 3]);
        for column in 0..rows.len() {
            let rest: Vec<Vec<Self>> = rows[1..]
                .iter()
                .map(|row| {
                    row.iter().enumerate().filter(|&(c, _)| c != column).map(|(_, p)| p.clone()).collect()
                })
                .collect();
            let term = rows[0][column].times(&Self::determinant(&rest));
            sum = sum.add(&term.scaled(&BigInt::from(if column % 2 == 0 { 1 } else { -1 })));
        }
        sum
    }

    /// Without powers that do not occur: leading coefficients of rational determinants cancel.
    pub fn trimmed(&self) -> Self {
        let used = self.indices().filter(|&index| !self.a[self.place(index)].is_zero());
        let degrees = used.fold([0; 3], |d: [usize; 3], i| std::array::from_fn(|x| d[x].max(i[x])));
        let mut out = Self::zero(degrees);
        for index in out.indices() {
            let place = out.place(index);
            out.a[place] = self.a[self.place(index)].clone();
        }
        out
    }

    /// The value at a rational point, exactly.
    pub fn value(&self, at: &[BigRational; 3]) -> BigRational {
        let mut sum = BigRational::zero();
        for index in self.indices().filter(|&index| !self.a[self.place(index)].is_zero()) {
            let mut term = BigRational::from_integer(self.a[self.place(index)].clone());
            for axis in 0..3 {
                term *= num_traits::pow(at[axis].clone(), index[axis]);
            }
            sum += term;
        }
        sum
    }

    /// `p(…, x/2, …)·2ⁿ`, then for the upper half x → x + 1.
    fn half(&self, axis: usize, upper: bool) -> Self {
        let n = self.degrees[axis];
        let mut out = self.clone();
        for index in self.indices() {
            let place = self.place(index);
            out.a[place] <<= n - index[axis];
        }
        if upper {
            // Horner's scheme for the Taylor shift.
            for step in 0..n {
                for index in self.indices().filter(|i| i[axis] < n && i[axis] >= step) {
                    // From the top down: index n − 1 first.
                    let mut at = index;
                    at[axis] = n - 1 - (index[axis] - step);
                    let mut above = at;
                    above[axis] += 1;
                    let add = out.a[out.place(above)].clone();
                    let place = out.place(at);
                    out.a[place] += add;
                }
            }
        }
        out
    }

    /// Bernstein coefficients times binomial coefficients, `Σⱼ C(n−j, i−j) aⱼ` along each axis: integers of the same signs.
    fn bernstein(&self) -> Vec<BigInt> {
        let mut out = self.clone();
        for axis in 0..3 {
            let before = out.clone();
            let n = self.degrees[axis];
            for index in self.indices() {
                let mut sum = BigInt::zero();
                for j in 0..=index[axis] {
                    let mut from = index;
                    from[axis] = j;
                    sum += &before.a[before.place(from)] * choose(n - j, index[axis] - j);
                }
                let place = out.place(index);
                out.a[place] = sum;
            }
        }
        out.a
    }

    /// The sign over the unit cube.
    pub fn truth(&self, most_cells: usize) -> Truth {
        if self.a.iter().all(Zero::is_zero) {
            return Truth::Zero;
        }
        let mut cells = vec![self.trimmed()];
        let mut touches = false;
        for _ in 0..most_cells {
            let Some(cell) = cells.pop() else {
                return if touches { Truth::NonNegative } else { Truth::Positive };
            };
            let b = cell.bernstein();
            let [l, m, n] = cell.degrees;
            let corners = (0..8).map(|c| cell.place([(c >> 2) * l, (c >> 1 & 1) * m, (c & 1) * n]));
            if corners.into_iter().any(|place| b[place].is_negative()) {
                return Truth::Negative;
            }
            if b.iter().all(|b| !b.is_negative()) {
                // Zero at a corner exactly where the corner's coefficient is; a positive one everywhere else would do too.
                let corners = (0..8).map(|c| cell.place([(c >> 2) * l, (c >> 1 & 1) * m, (c & 1) * n]));
                touches |= corners.into_iter().any(|place| b[place].is_zero());
                continue;
            }
            // The axis of the largest second difference.
            let merit = |axis: usize| {
                let d = cell.degrees[axis];
                let bend = cell.indices().filter(|i| i[axis] + 2 <= d).map(|i| {
                    let at = |k: usize| {
                        let mut index = i;
                        index[axis] += k;
                        BigRational::new(b[cell.place(index)].clone(), choose_all(cell.degrees, index))
                    };
                    (at(0) - at(1) * BigInt::from(2) + at(2)).abs()
                });
                bend.max().unwrap_or_else(BigRational::zero)
            };
            let merits: Vec<BigRational> = (0..3).map(merit).collect();
            let mut axis = (0..3).filter(|&a| cell.degrees[a] > 0).max_by(|&a, &b| merits[a].cmp(&merits[b]));
            if merits.iter().all(Zero::is_zero) {
                axis = (0..3).find(|&a| cell.degrees[a] > 0);
            }
            let Some(axis) = axis else { return Truth::Unknown };
            // Depth first, and the lower half first.
            cells.push(cell.half(axis, true));
            cells.push(cell.half(axis, false));
        }
        Truth::Unknown
    }
}

pub fn choose(n: usize, k: usize) -> BigInt {
    (0..k).fold(BigInt::one(), |c, j| c * (n - j) / (j + 1))
}

fn choose_all(degrees: [usize; 3], index: [usize; 3]) -> BigInt {
    (0..3).map(|x| choose(degrees[x], index[x])).product()
}

impl Polynomial {
    pub fn product(&self, other: &Self) -> Self {
        self.times(other)
    }

    /// det of the partial derivatives of three polynomials.
    pub fn jacobian(of: &[Self; 3]) -> Self {
        let rows: Vec<Vec<Self>> =
            (0..3).map(|axis| of.iter().map(|p| p.derivative(axis)).collect()).collect();
        Self::determinant(&rows)
    }

    /// The integral over the domain, term by term.
    pub fn integral(&self, domain: SolidDegrees) -> BigRational {
        let factorial = |n: usize| (1..=n).map(BigInt::from).product::<BigInt>();
        let mut sum = BigRational::zero();
        for index in self.indices() {
            let [i, j, k] = index;
            let a = self.a[self.place(index)].clone();
            let (above, below) = match domain {
                SolidDegrees::Hexahedron(_) => (BigInt::one(), BigInt::from((i + 1) * (j + 1) * (k + 1))),
                SolidDegrees::Tetrahedron(_) => {
                    (factorial(i) * factorial(j) * factorial(k), factorial(i + j + k + 3))
                }
                SolidDegrees::Wedge(_) => (factorial(i) * factorial(j), factorial(i + j + 2) * (k + 1)),
            };
            sum += BigRational::new(a * above, below);
        }
        sum
    }
}
