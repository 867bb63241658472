//! What mean value and Wachspress coordinates promise.

#![allow(clippy::unwrap_used, clippy::needless_range_loop)]

mod support;

use casteljau_domain::glam::{DMat2, DVec2, dvec2};
use casteljau_domain::{CoordinateKind, Coordinates, DomainError, Location, Polygon};
use support::{Dd, Plane, Random, convex, gallery, inside, rows_by_differences, wild};

fn both(polygon: &Polygon) -> Vec<Coordinates> {
    let mut all = vec![Coordinates::mean_value(polygon.clone()).unwrap()];
    all.extend(Coordinates::wachspress(polygon.clone()));
    all
}

fn reference(coordinates: &Coordinates) -> impl Fn(Plane) -> Vec<Dd> {
    let (polygon, kind) = (coordinates.polygon().clone(), coordinates.kind());
    move |x| match kind {
        CoordinateKind::Wachspress => support::wachspress(&polygon, x),
        _ => support::mean_value(&polygon, x),
    }
}

fn rows(coordinates: &Coordinates, p: DVec2, order: usize) -> Vec<f64> {
    let mut out = vec![f64::NAN; coordinates.stride(order)];
    coordinates.evaluate_inside(&[p], order, &mut out).unwrap();
    out
}

/// Points inside, some of them very close to sides and corners.
fn hunting_points(random: &mut Random, polygon: &Polygon) -> Vec<DVec2> {
    let mut points = Vec::new();
    for k in 0..40 {
        let Some(p) = inside(random, polygon) else { continue };
        let i = random.below(polygon.len());
        let [a, b] = polygon.side(i);
        let close = 10f64.powi(-(k % 17));
        let target = match k % 3 {
            0 => p,
            1 => a.lerp(b, random.unit()),
            _ => b,
        };
        let q = target.lerp(p, close);
        if matches!(polygon.locate(q), Location::Inside(_)) {
            points.push(q);
        }
    }
    points
}

fn distance_to_vertices(polygon: &Polygon, p: DVec2) -> f64 {
    polygon.vertices().iter().map(|v| v.distance(p)).fold(f64::INFINITY, f64::min)
}

#[test]
fn values_agree_with_double_double_within_the_certificate() {
    let mut random = Random(1);
    let mut polygons: Vec<Polygon> = gallery().into_iter().map(|g| g.1).collect();
    for n in 3..24 {
        polygons.extend(convex(&mut random, n));
        polygons.extend(wild(&mut random, n));
    }
    let mut worst: f64 = 0.0;
    for polygon in &polygons {
        for c in both(polygon) {
            for p in hunting_points(&mut random, polygon) {
                let exact = reference(&c)([p.x.into(), p.y.into()]);
                for (a, b) in rows(&c, p, 0).iter().zip(exact) {
                    let error = (Dd::from(*a) - b).to_f64().abs();
                    assert!(error <= c.certificate(), "{:?} {polygon:?} {p}: {error:e}", c.kind());
                    worst = worst.max(error / c.certificate());
                }
            }
        }
    }
    println!("largest error, as a part of the certificate: {worst:.2e}");
    assert!(worst > 1e-4, "the bound is too loose to mean anything");
}

#[test]
fn derivatives_agree_with_high_precision_differences() {
    let mut random = Random(2);
    for (name, polygon) in gallery() {
        for c in both(&polygon) {
            for p in hunting_points(&mut random, &polygon) {
                let r = distance_to_vertices(&polygon, p);
                if r < 1e-4 {
                    continue;
                }
                // Both formulas are analytic within the distance to the nearest vertex, across sides.
                let exact = rows_by_differences(&reference(&c), p, 1e-3 * r);
                let n = polygon.len();
                let computed = rows(&c, p, 2);
                for (k, (a, b)) in computed.iter().zip(&exact).enumerate() {
                    let order = [0, 1, 1, 2, 2, 2][k / n];
                    let size = r.powi(-order);
                    let error = (a - b).abs() / size;
                    assert!(error < 1e-10, "{name} {:?} {p} row {}: {a} for {b}", c.kind(), k / n);
                }
                assert_eq!(rows(&c, p, 0).len(), n);
                assert_eq!(rows(&c, p, 1), computed[..3 * n], "order 1 differs from order 2");
            }
        }
    }
}

