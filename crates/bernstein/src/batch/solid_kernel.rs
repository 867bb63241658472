//! The kernels of a solid at a register of scattered parameters.
//!
//! With `q` the control points times their binomials, and r₁, r₂, r₃ the rests that belong to the coordinates u, v, w (see
//! `solid.rs`), the polynomial is `f Σᵢ Σⱼ Σₖ q xⁱ yʲ zᵏ`, x = u/r₁, y = v/r₂, z = w/r₃: nested Horner schemes, one
//! multiply-add a control point and component. The factor f is the product of the powers of the rests, r₁ˡ r₂ᵐ r₃ⁿ of a box,
//! λ₃ⁿ(1−w)ᵒ of a wedge, λ₄ⁿ of a tetrahedron.
//!
//! With N the total degree, a term takes the rounding of f's N factors and N of their product, 2 of each of the i + j + k
//! quotients, i + j + k + 3 of the schemes, and 1 to 3 of q; the roundings of the rests themselves, two of a last barycentric
//! coordinate, count only as often as the rest is left over, N − i − j − k times. At most 4N + 6 together.
//!
//! Where a quotient is so large that `(1 + |x| + |y| + |z|)ᴺ` may leave the range of numbers, in the lanes on the faces where
//! a rest is 0 and next to them, the powers of all coordinates are taken instead.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::scattered::Form;
use super::simd::{Job, Lanes, WIDTH, dispatch_in};
use super::solid::{Kind, Shape, View};
use super::triangle::last;

/// The highest total degree that has a kernel.
pub(super) const MOST: usize = 60;

/// Ways to evaluate: with degrees known to the compiler or not.
pub(super) const ANY: u8 = 0;
/// A box of the degrees (3, 3, 3).
pub(super) const TRICUBIC: u8 = 1;
/// A tetrahedron of degree 4.
pub(super) const QUARTIC: u8 = 2;

/// The place in the list of derivatives of the one with each coordinate.
const AXES: [Option<usize>; 4] = [None, Some(0), Some(1), Some(2)];

#[derive(Clone, Copy)]
pub(super) struct Solid<'a, const WAY: u8>(pub(super) View<'a>);

impl<const WAY: u8> Solid<'_, WAY> {
    /// The shape that this way is for.
    pub(super) const SHAPE: Shape = match WAY {
        TRICUBIC => Shape { kind: Kind::Box, degrees: [3; 3] },
        _ => Shape { kind: Kind::Tetrahedron, degrees: [4; 3] },
    };

    #[inline(always)]
    fn shape(&self) -> Shape {
        if WAY == ANY { self.0.shape } else { Self::SHAPE }
    }

    /// The sum without f, and the shape it has, of the derivative at place `k`; `None` where it vanishes.
    #[inline(always)]
    fn sum<S: Lanes, const D: usize>(&self, simd: S, at: &At<S>, k: usize) -> Option<([S::f64s; D], Shape)> {
        let shape = self.shape().lowered(AXES[k])?;
        Some((horner(simd, at.quotients, shape, self.0.scaled[k].as_chunks().0), shape))
    }

    /// Replaces the lanes where a quotient is too large, by the derivative at place `k` itself.
    #[inline(always)]
    fn mend<S: Lanes, const D: usize>(
        &self,
        simd: S,
        at: &At<S>,
        k: usize,
        shape: Shape,
        sum: &mut [S::f64s; D],
    ) {
        let mut lanes = [[0.0; WIDTH]; 6];
        for a in 0..3 {
            S::as_mut_simd_f64s(&mut lanes[a]).0[0] = at.coordinates[a];
            S::as_mut_simd_f64s(&mut lanes[3 + a]).0[0] = at.rests[a];
        }
        let mut numbers = [[0.0; WIDTH]; 4];
        by_powers::<D>(shape, &self.0.scaled[k], &lanes, &mut numbers);
        for c in 0..D {
            sum[c] = simd.select_f64s(at.ends, simd.load(&numbers[c], 0), sum[c]);
        }
    }
}

