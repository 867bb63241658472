//! When two sides are the same curve, and in which direction it is sampled.

use std::cmp::Ordering;

use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};

use crate::charted::is_collapsed;

/// A curve's homogeneous control points in the canonical form: equal for curves that share all samples.
///
/// Of the two directions and the two signs of a homogeneous net that list of coordinates is taken which is
/// lexicographically least; zeros have no sign. A common factor is a power of two that brings the largest weight
/// into [1, 2); where all weights are equal the net is that of the polynomial curve, all weights 1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SideKey {
    pub net: Vec<DVec4>,
    pub reversed: bool,
    /// Both directions are the same.
    pub symmetric: bool,
    /// All control points are one.
    pub collapsed: bool,
}

impl SideKey {
    pub fn new(net: &[DVec4]) -> Self {
        let net = scaled(net);
        let forth = least(net.clone(), net.iter().map(|&p| -p).collect());
        let back = |net: &[DVec4]| net.iter().rev().copied().collect::<Vec<_>>();
        let back = least(back(&net), net.iter().rev().map(|&p| -p).collect());
        let order = compare(&forth, &back);
        let (mut net, reversed) = if order == Ordering::Greater { (back, true) } else { (forth, false) };
        // Weights that are all −1 came from the sign that was chosen.
        if net.iter().all(|p| p.w == -1.0) {
            net = with_plain_zeros(net.into_iter().map(|p| -p));
        }
        let finite: Vec<DVec3> = net.iter().map(|p| p.xyz() / p.w).filter(|p| p.is_finite()).collect();
        let collapsed = finite.len() == net.len() && is_collapsed(&finite);
        Self { net, reversed, symmetric: order == Ordering::Equal, collapsed }
    }

    /// The bits, to look it up by.
    pub fn bits(&self) -> Vec<u64> {
        self.net.iter().flat_map(|p| p.to_array().map(f64::to_bits)).collect()
    }

    /// The first and the last point; not finite where they lie at infinity.
    pub fn ends(&self) -> [DVec3; 2] {
        let end = |p: Option<&DVec4>| p.map_or(DVec3::NAN, |p| p.xyz() / p.w + DVec3::ZERO);
        [end(self.net.first()), end(self.net.last())]
    }

    /// The points, where all weights are 1.
    pub fn polynomial(&self) -> Option<Vec<DVec3>> {
        let plain = self.net.iter().all(|p| p.w == 1.0);
        plain.then(|| self.net.iter().map(|p| p.xyz()).collect())
    }
}

/// The net with its common factor taken out as far as that is exact, or altogether where all weights are equal.
pub(crate) fn scaled(net: &[DVec4]) -> Vec<DVec4> {
    let largest = net.iter().map(|p| p.w.abs()).fold(0.0, f64::max);
    let factor = match net.first() {
        Some(first) if net.iter().all(|p| p.w == first.w) => first.w,
        // The power of two: the mantissa left out.
        _ => f64::from_bits(largest.to_bits() & (0x7ff << 52)),
    };
    let divided = with_plain_zeros(net.iter().map(|&p| p / factor));
    // Weights of all but no size leave the range of numbers; they are then compared as they are.
    if divided.iter().all(|p| p.is_finite()) { divided } else { with_plain_zeros(net.iter().copied()) }
}

/// Adding 0 turns −0 into 0.
fn with_plain_zeros(net: impl Iterator<Item = DVec4>) -> Vec<DVec4> {
    net.map(|p| p + DVec4::ZERO).collect()
}

pub(crate) fn least(a: Vec<DVec4>, b: Vec<DVec4>) -> Vec<DVec4> {
    let b = with_plain_zeros(b.into_iter());
    if compare(&a, &b) == Ordering::Greater { b } else { a }
}

pub(crate) fn compare(a: &[DVec4], b: &[DVec4]) -> Ordering {
    let (a, b) = (a.iter().flat_map(|p| p.to_array()), b.iter().flat_map(|p| p.to_array()));
    // All are finite.
    a.partial_cmp(b).unwrap_or(Ordering::Equal)
}
