//! The closest point of a triangle.

use casteljau_bernstein::{TriangleNet, elevate, last_barycentric};
use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_geom::{Interval, UNIT_ROUNDOFF};

use super::net::{LocalNet, check_weights, positive};
use super::newton::descend;
use super::patch::{PatchProjector, Place};
use super::tree::Cuts;
use super::{LocalMinima, LocalMinimum, LocalProjection, Projection, check_query};
use crate::{BezierTriangle, ControlPoint, ShapeError};

/// A triangle prepared for questions about its closest points, `min |S(λ₁,λ₂) − q|` over `λ ≥ 0`.
///
/// The triangle is the image of a square one of whose sides collapses to a vertex, the *apex*: with
/// `λ₁ = 1 − s`, `λ₂ = s(1 − t)`, `λ₃ = st` the points of equal λ₁ form a row of the net of degree n − i, which is
/// elevated to n. So the patch's search and its proofs serve triangles, too.
///
/// ```
/// use casteljau_shape::{Triangle, TriangleProjector, geom::glam::DVec3};
/// let triangle = Triangle::new(1, [DVec3::ZERO, DVec3::X, DVec3::Y])?;
/// let projector = TriangleProjector::new(&triangle)?;
/// let foot = projector.closest_point(DVec3::new(0.75, -1.0, 0.0))?; // beside the edge from vertex 1 to vertex 2
/// assert_eq!((foot.parameters, foot.distance), ([0.25, 0.75], 1.0));
/// assert!(foot.lower_bound > 1.0 - 1e-12);
/// # Ok::<(), casteljau_shape::ShapeError>(())
/// ```
///
/// Source: Duffy, "Quadrature over a pyramid or cube of integrands with a singularity at a vertex", SIAM J. Numer.
/// Anal. 19 (1982), for the map.
#[derive(Debug, Clone)]
pub struct TriangleProjector {
    control_points: Vec<DVec4>,
    degree: usize,
    /// The square with its apex at vertex `apex`.
    square: PatchProjector,
    apex: usize,
    /// The nets of the squares with the apex at each of the vertices: one of them is far from any place.
    nets: [LocalNet; 3],
}

impl TriangleProjector {
    /// Prepares a polynomial or rational triangle: cuts it into at most 512 pieces, and each edge into at most 64.
    ///
    /// Cost: that of a patch of degree n × n.
    ///
    /// # Errors
    /// [`ShapeError::Weight`] unless all weights have one sign.
    pub fn new<P: ControlPoint>(triangle: &BezierTriangle<P>) -> Result<Self, ShapeError> {
        let degree = triangle.degree();
        let control_points = positive(triangle.control_points());
        check_weights(&control_points)?;
        // An edge that is a point is kept apart from the apex, so that each has a side of its own.
        let mut apex = None;
        for vertex in [2, 1, 0] {
            if is_point(triangle.edge(vertex)?.control_points()) {
                apex = Some(vertex);
            }
        }
        let cuts = Cuts { apices: [true, apex.is_some()] };
        let apex = apex.unwrap_or(0);
        let mut squares = [const { Vec::new() }; 3];
        for (vertex, net) in squares.iter_mut().enumerate() {
            *net = square_net(&control_points, degree, vertex)?;
        }
        let degrees = [degree, degree];
        let [a, b, c] = &squares;
        let nets = [LocalNet::new(a, degrees)?, LocalNet::new(b, degrees)?, LocalNet::new(c, degrees)?];
        let square =
            PatchProjector::of_net(std::mem::take(&mut squares[apex]), degrees, [Interval::UNIT; 2], cuts)?;
        Ok(Self { control_points, degree, square, apex, nets })
    }

    /// The closest point of the whole triangle, edges and vertices included, with a lower bound of the distance
    /// as its certificate; the parameters are (λ₁, λ₂).
    ///
    /// Of several closest points one is given, always the same. Cost: that of a patch of degree n × n, more where
    /// the tree does not decide.
    ///
    /// # Errors
    /// [`ShapeError::Query`] for a q that is not finite or beyond
    /// [`LARGEST_COORDINATE`](crate::LARGEST_COORDINATE), in itself or measured by the triangle's size.
    pub fn closest_point(&self, q: DVec3) -> Result<Projection<2>, ShapeError> {
        let (place, lower) = self.square.nearest(q)?;
        let parameters = parameters(barycentric(place, self.apex));
        let (point, distance) = self.measured(q, parameters);
        let lower_bound = self.square.interior.net.certified(lower, distance);
        Ok(Projection { parameters, point, distance, lower_bound })
    }

