//! Values and partial derivatives over a simplex.

use super::de_casteljau::raised;
use super::index::{MultiIndices, simplex_count, simplex_index, step_back};
use crate::interval::{nested_barycentric, push};
use crate::{BernsteinError, MAX_DEGREE, Point, binomial::Row};

/// A polynomial over a simplex with V vertices, `p(λ) = Σ n!/β! λ^β P_β`, |β| = n, over a borrowed control net.
///
/// λ are barycentric coordinates, one for each vertex; the points stand in descending lexicographic order of
/// their multi-indices, at the places [`simplex_index`]. [`TriangleNet`] and [`TetrahedronNet`] are the two in
/// daily use; with V = 2, `λ = [1−t, t]`, it is a curve.
///
/// **Barycentric coordinates are taken as given**, and the form above, homogeneous of degree n, is evaluated at
/// them. Nothing is normalised: where they add up to 1 + ε, the value is (1 + ε)ⁿ times that at the point
/// λ/(1 + ε). Negative ones continue the polynomial outside the simplex. [`last_barycentric`] makes the last one
/// of the others without loss of digits.
///
/// ```
/// use casteljau_bernstein::TriangleNet;
/// let net = TriangleNet::new(&[0.0, 0.5, 0.0, 0.0, 0.0, 0.0], 2)?; // λ₁λ₂
/// assert_eq!(net.value([0.5, 0.25, 0.25]), 0.125);
/// let mut partials = [0.0; 6]; // 1; λ₁, λ₂; λ₁λ₁, λ₁λ₂, λ₂λ₂, λ₃ = 1 − λ₁ − λ₂ being eliminated
/// net.partials([0.5, 0.25, 0.25], &mut partials);
/// assert_eq!(partials, [0.125, 0.25, 0.5, 0.0, 1.0, 0.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct SimplexNet<'a, P, const V: usize> {
    points: &'a [P],
    degree: usize,
}

/// A polynomial over a triangle; see [`SimplexNet`].
pub type TriangleNet<'a, P> = SimplexNet<'a, P, 3>;

/// A polynomial over a tetrahedron; see [`SimplexNet`].
pub type TetrahedronNet<'a, P> = SimplexNet<'a, P, 4>;

/// The last barycentric coordinate, `1 − Σλₐ`, from the others.
///
/// The sum is carried in twice the precision: relative error at most 2u, as long as the answer is above
/// `u·(1 + Σ|λₐ|)` times the number of coordinates.
///
/// ```
/// use casteljau_bernstein::last_barycentric;
/// assert_eq!(last_barycentric(&[0.1, 0.7]), 0.20000000000000004); // 1 − 0.1 − 0.7 gives …07
/// ```
#[must_use]
pub fn last_barycentric(free: &[f64]) -> f64 {
    let (mut sum, mut lost) = (1.0_f64, 0.0);
    for &x in free {
        let next = sum - x;
        // What rounding took from the difference, exactly (Knuth's two-sum).
        let taken = sum - next;
        lost += (sum - (next + taken)) + (taken - x);
        sum = next;
    }
    sum + lost
}

impl<'a, P: Point, const V: usize> SimplexNet<'a, P, V> {
    /// Takes `points` as a net of degree n.
    ///
    /// # Errors
    /// [`BernsteinError::SimplexNetLength`] unless there are [`simplex_count`] points,
    /// [`BernsteinError::Degree`] above [`MAX_DEGREE`].
    pub fn new(points: &'a [P], degree: usize) -> Result<Self, BernsteinError> {
        const { assert!(V >= 2, "a simplex has two vertices or more") };
        if degree > MAX_DEGREE {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
        }
        let (needed, given) = (simplex_count::<V>(degree), points.len());
        if given != needed {
            return Err(BernsteinError::SimplexNetLength { vertices: V, degree, needed, given });
        }
        Ok(Self { points, degree })
    }

    /// Takes `points` as a net that was validated before, when the shape that owns it was constructed.
    ///
    /// Nothing is checked: a net that does not fit its degree gives meaningless values, but no panic.
    #[inline]
    #[must_use]
    pub const fn validated(points: &'a [P], degree: usize) -> Self {
        const { assert!(V >= 2, "a simplex has two vertices or more") };
        Self { points, degree }
    }

    /// The degree n.
    #[must_use]
    pub const fn degree(&self) -> usize {
        self.degree
    }

