use casteljau_domain::{CoordinateKind, Coordinates, HarmonicOptions, Polygon, layout};
use casteljau_geom::BoundingBox;
use casteljau_geom::glam::DVec3;

use crate::contact::{contacts, corner_point_order};
use crate::outline::lay_out;
use crate::ribbon::check_point;
use crate::{CenterWeight, ConcavePatch, CornerPoint, GbError, LayoutKind, MAX_BLEND_POWER, Place, Ribbon};

/// Default distance up to which the ends of neighbouring sides count as one corner, in units of the model's size (the
/// diagonal of the box of all ribbons' control points).
pub const CORNER_TOLERANCE: f64 = 1e-9;

/// Default bound on the error of the coordinates inside: see [`Coordinates::certificate`].
pub const DEFAULT_ACCURACY: f64 = 1e-8;

/// Bound on the error of the coordinates for exacting work; costs about three times the set-up.
pub const HIGH_ACCURACY: f64 = 1e-10;

/// Default blend power p.
pub const DEFAULT_BLEND_POWER: u32 = 2;

/// Collects what a [`ConcavePatch`] is made of; [`build`](ConcavePatchBuilder::build) checks it and sets it up.
///
/// ```
/// use casteljau_gb::{ConcavePatch, LayoutKind, Location, Ribbon, glam::DVec3};
/// // A flat square whose sides are straight cubics, with the layer inside a third further in.
/// let corners = [DVec3::X + DVec3::Y, DVec3::Y, DVec3::ZERO, DVec3::X];
/// let ribbon = |i: usize| {
///     let (a, b, inward) = (corners[(i + 3) % 4], corners[i], corners[(i + 1) % 4] - corners[i]);
///     let row = |k: f64| (0..4).map(move |j| a.lerp(b, j as f64 / 3.0) + inward * (k / 3.0));
///     Ribbon::new(3, 2, row(0.0).chain(row(1.0)).collect())
/// };
/// let ribbons = (0..4).map(ribbon).collect::<Result<Vec<_>, _>>()?;
/// let patch = ConcavePatch::builder(ribbons).layout(LayoutKind::Regular).build()?;
/// assert_eq!(patch.point_at(Location::Corner(2))?, DVec3::ZERO);
/// assert!((patch.point_at(Location::Side { side: 3, t: 0.25 })? - DVec3::X * 0.25).length() < 1e-15);
/// # Ok::<(), casteljau_gb::GbError>(())
/// ```
#[derive(Debug, Clone)]
#[must_use]
pub struct ConcavePatchBuilder {
    ribbons: Vec<Ribbon>,
    layout: LayoutKind,
    domain: Option<Polygon>,
    kind: CoordinateKind,
    accuracy: f64,
    prepared: Option<Coordinates>,
    blend_power: u32,
    center: Option<DVec3>,
    center_weight: CenterWeight,
    corner_points: Vec<CornerPoint>,
    corner_tolerance: f64,
}

impl ConcavePatchBuilder {
    pub(crate) fn new(ribbons: Vec<Ribbon>) -> Self {
        Self {
            ribbons,
            layout: LayoutKind::default(),
            domain: None,
            kind: CoordinateKind::Harmonic,
            accuracy: DEFAULT_ACCURACY,
            prepared: None,
            blend_power: DEFAULT_BLEND_POWER,
            center: None,
            center_weight: CenterWeight::default(),
            corner_points: Vec::new(),
            corner_tolerance: CORNER_TOLERANCE,
        }
    }

    /// How the domain polygon is made, [`LayoutKind::Projection`] by default.
    pub fn layout(mut self, layout: LayoutKind) -> Self {
        self.layout = layout;
        self
    }

    /// Gives the domain polygon; vertex i ends side i. It is kept as given, clockwise ones included.
    pub fn domain(mut self, polygon: Polygon) -> Self {
        self.domain = Some(polygon);
        self
    }

    /// Kind of the barycentric coordinates, harmonic by default. The other kinds have no options.
    pub fn coordinates(mut self, kind: CoordinateKind) -> Self {
        self.kind = kind;
        self
    }

    /// Bound wanted on the error of harmonic coordinates, [`DEFAULT_ACCURACY`] by default. What was reached is
    /// [`Coordinates::certificate`]; on difficult polygons it may be larger, up to the limit of [`HarmonicOptions`].
    pub fn accuracy(mut self, target: f64) -> Self {
        self.accuracy = target;
        self
    }

