//! The referee: the sign of a determinant in exact integer arithmetic.
//!
//! Control points are integers over a power of two. Everything is done in the power basis, a way that the library does not
//! go: differentiation, the determinant by its definition, Taylor shifts for parts of the domain. Simplices are handled as
//! images of the cube, (x, y, z) = (r, (1−r)s, (1−r)(1−s)t).
#![allow(dead_code)] // every test file uses its own share of this

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use casteljau_solid::geom::glam::DVec4;
use casteljau_solid::{Feature, SolidDegrees};
use polynomial::choose;
pub use polynomial::{Polynomial, Truth};

mod polynomial;

/// Homogeneous points brought to integers by one power of two.
fn integers(points: &[DVec4]) -> Vec<[BigInt; 4]> {
    let exact = |x: f64| BigRational::from_float(x).unwrap();
    let bits = points.iter().flat_map(|p| p.to_array()).map(|x| exact(x).denom().bits()).max().unwrap();
    let factor = BigRational::from_integer(BigInt::one() << bits);
    points.iter().map(|p| p.to_array().map(|x| (exact(x) * &factor).to_integer())).collect()
}

/// The variables of the domain as functions on the cube or, for simplices, on themselves.
fn power_form(points: &[[BigInt; 4]], component: usize, degrees: SolidDegrees) -> Polynomial {
    let variable = |axis: usize| {
        let mut degrees = [0; 3];
        degrees[axis] = 1;
        Polynomial { degrees, a: vec![BigInt::zero(), BigInt::one()] }
    };
    let constant = |c: i32| Polynomial { degrees: [0; 3], a: vec![BigInt::from(c)] };
    let minus = |p: &Polynomial, q: &Polynomial| p.add(&q.scaled(&BigInt::from(-1)));
    let power = |p: &Polynomial, n: usize| (0..n).fold(constant(1), |q, _| q.times(p));
    let [x, y, z] = [0, 1, 2].map(variable);
    let one = constant(1);
    let mut sum = Polynomial::zero([0; 3]);
    let mut place = 0;
    let mut take = |basis: Polynomial, multiplicity: BigInt, sum: &mut Polynomial| {
        *sum = sum.add(&basis.scaled(&(multiplicity * &points[place][component])));
        place += 1;
    };
    let bernstein = |t: &Polynomial, n: usize, i: usize| power(&minus(&one, t), n - i).times(&power(t, i));
    match degrees {
        SolidDegrees::Hexahedron([l, m, n]) => {
            for i in 0..=l {
                for j in 0..=m {
                    for k in 0..=n {
                        let basis =
                            bernstein(&x, l, i).times(&bernstein(&y, m, j)).times(&bernstein(&z, n, k));
                        take(basis, choose(l, i) * choose(m, j) * choose(n, k), &mut sum);
                    }
                }
            }
        }
        SolidDegrees::Tetrahedron(n) => {
            let last = minus(&minus(&minus(&one, &x), &y), &z);
            for i in (0..=n).rev() {
                for j in (0..=n - i).rev() {
                    for k in (0..=n - i - j).rev() {
                        let basis = power(&x, i).times(&power(&y, j)).times(&power(&z, k));
                        let basis = basis.times(&power(&last, n - i - j - k));
                        take(basis, choose(n, i) * choose(n - i, j) * choose(n - i - j, k), &mut sum);
                    }
                }
            }
        }
        SolidDegrees::Wedge([n, o]) => {
            let last = minus(&minus(&one, &x), &y);
            for i in (0..=n).rev() {
                for j in (0..=n - i).rev() {
                    for k in 0..=o {
                        let basis = power(&x, i).times(&power(&y, j)).times(&power(&last, n - i - j));
                        let basis = basis.times(&bernstein(&z, o, k));
                        take(basis, choose(n, i) * choose(n - i, j) * choose(o, k), &mut sum);
                    }
                }
            }
        }
    }
    sum
}

/// The coordinates of a polynomial solid, times a power of two, and that power.
pub fn coordinates(points: &[DVec4], degrees: SolidDegrees) -> ([Polynomial; 3], BigRational) {
    let integers = integers(points);
    // The weights are 1: they tell the factor.
    let factor = BigRational::from_integer(integers[0][3].clone());
    ([0, 1, 2].map(|component| power_form(&integers, component, degrees)), factor)
}

/// A determinant with the sign of det J, in the parameters of the solid; and `w⁴ det J` = its value over 2 to some power.
pub struct Determinant {
    pub degrees: SolidDegrees,
    pub polynomial: Polynomial,
}

impl Determinant {
    pub fn new(points: &[DVec4], degrees: SolidDegrees, rational: bool) -> Self {
        let integers = integers(points);
        let of = |component| power_form(&integers, component, degrees);
        let space = [of(0), of(1), of(2)];
        let polynomial = if rational {
            let weight = of(3);
            // −det(H, H_u, H_v, H_w), the weight being last.
            let columns = [space[0].clone(), space[1].clone(), space[2].clone(), weight];
            let mut rows = vec![columns.to_vec()];
            rows.extend((0..3).map(|axis| columns.iter().map(|p| p.derivative(axis)).collect::<Vec<_>>()));
            Polynomial::determinant(&rows).scaled(&BigInt::from(-1))
        } else {
            let rows: Vec<Vec<Polynomial>> =
                (0..3).map(|axis| space.iter().map(|p| p.derivative(axis)).collect()).collect();
            Polynomial::determinant(&rows)
        };
        Self { degrees, polynomial: polynomial.trimmed() }
    }

