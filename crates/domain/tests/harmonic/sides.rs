//! On a side: exact values, exact slopes along it, limits from inside across it.

use casteljau_domain::glam::DVec2;
use casteljau_domain::{DomainError, Location};

use crate::shapes::{Solved, hard_solved, plain_solved, rows};

/// Value along the side of λⱼ at t, and its slope by t.
fn hat(n: usize, side: usize, j: usize, t: f64) -> [f64; 2] {
    if j == side {
        [t, 1.0]
    } else if j == (side + n - 1) % n {
        [1.0 - t, -1.0]
    } else {
        [0.0, 0.0]
    }
}

#[test]
fn values_and_tangential_derivatives_are_exact() {
    for Solved { name, coordinates: c, .. } in plain_solved().iter().chain(hard_solved()) {
        let n = c.len();
        for side in 0..n {
            let [a, b] = c.polygon().side(side);
            let (along, length) = ((b - a).normalize(), a.distance(b));
            for t in [1e-9, 1e-4, 0.1, 0.5, 0.77, 1.0 - 1e-6] {
                let mut out = vec![f64::NAN; c.stride(2)];
                c.evaluate_side(side, t, 2, &mut out).unwrap();
                assert!(out.iter().all(|x| x.is_finite()), "{name} side {side} at {t}");
                for j in 0..n {
                    let [value, slope] = hat(n, side, j, t);
                    assert_eq!(out[j], value, "{name} side {side} at {t}");
                    let gradient = DVec2::new(out[n + j], out[2 * n + j]);
                    // Two roundings of each product.
                    let slack = 8.0 * f64::EPSILON * (gradient.length() + 1.0 / length);
                    let error = (gradient.dot(along) - slope / length).abs();
                    assert!(error <= slack, "{name} side {side} at {t}: slope off by {error:e}");
                    let [uu, uv, vv] = [3, 4, 5].map(|row| out[row * n + j]);
                    assert_eq!(uu + vv, 0.0, "{name} side {side} at {t}: Laplacian");
                    let bend = uu * along.x * along.x + 2.0 * uv * along.x * along.y + vv * along.y * along.y;
                    assert!(
                        bend.abs() <= 16.0 * f64::EPSILON * (uu.abs() + uv.abs()),
                        "{name} side {side}: {bend}"
                    );
                }
                // Lower orders have the same numbers, and `evaluate` finds the side.
                for order in [0, 1] {
                    let mut less = vec![f64::NAN; c.stride(order)];
                    c.evaluate_side(side, t, order, &mut less).unwrap();
                    assert_eq!(less, out[..less.len()], "{name} side {side} at {t}");
                }
            }
            let p = a.lerp(b, 0.25);
            if let Location::Side { side: found, t } = c.polygon().locate(p) {
                let (mut by_point, mut by_side) = (vec![0.0; c.stride(2)], vec![0.0; c.stride(2)]);
                c.evaluate(&[p], 2, &mut by_point).unwrap();
                c.evaluate_side(found, t, 2, &mut by_side).unwrap();
                assert_eq!((found, by_point), (side, by_side), "{name}");
            } else {
                panic!("{name}: a point of side {side} is not found on it");
            }
        }
    }
}

/// At the depth h below a side the rows differ from those on it by h times the next derivative and by what the fit is
/// off. Sources of roughness are the corners and whatever lies behind the side, so differences are compared to the
/// distance to the nearest corner and the polygon's clearance, with a hundred certificates of leave.
#[test]
fn sides_are_limits_from_inside() {
    for Solved { name, coordinates: c, .. } in plain_solved() {
        let n = c.len();
        let sign = c.polygon().signed_area().signum();
        let gap = c.polygon().clearance();
        for side in 0..n {
            let [a, b] = c.polygon().side(side);
            let inward = (b - a).normalize().perp() * sign;
            for t in [0.02, 0.2, 0.5, 0.81, 0.97] {
                let p = a.lerp(b, t);
                let r = gap.min(a.distance(b) * t.min(1.0 - t));
                let h = 1e-6 * r;
                let mut on = vec![0.0; c.stride(2)];
                c.evaluate_side(side, t, 2, &mut on).unwrap();
                for (k, (x, y)) in rows(c, p + inward * h, 2).iter().zip(&on).enumerate() {
                    let order = [0, 1, 1, 2, 2, 2][k / n];
                    let slack = (20.0 * h / r + [2.0, 100.0, 3000.0][order as usize] * c.certificate())
                        / r.powi(order);
                    let error = (x - y).abs();
                    assert!(error <= slack, "{name} side {side} at {t}, entry {k}: {error:e} of {slack:e}");
                }
            }
        }
    }
}

#[test]
fn corners_have_values_and_no_derivatives() {
    for Solved { name, coordinates: c, .. } in plain_solved() {
        for corner in 0..c.len() {
            let p = c.polygon().vertex(corner);
            let mut out = vec![0.0; c.len()];
            c.evaluate(&[p], 0, &mut out).unwrap();
            assert!((0..c.len()).all(|j| out[j] == if j == corner { 1.0 } else { 0.0 }), "{name}");
            let mut out = vec![0.0; c.stride(1)];
            let error = c.evaluate(&[p], 1, &mut out).unwrap_err();
            assert_eq!(error, DomainError::DerivativeAtCorner { corner, position: p.to_array() });
            let free = rows(c, p, 2);
            assert!(free.iter().all(|x| x.is_finite()), "{name}: {free:?} at corner {corner}");
            for j in 0..c.len() {
                let exact = if j == corner { 1.0 } else { 0.0 };
                assert!((free[j] - exact).abs() <= c.certificate(), "{name}: {free:?} at corner {corner}");
            }
        }
    }
}
