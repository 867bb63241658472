//! Random curves, patches and triangles.

use casteljau_io::model::Shape;
use casteljau_io::{CurveRecord, NetRecord, PatchRecord, PowerCurveRecord, PowerPatchRecord, TriangleRecord};
use proptest::prelude::*;

use super::number;

/// Coordinates that a shape accepts, and products of two of which it accepts too.
pub fn coordinate() -> impl Strategy<Value = f64> {
    number().prop_map(|x| if x.abs() <= 1e70 { x } else { -0.0 })
}

pub fn points(count: usize) -> impl Strategy<Value = Vec<[f64; 3]>> {
    prop::collection::vec([coordinate(), coordinate(), coordinate()], count)
}

/// The three forms; the last weight is not zero.
pub fn net(count: usize) -> impl Strategy<Value = NetRecord> {
    let weights = prop::collection::vec(coordinate(), count - 1).prop_map(|mut weights| {
        weights.push(0.5);
        weights
    });
    let homogeneous =
        prop::collection::vec([coordinate(), coordinate(), coordinate(), coordinate()], count - 1);
    prop_oneof![
        points(count).prop_map(NetRecord::Points),
        (points(count), weights).prop_map(|(points, weights)| NetRecord::Weighted { points, weights }),
        homogeneous.prop_map(|mut points| {
            points.push([0.1, 0.2, 0.3, -0.7]);
            NetRecord::Homogeneous(points)
        }),
    ]
}

pub fn interval() -> impl Strategy<Value = [f64; 2]> {
    prop_oneof![
        Just([0.0, 1.0]),
        Just([-0.0, 1.0]),
        (coordinate(), coordinate()).prop_map(|(a, b)| if a < b { [a, b] } else { [b, a.max(b + 1.0)] }),
    ]
    .prop_map(|[a, b]| if a < b { [a, b] } else { [0.0, f64::MIN_POSITIVE] })
}

/// Any curve, patch or triangle that can be built.
pub fn classical() -> impl Strategy<Value = Shape> {
    let curve = (1..8_usize, interval()).prop_flat_map(|(count, interval)| {
        net(count).prop_map(move |net| Shape::Curve(CurveRecord { net, interval }))
    });
    let power_curve = (1..8_usize, interval()).prop_flat_map(|(count, interval)| {
        points(count)
            .prop_map(move |coefficients| Shape::PowerCurve(PowerCurveRecord { coefficients, interval }))
    });
    let patch = ([0..4_usize, 0..4_usize], [interval(), interval()]).prop_flat_map(|(degrees, intervals)| {
        net((degrees[0] + 1) * (degrees[1] + 1))
            .prop_map(move |net| Shape::Patch(PatchRecord { degrees, net, intervals }))
    });
    let power_patch =
        ([0..4_usize, 0..4_usize], [interval(), interval()]).prop_flat_map(|(degrees, intervals)| {
            points((degrees[0] + 1) * (degrees[1] + 1)).prop_map(move |coefficients| {
                Shape::PowerPatch(PowerPatchRecord { degrees, coefficients, intervals })
            })
        });
    let triangle = (0..5_usize).prop_flat_map(|degree| {
        net((degree + 1) * (degree + 2) / 2)
            .prop_map(move |net| Shape::Triangle(TriangleRecord { degree, net }))
    });
    prop_oneof![curve, power_curve, patch, power_patch, triangle]
}