/// A register of places.
pub(super) struct At<S: Lanes> {
    coordinates: [S::f64s; 3],
    /// r₁, r₂ and r₃, where they have a power of their own in f; 1 in the place of repeated ones.
    rests: [S::f64s; 3],
    /// 1/r₁, 1/r₂ and 1/r₃.
    inverses: [S::f64s; 3],
    /// x, y and z.
    quotients: [S::f64s; 3],
    /// The lanes where one of these is too large.
    ends: S::m64s,
    any_end: bool,
}

impl<S: Lanes> At<S> {
    /// The product of the powers of the rests.
    #[inline(always)]
    fn factor(&self, simd: S, shape: Shape) -> S::f64s {
        let [l, m, n] = shape.degrees;
        let mut factor = simd.power(self.rests[2], n);
        if shape.kind != Kind::Tetrahedron {
            factor = simd.mul_f64s(factor, simd.power(self.rests[1], m));
        }
        if shape.kind == Kind::Box {
            factor = simd.mul_f64s(factor, simd.power(self.rests[0], l));
        }
        factor
    }
}

impl<const WAY: u8> Form<3> for Solid<'_, WAY> {
    type At<S: Lanes> = At<S>;

    fn net(&self) -> &[f64] {
        self.0.net
    }

    fn degree(&self) -> usize {
        self.0.shape.total()
    }

    #[inline(always)]
    fn at<S: Lanes>(&self, simd: S) -> At<S> {
        let (zero, one) = (simd.splat_f64s(0.0), simd.splat_f64s(1.0));
        At {
            coordinates: [zero; 3],
            rests: [one; 3],
            inverses: [one; 3],
            quotients: [zero; 3],
            ends: simd.less_than_f64s(one, zero),
            any_end: false,
        }
    }

    #[inline(always)]
    fn move_to<S: Lanes>(&self, simd: S, at: &mut At<S>, parameters: [S::f64s; 3]) {
        let shape = self.shape();
        let one = simd.splat_f64s(1.0);
        let [u, v, w] = parameters;
        let inverse = |rest| simd.div_f64s(one, rest);
        match shape.kind {
            Kind::Box => {
                at.rests = [simd.sub_f64s(one, u), simd.sub_f64s(one, v), simd.sub_f64s(one, w)];
                at.inverses = [inverse(at.rests[0]), inverse(at.rests[1]), inverse(at.rests[2])];
            }
            Kind::Wedge => {
                at.rests = [one, last(simd, [u, v]), simd.sub_f64s(one, w)];
                let of_triangle = inverse(at.rests[1]);
                at.inverses = [of_triangle, of_triangle, inverse(at.rests[2])];
            }
            Kind::Tetrahedron => {
                at.rests = [one, one, last(simd, parameters)];
                at.inverses = [inverse(at.rests[2]); 3];
            }
        }
        at.coordinates = parameters;
        // With |x|, |y| and |z| at most 2ˡ, 1 + |x| + |y| + |z| is at most 2ˡ⁺².
        let limit = (1_u64 << (477 / shape.total().max(1)).min(53).saturating_sub(2)) as f64;
        let mut largest = simd.splat_f64s(0.0);
        for a in 0..3 {
            at.quotients[a] = simd.mul_f64s(parameters[a], at.inverses[a]);
            // A sum, as no maximum is sure to keep what is not a number.
            largest = simd.add_f64s(largest, simd.abs_f64s(at.quotients[a]));
        }
        let small = simd.less_than_or_equal_f64s(largest, simd.splat_f64s(limit));
        at.any_end = !simd.all(small);
        if at.any_end {
            at.ends = simd.xor_m64s(small, simd.equal_f64s(one, one));
        }
    }

    #[inline(always)]
    fn jet<S: Lanes, const D: usize, const K: usize>(&self, simd: S, at: &At<S>) -> [[S::f64s; D]; K] {
        let mut jet = [[simd.splat_f64s(0.0); D]; K];
        for k in 0..K {
            let Some((mut sum, shape)) = self.sum::<S, D>(simd, at, k) else { continue };
            let factor = at.factor(simd, shape);
            for c in 0..D {
                sum[c] = simd.mul_f64s(sum[c], factor);
            }
            if at.any_end {
                self.mend(simd, at, k, shape, &mut sum);
            }
            jet[k] = sum;
        }
        jet
    }

    #[inline(always)]
    fn homogeneous<S: Lanes, const K: usize>(&self, simd: S, at: &At<S>) -> [[S::f64s; 4]; K] {
        let mut jet = [[simd.splat_f64s(0.0); 4]; K];
        for k in 0..K {
            let Some((mut sum, shape)) = self.sum::<S, 4>(simd, at, k) else { continue };
            if let Some(axis) = AXES[k] {
                for c in 0..4 {
                    sum[c] = simd.mul_f64s(sum[c], at.inverses[axis]);
                }
            }
            if at.any_end {
                self.mend(simd, at, k, shape, &mut sum);
            }
            jet[k] = sum;
        }
        jet
    }

    #[inline(always)]
    fn factor<S: Lanes>(&self, simd: S, at: &At<S>) -> S::f64s {
        let factor = at.factor(simd, self.shape());
        if at.any_end { simd.select_f64s(at.ends, simd.splat_f64s(1.0), factor) } else { factor }
    }

    /// (1 + |x|)ˡ (1 + |y|)ᵐ (1 + |z|)ⁿ, where rests are shared (1 + |x| + …)ⁿ; infinite, or not a number, at the ends,
    /// which are then looked at one by one.
    #[inline(always)]
    fn spread<S: Lanes>(&self, simd: S, at: &At<S>) -> S::f64s {
        let shape = self.shape();
        let [l, m, n] = shape.degrees;
        let mut sizes = at.quotients;
        for a in 0..3 {
            sizes[a] = simd.abs_f64s(sizes[a]);
        }
        let one = simd.splat_f64s(1.0);
        let [x, y, z] = sizes;
        let spread = match shape.kind {
            Kind::Box => {
                let in_u = simd.power(simd.add_f64s(one, x), l);
                let in_v = simd.power(simd.add_f64s(one, y), m);
                simd.mul_f64s(simd.mul_f64s(in_u, in_v), simd.power(simd.add_f64s(one, z), n))
            }
            Kind::Wedge => {
                let in_triangle = simd.power(simd.add_f64s(one, simd.add_f64s(x, y)), l);
                simd.mul_f64s(in_triangle, simd.power(simd.add_f64s(one, z), n))
            }
            Kind::Tetrahedron => simd.power(simd.add_f64s(one, simd.add_f64s(x, simd.add_f64s(y, z))), l),
        };
        if at.any_end { simd.select_f64s(at.ends, simd.splat_f64s(f64::INFINITY), spread) } else { spread }
    }

    /// Inside, and away from the faces that the quotients do not reach.
    #[inline(always)]
    fn is_inside<S: Lanes>(&self, simd: S, at: &At<S>) -> bool {
        let zero = simd.splat_f64s(0.0);
        let [x, y, z] = at.quotients;
        let not_negative = |x| simd.greater_than_or_equal_f64s(x, zero);
        let all = simd.and_m64s(not_negative(x), simd.and_m64s(not_negative(y), not_negative(z)));
        !at.any_end && simd.all(all)
    }

    fn scale(&self, at: [f64; 3], scratch: &mut Vec<f64>) -> f64 {
        self.0.shape.scale(self.0.net, at, scratch)
    }
}

