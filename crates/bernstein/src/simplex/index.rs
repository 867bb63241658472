//! Multi-indices and their places in a net.

/// The number of control points over a simplex with V vertices, `C(n + V − 1, V − 1)`: (n+1)(n+2)/2 for a
/// triangle (V = 3), (n+1)(n+2)(n+3)/6 for a tetrahedron (V = 4).
///
/// It is also the number of partial derivatives up to the total order n in V − 1 variables. Numbers that leave
/// the range of `usize` stay at its end.
///
/// ```
/// use casteljau_bernstein::simplex_count;
/// assert_eq!((simplex_count::<3>(3), simplex_count::<4>(3)), (10, 20));
/// ```
#[must_use]
pub const fn simplex_count<const V: usize>(degree: usize) -> usize {
    rising(degree.saturating_add(1), V.saturating_sub(1))
}

/// The number of points of de Casteljau's scheme, `C(n + V, V)`: the nets of all degrees from n to 0.
pub(crate) const fn scheme_count<const V: usize>(degree: usize) -> usize {
    rising(degree.saturating_add(1), V)
}

/// The place of the control point with a multi-index: indices descend lexicographically, (n,0,0), (n−1,1,0),
/// (n−1,0,1), (n−2,2,0), …
///
/// With `rₘ = βₘ + … + β_V` it is `Σ C(rₘ + V − m, V − m + 1)`, m = 2…V: for a triangle `r₂(r₂+1)/2 + r₃`. The
/// degree does not occur, as points with more of the first vertex come first. Where an index is out of the range
/// of `usize`, so is the answer.
///
/// ```
/// use casteljau_bernstein::simplex_index;
/// assert_eq!([simplex_index([3, 0, 0]), simplex_index([1, 1, 1]), simplex_index([0, 0, 3])], [0, 4, 9]);
/// ```
#[inline]
#[must_use]
pub const fn simplex_index<const V: usize>(index: [usize; V]) -> usize {
    places(&index, 1)
}

/// The place of `∂ᵃ⁺ᵇ⁺…/∂x₁ᵃ∂x₂ᵇ…` in a list of partial derivatives in D variables: by total order, then
/// descending lexicographically, `1; x, y, z; xx, xy, xz, yy, yz, zz; …`.
///
/// In two variables it is [`partial_index`](crate::partial_index).
///
/// ```
/// use casteljau_bernstein::{partial_index, simplex_partial_index};
/// assert_eq!(simplex_partial_index([1, 2]), partial_index(1, 2));
/// assert_eq!(simplex_partial_index([0, 1, 1]), 8);
/// ```
#[inline]
#[must_use]
pub const fn simplex_partial_index<const D: usize>(orders: [usize; D]) -> usize {
    places(&orders, 0)
}

/// `Σ C(rₘ + d − 1, d)`, d running from 1 at the last index to that at `first`, rₘ being the sum from m on.
#[inline]
const fn places<const V: usize>(index: &[usize; V], first: usize) -> usize {
    let (mut place, mut sum, mut dimension) = (0_usize, 0_usize, 1);
    let mut m = V;
    while m > first {
        m -= 1;
        sum = sum.saturating_add(index[m]);
        place = place.saturating_add(rising(sum, dimension));
        dimension += 1;
    }
    place
}

/// `r (r+1) … (r+d−1) / d!`, the number of multi-indices of d + 1 entries and a degree below r.
#[inline]
const fn rising(r: usize, d: usize) -> usize {
    let (mut product, mut i) = (1_usize, 0);
    while i < d {
        product = product.saturating_mul(r.saturating_add(i)) / (i + 1);
        i += 1;
    }
    product
}

/// The place of a vertex.
pub(crate) const fn vertex_place<const V: usize>(degree: usize, vertex: usize) -> usize {
    let mut index = [0; V];
    index[vertex] = degree;
    simplex_index(index)
}

/// All multi-indices of a degree, in the order of the nets.
///
/// ```
/// use casteljau_bernstein::multi_indices;
/// let all: Vec<[usize; 3]> = multi_indices(1).collect();
/// assert_eq!(all, [[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
/// ```
#[must_use]
pub fn multi_indices<const V: usize>(degree: usize) -> MultiIndices<V> {
    MultiIndices::on_face(degree, std::array::from_fn(|vertex| vertex), V)
}

/// The iterator that [`multi_indices`] makes.
#[derive(Debug, Clone)]
pub struct MultiIndices<const V: usize> {
    next: Option<[usize; V]>,
    /// The vertices whose entries are not kept at 0; so many of them, ascending.
    face: [usize; V],
    vertices: usize,
}

impl<const V: usize> MultiIndices<V> {
    /// The multi-indices that are zero but at the first `vertices` ones of `face`, which ascend.
    pub(crate) fn on_face(degree: usize, face: [usize; V], vertices: usize) -> Self {
        let mut first = [0; V];
        let next = face[..vertices].first().map(|&vertex| {
            first[vertex] = degree;
            first
        });
        Self { next, face, vertices }
    }
}

impl<const V: usize> Iterator for MultiIndices<V> {
    type Item = [usize; V];

    #[inline]
    fn next(&mut self) -> Option<[usize; V]> {
        let current = self.next?;
        let face = &self.face[..self.vertices];
        let last = face[self.vertices - 1];
        // One unit moves from the last entry that has any, the very last apart, to the entry after it, where
        // everything that stood at the very last joins it.
        self.next = (1..self.vertices).rev().find(|&p| current[face[p - 1]] > 0).map(|p| {
            let mut index = current;
            index[face[p - 1]] -= 1;
            index[last] = 0;
            index[face[p]] += current[last] + 1;
            index
        });
        Some(current)
    }
}

/// The multi-index before this one; `false`, and nothing changed, at the first.
pub(crate) fn step_back<const V: usize>(index: &mut [usize; V]) -> bool {
    let Some(p) = (1..V).rev().find(|&p| index[p] > 0) else { return false };
    let moved = std::mem::take(&mut index[p]);
    index[p - 1] += 1;
    index[V - 1] = moved - 1;
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn order_is_that_of_places<const V: usize>(degree: usize) {
        let all: Vec<[usize; V]> = multi_indices(degree).collect();
        assert_eq!(all.len(), simplex_count::<V>(degree));
        assert!(all.windows(2).all(|pair| pair[0] > pair[1]));
        let mut backwards = all[all.len() - 1];
        for (place, &index) in all.iter().enumerate().rev() {
            assert_eq!(index.iter().sum::<usize>(), degree);
            assert_eq!(simplex_index(index), place);
            assert_eq!(backwards, index);
            assert_eq!(step_back(&mut backwards), place > 0);
        }
    }

    #[test]
    fn multi_indices_and_places_agree() {
        for degree in 0..12 {
            order_is_that_of_places::<2>(degree);
            order_is_that_of_places::<3>(degree);
            order_is_that_of_places::<4>(degree);
            order_is_that_of_places::<5>(degree);
        }
        assert_eq!(simplex_index([0, usize::MAX, usize::MAX]), usize::MAX);
        assert_eq!(simplex_count::<4>(usize::MAX), usize::MAX / 3);
    }

    #[test]
    fn a_face_takes_its_share() {
        let edge: Vec<[usize; 3]> = MultiIndices::on_face(2, [0, 2, 0], 2).collect();
        assert_eq!(edge, [[2, 0, 0], [1, 0, 1], [0, 0, 2]]);
    }
}
