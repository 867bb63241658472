//! Audits, boundary loops and welding, on meshes whose answers are known and against plain counting.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::collections::{BTreeMap, BTreeSet};

use casteljau_mesh::glam::{DVec3, dvec3};
use casteljau_mesh::{CountingSink, MeshError, MeshSink, TriangleMesh};
use proptest::prelude::*;

fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> TriangleMesh {
    TriangleMesh {
        positions: positions.iter().map(|&p| p.into()).collect(),
        normals: Vec::new(),
        triangles: triangles.to_vec(),
    }
}

/// A grid of m × n squares, each halved, in the unit square.
fn grid(m: u32, n: u32) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for j in 0..=n {
        for i in 0..=m {
            mesh.positions.push(dvec3(f64::from(i) / f64::from(m), f64::from(j) / f64::from(n), 0.0));
        }
    }
    let at = |i: u32, j: u32| j * (m + 1) + i;
    for j in 0..n {
        for i in 0..m {
            mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh
}

/// A torus of m × n squares, each halved.
fn torus(m: u32, n: u32) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for j in 0..n {
        for i in 0..m {
            let (u, v) = (
                std::f64::consts::TAU * f64::from(i) / f64::from(m),
                std::f64::consts::TAU * f64::from(j) / f64::from(n),
            );
            let radius = 3.0 + v.cos();
            mesh.positions.push(dvec3(radius * u.cos(), radius * u.sin(), v.sin()));
        }
    }
    let at = |i: u32, j: u32| (j % n) * m + i % m;
    for j in 0..n {
        for i in 0..m {
            mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh
}

const CORNERS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

#[test]
fn closed_surfaces() {
    let audit = mesh(&CORNERS, &TETRAHEDRON).audit().unwrap();
    assert!(audit.closed && audit.manifold && audit.oriented);
    assert_eq!((audit.euler_characteristic, audit.components, audit.edges), (2, 1, 6));
    let audit = torus(30, 20).audit().unwrap();
    assert!(audit.closed && audit.manifold && audit.oriented);
    assert_eq!((audit.euler_characteristic, audit.components, audit.boundary_edges), (0, 1, 0));
    assert_eq!(torus(5, 4).boundary_loops().unwrap(), Vec::<Vec<u32>>::new());
    let mut two = mesh(&CORNERS, &TETRAHEDRON);
    two.append(&torus(7, 5)).unwrap();
    let audit = two.audit().unwrap();
    assert_eq!((audit.euler_characteristic, audit.components), (2, 2));
}

#[test]
fn open_surfaces_and_their_loops() {
    let square = grid(4, 3);
    let audit = square.audit().unwrap();
    assert!(!audit.closed && audit.manifold && audit.oriented);
    assert_eq!((audit.euler_characteristic, audit.boundary_edges), (1, 14));
    assert_eq!(square.boundary_loops().unwrap(), [vec![0, 1, 2, 3, 4, 9, 14, 19, 18, 17, 16, 15, 10, 5]]);
    // A hole of one square: a second loop, which runs the other way.
    let mut ring = grid(3, 3);
    ring.triangles.retain(|t| !t.iter().all(|v| [5, 6, 9, 10].contains(v)));
    assert_eq!(ring.triangles.len(), 16);
    assert_eq!(ring.audit().unwrap().euler_characteristic, 0);
    assert_eq!(
        ring.boundary_loops().unwrap(),
        [vec![0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4], vec![5, 9, 10, 6]]
    );
    // Turned over, every loop runs the other way.
    ring.flip();
    assert_eq!(ring.boundary_loops().unwrap()[1], [5, 6, 10, 9]);
}

#[test]
fn fans_that_touch_in_a_vertex() {
    // Two triangles that share vertex 0 only.
    let bow = mesh(
        &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [-1.0, -1.0, 0.0]],
        &[[0, 1, 2], [0, 3, 4]],
    );
    let audit = bow.audit().unwrap();
    assert!(audit.edge_manifold && !audit.vertex_manifold && !audit.manifold);
    assert_eq!((audit.non_manifold_vertices, audit.components), (1, 1));
    assert_eq!(bow.boundary_loops().unwrap(), [[0, 1, 2], [0, 3, 4]]);
}

#[test]
fn edges_of_three_triangles() {
    let fin = mesh(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]],
        &[[0, 1, 2], [1, 0, 3], [0, 1, 4]],
    );
    let audit = fin.audit().unwrap();
    assert!(!audit.edge_manifold && !audit.manifold && !audit.oriented);
    assert_eq!((audit.non_manifold_edges, audit.misoriented_edges), (1, 1));
    assert_eq!(fin.boundary_loops(), Err(MeshError::NonManifoldEdge { from: 0, to: 1, triangles: 3 }));
}

