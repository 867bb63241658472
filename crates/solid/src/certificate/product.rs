//! Products of polynomials over the domain of a solid, with what is needed to bound their rounding.

use super::net::SolidDegrees;

/// What belongs to one product of basis functions: K components, the sums of the absolute values of their contributions,
/// and what these change by for control points that are uncertain by one unit.
#[derive(Clone, Copy)]
pub(crate) struct Term<const K: usize> {
    pub value: [f64; K],
    pub size: [f64; K],
    pub uncertain: [f64; K],
}

/// A polynomial by its coefficients times their multiplicities, so that products are sums over sums of indices.
pub(crate) struct Polynomial<const K: usize> {
    pub degrees: SolidDegrees,
    pub terms: Vec<Term<K>>,
    /// So many roundings, at most, lie on the way of a contribution.
    pub roundings: f64,
}

impl Polynomial<4> {
    /// Without the weight.
    pub fn narrowed(&self) -> Polynomial<3> {
        let narrow = |[x, y, z, _]: [f64; 4]| [x, y, z];
        let terms = self.terms.iter().map(|t| Term {
            value: narrow(t.value),
            size: narrow(t.size),
            uncertain: narrow(t.uncertain),
        });
        Polynomial { degrees: self.degrees, terms: terms.collect(), roundings: self.roundings }
    }
}

/// Binomial coefficients above degree 50 are rounded: so many more roundings.
pub(crate) fn beyond_exact(degrees: SolidDegrees) -> f64 {
    let highest = degrees.along().into_iter().fold(0, usize::max);
    if highest > 50 { 6.0 * highest as f64 } else { 0.0 }
}

/// The minors `aᵢ bⱼ − aⱼ bᵢ` of two columns.
pub(crate) fn minors<const K: usize>(
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
pub(crate) fn contract<const K: usize>(
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
pub(crate) fn convolution<const A: usize, const B: usize, const K: usize>(
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
