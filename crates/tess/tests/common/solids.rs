//! Solids to mesh.

use casteljau_geom::glam::{DVec3, DVec4, dvec3};
use casteljau_shape::RationalCurve;
use casteljau_shape::bernstein::multi_indices;
use casteljau_solid::{
    Axis, Hexahedron, RationalHexahedron, RationalTetrahedron, RationalWedge, Tetrahedron, Wedge,
};
use casteljau_tess::Solid;
use proptest::prelude::*;

/// A solid of any kind that owns its control points.
#[derive(Clone, Debug)]
pub enum Any {
    Hexahedron(Hexahedron),
    RationalHexahedron(RationalHexahedron),
    Tetrahedron(Tetrahedron),
    RationalTetrahedron(RationalTetrahedron),
    Wedge(Wedge),
    RationalWedge(RationalWedge),
}

impl Any {
    pub fn solid(&self) -> Solid<'_> {
        match self {
            Self::Hexahedron(solid) => solid.into(),
            Self::RationalHexahedron(solid) => solid.into(),
            Self::Tetrahedron(solid) => solid.into(),
            Self::RationalTetrahedron(solid) => solid.into(),
            Self::Wedge(solid) => solid.into(),
            Self::RationalWedge(solid) => solid.into(),
        }
    }

    /// The two halves across the first parameter, which share a face to the bit; the second one turned about.
    pub fn halves(&self) -> [Self; 2] {
        match self {
            Self::Hexahedron(solid) => {
                let (a, b) = solid.split(Axis::U, 0.375).unwrap();
                [Self::Hexahedron(a), Self::Hexahedron(b.permuted([Axis::W, Axis::U, Axis::V]).unwrap())]
            }
            Self::RationalHexahedron(solid) => {
                let (a, b) = solid.split(Axis::V, 0.5).unwrap();
                let b = b.reversed(Axis::U).reversed(Axis::W);
                [Self::RationalHexahedron(a), Self::RationalHexahedron(b)]
            }
            Self::Tetrahedron(solid) => {
                let (a, b) = solid.split_edge([0, 1], 0.4).unwrap();
                [Self::Tetrahedron(a), Self::Tetrahedron(b.permuted([1, 2, 0, 3]).unwrap())]
            }
            Self::RationalTetrahedron(solid) => {
                let (a, b) = solid.split_edge([2, 3], 0.5).unwrap();
                [Self::RationalTetrahedron(a), Self::RationalTetrahedron(b.permuted([3, 2, 1, 0]).unwrap())]
            }
            Self::Wedge(solid) => {
                let (a, b) = solid.split_height(0.5).unwrap();
                [Self::Wedge(a), Self::Wedge(b.reoriented([1, 2, 0], false).unwrap())]
            }
            Self::RationalWedge(solid) => {
                let (a, b) = solid.split_edge([0, 1], 0.5).unwrap();
                [Self::RationalWedge(a), Self::RationalWedge(b.reoriented([2, 1, 0], true).unwrap())]
            }
        }
    }
}

/// The unit ball, one hexahedron.
pub fn ball() -> RationalHexahedron {
    let half = [-DVec3::Z, dvec3(2.0, 0.0, -1.0), dvec3(2.0, 0.0, 1.0), DVec3::Z];
    let meridian = RationalCurve::new(&half, &[1.0, 1.0 / 3.0, 1.0 / 3.0, 1.0]).unwrap();
    RationalHexahedron::rotational(&meridian).unwrap()
}

/// A cone of radius 1 and height 1, its apex at the origin.
pub fn cone() -> RationalHexahedron {
    let meridian = RationalCurve::new(&[DVec3::ZERO, dvec3(1.0, 0.0, 1.0)], &[1.0, 1.0]).unwrap();
    RationalHexahedron::rotational(&meridian).unwrap()
}

/// A cylinder of radius 1 and height 2 from z = 0.
pub fn cylinder() -> RationalHexahedron {
    let meridian = RationalCurve::new(&[DVec3::X, dvec3(1.0, 0.0, 2.0)], &[1.0, 1.0]).unwrap();
    RationalHexahedron::rotational(&meridian).unwrap()
}

