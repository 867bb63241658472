//! Meshing of solids on one thread: the unit ball, one rational hexahedron of degrees (2, 2, 3), its surface, the cells in it, and a
//! slice; and a cubic tetrahedron that bends little.
//!
//! Run with `cargo bench -p casteljau-benches --bench mesh_solids`; per triangle or cell.
//!
//! | what | measured |
//! | --- | --- |
//! | surface of the ball, tolerance 1e-2 and 1e-3 | 2.0 and 1.4 µs a triangle |
//! | own cells of the ball, resolution 10 and 40 | 12 and 0.61 µs a cell: the bounds take 11 ms |
//! | tetrahedra of the ball, resolution 10 and 40 | 2.3 and 0.15 µs a cell |
//! | tetrahedra of a cubic tetrahedron, resolution 40 | 0.17 µs a cell |
//! | slice of the ball, tolerance 1e-2 and 2e-3 | 5.9 and 4.2 µs a triangle |
//!
//! Figures of one core of an AMD EPYC (Zen 4).

#![allow(clippy::unwrap_used)]

use std::hint::black_box;

use casteljau::geom::glam::{DVec3, dvec3};
use casteljau::shape::RationalCurve;
use casteljau::tess::{
    CellKind, SectionOptions, SharedFaces, TessellationOptions, VolumeOptions, no_progress, slice,
    tessellate_solids, volume_mesh,
};
use casteljau_solid::{RationalHexahedron, Tetrahedron};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn ball() -> RationalHexahedron {
    let half = [-DVec3::Z, dvec3(2.0, 0.0, -1.0), dvec3(2.0, 0.0, 1.0), DVec3::Z];
    let meridian = RationalCurve::new(&half, &[1.0, 1.0 / 3.0, 1.0 / 3.0, 1.0]).unwrap();
    RationalHexahedron::rotational(&meridian).unwrap()
}

fn solids(c: &mut Criterion) {
    let ball = ball();
    let corners = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO];
    let tetrahedron = Tetrahedron::new(1, corners).unwrap().elevated(2).unwrap();
    let mut group = c.benchmark_group("mesh solids");
    group.sample_size(10);
    for tolerance in [1e-2, 1e-3] {
        let options = TessellationOptions::tolerance(tolerance);
        let mesh =
            || tessellate_solids(&[&ball], SharedFaces::Dropped, &options, &mut no_progress).unwrap().0;
        group.throughput(Throughput::Elements(mesh().triangles.len() as u64));
        group.bench_function(format!("surface of the ball, tolerance {tolerance}"), |b| {
            b.iter(|| black_box(mesh()))
        });
    }
    for (name, cells) in [("own cells", CellKind::Own), ("tetrahedra", CellKind::Tetrahedra)] {
        for resolution in [10, 40] {
            let options = VolumeOptions { cells, ..VolumeOptions::resolution(resolution) };
            let mesh = || volume_mesh(&[&ball], &options, &mut no_progress).unwrap().0;
            group.throughput(Throughput::Elements(mesh().cells.len() as u64));
            group.bench_function(format!("{name} of the ball, resolution {resolution}"), |b| {
                b.iter(|| black_box(mesh()))
            });
        }
    }
    let options = VolumeOptions::resolution(40);
    let mesh = || volume_mesh(&[&tetrahedron], &options, &mut no_progress).unwrap().0;
    group.throughput(Throughput::Elements(mesh().cells.len() as u64));
    group.bench_function("tetrahedron, resolution 40", |b| b.iter(|| black_box(mesh())));
    for tolerance in [1e-2, 2e-3] {
        let options = SectionOptions::tolerance(tolerance);
        let mesh = || slice(&[&ball], DVec3::ONE, 0.3, &options, &mut no_progress).unwrap().0;
        group.throughput(Throughput::Elements(mesh().triangles.len() as u64));
        group.bench_function(format!("slice of the ball, tolerance {tolerance}"), |b| {
            b.iter(|| black_box(mesh()))
        });
    }
    group.finish();
}

criterion_group!(benches, solids);
criterion_main!(benches);
