//! The analytic functions whose real parts make up the coordinates on one cell.
//!
//! 1. A polynomial about the cell's centre.
//! 2. For corners with interior angle ω the corner series r^(jα) sin(jαθ), α = π/ω: each vanishes on both sides of the
//!    corner and together they carry its singularity exactly. Their branch cut is a ray that misses the cell. Corners
//!    of the polygon beside the cell take part too, since the functions on the cell feel them.
//! 3. Where another corner is near, that series is used in the variable (z − c)/(z − e), e beyond the corner, which
//!    stays bounded away from the corner, together with
//! 4. poles in geometric progression along the ray: they carry what happens between the scale of the near corner and
//!    that of the cell.
//! 5. Poles midway across outer gaps (slots, notches), as dense as the gap is narrow.

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use super::super::lanes::{LANES, Lanes};
use super::{
    cell::{Cell, Edge},
    number::{Complex, Real},
    outline::Outline,
};

/// How rich the basis is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    /// Degree of the polynomial.
    pub(super) degree: usize,
    /// Largest exponent in the corner series.
    pub(super) exponent: f64,
    /// What the poles shall resolve.
    pub(super) tolerance: f64,
}

impl Level {
    /// Ratio of the distances of graded poles in the middle of an outer wedge of angle `wedge`.
    ///
    /// Poles at c + dᵏ are the trapezoidal rule in log d for a density along their ray, which is analytic up to the
    /// sides of the wedge: its error is exp(−2π·(wedge/2)/log ratio).
    fn ratio(&self, wedge: f64) -> f64 {
        (PI * wedge / self.tolerance.ln().abs()).exp().clamp(1.02, 2.5)
    }

    /// Distance of poles in the middle of a gap of this width, by the same rule: exp(−2π·(width/2)/step).
    fn step(&self, width: f64) -> f64 {
        PI * width / self.tolerance.ln().abs()
    }
}

/// The levels, from the poorest to the richest.
pub(super) const LEVELS: [Level; 5] = [
    Level { degree: 16, exponent: 9.0, tolerance: 1e-6 },
    Level { degree: 22, exponent: 11.0, tolerance: 1e-8 },
    Level { degree: 28, exponent: 14.0, tolerance: 1e-10 },
    Level { degree: 34, exponent: 16.0, tolerance: 1e-12 },
    Level { degree: 42, exponent: 18.0, tolerance: 1e-13 },
];

/// Other corners nearer than this part of the cell's diameter make a corner crowded.
const CROWDED: f64 = 0.10;
/// Corners beside the cell take part up to this distance, in diameters of the cell.
const REACH: f64 = 0.35;

/// Offsets from a corner are at least this long; two divisions by it stay within f64.
const LEAST_OFFSET: f64 = 1e-60;
/// Most poles of a cell.
const MOST_POLES: usize = 240;

/// A point with its offsets from the corners that it shares a side with, which are exact where the difference of
/// coordinates would not be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Site {
    pub(super) z: Complex64,
    pub(super) near: [(usize, Complex64); 2],
}

impl Site {
    /// A point that is on no side.
    pub(super) fn free(z: Complex64) -> Self {
        Self { z, near: [(usize::MAX, Complex64::ZERO); 2] }
    }

    /// z − c, never 0: at the corner itself the derivatives are finite numbers, if without meaning.
    fn offset(&self, corner: usize, c: Complex64) -> Complex64 {
        let offset = match self.near.iter().find(|(k, _)| *k == corner) {
            Some((_, offset)) => *offset,
            None => self.z - c,
        };
        if offset.norm_sqr() < LEAST_OFFSET * LEAST_OFFSET {
            Complex64::new(LEAST_OFFSET, 0.0)
        } else {
            offset
        }
    }
}

/// Series of corner functions −i·(z − c)^(jα), cut along the ray at `cut`.
#[derive(Clone, Debug)]
struct CornerSeries {
    corner: usize,
    at: Complex64,
    alpha: f64,
    /// The rotation that turns the cut onto the positive real axis.
    rotation: Complex64,
    /// Angle from the first side to the cut, minus 2π.
    turn: f64,
    terms: usize,
}

