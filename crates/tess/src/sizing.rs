//! How large triangles may be where: samples of the surface, the plane they are drawn in, and the field of sizes.

use casteljau_domain::triangulation::{TriangulationOptions, triangulate};
use casteljau_gb::{Location, SurfaceJet};
use casteljau_geom::glam::{DMat2, DVec2};

use crate::TessError;
use crate::surface::Surface;

/// A stretch of the domain beyond this is not evened out: the samples are then not to be trusted.
const MOST_STRETCH: f64 = 16.0;
/// Pieces that an edge of a coarse triangle is cut into at most, to sample it.
const MOST_CUTS: usize = 16;

/// Jets spread evenly over the inside of the domain, with the area that each stands for.
pub(crate) struct Probes {
    places: Vec<DVec2>,
    areas: Vec<f64>,
    jets: Vec<SurfaceJet>,
}

impl Probes {
    /// About `count` samples: centroids of a coarse triangulation, of which large triangles, as there are in narrow arms,
    /// are cut up.
    pub fn new(surface: &dyn Surface, index: usize, count: usize) -> Result<Self, TessError> {
        let polygon = surface.domain();
        let spacing = (polygon.signed_area().abs() * 2.3 / count as f64).sqrt() * 1.4;
        let options = TriangulationOptions { angle: 0.3, max_points: 4 * count + polygon.len() };
        let coarse = triangulate(polygon, &|_| spacing, &options)
            .map_err(|source| TessError::Domain { patch: index, source })?;
        let (mut places, mut areas) = (Vec::new(), Vec::new());
        for t in &coarse.triangles {
            let [a, b, c] = t.map(|i| coarse.points[i as usize]);
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            let cuts = ((longest / spacing).ceil() as usize).clamp(1, MOST_CUTS);
            let area = 0.5 * (b - a).perp_dot(c - a) / (cuts * cuts) as f64;
            let at = |i: f64, j: f64| a + (b - a) * (i / cuts as f64) + (c - a) * (j / cuts as f64);
            for i in 0..cuts {
                for j in 0..cuts - i {
                    let (x, y) = (i as f64, j as f64);
                    places.push(at(x + 1.0 / 3.0, y + 1.0 / 3.0));
                    areas.push(area);
                    if i + j + 1 < cuts {
                        places.push(at(x + 2.0 / 3.0, y + 2.0 / 3.0));
                        areas.push(area);
                    }
                }
            }
        }
        let locations: Vec<Location> = places.iter().map(|&p| Location::Inside(p)).collect();
        let mut jets = vec![SurfaceJet::default(); places.len()];
        surface.jets(&locations, &mut jets).map_err(|fault| fault.of(index))?;
        Ok(Self { places, areas, jets })
    }

    /// The linear map of the domain after which the patch is, on the average over its area, no longer stretched: A = √M with M
    /// the mean of G/√det G, G the first fundamental form, of determinant 1.
    pub fn evened(&self) -> DMat2 {
        let mut mean = [0.0; 3];
        for (jet, area) in self.jets.iter().zip(&self.areas) {
            let form = jet.first_form();
            let root = (form.e * form.g - form.f * form.f).sqrt();
            let part = [form.e, form.f, form.g].map(|x| x / root * area);
            if part.iter().all(|x| x.is_finite())
                && part[0] + part[2] < 2.0 * MOST_STRETCH * MOST_STRETCH * area
            {
                mean.iter_mut().zip(part).for_each(|(sum, x)| *sum += x);
            }
        }
        let root = (mean[0] * mean[2] - mean[1] * mean[1]).sqrt();
        let [e, f, g] = mean.map(|x| x / root);
        let trace = e + g;
        // The ratio of the eigenvalues is the square of the stretch.
        if !(trace.is_finite() && root > 0.0) || trace > MOST_STRETCH + 1.0 / MOST_STRETCH {
            return DMat2::IDENTITY;
        }
        // √M = (M + √det M·I)/√(tr M + 2√det M).
        let scale = (trace + 2.0).sqrt().recip();
        DMat2::from_cols(DVec2::new(e + 1.0, f) * scale, DVec2::new(f, g + 1.0) * scale)
    }

    /// Longest edge at each sample, in the plane that `plane` leads to, for that chord tolerance.
    ///
    /// An edge w leaves the surface by |II(w,w)|/8 at its middle and an equilateral triangle by up to |II|·w²/6 at its
    /// centre; the latter decides.
    pub fn sizes(&self, plane: DMat2, tolerance: f64) -> Vec<f64> {
        let back = plane.inverse();
        let size = |jet: &SurfaceJet| {
            let Some(form) = jet.second_form() else { return f64::INFINITY };
            let second = DMat2::from_cols(DVec2::new(form.l, form.m), DVec2::new(form.m, form.n));
            let second = back.transpose() * second * back;
            let (x, y, z) = (second.x_axis.x, second.x_axis.y, second.y_axis.y);
            let norm = 0.5 * (x + z).abs() + (0.25 * (x - z) * (x - z) + y * y).sqrt();
            let size = (6.0 * tolerance / norm).sqrt();
            if size.is_nan() { f64::INFINITY } else { size }
        };
        self.jets.iter().map(size).collect()
    }

    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Where the samples are in the domain.
    pub fn places(&self) -> impl Iterator<Item = DVec2> {
        self.places.iter().copied()
    }