#[test]
fn partition_of_unity_linear_precision_and_lagrange_property() {
    let mut random = Random(3);
    let mut polygons: Vec<Polygon> = gallery().into_iter().map(|g| g.1).collect();
    polygons.extend((3..40).filter_map(|n| convex(&mut random, n)));
    for polygon in &polygons {
        let n = polygon.len();
        let size = polygon.diameter();
        for c in both(polygon) {
            for p in hunting_points(&mut random, polygon) {
                let out = rows(&c, p, 1);
                let sum: f64 = out[..n].iter().sum();
                assert!((sum - 1.0).abs() < 1e-13);
                let q: DVec2 = polygon.vertices().iter().zip(&out).map(|(v, l)| *v * *l).sum();
                let allowed = 1e-12f64.max(c.certificate()) * size;
                assert!(q.distance(p) <= allowed, "{:?} {p}: {:e}", c.kind(), q.distance(p));
                // Σ ∇λᵢ vᵢᵀ is the identity; away from corners to 1e-12.
                if distance_to_vertices(polygon, p) > 0.01 * size && c.certificate() < 1e-12 {
                    let du: DVec2 = polygon.vertices().iter().zip(&out[n..]).map(|(v, l)| *v * *l).sum();
                    let dv: DVec2 = polygon.vertices().iter().zip(&out[2 * n..]).map(|(v, l)| *v * *l).sum();
                    assert!(du.distance(DVec2::X) < 1e-11 && dv.distance(DVec2::Y) < 1e-11, "{du} {dv}");
                }
            }
            for i in 0..n {
                let mut out = vec![0.0; n];
                c.evaluate(&[polygon.vertex(i)], 0, &mut out).unwrap();
                assert!((0..n).all(|j| out[j] == if i == j { 1.0 } else { 0.0 }));
                // Without location as well, to rounding.
                let near = rows(&c, polygon.vertex(i), 0);
                assert!((0..n).all(|j| (near[j] - out[j]).abs() < 1e-15), "{near:?}");
            }
        }
    }
}

#[test]
fn sides_are_linear_and_their_derivatives_are_limits_from_inside() {
    for (name, polygon) in gallery() {
        let n = polygon.len();
        for c in both(&polygon) {
            for side in 0..n {
                let [a, b] = polygon.side(side);
                let before = (side + n - 1) % n;
                for t in [1e-9, 0.1, 0.5, 0.75, 1.0 - 1e-12] {
                    let mut out = vec![f64::NAN; c.stride(2)];
                    c.evaluate_side(side, t, 2, &mut out).unwrap();
                    assert!(out.iter().all(|x| x.is_finite()), "{name} {side} {t}");
                    for j in 0..n {
                        let wanted = if j == side {
                            t
                        } else if j == before {
                            1.0 - t
                        } else {
                            0.0
                        };
                        assert_eq!(out[j], wanted);
                    }
                    let p = a.lerp(b, t);
                    let near = rows(&c, p, 0);
                    for j in 0..n {
                        let slack = 8.0 * c.certificate() + 1e-15 / (1.0 - t).min(t);
                        assert!((near[j] - out[j]).abs() <= slack, "{name} {side} {t} {near:?}");
                    }
                    if !(0.01..0.99).contains(&t) {
                        continue;
                    }
                    let along = b - a;
                    for j in 0..n {
                        let slope = along.x * out[n + j] + along.y * out[2 * n + j];
                        let wanted = if j == side {
                            1.0
                        } else if j == before {
                            -1.0
                        } else {
                            0.0
                        };
                        assert!((slope - wanted).abs() < 1e-9, "{name} {:?} {side} {t}: {slope}", c.kind());
                    }
                    // Inside at a small distance, everything differs by a little.
                    let step = 1e-7 * a.distance(b);
                    let inward = along.perp().normalize() * step * polygon.signed_area().signum();
                    let inside = rows(&c, p + inward, 2);
                    let feature = polygon.clearance();
                    let r = distance_to_vertices(&polygon, p).min(feature);
                    for (k, (x, y)) in inside.iter().zip(&out).enumerate() {
                        let order = [0, 1, 1, 2, 2, 2][k / n];
                        let slack = 100.0 * step / r.powi(order + 1) + 1e-10 / r.powi(order);
                        assert!((x - y).abs() < slack, "{name} {:?} {side} {t} {k}: {x} {y}", c.kind());
                    }
                }
            }
        }
    }
}

