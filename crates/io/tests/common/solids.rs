//! Random solids.

use casteljau_io::model::Shape;
use casteljau_io::{
    CurveRecord, HexahedronRecord, NetRecord, Part, PatchRecord, RotationalRecord, TetrahedronRecord,
    TransitionalRecord, TwistedRecord, WedgeRecord,
};
use casteljau_solid::Twist;
use proptest::prelude::*;

use super::classical::{interval, net};

/// Numbers that stay in range when three of them are multiplied.
fn tame(net: NetRecord) -> NetRecord {
    let small = |x: f64| if x.abs() <= 1e30 { x } else { 0.25 };
    match net {
        NetRecord::Points(points) => NetRecord::Points(points.into_iter().map(|p| p.map(small)).collect()),
        NetRecord::Weighted { points, weights } => NetRecord::Weighted {
            points: points.into_iter().map(|p| p.map(small)).collect(),
            weights: weights.into_iter().map(small).collect(),
        },
        NetRecord::Homogeneous(points) => {
            NetRecord::Homogeneous(points.into_iter().map(|p| p.map(small)).collect())
        }
    }
}

/// A curve that a patch can be moved along: its first point is not at infinity.
fn curve() -> impl Strategy<Value = Part<CurveRecord>> {
    let net = (1..5_usize).prop_flat_map(net).prop_map(tame).prop_map(|net| match net {
        NetRecord::Homogeneous(mut points) => {
            points[0] = [0.5, -1.0, 2.0, 0.75];
            NetRecord::Homogeneous(points)
        }
        NetRecord::Weighted { points, mut weights } => {
            weights[0] = 0.3;
            NetRecord::Weighted { points, weights }
        }
        net => net,
    });
    (net, interval(), prop::option::of(any::<String>()))
        .prop_map(|(net, interval, name)| Part { name, record: CurveRecord { net, interval } })
}

fn patch() -> impl Strategy<Value = Part<PatchRecord>> {
    ([0..3_usize, 0..3_usize], [interval(), interval()], prop::option::of(any::<String>())).prop_flat_map(
        |(degrees, intervals, name)| {
            let count = (degrees[0] + 1) * (degrees[1] + 1);
            net(count).prop_map(tame).prop_map(move |net| Part {
                name: name.clone(),
                record: PatchRecord { degrees, net, intervals },
            })
        },
    )
}

/// Any solid that can be built.
pub fn solid() -> impl Strategy<Value = Shape> {
    let tetrahedron = (0..5_usize).prop_flat_map(|degree| {
        net((degree + 1) * (degree + 2) * (degree + 3) / 6)
            .prop_map(move |net| Shape::Tetrahedron(TetrahedronRecord { degree, net }))
    });
    let hexahedron = ([0..4_usize, 0..4_usize, 0..4_usize], [interval(), interval(), interval()])
        .prop_flat_map(|(degrees, intervals)| {
            net(degrees.iter().map(|d| d + 1).product())
                .prop_map(move |net| Shape::Hexahedron(HexahedronRecord { degrees, net, intervals }))
        });
    let wedge = ([0..5_usize, 0..4_usize], interval()).prop_flat_map(|(degrees, interval)| {
        let [n, o] = degrees;
        net((n + 1) * (n + 2) / 2 * (o + 1))
            .prop_map(move |net| Shape::Wedge(WedgeRecord { degrees, net, interval }))
    });
    let transitional = (patch(), curve())
        .prop_map(|(patch, curve)| Shape::TransitionalSolid(TransitionalRecord { patch, curve }));
    let rotational = curve().prop_map(|curve| Shape::RotationalSolid(RotationalRecord { curve }));
    let twist = prop_oneof![(-9.0..9.0).prop_map(Twist::PerLayer), (-9.0..9.0).prop_map(Twist::Rigid)];
    let twisted = (patch(), curve(), twist)
        .prop_map(|(patch, curve, twist)| Shape::TwistedSolid(TwistedRecord { patch, curve, twist }));
    prop_oneof![tetrahedron, hexahedron, wedge, transitional, rotational, twisted]
}
