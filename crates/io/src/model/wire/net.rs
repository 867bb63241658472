//! Nets in either form, nested or flat.

use casteljau_shape::ShapeError;
use casteljau_shape::bernstein::{MAX_DEGREE, simplex_count};

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

/// What an array of a nested field holds: how many, after which degree, and how they are called.
#[derive(Clone, Copy)]
pub(super) struct Level {
    degree: usize,
    count: usize,
    what: &'static str,
}

impl Level {
    /// One more than the degree.
    pub(super) fn along(degree: usize, what: &'static str) -> Self {
        Self { degree, count: degree + 1, what }
    }

    /// A column for each control point of a triangle.
    pub(super) fn columns(degree: usize) -> Self {
        Self { degree, count: simplex_count::<3>(degree), what: "columns" }
    }

    fn check<T>(&self, given: &[T], steps: impl FnOnce() -> Vec<Step>) -> Result<(), Fault> {
        let Self { degree, count: expected, what } = *self;
        match given.len() {
            found if found == expected => Ok(()),
            found => Err((steps(), Reason::NetSize { what, degree, expected, found })),
        }
    }
}

/// The rows of a field, one behind the other, once their number is as `outer` says and their lengths fit the degree.
pub(super) fn rows<T>(
    field: &'static str,
    given: Option<Vec<Vec<T>>>,
    outer: Level,
    degree: usize,
) -> Result<Option<Vec<T>>, Fault> {
    let Some(given) = given else { return Ok(None) };
    outer.check(&given, || vec![Step::Field(field)])?;
    let inner = Level::along(degree, words(field));
    for (row, points) in given.iter().enumerate() {
        inner.check(points, || vec![Step::Field(field), Step::Index(row)])?;
    }
    Ok(Some(given.into_iter().flatten().collect()))
}

/// The slabs of a field, one behind the other, once the numbers of slabs, rows and points fit the degrees.
pub(super) fn slabs<T>(
    field: &'static str,
    given: Option<Vec<Vec<Vec<T>>>>,
    [l, m, n]: [usize; 3],
) -> Result<Option<Vec<T>>, Fault> {
    let Some(given) = given else { return Ok(None) };
    Level::along(l, "slabs").check(&given, || vec![Step::Field(field)])?;
    let (rows, inner) = (Level::along(m, "rows"), Level::along(n, words(field)));
    for (slab, lines) in given.iter().enumerate() {
        rows.check(lines, || vec![Step::Field(field), Step::Index(slab)])?;
        for (row, points) in lines.iter().enumerate() {
            inner.check(points, || vec![Step::Field(field), Step::Index(slab), Step::Index(row)])?;
        }
    }
    Ok(Some(given.into_iter().flatten().flatten().collect()))
}

/// What a field consists of.
fn words(field: &str) -> &'static str {
    match field {
        "weights" => "weights",
        "homogeneous" => "homogeneous control points",
        _ => "control points",
    }
}