/// `Σᵢ Σⱼ Σₖ q xⁱ yʲ zᵏ`, q standing from the last i, j, k to the first.
#[inline(always)]
fn horner<S: Lanes, const D: usize>(
    simd: S,
    [x, y, z]: [S::f64s; 3],
    shape: Shape,
    net: &[[f64; D]],
) -> [S::f64s; D] {
    let mut sum = [simd.splat_f64s(0.0); D];
    let mut first = 0;
    for i in (0..=shape.degrees[0]).rev() {
        let middle = shape.middle(i);
        let mut column = [simd.splat_f64s(0.0); D];
        for j in (0..=middle).rev() {
            let inner = shape.inner(i, j);
            let line = &net[first..=first + inner];
            first += inner + 1;
            let mut row = [simd.splat_f64s(0.0); D];
            for c in 0..D {
                row[c] = simd.splat_f64s(line[0][c]);
            }
            for point in &line[1..] {
                for c in 0..D {
                    row[c] = simd.mul_add_f64s(row[c], z, simd.splat_f64s(point[c]));
                }
            }
            for c in 0..D {
                column[c] = if j == middle { row[c] } else { simd.mul_add_f64s(column[c], y, row[c]) };
            }
        }
        for c in 0..D {
            sum[c] = if i == shape.degrees[0] { column[c] } else { simd.mul_add_f64s(sum[c], x, column[c]) };
        }
    }
    sum
}

