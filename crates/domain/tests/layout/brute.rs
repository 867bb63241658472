//! An independent checker, by plain loops and without the library's predicates, and the best alignment of two
//! outlines.

use std::f64::consts::PI;

use casteljau_domain::glam::{DVec2, dvec2};
use casteljau_domain::layout::{Layout, STRAIGHT};

/// Least distance of vertices to sides that they do not end, by sampling nothing and pruning nothing.
pub fn clearance(v: &[DVec2]) -> f64 {
    let n = v.len();
    let mut least = f64::INFINITY;
    for i in 0..n {
        for j in 0..n {
            let (a, b, p) = (v[j], v[(j + 1) % n], v[i]);
            if i == j || i == (j + 1) % n {
                continue;
            }
            let s = ((p - a).dot(b - a) / (b - a).dot(b - a)).clamp(0.0, 1.0);
            least = least.min((a + (b - a) * s - p).length());
        }
    }
    least
}

pub fn diameter(v: &[DVec2]) -> f64 {
    v.iter().flat_map(|a| v.iter().map(move |b| (*a - *b).length())).fold(0.0, f64::max)
}

/// Whether some sides cross properly; touching ones are for `clearance`.
pub fn crosses(v: &[DVec2]) -> bool {
    let n = v.len();
    let left = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a) > 0.0;
    (0..n).any(|i| {
        (0..n).any(|j| {
            let (a, b, c, d) = (v[i], v[(i + 1) % n], v[j], v[(j + 1) % n]);
            let apart = i != j && (i + 1) % n != j && (j + 1) % n != i;
            apart && left(a, b, c) != left(a, b, d) && left(c, d, a) != left(c, d, b)
        })
    })
}

/// Turning angle at each vertex, within (−π, π].
pub fn turning(v: &[DVec2]) -> Vec<f64> {
    let n = v.len();
    let turn = |i: usize| {
        let (a, b) = (v[i] - v[(i + n - 1) % n], v[(i + 1) % n] - v[i]);
        a.perp_dot(b).atan2(a.dot(b))
    };
    (0..n).map(turn).collect()
}

/// Fails unless the layout is what the module promises for `required` clearance.
pub fn assert_valid(layout: &Layout, required: f64, context: &str) {
    let v = layout.polygon.vertices();
    assert!(v.iter().all(|p| p.is_finite()), "{context}: {v:?}");
    assert!(!crosses(v), "{context}: crosses, {v:?}");
    let total: f64 = turning(v).iter().sum();
    assert!((total - 2.0 * PI).abs() < 1e-6, "{context}: turns by {total}, {v:?}");
    for (i, (&concave, turn)) in layout.concave.iter().zip(turning(v)).enumerate() {
        let kept = if concave { turn <= -0.99 * STRAIGHT } else { turn >= -1.01 * STRAIGHT };
        assert!(kept, "{context}: corner {i} turns by {turn}, concave {concave}, {v:?}");
    }
    let share = clearance(v) / diameter(v);
    assert!(share >= required * (1.0 - 1e-12), "{context}: clearance {share}, required {required}, {v:?}");
    assert!(
        (share - layout.clearance).abs() < 1e-12,
        "{context}: clearance {share}, reported {}",
        layout.clearance
    );
    let mean = v.iter().sum::<DVec2>() / v.len() as f64;
    let radius = v.iter().map(|p| p.length()).fold(0.0, f64::max);
    assert!(mean.length() < 1e-13 && (radius - 1.0).abs() < 1e-13, "{context}: mean {mean}, radius {radius}");
}

/// Largest distance between two outlines after the motion (and the scale, if `scaled`) that fits b to a best.
pub fn misfit(a: &[DVec2], b: &[DVec2], scaled: bool) -> f64 {
    let mean = |p: &[DVec2]| p.iter().sum::<DVec2>() / p.len() as f64;
    let (ca, cb) = (mean(a), mean(b));
    let (mut fit, mut square) = (DVec2::ZERO, 0.0);
    for (p, q) in a.iter().zip(b) {
        let (p, q) = (*p - ca, *q - cb);
        fit += dvec2(q.dot(p), q.perp_dot(p));
        square += q.dot(q);
    }
    let fit = if scaled { fit / square } else { fit.normalize() };
    a.iter().zip(b).map(|(p, q)| (*p - ca - fit.rotate(*q - cb)).length()).fold(0.0, f64::max)
}
