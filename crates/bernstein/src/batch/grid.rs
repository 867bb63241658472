//! Tensor-product patches on grids of parameters.

use std::sync::atomic::AtomicUsize;

use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::grid_kernel::{Chunk, NORMALS, PLAIN, RATIONAL};
use super::grid_table::{Columns, MAX_ORDER, Rows};
use super::nets::{ANY, ORDERS};
use super::parallel::{CHUNK, each_chunk};
use super::quotient::refuse_pole;
use super::simd::{dispatch, dispatch_in};
use super::{BatchPoint, check_length};
use crate::glam::{DVec3, DVec4};
use crate::{BernsteinError, MAX_DEGREE};

/// A grid of parameters (uᵢ, vⱼ) for nets of fixed degrees: the basis is evaluated once for each row and
/// column.
///
/// A grid serves any number of nets; one call takes many, for small patches by the thousand. Results stand
/// row by row: the point at (uᵢ, vⱼ) of a net at place `i·N + j`, N being the number of the vⱼ, net after
/// net.
///
/// ```
/// use casteljau_bernstein::GridBatch;
/// let grid = GridBatch::new([1, 1], &[0.0, 0.5], &[0.25, 0.5, 1.0], 1)?;
/// let [mut value, mut in_u, mut in_v] = [[0.0; 6]; 3];
/// grid.evaluate(&[0.0, 0.0, 0.0, 1.0], [&mut value, &mut in_u, &mut in_v])?; // u·v
/// assert_eq!(value, [0.0, 0.0, 0.0, 0.125, 0.25, 0.5]);
/// assert_eq!(in_u[3..], [0.25, 0.5, 1.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone)]
pub struct GridBatch {
    pub(super) u: Rows,
    pub(super) v: Columns,
}

impl GridBatch {
    /// Prepares a grid for nets of the degrees m (with u) and n (with v) and for derivatives up to `order`,
    /// at most 2.
    ///
    /// Any parameters, in any order. Cost: the basis at each uᵢ, two divisions for each vⱼ.
    ///
    /// # Errors
    /// [`BernsteinError::Degree`] above [`MAX_DEGREE`], [`BernsteinError::Order`] above 2.
    pub fn new(degrees: [usize; 2], u: &[f64], v: &[f64], order: usize) -> Result<Self, BernsteinError> {
        if let Some(&degree) = degrees.iter().find(|&&d| d > MAX_DEGREE) {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
        }
        if order > MAX_ORDER {
            return Err(BernsteinError::Order { order, limit: MAX_ORDER });
        }
        Ok(Self { u: Rows::new(degrees[0], u, order), v: Columns::new(degrees[1], v) })
    }

    /// Degrees of the nets.
    #[must_use]
    pub fn degrees(&self) -> [usize; 2] {
        [self.u.degree, self.v.degree]
    }

    /// Points a net has on the grid: the number of the uᵢ times that of the vⱼ.
    #[must_use]
    pub fn points_per_net(&self) -> usize {
        self.u.count * self.v.count
    }

    /// Values (K = 1), with first (K = 3) and second (K = 6) partial derivatives, each kind in its own
    /// buffer, in the order of [`partial_index`](crate::partial_index): 1; u, v; uu, uv, vv.
    ///
    /// `nets` holds one net or several, one after another, in the order of [`TensorNet`](crate::TensorNet).
    /// Error: at most `4(m + n + 2(a+b) + 2)·u·scale`, see [the crate](crate). Cost: n + 1 multiply-adds a
    /// component and point, and (m+1)(n+1) a row; scratch for one net a thread.
    ///
    /// # Errors
    /// [`BernsteinError::NetLength`] unless `nets` holds whole nets, [`BernsteinError::BufferLength`] unless
    /// every buffer holds [`points_per_net`](Self::points_per_net) for each, [`BernsteinError::Order`] where
    /// the grid was not prepared for such derivatives.
    pub fn evaluate<P: BatchPoint, const K: usize>(
        &self,
        nets: &[P],
        out: [&mut [P]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(K == 1 || K == 3 || K == 6, "values; first; second derivatives") };
        self.check(nets.len(), out.each_ref().map(|out| out.len()))?;
        let mut out = out.map(cast_slice_mut::<P, f64>);
        self.plain(P::DIMENSION, cast_slice(nets), &mut out)
    }

    /// As [`evaluate`](Self::evaluate), for rational nets `(w·x, w·y, w·z, w)`: points and derivatives in
    /// space, by the quotient rule.
    ///
    /// Error: that of numerator and denominator, magnified by 1/|w| once an order.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate), and [`BernsteinError::Pole`] with the first place where the
    /// denominator vanishes within its rounding error, or the quotient is out of range; the buffers hold 0 at
    /// such places, and the answers everywhere else.
    pub fn evaluate_rational<const K: usize>(
        &self,
        nets: &[DVec4],
        out: [&mut [DVec3]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(K == 1 || K == 3 || K == 6, "values; first; second derivatives") };
        self.check(nets.len(), out.each_ref().map(|out| out.len()))?;
        let mut out = out.map(cast_slice_mut::<DVec3, f64>);
        self.rational(cast_slice(nets), &mut out)
    }

