//! Harmonic coordinates by certified least squares in analytic functions.
//!
//! λ_i is the harmonic function on the polygon that is linear on every side, 1 at vertex i and 0 at the others. It is
//! the real part of an analytic function F_i, sought in a span of functions made for the polygon (`basis`): a
//! polynomial, the functions that carry the singularities of the corners, and poles where the outside is narrow.
//!
//! Where one span does not serve the whole polygon, chords cut it into cells (`cut`), each with a span of its own; the
//! functions of neighbouring cells are fitted to each other along their chord, real and imaginary part. All this is
//! one least-squares problem with a block of unknowns a cell (`solve`). Its residual tells which cells to enrich or to
//! cut next (`fit`).
//!
//! **Certificate.** With one cell, the maximum principle bounds the error inside by the residual on the boundary. With
//! more, F jumps by δ across the chords; a Cauchy integral of δ mends that and is of the size of δ. The certificate is
//! twice the largest residual at samples apart from those of the fit, plus twice the largest jump of every chord, plus
//! a bound on the rounding of the evaluation, u·((10 + √N)·Σ|c||φ| + 32n). The factors 2 stand for what lies between the
//! samples, and for the constant of the Cauchy integral.
//!
//! Sources: Gopal and Trefethen, *Solving Laplace problems with corner singularities via rational functions*, SIAM J.
//! Numer. Anal. 57 (2019); Costa and Trefethen, *AAA-least squares rational approximation and solution of Laplace
//! problems* (2021); Betcke and Trefethen, *Reviving the method of particular solutions*, SIAM Review 47 (2005), for
//! corner functions and subdomains.

mod basis;
mod cell;
mod cut;
mod elementary;
mod evaluate;
mod fit;
mod number;
mod outline;
mod reproduce;
mod sample;
mod solve;

use casteljau_geom::glam::DVec2;
use num_complex::Complex64;
use pulp::{Arch, Simd, WithSimd};

use super::{lanes::LANES, rows};
use crate::{DomainError, Polygon};
use basis::Site;
use cell::Edge;
use evaluate::{Part, Scratch, block, solved_rows};
use outline::{Frame, Outline};
use reproduce::Reproduction;
use sample::side_site;

/// How accurate harmonic coordinates shall be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HarmonicOptions {
    /// The basis is enlarged until the certificate is at most this.
    pub target: f64,
    /// A certificate above this is an error; between the two the coordinates are given with what was reached.
    pub limit: f64,
}

impl HarmonicOptions {
    /// Least target that rounding leaves room for.
    pub const LEAST_TARGET: f64 = 1e-12;

    fn check(&self) -> Result<(), DomainError> {
        for (option, value) in [("target", self.target), ("limit", self.limit)] {
            if !(Self::LEAST_TARGET..=1.0).contains(&value) {
                return Err(DomainError::BadOption { option, value, least: Self::LEAST_TARGET, most: 1.0 });
            }
        }
        Ok(())
    }

    /// A target of 1e-10, for measuring with.
    pub fn high_accuracy() -> Self {
        Self { target: 1e-10, limit: 1e-7 }
    }
}

impl Default for HarmonicOptions {
    /// A target of 1e-8, and 1e-7 at the least.
    fn default() -> Self {
        Self { target: 1e-8, limit: 1e-7 }
    }
}

/// Harmonic coordinates of a simple polygon.
#[derive(Clone, Debug)]
pub(super) struct HarmonicCoordinates {
    frame: Frame,
    outline: Outline,
    parts: Vec<Part>,
    reproduction: Reproduction,
    certificate: f64,
    boundary_residual: f64,
}

impl HarmonicCoordinates {
    /// Most sides; polygons with more than some thirty corners of like weight are rarely reached.
    const MOST_SIDES: usize = 64;

