//! Vector registers, and the choice of the widest that the processor has.
//!
//! A kernel is a [`Job`], written once over [`Lanes`]. All registers do the same operations in the same
//! order, with a multiplication fused into an addition exactly where the kernel says `mul_add`, and no
//! operation of a kernel mixes lanes: a lane's result has the same bits in every lane and with every
//! instruction set.
//!
//! Everything that touches a register is marked `#[inline(always)]`, and loops over registers are plain `for`
//! loops: a function of the standard library between the two would be compiled without the vector
//! instructions.

// An index says it best, and no adaptor stands between the registers and the function that has their
// instructions.
#![allow(clippy::needless_range_loop)]

use pulp::{NullaryFnOnce, Scalar, Simd};

/// The widest register, in f64: tables are padded to multiples of it.
pub(super) const WIDTH: usize = 8;

/// A kernel, for points of `D` numbers.
pub(super) trait Job {
    type Output;

    fn run<S: Lanes, const D: usize>(self, simd: S) -> Self::Output;
}

/// The instruction sets that kernels are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Path {
    /// One lane and `f64::mul_add`: every processor.
    Portable,
    /// AVX2 and FMA: 4 lanes.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// AVX-512 (F, BW, CD, DQ, VL): 8 lanes.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Path {
    /// The paths that this processor can take, the fastest first.
    pub(super) fn available() -> impl Iterator<Item = Self> {
        #[cfg(target_arch = "x86_64")]
        let vector = [
            pulp::x86::V4::is_available().then_some(Self::Avx512),
            pulp::x86::V3::is_available().then_some(Self::Avx2),
        ];
        #[cfg(not(target_arch = "x86_64"))]
        let vector = [];
        vector.into_iter().flatten().chain([Self::Portable])
    }

    /// The fastest path, or the one that a test forces upon its thread.
    fn chosen() -> Self {
        #[cfg(test)]
        if let Some(path) = FORCED.get() {
            return path;
        }
        Self::available().next().unwrap_or(Self::Portable)
    }

    /// Runs `job` for points of `dimension` numbers; a path that the processor lacks falls back to the
    /// portable one.
    pub(super) fn run<J: Job>(self, dimension: usize, job: J) -> J::Output {
        match dimension {
            1 => self.run_in::<J, 1>(job),
            2 => self.run_in::<J, 2>(job),
            3 => self.run_in::<J, 3>(job),
            _ => self.run_in::<J, 4>(job),
        }
    }

    fn run_in<J: Job, const D: usize>(self, job: J) -> J::Output {
        #[cfg(target_arch = "x86_64")]
        match self {
            Self::Avx512 => {
                if let Some(simd) = pulp::x86::V4::try_new() {
                    return simd.vectorize(Call::<_, _, D> { simd, job });
                }
            }
            Self::Avx2 => {
                if let Some(simd) = pulp::x86::V3::try_new() {
                    return simd.vectorize(Call::<_, _, D> { simd, job });
                }
            }
            Self::Portable => {}
        }
        job.run::<Scalar, D>(Scalar)
    }
}

#[cfg(test)]
thread_local! {
    /// The path that batches of this thread take.
    pub(super) static FORCED: std::cell::Cell<Option<Path>> = const { std::cell::Cell::new(None) };
}

/// Runs `job` on the widest registers that the processor has.
pub(super) fn dispatch<J: Job>(dimension: usize, job: J) -> J::Output {
    Path::chosen().run(dimension, job)
}

/// As [`dispatch`], for one dimension only.
pub(super) fn dispatch_in<J: Job, const D: usize>(job: J) -> J::Output {
    Path::chosen().run_in::<J, D>(job)
}

struct Call<S, J, const D: usize> {
    simd: S,
    job: J,
}

impl<S: Lanes, J: Job, const D: usize> NullaryFnOnce for Call<S, J, D> {
    type Output = J::Output;

    #[inline(always)]
    fn call(self) -> Self::Output {
        self.job.run::<S, D>(self.simd)
    }
}

/// A kind of register, with the moves between registers and points.
pub(super) trait Lanes: Simd {
    /// From one register a component to the points one after another: lane l of `parts[c]` becomes number
    /// `D·l + c` of the registers returned.
    fn interleave<const D: usize>(self, parts: [Self::f64s; D]) -> [Self::f64s; D];

    /// The components of pairs or triples: x of each, then y, then z. The inverse of
    /// [`interleave`](Self::interleave) for D = 2 and 3.
    fn deinterleave<const D: usize>(self, numbers: [Self::f64s; D]) -> [Self::f64s; D];

    /// The register that begins at `place`.
    #[inline(always)]
    fn load(self, slice: &[f64], place: usize) -> Self::f64s {
        Self::as_simd_f64s(&slice[place..place + Self::F64_LANES]).0[0]
    }

    /// Whether any lane is true.
    #[inline(always)]
    fn any(self, mask: Self::m64s) -> bool {
        self.first_true_m64s(mask) != Self::F64_LANES
    }

