//! What can be wrong with a polygon, a layout or a set of coordinates, with the numbers.

use thiserror::Error;

/// An error of this crate. Sides, corners and points are counted from 0; positions are in the units of the
/// input.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DomainError {
    /// A polygon, or an outline to lay out, of fewer than three sides.
    #[error("{count} sides given, a polygon has at least 3")]
    TooFewSides {
        /// How many were given.
        count: usize,
    },
    /// A polygon with more sides than harmonic coordinates are made for.
    #[error("{count} sides given, harmonic coordinates take at most {most}")]
    TooManySides {
        /// How many were given.
        count: usize,
        /// How many are accepted.
        most: usize,
    },
    /// A coordinate that is NaN or infinite.
    #[error("corner {corner} is at {position:?}, which is not finite")]
    NotFinite {
        /// The corner.
        corner: usize,
        /// Its coordinates; a plane point has the third one 0.
        position: [f64; 3],
    },
    /// Coordinates so large or a polygon so small that squares of lengths leave the range of f64.
    #[error(
        "the polygon has coordinates up to {largest:.3e} and size {size:.3e}; both must lie within [{least:.0e}, {most:.0e}]"
    )]
    OutOfRange {
        /// Largest absolute coordinate.
        largest: f64,
        /// Larger extent of the bounding box.
        size: f64,
        /// Least size that is accepted.
        least: f64,
        /// Largest coordinate that is accepted.
        most: f64,
    },
    /// A side that starts where it ends.
    #[error("side {side} has length zero: it starts and ends at {position:?}")]
    ZeroSide {
        /// The side.
        side: usize,
        /// Where it is; a plane point has the third coordinate 0.
        position: [f64; 3],
    },
    /// Two neighbouring sides that overlap, so that the interior angle between them is 0 or 2π.
    #[error("side {side} turns back onto itself at corner {corner}, {position:?}")]
    FoldBack {
        /// The side that ends in the corner.
        side: usize,
        /// The corner, the end of `side`.
        corner: usize,
        /// Where the corner is.
        position: [f64; 2],
    },
    /// Two sides that are no neighbours cross or touch.
    #[error("sides {first} and {second} meet at {position:?}")]
    SidesMeet {
        /// The side with the lower number.
        first: usize,
        /// The other one.
        second: usize,
        /// A point of both, to rounding.
        position: [f64; 2],
    },
    /// A side whose length is not a positive finite number.
    #[error("side {side} has length {length}, which is not a positive finite number")]
    BadLength {
        /// The side.
        side: usize,
        /// Its length.
        length: f64,
    },
    /// A turning angle outside [−π, π].
    #[error("the turning angle at corner {corner} is {angle}, which is not within [-pi, pi]")]
    BadAngle {
        /// The corner.
        corner: usize,
        /// Its turning angle in radians.
        angle: f64,
    },
    /// An option that is not in its range.
    #[error("option `{option}` is {value}, it must lie within [{least}, {most}]")]
    BadOption {
        /// Its name.
        option: &'static str,
        /// Its value.
        value: f64,
        /// Least accepted value.
        least: f64,
        /// Largest accepted value.
        most: f64,
    },
    /// Two lists that belong together differ in length.
    #[error("{given} {what} given, {wanted} wanted")]
    CountMismatch {
        /// What is counted.
        what: &'static str,
        /// How many there are.
        given: usize,
        /// How many there should be.
        wanted: usize,
    },
    /// Coordinates that are defined on convex polygons only were asked for on another one.
    #[error("corner {corner} has the interior angle {angle:.6} rad; these coordinates need a convex polygon")]
    NotConvex {
        /// A concave corner.
        corner: usize,
        /// Its interior angle in radians.
        angle: f64,
    },
    /// Wachspress coordinates were asked for on a polygon with a corner that is straight, or almost.
    #[error("corner {corner} turns by {turn:.3e} rad only (at least {least:.0e} wanted); leave it out")]
    StraightCorner {
        /// The corner.
        corner: usize,
        /// π less its interior angle, in radians.
        turn: f64,
        /// Least turn that is accepted.
        least: f64,
    },
    /// Derivatives of coordinates at a corner, where they do not exist.
    #[error("coordinates have no derivatives at corner {corner}, {position:?}")]
    DerivativeAtCorner {
        /// The corner.
        corner: usize,
        /// Where it is.
        position: [f64; 2],
    },
    /// Points of a boundary so close to each other that they cannot be triangulated.
    #[error("the boundary has features below {size:.3e}, which cannot be triangulated")]
    Unresolved {
        /// The size.
        size: f64,
    },
    /// A point outside the polygon.
    #[error("point {index}, {point:?}, lies outside the polygon")]
    OutsidePolygon {
        /// Which point of those given.
        index: usize,
        /// Where it is.
        point: [f64; 2],
    },
    /// Harmonic coordinates could not be had to the wanted accuracy.
    #[error(
        "harmonic coordinates were reached to {reached:.1e} only, wanted {limit:.1e}: the polygon is too thin, too folded, or has too short or too many sides"
    )]
    HarmonicAccuracy {
        /// The least certificate found.
        reached: f64,
        /// The largest certificate allowed.
        limit: f64,
    },
}