    /// Uses coordinates that are set up already, together with their polygon: patches over the same domain share the
    /// work. Layout, domain, kind and accuracy are then not looked at.
    pub fn prepared_coordinates(mut self, coordinates: Coordinates) -> Self {
        self.prepared = Some(coordinates);
        self
    }

    /// The power p of the blends, 1 to [`MAX_BLEND_POWER`], [`DEFAULT_BLEND_POWER`] by default.
    pub fn blend_power(mut self, power: u32) -> Self {
        self.blend_power = power;
        self
    }

    /// The central control point; without a [`center_weight`](Self::center_weight) it is kept and unused.
    pub fn center(mut self, point: DVec3) -> Self {
        self.center = Some(point);
        self
    }

    /// The weight of the central control point, [`CenterWeight::None`] by default.
    pub fn center_weight(mut self, weight: CenterWeight) -> Self {
        self.center_weight = weight;
        self
    }

    /// Adds a control point at a corner, between side `corner` and the next.
    pub fn corner_point(mut self, corner: usize, point: DVec3) -> Self {
        self.corner_points.push(CornerPoint { corner, point });
        self
    }

    /// Distance up to which the ends of neighbouring sides count as one corner, in units of the model's size;
    /// [`CORNER_TOLERANCE`] by default. Ends that meet only so are both moved to the middle between them, so that a
    /// corner is one point; sides that meet exactly stay as they are to the last bit.
    pub fn corner_tolerance(mut self, relative: f64) -> Self {
        self.corner_tolerance = relative;
        self
    }

    /// Checks everything, makes the domain polygon and sets its coordinates up.
    ///
    /// # Errors
    /// Fewer than three sides; sides that do not meet, have no length, or corners that coincide; a blend power, centre
    /// or corner point out of range; a weight that would stay on a side; a polygon of the wrong size; whatever the
    /// layout and the coordinates refuse.
    ///
    /// Cost: that of the coordinates, some 10 ms for harmonic ones.
    pub fn build(self) -> Result<ConcavePatch, GbError> {
        let mut ribbons = self.ribbons;
        let n = ribbons.len();
        if n < 3 {
            return Err(GbError::TooFewSides { count: n });
        }
        join_corners(&mut ribbons, self.corner_tolerance)?;
        if !(1..=MAX_BLEND_POWER).contains(&self.blend_power) {
            return Err(GbError::BlendPower { power: self.blend_power });
        }
        check_center(n, self.center, self.center_weight)?;
        let mut corner_points = self.corner_points;
        corner_points.sort_by_key(|c| c.corner);
        check_corner_points(&ribbons, self.blend_power, &corner_points)?;

        let (layout, repaired, coordinates) = match (self.prepared, self.domain) {
            (Some(coordinates), _) => (LayoutKind::Given, false, coordinates),
            (None, Some(polygon)) => {
                check_size(&polygon, n)?;
                (LayoutKind::Given, false, set_up(self.kind, polygon, self.accuracy)?)
            }
            (None, None) => {
                let (kind, polygon, repaired) = match self.layout {
                    LayoutKind::Given => (LayoutKind::Projection, None, false),
                    LayoutKind::Regular => (LayoutKind::Regular, Some(layout::regular(n)?), false),
                    kind => (kind, None, false),
                };
                let (polygon, repaired) = match polygon {
                    Some(polygon) => (polygon, repaired),
                    None => {
                        let made = lay_out(&ribbons, kind)?;
                        (made.polygon, made.repaired)
                    }
                };
                (kind, repaired, set_up(self.kind, polygon, self.accuracy)?)
            }
        };
        check_size(coordinates.polygon(), n)?;
        let contacts = contacts(&ribbons, self.blend_power, self.center_weight);
        Ok(ConcavePatch {
            ribbons,
            coordinates,
            layout,
            layout_repaired: repaired,
            blend_power: self.blend_power,
            center: self.center,
            center_weight: self.center_weight,
            corner_points,
            contacts,
        })
    }
}

fn set_up(kind: CoordinateKind, polygon: Polygon, accuracy: f64) -> Result<Coordinates, GbError> {
    Ok(match kind {
        CoordinateKind::Wachspress => Coordinates::wachspress(polygon)?,
        CoordinateKind::MeanValue => Coordinates::mean_value(polygon)?,
        _ => {
            let default = HarmonicOptions::default();
            let limit = default.limit.max(accuracy);
            Coordinates::harmonic(polygon, &HarmonicOptions { target: accuracy, limit })?
        }
    })
}