    /// Vertices that a mesh with these edges would have.
    pub fn expected(&self, sizes: &[f64]) -> f64 {
        // Equilateral triangles of edge 0.7·size, two a vertex.
        self.areas.iter().zip(sizes).map(|(area, size)| area / (0.42 * size * size)).sum()
    }
}

/// A length at the nodes of a grid, interpolated between them.
pub(crate) struct SizeField {
    origin: DVec2,
    spacing: f64,
    columns: usize,
    rows: usize,
    lengths: Vec<f64>,
}

impl SizeField {
    /// A grid of about `count` nodes around the points, with that length everywhere.
    pub fn new(points: &[DVec2], count: usize, length: f64) -> Self {
        let low = points.iter().fold(DVec2::INFINITY, |low, p| low.min(*p));
        let high = points.iter().fold(DVec2::NEG_INFINITY, |high, p| high.max(*p));
        let extent = high - low;
        let longest = extent.max_element();
        let spacing = (extent.x * extent.y / count as f64).sqrt().max(longest / count as f64);
        let columns = (extent.x / spacing).ceil() as usize + 2;
        let rows = (extent.y / spacing).ceil() as usize + 2;
        let origin = low - DVec2::splat(0.5 * spacing);
        Self { origin, spacing, columns, rows, lengths: vec![length; columns * rows] }
    }

    /// Sets every node.
    pub fn set(&mut self, length: impl Fn(DVec2) -> f64) {
        for row in 0..self.rows {
            for column in 0..self.columns {
                let at = self.origin + DVec2::new(column as f64, row as f64) * self.spacing;
                self.lengths[row * self.columns + column] = length(at);
            }
        }
    }

    /// Lowers the node next to `at`.
    pub fn lower(&mut self, at: DVec2, length: f64) {
        let place = ((at - self.origin) / self.spacing).round().max(DVec2::ZERO);
        let (column, row) = ((place.x as usize).min(self.columns - 1), (place.y as usize).min(self.rows - 1));
        let node = &mut self.lengths[row * self.columns + column];
        *node = node.min(length);
    }

    /// Lowers every node to what its neighbours allow: a length grows by `growth` per unit of distance at most.
    pub fn spread(&mut self, growth: f64) {
        let (straight, slanted) = (growth * self.spacing, growth * self.spacing * std::f64::consts::SQRT_2);
        let (columns, rows) = (self.columns as isize, self.rows as isize);
        let before = [(-1, 0, straight), (0, -1, straight), (-1, -1, slanted), (1, -1, slanted)];
        for _ in 0..2 {
            for direction in [1, -1] {
                let count = columns * rows;
                for step in 0..count {
                    let node = if direction > 0 { step } else { count - 1 - step };
                    let (column, row) = (node % columns, node / columns);
                    for (dx, dy, more) in before {
                        let (x, y) = (column + direction * dx, row + direction * dy);
                        if (0..columns).contains(&x) && (0..rows).contains(&y) {
                            let allowed = self.lengths[(y * columns + x) as usize] + more;
                            let length = &mut self.lengths[node as usize];
                            *length = length.min(allowed);
                        }
                    }
                }
            }
        }
    }

    /// The length at a place, bilinear between the nodes.
    #[inline]
    pub fn at(&self, place: DVec2) -> f64 {
        let last = DVec2::new((self.columns - 2) as f64, (self.rows - 2) as f64);
        let place = ((place - self.origin) / self.spacing).clamp(DVec2::ZERO, last + 0.999_999);
        let (column, row) = (place.x as usize, place.y as usize);
        let (x, y) = (place.x - column as f64, place.y - row as f64);
        let node = row * self.columns + column;
        let below = self.lengths[node] * (1.0 - x) + self.lengths[node + 1] * x;
        let above = self.lengths[node + self.columns] * (1.0 - x) + self.lengths[node + self.columns + 1] * x;
        below * (1.0 - y) + above * y
    }

    /// Places of the samples as the field wants them.
    pub fn lower_all(&mut self, probes: &Probes, plane: DMat2, sizes: &[f64]) {
        for (&place, &size) in probes.places.iter().zip(sizes) {
            self.lower(plane * place, size);
        }
    }
}
