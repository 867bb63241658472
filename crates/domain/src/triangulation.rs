//! Triangulations of simple polygons that keep the boundary's points and control size and angles inside.
//!
//! The only file that names spade, which holds the constrained Delaunay triangulation while points are inserted.

use std::collections::VecDeque;

use casteljau_geom::glam::{DVec2, dvec2};
use robust::{Coord, incircle};
use spade::handles::{FixedFaceHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, Point2, PositionInTriangulation, Triangulation as _};

use crate::{DomainError, Orientation, Polygon};

mod smooth;

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;
type Face = FixedFaceHandle<InnerTag>;

/// Angle below which a triangle without boundary vertices is counted as poor, in radians (19°).
pub const POOR_INNER_ANGLE: f64 = 19.0 / 180.0 * std::f64::consts::PI;
/// Angle below which a triangle with a boundary vertex is counted as poor, in radians (10°).
pub const POOR_BOUNDARY_ANGLE: f64 = 10.0 / 180.0 * std::f64::consts::PI;

/// In the second sweep triangles below this angle are split, and none is made at a boundary edge, in radians (20°).
const RELAXED_ANGLE: f64 = 20.0 / 180.0 * std::f64::consts::PI;

/// Edges of which one is longer than this part of the other need no fan between them.
const FAN_RATIO: f64 = 0.35;

/// What [`triangulate`] aims at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangulationOptions {
    /// Angle below which a triangle is split where the boundary lets it, in radians, within [0, π/6].
    ///
    /// Up to asin(1/2) = π/6 no insertion makes two points closer than they were, so refinement ends. Default 27°.
    pub angle: f64,
    /// Most points in all; refinement stops there, and the report says so. Default one million.
    pub max_points: usize,
}

impl Default for TriangulationOptions {
    fn default() -> Self {
        Self { angle: 27f64.to_radians(), max_points: 1_000_000 }
    }
}

/// Triangles that cover a polygon, every edge of the polygon being an edge of one triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangulation {
    /// The polygon's vertices, bit by bit and in its order, then the points inside.
    pub points: Vec<DVec2>,
    /// Counter-clockwise triples of indices, the least index first, sorted.
    pub triangles: Vec<[u32; 3]>,
    /// How many of the points are the polygon's vertices.
    pub boundary: usize,
    /// What was reached.
    pub report: TriangulationReport,
}

/// Measured quality of a [`Triangulation`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangulationReport {
    /// Whether refinement ended of itself, not at the limit on points.
    pub complete: bool,
    /// Triangles that touch no boundary vertex.
    pub inner_triangles: usize,
    /// Least angle of those, in radians; π/3 where there are none.
    pub inner_angle: f64,
    /// How many of those have an angle below [`POOR_INNER_ANGLE`].
    pub inner_poor: usize,
    /// Triangles that touch a boundary vertex.
    pub boundary_triangles: usize,
    /// Least angle of those, in radians.
    pub boundary_angle: f64,
    /// How many of those have an angle below [`POOR_BOUNDARY_ANGLE`].
    pub boundary_poor: usize,
}

