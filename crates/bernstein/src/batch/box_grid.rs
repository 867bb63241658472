//! Tensor-product solids on grids of parameters.

use std::sync::atomic::AtomicUsize;

use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::box_grid_kernel::{Chunk, PLAIN, RATIONAL, prepare};
use super::grid_table::{Columns, Rows, TABULATED};
use super::nets::ANY;
use super::parallel::{CHUNK, each_chunk};
use super::quotient::refuse_pole;
use super::simd::{dispatch, dispatch_in};
use super::{BatchPoint, check_length};
use crate::glam::{DVec3, DVec4};
use crate::{BernsteinError, MAX_DEGREE};

/// Highest order of derivatives of solids on grids.
const MAX_ORDER: usize = 1;

/// A grid of parameters (uᵢ, vⱼ, wₖ) for nets of fixed degrees: the basis is evaluated once for each of them.
///
/// A grid serves any number of nets; one call takes many. The point at (uᵢ, vⱼ, wₖ) of a net stands at place `(i·M + j)·N + k`,
/// M being the number of the vⱼ and N that of the wₖ, net after net.
///
/// ```
/// use casteljau_bernstein::BoxGridBatch;
/// let grid = BoxGridBatch::new([1, 1, 1], &[0.5], &[0.0, 0.5], &[0.25, 0.5, 1.0], 1)?;
/// let [mut value, mut in_u, mut in_v, mut in_w] = [[0.0; 6]; 4];
/// let net = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]; // u·v·w
/// grid.evaluate(&net, [&mut value, &mut in_u, &mut in_v, &mut in_w])?;
/// assert_eq!(value, [0.0, 0.0, 0.0, 0.0625, 0.125, 0.25]);
/// assert_eq!((in_u[5], in_v[5], in_w[5]), (0.5, 0.5, 0.25));
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
#[derive(Debug, Clone)]
pub struct BoxGridBatch {
    pub(super) u: Rows,
    pub(super) v: Rows,
    pub(super) w: Columns,
}

