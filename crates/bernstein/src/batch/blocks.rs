//! Registers of parameters, one after another, and the points that belong to them.

// As in `simd.rs`: plain loops over registers.
#![allow(clippy::needless_range_loop)]

use super::simd::{Lanes, WIDTH};

/// Calls `kernel` with the places 0, L, 2L, … below `count`, L being the number of lanes, and stores what it
/// makes of each: as many points for each of the buffers `out` as there are places left.
///
/// `kernel` must be a closure marked `#[inline(always)]`, so that it gets the vector instructions of its
/// caller.
#[inline(always)]
pub(super) fn each<S: Lanes, const D: usize, const K: usize>(
    simd: S,
    count: usize,
    out: [&mut [f64]; K],
    mut kernel: impl FnMut(usize) -> [[S::f64s; D]; K],
) {
    let mut place = 0;
    while place < count {
        let points = kernel(place);
        for k in 0..K {
            store(simd, out[k], place, points[k]);
        }
        place += S::F64_LANES;
    }
}

/// Stores the points from `place` on for which there is room.
#[inline(always)]
pub(super) fn store<S: Lanes, const D: usize>(simd: S, out: &mut [f64], place: usize, points: [S::f64s; D]) {
    let numbers = simd.interleave(points);
    match out.get_mut(D * place..D * (place + S::F64_LANES)) {
        Some(room) => S::as_mut_simd_f64s(room).0[..D].copy_from_slice(&numbers),
        None => {
            let mut all = [0.0; 4 * WIDTH];
            S::as_mut_simd_f64s(&mut all).0[..D].copy_from_slice(&numbers);
            let rest = out.get_mut(D * place..).unwrap_or_default();
            rest.copy_from_slice(&all[..rest.len()]);
        }
    }
}

/// The parameters from `place` on; lanes beyond the last parameter repeat it.
#[inline(always)]
pub(super) fn load<S: Lanes>(simd: S, parameters: &[f64], place: usize) -> S::f64s {
    match parameters.get(place..place + S::F64_LANES) {
        Some(all) => S::as_simd_f64s(all).0[0],
        None => {
            let rest = parameters.get(place..).unwrap_or_default();
            let mut padded = [rest.last().copied().unwrap_or_default(); WIDTH];
            padded[..rest.len()].copy_from_slice(rest);
            simd.load(&padded, 0)
        }
    }
}

/// Pairs or triples of parameters from number `place` on, a register a component; lanes beyond the last repeat it.
#[inline(always)]
pub(super) fn load_tuples<S: Lanes, const N: usize>(
    simd: S,
    parameters: &[f64],
    place: usize,
) -> [S::f64s; N] {
    let mut padded = [0.0; 3 * WIDTH];
    let all = parameters.get(N * place..N * (place + S::F64_LANES)).unwrap_or_else(|| {
        let rest = parameters.get(N * place..).unwrap_or_default();
        padded[..rest.len()].copy_from_slice(rest);
        if let Some(last) = rest.last_chunk::<N>() {
            padded[rest.len()..].as_chunks_mut().0.fill(*last);
        }
        &padded
    });
    let mut numbers = [simd.splat_f64s(0.0); N];
    for c in 0..N {
        numbers[c] = simd.load(all, c * S::F64_LANES);
    }
    simd.deinterleave(numbers)
}
