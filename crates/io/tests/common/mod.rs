//! Random descriptions for the round trips.
#![allow(dead_code, clippy::unwrap_used)]

mod classical;
mod solids;

use casteljau_io::{
    CenterWeightName, CoordinatesName, CornerPointRecord, GbPatchRecord, LayoutRecord, RibbonRecord,
};
pub use classical::classical;
use proptest::prelude::*;
pub use solids::solid;

/// Finite numbers that hunt for bad printing and reading: every exponent, neighbours of powers of ten and of integers,
/// subnormals, both zeros.
pub fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<u64>().prop_map(f64::from_bits),
        (-308..309, -32..32_i64).prop_map(|(exponent, ulps)| {
            let power: f64 = format!("1e{exponent}").parse().unwrap();
            f64::from_bits(power.to_bits().wrapping_add_signed(ulps))
        }),
        (-1000..1000_i64, -2..3_i64)
            .prop_map(|(n, ulps)| f64::from_bits((n as f64).to_bits().wrapping_add_signed(ulps))),
        (-100_000..100_000_i64).prop_map(|n| n as f64 / 1000.0),
        Just(0.0),
        Just(-0.0),
        Just(f64::MIN_POSITIVE),
        Just(f64::from_bits(1)),
        Just(f64::MAX),
    ]
    .prop_map(|x| if x.is_finite() { x } else { 0.1 })
}

pub fn point() -> impl Strategy<Value = [f64; 3]> {
    [number(), number(), number()]
}

fn ribbon() -> impl Strategy<Value = RibbonRecord> {
    (1..=20_usize, 1..=6_usize)
        .prop_flat_map(|(degree, layers)| {
            prop::collection::vec(prop::collection::vec(point(), degree + 1), layers)
        })
        .prop_map(|control_points| RibbonRecord { control_points })
}

/// Any description that is well-formed; few of them are patches.
pub fn record() -> impl Strategy<Value = GbPatchRecord> {
    (3..7_usize).prop_flat_map(|sides| {
        let layout = prop_oneof![
            Just(LayoutRecord::Projection),
            Just(LayoutRecord::Heuristic),
            Just(LayoutRecord::Regular),
            prop::collection::vec([number(), number()], sides).prop_map(LayoutRecord::Given),
        ];
        let coordinates = prop_oneof![
            Just(CoordinatesName::Harmonic),
            Just(CoordinatesName::Wachspress),
            Just(CoordinatesName::MeanValue),
        ];
        let corners = prop::collection::vec(prop::option::of(point()), sides);
        let ribbons = prop::collection::vec(ribbon(), sides);
        (ribbons, layout, coordinates, 1..100_u32, prop::option::of(point()), weight(), corners).prop_map(
            |(ribbons, layout, coordinates, blend_power, center, center_weight, corners)| GbPatchRecord {
                ribbons,
                layout,
                coordinates,
                blend_power,
                center,
                center_weight,
                corner_points: corners
                    .into_iter()
                    .enumerate()
                    .filter_map(|(corner, point)| Some(CornerPointRecord { corner, point: point? }))
                    .collect(),
            },
        )
    })
}

fn weight() -> impl Strategy<Value = CenterWeightName> {
    prop_oneof![
        Just(CenterWeightName::None),
        Just(CenterWeightName::Deficiency),
        Just(CenterWeightName::Nth),
        Just(CenterWeightName::Harmonic),
    ]
}
