//! De Casteljau's algorithm over a simplex: its scheme, the blossom, directional derivatives.

use super::index::{multi_indices, scheme_count, simplex_count, simplex_index};
use super::net::{SimplexNet, value};
use crate::error::least_length;
use crate::line::check_length;
use crate::{BernsteinError, Point};

impl<P: Point, const V: usize> SimplexNet<'_, P, V> {
    /// Value by de Casteljau's algorithm, `P_βʳ = Σ λₐ P_{β+eₐ}ʳ⁻¹`, `p(λ) = P₀ⁿ`.
    ///
    /// `scratch` should hold as many points as the net and its content is lost; where it is shorter,
    /// [`value`](Self::value) answers instead. Error: as for that. Cost: `C(n+V−1, V)` affine combinations.
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 17.2.
    #[must_use]
    pub fn de_casteljau(&self, lambda: [f64; V], scratch: &mut [P]) -> P {
        let Ok(scratch) = self.copied(scratch) else { return self.value(lambda) };
        for lower in (0..self.degree()).rev() {
            step(lower, lambda, scratch);
        }
        scratch.first().copied().unwrap_or(P::ZERO)
    }

    /// The whole scheme of de Casteljau's algorithm: the net of level r, `P_βʳ` with |β| = n − r, follows that
    /// of level r − 1 in `out`; the control points come first, `p(λ)` last.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless `out` holds `C(n+V, V)` points: (n+1)(n+2)(n+3)/6 for a triangle.
    ///
    /// ```
    /// use casteljau_bernstein::TriangleNet;
    /// let mut scheme = [0.0; 4];
    /// TriangleNet::new(&[1.0, 2.0, 4.0], 1)?.scheme([0.5, 0.25, 0.25], &mut scheme)?;
    /// assert_eq!(scheme, [1.0, 2.0, 4.0, 2.0]);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    pub fn scheme(&self, lambda: [f64; V], out: &mut [P]) -> Result<(), BernsteinError> {
        check_length("out", out.len(), scheme_count::<V>(self.degree()))?;
        let (mut below, mut rest) = out.split_at_mut(simplex_count::<V>(self.degree()));
        self.copy_to(below);
        for lower in (0..self.degree()).rev() {
            let (level, left) = rest.split_at_mut(simplex_count::<V>(lower));
            for (p, index) in level.iter_mut().zip(multi_indices(lower)) {
                *p = combined(index, lambda, below);
            }
            (below, rest) = (level, left);
        }
        Ok(())
    }

    /// The blossom, or polar form, `p[λ¹, …, λⁿ]`: affine in each of its n arguments, symmetric, and p(λ) where
    /// all are λ. With vertices as arguments it gives the control points.
    ///
    /// The content of `scratch` is lost. Arguments are taken as given; vectors (coordinates that add up to 0)
    /// give differences. Error: at most `4(n+2)·u` times the same with everything taken absolutely. Cost: as for
    /// [`de_casteljau`](Self::de_casteljau).
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless there are n arguments and `scratch` holds as many points as the
    /// net, or more.
    ///
    /// Source: Ramshaw, "Blossoms are polar forms", CAGD 6 (1989).
    pub fn blossom(&self, arguments: &[[f64; V]], scratch: &mut [P]) -> Result<P, BernsteinError> {
        check_length("arguments", arguments.len(), self.degree())?;
        let scratch = self.copied(scratch)?;
        for (lower, &argument) in (0..self.degree()).rev().zip(arguments) {
            step(lower, argument, scratch);
        }
        Ok(scratch.first().copied().unwrap_or(P::ZERO))
    }

    /// The derivative along directions d¹, …, dᵏ, `n!/(n−k)! p[λ, …, λ, d¹, …, dᵏ]`; the same one k times gives
    /// the derivative of order k.
    ///
    /// A direction has barycentric coordinates that add up to 0; the last one is implied by the others and not
    /// read. The content of `scratch` is lost. Error: at most `4(n + 2k + 2)·u·scale`, scale being the sum of
    /// the absolute contributions. Cost: k differences of the net, and a value.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] where `scratch` holds fewer points than the net.
    ///
    /// ```
    /// use casteljau_bernstein::TriangleNet;
    /// let net = TriangleNet::new(&[0.0, 0.5, 0.0, 0.0, 0.0, 0.0], 2)?; // λ₁λ₂
    /// let along_edge = [1.0, -1.0, 0.0];
    /// let slope = net.directional([0.75, 0.25, 0.0], &[along_edge], &mut [0.0; 6])?;
    /// assert_eq!(slope, -0.5);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    pub fn directional(
        &self,
        lambda: [f64; V],
        directions: &[[f64; V]],
        scratch: &mut [P],
    ) -> Result<P, BernsteinError> {
        let scratch = self.copied(scratch)?;
        Ok(directional(self.degree(), lambda, directions.iter().copied(), scratch))
    }

    /// The control points, at the beginning of `scratch`.
    pub(super) fn copied<'s>(&self, scratch: &'s mut [P]) -> Result<&'s mut [P], BernsteinError> {
        let needed = simplex_count::<V>(self.degree());
        least_length("scratch", needed, scratch.len())?;
        let net = &mut scratch[..needed];
        self.copy_to(net);
        Ok(net)
    }
}

/// The derivative of the polynomial whose points stand in `net`, which is lost.
pub(crate) fn directional<P: Point, const V: usize>(
    degree: usize,
    lambda: [f64; V],
    directions: impl ExactSizeIterator<Item = [f64; V]>,
    net: &mut [P],
) -> P {
    let Some(lower) = degree.checked_sub(directions.len()) else { return P::ZERO };
    let mut factor = 1.0;
    for (m, direction) in (lower..degree).rev().zip(directions) {
        factor *= (m + 1) as f64;
        difference_step(m, direction, net);
    }
    value(lower, lambda, &|place| net.get(place).copied().unwrap_or(P::ZERO)) * factor
}

/// One step of de Casteljau's algorithm down to degree `lower`, in place: what is read stands at the place
/// written or above.
pub(crate) fn step<P: Point, const V: usize>(lower: usize, lambda: [f64; V], points: &mut [P]) {
    for (place, index) in multi_indices::<V>(lower).enumerate() {
        points[place] = combined(index, lambda, points);
    }
}

/// `Σ λₐ P_{β+eₐ}`
#[inline]
fn combined<P: Point, const V: usize>(index: [usize; V], lambda: [f64; V], points: &[P]) -> P {
    let term = |vertex: usize| points[simplex_index(raised(index, vertex))] * lambda[vertex];
    (1..V).fold(term(0), |sum, vertex| sum + term(vertex))
}

/// `Σ dₐ (P_{β+eₐ} − P_{β+e_V})`, the step towards a derivative along d.
fn difference_step<P: Point, const V: usize>(lower: usize, direction: [f64; V], points: &mut [P]) {
    for (place, index) in multi_indices::<V>(lower).enumerate() {
        let last = points[simplex_index(raised(index, V - 1))];
        points[place] = (0..V - 1).fold(P::ZERO, |sum, vertex| {
            sum + (points[simplex_index(raised(index, vertex))] - last) * direction[vertex]
        });
    }
}

/// `β + eₐ`
#[inline]
pub(crate) fn raised<const V: usize>(mut index: [usize; V], vertex: usize) -> [usize; V] {
    index[vertex] += 1;
    index
}