/// Series of ((z − c)/(z − e))^(jα), cut between c and e.
#[derive(Clone, Debug)]
struct CrowdedSeries {
    corner: usize,
    at: Complex64,
    /// c − e.
    beyond: Complex64,
    alpha: f64,
    terms: usize,
}

/// strength/(z − at).
#[derive(Clone, Copy, Debug)]
pub(super) struct Pole {
    pub(super) at: Complex64,
    pub(super) strength: f64,
}

/// The functions of one cell; see the head of this file.
#[derive(Clone, Debug)]
pub(super) struct Basis {
    centre: Complex64,
    radius: f64,
    degree: usize,
    /// Whether the imaginary constant takes part: it matters only for agreement between cells.
    imaginary_constant: bool,
    series: Vec<CornerSeries>,
    crowded: Vec<CrowdedSeries>,
    poles: Vec<Pole>,
    len: usize,
}

impl Basis {
    /// Chooses the functions for a cell.
    pub(super) fn new(outline: &Outline, cell: &Cell, level: &Level, imaginary_constant: bool) -> Self {
        let (centre, radius) = cell.centre_and_radius();
        let diameter = cell.diameter();
        let mut basis = Self {
            centre,
            radius,
            degree: level.degree,
            imaginary_constant,
            series: Vec::new(),
            crowded: Vec::new(),
            poles: Vec::new(),
            len: 0,
        };
        for corner in 0..outline.len() {
            basis.add_corner(outline, cell, level, corner, diameter);
        }
        basis.add_gap_poles(cell, level, diameter);
        basis.len = basis.count();
        basis
    }

    /// Number of real unknowns.
    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// The poles, whose distance tells how fine the boundary must be sampled.
    pub(super) fn poles(&self) -> &[Pole] {
        &self.poles
    }

    fn count(&self) -> usize {
        let polynomial = 2 * (self.degree + 1) - usize::from(!self.imaginary_constant);
        let series: usize = self.series.iter().map(|s| (1..=s.terms).filter(|&j| s.takes(j)).count()).sum();
        let crowded: usize = self.crowded.iter().map(|s| 2 * s.terms).sum();
        polynomial + series + crowded + 2 * self.poles.len()
    }

    fn add_corner(&mut self, outline: &Outline, cell: &Cell, level: &Level, corner: usize, diameter: f64) {
        let at = outline.vertices[corner];
        let own = cell.corners.contains(&Some(corner));
        let distance = if own { 0.0 } else { cell.boundary_distance(at) };
        if distance > REACH * diameter {
            return;
        }
        let (omega, first) = (outline.angles[corner], outline.direction(corner));
        let free = free_ray(cell, at, first + omega, TAU - omega);
        let gap = outline.gaps[corner];
        let singular = outline.is_singular(corner);
        let alpha = PI / omega;
        // The bisector leaves most room; half the way to what it meets is free on all sides.
        let bisector = first + omega + 0.5 * (TAU - omega);
        let direction = Complex64::from_polar(1.0, bisector);
        let near = gap.min(0.5 * cell.ray(at, direction, 1e-12).0);
        let is_crowded = gap < CROWDED * diameter || (own && singular && free.is_none());
        if singular {
            let terms = (level.exponent / alpha).ceil() as usize;
            if is_crowded && (own || free.is_some()) {
                let terms = terms.max(1);
                self.crowded.push(CrowdedSeries { corner, at, beyond: -direction * near, alpha, terms });
            }
            if let Some(cut) = free {
                let terms = if is_crowded { 1 } else { terms };
                let (rotation, turn) = (Complex64::from_polar(1.0, -cut), cut - first - TAU);
                self.series.push(CornerSeries { corner, at, alpha, rotation, turn, terms });
            }
        }
        if is_crowded {
            self.add_graded_poles(cell, level, at, bisector, (0.25 * near).max(distance), diameter);
        }
    }