#[test]
fn approach_to_sides_has_no_jump() {
    let (_, l) = gallery().swap_remove(3);
    let c = Coordinates::mean_value(l).unwrap();
    let mut last: Option<Vec<f64>> = None;
    for k in 0..400 {
        let h = 2f64.powi(-k);
        let out = rows(&c, dvec2(0.3, 0.5 * h), 1);
        if let Some(last) = &last {
            assert!(out.iter().zip(last).all(|(a, b)| (a - b).abs() < 8.0 * h + 1e-13), "{k}");
        }
        last = Some(out);
    }
}

#[test]
fn wachspress_is_affinely_invariant_and_mean_value_by_similarities() {
    let mut random = Random(5);
    for (name, polygon) in gallery() {
        for c in both(&polygon) {
            let m = match c.kind() {
                CoordinateKind::Wachspress => DMat2::from_cols(dvec2(2.0, 0.3), dvec2(-0.7, 1.1)),
                _ => DMat2::from_cols(dvec2(1.2, 0.9), dvec2(-0.9, 1.2)),
            };
            for mirror in [1.0, -1.0] {
                let map = |p: DVec2| m * (p * dvec2(mirror, 1.0)) * 1e3 + dvec2(5.0, -3.0);
                let moved = Polygon::new(polygon.vertices().iter().map(|v| map(*v)).collect()).unwrap();
                let other = match c.kind() {
                    CoordinateKind::Wachspress => Coordinates::wachspress(moved).unwrap(),
                    _ => Coordinates::mean_value(moved).unwrap(),
                };
                for _ in 0..20 {
                    let p = inside(&mut random, &polygon).unwrap();
                    for (a, b) in rows(&c, p, 0).iter().zip(rows(&other, map(p), 0)) {
                        assert!((a - b).abs() < 1e-11, "{name} {:?}", c.kind());
                    }
                }
            }
        }
    }
}

#[test]
fn numbering_orientation_and_scale_change_nothing() {
    let mut random = Random(6);
    for (name, polygon) in gallery() {
        let n = polygon.len();
        for c in both(&polygon) {
            let again = |v: Vec<DVec2>| match c.kind() {
                CoordinateKind::Wachspress => Coordinates::wachspress(Polygon::new(v).unwrap()).unwrap(),
                _ => Coordinates::mean_value(Polygon::new(v).unwrap()).unwrap(),
            };
            let mut turned = polygon.vertices().to_vec();
            turned.rotate_left(2);
            let turned = again(turned);
            let reversed = again(polygon.vertices().iter().rev().copied().collect());
            let tiny = again(polygon.vertices().iter().map(|v| *v * 2f64.powi(-200)).collect());
            for _ in 0..20 {
                let p = inside(&mut random, &polygon).unwrap();
                let plain = rows(&c, p, 2);
                let (a, b) = (rows(&turned, p, 2), rows(&reversed, p, 2));
                let s = rows(&tiny, p * 2f64.powi(-200), 2);
                for row in 0..6 {
                    let scale = plain[row * n..][..n].iter().fold(1.0f64, |m, x| m.max(x.abs()));
                    for i in 0..n {
                        let wanted = plain[row * n + i];
                        let slack = 1e-10 * scale;
                        assert!((a[row * n + (i + n - 2) % n] - wanted).abs() < slack, "{name} {row}");
                        assert!((b[row * n + n - 1 - i] - wanted).abs() < slack, "{name} {row}");
                        let power = 200 * [0, 1, 1, 2, 2, 2][row];
                        assert_eq!(s[row * n + i] * 2f64.powi(-power), wanted, "a power of two is exact");
                    }
                }
            }
        }
    }
}

