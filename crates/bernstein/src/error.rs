//! What can be wrong with the buffers given to a kernel.

use thiserror::Error;

/// Why a kernel refused its arguments.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
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

    /// A net over a simplex has another number of control points than its degree says.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, TriangleNet};
    /// let refused = TriangleNet::new(&[0.0, 1.0], 1).err();
    /// assert_eq!(refused, Some(BernsteinError::SimplexNetLength { vertices: 3, degree: 1, needed: 3, given: 2 }));
    /// ```
    #[error("a net of degree {degree} over {vertices} vertices has {needed} control points, not {given}")]
    SimplexNetLength {
        /// The number of vertices: 3 for a triangle, 4 for a tetrahedron.
        vertices: usize,
        /// The degree asked for.
        degree: usize,
        /// The number of control points that it asks for.
        needed: usize,
        /// The number of control points given.
        given: usize,
    },

    /// A net over a wedge has another number of control points than its degrees say.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, WedgeNet};
    /// let refused = WedgeNet::new(&[0.0, 1.0], [1, 1]).err();
    /// assert_eq!(refused, Some(BernsteinError::WedgeNetLength { degrees: [1, 1], needed: 6, given: 2 }));
    /// ```
    #[error("a wedge of degrees {} × {} has {needed} control points, not {given}", .degrees[0], .degrees[1])]
    WedgeNetLength {
        /// The degrees of the triangle and of the height.
        degrees: [usize; 2],
        /// The number of control points that they ask for.
        needed: usize,
        /// The number of control points given.
        given: usize,
    },

    /// A net in three variables has another number of control points than its degrees say.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, BoxNet};
    /// let refused = BoxNet::new(&[0.0, 1.0, 2.0], [1, 1, 0]);
    /// assert_eq!(refused.err(), Some(BernsteinError::BoxNetLength { degrees: [1, 1, 0], given: 3 }));
    /// ```
    #[error(
        "a net of degrees {} × {} × {} does not have {given} control points",
        .degrees[0], .degrees[1], .degrees[2]
    )]
    BoxNetLength {
        /// The degrees asked for.
        degrees: [usize; 3],
        /// The number of control points given.
        given: usize,
    },

    /// A net does not have so many axes.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, elevate_along};
    /// let refused = elevate_along(&[0.0, 1.0], [1, 0], 2, 3, &mut [0.0; 4]);
    /// assert_eq!(refused, Err(BernsteinError::Axis { axis: 2, dimension: 2 }));
    /// ```
    #[error("axis {axis} of a net with {dimension} axes, counted from 0")]
    Axis {
        /// The axis asked for.
        axis: usize,
        /// The number of axes.
        dimension: usize,
    },

    /// Elevation cannot lower a degree.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, elevate_tensor};
    /// let refused = elevate_tensor(&[0.0; 4], [1, 1], [2, 0], &mut [0.0; 3]);
    /// assert_eq!(refused, Err(BernsteinError::ElevatedDegree { from: 1, to: 0 }));
    /// ```
    #[error("elevation from degree {from} to {to}, which is lower")]
    ElevatedDegree {
        /// The degree of the net.
        from: usize,
        /// The degree asked for.
        to: usize,
    },

    /// Reduction cannot raise a degree.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, reduce};
    /// let refused = reduce(&[0.0, 1.0], &mut [0.0; 3], &mut [0.0; 2]);
    /// assert_eq!(refused, Err(BernsteinError::ReducedDegree { from: 1, to: 2 }));
    /// ```
    #[error("reduction from degree {from} to {to}, which is higher")]
    ReducedDegree {
        /// The degree of the net.
        from: usize,
        /// The degree asked for.
        to: usize,
    },

    /// An interval of length zero, where none is allowed.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, to_power};
    /// let refused = to_power(&[0.0, 1.0], [2.0, 2.0], &mut [0.0; 2]);
    /// assert_eq!(refused, Err(BernsteinError::EmptyInterval { start: 2.0 }));
    /// ```
    #[error("the interval begins and ends at {start}")]
    EmptyInterval {
        /// Both ends.
        start: f64,
    },

    /// A tolerance that is not positive.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, roots};
    /// assert_eq!(roots(&[-1.0, 1.0], 0.0), Err(BernsteinError::Tolerance { tolerance: 0.0 }));
    /// ```
    #[error("the tolerance {tolerance} is not positive")]
    Tolerance {
        /// The tolerance given.
        tolerance: f64,
    },

    /// A coefficient is not finite.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, roots};
    /// let refused = roots(&[-1.0, f64::INFINITY], 1e-9);
    /// assert_eq!(refused, Err(BernsteinError::Coefficient { place: 1, value: f64::INFINITY }));
    /// ```
    #[error("coefficient {place} is {value}")]
    Coefficient {
        /// Its place, counted from 0.
        place: usize,
        /// Its value.
        value: f64,
    },

    /// The polynomial is zero everywhere: every parameter is a root.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, roots};
    /// assert_eq!(roots(&[0.0, 0.0], 1e-9), Err(BernsteinError::ZeroPolynomial));
    /// ```
    #[error("the polynomial is zero everywhere")]
    ZeroPolynomial,

    /// A simplex does not have such a vertex, or it was named twice.
    ///
    /// ```
    /// use casteljau_bernstein::{BernsteinError, TriangleNet};
    /// let net = TriangleNet::new(&[0.0, 1.0, 2.0], 1)?;
    /// let refused = net.split_edge([0, 3], 0.5, &mut [0.0; 3], &mut [0.0; 3]);
    /// assert_eq!(refused, Err(BernsteinError::Vertices { vertex: 3, vertices: 3 }));
    /// # Ok::<(), BernsteinError>(())
    /// ```
    #[error("vertex {vertex} named twice, or not one of {vertices} vertices, counted from 0")]
    Vertices {
        /// The vertex asked for.
        vertex: usize,
        /// The number of vertices that there are.
        vertices: usize,
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
}

/// Refuses a buffer that is shorter than needed.
pub(crate) fn least_length(buffer: &'static str, needed: usize, given: usize) -> Result<(), BernsteinError> {
    if given >= needed { Ok(()) } else { Err(BernsteinError::BufferLength { buffer, needed, given }) }
}
