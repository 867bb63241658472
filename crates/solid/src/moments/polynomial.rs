//! Moments of polynomial solids, exact but for rounding.

use casteljau_bernstein::glam::DVec3;
use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_shape::ControlPoint;

use super::{Integrals, MassProperties, assembled};
use crate::certificate::product::{Polynomial, Term, beyond_exact, convolution};
use crate::certificate::{SolidDegrees, SolidNet, exponent, jacobian};

/// The products of two coordinates, in the order of the integrals.
const PAIRS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// All ten integrals about a point, with bounds on their errors.
pub(super) fn integrate<P: ControlPoint>(net: &SolidNet<'_, P>, reference: DVec3) -> MassProperties {
    let places: Vec<DVec3> = net.points().iter().map(|p| p.homogeneous().truncate() - reference).collect();
    let in_space = exponent(places.iter().fold(0.0, |most, p| most.max(p.abs().max_element())));
    let (mut sums, mut errors): (Integrals, Integrals) = ([0.0; 10], [0.0; 10]);
    let mut exponents = [0; 2];
    if let Some((determinant, in_volume)) = jacobian(net) {
        exponents = [in_volume, in_space];
        let degrees = net.degrees();
        let place = places.iter().zip(degrees.indices()).map(|(p, index)| {
            let value = (*p * 2_f64.powi(-in_space) * degrees.multiplicity(index)).to_array();
            Term { value, size: value.map(f64::abs), uncertain: [0.0; 3] }
        });
        let roundings = 2.0 + beyond_exact(degrees);
        let place = Polynomial { degrees, terms: place.collect(), roundings };
        let square = convolution(&place, &place, 1.0, |sum: &mut Term<6>, a, b| {
            for (k, (i, j)) in PAIRS.into_iter().enumerate() {
                sum.value[k] += a.value[i] * b.value[j];
                sum.size[k] += a.size[i] * b.size[j];
            }
        });
        let one = Term { value: [1.0], size: [1.0], uncertain: [0.0] };
        let one = Polynomial { degrees: degrees.constant(), terms: vec![one], roundings: 0.0 };
        ([sums[0]], [errors[0]]) = integral_of_product(&one, &determinant);
        let first = integral_of_product(&place, &determinant);
        sums[1..4].copy_from_slice(&first.0);
        errors[1..4].copy_from_slice(&first.1);
        let second = integral_of_product(&square, &determinant);
        sums[4..].copy_from_slice(&second.0);
        errors[4..].copy_from_slice(&second.1);
    }
    assembled(sums, errors, reference, exponents)
}

/// `∫ a b`: every basis function of degrees N has the same integral, the measure of the domain divided by their number.
fn integral_of_product<const K: usize>(a: &Polynomial<K>, b: &Polynomial<1>) -> ([f64; K], [f64; K]) {
    let degrees = a.degrees.times(b.degrees);
    let share = degrees.measure() / degrees.count() as f64;
    // As in products of polynomials: in a box that holds every index, places add up.
    let [_, m, n] = degrees.along();
    let place = |[i, j, k]: [usize; 3]| (i * (m + 1) + j) * (n + 1) + k;
    let boxed = |degrees: SolidDegrees| degrees.indices().into_iter().map(place).collect::<Vec<_>>();
    let (of_a, of_b) = (boxed(a.degrees), boxed(b.degrees));
    let indices = degrees.indices();
    let mut inverse = vec![0.0; indices.iter().fold(0, |most, &index| most.max(place(index))) + 1];
    for index in indices {
        inverse[place(index)] = 1.0 / degrees.multiplicity(index);
    }
    let (mut sums, mut sizes) = ([0.0; K], [0.0; K]);
    for (a, at) in a.terms.iter().zip(of_a) {
        let (mut value, mut size) = (0.0, 0.0);
        for (b, shift) in b.terms.iter().zip(&of_b) {
            value += b.value[0] * inverse[at + shift];
            size += b.size[0] * inverse[at + shift];
        }
        for k in 0..K {
            sums[k] += a.value[k] * value;
            sizes[k] += a.size[k] * size;
        }
    }
    let added = (a.terms.len() + b.terms.len()) as f64;
    let roundings = a.roundings + b.roundings + added + beyond_exact(degrees) + 8.0;
    // The bound itself is rounded too, by much less than a thousandth.
    let errors = sizes.map(|size| 1.001 * roundings * UNIT_ROUNDOFF * size * share + 1e-300);
    (sums.map(|sum| sum * share), errors)
}