#[test]
fn orientation() {
    let mut turned = mesh(&CORNERS, &TETRAHEDRON);
    turned.triangles[2].swap(0, 1);
    let audit = turned.audit().unwrap();
    assert!(audit.closed && audit.manifold && !audit.oriented);
    assert_eq!(audit.misoriented_edges, 3);
    // Two loops are still found on a surface that is not oriented.
    let mut square = grid(3, 2);
    square.triangles[5].swap(0, 1);
    assert_eq!(square.boundary_loops().unwrap().concat().len(), 10);
}

#[test]
fn shape_of_triangles() {
    let audit = mesh(&[[0.0; 3], [3.0, 0.0, 0.0], [0.0, 3.0_f64.sqrt(), 0.0]], &[[0, 1, 2]]).audit().unwrap();
    assert!((audit.min_angle.unwrap().to_degrees() - 30.0).abs() < 1e-13);
    assert!((audit.max_angle.unwrap().to_degrees() - 90.0).abs() < 1e-13);
    // The same shape at any size; the least normal square root of f64 is 1.5e-154.
    for size in [1e-200, 1e-100, 1e-6, 1e6, 1e70] {
        let scaled =
            mesh(&[[0.0; 3], [3.0 * size, 0.0, 0.0], [0.0, size, 0.0]], &[[0, 1, 2]]).audit().unwrap();
        assert_eq!(scaled.degenerate, 0);
        assert!((scaled.min_angle.unwrap() - (1.0_f64 / 3.0).atan()).abs() < 1e-15, "{size}");
    }
    // Repeated vertex, equal positions, points on a line, points on a line to rounding, and one thin but good triangle.
    let third = 1.0 / 3.0;
    let points = [
        [0.0; 3],
        [0.0; 3],
        [1.0, 1.0, 1.0],
        [third, third, third],
        [third, third, third + f64::EPSILON / 4.0],
        [third, third, third + 1e-12],
    ];
    let audit = mesh(&points, &[[0, 0, 2], [0, 1, 2], [0, 2, 3], [0, 2, 4], [0, 2, 5]]).audit().unwrap();
    assert_eq!(audit.degenerate, 4);
    assert!(audit.min_angle.unwrap() > 4e-13);
    assert_eq!(mesh(&points, &[[0, 0, 2]]).audit().unwrap().min_angle, None);
}

#[test]
fn empty_and_broken_meshes() {
    let empty = TriangleMesh::default();
    let audit = empty.audit().unwrap();
    assert!(!audit.closed && audit.manifold && audit.oriented);
    assert_eq!((audit.components, audit.euler_characteristic, audit.min_angle), (0, 0, None));
    assert!(empty.boundary_loops().unwrap().is_empty());
    assert_eq!(empty.welded().unwrap().mesh, empty);
    assert_eq!(empty.bounding_box(), None);
    let loose = mesh(&CORNERS, &[[0, 1, 2]]);
    assert_eq!(loose.audit().unwrap().unreferenced_vertices, 1);

    let far = mesh(&CORNERS, &[[0, 1, 2], [0, 1, u32::MAX]]);
    let expected = MeshError::IndexOutOfRange { triangle: 1, index: u32::MAX, vertices: 4 };
    assert_eq!(far.audit(), Err(expected.clone()));
    assert_eq!(far.boundary_loops(), Err(expected.clone()));
    assert_eq!(far.welded(), Err(expected.clone()));
    assert_eq!(far.area(), Err(expected.clone()));
    assert_eq!(loose.clone().append(&far), Err(expected));
    assert_eq!(far.corners(1), None);

    let mut nan = mesh(&CORNERS, &TETRAHEDRON);
    nan.positions[2].y = f64::NAN;
    assert!(matches!(nan.audit(), Err(MeshError::NonFinite { what: "position", index: 2, .. })));
    assert!(matches!(nan.welded(), Err(MeshError::NonFinite { .. })));
    assert_eq!(nan.bounding_box(), None);
    let mut odd = mesh(&CORNERS, &TETRAHEDRON);
    odd.normals = vec![DVec3::Z; 3];
    assert_eq!(odd.validate(), Err(MeshError::NormalCount { vertex: 3, normals: 3, vertices: 4 }));
    let before = odd.clone();
    assert!(odd.append(&loose).is_err());
    assert_eq!(odd, before);
}

