//! Bernstein coefficients of the Jacobian determinant, with bounds on their rounding.

use casteljau_bernstein::glam::DVec4;
use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_shape::ControlPoint;

use super::net::{SolidDegrees, SolidNet};
use crate::SolidError;

/// Control points are taken to be right to so many units of roundoff of their size: sums like x + y, rotations and
/// products with weights each leave one or two.
const INPUT_ROUNDINGS: f64 = 4.0;

/// What products below the range of f64 may add to a coefficient, the coordinates being brought near 1.
const UNDERFLOW: f64 = 1e-300;

/// The determinant of the partial derivatives of a solid as a Bernstein polynomial over its domain.
///
/// For a polynomial solid it is det J itself, of the degree 3n − 1 along each axis of a hexahedron, 3(n − 1) over a
/// tetrahedron, 3n − 2 and 3o − 1 over a wedge. For a rational one it is `D = w⁴ det J`. With H = (wX, w), the four
/// columns being H and its derivatives, `D = −det(H, H_u, H_v, H_w)`. As `H ∧ H_u = l A ∧ B`, where A and B are the nets of
/// the first l and of the last l layers, D has the degree 4l − 2 with u; with v and w it is written in 4m − 1 and
/// 4n − 1, one more than it has. Over a tetrahedron it is `−n³ det(A₄, A₁, A₂, A₃)` of degree 4(n − 1), Aₐ having the points
/// `P_{β+eₐ}`; over a wedge `−n² det(A₃, A₁, A₂, H_w)` of degrees 4n − 3 and 4o − 1.
#[derive(Debug, Clone, PartialEq)]
pub struct JacobianCoefficients {
    degrees: SolidDegrees,
    values: Vec<f64>,
    rounding: Vec<f64>,
    tolerances: Vec<f64>,
    /// The determinant is 2 to this power times what is stored.
    exponent: i32,
}

impl JacobianCoefficients {
    /// The coefficients for a solid.
    ///
    /// Error: each is right to its [`rounding`](Self::rounding). Cost: one multiplication for each pair of points and
    /// component in three products, and three times as many for the bounds: 10 µs for a trilinear hexahedron, 0.1 ms for
    /// one of degree 2.
    ///
    /// # Errors
    /// [`SolidError::NetLength`] and [`SolidError::Shape`] for a net that is none.
    pub fn new<P: ControlPoint>(net: &SolidNet<'_, P>) -> Result<Self, SolidError> {
        net.check()?;
        Ok(Self::of(net))
    }

    /// [`new`](Self::new) for a net that was checked.
    pub(super) fn of<P: ControlPoint>(net: &SolidNet<'_, P>) -> Self {
        let points = Points::new(net);
        let degrees = net.degrees();
        let flat = |exponent| Self {
            degrees: degrees.constant(),
            values: vec![0.0],
            rounding: vec![0.0],
            tolerances: vec![0.0],
            exponent,
        };
        let derivative = |axis: usize| {
            let lower = degrees.lowered(axis)?;
            let factor = degrees.along()[axis] as f64;
            Some(points.row(degrees, lower, factor, unit(axis), Some([0; 3])))
        };
        let Some(lower) = degrees.lowered(0) else { return flat(0) };
        let (Some(v), Some(w)) = (derivative(1), derivative(2)) else { return flat(0) };
        if !P::RATIONAL {
            let Some(u) = derivative(0) else { return flat(0) };
            let normals = minors(&v, &w, &[(1, 2), (2, 0), (0, 1)]);
            return contract(&u.narrowed(), &normals, [(0, 1.0), (1, 1.0), (2, 1.0)], 1.0)
                .finished(points.exponent(3, 0));
        }
        let part = |shift| points.row(degrees, lower, 1.0, shift, None);
        let n = degrees.along()[0] as f64;
        let (third, fourth, factor) = match degrees {
            SolidDegrees::Hexahedron(_) => (v, w, n),
            SolidDegrees::Tetrahedron(_) => (part(unit(1)), part(unit(2)), n * n * n),
            SolidDegrees::Wedge(_) => (part(unit(1)), w, n * n),
        };
        // Laplace's expansion by the first two columns: each minor with the one that it leaves.
        let all = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
        let complements = [(5, 1.0), (4, -1.0), (3, 1.0), (2, 1.0), (1, -1.0), (0, 1.0)];
        let (left, right) = (minors(&part([0; 3]), &part(unit(0)), &all), minors(&third, &fourth, &all));
        contract(&left, &right, complements, -factor).finished(points.exponent(3, 1))
    }

