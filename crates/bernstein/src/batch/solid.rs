//! What batches over boxes, wedges and tetrahedra have in common: their nets as plain numbers.
//!
//! All three are polynomials `Σᵢ Σⱼ Σₖ` of three coordinates; the solids differ in how far j and k run, and in what
//! stands for "the rest": 1 − u, 1 − v, 1 − w of a box, λ₃ and 1 − w of a wedge, λ₄ of a tetrahedron.

use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::BatchPoint;
use super::scattered::{self, one_by_one, rational_one_by_one};
use super::solid_kernel::{ANY, MOST, QUARTIC, Solid, TRICUBIC};
use crate::glam::{DVec3, DVec4};
use crate::{BernsteinError, MAX_DEGREE, basis, binomial, last_barycentric, simplex_basis, simplex_index};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Box,
    Wedge,
    Tetrahedron,
}

/// How far the three indices run: i to `outer`, j to `middle`, less i but in a box, k to `inner`, less i + j in a
/// tetrahedron.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shape {
    pub(super) kind: Kind,
    /// The largest i, j and k.
    pub(super) degrees: [usize; 3],
}

impl Shape {
    #[inline(always)]
    pub(super) fn middle(&self, i: usize) -> usize {
        if self.kind == Kind::Box { self.degrees[1] } else { self.degrees[1] - i }
    }

    #[inline(always)]
    pub(super) fn inner(&self, i: usize, j: usize) -> usize {
        if self.kind == Kind::Tetrahedron { self.degrees[2] - i - j } else { self.degrees[2] }
    }

    /// The degree of all coordinates together.
    pub(super) fn total(&self) -> usize {
        let [l, m, n] = self.degrees;
        match self.kind {
            Kind::Box => l + m + n,
            Kind::Wedge => l + n,
            Kind::Tetrahedron => l,
        }
    }

    /// The shape of the derivative with the coordinate `axis`, or of the polynomial itself for none; `None` where it
    /// vanishes.
    #[inline(always)]
    pub(super) fn lowered(&self, axis: Option<usize>) -> Option<Self> {
        let Some(axis) = axis else { return Some(*self) };
        let mut degrees = self.degrees;
        for (other, degree) in degrees.iter_mut().enumerate() {
            let together = match self.kind {
                Kind::Box => other == axis,
                Kind::Wedge => (other < 2) == (axis < 2),
                Kind::Tetrahedron => true,
            };
            if together {
                *degree = degree.checked_sub(1)?;
            }
        }
        Some(Self { degrees, ..*self })
    }

    /// The place of a control point in the net.
    fn place(&self, [i, j, k]: [usize; 3]) -> usize {
        let [l, m, n] = self.degrees;
        match self.kind {
            Kind::Box => (i * (m + 1) + j) * (n + 1) + k,
            Kind::Wedge => simplex_index([i, j, l - i - j]) * (n + 1) + k,
            Kind::Tetrahedron => simplex_index([i, j, k, l - i - j - k]),
        }
    }

    /// The control points of the derivative, `degree · Δ P`, or of the polynomial itself, multiplied by `C(l,i) C(m,j)
    /// C(n,k)` with m and n as far as j and k run, from the last i, j, k to the first: as Horner's scheme takes them.
    fn scaled<P: BatchPoint>(&self, points: &[P], axis: Option<usize>) -> Vec<f64> {
        let Some(lower) = self.lowered(axis) else { return Vec::new() };
        let mut scaled = Vec::new();
        for i in (0..=lower.degrees[0]).rev() {
            let middle = lower.middle(i);
            for j in (0..=middle).rev() {
                let inner = lower.inner(i, j);
                for k in (0..=inner).rev() {
                    let factor = binomial(lower.degrees[0], i) * binomial(middle, j) * binomial(inner, k);
                    let point = points[self.place([i, j, k])];
                    scaled.push(match axis {
                        None => point * factor,
                        Some(axis) => {
                            let mut raised = [i, j, k];
                            raised[axis] += 1;
                            (points[self.place(raised)] - point) * (factor * self.degrees[axis] as f64)
                        }
                    });
                }
            }
        }
        cast_slice(&scaled).to_vec()
    }

    /// The three coordinates that a place has, and 1 less their sum where they are barycentric.
    pub(super) fn barycentric(&self, [u, v, w]: [f64; 3]) -> [f64; 4] {
        let last = match self.kind {
            Kind::Box => 0.0,
            Kind::Wedge => last_barycentric(&[u, v]),
            Kind::Tetrahedron => last_barycentric(&[u, v, w]),
        };
        [u, v, w, last]
    }

