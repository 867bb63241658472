//! The sample models, in millimetres.

use casteljau::io::model::{Model, NamedShape, Shape};
use casteljau::io::{GbPatchRecord, LayoutRecord};

use crate::guide::Guide;
use crate::plan::{Side, bent, ribbons, straight};

/// File names and models.
pub fn all() -> Vec<(&'static str, Model)> {
    vec![
        ("l.json", l()),
        ("u.json", u()),
        ("pocket.json", pocket()),
        ("mixed.json", mixed()),
        ("pair.json", pair()),
        ("closed.json", closed()),
    ]
}

fn named(name: &str, record: GbPatchRecord) -> NamedShape {
    NamedShape::new(Some(name.into()), Shape::GbPatch(record))
}

fn face(guide: &Guide, plan: &[Side]) -> GbPatchRecord {
    GbPatchRecord { ribbons: ribbons(guide, plan), ..Default::default() }
}

fn single(name: &str, record: GbPatchRecord) -> Model {
    Model { shapes: vec![named(name, record)] }
}

/// An L of six cubic sides with one concave corner, crowned over both arms.
fn l() -> Model {
    let guide = Guide(vec![
        (1, 0, [40.0, 0.0, 14.0]),
        (0, 1, [0.0, 40.0, 14.0]),
        (2, 0, [0.0, 1.5, -9.0]),
        (0, 2, [1.5, 0.0, -9.0]),
        (1, 1, [0.0, 0.0, 5.0]),
    ]);
    single("crowned L", face(&guide, &l_plan()))
}

fn l_plan() -> [Side; 6] {
    [(2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0), (0.0, 0.0)]
        .map(|(u, v)| straight(u, v, 3, 2))
}

/// A U of eight cubic sides with two concave corners, rolled about its length and twisted a little.
fn u() -> Model {
    let guide = Guide(vec![
        (1, 0, [30.0, 0.0, 24.0]),
        (0, 1, [0.0, 30.0, 4.0]),
        (2, 0, [0.0, 0.0, -8.0]),
        (0, 2, [0.0, -1.0, 3.0]),
        (2, 1, [0.0, 0.0, -1.2]),
        (1, 1, [1.0, 0.0, 2.4]),
    ]);
    let plan =
        [(3.0, 0.0), (3.0, 3.0), (2.0, 3.0), (2.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0), (0.0, 0.0)];
    single("rolled U", face(&guide, &plan.map(|(u, v)| straight(u, v, 3, 2))))
}

/// A dished pentagon of quintic sides, three layers and blends of power 3: it meets its ribbons with equal curvature.
fn pocket() -> Model {
    let guide = Guide(vec![
        (1, 0, [30.0, 0.0, 0.0]),
        (0, 1, [0.0, 30.0, 5.0]),
        (2, 0, [0.0, 0.0, 9.0]),
        (0, 2, [0.0, 0.0, 11.0]),
        (1, 1, [0.0, 0.0, 3.0]),
    ]);
    // A regular pentagon, rounded to hundredths, its sides bulging outward.
    let plan = [
        bent([0.70, 0.51], [0.31, 0.95], 5, 3),
        bent([-0.27, 0.83], [-0.81, 0.59], 5, 3),
        bent([-0.87, 0.0], [-0.81, -0.59], 5, 3),
        bent([-0.27, -0.83], [0.31, -0.95], 5, 3),
        bent([0.70, -0.51], [1.0, 0.0], 5, 3),
    ];
    let record = GbPatchRecord { blend_power: 3, layout: LayoutRecord::Regular, ..face(&guide, &plan) };
    single("dished pocket", record)
}