/// Triangulates `boundary`, a polygon whose vertices are all the boundary points wanted, collinear ones included.
///
/// `size(p)` is the longest edge wanted near p, in the polygon's unit; infinite for none. Boundary edges are never
/// split; triangles near edges that are longer than `size` asks for stay as large as these demand.
///
/// Starts from the constrained Delaunay triangulation and inserts circumcentres of triangles that are too large or
/// too thin, unless one would lie within the circle over a boundary edge (Chew's second algorithm without the
/// splitting of segments); points next to thin triangles that remain are then moved where that widens the least
/// angle around them. The same input gives the same bits.
///
/// Angles at the boundary are its own where corners are sharp, where neighbouring edges differ in length by more than
/// about ten, and where a passage is narrower than its edges are long; what remains is counted in the report.
///
/// Error: a `size` that is not positive; `angle` out of range; more boundary vertices than `max_points`; boundary
/// points that differ by less than spade resolves (1e-42 of the polygon's size).
/// Cost: about 0.5 µs a triangle on an idle core, O(n log n) for n points.
///
/// ```
/// use casteljau_domain::{Polygon, glam::dvec2, triangulation::{TriangulationOptions, triangulate}};
/// let side = |i: i32| f64::from(i) / 4.0;
/// let mut square: Vec<_> = (0..4).map(|i| dvec2(side(i), 0.0)).collect();
/// square.extend((0..4).map(|i| dvec2(1.0, side(i))));
/// square.extend((0..4).map(|i| dvec2(1.0 - side(i), 1.0)));
/// square.extend((0..4).map(|i| dvec2(0.0, 1.0 - side(i))));
/// let mesh = triangulate(&Polygon::new(square)?, &|_| 0.25, &TriangulationOptions::default())?;
/// assert!(mesh.report.complete && mesh.report.inner_poor == 0 && mesh.boundary == 16);
/// let wrong = TriangulationOptions { max_points: 3, ..Default::default() };
/// assert!(triangulate(&Polygon::new(mesh.points[..16].to_vec())?, &|_| 0.25, &wrong).is_err());
/// let tiny = Polygon::new(vec![dvec2(0.0, 0.0), dvec2(1e-50, 0.0), dvec2(1.0, 0.0), dvec2(0.0, 1.0)])?;
/// let wrong = triangulate(&tiny, &|_| 0.25, &TriangulationOptions::default()).unwrap_err();
/// assert!(matches!(wrong, casteljau_domain::DomainError::Unresolved { .. }));
/// # Ok::<(), casteljau_domain::DomainError>(())
/// ```
pub fn triangulate(
    boundary: &Polygon,
    size: &dyn Fn(DVec2) -> f64,
    options: &TriangulationOptions,
) -> Result<Triangulation, DomainError> {
    let (least, most) = (0.0, std::f64::consts::FRAC_PI_6);
    if !(least..=most).contains(&options.angle) {
        return Err(DomainError::BadOption { option: "angle", value: options.angle, least, most });
    }
    let n = boundary.len();
    if options.max_points < n || n > u32::MAX as usize {
        let (value, least, most) = (options.max_points as f64, n as f64, f64::from(u32::MAX));
        return Err(DomainError::BadOption { option: "max_points", value, least, most });
    }
    let mut work = Refinement::new(boundary, size, options)?;
    let mut complete = work.run()?;
    if complete {
        work.relax();
        complete = work.run()?;
    }
    Ok(work.finish(boundary, complete))
}

/// A triangulation on the way.
struct Refinement<'a> {
    cdt: Cdt,
    /// Faces of the start that lie outside; all others, and all that come later, lie inside.
    outside: Vec<bool>,
    /// Faces to look at.
    queue: VecDeque<Face>,
    /// Edges of the cavity still to cross.
    cavity: Vec<spade::handles::FixedDirectedEdgeHandle>,
    size: &'a dyn Fn(DVec2) -> f64,
    /// Power of two that brings the polygon to a size near 1, for which spade is made.
    scale: f64,
    /// (1/(2 sin angle))²: squared bound on circumradius over shortest edge.
    ratio: f64,
    /// Whether points are kept out of the circles over boundary edges, or only from making thin triangles there.
    strict: bool,
    max_points: usize,
}

fn position(p: Point2<f64>) -> DVec2 {
    dvec2(p.x, p.y)
}