    /// The degrees that the determinant is written in.
    #[must_use]
    pub const fn degrees(&self) -> SolidDegrees {
        self.degrees
    }

    /// The coefficients, in the order of a net of those degrees.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.values.iter().map(|&v| scaled(v, self.exponent)).collect()
    }

    /// Bounds on the errors of the values, as the determinant of the net that was given to the bit.
    ///
    /// It is `N·u·Σ|contributions|`, N being the number of roundings on the way of one contribution, that of sums
    /// included. Rational solids far from the origin are brought near it first, which may round; then the bound is the
    /// [`tolerance`](Self::tolerances).
    #[must_use]
    pub fn rounding(&self) -> Vec<f64> {
        self.rounding.iter().map(|&r| scaled(r, self.exponent)).collect()
    }

    /// How far from 0 a coefficient may be and yet count as zero: the rounding, and what it changes by where each control
    /// point is wrong by 4u of its size (its largest coordinate) and each weight by 4u of itself.
    #[must_use]
    pub fn tolerances(&self) -> Vec<f64> {
        self.tolerances.iter().map(|&t| scaled(t, self.exponent)).collect()
    }

    /// Coefficients, roundings and tolerances with a common factor that is a power of two, and its exponent.
    pub(super) fn raw(&self) -> (&[f64], &[f64], &[f64], i32) {
        (&self.values, &self.rounding, &self.tolerances, self.exponent)
    }
}

/// `x·2ᵏ`, at the end of the range where it would leave it.
pub(super) fn scaled(x: f64, exponent: i32) -> f64 {
    let half = exponent / 2;
    (x * 2_f64.powi(half) * 2_f64.powi(exponent - half)).clamp(f64::MIN, f64::MAX)
}

const fn unit(axis: usize) -> [usize; 3] {
    let mut shift = [0; 3];
    shift[axis] = 1;
    shift
}

/// Control points near the origin and near 1, with their uncertainties.
struct Points {
    points: Vec<DVec4>,
    uncertain: Vec<DVec4>,
    in_space: i32,
    in_weight: i32,
    /// Whether bringing them there may have rounded.
    rounded: bool,
}

impl Points {
    fn new<P: ControlPoint>(net: &SolidNet<'_, P>) -> Self {
        let mut rounded = false;
        let given: Vec<DVec4> = net.points().iter().map(|p| p.homogeneous()).collect();
        let center = if P::RATIONAL { center(&given) } else { [0.0; 3] };
        let mut points = given.clone();
        for p in &mut points {
            for axis in 0..3 {
                let (shift, before) = (center[axis] * p.w, p[axis]);
                p[axis] = before - shift;
                // Both steps are exact where the solid lies on a grid that is coarse enough.
                let exact = f64::mul_add(center[axis], p.w, -shift) == 0.0
                    && before - p[axis] == shift
                    && p[axis] + shift == before;
                rounded |= !exact;
            }
        }
        let largest = |of: fn(&DVec4) -> f64| points.iter().map(of).fold(0.0, f64::max);
        let in_space = exponent(largest(|p| p.truncate().abs().max_element()));
        let in_weight = if P::RATIONAL { exponent(largest(|p| p.w.abs())) } else { 0 };
        let bring = |p: DVec4| {
            let q = p.truncate() * 2_f64.powi(-in_space);
            q.extend(p.w * 2_f64.powi(-in_weight))
        };
        let size = |p: &DVec4| p.truncate().abs().max_element();
        let far = center.into_iter().fold(0.0, |far: f64, c| far.max(c.abs()));
        let uncertain = given.iter().zip(&points).map(|(p, q)| {
            bring(
                DVec4::new(1.0, 1.0, 1.0, 0.0) * (size(p).max(size(q)) + far * p.w.abs())
                    + DVec4::W * p.w.abs(),
            )
        });
        let uncertain = uncertain.collect();
        Self { points: points.iter().map(|&p| bring(p)).collect(), uncertain, in_space, in_weight, rounded }
    }

