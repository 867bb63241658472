//! Where the boundary and the chords are sampled: for the fit, and apart from it for the check.

use std::f64::consts::PI;

use num_complex::Complex64;

use super::{
    basis::{Basis, Pole, Site},
    cell::{Cell, Edge},
    outline::{Outline, dot},
};

/// Points of a panel between two subdivisions.
const PANEL_POINTS: usize = 10;
/// A panel is cut while it is longer than this many times its distance from the nearest pole.
const PANEL_REACH: f64 = 1.2;
/// Panels are not cut below this length.
const LEAST_PANEL: f64 = 1e-10;

/// A sample of a side: the point, and the boundary values there, 1 − t at vertex `side`, t at the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct SideSample {
    pub(super) site: Site,
    pub(super) side: usize,
    pub(super) t: f64,
}

/// A part of a chord that two cells share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interface {
    pub(super) cells: [usize; 2],
    pub(super) ends: [Complex64; 2],
}

/// The point at parameter t of side k.
pub(super) fn side_site(outline: &Outline, k: usize, t: f64) -> Site {
    let n = outline.len();
    let next = (k + 1) % n;
    let (a, b) = (outline.vertices[k], outline.vertices[next]);
    let d = b - a;
    // 1 − t is exact for t ≥ ½.
    let near = [(k, d * t), (next, -d * (1.0 - t))];
    Site { z: if t < 0.5 { a + near[0].1 } else { b + near[1].1 }, near }
}

/// Samples of the sides of a cell, to fit to.
pub(super) fn fit_sides(outline: &Outline, cell: &Cell, basis: &Basis, degree: usize) -> Vec<SideSample> {
    let mut out = Vec::new();
    for_each_side(outline, cell, |k, range, corner| {
        let places = side_places(outline, k, range, corner, basis.poles(), degree);
        out.extend(places.into_iter().map(|t| SideSample { site: side_site(outline, k, t), side: k, t }));
    });
    out
}

/// Samples of the sides of a cell between those of the fit, and nearer to the corners than any of them.
pub(super) fn check_sides(outline: &Outline, cell: &Cell, basis: &Basis, degree: usize) -> Vec<SideSample> {
    let mut out = Vec::new();
    for_each_side(outline, cell, |k, range, corner| {
        let mut places = between(&side_places(outline, k, range, corner, basis.poles(), degree), range);
        let width = range[1] - range[0];
        for decade in 1..=12 {
            let near = width * 0.37 * 0.1_f64.powi(decade);
            places.extend([range[0] + near, range[1] - near]);
        }
        places.retain(|t| *t > 0.0 && *t < 1.0);
        out.extend(places.into_iter().map(|t| SideSample { site: side_site(outline, k, t), side: k, t }));
    });
    out
}

/// Points of a chord to fit to.
pub(super) fn fit_chord(interface: &Interface, poles: &[&[Pole]; 2], degree: usize) -> Vec<Complex64> {
    let [a, b] = interface.ends;
    chord_places(interface, poles, degree).into_iter().map(|t| a + (b - a) * t).collect()
}

/// Points of a chord between those of the fit.
pub(super) fn check_chord(interface: &Interface, poles: &[&[Pole]; 2], degree: usize) -> Vec<Complex64> {
    let [a, b] = interface.ends;
    between(&chord_places(interface, poles, degree), [0.0, 1.0])
        .into_iter()
        .map(|t| a + (b - a) * t)
        .collect()
}

/// The pieces of chords along which two cells meet.
pub(super) fn interfaces(cells: &[Cell]) -> Vec<Interface> {
    let chords: Vec<(usize, usize, [Complex64; 2])> = cells
        .iter()
        .enumerate()
        .flat_map(|(c, cell)| {
            (0..cell.len()).filter_map(move |i| match cell.edges[i] {
                Edge::Chord(id) => Some((c, id, cell.ends(i).into())),
                Edge::Side(_) => None,
            })
        })
        .collect();
    let mut out = Vec::new();
    for (x, &(first, id, [a, b])) in chords.iter().enumerate() {
        for &(second, other, ends) in &chords[x + 1..] {
            if id != other || first == second {
                continue;
            }
            let place = |z: Complex64| dot(b - a, z - a) / (b - a).norm_sqr();
            let [s, t] = ends.map(place);
            let (lo, hi) = (s.min(t).max(0.0), s.max(t).min(1.0));
            if hi - lo > 1e-9 {
                out.push(Interface { cells: [first, second], ends: [a + (b - a) * lo, a + (b - a) * hi] });
            }
        }
    }
    out
}

