//! Area, volume and distance, against closed forms and plain search.
#![allow(clippy::unwrap_used, clippy::panic)]

use casteljau_mesh::glam::{DMat3, DVec3, dvec3};
use casteljau_mesh::{MAX_COORDINATE, MeshError, TriangleMesh, TriangleTree};
use proptest::prelude::*;

/// The unit cube, outward.
fn cube() -> TriangleMesh {
    let positions = (0..8).map(|i| dvec3(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1)));
    let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    TriangleMesh {
        positions: positions.collect(),
        normals: Vec::new(),
        triangles: squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
    }
}

fn moved(mesh: &TriangleMesh, turn: DMat3, shift: DVec3) -> TriangleMesh {
    TriangleMesh { positions: mesh.positions.iter().map(|&p| turn * p + shift).collect(), ..mesh.clone() }
}

#[test]
fn area_and_volume_of_a_cube() {
    let cube = cube();
    assert!(cube.audit().unwrap().closed && cube.audit().unwrap().oriented);
    assert_eq!((cube.area(), cube.signed_volume()), (Ok(6.0), Ok(1.0)));
    let mut inside_out = cube.clone();
    inside_out.flip();
    assert_eq!(inside_out.signed_volume(), Ok(-1.0));
    // Far away and turned: the corners round to u·1e6, and so does the volume, not to u·1e18.
    let turn = DMat3::from_rotation_z(0.3) * DMat3::from_rotation_x(1.1);
    let far = moved(&cube, turn, dvec3(1e6, -2e6, 3e5));
    assert!((far.signed_volume().unwrap() - 1.0).abs() < 24.0 * 1.1e-16 * 2e6);
    assert!((far.area().unwrap() - 6.0).abs() < 48.0 * 1.1e-16 * 2e6);
    for size in [1e-40, 1e-6, 1e6, MAX_COORDINATE] {
        let scaled = moved(&cube, DMat3::from_diagonal(DVec3::splat(size)), DVec3::ZERO);
        assert!((scaled.signed_volume().unwrap() / size.powi(3) - 1.0).abs() < 1e-15, "{size}");
        assert!((scaled.area().unwrap() / (6.0 * size * size) - 1.0).abs() < 1e-15, "{size}");
    }
}

#[test]
fn volume_needs_a_closed_oriented_mesh() {
    let mut open = cube();
    open.triangles.pop();
    assert!(matches!(open.signed_volume(), Err(MeshError::NotClosed { boundary_edges: 3, .. })));
    let mut turned = cube();
    turned.triangles[0].swap(0, 1);
    assert!(matches!(turned.signed_volume(), Err(MeshError::NotOriented { .. })));
    assert_eq!(TriangleMesh::default().signed_volume(), Ok(0.0));
    assert_eq!(TriangleMesh::default().area(), Ok(0.0));
    // Two cubes that share an edge: it has four triangles, and the volume is that of both.
    let mut two = cube();
    two.append(&moved(&cube(), DMat3::IDENTITY, dvec3(1.0, 1.0, 0.0))).unwrap();
    let two = two.welded().unwrap().mesh;
    assert!(!two.audit().unwrap().edge_manifold);
    assert_eq!(two.signed_volume(), Ok(2.0));
    let huge = moved(&cube(), DMat3::from_diagonal(DVec3::splat(1.01 * MAX_COORDINATE)), DVec3::ZERO);
    assert!(matches!(huge.area(), Err(MeshError::TooLarge { index: 1, .. })));
}

#[test]
fn the_sum_does_not_tire() {
    // 0.1 rounds: ten million plain additions of its square would lose eight digits.
    let one = TriangleMesh {
        positions: vec![DVec3::ZERO, 0.1 * DVec3::X, 0.1 * DVec3::Y],
        triangles: vec![[0, 1, 2]; 1_000_000],
        ..Default::default()
    };
    assert!((one.area().unwrap() / (0.5 * 0.1 * 0.1 * 1e6) - 1.0).abs() < 1e-15);
}

