//! The polygon as the solver sees it: counter-clockwise, of diameter about 1, in complex numbers.

use casteljau_geom::glam::DVec2;
use num_complex::Complex64;

use crate::{Orientation, Polygon};

/// `Im(conj(a)·b)`, the cross product of two plane vectors.
pub(super) fn cross(a: Complex64, b: Complex64) -> f64 {
    a.re * b.im - a.im * b.re
}

/// `Re(conj(a)·b)`, their scalar product.
pub(super) fn dot(a: Complex64, b: Complex64) -> f64 {
    a.re * b.re + a.im * b.im
}

/// Distance of `p` from the segment from `a` to `b`.
pub(super) fn segment_distance(p: Complex64, a: Complex64, b: Complex64) -> f64 {
    let d = b - a;
    let t = (dot(d, p - a) / d.norm_sqr()).clamp(0.0, 1.0);
    (p - a - d * t).norm()
}

/// A similarity from the user's plane to the solver's, which turns clockwise polygons over.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    origin: DVec2,
    /// Solver units in a unit of the user's.
    pub(super) scale: f64,
    /// −1 where v is turned over.
    pub(super) flip: f64,
}

impl Frame {
    /// The solver's image of `p`.
    pub(super) fn to_solver(self, p: DVec2) -> Complex64 {
        let d = (p - self.origin) * self.scale;
        Complex64::new(d.x, self.flip * d.y)
    }
}

/// Vertices, angles and distances of the polygon; side k runs from vertex k to vertex k + 1.
#[derive(Clone, Debug)]
pub(super) struct Outline {
    pub(super) vertices: Vec<Complex64>,
    /// Interior angles ω in (0, 2π).
    pub(super) angles: Vec<f64>,
    /// For each corner the distance to the nearest other corner or side that is not its own.
    pub(super) gaps: Vec<f64>,
}

impl Outline {
    /// The outline and the frame it is seen in.
    pub(super) fn new(polygon: &Polygon) -> (Self, Frame) {
        let [min, max] = polygon.bounding_box();
        let flip = if polygon.orientation() == Orientation::Clockwise { -1.0 } else { 1.0 };
        let frame = Frame { origin: 0.5 * (min + max), scale: 1.0 / (max - min).length(), flip };
        let vertices: Vec<_> = polygon.vertices().iter().map(|&p| frame.to_solver(p)).collect();
        let n = vertices.len();
        let angles = (0..n)
            .map(|k| {
                let (to_last, to_next) =
                    (vertices[(k + n - 1) % n] - vertices[k], vertices[(k + 1) % n] - vertices[k]);
                let omega = (to_last / to_next).arg();
                if omega <= 0.0 { omega + std::f64::consts::TAU } else { omega }
            })
            .collect();
        let gaps = (0..n)
            .map(|k| {
                let own = |j: usize| j == k || (j + 1) % n == k;
                let sides = (0..n)
                    .filter(|&j| !own(j))
                    .map(|j| segment_distance(vertices[k], vertices[j], vertices[(j + 1) % n]));
                sides
                    .chain([(k + 1) % n, (k + n - 1) % n].map(|j| (vertices[j] - vertices[k]).norm()))
                    .fold(f64::INFINITY, f64::min)
            })
            .collect();
        (Self { vertices, angles, gaps }, frame)
    }

    pub(super) fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Vertex k, cyclic.
    pub(super) fn vertex(&self, k: usize) -> Complex64 {
        self.vertices[k % self.len()]
    }

    /// Whether harmonic functions with linear boundary values have a singularity at corner k.
    ///
    /// They behave there like r^(jπ/ω); where π/ω is an integer of 2 or more all of these are polynomials, and where it
    /// is 1 a change of slope brings in r log r. In very sharp corners r^(π/ω) is nothing at all.
    pub(super) fn is_singular(&self, k: usize) -> bool {
        let alpha = std::f64::consts::PI / self.angles[k];
        let smooth = (alpha - alpha.round()).abs() < 1e-9 && alpha > 1.5;
        alpha < 24.0 && !smooth
    }

    /// Direction of the side that leaves corner k.
    pub(super) fn direction(&self, k: usize) -> f64 {
        (self.vertex(k + 1) - self.vertices[k]).arg()
    }
}
