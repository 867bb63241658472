//! Nets in either form, nested or flat.

use casteljau_shape::ShapeError;
use casteljau_shape::bernstein::MAX_DEGREE;

use crate::place::Step;
use crate::record::Fault;
use crate::{NetRecord, Reason};

/// The net of the fields that are there, each flat already.
pub(super) fn net(
    control_points: Option<Vec<[f64; 3]>>,
    weights: Option<Vec<f64>>,
    homogeneous: Option<Vec<[f64; 4]>>,
) -> Result<NetRecord, Fault> {
    match (control_points, weights, homogeneous) {
        (Some(points), None, None) => Ok(NetRecord::Points(points)),
        (Some(points), Some(weights), None) => Ok(NetRecord::Weighted { points, weights }),
        (None, None, Some(points)) => Ok(NetRecord::Homogeneous(points)),
        (Some(_), _, Some(_)) => Err(two_nets("control_points")),
        (None, Some(_), Some(_)) => Err(two_nets("weights")),
        (None, _, None) => Err((Vec::new(), Reason::NoNet)),
    }
}

fn two_nets(field: &'static str) -> Fault {
    (vec![Step::Field("homogeneous")], Reason::TwoNets { field })
}

/// A degree within the limit, so that counts made of it are no nonsense.
pub(super) fn check_degree(degree: usize, steps: &[Step]) -> Result<(), Fault> {
    if degree <= MAX_DEGREE {
        return Ok(());
    }
    let refused = ShapeError::Degree { degree, limit: MAX_DEGREE };
    Err((steps.to_vec(), Reason::Shape(Box::new(refused))))
}

/// What a field holds, once its length is as the degree needs it.
pub(super) fn flat<T>(
    field: &'static str,
    given: Option<Vec<T>>,
    degree: usize,
    expected: usize,
) -> Result<Option<Vec<T>>, Fault> {
    match &given {
        Some(given) if given.len() != expected => {
            let (what, found) = (words(field), given.len());
            Err((vec![Step::Field(field)], Reason::NetSize { what, degree, expected, found }))
        }
        _ => Ok(given),
    }
}

/// The rows of a field, one behind the other, once their number and their lengths are as the degrees need them.
pub(super) fn rows<T>(
    field: &'static str,
    given: Option<Vec<Vec<T>>>,
    [m, n]: [usize; 2],
) -> Result<Option<Vec<T>>, Fault> {
    let Some(given) = given else { return Ok(None) };
    let size = |steps, what, degree, found| {
        Err((steps, Reason::NetSize { what, degree, expected: degree + 1, found }))
    };
    if given.len() != m + 1 {
        return size(vec![Step::Field(field)], "rows", m, given.len());
    }
    if let Some((row, points)) = given.iter().enumerate().find(|(_, points)| points.len() != n + 1) {
        return size(vec![Step::Field(field), Step::Index(row)], words(field), n, points.len());
    }
    Ok(Some(given.into_iter().flatten().collect()))
}

/// What a field consists of.
fn words(field: &str) -> &'static str {
    match field {
        "weights" => "weights",
        "homogeneous" => "homogeneous control points",
        _ => "control points",
    }
}
