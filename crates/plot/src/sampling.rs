//! A domain polygon's triangulation, with the places of its vertices known to the bit.

use casteljau_domain::triangulation::{TriangulationOptions, triangulate};
use casteljau_domain::{Coordinates, Location, Polygon};
use casteljau_gb::{ConcavePatch, SampleSet};
use casteljau_geom::glam::{DVec2, DVec3};

use crate::PlotError;

/// Least number of edges of the triangulation on a side.
const LEAST_PER_SIDE: usize = 8;
/// Most, however long the side is beside the others.
const MOST_PER_SIDE: usize = 200;

/// Draws parameters together at the ends that are concave corners, where everything bends most.
fn toward_concave(t: f64, concave: [bool; 2]) -> f64 {
    match concave {
        [false, false] => t,
        [true, false] => t * t,
        [false, true] => t * (2.0 - t),
        [true, true] => t * t * (3.0 - 2.0 * t),
    }
}

/// A triangulated domain.
pub(crate) struct Sampling {
    pub(crate) points: Vec<DVec2>,
    pub(crate) locations: Vec<Location>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Sampling {
    /// About `count` triangles; every side is cut into eight edges at least, its own curve being what one looks at.
    pub(crate) fn new(polygon: &Polygon, count: usize) -> Result<Self, PlotError> {
        // The area of an equilateral triangle is √3/4 of its squared edge.
        let edge = (polygon.signed_area().abs() / count.max(1) as f64 / 0.45).sqrt();
        let mut boundary = Vec::new();
        let mut locations = Vec::new();
        for side in 0..polygon.len() {
            let [a, b] = polygon.side(side);
            let pieces = (a.distance(b) / edge).ceil() as usize;
            let pieces = pieces.clamp(LEAST_PER_SIDE, MOST_PER_SIDE);
            let before = (side + polygon.len() - 1) % polygon.len();
            let concave = [polygon.is_concave(before), polygon.is_concave(side)];
            for piece in 1..pieces {
                let t = toward_concave(piece as f64 / pieces as f64, concave);
                boundary.push(a * (1.0 - t) + b * t);
                locations.push(Location::Side { side, t });
            }
            boundary.push(b);
            locations.push(Location::Corner(side));
        }
        // Rounding of the points on a very short side may fold the outline; the polygon itself is then the boundary.
        let outline = Polygon::new(boundary).or_else(|_| {
            locations = (0..polygon.len()).map(Location::Corner).collect();
            Polygon::new(polygon.vertices().to_vec())
        })?;
        // Edges come out at some 0.8 of what is asked for at most.
        let options = TriangulationOptions { max_points: 4 * count + outline.len(), ..Default::default() };
        let concave: Vec<DVec2> =
            (0..polygon.len()).filter(|&i| polygon.is_concave(i)).map(|i| polygon.vertex(i)).collect();
        let size = |p: DVec2| {
            let distance = concave.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
            1.25 * edge.min(0.25 * (edge + distance))
        };
        let mesh = triangulate(&outline, &size, &options)?;
        locations.extend(mesh.points[mesh.boundary..].iter().map(|&p| Location::Inside(p)));
        Ok(Self { points: mesh.points, locations, triangles: mesh.triangles })
    }

    /// λ at every point, n values each.
    pub(crate) fn coordinates(&self, coordinates: &Coordinates) -> Result<Vec<f64>, PlotError> {
        let set = SampleSet::new(coordinates, &self.locations, 0)?;
        let n = coordinates.len();
        let values = (0..set.len()).flat_map(|point| (0..n).map(move |vertex| (point, vertex)));
        Ok(values.map(|(point, vertex)| set.coordinate(point, 0, vertex).unwrap_or(f64::NAN)).collect())
    }

    /// Points and normals of the surface; the normal is zero where there is none.
    pub(crate) fn surface(&self, patch: &ConcavePatch) -> Result<(Vec<DVec3>, Vec<DVec3>), PlotError> {
        let set = SampleSet::new(patch.coordinates(), &self.locations, 1)?;
        let mut points = vec![DVec3::ZERO; set.len()];
        let mut normals = points.clone();
        patch.evaluate_sample_normals(&set, &mut points, &mut normals)?;
        if points.iter().all(|p| p.is_finite()) { Ok((points, normals)) } else { Err(PlotError::NotFinite) }
    }
}
