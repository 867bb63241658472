//! Polynomial trilinear hexahedra, most of which need no subdivision: the 27 coefficients of det J without allocation.

use casteljau_bernstein::glam::DVec3;
use casteljau_geom::UNIT_ROUNDOFF;

use super::JacobianVerdict;

/// Roundings on the way of a contribution to a coefficient: three differences, a cross product, a sum of two, a dot
/// product, a sum of four; and some for the bound itself.
const ROUNDINGS: f64 = 16.0;

/// Beyond these, products may leave the range of numbers: the general way scales first.
const SMALLEST: f64 = 1e-250;
const LARGEST: f64 = 1e250;

/// The verdict where the coefficients give it at once.
///
/// The bounds are the same for all coefficients, made of the largest edges: a solid much smaller at one end than at the
/// other may need those of its own coefficients.
pub(super) fn verdict(points: &[DVec3; 8]) -> Option<JacobianVerdict> {
    let p = points;
    let u = [p[4] - p[0], p[5] - p[1], p[6] - p[2], p[7] - p[3]]; // by (j, k)
    let v = [p[2] - p[0], p[3] - p[1], p[6] - p[4], p[7] - p[5]]; // by (i, k)
    let w = [p[1] - p[0], p[3] - p[2], p[5] - p[4], p[7] - p[6]]; // by (i, j)

    let largest =
        |edges: &[DVec3; 4]| edges[0].abs().max(edges[1].abs()).max(edges[2].abs().max(edges[3].abs()));
    let (mu, mv, mw) = (largest(&u), largest(&v), largest(&w));
    let (vw, wu, uv) = (permanents(mv, mw), permanents(mw, mu), permanents(mu, mv));
    let scale = mu.dot(vw);
    if !(SMALLEST..LARGEST).contains(&scale) {
        return None;
    }
    let rounding = ROUNDINGS * UNIT_ROUNDOFF * scale;

    // Twice the coefficients' numerators: sums over a + a′ = i, b + b′ = j, c + c′ = k of det(U_bc, V_ac′, W_a′b′).
    let mut sums = [[[0.0; 3]; 3]; 3];
    for (c, in_w) in [[v[0], v[2]], [v[1], v[3]]].into_iter().enumerate() {
        for (b, in_v) in [[w[0], w[2]], [w[1], w[3]]].into_iter().enumerate() {
            let [first, last] = [in_w[0].cross(in_v[0]), in_w[1].cross(in_v[1])];
            let normals = [first, in_w[0].cross(in_v[1]) + in_w[1].cross(in_v[0]), last];
            for (sum, normal) in sums.iter_mut().zip(normals) {
                sum[b][c] += u[0].dot(normal);
                sum[b][c + 1] += u[1].dot(normal);
                sum[b + 1][c] += u[2].dot(normal);
                sum[b + 1][c + 1] += u[3].dot(normal);
            }
        }
    }
    let mut least = f64::INFINITY;
    for (i, plane) in sums.iter().enumerate() {
        for (j, row) in plane.iter().enumerate() {
            for (k, sum) in row.iter().enumerate() {
                const SHARE: [f64; 3] = [1.0, 0.5, 1.0];
                let value = sum * (SHARE[i] * SHARE[j] * SHARE[k]);
                least = least.min(value);
            }
        }
    }
    if least > rounding {
        return Some(JacobianVerdict::Positive);
    }
    let far = p.iter().fold(DVec3::ZERO, |far, p| far.max(p.abs())).max_element();
    let uncertain = 2.0 * far * (vw.element_sum() + wu.element_sum() + uv.element_sum());
    let tolerance = 1.001 * (rounding + 4.0 * UNIT_ROUNDOFF * uncertain);
    (0..8).find_map(|corner| {
        let [i, j, k] = [corner >> 2, corner >> 1 & 1, corner & 1];
        let value = sums[2 * i][2 * j][2 * k];
        (value < -tolerance)
            .then_some(JacobianVerdict::Invalid { witness: [i as f64, j as f64, k as f64], value })
    })
}

/// The cross product with plus signs.
fn permanents(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x)
}