    /// Fits the coordinates of all vertices.
    pub(super) fn new(polygon: &Polygon, options: &HarmonicOptions) -> Result<Self, DomainError> {
        options.check()?;
        if polygon.len() > Self::MOST_SIDES {
            return Err(DomainError::TooManySides { count: polygon.len(), most: Self::MOST_SIDES });
        }
        let (outline, frame) = Outline::new(polygon);
        let reproduction = Reproduction::new(&outline);
        let fit = fit::fit(&outline, &reproduction, options.target, options.limit);
        let certified = fit.certificate <= options.limit.max(options.target);
        if !certified {
            return Err(DomainError::HarmonicAccuracy { reached: fit.certificate, limit: options.limit });
        }
        let (certificate, boundary_residual) = (fit.certificate, fit.boundary_residual);
        Ok(Self { frame, outline, parts: fit.parts, reproduction, certificate, boundary_residual })
    }

    /// Bound on the error of every λ_j inside.
    pub(super) fn certificate(&self) -> f64 {
        self.certificate
    }

    /// Largest difference from the linear boundary values at the samples of the check.
    pub(super) fn boundary_residual(&self) -> f64 {
        self.boundary_residual
    }

    /// Rows of λ and its derivatives at points inside: 1, 3 or 6 rows of n a point, point-major.
    pub(super) fn evaluate_inside(&self, points: &[DVec2], order: usize, out: &mut [f64]) {
        if points.is_empty() {
            return;
        }
        Arch::new().dispatch(Batch { coordinates: self, points, order, out });
    }

    /// The same rows at places on sides, strictly between their ends, each a side and the parameter on it.
    ///
    /// Along the side λ_j is linear, so its first derivative is known there and its second is 0, and with it that
    /// across the side, their sum being 0. What remains of the fit is the slope across the side and how that changes.
    pub(super) fn evaluate_sides(
        &self,
        polygon: &Polygon,
        places: &[(usize, f64)],
        order: usize,
        out: &mut [f64],
    ) {
        if places.is_empty() {
            return;
        }
        Arch::new().dispatch(SideBatch { coordinates: self, polygon, places, order, out });
    }

    /// The cell that a place on a side belongs to.
    fn part_of_side(&self, k: usize, t: f64, site: &Site) -> usize {
        if self.parts.len() == 1 {
            return 0;
        }
        let owns = |p: &Part| {
            (0..p.cell().len()).any(|i| {
                let [from, to] = p.cell().side_range(&self.outline, i, k);
                p.cell().edges[i] == Edge::Side(k) && (from..=to).contains(&t)
            })
        };
        self.parts.iter().position(owns).unwrap_or_else(|| self.part_of(site.z))
    }

    /// Rows of λ and its derivatives at sites, each of which lies in the part of that number, into the
    /// rows of each in `out`.
    #[inline(always)]
    fn evaluate_block(
        &self,
        parts: &[usize],
        sites: &[Site; LANES],
        order: usize,
        scratch: &mut Scratch,
        out: &mut [f64],
    ) {
        let n = self.outline.len();
        for (first, &part) in parts.iter().enumerate() {
            if parts[..first].contains(&part) {
                continue;
            }
            self.parts[part].evaluate(sites, order, scratch);
            for (lane, out) in out.chunks_exact_mut(rows(order) * n).enumerate() {
                if parts[lane] == part {
                    out.iter_mut().zip(&scratch.sums).for_each(|(out, sum)| *out = sum.0[lane]);
                    self.finish(sites[lane].z, order, out);
                }
            }
        }
    }

    /// From Re F, Re F′, Im F′, Re F″, Im F″ at z to the rows of λ.
    #[inline(always)]
    fn finish(&self, z: Complex64, order: usize, out: &mut [f64]) {
        let n = self.outline.len();
        let moments = [[1.0, z.re, z.im], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [0.0; 3], [0.0; 3]];
        for (row, moments) in out.chunks_exact_mut(n).zip(moments).take(solved_rows(order)) {
            self.reproduction.correct(row, moments);
        }
        // λ = Re F, so λ_x = Re F′, λ_y = −Im F′, λ_xx = Re F″, λ_xy = −Im F″, λ_yy = −λ_xx.
        let (s, flip) = (self.frame.scale, self.frame.flip);
        if order >= 1 {
            out[n..2 * n].iter_mut().for_each(|x| *x *= s);
            out[2 * n..3 * n].iter_mut().for_each(|x| *x *= -s * flip);
        }
        if order >= 2 {
            out[3 * n..4 * n].iter_mut().for_each(|x| *x *= s * s);
            out[4 * n..5 * n].iter_mut().for_each(|x| *x *= -s * s * flip);
            for j in 0..n {
                out[5 * n + j] = -out[3 * n + j];
            }
        }
    }

