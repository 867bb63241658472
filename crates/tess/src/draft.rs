//! The mesh of one patch while it is made.

use std::collections::HashSet;

use casteljau_domain::triangulation::{TriangulationOptions, triangulate};
use casteljau_domain::{DomainError, Polygon};
use casteljau_gb::Location;
use casteljau_geom::glam::{DMat2, DVec2, DVec3};

use crate::TessError;
use crate::progress::Tell;
use crate::surface::Surface;
use crate::topology::Topology;

/// Points evaluated between two looks at the progress callback.
const BATCH: usize = 8192;
/// Calls of the size function between two looks at the progress callback.
const CALLS: usize = 4096;
/// Angle that the triangulation of the domain aims at.
const AIM: f64 = 27.0 / 180.0 * std::f64::consts::PI;

/// Samples around a patch, side after side, each side without its end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outline {
    pub locations: Vec<Location>,
    pub points: Vec<DVec3>,
    /// Where each side starts in these lists.
    pub starts: Vec<usize>,
    /// Bound on the distance between the sides' curves and their chords.
    pub chord_error: f64,
}

/// What is asked of a patch's mesh.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Request<'a> {
    /// Number of the patch, for messages.
    pub patch: usize,
    pub tolerance: Option<f64>,
    pub normals: bool,
    /// Vertices that this patch may have, and the limit that they come from, for messages.
    pub room: usize,
    pub limit: usize,
    /// The model's vertex of each sample of the outline.
    pub vertices: &'a [u32],
    /// Edges between the model's vertices, the lesser first, that the patch must not have inside: another patch has them,
    /// and triangles of both would share them.
    pub taken: &'a HashSet<[u32; 2]>,
}

impl Request<'_> {
    /// Whether an inner edge between two samples of the outline belongs to others.
    pub fn forbids(&self, a: usize, b: usize) -> bool {
        match (self.vertices.get(a), self.vertices.get(b)) {
            (Some(&a), Some(&b)) => self.taken.contains(&[a.min(b), a.max(b)]),
            _ => false,
        }
    }
}

/// Vertices and triangles of one patch; the vertices of the outline come first.
pub(crate) struct Draft<'a> {
    pub surface: &'a dyn Surface,
    pub request: Request<'a>,
    pub tell: &'a Tell<'a>,
    /// From the plane that the mesh is drawn in to the domain.
    pub back: DMat2,
    /// Vertices in that plane.
    pub plane: Vec<DVec2>,
    pub points: Vec<DVec3>,
    /// Zero where there is none, or none is wanted.
    pub normals: Vec<DVec3>,
    pub boundary: usize,
    pub topology: Topology,
    /// Whether a triangle's chord error was found small since it last changed.
    pub passed: Vec<bool>,
    /// Cotangent of each triangle's least angle, NaN where it changed since it was computed.
    pub cotangents: Vec<f64>,
    /// Whether no flip of a triangle's edges helped, while it and its neighbours have not changed since.
    pub settled: Vec<bool>,
    /// Whether no better place was found for a vertex, while the triangles around it have not changed since.
    pub placed: Vec<bool>,
    pub chord_error: f64,
}

impl<'a> Draft<'a> {
    /// Triangulates the domain and evaluates the patch at the vertices.
    pub fn new(
        surface: &'a dyn Surface,
        outline: &Outline,
        request: Request<'a>,
        forth: DMat2,
        size: &dyn Fn(DVec2) -> f64,
        expected: f64,
        tell: &'a Tell<'a>,
    ) -> Result<Self, TessError> {
        let domain = surface.domain();
        let wrong = |source| TessError::Domain { patch: request.patch, source };
        // A location is one of the outline's own, so there is always a place.
        let place = |location: &Location| forth * domain.at(*location).unwrap_or(DVec2::NAN);
        let boundary: Vec<DVec2> = outline.locations.iter().map(place).collect();
        let boundary = Polygon::new(boundary).map_err(wrong)?;
        let options = TriangulationOptions { angle: AIM, max_points: request.room.max(boundary.len()) };
        let calls = std::cell::Cell::new(0usize);
        let asked = |p: DVec2| {
            calls.set(calls.get() + 1);
            // About eight calls a vertex.
            let done = 0.4 * (calls.get() as f64 / (8.0 * expected)).min(1.0);
            if calls.get().is_multiple_of(CALLS) && tell(done).is_err() {
                // Refused by the triangulation, which ends it.
                return f64::NAN;
            }
            size(p)
        };
        let mesh = match triangulate(&boundary, &asked, &options) {
            Err(DomainError::BadOption { option: "size", value, .. }) if value.is_nan() => {
                tell(0.4)?;
                return Err(wrong(DomainError::BadOption {
                    option: "size",
                    value,
                    least: 0.0,
                    most: f64::INFINITY,
                }));
            }
            result => result.map_err(wrong)?,
        };
        let count = mesh.points.len();
        let mut draft = Self {
            surface,
            request,
            tell,
            back: forth.inverse(),
            plane: mesh.points,
            points: outline.points.clone(),
            normals: Vec::new(),
            boundary: mesh.boundary,
            passed: vec![false; mesh.triangles.len()],
            cotangents: vec![f64::NAN; mesh.triangles.len()],
            settled: vec![false; mesh.triangles.len()],
            placed: vec![false; count],
            topology: Topology::new(mesh.triangles, count),
            chord_error: outline.chord_error,
        };
        if !mesh.report.complete {
            return Err(draft.too_many(expected));
        }
        draft.normals = vec![DVec3::ZERO; outline.points.len()];
        if draft.wants_normals() {
            let mut unused = vec![DVec3::ZERO; outline.points.len()];
            let mut normals = std::mem::take(&mut draft.normals);
            draft.sample(&outline.locations, &mut unused, Some(&mut normals))?;
            draft.normals = normals;
        }
        draft.evaluate_new([0.4, 0.8])?;
        Ok(draft)
    }