    /// The local minimum of the distance that Newton's method reaches from `start`, (λ₁, λ₂).
    ///
    /// Kept inside the triangle and from climbing; says whether it converged. For a start close to the closest
    /// point. Cost: a jet of order 2 a step.
    ///
    /// # Errors
    /// [`ShapeError::Query`] as for [`closest_point`](Self::closest_point), [`ShapeError::Parameter`] for a
    /// start that is not finite.
    pub fn closest_point_from(&self, q: DVec3, start: [f64; 2]) -> Result<LocalProjection<2>, ShapeError> {
        check_query(q, self.square.interior.net.local(q))?;
        if let Some(&value) = start.iter().find(|x| !x.is_finite()) {
            return Err(ShapeError::Parameter { value });
        }
        let mut at = start;
        let mut converged = false;
        // The square is singular at its apex: a descent that comes near it goes on with another.
        for _ in 0..MOST_SQUARES {
            let lambda = [at[0], at[1], last_barycentric(&at)];
            let apex = farthest_vertex(lambda);
            let net = &self.nets[apex];
            let end = descend(net, net.local(q), place(lambda, apex));
            let lambda = barycentric(end.at, apex);
            (at, converged) = (parameters(lambda), end.converged);
            if lambda[apex] <= 0.5 {
                break;
            }
        }
        let (point, distance) = self.measured(q, at);
        Ok(LocalProjection { parameters: at, point, distance, converged })
    }

    /// All local minima of the distance over the triangle, edges and vertices included, each proved and isolated.
    ///
    /// The uncertainty of a minimum on an edge is that of its place along the edge. An edge that is collapsed to a
    /// point counts as one minimum, given at its middle, if every direction leads away from q there. At most
    /// 20,000 pieces are looked at, and as many on each edge.
    ///
    /// # Errors
    /// [`ShapeError::Query`] as for [`closest_point`](Self::closest_point).
    pub fn local_minima(&self, q: DVec3) -> Result<LocalMinima<2>, ShapeError> {
        let found = self.square.minima(q)?;
        let mut answer = LocalMinima::default();
        let mut keep = |at, uncertainty| {
            let parameters = parameters(barycentric(at, self.apex));
            let (point, distance) = self.measured(q, parameters);
            answer.minima.push(LocalMinimum { parameters, uncertainty, point, distance });
        };
        for &known in &found.inside {
            let reach = extent(known);
            // In the box of λ there is no other minimum if there is none in what it is on the square.
            if preimage(known.at, reach).is_some_and(|area| found.convex.covers(&area)) {
                keep(known.at, parameters(turned(reach, self.apex)));
            } else {
                let [s, t] = [0, 1].map(|k| {
                    let (x, r) = (known.at[k], known.radius[k]);
                    [(x - r).max(0.0), (x + r).min(1.0)]
                });
                answer.unresolved.push(box_of([s, t], self.apex));
            }
        }
        for &known in &found.on_sides {
            keep(known.at, parameters(turned(extent(known), self.apex)));
        }
        answer.unresolved.extend(found.unresolved.iter().map(|&area| box_of(area, self.apex)));
        answer.minima.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        Ok(answer)
    }

    fn measured(&self, q: DVec3, [u, v]: [f64; 2]) -> (DVec3, f64) {
        let p = TriangleNet::validated(&self.control_points, self.degree).value([
            u,
            v,
            last_barycentric(&[u, v]),
        ]);
        let point = p.xyz() / p.w;
        (point, self.square.interior.net.distance(point, q))
    }
}

/// Squares that one descent may use: it comes near an apex at most once or twice.
const MOST_SQUARES: usize = 4;

/// The net of degree n × n of the square with its apex at a vertex: row r is the row of r + 1 control points across
/// from the vertex, elevated to degree n.
fn square_net(points: &[DVec4], degree: usize, apex: usize) -> Result<Vec<DVec4>, ShapeError> {
    let mut from_apex = vec![DVec4::ZERO; points.len()];
    let order = [apex, (apex + 1) % 3, (apex + 2) % 3];
    TriangleNet::validated(points, degree).face(order, &mut from_apex)?;
    let mut net = vec![DVec4::ZERO; (degree + 1) * (degree + 1)];
    let mut rest = &from_apex[..];
    for (r, out) in net.chunks_exact_mut(degree + 1).enumerate() {
        let (row, after) = rest.split_at(r + 1);
        elevate(row, out)?;
        rest = after;
        // Equal weights stay equal to the bit, and the apex one point.
        if row.iter().all(|p| p.w == row[0].w) {
            out.iter_mut().for_each(|p| p.w = row[0].w);
        }
        if r == 0 {
            out.fill(row[0]);
        }
    }
    Ok(net)
}