fn coord(p: DVec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// Refused by the Delaunay triangulation, whatever the reason: two points that it cannot tell apart.
fn unresolved(scale: f64) -> DomainError {
    DomainError::Unresolved { size: f64::EPSILON / scale }
}

impl<'a> Refinement<'a> {
    fn new(
        boundary: &Polygon,
        size: &'a dyn Fn(DVec2) -> f64,
        options: &TriangulationOptions,
    ) -> Result<Self, DomainError> {
        let [low, high] = boundary.bounding_box();
        let exponent = ((high - low).max_element().to_bits() >> 52) as i32 - 1023;
        let scale = 2f64.powi(-exponent);
        // spade refuses coordinates below 1e-43 other than 0; in a polygon of size 1 they are 0 for its purposes.
        let flush = |x: f64| if x.abs() < 1e-42 { 0.0 } else { x };
        let n = boundary.len();
        let sites: Vec<_> =
            boundary.vertices().iter().map(|p| Point2::new(flush(p.x * scale), flush(p.y * scale))).collect();
        let edges = (0..n).map(|i| [i, (i + 1) % n]).collect();
        let mut conflicts = 0;
        let cdt = Cdt::try_bulk_load_cdt(sites, edges, |_| conflicts += 1).map_err(|_| unresolved(scale))?;
        if conflicts > 0 || cdt.num_vertices() != n || cdt.num_constraints() != n {
            return Err(unresolved(scale));
        }
        let sine = options.angle.sin();
        let mut work = Self {
            outside: vec![true; cdt.num_inner_faces() + 1],
            queue: VecDeque::new(),
            cavity: Vec::new(),
            size,
            scale,
            ratio: 0.25 / (sine * sine),
            strict: true,
            max_points: options.max_points,
            cdt,
        };
        work.flood(boundary.orientation());
        Ok(work)
    }

    /// Marks and queues the faces inside: those left of the boundary, and whatever can be reached from them.
    fn flood(&mut self, orientation: Orientation) {
        let n = self.cdt.num_vertices();
        let mut stack = Vec::new();
        for edge in self.cdt.directed_edges() {
            let (from, to) = (edge.from().fix().index(), edge.to().fix().index());
            let follows = match orientation {
                Orientation::CounterClockwise => to == (from + 1) % n,
                Orientation::Clockwise => from == (to + 1) % n,
            };
            if edge.is_constraint_edge() && follows {
                stack.extend(edge.face().as_inner().map(|f| f.fix()));
            }
        }
        while let Some(face) = stack.pop() {
            if std::mem::replace(&mut self.outside[face.index()], false) {
                self.queue.push_back(face);
                let crossable = self.cdt.face(face).adjacent_edges();
                stack.extend(
                    crossable
                        .into_iter()
                        .filter(|e| !e.is_constraint_edge())
                        .filter_map(|e| e.rev().face().as_inner().map(|f| f.fix())),
                );
            }
        }
    }

    /// Turns to the triangles that are still thin: they may be mended by points closer to the boundary.
    fn relax(&mut self) {
        self.strict = false;
        self.ratio = self.ratio.max(0.25 / (RELAXED_ANGLE.sin() * RELAXED_ANGLE.sin()));
        let inside = self.cdt.fixed_inner_faces().filter(|f| !self.is_outside(*f)).collect();
        self.queue = inside;
    }

    fn is_outside(&self, face: Face) -> bool {
        self.outside.get(face.index()).copied().unwrap_or(false)
    }

    /// Inserts points until no triangle asks for one that the boundary lets in; `false` at the limit on points.
    fn run(&mut self) -> Result<bool, DomainError> {
        // Points that split fans are not kept apart by Chew's argument, so their number is bounded.
        let mut fans = if self.strict { 0 } else { self.outside.len() };
        while let Some(face) = self.queue.pop_front() {
            let [a, b, c] = self.cdt.face(face).positions().map(position);
            let Some(center) = self.wanted(a, b, c)? else { continue };
            let limit = if self.strict { None } else { Some(RELAXED_ANGLE) };
            let point = if self.admits(face, center, limit) {
                center
            } else {
                let Some(point) = fan_point([a, b, c]).filter(|_| fans > 0) else { continue };
                if !self.admits(face, point, Some(POOR_BOUNDARY_ANGLE)) {
                    continue;
                }
                fans -= 1;
                point
            };
            if self.cdt.num_vertices() >= self.max_points {
                return Ok(false);
            }
            let hint = self.cdt.face(face).vertices()[0].fix();
            let Ok(vertex) = self.cdt.insert_with_hint(Point2::new(point.x, point.y), hint) else { continue };
            let around = self.cdt.vertex(vertex);
            self.queue.extend(around.out_edges().filter_map(|e| e.face().as_inner().map(|f| f.fix())));
        }
        Ok(true)
    }

    /// The circumcentre of a triangle that is too large or too thin.
    fn wanted(&self, a: DVec2, b: DVec2, c: DVec2) -> Result<Option<DVec2>, DomainError> {
        let (p, q) = (b - a, c - a);
        let (pp, qq, rr) = (p.length_squared(), q.length_squared(), (q - p).length_squared());
        let area = p.perp_dot(q);
        let longest = pp.max(qq).max(rr);
        let shortest = pp.min(qq).min(rr);
        let circumradius_squared = pp * qq * rr / (4.0 * area * area);
        let thin = circumradius_squared > self.ratio * shortest || area <= 0.0;
        if !thin {
            if !self.strict {
                return Ok(None);
            }
            let middle = (a + b + c) / (3.0 * self.scale);
            let size = (self.size)(middle);
            if size.is_nan() || size <= 0.0 {
                let (least, most) = (f64::MIN_POSITIVE, f64::INFINITY);
                return Err(DomainError::BadOption { option: "size", value: size, least, most });
            }
            let size = size * self.scale;
            if longest <= size * size {
                return Ok(None);
            }
        }
        let center = a + dvec2(q.y * pp - p.y * qq, p.x * qq - q.x * pp) / (2.0 * area);
        Ok(center.is_finite().then_some(center))
    }

    /// Whether `point` lies inside, off all edges of the boundary, and outside the circle over each boundary edge
    /// that would see it; with a `limit`, whether no triangle over such an edge has a smaller angle.
    fn admits(&mut self, face: Face, point: DVec2, limit: Option<f64>) -> bool {
        let start = self.cdt.face(face).vertices()[0].fix();
        match self.cdt.locate_with_hint(Point2::new(point.x, point.y), start) {
            PositionInTriangulation::OnFace(f) if !self.is_outside(f) => {
                self.cavity.clear();
                self.cavity.extend(self.cdt.face(f).adjacent_edges().map(|e| e.fix()));
            }
            PositionInTriangulation::OnEdge(e) => {
                let edge = self.cdt.directed_edge(e);
                let inside = edge.face().as_inner().is_some_and(|f| !self.is_outside(f.fix()));
                if edge.is_constraint_edge() || !inside {
                    return false;
                }
                self.cavity.clear();
                for edge in [edge, edge.rev()] {
                    self.cavity.extend([edge.next().fix(), edge.prev().fix()]);
                }
            }
            _ => return false,
        }
        while let Some(edge) = self.cavity.pop() {
            let edge = self.cdt.directed_edge(edge);
            let [from, to] = edge.positions().map(position);
            if edge.is_constraint_edge() {
                let blocked = match limit {
                    None => (from - point).dot(to - point) <= 0.0,
                    Some(limit) => least_angle(from, to, point) < limit,
                };
                if blocked {
                    return false;
                }
                continue;
            }
            let across = edge.rev();
            let Some(opposite) = across.opposite_position().map(position) else { continue };
            if incircle(coord(to), coord(from), coord(opposite), coord(point)) > 0.0 {
                self.cavity.extend([across.next().fix(), across.prev().fix()]);
            }
        }
        true
    }

    fn finish(self, boundary: &Polygon, complete: bool) -> Triangulation {
        let n = boundary.len();
        let mut points = boundary.vertices().to_vec();
        points.extend(self.cdt.vertices().skip(n).map(|v| position(v.position()) / self.scale));
        let mut triangles: Vec<[u32; 3]> = self
            .cdt
            .inner_faces()
            .filter(|f| !self.is_outside(f.fix()))
            .map(|f| {
                let [a, b, c] = f.vertices().map(|v| v.fix().index() as u32);
                if a < b && a < c {
                    [a, b, c]
                } else if b < c {
                    [b, c, a]
                } else {
                    [c, a, b]
                }
            })
            .collect();
        triangles.sort_unstable();
        smooth::widen(&mut points, &triangles, n);
        let report = measure(&points, &triangles, n, complete);
        Triangulation { points, triangles, boundary: n, report }
    }
}

/// A point that halves the angle between the shortest and the longest edge of a thin triangle, at the geometric mean
/// of their lengths; `None` if the triangle is not poor, or the angle too small to be halved.
///
/// Where boundary edges of very unlike lengths meet, a fan of such triangles leads from one length to the other.
fn fan_point(mut p: [DVec2; 3]) -> Option<DVec2> {
    // Afterwards p[0]p[1] is the shortest edge and p[0]p[2] the longest.
    let opposite = |p: &[DVec2; 3], i: usize| p[(i + 1) % 3].distance_squared(p[(i + 2) % 3]);
    let length = [0, 1, 2].map(|i| opposite(&p, i));
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| length[*i].total_cmp(&length[*j]));
    let [short, middle, long] = order;
    p = [p[middle], p[long], p[short]];
    let (s, l) = (p[1] - p[0], p[2] - p[0]);
    let angle = s.angle_to(l).abs();
    if angle < 3.0 * POOR_BOUNDARY_ANGLE || s.length() > FAN_RATIO * l.length() {
        return None;
    }
    let half = (s.normalize() + l.normalize()).normalize();
    let point = p[0] + half * (s.length() * l.length()).sqrt();
    point.is_finite().then_some(point)
}

