//! What is asked for: limits, nonsense, progress, sinks.
#![allow(missing_docs, clippy::unwrap_used)]

mod common;

use std::ops::ControlFlow;

use casteljau_gb::ConcavePatch;
use casteljau_mesh::{CountingSink, MeshError};
use casteljau_tess::{Density, TessError, TessellationOptions, no_progress, tessellate, tessellate_into};
use common::{cube, l_polygon, patch_over, pillow, u_polygon};

fn one(patch: &ConcavePatch, options: TessellationOptions) -> Result<usize, TessError> {
    Ok(tessellate(std::slice::from_ref(patch), &options, &mut no_progress)?.0.triangles.len())
}

#[test]
fn nonsense_is_refused() {
    let patch = patch_over(l_polygon());
    for value in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, 1e-16, f64::MIN_POSITIVE] {
        let refused = one(&patch, TessellationOptions::tolerance(value)).unwrap_err();
        assert!(matches!(refused, TessError::Tolerance { .. }), "{value}: {refused}");
    }
    let refused = one(&patch, TessellationOptions::resolution(0)).unwrap_err();
    assert_eq!(refused, TessError::Resolution { value: 0 });
    assert_eq!(
        tessellate::<ConcavePatch>(&[], &TessellationOptions::resolution(1), &mut no_progress).unwrap_err(),
        TessError::Empty
    );
}

#[test]
fn limits_are_kept_and_found_out_early() {
    let patch = patch_over(l_polygon());
    let start = std::time::Instant::now();
    let dense = [
        TessellationOptions::resolution(1_000_000_000),
        TessellationOptions::resolution(usize::MAX),
        TessellationOptions::resolution(500_000),
        TessellationOptions::tolerance(1e-13),
        TessellationOptions::tolerance(1e-10),
    ];
    for options in dense {
        let refused = one(&patch, options).unwrap_err();
        assert!(matches!(refused, TessError::TooManyVertices { .. }), "{options:?}: {refused}");
    }
    assert!(start.elapsed().as_secs() < 20);
    for density in [Density::Resolution(20), Density::Tolerance(1e-3)] {
        let all =
            tessellate(std::slice::from_ref(&patch), &TessellationOptions::new(density), &mut no_progress);
        let needed = all.unwrap().0.positions.len();
        for (max_vertices, fits) in
            [(needed, true), (needed - 1, false), (needed / 2, false), (5, false), (0, false)]
        {
            let options = TessellationOptions { max_vertices, ..TessellationOptions::new(density) };
            match tessellate(std::slice::from_ref(&patch), &options, &mut no_progress) {
                Ok((mesh, _)) => assert!(mesh.positions.len() <= max_vertices, "{density:?}"),
                Err(TessError::TooManyVertices { limit, .. }) => {
                    assert!(!fits && limit == max_vertices, "{density:?} {max_vertices}");
                }
                Err(other) => panic!("{other}"),
            }
        }
    }
}

#[test]
fn a_tolerance_larger_than_the_model_gives_few_triangles() {
    let patch = patch_over(u_polygon());
    let count = one(&patch, TessellationOptions::tolerance(1e6)).unwrap();
    assert!((6..60).contains(&count), "{count}");
}

#[test]
fn progress_never_goes_back_and_stops_where_it_is_told_to() {
    let body = cube();
    let options = TessellationOptions::tolerance(3e-4);
    let mut told = Vec::new();
    tessellate(&body, &options, &mut |f| {
        told.push(f);
        ControlFlow::Continue(())
    })
    .unwrap();
    assert!(told.len() > 20 && told.windows(2).all(|w| w[0] <= w[1]), "{told:?}");
    assert_eq!((told[0], told[told.len() - 1]), (0.0, 1.0));
    // At every call once.
    for stop in (0..told.len()).step_by(7) {
        let mut calls = 0;
        let result = tessellate(&body, &options, &mut |_| {
            calls += 1;
            if calls > stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!(result.unwrap_err(), TessError::Cancelled { fraction: told[stop] });
        assert_eq!(calls, stop + 1);
    }
}

#[test]
fn the_same_input_gives_the_same_bits() {
    for options in [TessellationOptions::resolution(21), TessellationOptions::tolerance(5e-4)] {
        let body = pillow(&l_polygon());
        let first = tessellate(&body, &options, &mut no_progress).unwrap();
        let again = tessellate(&body, &options, &mut no_progress).unwrap();
        assert_eq!(first, again);
    }
}

#[test]
fn scaled_models_get_scaled_meshes() {
    use casteljau_gb::glam::DVec3;
    use common::{lifted, ribbons_over};
    let count = |scale: f64| {
        let ribbons = ribbons_over(&l_polygon(), &|p| lifted(p) * scale);
        let patch = ConcavePatch::builder(ribbons).domain(l_polygon()).build().unwrap();
        let options = TessellationOptions::tolerance(1e-3 * scale);
        let (mesh, _) = tessellate(&[patch], &options, &mut no_progress).unwrap();
        (mesh.triangles, mesh.positions.iter().map(|p| *p / scale).collect::<Vec<DVec3>>())
    };
    let plain = count(1.0);
    // Powers of two change no digit.
    for scale in [2f64.powi(20), 2f64.powi(-20)] {
        assert_eq!(plain, count(scale), "{scale}");
    }
}

#[test]
fn sinks_count_and_refuse() {
    let patch = patch_over(l_polygon());
    let options = TessellationOptions { normals: false, ..TessellationOptions::resolution(10) };
    let mut sink = CountingSink::default();
    let report =
        tessellate_into(std::slice::from_ref(&patch), &options, &mut sink, &mut no_progress).unwrap();
    assert_eq!((sink.vertices(), sink.triangles()), (report.vertices, report.triangles));
    let (mesh, _) = tessellate(std::slice::from_ref(&patch), &options, &mut no_progress).unwrap();
    assert!(mesh.normals.is_empty() && mesh.positions.len() == report.vertices);
    let mut small = CountingSink::with_limits(10, 10);
    let refused = tessellate_into(&[patch], &options, &mut small, &mut no_progress).unwrap_err();
    assert_eq!(refused, TessError::Sink(MeshError::TooManyVertices { limit: 10 }));
}