#[test]
fn sinks_refuse_the_same() {
    let mut built = TriangleMesh::default();
    let mut counted = CountingSink::default();
    let sinks: [&mut dyn MeshSink; 2] = [&mut built, &mut counted];
    for sink in sinks {
        assert_eq!(sink.vertex(DVec3::ZERO, Some(DVec3::Z)), Ok(0));
        assert!(matches!(
            sink.vertex(DVec3::INFINITY, Some(DVec3::Z)),
            Err(MeshError::NonFinite { index: 1, .. })
        ));
        assert!(matches!(
            sink.vertex(DVec3::X, Some(DVec3::NAN)),
            Err(MeshError::NonFinite { what: "normal", .. })
        ));
        assert_eq!(sink.vertex(DVec3::X, Some(DVec3::Z)), Ok(1));
        let error = sink.triangle([0, 1, 2]).unwrap_err();
        assert_eq!(error, MeshError::IndexOutOfRange { triangle: 0, index: 2, vertices: 2 });
        assert_eq!(sink.vertex(DVec3::Y, Some(DVec3::Z)), Ok(2));
        sink.triangle([0, 1, 2]).unwrap();
    }
    assert_eq!((counted.vertices(), counted.triangles()), (3, 1));
    built.validate().unwrap();
    assert_eq!(
        built.vertex(DVec3::ONE, None),
        Err(MeshError::NormalCount { vertex: 3, normals: 3, vertices: 4 })
    );
    let mut full = CountingSink::with_limits(usize::MAX, 0);
    full.vertex(DVec3::ZERO, None).unwrap();
    assert_eq!(full.triangle([0, 0, 0]), Err(MeshError::TooManyTriangles { limit: 0 }));
}

#[test]
fn welding_keeps_what_merely_lies_near() {
    let next = f64::from_bits(1.0_f64.to_bits() + 1);
    let soup = TriangleMesh {
        positions: vec![dvec3(1.0, 0.0, -0.0), dvec3(next, 0.0, 0.0), DVec3::Y, dvec3(1.0, -0.0, 0.0)],
        normals: vec![DVec3::X, DVec3::Z, DVec3::Z, DVec3::Y],
        triangles: vec![[0, 1, 2], [3, 2, 1]],
    };
    let welded = soup.welded().unwrap();
    assert_eq!(welded.map, [0, 1, 2, 0]);
    assert_eq!(welded.mesh.triangles, [[0, 1, 2], [0, 2, 1]]);
    assert!((welded.mesh.normals[0] - dvec3(0.5, 0.5, 0.0).normalize()).length() < 1e-15);
    assert_eq!(welded.mesh.normals[1..], soup.normals[1..3]);
    // Opposite normals cancel: the first one stays.
    let opposite = TriangleMesh { normals: vec![DVec3::X, DVec3::Z, DVec3::Z, -DVec3::X], ..soup };
    assert_eq!(opposite.welded().unwrap().mesh.normals[0], DVec3::X);
}

/// Counting by plain maps, from the definitions.
fn plain_edges(mesh: &TriangleMesh) -> BTreeMap<(u32, u32), Vec<bool>> {
    let mut edges: BTreeMap<(u32, u32), Vec<bool>> = BTreeMap::new();
    for &[a, b, c] in mesh.triangles.iter().filter(|[a, b, c]| a != b && b != c && c != a) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            edges.entry((from.min(to), from.max(to))).or_default().push(from < to);
        }
    }
    edges
}