/// `Σᵢ Σⱼ Σₖ q uⁱ r₁ˡ⁻ⁱ vʲ r₂ᵐ⁻ʲ wᵏ r₃ⁿ⁻ᵏ`, m and n being as far as j and k run; apart, so that the kernels stay small.
///
/// `lanes` holds the three coordinates and their rests.
#[cold]
#[inline(never)]
fn by_powers<const D: usize>(
    shape: Shape,
    net: &[f64],
    lanes: &[[f64; WIDTH]; 6],
    out: &mut [[f64; WIDTH]; 4],
) {
    dispatch_in::<_, D>(Powers { shape, net, lanes, out });
}

struct Powers<'a> {
    shape: Shape,
    net: &'a [f64],
    lanes: &'a [[f64; WIDTH]; 6],
    /// One row a component.
    out: &'a mut [[f64; WIDTH]; 4],
}

impl Job for Powers<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let Self { shape, net, lanes, out } = self;
        let net: &[[f64; D]] = net.as_chunks().0;
        let (zero, one) = (simd.splat_f64s(0.0), simd.splat_f64s(1.0));
        let most = shape.total();
        let mut place = 0;
        while place < WIDTH {
            let mut powers = [[one; MOST + 1]; 6];
            for a in 0..6 {
                let x = simd.load(&lanes[a], place);
                for exponent in 1..=most {
                    powers[a][exponent] = simd.mul_f64s(powers[a][exponent - 1], x);
                }
            }
            let weight =
                |a: usize, i: usize, most: usize| simd.mul_f64s(powers[a][i], powers[3 + a][most - i]);
            let mut sum = [zero; D];
            let mut first = 0;
            for i in (0..=shape.degrees[0]).rev() {
                let middle = shape.middle(i);
                let mut column = [zero; D];
                for j in (0..=middle).rev() {
                    let inner = shape.inner(i, j);
                    let mut row = [zero; D];
                    for k in (0..=inner).rev() {
                        let weight = weight(2, k, inner);
                        for c in 0..D {
                            row[c] = simd.mul_add_f64s(weight, simd.splat_f64s(net[first][c]), row[c]);
                        }
                        first += 1;
                    }
                    let weight = weight(1, j, middle);
                    for c in 0..D {
                        column[c] = simd.mul_add_f64s(weight, row[c], column[c]);
                    }
                }
                let weight = weight(0, i, shape.degrees[0]);
                for c in 0..D {
                    sum[c] = simd.mul_add_f64s(weight, column[c], sum[c]);
                }
            }
            for c in 0..D {
                S::as_mut_simd_f64s(&mut out[c][place..]).0[0] = sum[c];
            }
            place += S::F64_LANES;
        }
    }
}
