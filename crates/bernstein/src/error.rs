//! What can be wrong with the buffers given to a kernel.

use thiserror::Error;

/// Why a kernel refused its arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum BernsteinError {
    /// There is no control point at all.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, elevate};
    /// assert_eq!(elevate::<f64>(&[], &mut [0.0]), Err(BernsteinError::NoPoints));
    /// ```
    #[error("no control points")]
    NoPoints,

    /// A buffer does not have the length that the degree asks for.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, elevate};
    /// let refused = elevate(&[0.0, 1.0], &mut [0.0]);
    /// assert_eq!(refused, Err(BernsteinError::BufferLength { buffer: "out", needed: 2, given: 1 }));
    /// ```
    #[error("buffer `{buffer}` holds {given} points, {needed} are needed")]
    BufferLength {
        /// The argument's name.
        buffer: &'static str,
        /// Its length as it should be (the least one, where longer ones are allowed).
        needed: usize,
        /// Its length as it is.
        given: usize,
    },

    /// A net has another number of control points than its degrees say.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, TensorNet};
    /// let refused = TensorNet::new(&[0.0, 1.0, 2.0], [1, 1]);
    /// assert_eq!(refused.err(), Some(BernsteinError::NetLength { degrees: [1, 1], given: 3 }));
    /// ```
    #[error("a net of degrees {} × {} does not have {given} control points", .degrees[0], .degrees[1])]
    NetLength {
        /// The degrees asked for.
        degrees: [usize; 2],
        /// The number of control points given.
        given: usize,
    },

    /// A degree is above [`MAX_DEGREE`](crate::MAX_DEGREE).
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, elevate};
    /// let refused = elevate(&[0.0, 1.0], &mut [0.0; 700]);
    /// assert_eq!(refused, Err(BernsteinError::Degree { degree: 699, limit: 500 }));
    /// ```
    #[error("degree {degree} is above the limit of {limit}")]
    Degree {
        /// The degree asked for.
        degree: usize,
        /// The largest one served.
        limit: usize,
    },

    /// Derivatives of a higher order than a batch is made for.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, GridBatch};
    /// let refused = GridBatch::new([3, 3], &[0.5], &[0.5], 3);
    /// assert_eq!(refused.err(), Some(BernsteinError::Order { order: 3, limit: 2 }));
    /// ```
    #[error("derivatives of order {order} are asked for, {limit} is the highest order here")]
    Order {
        /// The order asked for.
        order: usize,
        /// The highest one there is.
        limit: usize,
    },

    /// The denominator of a rational shape vanishes within its rounding error, or the quotient is out of range.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, CurveBatch, glam::{DVec3, DVec4}};
    /// let curve = CurveBatch::new(&[DVec4::W, DVec4::new(1.0, 0.0, 0.0, -1.0)])?; // w = 1 − 2t
    /// let mut points = [DVec3::ZERO; 3];
    /// let refused = curve.evaluate_rational(&[0.0, 0.5, 1.0], [&mut points]);
    /// assert_eq!(refused, Err(BernsteinError::Pole { index: 1 }));
    /// assert_eq!(points, [DVec3::ZERO, DVec3::ZERO, -DVec3::X]);
    /// # Ok::<(), BernsteinError>(())
    /// ```
    #[error("the denominator vanishes at parameter number {index}")]
    Pole {
        /// The first parameter's place, counted from 0.
        index: usize,
    },
}
