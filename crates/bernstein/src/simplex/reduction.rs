//! The nearest polynomial of a lower degree over a simplex.

use super::de_casteljau::raised;
use super::elevation::elevate_step;
use super::index::{multi_indices, simplex_count, simplex_index, vertex_place};
use super::net::SimplexNet;
use crate::error::least_length;
use crate::line::check_length;
use crate::{BernsteinError, Point};

/// Unit roundoff.
const U: f64 = f64::EPSILON / 2.0;

/// Solutions are improved this many times, each time from the residual measured anew.
const ROUNDS: usize = 3;

impl<P: Point, const V: usize> SimplexNet<'_, P, V> {
    /// Degree reduction from n to `to`: the polynomial q with the same values at the vertices that minimises
    /// `Σ |P_β − Q_β|²`, q being elevated to degree n; gives a bound on `|p(λ) − q(λ)|` over the simplex.
    ///
    /// The bound is `max |P_β − Q_β|`, and an allowance for rounding: by the convex hull property nothing in the
    /// simplex is farther apart. It is certified, being measured on the result. Vectors are measured by their
    /// Euclidean length. For `to` = 0, where values at the vertices cannot all be kept, q is the mean of the
    /// control points.
    ///
    /// A polynomial of degree `to` that was elevated to n comes back as it was: within about `n·κ²·u·√Σ|P_β|²`, κ
    /// being the condition of elevation, 40 from degree 10 to 20. The normal equations are solved by conjugate
    /// gradients, which elevation and its transpose, both sparse, are all that is needed for. `scratch` holds
    /// `4·`[`simplex_count`]`::<V>(n)` points; its content is lost. Cost: about κ iterations with n − `to`
    /// elevations each, a few hundred at most.
    ///
    /// # Errors
    /// [`BernsteinError::ReducedDegree`] where `to` is above n, [`BernsteinError::BufferLength`].
    ///
    /// Sources: Björck, *Numerical Methods for Least Squares Problems*, sec. 7.4 (CGLS); Peters and Reif, "Least
    /// squares approximation of Bézier coefficients provides best degree reduction in the L2-norm", J. Approx.
    /// Theory 104 (2000).
    pub fn reduce(&self, to: usize, out: &mut [P], scratch: &mut [P]) -> Result<f64, BernsteinError> {
        let n = self.degree();
        if to > n {
            return Err(BernsteinError::ReducedDegree { from: n, to });
        }
        let (high, low) = (simplex_count::<V>(n), simplex_count::<V>(to));
        check_length("out", out.len(), low)?;
        least_length("scratch", high.saturating_mul(4), scratch.len())?;
        if to == n {
            self.copy_to(out);
            return Ok(0.0);
        }
        let (residual, rest) = scratch.split_at_mut(high);
        out.fill(P::ZERO);
        if to == 0 {
            out[0] = (0..high).fold(P::ZERO, |sum, place| sum + self.at(place)) / high as f64;
        } else {
            for vertex in 0..V {
                out[vertex_place::<V>(to, vertex)] = self.at(vertex_place::<V>(n, vertex));
            }
            for _ in 0..ROUNDS {
                self.subtract_elevated(to, out, residual);
                improve::<P, V>(n, to, out, residual, rest);
            }
        }
        self.subtract_elevated(to, out, residual);
        let deviation = residual.iter().fold(0.0, |d: f64, r| d.max(r.norm()));
        let largest = out.iter().fold(0.0, |d: f64, q| d.max(q.norm()));
        // Elevation is within (V+1)(n−to) roundings, difference and length add a few.
        let rounding = ((V + 1) * (n - to) + 8) as f64 * U;
        Ok(deviation * (1.0 + rounding) + rounding * largest)
    }

    /// `P − E Q`
    fn subtract_elevated(&self, to: usize, q: &[P], residual: &mut [P]) {
        residual[..q.len()].copy_from_slice(q);
        elevate_through::<P, V>(to, self.degree(), residual);
        for (place, r) in residual.iter_mut().enumerate() {
            *r = self.at(place) - *r;
        }
    }
}

fn elevate_through<P: Point, const V: usize>(from: usize, to: usize, net: &mut [P]) {
    for degree in from + 1..=to {
        elevate_step::<P, V>(degree, 1, net);
    }
}

fn dot<P: Point>(a: &[P], b: &[P]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

fn square<P: Point>(points: &[P]) -> f64 {
    dot(points, points)
}

/// Conjugate gradients for the normal equations of `E x = r`, corners apart; x is added to `q`.
fn improve<P: Point, const V: usize>(n: usize, to: usize, q: &mut [P], residual: &mut [P], work: &mut [P]) {
    let (high, low) = (residual.len(), q.len());
    let (gradient, rest) = work.split_at_mut(high);
    let (image, direction) = rest.split_at_mut(high);
    let direction = &mut direction[..low];
    project::<P, V>(n, to, residual, gradient);
    direction.copy_from_slice(&gradient[..low]);
    let mut size = square(&gradient[..low]);
    let (start, mut least) = (size, size);
    let mut stalled = 0;
    // In exact arithmetic there are at most as many steps as unknowns; rounding makes it a few more.
    for _ in 0..2 * low {
        if size <= start * (U * U) || stalled > 20 {
            break;
        }
        image[..low].copy_from_slice(direction);
        elevate_through::<P, V>(to, n, image);
        // In exact arithmetic the numerator is `size`. Where gradients are rounding errors it is not, and only this
        // step leads to the minimum along the direction, however short that is.
        let step = dot(&gradient[..low], direction) / square(image);
        if !step.is_finite() {
            break;
        }
        for (q, &d) in q.iter_mut().zip(&*direction) {
            *q = *q + d * step;
        }
        for (r, &i) in residual.iter_mut().zip(&*image) {
            *r = *r - i * step;
        }
        project::<P, V>(n, to, residual, gradient);
        let next = square(&gradient[..low]);
        let turn = next / size;
        for (d, &g) in direction.iter_mut().zip(&*gradient) {
            *d = g + *d * turn;
        }
        stalled = if next < least { 0 } else { stalled + 1 };
        (size, least) = (next, least.min(next));
    }
}

/// `Eᵀ r`, corners set to zero: `(γₐ+1)/m r_{γ+eₐ}` summed over a, once a degree.
fn project<P: Point, const V: usize>(n: usize, to: usize, residual: &[P], out: &mut [P]) {
    out.copy_from_slice(residual);
    for m in (to + 1..=n).rev() {
        for (place, index) in multi_indices::<V>(m - 1).enumerate() {
            let term = |a: usize| out[simplex_index(raised(index, a))] * (index[a] + 1) as f64;
            out[place] = (1..V).fold(term(0), |sum, a| sum + term(a)) / m as f64;
        }
    }
    for vertex in 0..V {
        out[vertex_place::<V>(to, vertex)] = P::ZERO;
    }
}
