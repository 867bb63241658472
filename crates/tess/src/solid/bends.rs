//! How much a solid bends: bounds on its second derivatives, and the lattice that keeps a chord tolerance.

use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_geom::power_of_two_below;
use casteljau_shape::bernstein::BernsteinError;

use super::net::{Degrees, Part, Points, SolidNet};
use super::quotient::{Net, Quotients, quotients};
use crate::TessError;

/// The domain is halved so many times along each parameter before the first bounds are taken.
const DEPTH: usize = 2;
/// Nets of more control points are halved once less.
const LARGE: usize = 400;
/// Most coefficients of a numerator.
const MOST_TERMS: usize = 3000;
/// Where weights have two signs, it is halved up to so many times.
const DEEPEST: usize = 12;
/// Parts looked at for that.
const MOST_PARTS: usize = 20_000;

/// Bounds `M_ab ≥ |∂²F/∂a∂b|` over the parts of a domain, in model units; parameters as in [`Degrees::partials`].
///
/// By the convex hull property. For a polynomial solid M_ab is the largest second difference over the part, times the
/// degrees. For a rational one ∂²F/∂a∂b = Q_ab/w³ ([`Quotients`]), and M_ab is the largest quotient of a control point of Q_ab over
/// the part and that of w³ in the same place, as the quotient of the polynomials is a mean of these.
///
/// Where that polynomial would be too large the terms of the quotient rule are bounded apart: let A = N − c·w be the numerator
/// about a centre c of control points within R of it. Then |F − c| ≤ R, with W = min |w|
/// `|F_a| ≤ (|A_a| + R|w_a|)/W =: D_a` and `|F_ab| ≤ (|A_ab| + D_a|w_b| + D_b|w_a| + R|w_ab|)/W`, every |·| on the right
/// being the largest control point of that derivative's net over the part.
#[derive(Clone, Debug)]
pub(crate) struct Bends {
    degrees: Degrees,
    parts: Vec<[[f64; 3]; 3]>,
}

impl Bends {
    /// # Errors
    /// [`TessError::SolidPole`] where weights of two signs are left in a part that is not halved further.
    pub fn new(net: &SolidNet, solid: usize) -> Result<Self, TessError> {
        let (degrees, mut points) = (net.degrees, net.homogeneous());
        // Brought near 1, so that no cube of a weight and no square of a length leaves the range of numbers.
        let space = power_of_two_below(largest(points.iter().map(|p| p.xyz().abs().max_element())));
        let weight = power_of_two_below(largest(points.iter().map(|p| p.w.abs())));
        points.iter_mut().for_each(|p| *p = (p.xyz() / space).extend(p.w / weight));
        let kernel = |source: BernsteinError| TessError::Solid { solid, source: source.into() };
        let rule = match net.points {
            Points::Rational(_) => quotients(degrees, &points, MOST_TERMS).map_err(kernel)?,
            Points::Polynomial(_) => None,
        };
        let rule = match rule {
            Some(quotients) => Rule::Exact(Box::new(quotients)),
            None => Rule::Apart(Box::new(Derivatives::new(degrees, &points))),
        };
        let depth = DEPTH - usize::from(points.len() > LARGE);
        let mut todo = vec![(degrees.whole(), 0)];
        let (mut parts, mut seen) = (Vec::new(), 0);
        while let Some((part, level)) = todo.pop() {
            if level < depth {
                todo.extend(part.split().map(|part| (part, level + 1)));
                continue;
            }
            seen += 1;
            let net = degrees.restrict(&points, &part).map_err(kernel)?;
            if !one_sign(&net) {
                if level >= DEEPEST || seen > MOST_PARTS {
                    return Err(TessError::SolidPole { solid, at: place(&part) });
                }
                todo.extend(part.split().map(|part| (part, level + 1)));
                continue;
            }
            let bends = rule.over(&part, &net).map_err(kernel)?;
            parts.push(bends.map(|row| row.map(|bend| bend * space / weight)));
        }
        Ok(Self { degrees, parts })
    }