    /// Poles from near a corner outwards, midway through the outside of the cell.
    fn add_graded_poles(
        &mut self,
        cell: &Cell,
        level: &Level,
        at: Complex64,
        start: f64,
        from: f64,
        to: f64,
    ) {
        let (mut r, mut direction) = (from.max(1e-12), start);
        while r < to && self.poles.len() < MOST_POLES {
            let [back, forth] = cell.arc(at, r, direction);
            direction = 0.5 * (back + forth);
            let pole = at + Complex64::from_polar(r, direction);
            if cell.contains(pole) {
                return;
            }
            let ratio = level.ratio(forth - back);
            self.add_pole(cell, pole, r, 0.3 * (ratio - 1.0) * r);
            r *= ratio;
        }
    }

    /// Poles midway between a side and what it faces across the outside of the cell, unless a corner series sits
    /// between the two.
    fn add_gap_poles(&mut self, cell: &Cell, level: &Level, diameter: f64) {
        for i in 0..cell.len() {
            let Edge::Side(_) = cell.edges[i] else { continue };
            let (a, b) = cell.ends(i);
            let length = (b - a).norm();
            let along = (b - a) / length;
            let outward = along * -Complex64::I;
            let mut s = 0.02 * length;
            while s < length && self.poles.len() < MOST_POLES {
                let foot = a + along * s;
                let (width, facing) = cell.ray(foot, outward, 1e-7);
                let covered = self.joined_by_series(cell, i, facing);
                if width < REACH * diameter && !covered {
                    let step = level.step(width).max(0.005 * length);
                    self.add_pole(cell, foot + outward * (0.5 * width), 0.5 * width, 0.4 * step);
                    s += step;
                } else {
                    s += 0.05 * length;
                }
            }
        }
    }

    /// Whether two edges are the sides of one corner that has its full series.
    fn joined_by_series(&self, cell: &Cell, i: usize, j: usize) -> bool {
        let n = cell.len();
        let between = if (i + 1) % n == j {
            j
        } else if (j + 1) % n == i {
            i
        } else {
            return false;
        };
        cell.corners[between].is_some_and(|c| self.series.iter().any(|s| s.corner == c && s.terms > 1))
    }

    fn add_pole(&mut self, cell: &Cell, at: Complex64, strength: f64, apart: f64) {
        if !cell.contains(at) && self.poles.iter().all(|p| (p.at - at).norm() > apart) {
            self.poles.push(Pole { at, strength });
        }
    }

    /// Calls `sink` once for every real unknown with its function and, up to `ORDER`, the derivatives with respect
    /// to z.
    #[inline(always)]
    pub(super) fn visit<const ORDER: usize>(&self, site: &Site, mut sink: impl FnMut([Complex<f64>; 3])) {
        let z = Complex { re: site.z.re, im: site.z.im };
        let offset = |corner: usize, at: Complex64| {
            let offset = site.offset(corner, at);
            Complex { re: offset.re, im: offset.im }
        };
        self.visit_all::<f64, ORDER>(z, &offset, &mut sink);
    }

    /// [`visit`](Self::visit) at several sites at once.
    #[inline(always)]
    pub(super) fn visit_lanes<const ORDER: usize>(
        &self,
        sites: &[Site; LANES],
        mut sink: impl FnMut([Complex<Lanes>; 3]),
    ) {
        let z = lanes(|l| sites[l].z);
        let offset = |corner: usize, at: Complex64| lanes(|l| sites[l].offset(corner, at));
        self.visit_all::<Lanes, ORDER>(z, &offset, &mut sink);
    }

