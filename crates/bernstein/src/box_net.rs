//! Tensor products in three variables.

use crate::interval::{differentiated, nested};
use crate::line::net_size;
use crate::{BernsteinError, Point, TensorNet, partial_index};

/// Nets with at most so many lines along the last axis keep the lines' values on the stack, up to order 3.
const LINES_ON_STACK: usize = 64;

/// A tensor-product polynomial, `p(u,v,w) = ΣΣΣ Bᵢˡ(u) Bⱼᵐ(v) Bₖⁿ(w) Pᵢⱼₖ`, over a borrowed control net.
///
/// `Pᵢⱼₖ` stands at place `(i·(m+1) + j)·(n+1) + k`: k runs fastest, and with w.
///
/// ```
/// use casteljau_bernstein::{BoxNet, box_partial_index};
/// let net = BoxNet::new(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], [1, 1, 1])?; // u·v·w
/// assert_eq!(net.value(0.5, 0.25, 1.0), 0.125);
/// let mut partials = [0.0; 10];
/// net.partials(0.5, 0.25, 1.0, &mut partials);
/// assert_eq!(partials[box_partial_index(0, 1, 1)], 0.5);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct BoxNet<'a, P> {
    points: &'a [P],
    degrees: [usize; 3],
}

/// The number of partial derivatives in three variables up to a total order, `(k+1)(k+2)(k+3)/6`.
#[must_use]
pub const fn box_partial_count(order: usize) -> usize {
    (order + 1) * (order + 2) * (order + 3) / 6
}

/// The place of `∂ᵃ⁺ᵇ⁺ᶜ/∂uᵃ∂vᵇ∂wᶜ` in a list of partial derivatives: by total order, then (a, b, c) descending,
/// `1; u, v, w; uu, uv, uw, vv, vw, ww; …`.
#[must_use]
pub const fn box_partial_index(a: usize, b: usize, c: usize) -> usize {
    let order = a + b + c;
    order * (order + 1) * (order + 2) / 6 + partial_index(b, c)
}

impl<'a, P: Point> BoxNet<'a, P> {
    /// Takes `points` as a net of the degrees l (with u), m (with v) and n (with w).
    ///
    /// # Errors
    /// [`BernsteinError::BoxNetLength`] unless there are (l+1)(m+1)(n+1) points, [`BernsteinError::Degree`]
    /// above [`MAX_DEGREE`](crate::MAX_DEGREE).
    pub fn new(points: &'a [P], degrees: [usize; 3]) -> Result<Self, BernsteinError> {
        if points.len() != net_size(degrees)? {
            return Err(BernsteinError::BoxNetLength { degrees, given: points.len() });
        }
        Ok(Self { points, degrees })
    }

    /// Takes `points` as a net that was validated before, when the shape that owns it was constructed.
    ///
    /// Nothing is checked: a net that does not fit its degrees gives meaningless values, but no panic.
    #[inline]
    #[must_use]
    pub const fn validated(points: &'a [P], degrees: [usize; 3]) -> Self {
        Self { points, degrees }
    }

    /// Value `p(u,v,w)`.
    ///
    /// Error: at most `4(l+m+n+2)·u·ΣΣΣ|Bᵢˡ Bⱼᵐ Bₖⁿ Pᵢⱼₖ|`. Cost: the net is read once, 3(l+1)(m+1)(n+1)
    /// operations a component.
    #[must_use]
    pub fn value(&self, u: f64, v: f64, w: f64) -> P {
        let [l, ..] = self.degrees;
        nested(l, u, self.slabs().map(|slab| slab.value(v, w)))
    }