    /// A bound on the distance between the solid and the map that is linear on every simplex within a cell of the lattice, at
    /// equal parameters: `⅛ ΣΣ M_ab h_a h_b`, h being the steps of the lattice.
    ///
    /// By Taylor's formula about x, |F(x) − Σλᵢ F(vᵢ)| ≤ ½ Σλᵢ ΣΣ M_ab |dᵢ_a||dᵢ_b| with dᵢ = vᵢ − x. Over a cell of
    /// width h_a, Σλᵢ dᵢ_a² is the variance of a number in an interval of that length, at most h_a²/4, and mixed terms follow by
    /// Cauchy's inequality. The trilinear map of a hexahedron keeps the diagonal terms of the same bound.
    pub fn chord_error(&self, counts: [u32; 3]) -> f64 {
        self.worst(counts).iter().sum()
    }

    /// The shares that the steps of the parameters have in the bound, in the part where it is largest.
    fn worst(&self, counts: [u32; 3]) -> [f64; 3] {
        let steps = self.degrees.steps(counts).map(|n| 1.0 / f64::from(n));
        let share = |part: &[[f64; 3]; 3], a: usize| -> f64 {
            (0..3).map(|b| part[a][b] * steps[a] * steps[b]).sum::<f64>() / 8.0
        };
        let shares = self.parts.iter().map(|part| [0, 1, 2].map(|a| share(part, a)));
        let total = |shares: &[f64; 3]| shares.iter().sum::<f64>();
        shares.max_by(|a, b| total(a).total_cmp(&total(b))).unwrap_or([0.0; 3])
    }

    /// Counts that keep the tolerance, none much larger than it need be; as many as the lattice has, the rest are 1.
    /// `None` where one would be beyond `limit`.
    pub fn counts(&self, tolerance: f64, limit: u32) -> Option<[u32; 3]> {
        let mut counts = [1u32; 3];
        loop {
            let shares = self.worst(counts);
            if shares.iter().sum::<f64>() <= tolerance {
                return Some(counts);
            }
            // The fewest cells are those of equal shares: the parameter with the largest gets more, a sixteenth at a time when
            // there are many.
            let parameter = (0..3).max_by(|&a, &b| shares[a].total_cmp(&shares[b])).unwrap_or(0);
            let group = self.degrees.group_of(parameter);
            counts[group] += 1 + counts[group] / 16;
            if counts[group] > limit {
                return None;
            }
        }
    }
}

/// How the second derivatives are bounded.
enum Rule {
    /// As quotients.
    Exact(Box<Quotients>),
    /// Term by term of the quotient rule.
    Apart(Box<Derivatives>),
}

/// First and second derivatives of the homogeneous net, the latter for a ≤ b.
struct Derivatives {
    first: [Net<DVec4>; 3],
    second: [[Option<Net<DVec4>>; 3]; 3],
}

impl Derivatives {
    fn new(degrees: Degrees, points: &[DVec4]) -> Self {
        let first = [0, 1, 2].map(|a| degrees.derivative(points, a));
        let second = [0, 1, 2].map(|a| {
            [0, 1, 2].map(|b| {
                let (lower, net) = &first[a];
                (b >= a).then(|| lower.derivative(net, b))
            })
        });
        Self { first, second }
    }
}

