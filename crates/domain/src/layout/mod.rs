//! Layout: a domain polygon for a loop of sides in space.
//!
//! Three rules: [`regular`] polygons, [`projection`] on the best plane of the corners, and the [`heuristic`]
//! drawn from arc lengths and turning angles. The last two promise, for every loop of sides of non-zero
//! length, a polygon that
//!
//! * is simple and counter-clockwise, its vertices' mean at the origin, the farthest vertex at distance 1;
//! * has [`Polygon::clearance`] at least [`required_clearance`] times its diameter: sides that are no
//!   neighbours are apart, no side is shorter than that and no angle is sharper than that allows;
//! * is concave exactly at the corners of [`Layout::concave`]: interior angles there are at least π +
//!   [`STRAIGHT`], elsewhere at most π + [`STRAIGHT`].
//!
//! Where the plain rule does not give such a polygon the *repair* does: a finite list of candidates, each
//! tested with the rules above, leading from the shape that was asked for to a star that passes for every
//! pattern of convex and concave corners (`repair.rs` has the list, `star.rs` the proof). So every layout
//! ends.
//!
//! The polygon depends on the loop only: a rigid motion, a change of scale or a renumbering of the sides
//! changes it by rounding and a rotation. No rule looks at side 0, except that it is drawn along +u before
//! the gap is closed. (The plain rule of the heuristic seems to: it moves vertex i by its share, counted from
//! side 0, of the closing gap g. But that adds −g·ℓⱼ/Σℓ to side j, the scaled turning angles sum to 2π, and
//! so the outline is the same wherever it starts.) Like any choice between rules the decision to repair is a
//! jump: loops that are within rounding of a bound may fall on either side of it. Straight corners, which
//! models are full of, are kept off the bounds by [`STRAIGHT`].

mod heuristic;
mod projection;
mod repair;
mod star;

use std::f64::consts::{PI, TAU};

use casteljau_geom::glam::{DVec2, dvec2};

use crate::{DomainError, Orientation, Polygon};

pub use heuristic::heuristic;
pub use projection::{DISTINCT, projection};

/// Angle in radians up to which a corner counts as straight, and with that as convex.
pub const STRAIGHT: f64 = 1e-8;

/// What [`required_clearance`] guarantees for polygons of n sides, times n, whatever is asked for.
pub const GUARANTEED_CLEARANCE: f64 = 0.35;

/// How a layout is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayoutOptions {
    /// Wanted distance between sides that are no neighbours, in units of the polygon's diameter, within [0,
    /// 1].
    ///
    /// A wish: what counts is [`required_clearance`]. Default 0.02.
    pub clearance: f64,
}

impl Default for LayoutOptions {
    fn default() -> Self {
        Self { clearance: 0.02 }
    }
}

impl LayoutOptions {
    fn check(&self) -> Result<(), DomainError> {
        let (option, value, least, most) = ("clearance", self.clearance, 0.0, 1.0);
        if (least..=most).contains(&value) {
            Ok(())
        } else {
            Err(DomainError::BadOption { option, value, least, most })
        }
    }
}

/// The clearance, in units of the diameter, that a layout of `sides` sides has: min(wanted,
/// [`GUARANTEED_CLEARANCE`]/n).
pub fn required_clearance(sides: usize, options: &LayoutOptions) -> f64 {
    options.clearance.min(GUARANTEED_CLEARANCE / sides.max(3) as f64)
}

/// A polygon that was laid out, and how.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Layout {
    /// The polygon; vertex i ends side i.
    pub polygon: Polygon,
    /// Which corners are concave.
    ///
    /// As the input says, except that a loop with fewer than three convex corners, which no polygon in the
    /// plane has, gets its least concave ones made convex (all of equal turning angle, so that no numbering
    /// is preferred).
    pub concave: Vec<bool>,
    /// Clearance of the polygon in units of its diameter.
    pub clearance: f64,
    /// Whether the plain rule failed, so that the polygon comes from the repair.
    pub repaired: bool,
    /// How far the repair went, from 0, angles and lengths as wanted, to 1, the star that depends on the
    /// pattern of convex and concave corners only. 0 where nothing was repaired.
    pub blend: f64,
}

/// Regular polygon of n vertices, vertex i at (cos 2πi/n, sin 2πi/n); for n = 4 the square (1,1), (−1,1),
/// (−1,−1), (1,−1).
///
/// Coordinates are within 3u of these. Error: fewer than three vertices.
///
/// ```
/// use casteljau_domain::layout;
/// assert_eq!(layout::regular(6)?.vertices()[3].x, -1.0);
/// assert!(layout::regular(2).is_err());
/// # Ok::<(), casteljau_domain::DomainError>(())
/// ```
pub fn regular(n: usize) -> Result<Polygon, DomainError> {
    let vertices = match n {
        4 => vec![dvec2(1.0, 1.0), dvec2(-1.0, 1.0), dvec2(-1.0, -1.0), dvec2(1.0, -1.0)],
        _ => (0..n).map(|i| DVec2::from_angle(TAU * i as f64 / n as f64)).collect(),
    };
    Polygon::new(vertices)
}

/// The outline moved to the mean of its vertices and scaled to radius 1; not finite when it is a point.
fn normalised(vertices: &[DVec2]) -> Vec<DVec2> {
    // The mean is taken about a vertex, so that the distance to the origin costs no digits.
    let mean = vertices[0] + vertices.iter().map(|p| *p - vertices[0]).sum::<DVec2>() / vertices.len() as f64;
    let radius = vertices.iter().map(|p| p.distance(mean)).fold(0.0, f64::max);
    vertices.iter().map(|p| (*p - mean) / radius).collect()
}

/// The normalised outline as a layout, if it keeps the promises of this module.
fn accept(vertices: &[DVec2], concave: &[bool], required: f64) -> Option<Layout> {
    let polygon = Polygon::new(normalised(vertices)).ok()?;
    if polygon.orientation() != Orientation::CounterClockwise {
        return None;
    }
    let kept = |(i, &concave): (usize, &bool)| concave == (polygon.interior_angle(i) >= PI + STRAIGHT);
    if !concave.iter().enumerate().all(kept) {
        return None;
    }
    let clearance = polygon.clearance() / polygon.diameter();
    let layout = Layout { polygon, concave: concave.to_vec(), clearance, repaired: false, blend: 0.0 };
    (clearance >= required).then_some(layout)
}