#[test]
fn distances_that_are_known() {
    let tree = TriangleTree::new(&cube()).unwrap();
    let inside = tree.closest(dvec3(0.5, 0.5, 0.875)).unwrap();
    assert_eq!((inside.distance, inside.point), (0.125, dvec3(0.5, 0.5, 1.0)));
    let corner = tree.closest(dvec3(2.0, 2.0, 2.0)).unwrap();
    assert_eq!((corner.point, corner.distance), (DVec3::ONE, 3.0_f64.sqrt()));
    let edge = tree.closest(dvec3(0.25, -3.0, -4.0)).unwrap();
    assert_eq!((edge.point, edge.distance), (dvec3(0.25, 0.0, 0.0), 5.0));
    let deviation = tree.deviation(&[dvec3(0.5, 0.5, 2.0), dvec3(0.5, 0.5, 4.0), DVec3::ZERO]).unwrap();
    assert_eq!((deviation.max, deviation.worst), (3.0, 1));
    assert!((deviation.mean - 4.0 / 3.0).abs() < 1e-15);
    assert!((deviation.rms - (10.0_f64 / 3.0).sqrt()).abs() < 1e-15);
    assert_eq!(tree.deviation(&[]).unwrap().max, 0.0);
    let bad = tree.deviation(&[DVec3::ZERO, dvec3(0.0, f64::NAN, 0.0)]);
    assert!(matches!(bad, Err(MeshError::NonFinite { what: "point", index: 1, .. })));
    assert!(matches!(tree.closest(DVec3::splat(1e300)), Err(MeshError::TooLarge { .. })));
    assert_eq!(TriangleTree::new(&TriangleMesh::default()).unwrap_err(), MeshError::Empty);
    assert_eq!(TriangleMesh::default().closest(DVec3::ZERO), Err(MeshError::Empty));
}

/// A coordinate that hunts: small integers, so that points repeat and triangles degenerate, or anything.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![(-2..3_i8).prop_map(f64::from), -2.0..2.0_f64, (-2..3_i8).prop_map(|i| f64::from(i) + 1e-15)]
}

fn point() -> impl Strategy<Value = DVec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(DVec3::from)
}

proptest! {
    #[test]
    fn the_tree_agrees_with_plain_search(
        positions in prop::collection::vec(point(), 3..30),
        picks in prop::collection::vec(any::<[prop::sample::Index; 3]>(), 1..60),
        queries in prop::collection::vec(point(), 1..20),
    ) {
        let triangles = picks.iter().map(|pick| pick.map(|i| i.index(positions.len()) as u32)).collect();
        let mesh = TriangleMesh { positions, normals: Vec::new(), triangles };
        let tree = TriangleTree::new(&mesh).unwrap();
        for query in queries {
            let (fast, plain) = (tree.closest(query).unwrap(), mesh.closest(query).unwrap());
            // Boxes are pruned by exact comparisons of rounded distances: the same to rounding, not to the bit.
            prop_assert!((fast.distance - plain.distance).abs() <= 1e-15);
            prop_assert!((fast.point.distance(query) - fast.distance).abs() <= 1e-15);
            let corners = mesh.corners(fast.triangle as usize).unwrap();
            let [a, b, c] = fast.barycentric;
            prop_assert!(a >= 0.0 && b >= 0.0 && c >= 0.0 && (a + b + c - 1.0).abs() <= 4e-16);
            let again = a * corners[0] + b * corners[1] + c * corners[2];
            prop_assert!(again.distance(fast.point) <= 4e-15, "{} {}", again, fast.point);
        }
    }

    /// No sampled point of the triangle lies nearer than the one that is found, needles included.
    #[test]
    fn nothing_lies_nearer(a in point(), b in point(), c in point(), query in point(), flat in 0..3_u8, thin in 0..17_i32) {
        let c = match flat {
            0 => c,
            1 => a + 0.3 * (b - a) + 10.0_f64.powi(-thin) * (c - a),
            _ => a + 0.3 * (b - a),
        };
        let mesh = TriangleMesh { positions: vec![a, b, c], normals: vec![], triangles: vec![[0, 1, 2]] };
        let found = mesh.closest(query).unwrap();
        for i in 0..=24 {
            for j in 0..=24 - i {
                let (u, v) = (f64::from(i) / 24.0, f64::from(j) / 24.0);
                let sample = a + u * (b - a) + v * (c - a);
                prop_assert!(found.distance <= sample.distance(query) + 4e-15, "{} {}", u, v);
            }
        }
        // A point of the triangle has distance 0, up to the 32u of its size that are promised.
        let on = a + 0.3 * (b - a) + 0.2 * (c - a);
        let size = (b - a).length().max((c - a).length()).max(2.0);
        let distance = mesh.closest(on).unwrap().distance;
        prop_assert!(distance <= 32.0 * 1.2e-16 * size, "{} of {}", distance, size);
    }
}