/// A ring with square sections: its first and last faces are one.
pub fn ring() -> Vec<RationalHexahedron> {
    // Four quarters of the tube between the radii 2 and 3 and the heights 0 and 1.
    let turn = |p: DVec3, quarter: usize| (0..quarter).fold(p, |p, _| dvec3(-p.y, p.x, p.z));
    (0..4)
        .map(|quarter| {
            let mut net = Vec::new();
            for (direction, weight) in
                [(dvec3(1., 0., 0.), 1.0), (dvec3(1., 1., 0.), 0.5f64.sqrt()), (dvec3(0., 1., 0.), 1.0)]
            {
                for radius in [2.0, 3.0] {
                    for height in [0.0, 1.0] {
                        let p = turn(direction * radius, quarter) + DVec3::Z * height;
                        net.push((p * weight).extend(weight));
                    }
                }
            }
            let quarter = RationalHexahedron::from_homogeneous([2, 1, 1], net).unwrap();
            // Parameters (around, outward, up) span a left-handed frame.
            quarter.reversed(Axis::V)
        })
        .collect()
}

/// A hexahedron of which one face is an edge and another's corner: a wedge by its shape.
pub fn folded_hexahedron() -> Hexahedron {
    let at = |u: f64, v: f64, w: f64| dvec3(u * (1.0 - 0.1 * w), u * v, w + 0.2 * u * u * v);
    let net: Vec<DVec3> =
        (0..27).map(|n| at((n / 9) as f64 / 2.0, (n / 3 % 3) as f64 / 2.0, (n % 3) as f64 / 2.0)).collect();
    Hexahedron::new([2, 2, 2], net).unwrap()
}

/// Random solids that are valid: control points of the identity, each moved by less than what turns a cell over.
pub fn any_solid() -> impl Strategy<Value = Any> {
    let shape = (0..6usize, 1..=3usize, 1..=3usize, 1..=2usize);
    let moves = proptest::collection::vec((-1.0..1.0, -1.0..1.0, -1.0..1.0, 0.0..1.0), 64);
    let scale = prop_oneof![Just(1e-6), Just(1.0), Just(1e6)];
    (shape, moves, scale, proptest::bool::ANY)
        .prop_map(|((kind, a, b, c), moves, scale, mirrored)| build(kind, [a, b, c], &moves, scale, mirrored))
}

fn build(
    kind: usize,
    [a, b, c]: [usize; 3],
    moves: &[(f64, f64, f64, f64)],
    scale: f64,
    mirrored: bool,
) -> Any {
    let mut next = moves.iter().cycle();
    let mut moved = |at: DVec3, degree: usize| -> DVec4 {
        let &(x, y, z, w) = next.next().unwrap();
        // Differences of control points stay within a quarter of 1/degree of the identity's.
        let mut p = at + dvec3(x, y, z) * (0.08 / degree as f64);
        if mirrored {
            p.x = -p.x;
        }
        let weight = 1.0 + 0.25 * w;
        (p * scale * weight).extend(weight)
    };
    let share = |i: usize, n: usize| i as f64 / n as f64;
    let most = a.max(b).max(c);
    let net: Vec<DVec4> = match kind / 2 {
        0 => {
            let all = (0..=a).flat_map(|i| (0..=b).flat_map(move |j| (0..=c).map(move |k| (i, j, k))));
            all.map(|(i, j, k)| moved(dvec3(share(i, a), share(j, b), share(k, c)), most)).collect()
        }
        1 => multi_indices::<4>(a)
            .map(|[i, j, k, _]| moved(dvec3(share(i, a), share(j, a), share(k, a)), a))
            .collect(),
        _ => multi_indices::<3>(a)
            .flat_map(|[i, j, _]| (0..=c).map(move |k| (i, j, k)))
            .map(|(i, j, k)| moved(dvec3(share(i, a), share(j, a), share(k, c)), most))
            .collect(),
    };
    let points: Vec<DVec3> = net.iter().map(|p| p.truncate() / p.w).collect();
    match kind {
        0 => Any::Hexahedron(Hexahedron::new([a, b, c], points).unwrap()),
        1 => Any::RationalHexahedron(RationalHexahedron::from_homogeneous([a, b, c], net).unwrap()),
        2 => Any::Tetrahedron(Tetrahedron::new(a, points).unwrap()),
        3 => Any::RationalTetrahedron(RationalTetrahedron::from_homogeneous(a, net).unwrap()),
        4 => Any::Wedge(Wedge::new([a, c], points).unwrap()),
        _ => Any::RationalWedge(RationalWedge::from_homogeneous([a, c], net).unwrap()),
    }
}
