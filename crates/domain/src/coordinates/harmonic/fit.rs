//! The adaptive fit: solve, look where the residual is large, enlarge the basis or cut the cell there, solve again.

use super::{
    basis::{Basis, LEVELS, Site, crowded_corners},
    cell::{Cell, EdgePoint},
    cut::{best_chord, gap_chord, middle_chord, neck_chord},
    evaluate::Part,
    number::Complex,
    outline::Outline,
    reproduce::Reproduction,
    sample::{Interface, SideSample, check_chord, check_sides, fit_chord, fit_sides, interfaces},
    solve::LeastSquares,
};

/// Residuals above these, level by level, call for a cut rather than for a richer basis.
const CUT_ABOVE: [f64; LEVELS.len()] = [3e-5, 3e-6, 3e-7, 0.0, 0.0];
/// Level that every cell begins with.
const FIRST_LEVEL: usize = 1;
/// Cells thinner than this are cut before anything is tried.
const THIN: f64 = 0.12;
/// Cells with more crowded corners than this are cut before anything is tried.
const MOST_CROWDED: usize = 6;
/// Most cells.
const MOST_CELLS: usize = 96;
/// Most solves.
const MOST_ROUNDS: usize = 30;
/// Rounds without progress, and work done, after which a fit that is good enough is taken.
const MOST_STALE: usize = 4;
const PATIENCE: f64 = 3e9;
/// Cells whose residual is below this part of the largest are left alone in a round.
const QUIET: f64 = 0.25;

/// Work after which no further round is begun: some three seconds.
const MOST_WORK: f64 = 1e10;

/// What a fit ends with.
pub(super) struct Fit {
    pub(super) parts: Vec<Part>,
    /// Bound on the error inside: twice the largest residual, the jumps between cells, rounding.
    pub(super) certificate: f64,
    pub(super) boundary_residual: f64,
}

/// A cell on its way.
struct Patch {
    cell: Cell,
    level: usize,
    /// No good chord cuts it.
    whole: bool,
}

/// Residuals of one solve.
struct Check {
    /// Largest boundary residual and jump of each cell.
    cells: Vec<f64>,
    boundary: f64,
    jumps: f64,
    rounding: f64,
}

impl Check {
    fn certificate(&self) -> f64 {
        2.0 * self.boundary + 2.0 * self.jumps + self.rounding
    }
}

/// Fits until the certificate is at most `target`; where nothing more helps, or it is at most `limit` and has not
/// come down for some rounds, the best fit found.
pub(super) fn fit(outline: &Outline, reproduction: &Reproduction, target: f64, limit: f64) -> Fit {
    let mut patches = vec![Patch { cell: Cell::whole(outline), level: FIRST_LEVEL, whole: false }];
    let mut chords = 0;
    cut_early(outline, &mut patches, &mut chords);
    let mut best = Fit { parts: Vec::new(), certificate: f64::INFINITY, boundary_residual: f64::INFINITY };
    let (mut work, mut stale) = (0.0, 0);
    for _ in 0..MOST_ROUNDS {
        let Some((parts, cost)) = solve(outline, &patches, MOST_WORK - work) else { break };
        let levels: Vec<usize> = patches.iter().map(|p| p.level).collect();
        let check = check(outline, reproduction, &parts, &levels);
        let certificate = check.certificate();
        work += cost;
        stale = if certificate < 0.7 * best.certificate { 0 } else { stale + 1 };
        if certificate < best.certificate {
            best = Fit { parts, certificate, boundary_residual: check.boundary };
        }
        let tired = stale >= MOST_STALE && work > PATIENCE;
        let enough = best.certificate <= target || (best.certificate <= limit && tired);
        if enough || !enlarge(outline, &mut patches, &mut chords, &check, target) {
            break;
        }
    }
    best
}