#[test]
fn batches_and_single_points_have_the_same_bits() {
    let mut random = Random(7);
    for (_, polygon) in gallery() {
        let points: Vec<DVec2> = (0..37).map(|_| inside(&mut random, &polygon).unwrap()).collect();
        for c in both(&polygon) {
            for order in 0..3 {
                let stride = c.stride(order);
                let mut out = vec![0.0; points.len() * stride];
                c.evaluate(&points, order, &mut out).unwrap();
                for (p, part) in points.iter().zip(out.chunks_exact(stride)) {
                    let alone = rows(&c, *p, order);
                    assert!(alone.iter().zip(part).all(|(a, b)| a.to_bits() == b.to_bits()));
                }
            }
        }
    }
}

#[test]
fn random_polygons_never_give_nan() {
    let mut random = Random(8);
    let mut tried = 0;
    for _ in 0..4000 {
        let n = 3 + random.below(14);
        let Some(polygon) = wild(&mut random, n) else { continue };
        tried += 1;
        let mut points = hunting_points(&mut random, &polygon);
        points.extend(polygon.vertices());
        points.extend((0..n).map(|i| polygon.side(i)[0].midpoint(polygon.side(i)[1])));
        for c in both(&polygon) {
            for order in 0..3 {
                let mut out = vec![f64::NAN; points.len() * c.stride(order)];
                c.evaluate_inside(&points, order, &mut out).unwrap();
                assert!(out.iter().all(|x| x.is_finite()), "{polygon:?} {:?} order {order}", c.kind());
            }
        }
    }
    assert!(tried > 1000, "{tried}");
}

#[test]
fn many_sides() {
    for n in [64, 500, 3000] {
        let v = (0..n).map(|i| DVec2::from_angle(i as f64 * std::f64::consts::TAU / n as f64)).collect();
        let polygon = Polygon::new(v).unwrap();
        for c in both(&polygon) {
            for p in
                [dvec2(0.1, 0.2), polygon.vertex(3) * 0.9999, polygon.vertex(1).midpoint(polygon.vertex(2))]
            {
                let out = rows(&c, p, 2);
                assert!(out.iter().all(|x| x.is_finite()));
                let q: DVec2 = polygon.vertices().iter().zip(&out).map(|(v, l)| *v * *l).sum();
                assert!(q.distance(p) < 1e-10, "{n} {:?} {p}: {:e}", c.kind(), q.distance(p));
            }
        }
    }
}

#[test]
fn wachspress_at_corners_has_derivatives() {
    let c = Coordinates::wachspress(gallery().swap_remove(1).1).unwrap();
    let mut out = [0.0; 24];
    c.evaluate(&[dvec2(1.0, 0.0)], 2, &mut out).unwrap();
    // λ₁ = u(1−v) on the unit square.
    assert_eq!([out[1], out[5], out[9], out[13], out[17], out[21]], [1.0, 1.0, -1.0, 0.0, -1.0, 0.0]);
}

#[test]
fn wrong_calls_are_typed_errors() {
    let c = Coordinates::mean_value(gallery().swap_remove(3).1).unwrap();
    let mut row = [0.0; 6];
    let outside = c.evaluate(&[dvec2(1.5, 1.5)], 0, &mut row);
    assert_eq!(outside, Err(DomainError::OutsidePolygon { index: 0, point: [1.5, 1.5] }));
    assert!(matches!(c.evaluate(&[DVec2::NAN], 0, &mut row), Err(DomainError::OutsidePolygon { .. })));
    assert!(matches!(
        c.evaluate_side(6, 0.5, 0, &mut row),
        Err(DomainError::BadOption { option: "side", .. })
    ));
    assert!(matches!(
        c.evaluate_side(0, f64::NAN, 0, &mut row),
        Err(DomainError::BadOption { option: "t", .. })
    ));
    assert!(matches!(
        c.evaluate_side(0, 0.5, 3, &mut row),
        Err(DomainError::BadOption { option: "order", .. })
    ));
    assert!(matches!(c.evaluate_side(0, 0.5, 1, &mut row), Err(DomainError::CountMismatch { .. })));
    assert!(matches!(
        c.evaluate_side(3, 1.0, 1, &mut [0.0; 18]),
        Err(DomainError::DerivativeAtCorner { corner: 3, .. })
    ));
    let many = vec![dvec2(0.5, 0.5); 3];
    assert!(matches!(
        c.evaluate_inside(&many, 0, &mut row),
        Err(DomainError::CountMismatch { wanted: 18, .. })
    ));
}