impl Rule {
    /// The bounds over a part, over which the solid has this net, of weights of one sign.
    fn over(&self, part: &Part, net: &[DVec4]) -> Result<[[f64; 3]; 3], BernsteinError> {
        let mut bends = [[0.0; 3]; 3];
        match self {
            Self::Exact(quotients) => {
                let Quotients { degrees, numerators, denominator } = quotients.as_ref();
                let cube = degrees.restrict(denominator, part)?;
                for (a, row) in numerators.iter().enumerate() {
                    for (b, net) in row.iter().enumerate() {
                        let Some(net) = net else { continue };
                        let net = degrees.restrict(net, part)?;
                        let bend = largest(net.iter().zip(&cube).map(|(p, w)| p.length() / w.abs()));
                        (bends[a][b], bends[b][a]) = (bend, bend);
                    }
                }
            }
            Self::Apart(derivatives) => {
                let about = Centre::new(net);
                let over = |(degrees, net): &Net<DVec4>| -> Result<(f64, f64), BernsteinError> {
                    let net = degrees.restrict(net, part)?;
                    let numerator = net.iter().map(|p| (p.xyz() - about.centre * p.w).length());
                    Ok((largest(numerator), largest(net.iter().map(|p| p.w.abs()))))
                };
                let mut slopes = [(0.0, 0.0); 3];
                for (slope, net) in slopes.iter_mut().zip(&derivatives.first) {
                    let (numerator, weight) = over(net)?;
                    *slope = ((numerator + about.radius * weight) / about.weight, weight);
                }
                for (a, row) in derivatives.second.iter().enumerate() {
                    for (b, net) in row.iter().enumerate() {
                        let Some(net) = net else { continue };
                        let (numerator, weight) = over(net)?;
                        let ((by_a, weight_a), (by_b, weight_b)) = (slopes[a], slopes[b]);
                        let terms = numerator + by_a * weight_b + by_b * weight_a + about.radius * weight;
                        let bend = terms / about.weight;
                        (bends[a][b], bends[b][a]) = (bend, bend);
                    }
                }
            }
        }
        Ok(bends)
    }
}

/// A ball around control points, and their least weight.
struct Centre {
    centre: DVec3,
    radius: f64,
    weight: f64,
}

impl Centre {
    fn new(net: &[DVec4]) -> Self {
        let points = || net.iter().map(|p| p.xyz() / p.w);
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
        let centre = 0.5 * (low + high);
        let radius = largest(points().map(|p| p.distance(centre)));
        let weight = net.iter().map(|p| p.w.abs()).fold(f64::INFINITY, f64::min);
        Self { centre, radius, weight }
    }
}

pub(crate) fn one_sign(net: &[DVec4]) -> bool {
    net.iter().all(|p| p.w > 0.0) || net.iter().all(|p| p.w < 0.0)
}

/// Infinity where one is not a number, as weights of all but no size beside others make it.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, x| if x.is_nan() { f64::INFINITY } else { most.max(x) })
}