    /// The sign over the domain.
    pub fn truth(&self, most_cells: usize) -> Truth {
        self.on_cube().truth(most_cells)
    }

    /// The polynomial on the cube that covers the domain.
    fn on_cube(&self) -> Polynomial {
        let p = &self.polynomial;
        let one_minus = |axis: usize| {
            let mut degrees = [0; 3];
            degrees[axis] = 1;
            Polynomial { degrees, a: vec![BigInt::one(), BigInt::from(-1)] }
        };
        let variable = |axis: usize| {
            let mut degrees = [0; 3];
            degrees[axis] = 1;
            Polynomial { degrees, a: vec![BigInt::zero(), BigInt::one()] }
        };
        let [r, s, t] = [0, 1, 2].map(variable);
        let images = match self.degrees {
            SolidDegrees::Hexahedron(_) => return p.clone(),
            SolidDegrees::Tetrahedron(_) => {
                let rest = one_minus(0).times(&one_minus(1));
                [r, one_minus(0).times(&s), rest.times(&t)]
            }
            SolidDegrees::Wedge(_) => [r, one_minus(0).times(&s), t],
        };
        let powers: Vec<Vec<Polynomial>> = (0..3)
            .map(|axis| {
                let mut list = vec![Polynomial { degrees: [0; 3], a: vec![BigInt::one()] }];
                for k in 0..p.degrees[axis] {
                    list.push(list[k].times(&images[axis]));
                }
                list
            })
            .collect();
        let mut sum = Polynomial::zero([0; 3]);
        for index in p.indices().filter(|&i| !p.a[p.place(i)].is_zero()) {
            let term = powers[0][index[0]].times(&powers[1][index[1]]).times(&powers[2][index[2]]);
            sum = sum.add(&term.scaled(&p.a[p.place(index)]));
        }
        sum.trimmed()
    }

    /// Whether it is zero on the whole of a feature, given by its corners: tried at enough points of a grid.
    pub fn vanishes_on(&self, feature: Feature) -> bool {
        let [l, m, n] = self.polynomial.degrees;
        let steps = l + m + n;
        let corners = corners(feature);
        // Convex combinations: along each of the corners but the last, all shares in multiples of 1/steps.
        let mut shares = vec![vec![]];
        for _ in 1..corners.len() {
            shares = shares
                .into_iter()
                .flat_map(|list: Vec<usize>| {
                    let left = steps - list.iter().sum::<usize>();
                    (0..=left).map(move |more| list.iter().copied().chain([more]).collect::<Vec<_>>())
                })
                .collect();
        }
        shares.into_iter().all(|mut list| {
            list.push(steps - list.iter().sum::<usize>());
            let at = std::array::from_fn(|axis| {
                let sum: usize = list.iter().zip(&corners).map(|(share, corner)| share * corner[axis]).sum();
                BigRational::new(BigInt::from(sum), BigInt::from(steps.max(1)))
            });
            self.polynomial.value(&at).is_zero()
        })
    }
}

/// Corners whose simplex is enough to know a polynomial on the feature.
fn corners(feature: Feature) -> Vec<[usize; 3]> {
    let unit = |vertex: u8| std::array::from_fn(|axis| usize::from(axis == usize::from(vertex)));
    let with_w = |vertex: u8, w: u8| {
        let [x, y, _] = if vertex < 2 { unit(vertex) } else { [0; 3] };
        [x, y, usize::from(w)]
    };
    match feature {
        Feature::Corner(at) => vec![at.map(usize::from)],
        Feature::Edge { axis, at } => [0, 1]
            .map(|free| {
                let mut rest = at.into_iter();
                std::array::from_fn(|a| {
                    if a == usize::from(axis) { free } else { usize::from(rest.next().unwrap()) }
                })
            })
            .to_vec(),
        Feature::Face { axis, at } => [[0, 0], [0, 1], [1, 0]]
            .map(|free| {
                let mut rest = free.into_iter();
                std::array::from_fn(|a| {
                    if a == usize::from(axis) { usize::from(at) } else { rest.next().unwrap() }
                })
            })
            .to_vec(),
        Feature::Vertex(v) => vec![unit(v)],
        Feature::SimplexEdge(ends) => ends.map(unit).to_vec(),
        Feature::SimplexFace { opposite } => (0..4).filter(|&v| v != opposite).map(unit).collect(),
        Feature::WedgeVertex { vertex, w } => vec![with_w(vertex, w)],
        Feature::WedgeEdge { vertices, w } => vertices.map(|v| with_w(v, w)).to_vec(),
        Feature::WedgeRib { vertex } => vec![with_w(vertex, 0), with_w(vertex, 1)],
        Feature::WedgeTriangle { w } => (0..3).map(|v| with_w(v, w)).collect(),
        Feature::WedgeSide { opposite } => {
            let others: Vec<u8> = (0..3).filter(|&v| v != opposite).collect();
            vec![with_w(others[0], 0), with_w(others[1], 0), with_w(others[0], 1)]
        }
        other => panic!("{other}"),
    }
}
