//! All local minima: against the minima of fine samples, and cases where they are known.

use casteljau_shape::geom::glam::{DVec3, DVec4};
use casteljau_shape::{Curve, CurveProjector, LocalMinima, Projection};

use crate::brute::{curve, patch};
use crate::cases::net;
use crate::random::Random;

/// Whether parameters lie within `reach` of a minimum or in an unresolved box.
pub fn accounted<const D: usize>(found: &LocalMinima<D>, at: [f64; D], reach: f64) -> bool {
    let near = |x: [f64; D]| (0..D).all(|k| (x[k] - at[k]).abs() <= reach);
    found.minima.iter().any(|m| near(m.parameters))
        || found
            .unresolved
            .iter()
            .any(|b| (0..D).all(|k| b[k][0] - reach <= at[k] && at[k] <= b[k][1] + reach))
}

/// Each minimum of a surface is smaller than its surroundings, and the least of them is the closest point. `inside`
/// gives the point at the place of the domain nearest to a place.
pub fn each_is_least(
    found: &LocalMinima<2>,
    global: &Projection<2>,
    q: DVec3,
    inside: impl Fn([f64; 2]) -> DVec3,
) {
    for m in &found.minima {
        assert!(m.uncertainty.iter().all(|&r| r < 1e-5), "{m:?}");
        for k in 0..16 {
            let (sin, cos) = (f64::from(k) * std::f64::consts::FRAC_PI_8).sin_cos();
            let near = inside([m.parameters[0] + 1e-5 * cos, m.parameters[1] + 1e-5 * sin]);
            assert!(near.distance(q) >= m.distance - 1e-14, "{m:?}");
        }
    }
    let least = found.minima.first().map_or(f64::INFINITY, |m| m.distance);
    assert!(least <= global.distance + 1e-13 || !found.unresolved.is_empty(), "{global:?} {found:?}");
    assert!(least >= global.lower_bound);
}

/// Each minimum is smaller than its surroundings; each minimum among samples is accounted for.
#[test]
fn patches() {
    const N: usize = 100;
    let mut random = Random::new(11);
    let (mut minima, mut unresolved) = (0, 0);
    for shape in 0..120 {
        let degrees = [2 + random.below(2), 2 + random.below(2)];
        let kind = [0, 1, 2, 6][shape % 4];
        let net = net(&mut random, kind, degrees);
        let projector = patch(degrees, &net.points);
        let q = 1.5 * random.point();
        let found = projector.local_minima(q).unwrap();
        assert_eq!(found, projector.local_minima(q).unwrap());
        minima += found.minima.len();
        // Weights of six orders make parts of a patch nearly singular, where rounding decides.
        unresolved += if kind == 2 { 0 } else { found.unresolved.len() };
        let inside = |at: [f64; 2]| net.point(at.map(|x| x.clamp(0.0, 1.0)));
        each_is_least(&found, &projector.closest_point(q).unwrap(), q, inside);
        let sample = |i: usize, j: usize| net.point([i, j].map(|i| i as f64 / N as f64)).distance(q);
        let grid: Vec<Vec<f64>> = (0..=N).map(|i| (0..=N).map(|j| sample(i, j)).collect()).collect();
        for i in 0..=N {
            for j in 0..=N {
                let around = (i.saturating_sub(2)..=(i + 2).min(N))
                    .flat_map(|a| (j.saturating_sub(2)..=(j + 2).min(N)).map(move |b| (a, b)));
                if around.filter(|&p| p != (i, j)).all(|(a, b)| grid[a][b] > grid[i][j]) {
                    let at = [i, j].map(|i| i as f64 / N as f64);
                    // The sample nearest to a minimum in a narrow valley can be far along it.
                    let (_, at) = net.refined(q, (grid[i][j], at), [1.0 / N as f64; 2], 100_000);
                    let reach = 0.02;
                    assert!(accounted(&found, at, reach), "{shape}: sample {at:?} of {found:?}");
                }
            }
        }
    }
    println!("{minima} minima, {unresolved} unresolved boxes");
    assert!(minima > 120 && unresolved <= 12, "{minima} {unresolved}");
}

#[test]
fn curves() {
    const N: usize = 2000;
    let mut random = Random::new(12);
    let (mut minima, mut unresolved) = (0, 0);
    for shape in 0..1000 {
        let net = net(&mut random, [0, 2, 6, 7][shape % 4], [1 + shape % 8, 0]);
        let projector = curve(&net.points);
        let q = 1.5 * random.point();
        let found = projector.local_minima(q).unwrap();
        minima += found.minima.len();
        unresolved += found.unresolved.len();
        let samples: Vec<f64> = (0..=N).map(|i| net.point([i as f64 / N as f64, 0.0]).distance(q)).collect();
        for i in 0..=N {
            let lower = |k: Option<&f64>| k.is_none_or(|&x| x > samples[i]);
            if lower(samples.get(i + 1)) && lower(i.checked_sub(1).and_then(|k| samples.get(k))) {
                assert!(
                    accounted(&found, [i as f64 / N as f64], 2.0 / N as f64),
                    "{shape}: {i} of {found:?}"
                );
            }
        }
        for m in &found.minima {
            let i = m.parameters[0] * N as f64;
            let around = [(i - 30.0).max(0.0), (i + 30.0).min(N as f64)].map(|i| i as usize);
            assert!(samples[around[0]..=around[1]].iter().any(|&s| s >= m.distance - 1e-14));
        }
    }
    println!("{minima} minima, {unresolved} unresolved boxes");
    assert!(minima > 1500 && unresolved <= 3, "{minima} {unresolved}");
}

#[test]
fn known_minima() {
    // A bowl seen from its axis: its four corners, in pairs at the same distance, and the bottom.
    let height = [1.0, -1.0, 1.0];
    let bowl: Vec<DVec4> = (0..9)
        .map(|k| {
            DVec4::new((k / 3) as f64 - 1.0, (k % 3) as f64 - 1.0, 0.5 * (height[k / 3] + height[k % 3]), 1.0)
        })
        .collect();
    let projector = patch([2, 2], &bowl);
    let inside = projector.local_minima(DVec3::Z * 0.3).unwrap();
    assert_eq!((inside.minima.len(), inside.unresolved.len()), (1, 0), "{inside:?}");
    assert!((inside.minima[0].distance - 0.3).abs() < 1e-15);
    // From below there is the bottom only, from high above the four corners.
    let below = projector.local_minima(-DVec3::Z).unwrap();
    assert_eq!((below.minima.len(), below.unresolved.len()), (1, 0), "{below:?}");
    let above = projector.local_minima(DVec3::Z * 5.0).unwrap();
    assert_eq!((above.minima.len(), above.unresolved.len()), (4, 0), "{above:?}");
    // On a corner of the patch.
    let corner = projector.local_minima(DVec3::ONE).unwrap();
    assert!(corner.minima[0].distance == 0.0 && corner.unresolved.is_empty(), "{corner:?}");
    // The focus of a parabola's vertex: the minimum is there, but not to second order.
    let parabola =
        Curve::new(vec![DVec3::new(-1.0, 1.0, 0.0), DVec3::NEG_Y, DVec3::new(1.0, 1.0, 0.0)]).unwrap();
    let focus = CurveProjector::new(&parabola).unwrap().local_minima(DVec3::Y * 0.5).unwrap();
    assert!(focus.minima.is_empty() && focus.unresolved.len() == 1, "{focus:?}");
    let [[from, to]] = focus.unresolved[0];
    assert!(from <= 0.5 && to >= 0.5 && to - from < 1e-2, "{focus:?}");
}