/// The parameters of a point in a part: the first three of its local ones, the height in place of the third in a wedge.
fn place(part: &Part) -> [f64; 3] {
    match part {
        Part::Hexahedron(intervals) => intervals.map(|[a, b]| 0.5 * (a + b)),
        Part::Tetrahedron(corners) => [0, 1, 2].map(|a| corners.iter().map(|c| 0.25 * c[a]).sum()),
        Part::Wedge(corners, [a, b]) => {
            let [x, y] = [0, 1].map(|a| corners.iter().map(|c| c[a]).sum::<f64>() / 3.0);
            [x, y, 0.5 * (a + b)]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::lattice::LatticeCell;
    use super::super::net::Local;
    use super::*;
    use proptest::prelude::*;

    /// Weights of a cell's corners: its middle, a diagonal's, and a place between.
    fn shares(corners: usize) -> Vec<Vec<f64>> {
        let sum = (corners * (corners + 1) / 2) as f64;
        let two =
            |a: usize, b: usize| (0..corners).map(|i| if i == a || i == b { 0.5 } else { 0.0 }).collect();
        vec![
            vec![1.0 / corners as f64; corners],
            (1..=corners).map(|i| i as f64 / sum).collect(),
            two(0, corners - 1),
            two(0, 1),
        ]
    }

    /// The distance of the solid from the cell, linear over what `rows` names, at equal parameters.
    fn deviation(net: &SolidNet, corners: &[Local], weights: &[f64]) -> f64 {
        let at: Local = std::array::from_fn(|a| corners.iter().zip(weights).map(|(c, w)| c[a] * w).sum());
        let linear: DVec3 = corners.iter().zip(weights).map(|(&c, &w)| net.point(c) * w).sum();
        net.point(at).distance(linear)
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

        #[test]
        fn the_bound_holds_in_every_cell(
            kind in 0..3usize,
            degrees in (0..=3usize, 0..=3usize, 0..=3usize),
            numbers in proptest::collection::vec((-1.0..1.0, -1.0..1.0, -1.0..1.0, 0.2..2.0), 64),
            rational in proptest::bool::ANY,
            counts in (1..=4u32, 1..=4u32, 1..=4u32),
        ) {
            let (l, m, n) = degrees;
            let degrees = match kind {
                0 => Degrees::Hexahedron([l, m, n]),
                1 => Degrees::Tetrahedron(l),
                _ => Degrees::Wedge([l, m]),
            };
            let numbers = numbers.iter().cycle().take(degrees.count());
            let points = if rational {
                Points::Rational(numbers.map(|&(x, y, z, w)| DVec4::new(x * w, y * w, z * w, w)).collect())
            } else {
                Points::Polynomial(numbers.map(|&(x, y, z, _)| DVec3::new(x, y, z)).collect())
            };
            let net = SolidNet { degrees, points };
            let bends = Bends::new(&net, 0).unwrap();
            let rule = Rule::Apart(Box::new(Derivatives::new(degrees, &net.homogeneous())));
            let apart = Bends { degrees, parts: vec![rule.over(&degrees.whole(), &net.homogeneous()).unwrap()] };
            let counts = [counts.0, counts.1, counts.2];
            let bound = bends.chord_error(counts);
            let mut worst = 0.0f64;
            degrees.each_cell(counts, |cell| {
                let corners: Vec<Local> = cell.places().iter().map(|&at| degrees.local(at, counts)).collect();
                // A box and a prism: the trilinear map at weights that are products, and tetrahedra within.
                let rows: Vec<Vec<usize>> = match cell {
                    LatticeCell::Hexahedron(_) => vec![vec![0, 1, 2, 6], vec![0, 3, 7, 6], vec![1, 3, 4, 6]],
                    LatticeCell::Wedge(_) => vec![vec![0, 1, 2, 3], vec![1, 2, 3, 5]],
                    LatticeCell::Tetrahedron(_) => vec![vec![0, 1, 2, 3]],
                };
                for row in rows {
                    let simplex: Vec<Local> = row.iter().map(|&i| corners[i]).collect();
                    for weights in shares(4) {
                        worst = worst.max(deviation(&net, &simplex, &weights));
                    }
                }
                if let LatticeCell::Hexahedron(_) = cell {
                    for [x, y, z] in [[0.5; 3], [0.5, 0.5, 0.0], [0.25, 0.75, 0.5]] {
                        let at = |i: usize| {
                            let bit = |value: f64, on: bool| if on { value } else { 1.0 - value };
                            bit(x, [1, 2, 5, 6].contains(&i)) * bit(y, [2, 3, 6, 7].contains(&i)) * bit(z, i > 3)
                        };
                        let weights: Vec<f64> = (0..8).map(at).collect();
                        worst = worst.max(deviation(&net, &corners, &weights));
                    }
                }
                Ok::<(), ()>(())
            }).unwrap();
            // Rounding of values below 2.
            prop_assert!(worst <= bound + 1e-13, "{} {}", worst, bound);
            prop_assert!(worst <= apart.chord_error(counts) + 1e-13);
        }

        #[test]
        fn counts_keep_the_tolerance_and_no_more(
            numbers in proptest::collection::vec((-1.0..1.0, -1.0..1.0, -1.0..1.0), 36),
            tolerance in 1e-3..1e-1,
        ) {
            let degrees = Degrees::Hexahedron([2, 2, 3]);
            let points = Points::Polynomial(numbers.iter().map(|&(x, y, z)| DVec3::new(x, y, z)).collect());
            let bends = Bends::new(&SolidNet { degrees, points }, 0).unwrap();
            let counts = bends.counts(tolerance, 1 << 20).unwrap();
            prop_assert!(bends.chord_error(counts) <= tolerance);
            // A step back, a sixteenth and one at most, in every parameter, and it does not.
            let less = counts.map(|n| (n - 1 - n / 16).max(1));
            prop_assert!(counts == [1; 3] || bends.chord_error(less) > tolerance);
        }
    }
}