/// Least angle of a triangle, in radians; 0 or less for one that is flat or clockwise.
pub(super) fn least_angle(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    // The least angle lies opposite the shortest edge, between the two others.
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let (x, y, z) = (ab.length_squared(), bc.length_squared(), ca.length_squared());
    let (p, q) = if x <= y && x <= z {
        (ca, bc)
    } else if y <= z {
        (ab, ca)
    } else {
        (bc, ab)
    };
    ab.perp_dot(-ca).atan2(-p.dot(q))
}

fn measure(points: &[DVec2], triangles: &[[u32; 3]], boundary: usize, complete: bool) -> TriangulationReport {
    let mut report = TriangulationReport {
        complete,
        inner_triangles: 0,
        inner_angle: std::f64::consts::FRAC_PI_3,
        inner_poor: 0,
        boundary_triangles: 0,
        boundary_angle: std::f64::consts::FRAC_PI_3,
        boundary_poor: 0,
    };
    for t in triangles {
        let [a, b, c] = t.map(|i| points[i as usize]);
        let angle = least_angle(a, b, c);
        if (t[0] as usize) < boundary {
            report.boundary_triangles += 1;
            report.boundary_angle = report.boundary_angle.min(angle);
            report.boundary_poor += usize::from(angle < POOR_BOUNDARY_ANGLE);
        } else {
            report.inner_triangles += 1;
            report.inner_angle = report.inner_angle.min(angle);
            report.inner_poor += usize::from(angle < POOR_INNER_ANGLE);
        }
    }
    report
}
