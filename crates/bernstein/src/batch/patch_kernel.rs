//! The kernels of a patch at a register of scattered parameters.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::horner::horner;
use super::nets::ORDERS;
use super::patch::View;
use super::simd::{Job, Lanes, WIDTH, dispatch_in};
use crate::{binomial, partial_index};

/// Degrees less than this one have their basis in registers on the stack.
pub(super) const MAX_BASIS: usize = 32;

/// Ways to evaluate: Horner schemes in the quotients, with the degrees known to the compiler or not, and by
/// the basis.
pub(super) const BICUBIC: u8 = 0;
pub(super) const QUOTIENTS: u8 = 1;
pub(super) const BASIS: u8 = 2;

/// A register of parameters (u, v).
pub(super) struct At<S: Lanes> {
    simd: S,
    pub(super) u: S::f64s,
    pub(super) v: S::f64s,
    /// 1 − u and 1 − v.
    pub(super) su: S::f64s,
    pub(super) sv: S::f64s,
    /// u/(1−u) and v/(1−v).
    x: S::f64s,
    y: S::f64s,
    /// The lanes where one of the quotients does not exist.
    ends: S::m64s,
    any_end: bool,
}

impl<S: Lanes> At<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, u: S::f64s, v: S::f64s) -> Self {
        let (one, zero) = (simd.splat_f64s(1.0), simd.splat_f64s(0.0));
        let (su, sv) = (simd.sub_f64s(one, u), simd.sub_f64s(one, v));
        let ends = simd.or_m64s(simd.equal_f64s(su, zero), simd.equal_f64s(sv, zero));
        let (x, y) = (simd.div_f64s(u, su), simd.div_f64s(v, sv));
        Self { simd, u, v, su, sv, x, y, ends, any_end: simd.any(ends) }
    }

    /// `∂ᵃ⁺ᵇp/∂uᵃ∂vᵇ = (1−u)ᵐ⁻ᵃ (1−v)ⁿ⁻ᵇ Σᵢ Σⱼ qᵢⱼ xⁱ yʲ`.
    #[inline(always)]
    pub(super) fn partial<const D: usize, const WAY: u8, const A: usize, const B: usize>(
        &self,
        patch: &View<'_>,
    ) -> [S::f64s; D] {
        let simd = self.simd;
        let mut sum = [simd.splat_f64s(0.0); D];
        let [m, n] = if WAY == BICUBIC { [3, 3] } else { patch.degrees };
        let [Some(m), Some(n)] = [m.checked_sub(A), n.checked_sub(B)] else { return sum };
        let k = partial_index(A, B);
        let q: &[[f64; D]] = &patch.scaled[k].as_chunks().0[..(m + 1) * (n + 1)];
        sum = horner(simd, &q[m * (n + 1)..], self.y);
        for i in (0..m).rev() {
            let row = horner(simd, &q[i * (n + 1)..(i + 1) * (n + 1)], self.y);
            for c in 0..D {
                sum[c] = simd.mul_add_f64s(sum[c], self.x, row[c]);
            }
        }
        let power = simd.mul_f64s(simd.power(self.su, m), simd.power(self.sv, n));
        for c in 0..D {
            sum[c] = simd.mul_f64s(sum[c], power);
        }
        if self.any_end {
            let mut ends = [[0.0; WIDTH]; 4];
            at_ends::<D>(patch, k, &array::<S>(self.u), &array::<S>(self.v), &mut ends);
            for c in 0..D {
                sum[c] = simd.select_f64s(self.ends, simd.load(&ends[c], 0), sum[c]);
            }
        }
        sum
    }

    /// The derivative at place k in the list of orders, as `Σᵢ Bᵢᵐ⁻ᵃ(u) Σⱼ Bⱼⁿ⁻ᵇ(v) Nᵢⱼ`; the degrees are
    /// less than [`MAX_BASIS`].
    #[inline(always)]
    pub(super) fn by_basis<const D: usize>(&self, patch: &View<'_>, k: usize) -> [S::f64s; D] {
        let simd = self.simd;
        let mut sum = [simd.splat_f64s(0.0); D];
        let ([m, n], [a, b]) = (patch.degrees, ORDERS[k]);
        let [Some(m), Some(n)] = [m.checked_sub(a), n.checked_sub(b)] else { return sum };
        let net: &[[f64; D]] = patch.plain[k].as_chunks().0;
        let (in_u, in_v) = (basis_lanes(simd, self.su, self.u, m), basis_lanes(simd, self.sv, self.v, n));
        for (i, row) in net.chunks_exact(n + 1).take(m + 1).enumerate() {
            let mut inner = [simd.splat_f64s(0.0); D];
            for (j, point) in row.iter().enumerate() {
                for c in 0..D {
                    inner[c] = simd.mul_add_f64s(in_v[j], simd.splat_f64s(point[c]), inner[c]);
                }
            }
            for c in 0..D {
                sum[c] = simd.mul_add_f64s(in_u[i], inner[c], sum[c]);
            }
        }
        sum
    }
}

/// The lanes of a register, and zeros.
#[inline(always)]
fn array<S: Lanes>(register: S::f64s) -> [f64; WIDTH] {
    let mut numbers = [0.0; WIDTH];
    S::as_mut_simd_f64s(&mut numbers).0[0] = register;
    numbers
}

/// A derivative by the basis, for blocks with u = 1 or v = 1 somewhere; apart, so that the kernels stay
/// small.
#[cold]
#[inline(never)]
fn at_ends<const D: usize>(
    patch: &View<'_>,
    k: usize,
    u: &[f64; WIDTH],
    v: &[f64; WIDTH],
    out: &mut [[f64; WIDTH]; 4],
) {
    dispatch_in::<_, D>(Ends { patch, k, u, v, out });
}

struct Ends<'a> {
    patch: &'a View<'a>,
    k: usize,
    u: &'a [f64; WIDTH],
    v: &'a [f64; WIDTH],
    /// One row a component.
    out: &'a mut [[f64; WIDTH]; 4],
}

impl Job for Ends<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes, const D: usize>(self, simd: S) {
        let mut place = 0;
        while place < WIDTH {
            let at = At::new(simd, simd.load(self.u, place), simd.load(self.v, place));
            let sum: [S::f64s; D] = at.by_basis(self.patch, self.k);
            for c in 0..D {
                S::as_mut_simd_f64s(&mut self.out[c][place..]).0[0] = sum[c];
            }
            place += S::F64_LANES;
        }
    }
}

/// `C(n,i) sⁿ⁻ⁱ tⁱ`, n less than [`MAX_BASIS`].
#[inline(always)]
fn basis_lanes<S: Lanes>(simd: S, s: S::f64s, t: S::f64s, n: usize) -> [S::f64s; MAX_BASIS] {
    let mut row = [simd.splat_f64s(1.0); MAX_BASIS];
    let mut power = t;
    for (i, b) in row[..=n].iter_mut().enumerate().skip(1) {
        *b = simd.mul_f64s(power, simd.splat_f64s(binomial(n, i)));
        power = simd.mul_f64s(power, t);
    }
    power = s;
    for b in row[..n].iter_mut().rev() {
        *b = simd.mul_f64s(*b, power);
        power = simd.mul_f64s(power, s);
    }
    row
}