/// Cuts thin cells, cells with many crowded corners, narrow arms and the walls of narrow gaps apart before anything is
/// tried.
fn cut_early(outline: &Outline, patches: &mut Vec<Patch>, chords: &mut usize) {
    let mut at = 0;
    while at < patches.len() && patches.len() < MOST_CELLS {
        let cell = &patches[at].cell;
        let chord = if cell.fatness() < THIN && cell.len() > 3 {
            best_chord(outline, cell)
        } else if crowded_corners(outline, cell) > MOST_CROWDED {
            middle_chord(outline, cell)
        } else {
            neck_chord(outline, cell)
        };
        match chord.or_else(|| gap_chord(outline, cell)) {
            Some(chord) => split(patches, at, &chord, chords),
            None => at += 1,
        }
    }
}

/// Cuts a cell by its best chord; whether there was one.
fn cut(outline: &Outline, patches: &mut Vec<Patch>, at: usize, chords: &mut usize) -> bool {
    if patches.len() >= MOST_CELLS {
        return false;
    }
    let Some(chord) = best_chord(outline, &patches[at].cell) else {
        patches[at].whole = true;
        return false;
    };
    split(patches, at, &chord, chords);
    true
}

fn split(patches: &mut Vec<Patch>, at: usize, (p, q): &(EdgePoint, EdgePoint), chords: &mut usize) {
    let (left, right) = patches[at].cell.split(p, q, *chords);
    *chords += 1;
    let level = patches[at].level;
    patches[at] = Patch { cell: left, level, whole: false };
    patches.insert(at + 1, Patch { cell: right, level, whole: false });
}

/// Cuts or enriches the cells with large residuals; whether anything could be done.
fn enlarge(
    outline: &Outline,
    patches: &mut Vec<Patch>,
    chords: &mut usize,
    check: &Check,
    target: f64,
) -> bool {
    let largest = check.cells.iter().copied().fold(0.0, f64::max);
    let least = (0.25 * target).max(QUIET * largest).min(largest);
    let mut acted = false;
    for at in (0..check.cells.len()).rev() {
        if check.cells[at] < least {
            continue;
        }
        let patch = &patches[at];
        let slow = check.cells[at] > CUT_ABOVE[patch.level] && !patch.whole;
        if slow && cut(outline, patches, at, chords) {
            acted = true;
        } else if patches[at].level + 1 < LEVELS.len() {
            patches[at].level += 1;
            acted = true;
        }
    }
    acted
}

/// One least-squares solve, and what it cost: rows by the square of columns. None where that is above `budget`.
fn solve(outline: &Outline, patches: &[Patch], budget: f64) -> Option<(Vec<Part>, f64)> {
    let n = outline.len();
    let cells: Vec<Cell> = patches.iter().map(|p| p.cell.clone()).collect();
    let bases: Vec<Basis> = patches
        .iter()
        .enumerate()
        .map(|(i, p)| Basis::new(outline, &p.cell, &LEVELS[p.level], i > 0))
        .collect();
    let mut system = LeastSquares::new(bases.iter().map(Basis::len).collect(), n);
    for (i, (patch, basis)) in patches.iter().zip(&bases).enumerate() {
        let samples = fit_sides(outline, &patch.cell, basis, LEVELS[patch.level].degree);
        system.add_rows(&[i], samples.len(), |row, values| {
            let sample = &samples[row];
            let mut k = 0;
            basis.visit::<0>(&sample.site, |g| {
                values[k] = g[0].re;
                k += 1;
            });
            values[k + sample.side] += 1.0 - sample.t;
            values[k + (sample.side + 1) % n] += sample.t;
        });
    }
    for interface in interfaces(&cells) {
        let [a, b] = interface.cells;
        let degree = LEVELS[patches[a].level].degree.max(LEVELS[patches[b].level].degree);
        let points = fit_chord(&interface, &[bases[a].poles(), bases[b].poles()], degree);
        system.add_rows(&[a, b], 2 * points.len(), |row, values| {
            let site = Site::free(points[row / 2]);
            let part = |z: Complex<f64>| if row % 2 == 0 { z.re } else { z.im };
            let mut k = 0;
            bases[a].visit::<0>(&site, |g| {
                values[k] = part(g[0]);
                k += 1;
            });
            bases[b].visit::<0>(&site, |g| {
                values[k] = -part(g[0]);
                k += 1;
            });
        });
    }
    let cost = system.cost();
    if cost > budget {
        return None;
    }
    let solution = system.solve();

    let parts = cells.into_iter().zip(bases).zip(&solution);
    Some((parts.map(|((cell, basis), x)| Part::new(cell, basis, x, n)).collect(), cost))
}

