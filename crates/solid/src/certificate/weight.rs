//! The weight function of a rational solid: has it a zero?

use casteljau_bernstein::{BoxNet, TetrahedronNet, WedgeNet, last_barycentric};
use casteljau_shape::ControlPoint;

use super::net::SolidNet;
use super::sign::{Coefficients, Sign};
use super::subdivision::Place;
use crate::SolidError;

/// Refuses solids whose weight function is zero somewhere.
pub(crate) fn check_one_sign<P: ControlPoint>(
    net: &SolidNet<'_, P>,
    operations: u64,
) -> Result<(), SolidError> {
    let given = weights(net);
    let Some(&first) = given.first() else { return Ok(()) };
    let degrees = net.degrees();
    for (index, at) in Place::whole(degrees).corners(degrees) {
        if given[degrees.place(index)] == 0.0 {
            return Err(SolidError::WeightZero { at });
        }
    }
    // The first point is a corner of every kind of solid.
    let values: Vec<f64> = given.iter().map(|w| w * first.signum()).collect();
    let none = vec![0.0; values.len()];
    let weight = Coefficients { degrees, values: &values, rounding: &none, tolerances: &none };
    match weight.sign(operations)? {
        Sign::Positive => Ok(()),
        // Zeros on features would be zeros at corners.
        Sign::PositiveExcept(_) => Ok(()),
        Sign::NotPositive { witness, .. } => {
            let positive = Place::whole(degrees)
                .corners(degrees)
                .into_iter()
                .map(|(_, at)| at)
                .find(|&at| value(net, at) * first.signum() > 0.0);
            let mut ends = [positive.unwrap_or(witness), witness];
            for _ in 0..60 {
                let middle = std::array::from_fn(|axis| 0.5 * (ends[0][axis] + ends[1][axis]));
                let side = usize::from(value(net, middle) * first.signum() <= 0.0);
                ends[side] = middle;
            }
            Err(SolidError::WeightZero { at: ends[1] })
        }
        Sign::Undecided { near, .. } => Err(SolidError::WeightUndecided { at: near }),
    }
}

/// The weight at parameters of the solid.
pub(crate) fn value<P: ControlPoint>(net: &SolidNet<'_, P>, [a, b, c]: [f64; 3]) -> f64 {
    let weights = weights(net);
    match *net {
        SolidNet::Hexahedron { degrees, .. } => BoxNet::validated(&weights, degrees).value(a, b, c),
        SolidNet::Tetrahedron { degree, .. } => {
            TetrahedronNet::validated(&weights, degree).value([a, b, c, last_barycentric(&[a, b, c])])
        }
        SolidNet::Wedge { degrees, .. } => {
            WedgeNet::validated(&weights, degrees).value([a, b, last_barycentric(&[a, b])], c)
        }
    }
}

fn weights<P: ControlPoint>(net: &SolidNet<'_, P>) -> Vec<f64> {
    net.points().iter().map(|p| p.homogeneous().w).collect()
}