    /// The cell that a point lies in, or is nearest to.
    #[inline(always)]
    fn part_of(&self, z: Complex64) -> usize {
        if self.parts.len() == 1 {
            return 0;
        }
        let inside = self.parts.iter().position(|p| p.cell().contains(z));
        inside.unwrap_or_else(|| {
            let distance = |i: &usize| self.parts[*i].cell().boundary_distance(z);
            (0..self.parts.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
        })
    }
}

/// Many points, compiled for the widest vector instructions at hand.
struct Batch<'a> {
    coordinates: &'a HarmonicCoordinates,
    points: &'a [DVec2],
    order: usize,
    out: &'a mut [f64],
}

impl WithSimd for Batch<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { coordinates, points, order, out } = self;
        let stride = rows(order) * coordinates.outline.len();
        let mut scratch = Scratch::new(&coordinates.parts, coordinates.outline.len(), order);
        for (points, out) in points.chunks(LANES).zip(out.chunks_mut(LANES * stride)) {
            let sites = block(points).map(|p| Site::free(coordinates.frame.to_solver(p)));
            let parts = sites.map(|site| coordinates.part_of(site.z));
            coordinates.evaluate_block(&parts[..points.len()], &sites, order, &mut scratch, out);
        }
    }
}

/// Many places on sides, compiled for the widest vector instructions at hand.
struct SideBatch<'a> {
    coordinates: &'a HarmonicCoordinates,
    polygon: &'a Polygon,
    places: &'a [(usize, f64)],
    order: usize,
    out: &'a mut [f64],
}

impl WithSimd for SideBatch<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { coordinates, polygon, places, order, out } = self;
        let n = coordinates.outline.len();
        let stride = rows(order) * n;
        let mut scratch = Scratch::new(&coordinates.parts, n, order);
        for (places, out) in places.chunks(LANES).zip(out.chunks_mut(LANES * stride)) {
            let all = block(places).map(|(side, t)| ((side + n - 1) % n, t));
            let sites = all.map(|(k, t)| side_site(&coordinates.outline, k, t));
            let parts: [usize; LANES] =
                std::array::from_fn(|l| coordinates.part_of_side(all[l].0, all[l].1, &sites[l]));
            coordinates.evaluate_block(&parts[..places.len()], &sites, order, &mut scratch, out);
            for (&(side, _), out) in places.iter().zip(out.chunks_exact_mut(stride)) {
                impose_linearity(polygon, side, order, out);
            }
        }
    }
}

/// Sets the derivatives along a side, of which λ is linear, to what they are exactly.
fn impose_linearity(polygon: &Polygon, side: usize, order: usize, out: &mut [f64]) {
    let n = polygon.len();
    let [a, b] = polygon.side(side);
    let length = a.distance(b);
    let tangent = (b - a) / length;
    let normal = tangent.perp();
    for j in 0..n {
        if order >= 1 {
            let slope = f64::from(i8::from(j == side) - i8::from(j == (side + n - 1) % n)) / length;
            let across = normal.dot(DVec2::new(out[n + j], out[2 * n + j]));
            let gradient = tangent * slope + normal * across;
            (out[n + j], out[2 * n + j]) = (gradient.x, gradient.y);
        }
        if order >= 2 {
            let (uu, uv) = (out[3 * n + j], out[4 * n + j]);
            let mixed = tangent.dot(DVec2::new(uu * normal.x + uv * normal.y, uv * normal.x - uu * normal.y));
            out[3 * n + j] = 2.0 * mixed * tangent.x * normal.x;
            out[4 * n + j] = mixed * (tangent.x * normal.y + tangent.y * normal.x);
            out[5 * n + j] = -out[3 * n + j];
        }
    }
}
