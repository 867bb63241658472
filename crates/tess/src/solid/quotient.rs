//! Second derivatives of a rational solid as polynomials over w³.

use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_shape::bernstein::{BernsteinError, Point, SimplexNet, WedgeNet, product_tensor};

use super::net::Degrees;

/// A polynomial over a domain, with its degrees.
pub(crate) type Net<P> = (Degrees, Vec<P>);

/// The second derivatives of a rational solid, `∂²F/∂a∂b = Q_ab/w³`.
pub(crate) struct Quotients {
    /// Three times those of the solid.
    pub degrees: Degrees,
    /// Q_ab for a ≤ b; `None` where it is zero.
    pub numerators: [[Option<Vec<DVec3>>; 3]; 3],
    /// w³.
    pub denominator: Vec<f64>,
}

/// Numerators and denominator of the second derivatives, all in three times the degrees: with F = N/w
/// `Q_ab = w²·N_ab − w·(w_b·N_a + w_a·N_b + w_ab·N) + 2·w_a·w_b·N`.
///
/// The points are taken about a point amid them, which Q does not depend on, so that little cancels. `None` where the nets would have more
/// than `most` coefficients.
pub(crate) fn quotients(
    degrees: Degrees,
    points: &[DVec4],
    most: usize,
) -> Result<Option<Quotients>, BernsteinError> {
    let cube = degrees.times(3);
    if cube.count() > most {
        return Ok(None);
    }
    let finite = points.iter().map(|p| p.xyz() / p.w).filter(|p| p.is_finite());
    let (sum, count) = finite.fold((DVec3::ZERO, 0.0), |(sum, count), p| (sum + p, count + 1.0));
    let middle = if count > 0.0 { sum / count } else { DVec3::ZERO };
    let numerator: Net<DVec3> = (degrees, points.iter().map(|p| p.xyz() - middle * p.w).collect());
    let weight: Net<f64> = (degrees, points.iter().map(|p| p.w).collect());
    let by = |a: usize| (derivative(&numerator, a), derivative(&weight, a));
    let first = [by(0), by(1), by(2)];
    let mut numerators = [const { [const { None }; 3] }; 3];
    for (a, row) in numerators.iter_mut().enumerate() {
        for (b, out) in row.iter_mut().enumerate().skip(a) {
            let (n_a, w_a) = &first[a];
            let (n_b, w_b) = &first[b];
            let n_ab = n_a.as_ref().and_then(|n| derivative(n, b));
            let w_ab = w_a.as_ref().and_then(|w| derivative(w, b));
            let mut total: Option<Net<DVec3>> = None;
            let mut add = |factors: [Option<&Net<f64>>; 2], net: Option<&Net<DVec3>>, share: f64| {
                let ([Some(x), Some(y)], Some(net)) = (factors, net) else { return Ok(()) };
                let (degrees, term) = times(x, &times(y, net)?)?;
                match &mut total {
                    Some((_, sum)) => sum.iter_mut().zip(term).for_each(|(sum, p)| *sum += p * share),
                    None => total = Some((degrees, term.into_iter().map(|p| p * share).collect())),
                }
                Ok::<(), BernsteinError>(())
            };
            let w = Some(&weight);
            add([w, w], n_ab.as_ref(), 1.0)?;
            add([w, w_b.as_ref()], n_a.as_ref(), -1.0)?;
            add([w, w_a.as_ref()], n_b.as_ref(), -1.0)?;
            add([w, w_ab.as_ref()], Some(&numerator), -1.0)?;
            add([w_a.as_ref(), w_b.as_ref()], Some(&numerator), 2.0)?;
            *out = match total {
                Some((degrees, net)) => Some(degrees.elevate(&net, cube)?),
                None => None,
            };
        }
    }
    let (_, denominator) = times(&weight, &times(&weight, &weight)?)?;
    Ok(Some(Quotients { degrees: cube, numerators, denominator }))
}

/// `None` where the degree by that parameter is 0, and the derivative with it.
fn derivative<P: Point>((degrees, points): &Net<P>, by: usize) -> Option<Net<P>> {
    let (lower, net) = degrees.derivative(points, by);
    (lower != *degrees).then_some((lower, net))
}

fn times<P: Point>(factor: &Net<f64>, net: &Net<P>) -> Result<Net<P>, BernsteinError> {
    let ((own, scalars), (degrees, points)) = (factor, net);
    Ok(match (*own, *degrees) {
        (Degrees::Hexahedron(a), Degrees::Hexahedron(b)) => {
            let degrees = Degrees::Hexahedron(std::array::from_fn(|axis| a[axis] + b[axis]));
            let mut out = vec![P::ZERO; degrees.count()];
            product_tensor(scalars, a, points, b, &mut out)?;
            (degrees, out)
        }
        (Degrees::Tetrahedron(a), Degrees::Tetrahedron(b)) => {
            let degrees = Degrees::Tetrahedron(a + b);
            let mut out = vec![P::ZERO; degrees.count()];
            SimplexNet::<P, 4>::new(points, b)?.product(&SimplexNet::new(scalars, a)?, &mut out)?;
            (degrees, out)
        }
        (Degrees::Wedge(a), Degrees::Wedge(b)) => {
            let degrees = Degrees::Wedge([a[0] + b[0], a[1] + b[1]]);
            let mut out = vec![P::ZERO; degrees.count()];
            WedgeNet::new(points, b)?.product(&WedgeNet::new(scalars, a)?, &mut out)?;
            (degrees, out)
        }
        // Both are of one solid.
        _ => net.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::super::net::{Points, SolidNet};
    use super::*;

    #[test]
    fn they_are_the_second_derivatives() {
        let local = |degrees: Degrees, at: [f64; 3]| degrees.completed(at);
        for degrees in [
            Degrees::Hexahedron([2, 1, 3]),
            Degrees::Tetrahedron(3),
            Degrees::Wedge([2, 2]),
            Degrees::Hexahedron([0, 1, 1]),
        ] {
            let number = |i: usize, j: usize| ((i * 37 + j * 11 + i * i * j) % 17) as f64 / 17.0;
            let point = |i: usize| {
                let w = 1.0 + number(i, 4);
                DVec4::new(number(i, 1) * w, number(i, 2) * w, number(i, 3) * w, w)
            };
            let points: Vec<DVec4> = (0..degrees.count()).map(point).collect();
            let all = quotients(degrees, &points, 10_000).unwrap().unwrap();
            let net = SolidNet { degrees, points: Points::Rational(points.clone()) };
            let at = [0.3, 0.2, 0.35];
            let cube = all.degrees.value(&all.denominator, local(degrees, at));
            for a in 0..3 {
                for b in a..3 {
                    // Central differences of the first derivative: h² and u/h, both below 1e-9.
                    let h = 1e-5;
                    let beside = |by: f64| {
                        let mut at = at;
                        at[b] += by;
                        net.jet(local(degrees, at))[a + 1]
                    };
                    let difference = (beside(h) - beside(-h)) / (2.0 * h);
                    let found = all.numerators[a][b]
                        .as_ref()
                        .map_or(DVec3::ZERO, |net| all.degrees.value(net, local(degrees, at)) / cube);
                    assert!(found.distance(difference) < 1e-7, "{degrees:?} {a} {b}: {found} {difference}");
                }
            }
        }
        assert!(quotients(Degrees::Tetrahedron(3), &[DVec4::ONE; 20], 10).unwrap().is_none());
    }
}