fn check_size(polygon: &Polygon, sides: usize) -> Result<(), GbError> {
    let vertices = polygon.len();
    if vertices == sides { Ok(()) } else { Err(GbError::DomainSize { vertices, sides }) }
}

/// Checks that the sides form a loop, and makes ends that meet within the tolerance meet exactly.
fn join_corners(ribbons: &mut [Ribbon], tolerance: f64) -> Result<(), GbError> {
    if !(0.0..=1.0).contains(&tolerance) {
        return Err(GbError::Tolerance { value: tolerance });
    }
    let n = ribbons.len();
    let points = ribbons.iter().flat_map(|r| r.control_points().iter().copied());
    let size = BoundingBox::from_points(points).map_or(0.0, |b| b.diagonal());
    let allowed = tolerance * size;
    if let Some(side) = ribbons.iter().position(Ribbon::collapsed) {
        return Err(GbError::ZeroLengthSide { side, at: ribbons[side].start() });
    }
    for side in 0..n {
        let next = (side + 1) % n;
        let (end, start) = (ribbons[side].end(), ribbons[next].start());
        let gap = end.distance(start);
        if gap > allowed {
            return Err(GbError::CornerGap { side, next, gap, allowed });
        }
        if end != start {
            let middle = end.midpoint(start);
            let degree = ribbons[side].degree();
            ribbons[side].set_point(degree, 0, middle)?;
            ribbons[next].set_point(0, 0, middle)?;
        }
    }
    distinct_corners(ribbons, allowed)
}

/// Refuses corners that are no further apart than `allowed`. Sorted by x, so that few pairs are looked at.
fn distinct_corners(ribbons: &[Ribbon], allowed: f64) -> Result<(), GbError> {
    let mut corners: Vec<(usize, DVec3)> = ribbons.iter().map(Ribbon::end).enumerate().collect();
    corners.sort_by(|a, b| a.1.x.total_cmp(&b.1.x));
    let mut equal: Option<(usize, usize, f64)> = None;
    for (place, &(i, a)) in corners.iter().enumerate() {
        for &(j, b) in corners[place + 1..].iter().take_while(|(_, b)| b.x - a.x <= allowed) {
            let distance = a.distance(b);
            let pair = (i.min(j), i.max(j), distance);
            if distance <= allowed && equal.is_none_or(|e| (pair.0, pair.1) < (e.0, e.1)) {
                equal = Some(pair);
            }
        }
        if equal.is_some() {
            break;
        }
    }
    match equal {
        None => Ok(()),
        Some((first, second, distance)) => Err(GbError::EqualCorners { first, second, distance, allowed }),
    }
}

fn check_center(sides: usize, center: Option<DVec3>, weight: CenterWeight) -> Result<(), GbError> {
    match center {
        Some(point) => check_point(Place::Center, point)?,
        None if weight != CenterWeight::None => return Err(GbError::MissingCenter { weight }),
        None => {}
    }
    // In a triangle the two other sides are both neighbours and their product of h²(1−h)² stays on the third.
    if weight == CenterWeight::Nth && sides == 3 {
        return Err(GbError::CenterWeightOnBoundary { weight, sides });
    }
    Ok(())
}

fn check_corner_points(ribbons: &[Ribbon], power: u32, points: &[CornerPoint]) -> Result<(), GbError> {
    let sides = ribbons.len();
    for (index, extra) in points.iter().enumerate() {
        let corner = extra.corner;
        if corner >= sides {
            return Err(GbError::NoSuchCorner { corner, sides });
        }
        if index > 0 && points[index - 1].corner == corner {
            return Err(GbError::RepeatedCornerPoint { corner });
        }
        check_point(Place::CornerPoint { corner }, extra.point)?;
        let stays = |&side: &usize| corner_point_order(ribbons, power as usize, extra, side) == 0;
        if let Some(side) = (0..sides).find(stays) {
            let reason = if sides == 3 { "a triangle" } else { "a side at the corner has one layer" };
            return Err(GbError::CornerPointOnBoundary { corner, side, reason });
        }
    }
    Ok(())
}
