use crate::{CenterWeight, CornerPoint, Ribbon};

/// How closely the patch follows the ribbon of one side: `S − R = O(h^q)` with `q = order`.
///
/// A ribbon of l layers prescribes derivatives to order l − 1, so the order promised is at most l. (With the center weight
/// `none` the patch happens to follow the rational surface R further than its layers prescribe.)
/// Order 1 is G0 (the patch contains the curve), order 2 is G1 (it has the ribbon's tangent planes), order 3 is G2.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Contact {
    /// The side.
    pub side: usize,
    /// q, at least 1.
    pub order: usize,
    /// What keeps the order from being larger.
    pub limit: ContactLimit,
}

impl Contact {
    /// The g of G^g that the patch keeps along the side: q − 1.
    pub fn geometric(&self) -> usize {
        self.order.saturating_sub(1)
    }
}

/// What limits the order of contact along a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ContactLimit {
    /// The ribbon's own number of layers, l.
    Layers,
    /// The power p of the blends.
    BlendPower,
    /// A neighbour's degree d: its blends vanish like `h^⌈d/2⌉`.
    NeighbourDegree {
        /// The neighbour.
        side: usize,
    },
    /// The layers of a side that is no neighbour: its blends vanish like `h^l`.
    OtherLayers {
        /// That side.
        side: usize,
    },
    /// The weight of the centre, which vanishes like h².
    CenterWeight,
}

/// Order of contact of every side, the least of these orders to which the parts of `S − R_i` vanish:
///
/// - l_i, since Σ_{k<l} B_k^{2l−1}(h) = 1 − O(h^l), and the rest belongs to others;
/// - p, since 1 − α_i and 1 − β_i are O(h^p), as are the neighbours' blends that carry a power of h_i;
/// - ⌈d/2⌉ for a neighbour of degree d: its middle blends carry s^⌈d/2⌉ = O(h^⌈d/2⌉);
/// - l_j for every side j that is no neighbour: 1 − h_j = O(h_i), to the power l_j;
/// - 2 for the center weights `nth` and `harmonic`; `deficiency` is what the blends leave and vanishes as they do;
///
/// Corner points never limit it: their weight vanishes to the order of [`corner_point_order`], p + 1 on its own two sides,
/// and 2l − 2 ≥ l for every side at the corner that is no neighbour, l ≥ 2 being asked for.
pub(crate) fn contacts(ribbons: &[Ribbon], blend_power: u32, center_weight: CenterWeight) -> Vec<Contact> {
    let thinnest = thinnest(ribbons);
    let contact = |side| contact(ribbons, blend_power as usize, center_weight, &thinnest, side);
    (0..ribbons.len()).map(contact).collect()
}

/// Four sides of fewest layers: a side has two neighbours, so one of the four is neither the side nor a neighbour
/// unless there is none at all.
fn thinnest(ribbons: &[Ribbon]) -> Vec<usize> {
    let mut sides: Vec<usize> = (0..ribbons.len()).collect();
    sides.sort_by_key(|&j| ribbons[j].layers());
    sides.truncate(4);
    sides
}

fn contact(
    ribbons: &[Ribbon],
    p: usize,
    center_weight: CenterWeight,
    thinnest: &[usize],
    side: usize,
) -> Contact {
    let n = ribbons.len();
    let mut least = Contact { side, order: ribbons[side].layers(), limit: ContactLimit::Layers };
    let mut consider = |order: usize, limit: ContactLimit| {
        if order < least.order {
            (least.order, least.limit) = (order, limit);
        }
    };
    consider(p, ContactLimit::BlendPower);
    for neighbour in [(side + n - 1) % n, (side + 1) % n] {
        let order = ribbons[neighbour].degree().div_ceil(2);
        consider(order, ContactLimit::NeighbourDegree { side: neighbour });
    }
    for &other in thinnest.iter().filter(|&&j| !adjacent(side, j, n)) {
        consider(ribbons[other].layers(), ContactLimit::OtherLayers { side: other });
    }
    if matches!(center_weight, CenterWeight::Nth | CenterWeight::Harmonic) {
        consider(2, ContactLimit::CenterWeight);
    }
    least
}

/// Whether j is `side` itself or one of its neighbours.
fn adjacent(side: usize, j: usize, n: usize) -> bool {
    j == side || j == (side + 1) % n || side == (j + 1) % n
}

/// Order to which the weight of a corner point vanishes on a side: p + 1 on its own two sides, else 2(l − 1) for each of
/// these two that is no neighbour. 0 is a weight that stays.
pub(crate) fn corner_point_order(ribbons: &[Ribbon], p: usize, extra: &CornerPoint, side: usize) -> usize {
    let n = ribbons.len();
    let own = [extra.corner, (extra.corner + 1) % n];
    if own.contains(&side) {
        return p + 1;
    }
    own.iter().filter(|&&j| !adjacent(side, j, n)).map(|&j| 2 * ribbons[j].layers() - 2).sum()
}
