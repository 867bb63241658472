//! One polynomial cut into two.

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