proptest! {
    /// Random triangles on a few vertices: every non-manifold configuration there is.
    #[test]
    fn audit_agrees_with_plain_counting(
        triangles in prop::collection::vec([0..7_u32, 0..7_u32, 0..7_u32], 0..12),
        points in prop::collection::vec([-2..3_i8, -2..3_i8, -2..3_i8], 7),
    ) {
        let positions: Vec<[f64; 3]> = points.iter().map(|p| p.map(f64::from)).collect();
        let mesh = mesh(&positions, &triangles);
        let audit = mesh.audit().unwrap();
        let edges = plain_edges(&mesh);
        prop_assert_eq!(audit.edges, edges.len());
        prop_assert_eq!(audit.boundary_edges, edges.values().filter(|e| e.len() == 1).count());
        prop_assert_eq!(audit.non_manifold_edges, edges.values().filter(|e| e.len() > 2).count());
        let unbalanced = |e: &&Vec<bool>| e.len() > 1 && 2 * e.iter().filter(|&&f| f).count() != e.len();
        prop_assert_eq!(audit.misoriented_edges, edges.values().filter(unbalanced).count());
        // Fans: triangles about each vertex, joined through common neighbours until nothing changes.
        let good: Vec<[u32; 3]> =
            mesh.triangles.iter().copied().filter(|[a, b, c]| a != b && b != c && c != a).collect();
        let mut pinched = 0;
        for vertex in 0..7 {
            let mut fans: Vec<BTreeSet<u32>> = Vec::new();
            for t in good.iter().filter(|t| t.contains(&vertex)) {
                let mut fan: BTreeSet<u32> = t.iter().copied().filter(|&v| v != vertex).collect();
                fans.retain(|other| {
                    let joined = !fan.is_disjoint(other);
                    if joined {
                        fan.extend(other);
                    }
                    !joined
                });
                fans.push(fan);
            }
            pinched += usize::from(fans.len() > 1);
        }
        prop_assert_eq!(audit.non_manifold_vertices, pinched);
        // Pieces: the same with all vertices.
        let mut pieces: Vec<BTreeSet<u32>> = Vec::new();
        for t in &good {
            let mut piece: BTreeSet<u32> = t.iter().copied().collect();
            pieces.retain(|other| {
                let joined = !piece.is_disjoint(other);
                if joined {
                    piece.extend(other);
                }
                !joined
            });
            pieces.push(piece);
        }
        prop_assert_eq!(audit.components, pieces.len());
        let vertices: usize = pieces.iter().map(BTreeSet::len).sum();
        prop_assert_eq!(audit.euler_characteristic, vertices as i64 - edges.len() as i64 + good.len() as i64);
        // Exact arithmetic on small integers tells degenerate triangles.
        let flat = |t: &&[u32; 3]| {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            (b - a).cross(c - a) == DVec3::ZERO
        };
        prop_assert_eq!(audit.degenerate, mesh.triangles.iter().filter(flat).count());

        // Every boundary edge lies in exactly one loop, every loop runs along boundary edges.
        match mesh.boundary_loops() {
            Err(MeshError::NonManifoldEdge { from, to, triangles }) => {
                prop_assert_eq!(edges[&(from, to)].len(), triangles);
                prop_assert!(triangles > 2);
            }
            Err(error) => prop_assert!(false, "{}", error),
            Ok(loops) => {
                let mut walked: Vec<(u32, u32)> = Vec::new();
                for chain in &loops {
                    for (place, &from) in chain.iter().enumerate() {
                        let to = chain[(place + 1) % chain.len()];
                        walked.push((from.min(to), from.max(to)));
                    }
                }
                walked.sort_unstable();
                let boundary: Vec<(u32, u32)> =
                    edges.iter().filter(|(_, e)| e.len() == 1).map(|(&ends, _)| ends).collect();
                prop_assert_eq!(walked, boundary);
            }
        }
    }

    /// Taking a mesh apart into a soup and welding it gives it back, up to the order of the vertices.
    #[test]
    fn welding_undoes_taking_apart(m in 1..6_u32, n in 1..6_u32) {
        let whole = grid(m, n);
        let mut soup = TriangleMesh::default();
        for index in 0..whole.triangles.len() {
            let start = soup.positions.len() as u32;
            soup.positions.extend(whole.corners(index).unwrap());
            soup.triangles.push([start, start + 1, start + 2]);
        }
        let welded = soup.welded().unwrap();
        prop_assert_eq!(welded.mesh.positions.len(), whole.positions.len());
        for (index, &target) in welded.map.iter().enumerate() {
            prop_assert_eq!(soup.positions[index], welded.mesh.positions[target as usize]);
        }
        prop_assert_eq!(welded.mesh.audit().unwrap(), whole.audit().unwrap());
        prop_assert_eq!(welded.mesh.clone(), welded.mesh.welded().unwrap().mesh);
    }
}
