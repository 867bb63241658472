//! The published program's polygons, where it gives one by the plain rules.

use std::path::PathBuf;

use casteljau_domain::glam::{DVec2, DVec3, dvec2};
use casteljau_domain::layout::{self, LayoutOptions};
use serde_json::Value;

use crate::brute::{assert_valid, misfit};

/// A ribbon's first two rows.
struct Ribbon {
    side: Vec<DVec3>,
    inner: Vec<DVec3>,
}

fn shared() -> Option<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let present = folder.join("goldens/gb/domain").is_dir() && folder.join("models").is_dir();
    if !present {
        println!("goldens are absent, nothing compared");
    }
    present.then_some(folder)
}

/// Smallest reader of `.cgb` that does: four header numbers, n, centre, then d, l and the rows of each
/// ribbon.
fn read(text: &str) -> Vec<Ribbon> {
    let numbers: Vec<f64> = text.split_whitespace().map(|w| w.parse().unwrap()).collect();
    let mut at = 8;
    let ribbon = |_| {
        let (degree, layers) = (numbers[at] as usize, numbers[at + 1] as usize);
        let rows = &numbers[at + 2..][..3 * layers * (degree + 1)];
        at += 2 + rows.len();
        let points: Vec<DVec3> = rows.chunks(3).map(DVec3::from_slice).collect();
        Ribbon { side: points[..=degree].to_vec(), inner: points[degree + 1..][..=degree].to_vec() }
    };
    (0..numbers[4] as usize).map(ribbon).collect()
}

/// Arc length by the published program's single four-point Gauss rule, with its rounded nodes and weights.
fn length_of(points: &[DVec3]) -> f64 {
    let speed = |x: f64| {
        let t = 0.5 * (x + 1.0);
        let mut d: Vec<DVec3> =
            points.windows(2).map(|w| (w[1] - w[0]) * (points.len() - 1) as f64).collect();
        while d.len() > 1 {
            d = d.windows(2).map(|w| w[0] * (1.0 - t) + w[1] * t).collect();
        }
        d[0].length()
    };
    let rule = [(0.861136312, 0.347854845), (0.339981044, 0.652145155)];
    rule.iter().map(|(x, w)| w * (speed(*x) + speed(-*x))).sum::<f64>() * 0.5
}

/// Turning angle where `before` meets `after`; concave where the end tangent points along the cross
/// direction.
fn turning_of(before: &Ribbon, after: &Ribbon) -> f64 {
    let end = before.side.len() - 1;
    let (incoming, outgoing) = (before.side[end] - before.side[end - 1], after.side[1] - after.side[0]);
    let angle = incoming.cross(outgoing).length().atan2(incoming.dot(outgoing));
    if incoming.dot(after.inner[0] - after.side[0]) > 0.0 { -angle } else { angle }
}

struct Loop {
    lengths: Vec<f64>,
    turning: Vec<f64>,
    corners: Vec<DVec3>,
}

fn load(folder: &std::path::Path, model: &str) -> Option<Loop> {
    let ribbons = read(&std::fs::read_to_string(folder.join("models").join(model)).ok()?);
    let n = ribbons.len();
    Some(Loop {
        lengths: ribbons.iter().map(|r| length_of(&r.side)).collect(),
        turning: (0..n).map(|i| turning_of(&ribbons[i], &ribbons[(i + 1) % n])).collect(),
        corners: ribbons.iter().map(|r| r.side[r.side.len() - 1]).collect(),
    })
}

fn cases(folder: &std::path::Path) -> Vec<Value> {
    let text = std::fs::read_to_string(folder.join("goldens/gb/domain/domain_generation.json")).unwrap();
    let file: Value = serde_json::from_str(&text).unwrap();
    file["cases"].as_array().unwrap().clone()
}

fn polygon_of(case: &Value) -> Option<Vec<DVec2>> {
    let pair = |p: &Value| dvec2(p[0].as_f64().unwrap(), p[1].as_f64().unwrap());
    Some(case["domain"].as_array()?.iter().map(pair).collect())
}

/// The published normalisation undone and ours done: only a shift and a scale, no rotation.
fn shifted(p: &[DVec2]) -> Vec<DVec2> {
    let mean = p.iter().sum::<DVec2>() / p.len() as f64;
    let radius = p.iter().map(|q| q.distance(mean)).fold(0.0, f64::max);
    p.iter().map(|q| (*q - mean) / radius).collect()
}

#[test]
fn plain_heuristic_and_projection_reproduce_the_published_polygons() {
    let Some(folder) = shared() else { return };
    let (mut heuristics, mut projections) = (0, 0);
    for case in cases(&folder) {
        let (Some(outline), Some(model)) =
            (load(&folder, case["model"].as_str().unwrap()), polygon_of(&case))
        else {
            continue;
        };
        let name = format!("{} {} {}", case["model"], case["kind"], case["tolerance"]);
        if case["kind"] == "similarity" && case["iterations"] == 0 {
            let ours =
                layout::heuristic(&outline.lengths, &outline.turning, &LayoutOptions::default()).unwrap();
            let worst = ours
                .polygon
                .vertices()
                .iter()
                .zip(shifted(&model))
                .map(|(a, b)| a.distance(b))
                .fold(0.0, f64::max);
            assert!(!ours.repaired && worst < 1e-13, "{name}: {worst:e}");
            heuristics += 1;
        } else if case["kind"] == "projection" {
            let concave: Vec<bool> = outline.turning.iter().map(|a| *a < 0.0).collect();
            for flags in [None, Some(concave.as_slice())] {
                let ours = layout::projection(&outline.corners, flags, &LayoutOptions::default()).unwrap();
                let mirrored: Vec<DVec2> = model.iter().map(|p| dvec2(p.x, -p.y)).collect();
                let ours_vertices = ours.polygon.vertices();
                let worst = misfit(ours_vertices, &model, true).min(misfit(ours_vertices, &mirrored, true));
                assert!(!ours.repaired && worst < 1e-13, "{name}: {worst:e}");
            }
            projections += 1;
        }
    }
    assert_eq!((heuristics, projections), (6, 3));
}

#[test]
fn outlines_that_the_published_program_iterates_on_get_a_polygon_at_once() {
    let Some(folder) = shared() else { return };
    for case in cases(&folder) {
        let Some(outline) = load(&folder, case["model"].as_str().unwrap()) else { continue };
        let Some(tolerance) = case["tolerance"].as_f64() else { continue };
        let options = LayoutOptions { clearance: tolerance };
        let ours = layout::heuristic(&outline.lengths, &outline.turning, &options).unwrap();
        let required = layout::required_clearance(outline.lengths.len(), &options);
        assert_valid(&ours, required, &format!("{} {tolerance}", case["model"]));
        let concave: Vec<bool> = outline.turning.iter().map(|a| *a < 0.0).collect();
        assert_eq!(ours.concave, concave);
        println!("{} {tolerance}: clearance {:.4}, blend {}", case["model"], ours.clearance, ours.blend);
    }
}
