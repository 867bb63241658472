//! The same polynomial over a simplex at a higher degree.

use super::index::{simplex_count, simplex_index, step_back};
use super::net::SimplexNet;
use crate::line::check_length;
use crate::{BernsteinError, MAX_DEGREE, Point};

impl<P: Point, const V: usize> SimplexNet<'_, P, V> {
    /// Degree elevation from n to `to`, `Q_β = Σ βₐ P_{β−eₐ} / (n+1)` once a degree: convex combinations only.
    ///
    /// Vertices are kept to the bit, and each edge and face is elevated as the net that it is, to the bit. Error
    /// of each point: at most `(V+1)(to−n)·u` times its combination of absolute values. Cost: V multiplications
    /// a component and point for each degree.
    ///
    /// # Errors
    /// [`BernsteinError::ElevatedDegree`] where `to` is below n, [`BernsteinError::Degree`] above
    /// [`MAX_DEGREE`], [`BernsteinError::BufferLength`] unless `out` holds [`simplex_count`]`::<V>(to)` points.
    ///
    /// ```
    /// use casteljau_bernstein::TriangleNet;
    /// let mut quadratic = [0.0; 6];
    /// TriangleNet::new(&[0.0, 2.0, 4.0], 1)?.elevate(2, &mut quadratic)?;
    /// assert_eq!(quadratic, [0.0, 1.0, 2.0, 2.0, 3.0, 4.0]);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    ///
    /// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 17.4.
    pub fn elevate(&self, to: usize, out: &mut [P]) -> Result<(), BernsteinError> {
        check_elevation(self.degree(), to)?;
        check_length("out", out.len(), simplex_count::<V>(to))?;
        self.copy_to(&mut out[..simplex_count::<V>(self.degree())]);
        for degree in self.degree() + 1..=to {
            elevate_step::<P, V>(degree, 1, out);
        }
        Ok(())
    }
}

pub(crate) fn check_elevation(from: usize, to: usize) -> Result<(), BernsteinError> {
    if to > MAX_DEGREE {
        return Err(BernsteinError::Degree { degree: to, limit: MAX_DEGREE });
    }
    if to < from { Err(BernsteinError::ElevatedDegree { from, to }) } else { Ok(()) }
}

/// Elevation to `degree` from one less, in place, of a net whose points are rows of `width` places.
pub(crate) fn elevate_step<P: Point, const V: usize>(degree: usize, width: usize, net: &mut [P]) {
    let mut index = [0; V];
    index[V - 1] = degree;
    // What is read stands at the place written or below.
    loop {
        let target = simplex_index(index) * width;
        let below = |vertex: usize| simplex_index(lowered(index, vertex)) * width;
        let mut used = (0..V).filter(|&vertex| index[vertex] > 0);
        let first = used.next().unwrap_or(0);
        if index[first] == degree {
            net.copy_within(below(first)..below(first) + width, target);
        } else {
            for k in 0..width {
                let term = |vertex: usize| net[below(vertex) + k] * index[vertex] as f64;
                net[target + k] = used.clone().fold(term(first), |sum, a| sum + term(a)) / degree as f64;
            }
        }
        if !step_back(&mut index) {
            break;
        }
    }
}

/// `β − eₐ`, for `βₐ > 0`
#[inline]
pub(crate) fn lowered<const V: usize>(mut index: [usize; V], vertex: usize) -> [usize; V] {
    index[vertex] -= 1;
    index
}