    /// All control points.
    #[must_use]
    pub const fn points(&self) -> &'a [P] {
        self.points
    }

    /// The control point with a multi-index; `None` where its entries do not add up to the degree.
    #[must_use]
    pub fn point(&self, index: [usize; V]) -> Option<P> {
        let degree = index.iter().fold(0_usize, |sum, &entry| sum.saturating_add(entry));
        if degree == self.degree { self.points.get(simplex_index(index)).copied() } else { None }
    }

    /// Value `p(λ)`, by nested multiplication, from the first vertex to the last.
    ///
    /// At a vertex the answer is its control point to the bit; where some λ are 0 it is, to the bit, the value of
    /// the net of the edge or face that is left. Error: at most `4(n+2)·u·Σ|n!/β! λ^β P_β|`. Contributions below
    /// 10⁻²⁹⁰ may vanish. Cost: each point is read once, 3 operations a component.
    ///
    /// Source: Schumaker and Volk, "Efficient evaluation of multivariate polynomials", CAGD 3 (1986).
    #[inline]
    #[must_use]
    pub fn value(&self, lambda: [f64; V]) -> P {
        value(self.degree, lambda, &|place| self.at(place))
    }

    /// Partial derivatives with respect to all barycentric coordinates but the last, which is `1 − Σ` of the
    /// others: `n!/(n−k)! Σ (n−k)!/β! λ^β Δ^α P_β`, with `Δₐ P_β = P_{β+eₐ} − P_{β+e_V}` and k = |α|.
    ///
    /// They go to the places [`simplex_partial_index`](crate::simplex_partial_index)`(α)` of `out`; the total
    /// order is the greatest k with [`simplex_count`]`::<V>(k) ≤ out.len()`, and places beyond are set to zero.
    /// Differences are taken of the control points themselves, so that a shape far from the origin keeps the
    /// digits of its derivatives. Error: at most `4(n + 2k + 2)·u·scale`, scale being the sum of the absolute
    /// contributions. Cost: for each derivative k differences of the net, on the stack, and a value; nets of
    /// more than 256 points are not copied, and Π(αₐ + 1) of their points are read for each β.
    pub fn partials(&self, lambda: [f64; V], out: &mut [P]) {
        let Some(order) = (0..).take_while(|&k| simplex_count::<V>(k) <= out.len()).last() else {
            out.fill(P::ZERO);
            return;
        };
        out[simplex_count::<V>(order)..].fill(P::ZERO);
        // Homogeneous, with (order − |α|) before α, the orders are the multi-indices of a net. From the last one
        // down: the places below, at least |α| many, are still free to work in.
        let mut orders = [0; V];
        orders[V - 1] = order;
        loop {
            let (free, rest) = out.split_at_mut(simplex_index(orders));
            rest[0] = partial(self.degree, lambda, &orders[1..], free, &|place| self.at(place));
            if !step_back(&mut orders) {
                break;
            }
        }
    }

    /// Fills `net` with the control points, whatever their number.
    pub(super) fn copy_to(&self, net: &mut [P]) {
        for (place, p) in net.iter_mut().enumerate() {
            *p = self.at(place);
        }
    }

    #[inline]
    pub(crate) fn at(&self, place: usize) -> P {
        self.points.get(place).copied().unwrap_or(P::ZERO)
    }
}

/// Value of the form of degree n whose points `at` gives by their places.
#[inline]
pub(crate) fn value<P: Point, const V: usize>(n: usize, lambda: [f64; V], at: &impl Fn(usize) -> P) -> P {
    if n > MAX_DEGREE {
        P::NAN
    } else if lambda.iter().all(|&l| l != 0.0) {
        nested_form(n, &lambda, &mut (0..).map(at))
    } else {
        form(n, lambda, |index| at(simplex_index(index)))
    }
}

/// The partial derivative of orders `α`, one for each vertex but the last; `work` has |α| places or more.
pub(crate) fn partial<P: Point, const V: usize>(
    n: usize,
    lambda: [f64; V],
    orders: &[usize],
    work: &mut [P],
    at: &impl Fn(usize) -> P,
) -> P {
    let total: usize = orders.iter().sum();
    match n.checked_sub(total) {
        None => P::ZERO,
        Some(_) if n > MAX_DEGREE => P::NAN,
        Some(_) if total == 0 => value(n, lambda, at),
        Some(lower) => {
            let factor = (lower + 1..=n).fold(1.0, |f, m| f * m as f64);
            let derivative = match orders.iter().position(|&order| order == 1) {
                // First derivatives, most in demand, without recursion.
                Some(axis) if total == 1 => form(lower, lambda, |index: [usize; V]| {
                    at(simplex_index(raised(index, axis))) - at(simplex_index(raised(index, V - 1)))
                }),
                _ => match simplex_count::<V>(n) {
                    ..=20 => by_differences(n, lambda, orders, [P::ZERO; 20], at),
                    21..=64 => by_differences(n, lambda, orders, [P::ZERO; 64], at),
                    65..=256 => by_differences(n, lambda, orders, [P::ZERO; 256], at),
                    _ => form(lower, lambda, |index| difference(index, orders, work, at)),
                },
            };
            derivative * factor
        }
    }
}