    pub fn wants_normals(&self) -> bool {
        self.request.normals || self.request.tolerance.is_some()
    }

    pub fn too_many(&self, expected: f64) -> TessError {
        let used = self.request.limit - self.request.room.min(self.request.limit);
        let needed = used as f64 + expected.max(self.plane.len() as f64);
        TessError::TooManyVertices { patch: self.request.patch, needed, limit: self.request.limit }
    }

    /// The place of a point of the plane in the domain.
    pub fn location(&self, at: DVec2) -> Location {
        Location::Inside(self.back * at)
    }

    /// Points of the patch, with normals where wanted.
    fn sample(
        &self,
        locations: &[Location],
        points: &mut [DVec3],
        normals: Option<&mut [DVec3]>,
    ) -> Result<(), TessError> {
        self.surface.sample(locations, points, normals).map_err(|fault| fault.of(self.request.patch))
    }

    /// Points of the patch at places of the plane.
    pub fn surface(&self, places: &[DVec2]) -> Result<Vec<DVec3>, TessError> {
        let mut points = vec![DVec3::ZERO; places.len()];
        for (places, points) in places.chunks(BATCH).zip(points.chunks_mut(BATCH)) {
            (self.tell)(0.0)?;
            let locations: Vec<Location> = places.iter().map(|&p| self.location(p)).collect();
            self.sample(&locations, points, None)?;
        }
        Ok(points)
    }

    /// Evaluates the vertices that have a place in the plane but no point yet.
    pub fn evaluate_new(&mut self, [from, to]: [f64; 2]) -> Result<(), TessError> {
        let all: Vec<u32> = (self.points.len() as u32..self.plane.len() as u32).collect();
        self.points.resize(self.plane.len(), DVec3::ZERO);
        self.normals.resize(self.plane.len(), DVec3::ZERO);
        let count = all.len().max(1) as f64;
        for (chunk, vertices) in all.chunks(BATCH).enumerate() {
            (self.tell)(from + (to - from) * (chunk * BATCH) as f64 / count)?;
            self.evaluate(vertices)?;
        }
        Ok(())
    }

    /// Evaluates inner vertices where they are now.
    pub fn evaluate(&mut self, vertices: &[u32]) -> Result<(), TessError> {
        let locations: Vec<Location> =
            vertices.iter().map(|&v| self.location(self.plane[v as usize])).collect();
        let mut points = vec![DVec3::ZERO; vertices.len()];
        let mut normals = vec![DVec3::ZERO; if self.wants_normals() { vertices.len() } else { 0 }];
        let wanted = if self.wants_normals() { Some(&mut normals[..]) } else { None };
        self.sample(&locations, &mut points, wanted)?;
        for (&vertex, point) in vertices.iter().zip(points) {
            self.points[vertex as usize] = point;
        }
        for (&vertex, normal) in vertices.iter().zip(normals) {
            self.normals[vertex as usize] = normal;
        }
        Ok(())
    }

    pub fn corners(&self, t: u32) -> [DVec3; 3] {
        self.topology.triangles[t as usize].map(|v| self.points[v as usize])
    }

    /// Whether a triangle has a vertex on the outline.
    pub fn at_boundary(&self, t: u32) -> bool {
        self.topology.triangles[t as usize].iter().any(|&v| (v as usize) < self.boundary)
    }
}
