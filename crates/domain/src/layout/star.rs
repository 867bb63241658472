//! The polygon that exists for every pattern of convex and concave corners.
//!
//! Let k ≥ 3 corners be convex. They are put on the unit circle; between two neighbours with m concave
//! corners between them lies the central angle Δ = 2π(⅞·1/k + ⅛·(m+1)/n), so that Δ < 2π(⅞·⅓ + ⅛) = 150°. The
//! m concave corners divide evenly a circular arc that joins the two and bends inward, its end tangents off
//! the chord by β = ¼(π − Δ), which is half the base angle of the triangle that the chord spans with the
//! centre.
//!
//! *Simple.* An arc stays within the triangle on its chord of base angles β, so within the triangle of chord
//! and centre. These triangles, k of them, fill the polygon of the convex corners and overlap in common edges
//! only, and the arc touches its triangle's edges in the two convex corners only. So arcs meet in common
//! corners only, and the chords of an arc meet in order. *Counter-clockwise*, because seen from the centre,
//! which lies inside since Δ < π, each side is passed counter-clockwise. *Concave*: at each of the m corners
//! the arc's chords turn right by 2β/(m+1) > 0. *Convex*: at a convex corner the interior angle is at least
//! the sum of two halves of base angles, ½(π − (Δ+Δ')/2) ≥ 26°, and at most π − (Δ+Δ')/2 < π.
//!
//! *Apart.* Let s be the shortest part of an arc's chord. With x = (m+1)/n ≤ 1 it is 2 sin(π(⅞/k + ⅛x))/(xn)
//! at least, which falls with x, so s ≥ 2 sin(π(⅞/k + ⅛))/n, and the parts themselves are longer. A vertex
//! and a side it does not end (a) of one arc are s apart, since the arc turns by 2β ≤ 90°, so that distances
//! along it do not decrease; (b) of arcs with a common corner are s·sin w apart, as they lie in wedges with
//! an angle w = ½(π − ½(Δ + Δ')) between, and Δ + Δ' ≤ 2π(2·⅞/k + ⅛): this is 0.84/n for k = 3, more for k =
//! 4 to 8, and falls from there to 2 sin 22.5°·sin 67.5° = 0.707/n for large k; (c) of arcs without a common
//! corner (k ≥ 4) are at least ¼, the least distance of an arc from the centre, times the sine of a sector
//! 2π(⅞/k + ⅛/n) ≥ 2π/n (or of 90°) apart, 1/n. Divided by the diameter, 2 at most, the clearance is at least
//! 0.35/n. The least that the tests find is 0.43/n.

use std::f64::consts::{PI, TAU};

use casteljau_geom::glam::DVec2;

/// The star for this pattern, which has at least three convex corners; counter-clockwise, within the unit
/// circle.
pub(super) fn star(concave: &[bool]) -> Vec<DVec2> {
    let n = concave.len();
    let convex: Vec<usize> = (0..n).filter(|&i| !concave[i]).collect();
    let k = convex.len();
    let mut vertices = vec![DVec2::ZERO; n];
    let mut angle = 0.0;
    for (j, &corner) in convex.iter().enumerate() {
        let steps = (convex[(j + 1) % k] + n - corner - 1) % n + 1;
        let sector = TAU * (0.875 / k as f64 + 0.125 * steps as f64 / n as f64);
        let (start, end) = (DVec2::from_angle(angle), DVec2::from_angle(angle + sector));
        vertices[corner] = start;
        let bend = 0.25 * (PI - sector);
        for step in 1..steps {
            // By the inscribed angle: seen from start, the chord to this point leaves the arc's chord by
            // bend·(1 − t).
            let t = step as f64 / steps as f64;
            let length = (bend * t).sin() / bend.sin();
            vertices[(corner + step) % n] =
                start + (end - start).rotate(DVec2::from_angle(bend * (1.0 - t))) * length;
        }
        angle += sector;
    }
    vertices
}

#[cfg(test)]
mod tests {
    use super::super::{GUARANTEED_CLEARANCE, accept};
    use super::star;

    /// Clearance of the star times n, which exists and is accepted.
    fn clearance(concave: &[bool]) -> f64 {
        let n = concave.len() as f64;
        accept(&star(concave), concave, GUARANTEED_CLEARANCE / n).expect("a valid star").clearance * n
    }

    #[test]
    fn every_pattern_to_fourteen_sides() {
        let mut least = f64::INFINITY;
        for n in 3..=14 {
            let patterns = (0..1u32 << n).filter(|p| p.count_ones() + 3 <= n);
            for pattern in patterns {
                let concave: Vec<bool> = (0..n).map(|i| pattern >> i & 1 == 1).collect();
                least = least.min(clearance(&concave));
            }
        }
        println!("least clearance of a star: {least:.4}/n");
    }

    #[test]
    fn long_patterns() {
        let mut least = f64::INFINITY;
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as usize
        };
        for _ in 0..2000 {
            let n = 15 + random() % 286;
            let share = random() % 101;
            let mut concave: Vec<bool> = (0..n).map(|_| random() % 100 < share).collect();
            for _ in 0..3 {
                // Three convex corners at least: three neighbours or three anywhere.
                let at = random() % n;
                (0..3).for_each(|j| concave[(at + j) % n] = false);
            }
            least = least.min(clearance(&concave));
        }
        // All concave corners between the same two convex ones, and all convex ones in a row.
        for n in [20, 50, 100, 300, 1000] {
            for convex in [3, 4, 5, n / 2, n - 2, n] {
                let concave: Vec<bool> = (0..n).map(|i| i >= convex).collect();
                least = least.min(clearance(&concave));
            }
        }
        println!("least clearance of a long star: {least:.4}/n");
    }
}
