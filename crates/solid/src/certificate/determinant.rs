//! Bernstein coefficients of the Jacobian determinant, with bounds on their rounding.

use casteljau_bernstein::glam::DVec4;
use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_shape::ControlPoint;

use super::net::{SolidDegrees, SolidNet};
use super::product::{Polynomial, Term, beyond_exact, contract, minors};
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
    /// component in three products, and three times as many for the bounds: some µs for a trilinear
    /// hexahedron, 20 µs for one of degree 2.
    ///
    /// # Errors
    /// [`SolidError::NetLength`] and [`SolidError::Shape`] for a net that is none, [`SolidError::Coefficients`] and
    /// [`SolidError::Multiplicities`] for high degrees.
    pub fn new<P: ControlPoint>(net: &SolidNet<'_, P>) -> Result<Self, SolidError> {
        net.check()?;
        net.degrees().check_determinant(P::RATIONAL)?;
        Ok(Self::of(net))
    }

    /// [`new`](Self::new) for a net that was checked.
    pub(super) fn of<P: ControlPoint>(net: &SolidNet<'_, P>) -> Self {
        let points = Points::new(net);
        let exponent = 3 * points.in_space + points.in_weight;
        match determinant::<P>(&points, net.degrees()) {
            Some(determinant) => finished(determinant, exponent, points.rounded),
            None => Self {
                degrees: net.degrees().constant(),
                values: vec![0.0],
                rounding: vec![0.0],
                tolerances: vec![0.0],
                exponent,
            },
        }
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
pub(crate) fn scaled(x: f64, exponent: i32) -> f64 {
    let half = exponent / 2;
    (x * 2_f64.powi(half) * 2_f64.powi(exponent - half)).clamp(f64::MIN, f64::MAX)
}

/// det J of a polynomial solid, times 2 to the power that is returned with it; `None` where it is zero by its degrees.
pub(crate) fn jacobian<P: ControlPoint>(net: &SolidNet<'_, P>) -> Option<(Polynomial<1>, i32)> {
    let points = Points::new(net);
    Some((determinant::<P>(&points, net.degrees())?, 3 * points.in_space))
}

/// det J or D; `None` for solids of degree 0 in a direction, which are flat.
fn determinant<P: ControlPoint>(points: &Points, degrees: SolidDegrees) -> Option<Polynomial<1>> {
    let derivative = |axis: usize| {
        let lower = degrees.lowered(axis)?;
        let factor = degrees.along()[axis] as f64;
        Some(points.row(degrees, lower, factor, unit(axis), Some([0; 3])))
    };
    let (v, w) = (derivative(1)?, derivative(2)?);
    if !P::RATIONAL {
        let normals = minors(&v, &w, &[(1, 2), (2, 0), (0, 1)]);
        return Some(contract(&derivative(0)?.narrowed(), &normals, [(0, 1.0), (1, 1.0), (2, 1.0)], 1.0));
    }
    let lower = degrees.lowered(0)?;
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
    Some(contract(&left, &right, complements, -factor))
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
                // Both steps are exact where the solid lies on a grid that is coarse enough (Knuth's error of a sum).
                let back = before - p[axis];
                let lost = (before - (p[axis] + back)) + (back - shift);
                let exact = f64::mul_add(center[axis], p.w, -shift) == 0.0 && lost == 0.0;
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
        Polynomial { degrees: lower, terms: terms.collect(), roundings: 5.0 + beyond_exact(lower) }
    }
}

/// The power of two that brings a number to [1, 2).
pub(crate) fn exponent(largest: f64) -> i32 {
    if largest > 0.0 { largest.log2().floor() as i32 } else { 0 }
}

/// A point in the middle of the control points, with few digits; the origin unless the solid is small beside its distance.
///
/// Few digits make the products with the weights exact where these have few digits too.
pub(crate) fn center(points: &[DVec4]) -> [f64; 3] {
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

/// The coefficients with their bounds.
fn finished(determinant: Polynomial<1>, exponent: i32, rounded: bool) -> JacobianCoefficients {
    let Polynomial { degrees, terms, roundings } = determinant;
    // The bounds themselves are rounded: by much less than a thousandth.
    let (per_size, per_uncertain) =
        (1.001 * UNIT_ROUNDOFF * (roundings + 4.0), 1.001 * UNIT_ROUNDOFF * INPUT_ROUNDINGS);
    let (mut values, mut rounding, mut tolerances) = (vec![], vec![], vec![]);
    for (term, index) in terms.iter().zip(degrees.indices()) {
        let multiplicity = degrees.multiplicity(index);
        let own = (per_size * term.size[0] + UNDERFLOW) / multiplicity;
        let tolerance = own + per_uncertain * term.uncertain[0] / multiplicity;
        values.push(term.value[0] / multiplicity);
        rounding.push(if rounded { tolerance } else { own });
        tolerances.push(tolerance);
    }
    JacobianCoefficients { degrees, values, rounding, tolerances, exponent }
}
