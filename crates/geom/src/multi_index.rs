//! The order in which partial derivatives stand in memory.

/// The number of partial derivatives up to a total order in N parameters, `C(order + N, N)`.
///
/// ```
/// use casteljau_geom::partial_count;
/// assert_eq!((partial_count::<1>(3), partial_count::<2>(2), partial_count::<3>(2)), (4, 6, 10));
/// ```
#[must_use]
pub const fn partial_count<const N: usize>(order: usize) -> usize {
    // Every prefix of the product is divisible: it is a binomial coefficient.
    let mut count = 1;
    let mut i = 1;
    while i <= N {
        count = count * (order + i) / i;
        i += 1;
    }
    count
}

/// The place of the derivative with the given orders: by total order, then descending lexicographically.
///
/// For a curve that is the order k; for a surface `1; u, v; uu, uv, vv; …`; for a solid `1; u, v, w; uu, uv,
/// uw, vv, vw, ww; …`.
///
/// ```
/// use casteljau_geom::partial_index;
/// assert_eq!((partial_index([3]), partial_index([1, 1]), partial_index([0, 1, 1])), (3, 4, 8));
/// ```
#[must_use]
pub const fn partial_index<const N: usize>(orders: [usize; N]) -> usize {
    // The derivatives of a lower total order in the last r parameters number C(s + r − 1, r), s being the sum
    // of their orders.
    let (mut place, mut sum, mut r) = (0, 0, 1);
    while r <= N {
        sum += orders[N - r];
        let (mut count, mut i) = (1, 1);
        while i <= r {
            count = count * (sum + i - 1) / i;
            i += 1;
        }
        place += count;
        r += 1;
    }
    place
}

/// All multi-indices in N parameters up to a total order, in the order of [`partial_index`].
///
/// ```
/// use casteljau_geom::multi_indices;
/// let all: Vec<_> = multi_indices::<2>(2).collect();
/// assert_eq!(all, [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]]);
/// ```
pub fn multi_indices<const N: usize>(order: usize) -> impl Iterator<Item = [usize; N]> {
    let mut next = [0; N];
    (0..partial_count::<N>(order)).map(move |_| {
        let this = next;
        next = successor(this);
        this
    })
}

/// The multi-index after this one: the last one that can gives a derivative to its right neighbour, which
/// takes all that stand behind.
fn successor<const N: usize>(mut orders: [usize; N]) -> [usize; N] {
    let Some(last) = N.checked_sub(1) else { return orders };
    let tail = std::mem::take(&mut orders[last]);
    match orders.iter().rposition(|&k| k > 0) {
        Some(i) => {
            orders[i] -= 1;
            orders[i + 1] = tail + 1;
        }
        None => orders[0] = tail + 1,
    }
    orders
}

/// The multi-indices `0 ≤ β ≤ α`, component by component.
pub(crate) fn below<const N: usize>(alpha: [usize; N]) -> impl Iterator<Item = [usize; N]> {
    let count = alpha.iter().map(|k| k + 1).product();
    (0..count).map(move |mut place: usize| {
        alpha.map(|k| {
            let digit = place % (k + 1);
            place /= k + 1;
            digit
        })
    })
}

/// `C(α, β) = Π C(αᵢ, βᵢ)`.
pub(crate) fn binomial<const N: usize>(alpha: [usize; N], beta: [usize; N]) -> f64 {
    let one = |(n, k): (usize, usize)| (1..=k).fold(1.0, |c, i| c * (n + 1 - i) as f64 / i as f64);
    alpha.into_iter().zip(beta).map(one).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places<const N: usize>(order: usize) {
        let mut last = None;
        for (place, orders) in multi_indices::<N>(order).enumerate() {
            assert_eq!(partial_index(orders), place, "{orders:?}");
            let key = (orders.iter().sum::<usize>(), orders.map(|k| usize::MAX - k));
            assert!(Some(key) > last, "{orders:?}");
            last = Some(key);
        }
    }

    #[test]
    fn every_place_once() {
        places::<1>(9);
        places::<2>(9);
        places::<3>(7);
        assert_eq!(below([2, 0, 1]).count(), 6);
        assert_eq!(binomial([4, 3], [2, 1]), 18.0);
    }
}
