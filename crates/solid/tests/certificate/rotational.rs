//! Solids of revolution: det J is a product of a function of (u, v), zero at the four corners only, and of
//! `(x² + y²)·(Z′R − ZR′)`.

use casteljau_solid::geom::glam::DVec3;
use casteljau_solid::{DEFAULT_OPERATIONS, Feature, JacobianVerdict, SolidNet, jacobian_verdict};

use crate::support::{Chance, rotational};

fn verdict(meridian: &[DVec3], weights: &[f64], middle: f64) -> JacobianVerdict {
    let points = rotational(meridian, weights, middle);
    let net = SolidNet::Hexahedron { points: &points, degrees: [2, 2, meridian.len() - 1] };
    jacobian_verdict(&net, DEFAULT_OPERATIONS).unwrap()
}

fn edges() -> Vec<Feature> {
    [[0, 0], [0, 1], [1, 0], [1, 1]].into_iter().map(|at| Feature::Edge { axis: 2, at }).collect()
}

#[test]
fn rising_meridians() {
    let mut chance = Chance(7);
    for round in 0..600 {
        let n = 1 + round % 5;
        let turn = DVec3::new(chance.between(-1.0, 1.0), chance.between(-1.0, 1.0), 0.0);
        let mut z = chance.between(-3.0, 3.0);
        // z rises, and weights of one size keep Z′R − ZR′ positive; the meridian winds around the axis, but keeps away.
        let meridian: Vec<DVec3> = (0..=n)
            .map(|_| {
                z += chance.between(0.5, 1.0);
                let mut q = turn + chance.point(0.3 * turn.length());
                q.z = z;
                q
            })
            .collect();
        let weights: Vec<f64> =
            (0..=n).map(|_| if round % 2 == 0 { 1.0 } else { chance.between(0.9, 1.1) }).collect();
        let middle = [4.0, 1.0, 0.25, 16.0, chance.between(0.1, 10.0)][round % 5];
        let scale = 10_f64.powi(round as i32 % 13 - 6);
        let meridian: Vec<DVec3> = meridian.into_iter().map(|q| q * scale).collect();
        let got = verdict(&meridian, &weights, middle);
        assert_eq!(
            got,
            JacobianVerdict::PositiveExcept(edges()),
            "round {round}: {meridian:?} {weights:?} {middle}"
        );
    }
}
