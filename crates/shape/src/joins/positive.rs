//! Whether a ratio that varies along an edge is positive all along.

use casteljau_bernstein::{RootKind, roots, value};

use crate::ShapeError;

/// Roots closer than this, in the parameter, are not told apart.
const APART: f64 = 1e-12;

/// Refuses a polynomial, given by its Bernstein coefficients, that is not positive on all of `[0, 1]`.
///
/// Coefficients that are all positive decide at once. Otherwise it is positive if and only if it is positive at 0 and
/// has no root: `roots` gives up a piece only where its coefficients have one sign by more than their rounding, n·u
/// times the largest for each halving. So no polynomial that vanishes is taken, and refused in error are only those
/// whose least value is 0 within that rounding.
///
/// # Errors
/// [`ShapeError::Ratio`] with a parameter and the value there, [`ShapeError::Construction`] for a coefficient that is
/// not finite, [`ShapeError::Kernel`] for a degree beyond the kernels' range.
pub(super) fn check_positive(coefficients: &[f64]) -> Result<(), ShapeError> {
    if let Some(&value) = coefficients.iter().find(|c| !c.is_finite()) {
        return Err(ShapeError::Construction { what: "coefficient along the edge", value });
    }
    if coefficients.iter().all(|&c| c > 0.0) {
        return Ok(());
    }
    let first = coefficients.first().copied().unwrap_or(0.0);
    if first <= 0.0 {
        return Err(ShapeError::Ratio { at: 0.0, value: first });
    }
    let found = roots(coefficients, APART)?;
    let Some(root) = found.first() else { return Ok(()) };
    let at = match root.kind {
        // Behind the first change of sign, up to the next root, it is negative.
        RootKind::Simple | RootKind::SignChange => {
            0.5 * (root.end + found.get(1).map_or(1.0, |next| next.start))
        }
        RootKind::Touch | RootKind::End(_) => root.middle(),
    };
    Err(ShapeError::Ratio { at, value: value(coefficients, at) })
}