    /// Points and unit normals `∂u × ∂v / |∂u × ∂v|`.
    ///
    /// The normal is the zero vector where ∂u and ∂v do not span a plane: where one of them is at most 2⁻⁴⁴
    /// of the largest difference of its net, or the sine of the angle between them is at most 2⁻⁴⁴. Error in
    /// angle: that of the derivatives over their length and over the sine.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); the grid must be prepared for first derivatives.
    pub fn normals(
        &self,
        nets: &[DVec3],
        points: &mut [DVec3],
        normals: &mut [DVec3],
    ) -> Result<(), BernsteinError> {
        self.check(nets.len(), [points.len(), normals.len(), normals.len()])?;
        let out = [cast_slice_mut(points), cast_slice_mut(normals)];
        self.run(3, 3, cast_slice(nets), out, |rows| {
            if self.degrees() == [3, 3] {
                dispatch_in::<_, 3>(rows.by::<NORMALS, 3>());
            } else {
                dispatch_in::<_, 3>(rows.by::<NORMALS, ANY>());
            }
        })
    }

    /// Not generic, so that the kernels are compiled with this crate and once.
    fn plain(&self, dimension: usize, nets: &[f64], out: &mut [&mut [f64]]) -> Result<(), BernsteinError> {
        match out {
            [a] => self.plain_in(dimension, nets, [a]),
            [a, b, c] => self.plain_in(dimension, nets, [a, b, c]),
            [a, b, c, d, e, f] => self.run(dimension, dimension, nets, [a, b, c, d, e, f], |rows| {
                dispatch(dimension, rows.by::<PLAIN, ANY>());
            }),
            _ => Ok(()),
        }
    }

    /// Cubic patches in space have kernels of their own, with unrolled loops.
    fn plain_in<const K: usize>(
        &self,
        dimension: usize,
        nets: &[f64],
        out: [&mut [f64]; K],
    ) -> Result<(), BernsteinError> {
        let unrolled = dimension == 3 && self.degrees() == [3, 3];
        self.run(dimension, dimension, nets, out, |rows| {
            if unrolled {
                dispatch_in::<_, 3>(rows.by::<PLAIN, 3>());
            } else {
                dispatch(dimension, rows.by::<PLAIN, ANY>());
            }
        })
    }

    fn rational(&self, nets: &[f64], out: &mut [&mut [f64]]) -> Result<(), BernsteinError> {
        match out {
            [a] => self.rational_in(nets, [a]),
            [a, b, c] => self.rational_in(nets, [a, b, c]),
            [a, b, c, d, e, f] => self.run(4, 3, nets, [a, b, c, d, e, f], |rows| {
                dispatch_in::<_, 4>(rows.by::<RATIONAL, ANY>());
            }),
            _ => Ok(()),
        }
    }

    fn rational_in<const K: usize>(&self, nets: &[f64], out: [&mut [f64]; K]) -> Result<(), BernsteinError> {
        self.run(4, 3, nets, out, |rows| match self.degrees() {
            [3, 3] => dispatch_in::<_, 4>(rows.by::<RATIONAL, 3>()),
            [5, 5] => dispatch_in::<_, 4>(rows.by::<RATIONAL, 5>()),
            _ => dispatch_in::<_, 4>(rows.by::<RATIONAL, ANY>()),
        })
    }

    /// Checks the number of control points, and the buffers of an evaluation of `K` kinds of derivatives.
    fn check<const K: usize>(&self, points: usize, out: [usize; K]) -> Result<(), BernsteinError> {
        let degrees = self.degrees();
        let size = (degrees[0] + 1) * (degrees[1] + 1);
        if !points.is_multiple_of(size) {
            return Err(BernsteinError::NetLength { degrees, given: points });
        }
        let (order, limit) = (ORDERS[K - 1][1], self.u.order());
        if order > limit {
            return Err(BernsteinError::Order { order, limit });
        }
        let needed = (points / size).saturating_mul(self.points_per_net());
        out.iter().try_for_each(|&given| check_length("out", needed, given))
    }

    /// Cuts the rows of all nets into chunks, for results of `width` numbers a point.
    fn run<const K: usize>(
        &self,
        dimension: usize,
        width: usize,
        nets: &[f64],
        out: [&mut [f64]; K],
        kernel: impl Fn(Chunk<'_, K>) + Send + Sync,
    ) -> Result<(), BernsteinError> {
        let rows = nets.len() / ((self.u.degree + 1) * (self.v.degree + 1) * dimension) * self.u.count;
        if rows == 0 || self.v.count == 0 {
            return Ok(());
        }
        // Whole nets where they are small, so that each is prepared once.
        let mut height = CHUNK.div_ceil(self.v.count);
        if height > self.u.count {
            height = height.next_multiple_of(self.u.count);
        }
        let out = out.map(|out| out.chunks_mut(height * self.v.count * width));
        let pole = AtomicUsize::new(usize::MAX);
        each_chunk((0..rows).step_by(height), out, |first, out| {
            kernel(Chunk { grid: self, nets, rows: first..rows.min(first + height), out, pole: &pole });
        });
        refuse_pole(pole.into_inner())
    }
}
