//! One polynomial cut into two.

use crate::line::{check_axis, check_length, strides};
use crate::{BernsteinError, Point, interval::step};

/// Subdivision at `t`: `left` holds p over `[0, t]`, `right` holds p over `[t, 1]`, both of degree n on their
/// own `[0, 1]`.
///
/// The two share the point `p(t)` to the bit; the outer ends are the given ones to the bit. `t` may lie
/// outside `[0, 1]`. Error of each point: at most `4(n+2)·u` times its combination of absolute values. Cost:
/// n(n+1)/2 affine combinations.
///
/// # Errors
/// [`BernsteinError::BufferLength`] where `left` or `right` has another length than `points`.
///
/// Source: Farin, *Curves and Surfaces for CAGD*, 5th ed., sec. 5.4.
pub fn subdivide<P: Point>(
    points: &[P],
    t: f64,
    left: &mut [P],
    right: &mut [P],
) -> Result<(), BernsteinError> {
    let needed = points.len();
    for (buffer, given) in [("left", left.len()), ("right", right.len())] {
        if given != needed {
            return Err(BernsteinError::BufferLength { buffer, needed, given });
        }
    }
    right.copy_from_slice(points);
    for (done, p) in left.iter_mut().enumerate() {
        *p = right[0];
        step(t, &mut right[..needed - done]);
    }
    Ok(())
}

/// Subdivision of a net along one axis at `t`: [`subdivide`] on all of its lines, whole layers at a time.
///
/// ```
/// use casteljau_bernstein::subdivide_along;
/// let (mut left, mut right) = ([0.0; 4], [0.0; 4]);
/// subdivide_along(&[0.0, 1.0, 2.0, 4.0], [1, 1], 0, 0.5, &mut left, &mut right)?;
/// assert_eq!((left, right), ([0.0, 1.0, 1.0, 2.5], [1.0, 2.5, 2.0, 4.0]));
/// # Ok::<(), casteljau_bernstein::BernsteinError>(())
/// ```
///
/// # Errors
/// [`BernsteinError::Axis`], [`BernsteinError::Degree`], [`BernsteinError::BufferLength`].
pub fn subdivide_along<P: Point, const D: usize>(
    points: &[P],
    degrees: [usize; D],
    axis: usize,
    t: f64,
    left: &mut [P],
    right: &mut [P],
) -> Result<(), BernsteinError> {
    check_axis(points, degrees, axis)?;
    check_length("left", left.len(), points.len())?;
    check_length("right", right.len(), points.len())?;
    right.copy_from_slice(points);
    let counts = crate::line::counts(degrees);
    let layer = strides(counts)[axis];
    let slab = layer * counts[axis];
    let s = 1.0 - t;
    for (left, right) in left.chunks_exact_mut(slab).zip(right.chunks_exact_mut(slab)) {
        for done in 0..counts[axis] {
            left[done * layer..][..layer].copy_from_slice(&right[..layer]);
            for i in 0..layer * (degrees[axis] - done) {
                right[i] = right[i] * s + right[i + layer] * t;
            }
        }
    }
    Ok(())
}