    /// `offset` gives z less a corner.
    #[inline(always)]
    fn visit_all<T: Real, const ORDER: usize>(
        &self,
        z: Complex<T>,
        offset: &impl Fn(usize, Complex64) -> Complex<T>,
        sink: &mut impl FnMut([Complex<T>; 3]),
    ) {
        self.visit_polynomial::<T, ORDER>(z, sink);
        for series in &self.series {
            series.visit::<T, ORDER>(offset(series.corner, series.at), self.radius, sink);
        }
        for series in &self.crowded {
            series.visit::<T, ORDER>(offset(series.corner, series.at), sink);
        }
        let zero = Complex::of(0.0, 0.0);
        for pole in &self.poles {
            let inverse = (z - Complex::of(pole.at.re, pole.at.im)).inv();
            let g = inverse.scale(T::of(pole.strength));
            let mut out = [g, zero, zero];
            if ORDER > 0 {
                out[1] = zero - g * inverse;
            }
            if ORDER > 1 {
                out[2] = (out[1] * inverse).scale(T::of(-2.0));
            }
            pair(out, sink);
        }
    }

    #[inline(always)]
    fn visit_polynomial<T: Real, const ORDER: usize>(
        &self,
        z: Complex<T>,
        sink: &mut impl FnMut([Complex<T>; 3]),
    ) {
        let per_radius = 1.0 / self.radius;
        let x = (z - Complex::of(self.centre.re, self.centre.im)).scale(T::of(per_radius));
        let (zero, one) = (Complex::of(0.0, 0.0), Complex::of(1.0, 0.0));
        sink([one, zero, zero]);
        if self.imaginary_constant {
            sink([one.times_i(), zero, zero]);
        }
        // p[0], p[1], p[2] are x^k, x^(k−1), x^(k−2).
        let mut p = [one, zero, zero];
        for k in 1..=self.degree {
            p = [p[0] * x, p[0], p[1]];
            let k = k as f64;
            let mut out = [p[0], zero, zero];
            if ORDER > 0 {
                out[1] = p[1].scale(T::of(k * per_radius));
            }
            if ORDER > 1 {
                out[2] = p[2].scale(T::of(k * (k - 1.0) * per_radius * per_radius));
            }
            pair(out, sink);
        }
    }
}

/// One complex number a lane.
#[inline(always)]
fn lanes(at: impl Fn(usize) -> Complex64) -> Complex<Lanes> {
    let (mut re, mut im) = (Lanes::ZERO, Lanes::ZERO);
    for l in 0..LANES {
        let z = at(l);
        (re.0[l], im.0[l]) = (z.re, z.im);
    }
    Complex { re, im }
}

/// Singular corners of a cell that have another corner near, measured by the size of the cell.
pub(super) fn crowded_corners(outline: &Outline, cell: &Cell) -> usize {
    let near = CROWDED * cell.diameter();
    cell.corners.iter().flatten().filter(|&&c| outline.is_singular(c) && outline.gaps[c] < near).count()
}

/// One complex unknown is two real ones: the function, and i times it.
#[inline(always)]
fn pair<T: Real>(g: [Complex<T>; 3], sink: &mut impl FnMut([Complex<T>; 3])) {
    sink(g);
    sink(g.map(Complex::times_i));
}

/// A direction in the wedge from `from` through `wedge` whose ray from `at` misses the cell, the nearest to the
/// bisector first.
fn free_ray(cell: &Cell, at: Complex64, from: f64, wedge: f64) -> Option<f64> {
    const TRIES: i32 = 16;
    (0..=2 * TRIES)
        .map(|i| {
            let step = f64::from((i + 1) / 2) / f64::from(TRIES) * 0.47;
            from + wedge * (0.5 + if i % 2 == 0 { step } else { -step })
        })
        .find(|&phi| cell.ray(at, Complex64::from_polar(1.0, phi), 1e-12).0.is_infinite())
}

impl CornerSeries {
    /// Powers that are integers are in the polynomial already; near 1 the difference quotient stands in.
    fn takes(&self, j: usize) -> bool {
        let a = self.alpha * j as f64;
        near_one(a) || (a - a.round()).abs() > 1e-9
    }