    /// `Σ|B w|` at one place, for a rational net.
    #[cold]
    pub(super) fn scale(&self, net: &[f64], at: [f64; 3], scratch: &mut Vec<f64>) -> f64 {
        let [l, m, n] = self.degrees;
        let [u, v, w, last] = self.barycentric(at);
        let mut rows = [[0.0; MAX_DEGREE + 1]; 2];
        let [in_v, in_w] = &mut rows;
        let (in_v, in_w) = (&mut in_v[..=m], &mut in_w[..=n]);
        // Of the first coordinates in `scratch`, of the others in the rows.
        let answer = match self.kind {
            Kind::Box => {
                scratch.resize(l + 1, 0.0);
                basis(u, scratch);
                basis(v, in_v);
                basis(w, in_w);
                Ok(())
            }
            Kind::Wedge => {
                scratch.resize(net.len() / (4 * (n + 1)), 0.0);
                basis(w, in_w);
                in_v[0] = 1.0;
                simplex_basis(l, [u, v, last], scratch)
            }
            Kind::Tetrahedron => {
                scratch.resize(net.len() / 4, 0.0);
                (in_v[0], in_w[0]) = (1.0, 1.0);
                simplex_basis(l, [u, v, w, last], scratch)
            }
        };
        if answer.is_err() {
            return f64::INFINITY; // never: the net was checked
        }
        let in_v = if self.kind == Kind::Box { &*in_v } else { &in_v[..1] };
        let in_w = if self.kind == Kind::Tetrahedron { &in_w[..1] } else { &*in_w };
        let mut weights = net.iter().skip(3).step_by(4);
        let mut sum = 0.0;
        for a in &*scratch {
            for b in in_v {
                for c in in_w {
                    sum += weights.next().map_or(0.0, |weight| (weight * a * b * c).abs());
                }
            }
        }
        sum
    }
}

/// The nets of a solid.
#[derive(Debug, Clone)]
pub(super) struct Nets<P> {
    pub(super) points: Vec<P>,
    pub(super) shape: Shape,
    /// Those of the value and the first derivatives, see [`Shape::scaled`]; none where degrees are too high for registers.
    scaled: Vec<Vec<f64>>,
}

impl<P: BatchPoint> Nets<P> {
    /// Of as many `points` as the shape has.
    pub(super) fn new(points: &[P], shape: Shape) -> Self {
        let orders: &[Option<usize>] =
            if shape.total() <= MOST { &[None, Some(0), Some(1), Some(2)] } else { &[] };
        let scaled = orders.iter().map(|&axis| shape.scaled(points, axis)).collect();
        Self { points: points.to_vec(), shape, scaled }
    }

    /// Values, with first derivatives; `single` makes them of one place, in case the degrees are too high.
    pub(super) fn evaluate<const K: usize>(
        &self,
        parameters: &[DVec3],
        out: [&mut [P]; K],
        single: impl Fn(DVec3, &mut [P]),
    ) -> Result<(), BernsteinError> {
        scattered::check_lengths(parameters, &out)?;
        if self.scaled.is_empty() {
            let mut out = out;
            one_by_one(parameters, &mut out, single);
            return Ok(());
        }
        let mut out = out.map(cast_slice_mut::<P, f64>);
        self.view().plain(P::DIMENSION, cast_slice(parameters), &mut out)
    }

    fn view(&self) -> View<'_> {
        View { net: cast_slice(&self.points), shape: self.shape, scaled: &self.scaled }
    }
}

impl Nets<DVec4> {
    /// The same of the rational shape.
    pub(super) fn evaluate_rational<const K: usize>(
        &self,
        parameters: &[DVec3],
        out: [&mut [DVec3]; K],
        single: impl Fn(DVec3, &mut [DVec4]),
    ) -> Result<(), BernsteinError> {
        scattered::check_lengths(parameters, &out)?;
        let mut out = out.map(cast_slice_mut::<DVec3, f64>);
        if self.scaled.is_empty() {
            return rational_one_by_one(Solid::<ANY>(self.view()), parameters, &mut out, single);
        }
        self.view().rational(cast_slice(parameters), &mut out)
    }
}

/// A solid as plain numbers.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) net: &'a [f64],
    pub(super) shape: Shape,
    pub(super) scaled: &'a [Vec<f64>],
}

impl View<'_> {
    fn plain(
        self,
        dimension: usize,
        parameters: &[f64],
        out: &mut [&mut [f64]],
    ) -> Result<(), BernsteinError> {
        // Tricubic boxes in space have kernels of their own, with unrolled loops.
        if dimension == 3 && self.shape == Solid::<TRICUBIC>::SHAPE {
            scattered::solid::<_, false>(Solid::<TRICUBIC>(self), dimension, parameters, out)
        } else {
            scattered::solid::<_, false>(Solid::<ANY>(self), dimension, parameters, out)
        }
    }

    fn rational(self, parameters: &[f64], out: &mut [&mut [f64]]) -> Result<(), BernsteinError> {
        // And so have quartic tetrahedra.
        if self.shape == Solid::<QUARTIC>::SHAPE {
            scattered::solid::<_, true>(Solid::<QUARTIC>(self), 4, parameters, out)
        } else {
            scattered::solid::<_, true>(Solid::<ANY>(self), 4, parameters, out)
        }
    }
}
