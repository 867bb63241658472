//! Angles of triangles, and distances to them.

use casteljau_geom::glam::{DVec2, DVec3};

/// Cotangent of the least angle of a triangle: the larger, the poorer; infinite without area.
#[inline]
pub(crate) fn cotangent(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (p, q, r) = (b - a, c - b, a - c);
    from_squares(p.length_squared(), q.length_squared(), r.length_squared(), p.cross(r).length())
}

/// The same in the plane; infinite for a clockwise triangle.
#[inline]
pub(crate) fn cotangent_2d(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let (p, q, r) = (b - a, c - b, a - c);
    from_squares(p.length_squared(), q.length_squared(), r.length_squared(), -p.perp_dot(r))
}

/// The least angle lies opposite the shortest edge: cot = (the other squares − its square)/(4·area).
#[inline]
fn from_squares(p: f64, q: f64, r: f64, twice_area: f64) -> f64 {
    let excess = p + q + r - 2.0 * p.min(q).min(r);
    if twice_area > 0.0 { excess / (2.0 * twice_area) } else { f64::INFINITY }
}

/// Distance from a point to a triangle, edges and corners included.
///
/// Source: Ericson, *Real-Time Collision Detection*, sec. 5.1.5.
pub(crate) fn distance_to_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let normal = ab.cross(ac);
    let square = normal.length_squared();
    if square > 0.0 {
        // Barycentric coordinates of the foot.
        let v = ap.cross(ac).dot(normal) / square;
        let w = ab.cross(ap).dot(normal) / square;
        if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
            return ap.dot(normal).abs() / square.sqrt();
        }
    }
    distance_to_segment(p, a, b).min(distance_to_segment(p, b, c)).min(distance_to_segment(p, c, a))
}

pub(crate) fn distance_to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let square = along.length_squared();
    let t = if square > 0.0 { ((p - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + along * t)
}

/// What the normals at its ends say about how far the surface leaves the chord from a to b at its middle, positive along
/// the normals: the middle of the cubic with these ends whose inner control points lie on the tangent planes.
///
/// Error: of fourth order in the chord. Source: Vlachos et al., *Curved PN triangles* (2001).
#[inline]
pub(crate) fn bulge(a: DVec3, normal_a: DVec3, b: DVec3, normal_b: DVec3) -> f64 {
    let chord = b - a;
    (chord.dot(normal_b) - chord.dot(normal_a)) / 8.0
}

/// Whether the normals at the ends of an edge are more than 60° apart: the surface bends or folds in between in a way that
/// they cannot foretell.
#[inline]
pub(crate) fn is_bend(normal_a: DVec3, normal_b: DVec3) -> bool {
    normal_a != DVec3::ZERO && normal_b != DVec3::ZERO && normal_a.dot(normal_b) < 0.5
}

#[cfg(test)]
mod tests {
    use super::*;
    use casteljau_geom::glam::dvec3;

    #[test]
    fn cotangents_and_distances_of_a_known_triangle() {
        let [a, b, c] = [DVec3::ZERO, DVec3::X * 3.0, dvec3(0.0, 1.0, 0.0)];
        assert!((cotangent(a, b, c) - 3.0).abs() < 1e-14);
        assert!((cotangent_2d(a.truncate(), b.truncate(), c.truncate()) - 3.0).abs() < 1e-14);
        assert_eq!(cotangent_2d(a.truncate(), c.truncate(), b.truncate()), f64::INFINITY);
        assert_eq!(cotangent(a, b, b), f64::INFINITY);
        assert!((distance_to_triangle(dvec3(0.5, 0.5, 2.0), [a, b, c]) - 2.0).abs() < 1e-14);
        assert!((distance_to_triangle(dvec3(-3.0, -4.0, 0.0), [a, b, c]) - 5.0).abs() < 1e-14);
        assert!((distance_to_triangle(dvec3(1.0, -2.0, 0.0), [a, b, c]) - 2.0).abs() < 1e-14);
        assert!((distance_to_triangle(dvec3(0.0, 1.0, 1.0), [a, c, a]) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn bulge_of_a_circle() {
        // Two points of the unit circle at ±δ: the arc leaves the chord by 1 − cos δ.
        let delta = 0.1f64;
        let point = |t: f64| dvec3(t.sin(), t.cos(), 0.0);
        let found = bulge(point(-delta), point(-delta), point(delta), point(delta));
        assert!((found - (1.0 - delta.cos())).abs() < delta.powi(4));
    }
}