    #[inline(always)]
    fn visit<T: Real, const ORDER: usize>(
        &self,
        offset: Complex<T>,
        radius: f64,
        sink: &mut impl FnMut([Complex<T>; 3]),
    ) {
        let turned = offset * Complex::of(self.rotation.re, self.rotation.im);
        let theta = turned.im.atan2(turned.re);
        let theta = theta.select_less(0.0, theta + T::of(TAU), theta);
        let r2 = offset.norm_sqr() / T::of(radius * radius);
        let log = Complex { re: T::of(0.5) * r2.ln(), im: theta + T::of(self.turn) };
        let w = log.scale(T::of(self.alpha)).exp();
        let zero = Complex::of(0.0, 0.0);
        let inverse = if ORDER > 0 { offset.inv() } else { zero };
        let mut power = Complex::of(1.0, 0.0);
        for j in 1..=self.terms {
            power = power * w;
            let a = self.alpha * j as f64;
            if near_one(a) {
                sink(difference_quotient::<T, ORDER>(log, a, inverse));
            } else if self.takes(j) {
                let mut out = [power.over_i(), zero, zero];
                if ORDER > 0 {
                    out[1] = (out[0] * inverse).scale(T::of(a));
                }
                if ORDER > 1 {
                    out[2] = (out[1] * inverse).scale(T::of(a - 1.0));
                }
                sink(out);
            }
        }
    }
}

/// Whether an exponent is so near 1 that z^a is no longer told from z.
fn near_one(a: f64) -> bool {
    (a - 1.0).abs() < 0.05
}

/// −i·(z^a − z)/(a − 1) by L = log z: it tends to −i·z log z, the function of a change of slope on a straight side.
#[inline(always)]
fn difference_quotient<T: Real, const ORDER: usize>(
    log: Complex<T>,
    a: f64,
    inverse: Complex<T>,
) -> [Complex<T>; 3] {
    let d = a - 1.0;
    let x = log.scale(T::of(d));
    let one = Complex::of(1.0, 0.0);
    // (eˣ − 1)/x; the series is exact to rounding below 1e-3, and above it at most three digits cancel.
    let mut term = one;
    let mut series = one;
    for k in 2..=10 {
        term = (term * x).scale(T::of(1.0 / f64::from(k)));
        series = series + term;
    }
    let quotient = Complex::select_less(x.norm_sqr(), 1e-2, series, (x.exp() - one) * x.inv());
    let z = log.exp();
    let f = z * quotient * log;
    let zero = Complex::of(0.0, 0.0);
    let mut out = [f, zero, zero];
    if ORDER > 0 {
        out[1] = (f.scale(T::of(a)) + z) * inverse;
    }
    if ORDER > 1 {
        out[2] = ((f.scale(T::of(d)) + z) * inverse * inverse).scale(T::of(a));
    }
    out.map(Complex::over_i)
}

impl CrowdedSeries {
    #[inline(always)]
    fn visit<T: Real, const ORDER: usize>(&self, near: Complex<T>, sink: &mut impl FnMut([Complex<T>; 3])) {
        let far = near + Complex::of(self.beyond.re, self.beyond.im);
        let inverse = [near.inv(), far.inv()];
        let ratio = near * inverse[1];
        let log = Complex { re: T::of(0.5) * ratio.norm_sqr().ln(), im: ratio.im.atan2(ratio.re) };
        // The logarithmic derivative of (z − c)/(z − e), and its derivative.
        let q = inverse[0] - inverse[1];
        let q1 = inverse[1] * inverse[1] - inverse[0] * inverse[0];
        let w = log.scale(T::of(self.alpha)).exp();
        let zero = Complex::of(0.0, 0.0);
        let mut power = Complex::of(1.0, 0.0);
        for j in 1..=self.terms {
            power = power * w;
            let a = self.alpha * j as f64;
            let mut out = [power, zero, zero];
            if ORDER > 0 {
                out[1] = (power * q).scale(T::of(a));
            }
            if ORDER > 1 {
                out[2] = power * ((q * q).scale(T::of(a * a)) + q1.scale(T::of(a)));
            }
            pair(out, sink);
        }
    }
}