    /// Whether all lanes are true.
    #[inline(always)]
    fn all(self, mask: Self::m64s) -> bool {
        let zero = self.splat_f64s(0.0);
        !self.any(self.xor_m64s(mask, self.equal_f64s(zero, zero)))
    }

    /// The power of a non-negative integer exponent, with less than `exponent` roundings.
    #[inline(always)]
    fn power(self, x: Self::f64s, exponent: usize) -> Self::f64s {
        let (mut square, mut rest) = (x, exponent);
        while rest > 0 && rest & 1 == 0 {
            square = self.mul_f64s(square, square);
            rest >>= 1;
        }
        if rest == 0 {
            return self.splat_f64s(1.0);
        }
        let mut result = square;
        rest >>= 1;
        while rest > 0 {
            square = self.mul_f64s(square, square);
            if rest & 1 == 1 {
                result = self.mul_f64s(result, square);
            }
            rest >>= 1;
        }
        result
    }
}

impl Lanes for Scalar {
    #[inline(always)]
    fn interleave<const D: usize>(self, parts: [f64; D]) -> [f64; D] {
        parts
    }

    #[inline(always)]
    fn deinterleave<const D: usize>(self, numbers: [f64; D]) -> [f64; D] {
        numbers
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use std::arch::x86_64::{__m256d, __m512d, __m512i};

    use pulp::x86::{V3, V4};
    use pulp::{Simd, cast, f64x4, f64x8};

    use super::Lanes;

    impl Lanes for V3 {
        #[inline(always)]
        fn interleave<const D: usize>(self, parts: [f64x4; D]) -> [f64x4; D] {
            let avx = self.avx;
            let mut p = [cast::<f64x4, __m256d>(self.splat_f64s(0.0)); D];
            for c in 0..D {
                p[c] = cast(parts[c]);
            }
            let mut out = p;
            // Comments name the lanes, lowest first.
            match D {
                2 => {
                    let even = avx._mm256_unpacklo_pd(p[0], p[1]); // x0 y0 x2 y2
                    let odd = avx._mm256_unpackhi_pd(p[0], p[1]); // x1 y1 x3 y3
                    out[0] = avx._mm256_permute2f128_pd::<0x20>(even, odd);
                    out[1] = avx._mm256_permute2f128_pd::<0x31>(even, odd);
                }
                3 => {
                    let xy = avx._mm256_unpacklo_pd(p[0], p[1]); // x0 y0 x2 y2
                    let yz = avx._mm256_unpackhi_pd(p[1], p[2]); // y1 z1 y3 z3
                    let zx = avx._mm256_blend_pd::<0b1010>(p[2], p[0]); // z0 x1 z2 x3
                    out[0] = avx._mm256_permute2f128_pd::<0x20>(xy, zx);
                    out[1] = avx._mm256_blend_pd::<0b1100>(yz, xy);
                    out[2] = avx._mm256_permute2f128_pd::<0x31>(zx, yz);
                }
                4 => {
                    let xy = avx._mm256_unpacklo_pd(p[0], p[1]); // x0 y0 x2 y2
                    let zw = avx._mm256_unpacklo_pd(p[2], p[3]); // z0 w0 z2 w2
                    out[0] = avx._mm256_permute2f128_pd::<0x20>(xy, zw);
                    out[2] = avx._mm256_permute2f128_pd::<0x31>(xy, zw);
                    let xy = avx._mm256_unpackhi_pd(p[0], p[1]); // x1 y1 x3 y3
                    let zw = avx._mm256_unpackhi_pd(p[2], p[3]); // z1 w1 z3 w3
                    out[1] = avx._mm256_permute2f128_pd::<0x20>(xy, zw);
                    out[3] = avx._mm256_permute2f128_pd::<0x31>(xy, zw);
                }
                _ => {}
            }
            let mut numbers = parts;
            for c in 0..D {
                numbers[c] = cast(out[c]);
            }
            numbers
        }

        #[inline(always)]
        fn deinterleave<const D: usize>(self, numbers: [f64x4; D]) -> [f64x4; D] {
            let avx = self.avx;
            let mut p = [cast::<f64x4, __m256d>(self.splat_f64s(0.0)); D];
            for c in 0..D {
                p[c] = cast(numbers[c]);
            }
            let mut out = p;
            match D {
                2 => {
                    let low = avx._mm256_permute2f128_pd::<0x20>(p[0], p[1]); // x0 y0 x2 y2
                    let high = avx._mm256_permute2f128_pd::<0x31>(p[0], p[1]); // x1 y1 x3 y3
                    out[0] = avx._mm256_unpacklo_pd(low, high);
                    out[1] = avx._mm256_unpackhi_pd(low, high);
                }
                3 => {
                    let xy = avx._mm256_blend_pd::<0b1100>(p[0], p[1]); // x0 y0 x2 y2
                    let zx = avx._mm256_permute2f128_pd::<0x21>(p[0], p[2]); // z0 x1 z2 x3
                    let yz = avx._mm256_blend_pd::<0b1100>(p[1], p[2]); // y1 z1 y3 z3
                    out[0] = avx._mm256_blend_pd::<0b1010>(xy, zx);
                    out[1] = avx._mm256_shuffle_pd::<0b0101>(xy, yz);
                    out[2] = avx._mm256_blend_pd::<0b1010>(zx, yz);
                }
                _ => {}
            }
            let mut parts = numbers;
            for c in 0..D {
                parts[c] = cast(out[c]);
            }
            parts
        }
    }

    /// Two registers shuffled into one; 8 + l is lane l of the second.
    #[inline(always)]
    fn pick(simd: V4, a: __m512d, b: __m512d, lanes: [u64; 8]) -> __m512d {
        simd.avx512f._mm512_permutex2var_pd(a, cast::<[u64; 8], __m512i>(lanes), b)
    }

    /// Lane l taken from lane `lanes[l]`.
    #[inline(always)]
    fn rotate(simd: V4, a: __m512d, lanes: [u64; 8]) -> __m512d {
        simd.avx512f._mm512_permutexvar_pd(cast::<[u64; 8], __m512i>(lanes), a)
    }

    /// y where the bit of `ys` is set, z where that of `zs` is, x elsewhere; the lowest bit is that of lane
    /// 0.
    #[inline(always)]
    fn choose(simd: V4, [x, y, z]: [__m512d; 3], ys: u8, zs: u8) -> __m512d {
        let xy = simd.avx512f._mm512_mask_blend_pd(ys, x, y);
        simd.avx512f._mm512_mask_blend_pd(zs, xy, z)
    }

    impl Lanes for V4 {
        #[inline(always)]
        fn interleave<const D: usize>(self, parts: [f64x8; D]) -> [f64x8; D] {
            let mut p = [cast::<f64x8, __m512d>(self.splat_f64s(0.0)); D];
            for c in 0..D {
                p[c] = cast(parts[c]);
            }
            let mut out = p;
            match D {
                2 => {
                    out[0] = pick(self, p[0], p[1], [0, 8, 1, 9, 2, 10, 3, 11]);
                    out[1] = pick(self, p[0], p[1], [4, 12, 5, 13, 6, 14, 7, 15]);
                }
                3 => {
                    // Lane l of component c belongs to lane (3l + c) mod 8 of one of the three.
                    let x = rotate(self, p[0], [0, 3, 6, 1, 4, 7, 2, 5]);
                    let y = rotate(self, p[1], [5, 0, 3, 6, 1, 4, 7, 2]);
                    let z = rotate(self, p[2], [2, 5, 0, 3, 6, 1, 4, 7]);
                    out[0] = choose(self, [x, y, z], 0b1001_0010, 0b0010_0100);
                    out[1] = choose(self, [x, y, z], 0b0010_0100, 0b0100_1001);
                    out[2] = choose(self, [x, y, z], 0b0100_1001, 0b1001_0010);
                }
                4 => {
                    let low = [0, 8, 1, 9, 2, 10, 3, 11];
                    let (xy, zw) = (pick(self, p[0], p[1], low), pick(self, p[2], p[3], low));
                    out[0] = pick(self, xy, zw, [0, 1, 8, 9, 2, 3, 10, 11]);
                    out[1] = pick(self, xy, zw, [4, 5, 12, 13, 6, 7, 14, 15]);
                    let high = [4, 12, 5, 13, 6, 14, 7, 15];
                    let (xy, zw) = (pick(self, p[0], p[1], high), pick(self, p[2], p[3], high));
                    out[2] = pick(self, xy, zw, [0, 1, 8, 9, 2, 3, 10, 11]);
                    out[3] = pick(self, xy, zw, [4, 5, 12, 13, 6, 7, 14, 15]);
                }
                _ => {}
            }
            let mut numbers = parts;
            for c in 0..D {
                numbers[c] = cast(out[c]);
            }
            numbers
        }

        #[inline(always)]
        fn deinterleave<const D: usize>(self, numbers: [f64x8; D]) -> [f64x8; D] {
            let mut p = [cast::<f64x8, __m512d>(self.splat_f64s(0.0)); D];
            for c in 0..D {
                p[c] = cast(numbers[c]);
            }
            let mut out = p;
            match D {
                2 => {
                    out[0] = pick(self, p[0], p[1], [0, 2, 4, 6, 8, 10, 12, 14]);
                    out[1] = pick(self, p[0], p[1], [1, 3, 5, 7, 9, 11, 13, 15]);
                }
                3 => {
                    // As above: component c of triple l stands in lane (3l + c) mod 8 of one of the three.
                    let all = [p[0], p[1], p[2]];
                    let x = choose(self, all, 0b1001_0010, 0b0010_0100);
                    let y = choose(self, all, 0b0010_0100, 0b0100_1001);
                    let z = choose(self, all, 0b0100_1001, 0b1001_0010);
                    out[0] = rotate(self, x, [0, 3, 6, 1, 4, 7, 2, 5]);
                    out[1] = rotate(self, y, [1, 4, 7, 2, 5, 0, 3, 6]);
                    out[2] = rotate(self, z, [2, 5, 0, 3, 6, 1, 4, 7]);
                }
                _ => {}
            }
            let mut parts = numbers;
            for c in 0..D {
                parts[c] = cast(out[c]);
            }
            parts
        }
    }
}