/// Residuals at samples apart from those of the fit.
fn check(outline: &Outline, reproduction: &Reproduction, parts: &[Part], levels: &[usize]) -> Check {
    let n = outline.len();
    let mut cells = vec![0.0_f64; parts.len()];
    let mut magnitude = 0.0_f64;
    let mut boundary = 0.0_f64;
    for (i, part) in parts.iter().enumerate() {
        let samples = check_sides(outline, part.cell(), part.basis(), LEVELS[levels[i]].degree);
        let sites: Vec<Site> = samples.iter().map(|s| s.site).collect();
        let mut values = vec![0.0; sites.len() * n];
        part.values(&sites, &mut values);
        for (at, (sample, values)) in samples.iter().zip(values.chunks_exact_mut(n)).enumerate() {
            reproduction.correct_values(values, sample.site.z);
            cells[i] = cells[i].max(residual(values, sample));
            if at % 8 == 0 {
                magnitude = magnitude.max(part.magnitude(&sample.site));
            }
        }
        boundary = boundary.max(cells[i]);
    }
    let list: Vec<Cell> = parts.iter().map(|p| p.cell().clone()).collect();
    let mut jumps = 0.0;
    for interface in interfaces(&list) {
        let jump = jump(parts, levels, &interface, n);
        jumps += reproduction.norm() * jump;
        for c in interface.cells {
            cells[c] = cells[c].max(jump);
        }
    }
    // The sum of N products: each has the error of its function, some ten roundings, and of the addition. The map that
    // makes Σλ and Σλv exact adds a few roundings for each of the n values.
    let longest = parts.iter().map(|p| p.basis().len()).max().unwrap_or(0) as f64;
    let rounding = 0.5 * f64::EPSILON * ((10.0 + longest.sqrt()) * magnitude + 32.0 * n as f64);
    if !boundary.is_finite() || !jumps.is_finite() {
        cells.iter_mut().filter(|c| !c.is_finite()).for_each(|c| *c = f64::INFINITY);
    }
    Check { cells, boundary, jumps, rounding }
}

/// Largest difference of the values from the hat functions; infinite where a value is not a number.
fn residual(values: &[f64], sample: &SideSample) -> f64 {
    let n = values.len();
    let next = (sample.side + 1) % n;
    let exact = |j: usize| {
        if j == sample.side {
            1.0 - sample.t
        } else if j == next {
            sample.t
        } else {
            0.0
        }
    };
    values
        .iter()
        .enumerate()
        .map(|(j, v)| (v - exact(j)).abs())
        .fold(0.0, |a, b| if b.is_nan() { f64::INFINITY } else { a.max(b) })
}

/// Largest jump of F over a part of a chord.
fn jump(parts: &[Part], levels: &[usize], interface: &Interface, n: usize) -> f64 {
    let [a, b] = interface.cells;
    let degree = LEVELS[levels[a]].degree.max(LEVELS[levels[b]].degree);
    let zero = num_complex::Complex64::ZERO;
    let (mut left, mut right) = (vec![zero; n], vec![zero; n]);
    let mut largest = 0.0_f64;
    for z in check_chord(interface, &[parts[a].basis().poles(), parts[b].basis().poles()], degree) {
        parts[a].complex(z, &mut left);
        parts[b].complex(z, &mut right);
        for (x, y) in left.iter().zip(&right) {
            let d = (x - y).norm();
            largest = if d.is_nan() { f64::INFINITY } else { largest.max(d) };
        }
    }
    largest
}