/// Whether all control points are one, but for the rounding of their quotients.
fn is_point<P: ControlPoint>(points: &[P]) -> bool {
    let mut places = points.iter().map(|p| p.euclidean().unwrap_or(DVec3::NAN));
    let first = places.next().unwrap_or_default();
    places.all(|p| p.distance(first) <= 8.0 * UNIT_ROUNDOFF * first.abs().max_element())
}

/// The vertex whose barycentric coordinate is least.
fn farthest_vertex(lambda: [f64; 3]) -> usize {
    (1..3).fold(0, |least, k| if lambda[k] < lambda[least] { k } else { least })
}

/// (λ₁, λ₂, λ₃) from numbers that belong to the apex, the next vertex and the one after it.
fn turned(from_apex: [f64; 3], apex: usize) -> [f64; 3] {
    std::array::from_fn(|k| from_apex[(k + 3 - apex) % 3])
}

/// The two that are parameters.
fn parameters([a, b, _]: [f64; 3]) -> [f64; 2] {
    [a, b]
}

/// (λ₁, λ₂, λ₃) at a place of the square; exact on edges, and of sum 1 there: s is a multiple of 2⁻⁵³ where 1 − s
/// is rounded, and so are the others.
fn barycentric([s, t]: [f64; 2], apex: usize) -> [f64; 3] {
    let first = 1.0 - s;
    let rest = 1.0 - first;
    let second = rest * (1.0 - t);
    turned([first, second, rest - second], apex)
}

/// The place of the square with such barycentric coordinates; of places outside one on an edge.
fn place(lambda: [f64; 3], apex: usize) -> [f64; 2] {
    let [first, second, third] = [0, 1, 2].map(|k| lambda[(apex + k) % 3].max(0.0));
    let across = second + third;
    let s = if across > 0.0 { across / (first + across) } else { 0.0 };
    [s, if across > 0.0 { third / across } else { 0.5 }]
}

/// How far the barycentric coordinates (from the apex on) can be from those of a place that is known within its
/// radius: `|δ(st)| ≤ s δt + t δs + δs δt`, and rounding.
fn extent(Place { at: [s, t], radius: [ds, dt] }: Place) -> [f64; 3] {
    if ds == 0.0 && dt == 0.0 {
        return [0.0; 3];
    }
    let across = s * dt + ds * dt;
    let rounding = 4.0 * UNIT_ROUNDOFF;
    [ds + rounding, across + (1.0 - t) * ds + rounding, across + t * ds + rounding]
}

/// A box of the square that holds all places whose parameters are within `reach` of those of a place; `None` where
/// that is all around the apex.
///
/// As one of the three coordinates is not given, each can change by as much as the two others together. With changes
/// a and b of `s(1−t)` and `st`, t changes by `(b(1−t) − at)/(s + a + b)`.
fn preimage([s, t]: [f64; 2], reach: [f64; 3]) -> Option<[[f64; 2]; 2]> {
    let [first, second, third] = [0, 1, 2].map(|k| reach[k].max(reach[(k + 1) % 3] + reach[(k + 2) % 3]));
    let least = s - second - third;
    if least <= 0.0 {
        return None;
    }
    let dt = (third * (1.0 - t) + second * t) / least;
    let around = |x: f64, d: f64| [(x - d).max(0.0), (x + d).min(1.0)];
    Some([around(s, first), around(t, dt)])
}

/// The box of the parameters (λ₁, λ₂) around what a box of the square is on the triangle.
fn box_of([[s0, s1], [t0, t1]]: [[f64; 2]; 2], apex: usize) -> [[f64; 2]; 2] {
    let low = turned([1.0 - s1, s0 * (1.0 - t1), s0 * t0], apex);
    let high = turned([1.0 - s0, s1 * (1.0 - t0), s1 * t1], apex);
    [0, 1].map(|k| [low[k], high[k]])
}
