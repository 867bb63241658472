//! Meshes of cells: what the audit finds, degenerate cells, volumes, boundaries.
#![allow(missing_docs, clippy::unwrap_used)]

use casteljau_mesh::{Cell, VolumeMesh, glam::DVec3, glam::dvec3};
use proptest::prelude::*;

/// A row of boxes along x, n of them, each the next one's neighbour.
fn row(n: u32) -> VolumeMesh {
    let at = |i: u32, j: u32, k: u32| 4 * i + 2 * j + k;
    let positions =
        (0..=n).flat_map(|i| (0..4).map(move |c| dvec3(f64::from(i), f64::from(c >> 1), f64::from(c & 1))));
    let cell = |i: u32| {
        Cell::Hexahedron([
            at(i, 0, 0),
            at(i + 1, 0, 0),
            at(i + 1, 1, 0),
            at(i, 1, 0),
            at(i, 0, 1),
            at(i + 1, 0, 1),
            at(i + 1, 1, 1),
            at(i, 1, 1),
        ])
    };
    VolumeMesh { positions: positions.collect(), cells: (0..n).map(cell).collect() }
}

#[test]
fn a_row_of_boxes_conforms() {
    for mesh in [row(3), row(3).tetrahedral().unwrap()] {
        let audit = mesh.audit().unwrap();
        assert!(audit.is_valid() && audit.boundary.manifold, "{audit:?}");
        assert_eq!((audit.folded, audit.repeated, audit.unreferenced_vertices), (0, 0, 0));
        assert_eq!(mesh.volume().unwrap(), 3.0);
        let boundary = mesh.boundary().unwrap();
        assert_eq!((boundary.triangles.len(), boundary.signed_volume().unwrap()), (28, 3.0));
    }
    let audit = row(3).audit().unwrap();
    assert_eq!((audit.cells, audit.interior_faces, audit.boundary_faces), ([0, 0, 0, 3], 2, 14));
    assert_eq!(audit.least_volume, Some(1.0));
}

#[test]
fn the_audit_finds_what_is_wrong() {
    // One box inside out.
    let mut mesh = row(2);
    mesh.cells[1] = mesh.cells[1].flipped();
    let audit = mesh.audit().unwrap();
    assert_eq!((audit.bad_faces, audit.not_positive, audit.folded), (1, 1, 1));
    assert_eq!(mesh.not_positive(), 1);
    // One box twice.
    let mut mesh = row(2);
    mesh.cells.push(mesh.cells[0]);
    assert!(mesh.audit().unwrap().bad_faces > 0);
    // A quad beside two triangles.
    let mut mesh = row(2);
    let cut = mesh.cells.remove(1);
    mesh.cells.extend(cut.tetrahedra().map(Cell::Tetrahedron));
    let audit = mesh.audit().unwrap();
    assert!(audit.bad_faces == 0 && !audit.boundary.manifold, "{audit:?}");
    // A flat tetrahedron, and a hexahedron that folds at one corner and still has a volume.
    let flat = VolumeMesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, dvec3(0.3, 0.3, 1e-17)],
        cells: vec![Cell::Tetrahedron([0, 1, 2, 3])],
    };
    assert_eq!(flat.audit().unwrap().not_positive, 1);
    let mut folded = row(1);
    folded.positions[0] = dvec3(0.9, 0.9, 0.9);
    let audit = folded.audit().unwrap();
    assert_eq!((audit.not_positive, audit.folded), (0, 1));
}

#[test]
fn degenerate_cells_become_what_they_are() {
    let h = |v: [u32; 8]| Cell::Hexahedron(v).reduced();
    // A face that is an edge, and one that is a point, in all the places of a box.
    let mesh = row(1);
    let Cell::Hexahedron(all) = mesh.cells[0] else { return };
    let faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
    for face in faces {
        let mut point = all;
        face.iter().for_each(|&place| point[place] = all[face[0]]);
        let pyramid = VolumeMesh { cells: vec![h(point).unwrap()], ..mesh.clone() };
        assert!(matches!(pyramid.cells[0], Cell::Pyramid(_)));
        assert!((pyramid.volume().unwrap() - 1.0 / 3.0).abs() < 1e-15 && pyramid.audit().unwrap().is_valid());
        for turn in 0..2 {
            let mut edge = all;
            edge[face[turn + 1]] = all[face[turn]];
            edge[face[turn + 2]] = all[face[(turn + 3) % 4]];
            let wedge = VolumeMesh { cells: vec![h(edge).unwrap()], ..mesh.clone() };
            assert!(matches!(wedge.cells[0], Cell::Wedge(_)));
            assert!((wedge.volume().unwrap() - 0.5).abs() < 1e-15 && wedge.audit().unwrap().is_valid());
            assert_eq!(wedge.tetrahedral().unwrap().cells.len(), 3);
        }
    }
    // One edge that is a point: no kind has such faces, and the cell stays.
    let mut edge = all;
    edge[1] = all[0];
    let kept = VolumeMesh { cells: vec![h(edge).unwrap()], ..mesh };
    let audit = kept.audit().unwrap();
    assert_eq!((audit.cells, audit.repeated), ([0, 0, 0, 1], 1));
    assert!(audit.is_valid() && kept.tetrahedral().unwrap().audit().unwrap().is_valid());
    // Opposite faces that are one: nothing between them.
    assert_eq!(h([0, 1, 2, 3, 0, 1, 2, 3]), None);
}

proptest! {
    /// However the vertices are numbered, the cut conforms and keeps the volume.
    #[test]
    fn cuts_conform_whatever_the_numbers(order in Just((0..16u32).collect::<Vec<_>>()).prop_shuffle()) {
        let mesh = row(3);
        let mut positions = vec![DVec3::ZERO; 16];
        for (&place, &p) in order.iter().zip(&mesh.positions) {
            positions[place as usize] = p;
        }
        let renamed = mesh.cells.iter().map(|cell| match *cell {
            Cell::Hexahedron(v) => Cell::Hexahedron(v.map(|v| order[v as usize])),
            other => other,
        });
        let cut = VolumeMesh { positions, cells: renamed.collect() }.tetrahedral().unwrap();
        let audit = cut.audit().unwrap();
        prop_assert!(audit.is_valid() && audit.boundary.manifold);
        prop_assert!((cut.volume().unwrap() - 3.0).abs() < 1e-14);
    }
}
