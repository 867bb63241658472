//! Wedges as domains of arguments in compositions.

use super::WedgeNet;
use crate::{BernsteinError, BernsteinSpace, MAX_DEGREE, Point};

/// The polynomials of degrees n (of the triangle) and o (of the height) over a wedge: the domain of arguments that
/// [`compose`](crate::compose) asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WedgeSpace(
    /// The degrees of the triangle and of the height.
    pub [usize; 2],
);

impl BernsteinSpace for WedgeSpace {
    fn size(self) -> Result<usize, BernsteinError> {
        match self.0.into_iter().find(|&degree| degree > MAX_DEGREE) {
            Some(degree) => Err(BernsteinError::Degree { degree, limit: MAX_DEGREE }),
            None => Ok(WedgeNet::<f64>::count(self.0)),
        }
    }

    fn power(self, k: usize) -> Self {
        Self(self.0.map(|degree| degree.saturating_mul(k)))
    }

    fn times(self, other: Self) -> Self {
        let ([n, o], [m, l]) = (self.0, other.0);
        Self([n.saturating_add(m), o.saturating_add(l)])
    }

    fn multiply<P: Point>(
        self,
        a: &[f64],
        other: Self,
        b: &[P],
        out: &mut [P],
    ) -> Result<(), BernsteinError> {
        WedgeNet::new(b, other.0)?.product(&WedgeNet::new(a, self.0)?, out)
    }
}
