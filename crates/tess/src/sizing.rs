//! How large triangles may be where: samples of the surface, the plane they are drawn in, and the field of sizes.

use casteljau_domain::Polygon;
use casteljau_domain::triangulation::{TriangulationOptions, triangulate};
use casteljau_gb::Location;
use casteljau_geom::glam::{DMat2, DVec2, DVec3};

use crate::TessError;
use crate::measure::bulge;
use crate::surface::Surface;

/// A stretch of the domain beyond this is not evened out: the samples are then not to be trusted.
const MOST_STRETCH: f64 = 16.0;
/// Pieces that a side is cut into at most for the samples.
const MOST_PIECES: usize = 24;

/// A quadratic form e·x² + 2f·xy + g·y².
#[derive(Clone, Copy, Debug, PartialEq)]
struct Form {
    e: f64,
    f: f64,
    g: f64,
}

impl Form {
    /// The form that has these values on the edges of a triangle, each opposite the corner of its number.
    ///
    /// Σ_k (½Σq − q_k)·(w_k^⊥·x)²/(2A)², since w_k^⊥·w_k = 0 and w_k^⊥·w_j = ±2A for the other two edges.
    fn on_edges([a, b, c]: [DVec2; 3], values: [f64; 3]) -> Self {
        let edges = [c - b, a - c, b - a];
        let square = (b - a).perp_dot(c - a).powi(2);
        let half = 0.5 * (values[0] + values[1] + values[2]);
        let mut form = Self { e: 0.0, f: 0.0, g: 0.0 };
        for (edge, value) in edges.into_iter().zip(values) {
            let share = (half - value) / square;
            form.e += share * edge.y * edge.y;
            form.f -= share * edge.x * edge.y;
            form.g += share * edge.x * edge.x;
        }
        form
    }

    fn matrix(&self) -> DMat2 {
        DMat2::from_cols(DVec2::new(self.e, self.f), DVec2::new(self.f, self.g))
    }
}

/// One triangle of a coarse mesh over the domain.
struct Probe {
    /// Its centroid.
    place: DVec2,
    area: f64,
    /// The first fundamental form: squares of the chords over the edges.
    first: Form,
    /// The second one, by how the normals turn along the edges; none where a corner has no normal.
    second: Option<Form>,
}

/// What the surface is like all over the domain: fundamental forms, averaged over the triangles of a coarse mesh.
pub(crate) struct Probes {
    all: Vec<Probe>,
}

impl Probes {
    /// About `count` triangles.
    pub fn new(surface: &dyn Surface, index: usize, count: usize) -> Result<Self, TessError> {
        let wrong = |source| TessError::Domain { patch: index, source };
        let polygon = surface.domain();
        let spacing = (polygon.signed_area().abs() * 2.3 / count as f64).sqrt() * 1.4;
        let mut locations = outline(polygon, spacing);
        let boundary = locations.iter().filter_map(|&location| polygon.at(location)).collect();
        let boundary = Polygon::new(boundary).map_err(wrong)?;
        let options = TriangulationOptions { angle: 0.3, max_points: 4 * count + boundary.len() };
        let coarse = triangulate(&boundary, &|_| spacing, &options).map_err(wrong)?;
        locations.extend(coarse.points[coarse.boundary..].iter().map(|&p| Location::Inside(p)));
        let mut points = vec![DVec3::ZERO; locations.len()];
        let mut normals = points.clone();
        surface.sample(&locations, &mut points, Some(&mut normals)).map_err(|fault| fault.of(index))?;

        let probe = |corners: &[u32; 3]| {
            let corners = corners.map(|i| i as usize);
            let [a, b, c] = corners.map(|i| coarse.points[i]);
            let edges = [0, 1, 2].map(|k| [corners[(k + 1) % 3], corners[(k + 2) % 3]]);
            let chords = edges.map(|[i, j]| points[i].distance_squared(points[j]));
            // II(w, w) = −dN·dX.
            let turns = edges.map(|[i, j]| -8.0 * bulge(points[i], normals[i], points[j], normals[j]));
            let known = corners.iter().all(|&i| normals[i] != DVec3::ZERO);
            Probe {
                place: (a + b + c) / 3.0,
                area: 0.5 * (b - a).perp_dot(c - a),
                first: Form::on_edges([a, b, c], chords),
                second: known.then(|| Form::on_edges([a, b, c], turns)),
            }
        };
        Ok(Self { all: coarse.triangles.iter().map(probe).collect() })
    }

    /// The linear map of the domain after which the patch is, on the average over its area, no longer stretched: A = √M with M
    /// the mean of G/√det G, G the first fundamental form, of determinant 1.
    pub fn evened(&self) -> DMat2 {
        let mut mean = [0.0; 3];
        for &Probe { first: Form { e, f, g }, area, .. } in &self.all {
            let root = (e * g - f * f).sqrt();
            let part = [e, f, g].map(|x| x / root * area);
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
        let size = |probe: &Probe| {
            let Some(second) = probe.second else { return f64::INFINITY };
            let second = second.matrix();
            let second = back.transpose() * second * back;
            let (x, y, z) = (second.x_axis.x, second.x_axis.y, second.y_axis.y);
            let norm = 0.5 * (x + z).abs() + (0.25 * (x - z) * (x - z) + y * y).sqrt();
            let size = (6.0 * tolerance / norm).sqrt();
            if size.is_nan() { f64::INFINITY } else { size }
        };
        self.all.iter().map(size).collect()
    }

    pub fn len(&self) -> usize {
        self.all.len()
    }

    /// Where the samples are in the domain.
    pub fn places(&self) -> impl Iterator<Item = DVec2> {
        self.all.iter().map(|probe| probe.place)
    }

    /// Vertices that a mesh with these edges would have.
    pub fn expected(&self, sizes: &[f64]) -> f64 {
        // Equilateral triangles of edge 0.7·size, two a vertex.
        self.all.iter().zip(sizes).map(|(probe, size)| probe.area / (0.42 * size * size)).sum()
    }
}

/// The corners of a polygon and places between them, about `spacing` apart.
fn outline(polygon: &Polygon, spacing: f64) -> Vec<Location> {
    let n = polygon.len();
    let mut locations = Vec::new();
    for corner in 0..n {
        locations.push(Location::Corner(corner));
        let side = (corner + 1) % n;
        let length = polygon.vertices()[corner].distance(polygon.vertices()[side]);
        let pieces = ((length / spacing).ceil() as usize).clamp(1, MOST_PIECES);
        let between = (1..pieces).map(|i| i as f64 / pieces as f64);
        locations.extend(between.map(|t| Location::Side { side, t }));
    }
    locations
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
        for (place, &size) in probes.places().zip(sizes) {
            self.lower(plane * place, size);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use casteljau_geom::glam::dvec2;

    #[test]
    fn a_form_is_known_by_its_values_on_the_edges() {
        let corners = [dvec2(0.25, -1.0), dvec2(3.0, 0.5), dvec2(-1.0, 2.0)];
        let form = Form { e: 2.0, f: -0.75, g: 0.5 };
        let value = |w: DVec2| form.matrix().mul_vec2(w).dot(w);
        let values = [0, 1, 2].map(|k| value(corners[(k + 2) % 3] - corners[(k + 1) % 3]));
        let found = Form::on_edges(corners, values);
        for (found, exact) in [(found.e, form.e), (found.f, form.f), (found.g, form.g)] {
            // A few roundings of the largest value over the square of the area.
            assert!((found - exact).abs() < 1e-14, "{found} {exact}");
        }
    }
}