/// A T of eight sides of degrees 3 to 6 with two or three layers, two of them parabolas in the plan.
fn mixed() -> Model {
    let guide = Guide(vec![
        (1, 0, [28.0, 0.0, 15.0]),
        (0, 1, [0.0, 28.0, -6.0]),
        (2, 0, [0.0, 0.0, -5.0]),
        (0, 2, [0.0, 0.0, 3.5]),
        (1, 1, [0.0, 2.0, 0.0]),
    ]);
    let plan = [
        bent([1.5, -0.3], [2.0, 0.0], 4, 2),
        straight(2.0, 2.0, 3, 2),
        straight(3.0, 2.0, 5, 3),
        straight(3.0, 3.0, 3, 2),
        bent([1.5, 3.5], [0.0, 3.0], 6, 3),
        straight(0.0, 2.0, 4, 2),
        straight(1.0, 2.0, 3, 3),
        straight(1.0, 0.0, 5, 2),
    ];
    single("T of mixed degrees", face(&guide, &plan))
}

/// Two neighbours cut out of one surface, an L and a pentagon: they share a side and its tangent planes.
fn pair() -> Model {
    let guide = Guide(vec![
        (1, 0, [40.0, 0.0, 12.0]),
        (0, 1, [0.0, 40.0, 10.0]),
        (2, 0, [0.0, 1.0, -6.0]),
        (0, 2, [1.5, 0.0, -7.0]),
        (1, 1, [0.0, 0.0, 4.0]),
    ]);
    let pentagon =
        [(2.0, 0.0), (3.0, -0.25), (3.5, 0.5), (3.0, 1.25), (2.0, 1.0)].map(|(u, v)| straight(u, v, 3, 2));
    Model { shapes: vec![named("arm", face(&guide, &l_plan())), named("end", face(&guide, &pentagon))] }
}

/// A solid bracket: crowned L on top, flat L below, six walls with a draft between them.
fn closed() -> Model {
    let plan = l_plan();
    let top = Guide(vec![
        (0, 0, [0.0, 0.0, 24.0]),
        (1, 0, [40.0, 0.0, 10.0]),
        (0, 1, [0.0, 40.0, 10.0]),
        (2, 0, [0.0, 1.5, -6.0]),
        (0, 2, [1.5, 0.0, -6.0]),
        (1, 1, [0.0, 0.0, 3.0]),
    ]);
    let bottom = Guide(vec![
        (0, 0, [-3.0, -3.0, 0.0]),
        (1, 0, [43.0, 0.0, 0.0]),
        (0, 1, [0.0, 43.0, 0.0]),
        (2, 0, [0.0, 1.5, 0.0]),
        (0, 2, [1.5, 0.0, 0.0]),
    ]);
    // Seen from below, the outline runs the other way.
    let mut under: Vec<Side> = plan.to_vec();
    under.reverse();
    let mut shapes = vec![named("top", face(&top, &plan)), named("bottom", face(&bottom, &under))];
    for (i, side) in plan.iter().enumerate() {
        let start = plan[(i + plan.len() - 1) % plan.len()].end;
        shapes.push(named(&format!("wall {i}"), face(&wall(&bottom, &top, start, side.end), &WALL)));
    }
    Model { shapes }
}

const WALL: [Side; 4] = [
    Side { end: [1.0, 0.0], bend: None, degree: 3, layers: 2 },
    Side { end: [1.0, 1.0], bend: None, degree: 3, layers: 2 },
    Side { end: [0.0, 1.0], bend: None, degree: 3, layers: 2 },
    Side { end: [0.0, 0.0], bend: None, degree: 3, layers: 2 },
];

/// The ruled surface between two guides along a straight line of the plan: (1 − v) below(s) + v above(s), u = s.
fn wall(below: &Guide, above: &Guide, start: [f64; 2], end: [f64; 2]) -> Guide {
    use crate::guide::Series;
    let line = std::array::from_fn(|axis| Series(vec![vec![start[axis], end[axis] - start[axis]]]));
    let (low, high) = (below.along(&line), above.along(&line));
    let coefficient = |series: &[Series; 3], i: usize| {
        std::array::from_fn(|axis| series[axis].0[0].get(i).copied().unwrap_or(0.0))
    };
    let mut terms = Vec::new();
    for i in 0..=3 {
        let (a, b): ([f64; 3], [f64; 3]) = (coefficient(&low, i), coefficient(&high, i));
        terms.push((i, 0, a));
        terms.push((i, 1, std::array::from_fn(|axis| b[axis] - a[axis])));
    }
    Guide(terms)
}