    /// Partial derivatives `∂ᵃ⁺ᵇ⁺ᶜp/∂uᵃ∂vᵇ∂wᶜ`, at the places [`box_partial_index`]`(a, b, c)` of `out`.
    ///
    /// The total order is the greatest k with [`box_partial_count`]`(k) ≤ out.len()`; places beyond are set to
    /// zero. Error: at most `4(l + m + n + 2(a+b+c) + 2)·u·scale`, scale being the sum of the absolute
    /// contributions. Cost: the net is read k + 1 times for k ≤ 3 and (l+1)(m+1) ≤ 64, once for each derivative
    /// otherwise.
    pub fn partials(&self, u: f64, v: f64, w: f64, out: &mut [P]) {
        let Some(order) = (0..).take_while(|&k| box_partial_count(k) <= out.len()).last() else {
            out.fill(P::ZERO);
            return;
        };
        out[box_partial_count(order)..].fill(P::ZERO);
        let [l, m, n] = self.degrees;
        let lines = l.saturating_add(1).saturating_mul(m.saturating_add(1));
        if lines <= LINES_ON_STACK && order <= 3 {
            let mut values = [P::ZERO; LINES_ON_STACK];
            let mut face = [P::ZERO; 10];
            let mut work = [P::ZERO; 3];
            for c in 0..=order {
                let of_line = |line: &[P], work: &mut [P]| {
                    differentiated(n.saturating_add(1), w, work, line.iter().copied())
                };
                for (place, line) in values.iter_mut().zip(self.points.chunks_exact(n.saturating_add(1))) {
                    *place = of_line(line, &mut work[..c]);
                }
                let rest = order - c;
                let count = crate::partial_count(rest);
                TensorNet::validated(&values[..lines], [l, m]).partials(u, v, &mut face[..count]);
                for a in 0..=rest {
                    for b in 0..=rest - a {
                        out[box_partial_index(a, b, c)] = face[partial_index(a, b)];
                    }
                }
            }
            return;
        }
        // The places before (a, b, c) are free and at least a + b + c many when the last ones are made first.
        for total in (0..=order).rev() {
            for a in 0..=total {
                for c in (0..=total - a).rev() {
                    let b = total - a - c;
                    let (free, rest) = out.split_at_mut(box_partial_index(a, b, c));
                    rest[0] = self.partial([u, v, w], [a, b, c], &mut free[..total]);
                }
            }
        }
    }

    /// Derivative of order r along a direction, `(d/dh)ʳ p(u + h·d)` at h = 0:
    /// `Σ r!/(a! b! c!) dᵤᵃ dᵥᵇ d_wᶜ ∂ᵃ⁺ᵇ⁺ᶜp/∂uᵃ∂vᵇ∂wᶜ` over a + b + c = r.
    ///
    /// The order is the length of `work`, whose content is lost. Error: as for [`partials`](Self::partials),
    /// scale being the sum above with every term taken absolutely. Cost: the net is read (r+1)(r+2)/2 times.
    #[must_use]
    pub fn directional(&self, at: [f64; 3], direction: [f64; 3], work: &mut [P]) -> P {
        let order = work.len();
        let [du, dv, dw] = direction;
        let mut sum = P::ZERO;
        for a in 0..=order {
            for b in 0..=order - a {
                let c = order - a - b;
                let factor = crate::binomial(order, a) * crate::binomial(order - a, b);
                let factor = factor * power(du, a) * power(dv, b) * power(dw, c);
                if factor != 0.0 {
                    sum = sum + self.partial(at, [a, b, c], work) * factor;
                }
            }
        }
        sum
    }

    /// One partial derivative; `work` holds as many points as its total order.
    fn partial(&self, [u, v, w]: [f64; 3], [a, b, _]: [usize; 3], work: &mut [P]) -> P {
        let [l, m, n] = self.degrees;
        let (in_u, rest) = work.split_at_mut(a);
        let (in_v, in_w) = rest.split_at_mut(b);
        let slabs = self.slabs().map(|slab| {
            let rows = slab
                .rows()
                .map(|row| differentiated(n.saturating_add(1), w, &mut *in_w, row.iter().copied()));
            differentiated(m.saturating_add(1), v, &mut *in_v, rows)
        });
        differentiated(l.saturating_add(1), u, in_u, slabs)
    }

    /// The nets of constant i.
    fn slabs(&self) -> impl Iterator<Item = TensorNet<'a, P>> + use<'a, P> {
        let [_, m, n] = self.degrees;
        let size = m.saturating_add(1).saturating_mul(n.saturating_add(1));
        self.points.chunks_exact(size).map(move |slab| TensorNet::validated(slab, [m, n]))
    }
}

/// `xᵏ` by repeated multiplication: k − 1 roundings.
pub(crate) fn power(x: f64, k: usize) -> f64 {
    (0..k).fold(1.0, |product, _| product * x)
}