/// Calls `f` with the side, the range of its parameter and which ends are singular corners, for every side edge.
fn for_each_side(outline: &Outline, cell: &Cell, mut f: impl FnMut(usize, [f64; 2], [bool; 2])) {
    for i in 0..cell.len() {
        if let Edge::Side(k) = cell.edges[i] {
            let range = cell.side_range(outline, i, k);
            let singular = |j: usize| cell.corners[j % cell.len()].is_some_and(|c| outline.is_singular(c));
            f(k, range, [singular(i), singular(i + 1)]);
        }
    }
}

fn side_places(
    outline: &Outline,
    k: usize,
    range: [f64; 2],
    corner: [bool; 2],
    poles: &[Pole],
    degree: usize,
) -> Vec<f64> {
    let (a, d) = (outline.vertices[k], outline.vertex(k + 1) - outline.vertices[k]);
    let mut places = places(range, d.norm(), |t| nearest(a + d * t, poles), degree);
    let width = range[1] - range[0];
    for step in 0..12 {
        let near = width * 10f64.powf(-8.0 + 6.5 * f64::from(step) / 11.0);
        if corner[0] {
            places.push(range[0] + near);
        }
        if corner[1] {
            places.push(range[1] - near);
        }
    }
    places.retain(|t| *t > 0.0 && *t < 1.0);
    places.sort_by(f64::total_cmp);
    places
}

fn chord_places(interface: &Interface, poles: &[&[Pole]; 2], degree: usize) -> Vec<f64> {
    let [a, b] = interface.ends;
    let scale = |t: f64| {
        let z = a + (b - a) * t;
        nearest(z, poles[0]).min(nearest(z, poles[1]))
    };
    let mut places = places([0.0, 1.0], (b - a).norm(), scale, degree);
    places.sort_by(f64::total_cmp);
    places
}

fn nearest(z: Complex64, poles: &[Pole]) -> f64 {
    poles.iter().map(|p| (p.at - z).norm_sqr()).fold(f64::INFINITY, f64::min).sqrt()
}

/// Chebyshev points over the range, and over its panels where poles are near.
fn places(range: [f64; 2], length: f64, scale: impl Fn(f64) -> f64, degree: usize) -> Vec<f64> {
    let mut out = Vec::new();
    chebyshev(range, 8 + degree * 8 / 5, &mut out);
    let mut todo = vec![range];
    while let Some([lo, hi]) = todo.pop() {
        let middle = 0.5 * (lo + hi);
        let panel = (hi - lo) * length;
        if panel > PANEL_REACH * scale(middle) && panel > LEAST_PANEL {
            todo.extend([[lo, middle], [middle, hi]]);
        } else if hi - lo < range[1] - range[0] {
            chebyshev([lo, hi], PANEL_POINTS, &mut out);
        }
    }
    out
}

fn chebyshev([lo, hi]: [f64; 2], count: usize, out: &mut Vec<f64>) {
    out.extend((0..count).map(|i| {
        let x = 0.5 - 0.5 * (PI * (i as f64 + 0.5) / count as f64).cos();
        lo + (hi - lo) * x
    }));
}

/// Two points in every gap of the sorted places, the ends of the range included.
fn between(places: &[f64], range: [f64; 2]) -> Vec<f64> {
    let ends = std::iter::once(range[0]).chain(places.iter().copied()).chain([range[1]]);
    let all: Vec<f64> = ends.collect();
    all.windows(2).flat_map(|w| [0.31, 0.73].map(|x| w[0] + (w[1] - w[0]) * x)).collect()
}