impl BoxGridBatch {
    /// Prepares a grid for nets of the degrees l (with u), m (with v) and n (with w) and for derivatives up to `order`, at most
    /// 1.
    ///
    /// Any parameters, in any order. Cost: the basis at each uᵢ and vⱼ, two divisions for each wₖ.
    ///
    /// # Errors
    /// [`BernsteinError::Degree`] above [`MAX_DEGREE`], [`BernsteinError::Order`] above 1.
    pub fn new(
        degrees: [usize; 3],
        u: &[f64],
        v: &[f64],
        w: &[f64],
        order: usize,
    ) -> Result<Self, BernsteinError> {
        if let Some(&degree) = degrees.iter().find(|&&d| d > MAX_DEGREE) {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE });
        }
        if order > MAX_ORDER {
            return Err(BernsteinError::Order { order, limit: MAX_ORDER });
        }
        let [l, m, n] = degrees;
        Ok(Self { u: Rows::new(l, u, order), v: Rows::new(m, v, order), w: Columns::new(n, w) })
    }

    /// Degrees of the nets.
    #[must_use]
    pub fn degrees(&self) -> [usize; 3] {
        [self.u.degree, self.v.degree, self.w.degree]
    }

    /// Points a net has on the grid: the product of the numbers of the uᵢ, vⱼ and wₖ.
    #[must_use]
    pub fn points_per_net(&self) -> usize {
        self.lines_per_net() * self.w.count
    }

    fn lines_per_net(&self) -> usize {
        self.u.count * self.v.count
    }

    /// Values (K = 1), with first partial derivatives (K = 4), each kind in its own buffer: 1; u, v, w.
    ///
    /// `nets` holds one net or several, one after another, in the order of [`BoxNet`](crate::BoxNet). Error: at most `4(l + m +
    /// n + 2k + 2)·u·scale`, k being 1 for derivatives, see [the crate](crate). Cost: n + 1 multiply-adds a component and point,
    /// (m+1)(n+1) a line (uᵢ, vⱼ), (l+1)(m+1)(n+1) a layer uᵢ; memory for as many nets as there are kinds.
    ///
    /// # Errors
    /// [`BernsteinError::BoxNetLength`] unless `nets` holds whole nets, [`BernsteinError::BufferLength`] unless every buffer
    /// holds [`points_per_net`](Self::points_per_net) for each, [`BernsteinError::Order`] where the grid was not prepared for
    /// derivatives.
    pub fn evaluate<P: BatchPoint, const K: usize>(
        &self,
        nets: &[P],
        out: [&mut [P]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(K == 1 || K == 4, "values; first derivatives") };
        self.check(nets.len(), out.each_ref().map(|out| out.len()))?;
        let mut out = out.map(cast_slice_mut::<P, f64>);
        self.plain(P::DIMENSION, cast_slice(nets), &mut out)
    }

    /// As [`evaluate`](Self::evaluate), for rational nets `(w·x, w·y, w·z, w)`: points and derivatives in space, by the quotient
    /// rule.
    ///
    /// Error: that of numerator and denominator, magnified by 1/|w| once an order.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate), and [`BernsteinError::Pole`] with the first place where the denominator vanishes within
    /// its rounding error, or the quotient is out of range; the buffers hold 0 at such places, and the answers everywhere else.
    pub fn evaluate_rational<const K: usize>(
        &self,
        nets: &[DVec4],
        out: [&mut [DVec3]; K],
    ) -> Result<(), BernsteinError> {
        const { assert!(K == 1 || K == 4, "values; first derivatives") };
        self.check(nets.len(), out.each_ref().map(|out| out.len()))?;
        let mut out = out.map(cast_slice_mut::<DVec3, f64>);
        self.rational(cast_slice(nets), &mut out)
    }

    /// Not generic, so that the kernels are compiled with this crate and once.
    fn plain(&self, dimension: usize, nets: &[f64], out: &mut [&mut [f64]]) -> Result<(), BernsteinError> {
        match out {
            [a] => self.plain_in(dimension, nets, [a]),
            [a, b, c, d] => self.plain_in(dimension, nets, [a, b, c, d]),
            _ => Ok(()),
        }
    }

    /// Solids in space, cubic in w, have kernels of their own, with unrolled loops.
    fn plain_in<const K: usize>(
        &self,
        dimension: usize,
        nets: &[f64],
        out: [&mut [f64]; K],
    ) -> Result<(), BernsteinError> {
        if dimension == 3 && self.w.degree == TABULATED {
            return self.run::<K, PLAIN, TABULATED>(dimension, nets, out, |chunk| dispatch_in::<_, 3>(chunk));
        }
        self.run::<K, PLAIN, ANY>(dimension, nets, out, |chunk| dispatch(dimension, chunk))
    }

    fn rational(&self, nets: &[f64], out: &mut [&mut [f64]]) -> Result<(), BernsteinError> {
        match out {
            [a] => self.rational_in(nets, [a]),
            [a, b, c, d] => self.rational_in(nets, [a, b, c, d]),
            _ => Ok(()),
        }
    }

    fn rational_in<const K: usize>(&self, nets: &[f64], out: [&mut [f64]; K]) -> Result<(), BernsteinError> {
        if self.w.degree == 5 {
            return self.run::<K, RATIONAL, 5>(4, nets, out, |chunk| dispatch_in::<_, 4>(chunk));
        }
        self.run::<K, RATIONAL, ANY>(4, nets, out, |chunk| dispatch_in::<_, 4>(chunk))
    }

    /// Checks the number of control points, and the buffers of an evaluation of `K` kinds of derivatives.
    fn check<const K: usize>(&self, points: usize, out: [usize; K]) -> Result<(), BernsteinError> {
        let degrees = self.degrees();
        let size: usize = degrees.iter().map(|d| d + 1).product();
        if !points.is_multiple_of(size) {
            return Err(BernsteinError::BoxNetLength { degrees, given: points });
        }
        let (order, limit) = (usize::from(K > 1), self.u.order());
        if order > limit {
            return Err(BernsteinError::Order { order, limit });
        }
        let needed = (points / size).saturating_mul(self.points_per_net());
        out.iter().try_for_each(|&given| check_length("out", needed, given))
    }

    /// Cuts the lines of all nets into chunks.
    fn run<'a, const K: usize, const KIND: u8, const N: usize>(
        &'a self,
        dimension: usize,
        nets: &'a [f64],
        out: [&mut [f64]; K],
        kernel: impl Fn(Chunk<'_, K, KIND, N>) + Send + Sync,
    ) -> Result<(), BernsteinError> {
        let size: usize = self.degrees().iter().map(|d| d + 1).product();
        let lines = nets.len() / (size * dimension) * self.lines_per_net();
        if lines == 0 || self.w.count == 0 {
            return Ok(());
        }
        let prepared = prepare(nets, self.degrees(), dimension, K, KIND == RATIONAL || N != TABULATED);
        // Whole layers where they are small, so that each is made once.
        let mut height = CHUNK.div_ceil(self.w.count);
        if self.v.count <= 4 * height {
            height = height.next_multiple_of(self.v.count);
        }
        let width = if KIND == RATIONAL { 3 } else { dimension };
        let out = out.map(|out| out.chunks_mut(height * self.w.count * width));
        let pole = AtomicUsize::new(usize::MAX);
        each_chunk((0..lines).step_by(height), out, |first, out| {
            let lines = first..lines.min(first + height);
            kernel(Chunk { grid: self, nets, prepared: &prepared, lines, out, pole: &pole });
        });
        refuse_pole(pole.into_inner())
    }
}