    fn exponent(&self, in_space: i32, in_weight: i32) -> Scale {
        Scale { exponent: in_space * self.in_space + in_weight * self.in_weight, rounded: self.rounded }
    }

    /// Differences of points (or the points themselves), times `factor` and the multiplicities of the degrees `lower`.
    fn row(
        &self,
        degrees: SolidDegrees,
        lower: SolidDegrees,
        factor: f64,
        plus: [usize; 3],
        minus: Option<[usize; 3]>,
    ) -> Polynomial<4> {
        let terms = lower.indices().into_iter().map(|index| {
            let place =
                |shift: [usize; 3]| degrees.place(std::array::from_fn(|axis| index[axis] + shift[axis]));
            let (mut p, mut e) = (self.points[place(plus)], self.uncertain[place(plus)]);
            if let Some(minus) = minus {
                p -= self.points[place(minus)];
                e += self.uncertain[place(minus)];
            }
            let weight = factor * lower.multiplicity(index);
            let value = (p * weight).to_array();
            Term { value, size: value.map(f64::abs), uncertain: (e * weight).to_array() }
        });
        Polynomial { degrees: lower, terms: terms.collect(), roundings: 3.0 + beyond_exact(lower) }
    }
}

/// The power of two that brings a number to [1, 2).
fn exponent(largest: f64) -> i32 {
    if largest > 0.0 { largest.log2().floor() as i32 } else { 0 }
}

/// Binomial coefficients above degree 50 are rounded: so many more roundings.
fn beyond_exact(degrees: SolidDegrees) -> f64 {
    let highest = degrees.along().into_iter().fold(0, usize::max);
    if highest > 50 { 6.0 * highest as f64 } else { 0.0 }
}

/// A point in the middle of the control points, with few digits; the origin unless the solid is small beside its distance.
///
/// Few digits make the products with the weights exact where these have few digits too.
fn center(points: &[DVec4]) -> [f64; 3] {
    std::array::from_fn(|axis| {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for p in points.iter().filter(|p| p.w != 0.0) {
            let x = p[axis] / p.w;
            (low, high) = (low.min(x), high.max(x));
        }
        let (middle, size) = (0.5 * low + 0.5 * high, high - low);
        if !(middle.is_finite() && size.is_finite() && middle.abs() > 4.0 * size) {
            return 0.0;
        }
        let step = 2_f64.powi(exponent(size.max(middle.abs() * 2_f64.powi(-20))));
        (middle / step).round() * step
    })
}

struct Scale {
    exponent: i32,
    rounded: bool,
}

/// What belongs to one product of basis functions: K components, the sums of the absolute values of their contributions,
/// and what these change by for control points that are uncertain by one unit.
#[derive(Clone, Copy)]
struct Term<const K: usize> {
    value: [f64; K],
    size: [f64; K],
    uncertain: [f64; K],
}

/// A polynomial by its coefficients times their multiplicities, so that products are sums over sums of indices.
struct Polynomial<const K: usize> {
    degrees: SolidDegrees,
    terms: Vec<Term<K>>,
    /// So many roundings, at most, lie on the way of a contribution.
    roundings: f64,
}

impl Polynomial<4> {
    /// Without the weight.
    fn narrowed(&self) -> Polynomial<3> {
        let narrow = |[x, y, z, _]: [f64; 4]| [x, y, z];
        let terms = self.terms.iter().map(|t| Term {
            value: narrow(t.value),
            size: narrow(t.size),
            uncertain: narrow(t.uncertain),
        });
        Polynomial { degrees: self.degrees, terms: terms.collect(), roundings: self.roundings }
    }
}

