//! A point with its derivatives of any order.

use glam::DVec3;

use crate::multi_index::{multi_indices, partial_count, partial_index};

/// The highest total order that [`Partials`] hold: in three parameters that is some 370,000 derivatives.
pub const LARGEST_ORDER: usize = 128;

/// A point and all its partial derivatives up to a total order, in N parameters: the jet of any order.
///
/// [`CurveJet`](crate::CurveJet) and [`SurfaceJet`](crate::SurfaceJet) are the fixed ones that the quantities
/// of differential geometry are computed from.
///
/// ```
/// use casteljau_geom::{Partials, glam::DVec3};
/// let mut jet = Partials::<2>::zero(1);
/// jet.as_mut_slice().copy_from_slice(&[DVec3::ONE, DVec3::X, DVec3::Y]);
/// assert_eq!((jet.get([0, 1]), jet.get([0, 2])), (Some(DVec3::Y), None));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Partials<const N: usize> {
    order: usize,
    values: Vec<DVec3>,
}

impl<const N: usize> Partials<N> {
    /// All zero, up to the total order given, but at most [`LARGEST_ORDER`]; to be filled by a shape.
    #[must_use]
    pub fn zero(order: usize) -> Self {
        let order = order.min(LARGEST_ORDER);
        Self { order, values: vec![DVec3::ZERO; partial_count::<N>(order)] }
    }

    /// The largest total order.
    #[must_use]
    pub fn order(&self) -> usize {
        self.order
    }

    /// The point itself.
    #[must_use]
    pub fn point(&self) -> DVec3 {
        self.values[0]
    }

    /// The derivative of the given orders; `None` beyond [`order`](Self::order).
    #[must_use]
    pub fn get(&self, orders: [usize; N]) -> Option<DVec3> {
        // The sum is checked first: far beyond it the place itself would overflow.
        let total = orders.iter().try_fold(0_usize, |sum, &k| sum.checked_add(k))?;
        if total <= self.order { self.values.get(partial_index(orders)).copied() } else { None }
    }

    /// All derivatives with their orders, as [`multi_indices`] go.
    pub fn iter(&self) -> impl Iterator<Item = ([usize; N], DVec3)> {
        multi_indices(self.order).zip(self.values.iter().copied())
    }

    /// All derivatives, at the places [`partial_index`].
    #[must_use]
    pub fn as_slice(&self) -> &[DVec3] {
        &self.values
    }

    /// All derivatives, to be written.
    #[must_use]
    pub fn as_mut_slice(&mut self) -> &mut [DVec3] {
        &mut self.values
    }
}