/// `Σ (n−k)!/β! λ^β Δ^α P_β`, `net` having room for all points.
fn by_differences<P: Point, const V: usize, const ROOM: usize>(
    n: usize,
    lambda: [f64; V],
    orders: &[usize],
    mut net: [P; ROOM],
    at: &impl Fn(usize) -> P,
) -> P {
    for (place, p) in net.iter_mut().enumerate().take(simplex_count::<V>(n)) {
        *p = at(place);
    }
    let lower = differentiate::<P, V>(n, orders, &mut net);
    value(lower, lambda, &|place| net[place])
}

/// `Δ^α P_β` of a net of degree n, in place, and the degree n − |α| ≥ 0 that is left.
pub(crate) fn differentiate<P: Point, const V: usize>(n: usize, orders: &[usize], net: &mut [P]) -> usize {
    let mut lower = n;
    for (axis, &order) in orders.iter().enumerate() {
        for _ in 0..order {
            lower -= 1;
            difference_along::<P, V>(lower, axis, net);
        }
    }
    lower
}

/// `Δₐ P_β` for all β of degree `lower`, in place: what is read stands at the place written or above. Points that
/// differ in the last two entries only lie side by side, and so do the two lines that they are differences of.
fn difference_along<P: Point, const V: usize>(lower: usize, axis: usize, net: &mut [P]) {
    let mut place = 0;
    for first in MultiIndices::<V>::on_face(lower, std::array::from_fn(|vertex| vertex), V - 1) {
        let ahead = simplex_index(raised(first, axis));
        let last = simplex_index(raised(first, V - 2)) + 1;
        for q in 0..=first[V - 2] {
            net[place] = net[ahead + q] - net[last + q];
            place += 1;
        }
    }
}

/// `Δ^α P_β`, each Δₐ by repeated differences; `work` has |α| places or more.
pub(super) fn difference<P: Point, const V: usize>(
    mut index: [usize; V],
    orders: &[usize],
    work: &mut [P],
    at: &impl Fn(usize) -> P,
) -> P {
    let Some((&order, later)) = orders.split_first() else { return at(simplex_index(index)) };
    let axis = V - 1 - orders.len();
    let (differences, work) = work.split_at_mut(order);
    index[V - 1] += order;
    for filled in 0..order {
        let newest = difference(index, later, work, at);
        differences[filled] = push(&mut differences[..filled], newest);
        index[axis] += 1;
        index[V - 1] -= 1;
    }
    let newest = difference(index, later, work, at);
    push(differences, newest)
}

/// `Σ n!/β! λ^β P_β` over the face where λ does not vanish; elsewhere all terms are zero.
fn form<P: Point, const V: usize>(n: usize, lambda: [f64; V], coefficient: impl FnMut([usize; V]) -> P) -> P {
    let (mut face, mut on_face, mut vertices) = ([V - 1; V], [0.0; V], 0);
    for (vertex, &l) in lambda.iter().enumerate().filter(|(_, l)| **l != 0.0) {
        face[vertices] = vertex;
        on_face[vertices] = l;
        vertices += 1;
    }
    // Nothing left: the form is 0, but for n = 0; the last vertex, with λ = 0, gives just that.
    let vertices = vertices.max(1);
    let mut points = MultiIndices::on_face(n, face, vertices).map(coefficient);
    nested_form(n, &on_face[..vertices], &mut points)
}

/// `Σ n!/β! λ^β P_β` over points that are made one after another, as a polynomial in the first coordinate whose
/// coefficients are forms in the others: `(… (b₀ λ₁ + C(n,1) b₁) λ₁ + C(n,2) b₂) λ₁ + …) + bₙ`, bᵣ of degree r.
fn nested_form<P: Point>(n: usize, lambda: &[f64], points: &mut impl Iterator<Item = P>) -> P {
    match *lambda {
        [] => P::ZERO,
        [last] => (0..n).fold(points.next().unwrap_or(P::ZERO), |p, _| p * last),
        [s, t] => nested_barycentric(n, s, t, points),
        [first, ref others @ ..] => {
            let mut row = Row::new(n);
            let mut sum = nested_form(0, others, points);
            for r in 1..=n {
                sum = sum * first + nested_form(r, others, points) * row.coefficient(r);
            }
            sum
        }
    }
}
