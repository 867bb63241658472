//! Composition: shapes whose arguments are polynomials themselves.
//!
//! `p(q(s)) = Σ Bᵢⁿ(q(s)) Pᵢ` needs the polynomials `Bᵢⁿ∘q = C(n,i) (1−q)ⁿ⁻ⁱ qⁱ`. They are made of the powers
//! of q and of 1 − q, which are products in Bernstein form. Where the coefficients of q lie in `[0, 1]` all of
//! this is sums of positive terms, and the composed basis adds up to 1 like the basis itself: no cancellation,
//! no overflow, at any degree. Outside it is as stable as evaluation is there.

use crate::line::net_size;
use crate::space::BernsteinSpace;
use crate::{BernsteinError, Point, binomial};

/// Composition of a tensor-product shape with polynomial arguments, `p(q₁(s), q₂(s), …)`.
///
/// The outer net has `degrees` in the order of [`TensorNet`](crate::TensorNet) and
/// [`BoxNet`](crate::BoxNet): a curve with D = 1, a patch with 2, a solid with 3. Each argument is a scalar
/// polynomial of the space `inner`: `[d]` on an interval, `[d, e]` on the square, and so on, or over a simplex.
/// The result lies in the space `inner.power(Σ degrees)`.
///
/// Error of each point: for arguments on an interval at most `4(Σ nᵢ(d + 2) + 2)·u·scale`, scale being the
/// composition of absolute values (of the outer points, of the arguments and of 1 − them); over other domains d
/// is the number of an argument's coefficients less one. Cost: a polynomial product for each point of the outer
/// net that is not on its last axis, and 2 Σ nᵢ more; a workspace is allocated.
///
/// ```
/// use casteljau_bernstein::compose;
/// // x = t² along a curve, with t = s².
/// let mut quartic = [0.0; 5];
/// compose(&[0.0, 0.0, 1.0], [2], [&[0.0, 0.0, 1.0]], [2], &mut quartic)?;
/// assert_eq!(quartic, [0.0, 0.0, 0.0, 0.0, 1.0]);
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::Degree`] where the result's degree is not served; [`BernsteinError::BufferLength`] for
/// `outer`, `arguments` and `out`.
///
/// Source: DeRose, Goldman, Hagen and Mann, *Functional composition algorithms via blossoming*, ACM Transactions
/// on Graphics 12, 1993.
pub fn compose<P: Point, S: BernsteinSpace, const D: usize>(
    outer: &[P],
    degrees: [usize; D],
    arguments: [&[f64]; D],
    inner: S,
    out: &mut [P],
) -> Result<(), BernsteinError> {
    let size = inner.size()?;
    for argument in arguments {
        check_buffer("arguments", argument.len(), size)?;
    }
    let complements = arguments.map(complement);
    let mut pairs = [[&[] as &[f64]; 2]; D];
    for ((pair, t), s) in pairs.iter_mut().zip(arguments).zip(&complements) {
        *pair = [s, t];
    }
    compose_homogeneous(outer, degrees, pairs, inner, out)
}

/// Composition of a tensor-product shape with homogeneous arguments, `Σ C(n,i) sⁿ⁻ⁱ tⁱ Pᵢ` along each axis.
///
/// With `s = 1 − t` this is [`compose`]. A rational argument `x/w` has `[w − x, x]`: the result is the
/// homogeneous form of the composed shape, times `wⁿ`, which cancels for rational shapes. Error and cost as for
/// [`compose`].
///
/// # Errors
/// As for [`compose`].
pub fn compose_homogeneous<P: Point, S: BernsteinSpace, const D: usize>(
    outer: &[P],
    degrees: [usize; D],
    arguments: [[&[f64]; 2]; D],
    inner: S,
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_buffer("outer", outer.len(), net_size(degrees)?)?;
    let total = degrees.iter().sum();
    check_buffer("out", out.len(), inner.power(total).size()?)?;
    let mut axes = Vec::with_capacity(D);
    for (degree, [s, t]) in degrees.into_iter().zip(arguments) {
        axes.push(composed_basis(degree, powers(s, degree, inner)?, powers(t, degree, inner)?, inner)?);
    }
    out.copy_from_slice(&contract(outer, &axes, inner)?.points);
    Ok(())
}

/// Composition of a shape over a simplex with polynomial barycentric coordinates,
/// `Σ n!/α! λ₀^α₀ λ₁^α₁ … P_α`: of a triangle for three coordinates, of a tetrahedron for four.
///
/// The outer points stand in descending lexicographic order of their multi-indices. `coordinates` are all
/// barycentric coordinates, each a polynomial of the space `inner`; [`last_coordinate`] makes the one that brings
/// the sum to 1. They need not add up to 1: then the result is homogeneous. It lies in `inner.power(degree)`.
///
/// Error as for [`compose`]. Cost: a polynomial product for each point that does not belong to the last two
/// coordinates alone; a workspace is allocated.
///
/// # Errors
/// [`BernsteinError::NoPoints`] without coordinates; [`BernsteinError::Degree`];
/// [`BernsteinError::BufferLength`] for `outer`, `coordinates` and `out`.
pub fn compose_simplex<P: Point, S: BernsteinSpace>(
    outer: &[P],
    degree: usize,
    coordinates: &[&[f64]],
    inner: S,
    out: &mut [P],
) -> Result<(), BernsteinError> {
    let size = inner.size()?;
    for coordinate in coordinates {
        check_buffer("coordinates", coordinate.len(), size)?;
    }
    net_size([degree])?;
    check_buffer("out", out.len(), inner.power(degree).size()?)?;
    let dimension = coordinates.len().checked_sub(1).ok_or(BernsteinError::NoPoints)?;
    check_buffer("outer", outer.len(), simplex_size(degree, dimension))?;
    let powers: Result<Vec<_>, _> = coordinates.iter().map(|c| powers(c, degree, inner)).collect();
    let leaf = |points: &[P]| constant(points.first().copied().unwrap_or(P::ZERO), inner);
    out.copy_from_slice(&contract_simplex(outer, degree, &powers?, 1, &leaf)?.points);
    Ok(())
}

/// Composition of a wedge with polynomial arguments: three barycentric coordinates of the triangle and the
/// height.
///
/// `degrees` are those of the triangle and of the height, n and o, the outer points in the order of
/// [`WedgeNet`](crate::WedgeNet). The result lies in `inner.power(n + o)`. The coordinates as for
/// [`compose_simplex`], the height as an argument of [`compose`]; error and cost as for these.
///
/// # Errors
/// [`BernsteinError::Degree`]; [`BernsteinError::BufferLength`] for `outer`, `coordinates`, `height` and `out`.
pub fn compose_wedge<P: Point, S: BernsteinSpace>(
    outer: &[P],
    degrees: [usize; 2],
    coordinates: [&[f64]; 3],
    height: &[f64],
    inner: S,
    out: &mut [P],
) -> Result<(), BernsteinError> {
    check_buffer("height", height.len(), inner.size()?)?;
    compose_wedge_homogeneous(outer, degrees, coordinates, [&complement(height), height], inner, out)
}

/// Composition of a wedge with homogeneous arguments: three coordinates of the triangle, which need not add up to 1,
/// and the pair `[w − z, z]` for a height z/w.
///
/// With coordinates whose sum is w the result is the homogeneous form of the composed shape, times wⁿ⁺ᵒ, which cancels
/// for rational shapes. Otherwise as [`compose_wedge`].
///
/// # Errors
/// As for [`compose_wedge`].
pub fn compose_wedge_homogeneous<P: Point, S: BernsteinSpace>(
    outer: &[P],
    degrees: [usize; 2],
    coordinates: [&[f64]; 3],
    height: [&[f64]; 2],
    inner: S,
    out: &mut [P],
) -> Result<(), BernsteinError> {
    let (size, [n, o]) = (inner.size()?, degrees);
    for coordinate in coordinates {
        check_buffer("coordinates", coordinate.len(), size)?;
    }
    for part in height {
        check_buffer("height", part.len(), size)?;
    }
    net_size(degrees)?;
    check_buffer("out", out.len(), inner.power(n.saturating_add(o)).size()?)?;
    check_buffer("outer", outer.len(), simplex_size(n, 2).saturating_mul(o.saturating_add(1)))?;
    let along = composed_basis(o, powers(height[0], o, inner)?, powers(height[1], o, inner)?, inner)?;
    let across: Result<Vec<_>, _> = coordinates.iter().map(|c| powers(c, n, inner)).collect();
    let leaf = |line: &[P]| combine(line, &along, inner);
    out.copy_from_slice(&contract_simplex(outer, n, &across?, o + 1, &leaf)?.points);
    Ok(())
}

/// The last barycentric coordinate, `1 − Σ` of the others, coefficient by coefficient.
///
/// Error: at most `k·u·(1 + Σ|λ|)` for k others.
///
/// # Errors
/// [`BernsteinError::BufferLength`] where lengths differ.
pub fn last_coordinate(others: &[&[f64]], out: &mut [f64]) -> Result<(), BernsteinError> {
    out.fill(1.0);
    for other in others {
        check_buffer("others", other.len(), out.len())?;
        for (rest, x) in out.iter_mut().zip(*other) {
            *rest -= x;
        }
    }
    Ok(())
}

fn complement(t: &[f64]) -> Vec<f64> {
    t.iter().map(|t| 1.0 - t).collect()
}

fn check_buffer(buffer: &'static str, given: usize, needed: usize) -> Result<(), BernsteinError> {
    crate::line::check_length(buffer, given, needed)
}

/// A polynomial and where it lies.
struct Polynomial<P, S> {
    points: Vec<P>,
    space: S,
}

/// `factor` times the product, added to `sum`, or in its place where there is none yet.
fn add_product<P: Point, S: BernsteinSpace>(
    sum: &mut Option<Polynomial<P, S>>,
    a: &Polynomial<f64, S>,
    b: &Polynomial<P, S>,
    factor: f64,
) -> Result<(), BernsteinError> {
    let product = multiply(a, b)?;
    match sum {
        None => {
            let points = product.points.into_iter().map(|p| p * factor).collect();
            *sum = Some(Polynomial { points, space: product.space });
        }
        Some(sum) => {
            for (sum, p) in sum.points.iter_mut().zip(product.points) {
                *sum = *sum + p * factor;
            }
        }
    }
    Ok(())
}

fn multiply<P: Point, S: BernsteinSpace>(
    a: &Polynomial<f64, S>,
    b: &Polynomial<P, S>,
) -> Result<Polynomial<P, S>, BernsteinError> {
    let space = a.space.times(b.space);
    let mut points = vec![P::ZERO; space.size()?];
    a.space.multiply(&a.points, b.space, &b.points, &mut points)?;
    Ok(Polynomial { points, space })
}

/// A constant, by which nothing needs to be multiplied.
fn constant<P: Point, S: BernsteinSpace>(p: P, inner: S) -> Result<Polynomial<P, S>, BernsteinError> {
    let space = inner.power(0);
    Ok(Polynomial { points: vec![p; space.size()?], space })
}

/// `1, x, …, xⁿ`.
fn powers<S: BernsteinSpace>(
    x: &[f64],
    n: usize,
    inner: S,
) -> Result<Vec<Polynomial<f64, S>>, BernsteinError> {
    check_buffer("arguments", x.len(), inner.size()?)?;
    let x = Polynomial { points: x.to_vec(), space: inner };
    let mut list = vec![constant(1.0, inner)?];
    for k in 1..=n {
        list.push(multiply(&x, &list[k - 1])?);
    }
    Ok(list)
}

/// `C(n,i) sⁿ⁻ⁱ tⁱ`, i = 0…n.
fn composed_basis<S: BernsteinSpace>(
    n: usize,
    s: Vec<Polynomial<f64, S>>,
    t: Vec<Polynomial<f64, S>>,
    inner: S,
) -> Result<Vec<Polynomial<f64, S>>, BernsteinError> {
    let mut list = Vec::with_capacity(n + 1);
    for (i, (s, t)) in s.iter().rev().zip(&t).enumerate() {
        let mut term = None;
        add_product(&mut term, s, t, binomial(n, i))?;
        list.push(match term {
            Some(term) => term,
            None => constant(0.0, inner)?,
        });
    }
    Ok(list)
}

/// `Σ Bᵢ∘q Pᵢ` along all the axes, the last one first.
fn contract<P: Point, S: BernsteinSpace>(
    outer: &[P],
    axes: &[Vec<Polynomial<f64, S>>],
    inner: S,
) -> Result<Polynomial<P, S>, BernsteinError> {
    let Some((basis, rest)) = axes.split_first() else {
        return constant(outer.first().copied().unwrap_or(P::ZERO), inner);
    };
    if rest.is_empty() {
        return combine(outer, basis, inner);
    }
    let mut sum = None;
    for (b, slab) in basis.iter().zip(outer.chunks_exact(outer.len() / basis.len())) {
        add_product(&mut sum, b, &contract(slab, rest, inner)?, 1.0)?;
    }
    sum.map_or_else(|| constant(P::ZERO, inner), Ok)
}

/// `Σ bᵢ Pᵢ`, for points that do not depend on anything.
fn combine<P: Point, S: BernsteinSpace>(
    outer: &[P],
    basis: &[Polynomial<f64, S>],
    inner: S,
) -> Result<Polynomial<P, S>, BernsteinError> {
    let Some(first) = basis.first() else { return constant(P::ZERO, inner) };
    let mut points = vec![P::ZERO; first.points.len()];
    for (b, &p) in basis.iter().zip(outer) {
        for (sum, &b) in points.iter_mut().zip(&b.points) {
            *sum = *sum + p * b;
        }
    }
    Ok(Polynomial { points, space: first.space })
}

/// The number of multi-indices of a simplex, `C(n + dimension, dimension)`.
fn simplex_size(degree: usize, dimension: usize) -> usize {
    (1..=dimension).fold(1, |size: usize, k| size.saturating_mul(degree.saturating_add(k)) / k)
}

/// `Σ n!/α! λ^α P_α`: the points with α₀ = i are a net of the degree n − i in the other coordinates. Each P_α is
/// a polynomial itself, which `leaf` makes of `width` points.
fn contract_simplex<P: Point, S: BernsteinSpace>(
    outer: &[P],
    degree: usize,
    powers: &[Vec<Polynomial<f64, S>>],
    width: usize,
    leaf: &impl Fn(&[P]) -> Result<Polynomial<P, S>, BernsteinError>,
) -> Result<Polynomial<P, S>, BernsteinError> {
    let Some((first, rest)) = powers.split_first() else { return leaf(outer) };
    if rest.is_empty() {
        return multiply(&first[degree], &leaf(outer)?);
    }
    let (mut sum, mut left) = (None, outer);
    for (i, power) in first.iter().enumerate().take(degree + 1).rev() {
        let (face, later) = left.split_at(simplex_size(degree - i, rest.len() - 1) * width);
        left = later;
        let form = contract_simplex(face, degree - i, rest, width, leaf)?;
        add_product(&mut sum, power, &form, binomial(degree, i))?;
    }
    sum.ok_or(BernsteinError::NoPoints)
}
