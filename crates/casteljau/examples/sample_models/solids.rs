//! Solids: of revolution, swept, twisted, and the exact quarter ring and eighth of a ball.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

use casteljau::bernstein::multi_indices;
use casteljau::glam::{DVec3, DVec4};
use casteljau::io::model::{Model, NamedShape, Shape};
use casteljau::io::{
    CurveRecord, NetRecord, PatchRecord, RotationalRecord, TetrahedronRecord, TransitionalRecord,
    TwistedRecord, WedgeRecord,
};
use casteljau::shape::RationalTriangle;
use casteljau::solid::{RationalTetrahedron, SolidError, Twist};

/// File names and models.
pub fn all() -> Result<Vec<(&'static str, Model)>, SolidError> {
    Ok(vec![
        ("ball.json", ball()),
        ("cone.json", cone()),
        ("twisted_prism.json", twisted_prism()),
        ("rigid_twist.json", rigid_twist()),
        ("swept_disc.json", swept_disc()),
        ("quarter_ring.json", quarter_ring()),
        ("ball_octant.json", ball_octant()?),
    ])
}

const UNIT: [f64; 2] = [0.0, 1.0];

fn single(name: &str, shape: Shape) -> Model {
    Model { shapes: vec![NamedShape::new(Some(name.into()), shape)] }
}

fn curve(points: &[[f64; 3]], weights: Option<&[f64]>) -> CurveRecord {
    let points = points.to_vec();
    let net = match weights {
        None => NetRecord::Points(points),
        Some(weights) => NetRecord::Weighted { points, weights: weights.to_vec() },
    };
    CurveRecord { net, interval: UNIT }
}

/// The unit ball, from the half circle of degree 3.
fn ball() -> Model {
    let meridian = [[0.0, 0.0, -1.0], [2.0, 0.0, -1.0], [2.0, 0.0, 1.0], [0.0, 0.0, 1.0]];
    let curve = curve(&meridian, Some(&[3.0, 1.0, 1.0, 3.0])).into();
    single("unit ball", Shape::RotationalSolid(RotationalRecord { curve }))
}

/// Radius 1 and height 2.
fn cone() -> Model {
    let curve = curve(&[[1.0, 0.0, 0.0], [0.0, 0.0, 2.0]], None).into();
    single("cone", Shape::RotationalSolid(RotationalRecord { curve }))
}

/// The square of side 2 around the z axis.
fn square() -> PatchRecord {
    let net = [[-1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0]];
    PatchRecord { degrees: [1, 1], net: NetRecord::Points(net.to_vec()), intervals: [UNIT; 2] }
}

/// A quarter of a turn in three steps: the sections between the ends shrink.
fn twisted_prism() -> Model {
    let axis = [0.0, 1.0, 2.0, 3.0].map(|z| [0.0, 0.0, z]);
    let (patch, curve) = (square().into(), curve(&axis, None).into());
    let twist = Twist::PerLayer(FRAC_PI_6);
    single("twisted prism", Shape::TwistedSolid(TwistedRecord { patch, curve, twist }))
}

/// A quarter of a turn, every section the square itself.
fn rigid_twist() -> Model {
    let axis = [[0.0, 0.0, 0.0], [0.0, 0.0, 3.0]];
    let (patch, curve) = (square().into(), curve(&axis, None).into());
    let twist = Twist::Rigid(FRAC_PI_2);
    single("rigidly twisted prism", Shape::TwistedSolid(TwistedRecord { patch, curve, twist }))
}

/// A disc of radius 1 translated along a sixth of a circle of radius 2.
fn swept_disc() -> Model {
    // Four quarter circles around, and the center.
    let disc = [
        ([1.0, 0.0], 1.0),
        ([1.0, -1.0], 1.0),
        ([0.0, -1.0], 2.0),
        ([1.0, 1.0], 1.0),
        ([0.0, 0.0], 1.0),
        ([-1.0, -1.0], 2.0),
        ([0.0, 1.0], 2.0),
        ([-1.0, 1.0], 2.0),
        ([-1.0, 0.0], 4.0),
    ];
    let net = NetRecord::Weighted {
        points: disc.map(|([x, y], _)| [x, y, 0.0]).to_vec(),
        weights: disc.map(|(_, weight)| weight).to_vec(),
    };
    let patch = PatchRecord { degrees: [2, 2], net, intervals: [UNIT; 2] }.into();
    let third = 1.0 / 3.0_f64.sqrt();
    let arc = [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0 * third], [1.0, 0.0, 3.0 * third]];
    let curve = curve(&arc, Some(&[1.0, 1.5 * third, 1.0])).into();
    single("disc along an arc", Shape::TransitionalSolid(TransitionalRecord { patch, curve }))
}

/// A triangle of area ½ at the radii 1 to 2, turned by 90° about the z axis.
fn quarter_ring() -> Model {
    let column = |[r, z]: [f64; 2]| [[r, 0.0, z], [r, r, z], [0.0, r, z]];
    let points = [[1.0, 1.0], [2.0, 0.0], [1.0, 0.0]].map(column).as_flattened().to_vec();
    let weights = [[1.0, 0.5_f64.sqrt(), 1.0]; 3].as_flattened().to_vec();
    let net = NetRecord::Weighted { points, weights };
    single("quarter of a ring", Shape::Wedge(WedgeRecord { degrees: [1, 2], net, interval: UNIT }))
}

/// An eighth of the unit ball: the face across from the origin is the exact octant of the sphere, of degree 4, the others
/// are plane. All control points that are not on the octant are the straight tetrahedron's, with its corners' weight.
fn ball_octant() -> Result<Model, SolidError> {
    let sphere = RationalTriangle::sphere_octant(DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z)?;
    let weight = sphere.control_points()[0].w;
    let n = sphere.degree();
    let point = |[i, j, k, l]: [usize; 4]| match l {
        0 => sphere.control_point(i, j, k).unwrap_or(DVec4::ZERO),
        _ => (DVec3::new(i as f64, j as f64, k as f64) / n as f64).extend(1.0) * weight,
    };
    let net: Vec<DVec4> = multi_indices::<4>(n).map(point).collect();
    let solid = RationalTetrahedron::from_homogeneous(n, net)?;
    Ok(single("eighth of a ball", Shape::Tetrahedron(TetrahedronRecord::from(&solid))))
}