impl Polynomial<1> {
    fn finished(self, scale: Scale) -> JacobianCoefficients {
        let Self { degrees, terms, roundings } = self;
        // The bounds themselves are rounded: by much less than a thousandth.
        let (per_size, per_uncertain) =
            (1.001 * UNIT_ROUNDOFF * (roundings + 2.0), 1.001 * UNIT_ROUNDOFF * INPUT_ROUNDINGS);
        let (mut values, mut rounding, mut tolerances) = (vec![], vec![], vec![]);
        for (term, index) in terms.iter().zip(degrees.indices()) {
            let multiplicity = degrees.multiplicity(index);
            let own = (per_size * term.size[0] + UNDERFLOW) / multiplicity;
            let tolerance = own + per_uncertain * term.uncertain[0] / multiplicity;
            values.push(term.value[0] / multiplicity);
            rounding.push(if scale.rounded { tolerance } else { own });
            tolerances.push(tolerance);
        }
        JacobianCoefficients { degrees, values, rounding, tolerances, exponent: scale.exponent }
    }
}

/// The minors `aᵢ bⱼ − aⱼ bᵢ` of two columns.
fn minors<const K: usize>(
    a: &Polynomial<4>,
    b: &Polynomial<4>,
    pairs: &[(usize, usize); K],
) -> Polynomial<K> {
    convolution(a, b, 2.0, |sum, a, b| {
        for (k, &(i, j)) in pairs.iter().enumerate() {
            sum.value[k] += a.value[i] * b.value[j] - a.value[j] * b.value[i];
            sum.size[k] += a.size[i] * b.size[j] + a.size[j] * b.size[i];
            sum.uncertain[k] += a.uncertain[i] * b.size[j] + a.size[i] * b.uncertain[j];
            sum.uncertain[k] += a.uncertain[j] * b.size[i] + a.size[j] * b.uncertain[i];
        }
    })
}

/// `factor Σ ± aₖ b_{order(k)}`.
fn contract<const K: usize>(
    a: &Polynomial<K>,
    b: &Polynomial<K>,
    order: [(usize, f64); K],
    factor: f64,
) -> Polynomial<1> {
    let mut product = convolution(a, b, 1.0 + K as f64, |sum: &mut Term<1>, a, b| {
        let mut value = 0.0;
        for (k, &(other, sign)) in order.iter().enumerate() {
            value += sign * (a.value[k] * b.value[other]);
            sum.size[0] += a.size[k] * b.size[other];
            sum.uncertain[0] += a.uncertain[k] * b.size[other] + a.size[k] * b.uncertain[other];
        }
        sum.value[0] += value;
    });
    for term in &mut product.terms {
        term.value[0] *= factor;
        term.size[0] *= factor.abs();
        term.uncertain[0] *= factor.abs();
    }
    product.roundings += 1.0;
    product
}

/// The product of two polynomials by any bilinear `add` that takes `steps` roundings.
fn convolution<const A: usize, const B: usize, const K: usize>(
    a: &Polynomial<A>,
    b: &Polynomial<B>,
    steps: f64,
    mut add: impl FnMut(&mut Term<K>, &Term<A>, &Term<B>),
) -> Polynomial<K> {
    let degrees = a.degrees.times(b.degrees);
    let [_, m, n] = degrees.along();
    // Places in a box that holds every index: there places of products are sums of places.
    let place = |[i, j, k]: [usize; 3]| (i * (m + 1) + j) * (n + 1) + k;
    let boxed = |degrees: SolidDegrees| degrees.indices().into_iter().map(place).collect::<Vec<_>>();
    let (of_a, of_b, of_product) = (boxed(a.degrees), boxed(b.degrees), boxed(degrees));
    let zero = Term { value: [0.0; K], size: [0.0; K], uncertain: [0.0; K] };
    let mut sums = vec![zero; of_product.iter().fold(0, |most, &p| most.max(p)) + 1];
    for (a, &at) in a.terms.iter().zip(&of_a) {
        for (b, &shift) in b.terms.iter().zip(&of_b) {
            add(&mut sums[at + shift], a, b);
        }
    }
    let meeting = a.terms.len().min(b.terms.len()) as f64;
    let roundings = a.roundings + b.roundings + steps + meeting + beyond_exact(degrees);
    Polynomial { degrees, terms: of_product.iter().map(|&p| sums[p]).collect(), roundings }
}
