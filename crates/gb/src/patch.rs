use casteljau_domain::{CoordinateKind, Coordinates, Location, Orientation, Polygon};
use casteljau_geom::glam::{DVec2, DVec3};
use casteljau_geom::{BoundingBox, SurfaceJet};
use casteljau_shape::Curve;

use crate::builder::ConcavePatchBuilder;
use crate::contact::Contact;
use crate::formula::{self, Net};
use crate::jet::Second;
use crate::ribbon::check_point;
use crate::samples::{check_length, checked};
use crate::{CORNER_TOLERANCE, GbError, Place, Ribbon};

/// Where the weight of the central control point comes from; n is the number of sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum CenterWeight {
    /// No weight: the centre is kept and unused.
    #[default]
    None,
    /// What all other weights leave of 1, so that no division is needed.
    Deficiency,
    /// `n Σ h_i²(1−h_i)² h_{i+1}²(1−h_{i+1})²`; vanishes like h² on the sides. Four sides at least.
    Nth,
    /// `(2/9)(1−2/n)^(−2n) Π h_i²`; vanishes like h² on the sides.
    Harmonic,
}

impl std::fmt::Display for CenterWeight {
    /// The word for it in model files.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::None => "none",
            Self::Deficiency => "deficiency",
            Self::Nth => "nth",
            Self::Harmonic => "harmonic",
        })
    }
}

/// How the domain polygon was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum LayoutKind {
    /// The corners projected on their best plane.
    #[default]
    Projection,
    /// Drawn from the sides' lengths and the angles at the corners.
    Heuristic,
    /// Vertex i at (cos 2πi/n, sin 2πi/n); for n = 4 the square (1,1), (−1,1), (−1,−1), (1,−1).
    Regular,
    /// Given by the caller, and kept as given, clockwise ones included.
    Given,
}

/// An extra control point at a (usually concave) corner, of weight
/// `4.5 β(1−β) B_1^{2l−1}(h_i) B_1^{2m−1}(h_{i+1})`, l and m being the layers of the two sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CornerPoint {
    /// The corner, between side `corner` and the next.
    pub corner: usize,
    /// The control point.
    pub point: DVec3,
}

/// Concave Generalized Bézier patch: an n-sided surface that follows one [`Ribbon`] along each side.
///
/// `S = (Σ_i Σ_jk μ^i_j B_j(s_i) B_k(h_i) C^i_jk + B_0 C_0 + Σ B_c C_c) / (the same sum of the weights)`, where
/// `s_i = λ_i/(λ_{i−1}+λ_i)`, `h_i = 1−λ_{i−1}−λ_i`, λ are the generalized barycentric coordinates of (u, v) in the domain
/// polygon, `B_j` has the ribbon's degree d, `B_k` degree 2l−1, and μ is α_i for 2j < d, 1 for 2j = d, β_i for 2j > d with
/// `α_i = h_{i−1}^p/(h_{i−1}^p+h_i^p)`, `β_i = h_{i+1}^p/(h_{i+1}^p+h_i^p)`. Side i runs from domain vertex i−1 to vertex i.
///
/// On a side and at a corner λ is known exactly and the patch is the ribbon's curve to rounding. Inside, an error of λ up
/// to the coordinates' certificate moves the surface by at most 4·max(d, 2l−1)·certificate·size; sides of one layer, which
/// fade only linearly, may add 2·certificate·size each, which matters from some twelve sides on. The formula has no
/// threshold. Which continuity with the ribbons it keeps is answered by [`ConcavePatch::continuity`].
///
/// Cost: that of λ, plus about 0.1 µs a point for a cubic six-sided patch of two layers.
///
/// Source: Salvi, Várady, *Multi-sided Bézier surfaces over concave polygonal domains*, Computers & Graphics 74 (2018).
#[derive(Debug, Clone)]
pub struct ConcavePatch {
    pub(crate) ribbons: Vec<Ribbon>,
    pub(crate) coordinates: Coordinates,
    pub(crate) layout: LayoutKind,
    pub(crate) layout_repaired: bool,
    pub(crate) blend_power: u32,
    pub(crate) center: Option<DVec3>,
    pub(crate) center_weight: CenterWeight,
    pub(crate) corner_points: Vec<CornerPoint>,
    pub(crate) contacts: Vec<Contact>,
}

impl ConcavePatch {
    /// Starts a patch from its ribbons, in order around it, each beginning where the one before ends.
    pub fn builder(ribbons: Vec<Ribbon>) -> ConcavePatchBuilder {
        ConcavePatchBuilder::new(ribbons)
    }

    /// The ribbons, with ends that meet exactly.
    pub fn ribbons(&self) -> &[Ribbon] {
        &self.ribbons
    }

    /// Number of sides, n.
    pub fn sides(&self) -> usize {
        self.ribbons.len()
    }

    /// The barycentric coordinates, with their certificate.
    pub fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }

    /// The domain polygon.
    pub fn domain(&self) -> &Polygon {
        self.coordinates.polygon()
    }

    /// How the domain polygon was made.
    pub fn layout(&self) -> LayoutKind {
        self.layout
    }

    /// Whether the plain layout rule failed and its repair made the polygon.
    pub fn layout_repaired(&self) -> bool {
        self.layout_repaired
    }

    /// The power p of the blends α and β.
    pub fn blend_power(&self) -> u32 {
        self.blend_power
    }

    /// The central control point, if one was given.
    pub fn center(&self) -> Option<DVec3> {
        self.center
    }

    /// The weight of the central control point.
    pub fn center_weight(&self) -> CenterWeight {
        self.center_weight
    }

    /// The extra control points, in ascending order of the corners.
    pub fn corner_points(&self) -> &[CornerPoint] {
        &self.corner_points
    }

    /// Side `side` as a curve, from corner side−1 to corner side: row 0 of its ribbon.
    pub fn side_curve(&self, side: usize) -> Result<Curve, GbError> {
        Ok(Curve::new(self.ribbon(side)?.row(0).to_vec())?)
    }

    /// Box of all control points in use. The patch lies within it as long as no weight is negative, which holds but
    /// for the center weight `deficiency`.
    pub fn bounding_box(&self) -> BoundingBox {
        let ribbons = self.ribbons.iter().flat_map(|r| r.control_points().iter().copied());
        let center = self.center.filter(|_| self.center_weight != CenterWeight::None);
        let corners = self.corner_points.iter().map(|c| c.point);
        let start = self.ribbons[0].start();
        BoundingBox::from_points(ribbons.chain(center).chain(corners))
            .unwrap_or(BoundingBox { min: start, max: start })
    }

    /// Order of contact with the ribbon that each side keeps by construction, and what limits it.
    ///
    /// The measured figures come from [`ContinuityReport`](crate::ContinuityReport).
    pub fn continuity(&self) -> &[Contact] {
        &self.contacts
    }

    /// Point of the patch at (u, v).
    ///
    /// # Errors
    /// (u, v) outside the domain polygon.
    pub fn point(&self, uv: DVec2) -> Result<DVec3, GbError> {
        self.point_at(self.locate(uv)?)
    }

    /// Point and partial derivatives to order 2 in (u, v), by the chain rule.
    ///
    /// # Errors
    /// (u, v) outside the domain polygon, or at a corner, where derivatives do not exist.
    pub fn jet(&self, uv: DVec2) -> Result<SurfaceJet, GbError> {
        self.jet_at(self.locate(uv)?)
    }

    /// Unit normal, S_u × S_v for a counter-clockwise domain: see [`ConcavePatch::normal_at`].
    ///
    /// # Errors
    /// (u, v) outside the domain polygon, or no normal there.
    pub fn normal(&self, uv: DVec2) -> Result<DVec3, GbError> {
        self.normal_at(self.locate(uv)?)
    }

    /// Point at a location, see [`ConcavePatch::point`]. On a side it is the ribbon's curve at `t`, at a corner the corner.
    ///
    /// # Errors
    /// A location that is outside or names no side or corner.
    pub fn point_at(&self, location: Location) -> Result<DVec3, GbError> {
        let n = self.sides();
        match self.checked(location)? {
            Location::Corner(corner) => Ok(self.ribbons[corner].end()),
            Location::Side { side, t } => {
                let before = (side + n - 1) % n;
                let lambda = |i| {
                    if i == side {
                        t
                    } else if i == before {
                        1.0 - t
                    } else {
                        0.0
                    }
                };
                Ok(formula::point(&self.net(), &lambda))
            }
            Location::Inside(uv) => {
                let rows = self.inside_rows(uv, 0)?;
                let point = formula::point(&self.net(), &|i| rows[i]);
                if point.is_finite() { Ok(point) } else { Err(self.overflow(location)) }
            }
            Location::Outside => Err(GbError::Outside { uv: DVec2::NAN }),
        }
    }

    /// Jet at a location, see [`ConcavePatch::jet`]. On an open side the derivatives are limits from inside.
    ///
    /// # Errors
    /// A corner; a location that is outside or names no side; derivatives beyond the range of f64.
    pub fn jet_at(&self, location: Location) -> Result<SurfaceJet, GbError> {
        let rows = match self.checked(location)? {
            Location::Corner(corner) => return Err(GbError::CornerDerivative { corner }),
            Location::Side { side, t } => {
                let mut rows = vec![0.0; 6 * self.sides()];
                self.coordinates.evaluate_side(side, t, 2, &mut rows)?;
                rows
            }
            Location::Inside(uv) => self.inside_rows(uv, 2)?,
            Location::Outside => return Err(GbError::Outside { uv: DVec2::NAN }),
        };
        let jet = jet_from_rows(&self.net(), &rows);
        if jet.is_finite() { Ok(jet) } else { Err(self.overflow(location)) }
    }

    /// The formula itself: the point for given coordinates λ_0 … λ_{n−1}, whatever made them.
    ///
    /// λ ≥ 0 with sum 1 is expected; values below zero are raised to zero.
    ///
    /// # Errors
    /// A slice whose length is not n, or a result that is not finite.
    pub fn point_from_coordinates(&self, lambda: &[f64]) -> Result<DVec3, GbError> {
        check_length("the slice of coordinates", self.sides(), lambda.len())?;
        let point = formula::point(&self.net(), &|i| lambda[i]);
        if point.is_finite() { Ok(point) } else { Err(GbError::Overflow { uv: DVec2::NAN }) }
    }

    /// The formula itself, with derivatives: six rows of n numbers, λ and its derivatives in the order u, v, uu, uv, vv.
    ///
    /// # Errors
    /// A slice whose length is not 6n, or a result that is not finite.
    pub fn jet_from_coordinates(&self, rows: &[f64]) -> Result<SurfaceJet, GbError> {
        check_length("the slice of coordinates", 6 * self.sides(), rows.len())?;
        let jet = jet_from_rows(&self.net(), rows);
        if jet.is_finite() { Ok(jet) } else { Err(GbError::Overflow { uv: DVec2::NAN }) }
    }

    pub(crate) fn locate(&self, uv: DVec2) -> Result<Location, GbError> {
        match self.domain().locate(uv) {
            Location::Outside => Err(GbError::Outside { uv }),
            location => Ok(location),
        }
    }

    /// Checks what a caller made up, and turns the ends of a side into corners.
    pub(crate) fn checked(&self, location: Location) -> Result<Location, GbError> {
        checked(location, self.sides())
    }

    pub(crate) fn overflow(&self, location: Location) -> GbError {
        GbError::Overflow { uv: self.domain().at(location).unwrap_or(DVec2::NAN) }
    }

    fn inside_rows(&self, uv: DVec2, order: usize) -> Result<Vec<f64>, GbError> {
        let mut rows = vec![0.0; (order + 1) * (order + 2) / 2 * self.sides()];
        self.coordinates.evaluate_inside(&[uv], order, &mut rows)?;
        Ok(rows)
    }

    pub(crate) fn net(&self) -> Net<'_> {
        Net {
            ribbons: &self.ribbons,
            blend_power: self.blend_power,
            center_weight: self.center_weight,
            center: self.center.unwrap_or(DVec3::ZERO),
            noise: self.coordinates.kind() == CoordinateKind::Harmonic,
            corner_points: &self.corner_points,
        }
    }

    pub(crate) fn ribbon(&self, side: usize) -> Result<&Ribbon, GbError> {
        self.ribbons.get(side).ok_or(GbError::NoSuchSide { side, sides: self.sides() })
    }

    /// +1 for a counter-clockwise domain, −1 for a clockwise one: the sign of (s, h) against (u, v).
    pub(crate) fn handedness(&self) -> f64 {
        match self.domain().orientation() {
            Orientation::CounterClockwise => 1.0,
            Orientation::Clockwise => -1.0,
        }
    }

    /// Moves `C^side_{j,k}`. The domain polygon and its coordinates stay as they are.
    ///
    /// An end of a side belongs to the neighbour too: its copy there moves along, so that the sides keep meeting.
    ///
    /// # Errors
    /// No such point, a point that is not finite or too large, a side that would lose its length, a corner that would
    /// coincide with another. The patch is then unchanged.
    pub fn set_control_point(
        &mut self,
        side: usize,
        j: usize,
        k: usize,
        point: DVec3,
    ) -> Result<(), GbError> {
        let n = self.sides();
        let ribbon = self.ribbon(side)?;
        let degree = ribbon.degree();
        let mut moved = vec![(side, ribbon.clone())];
        moved[0].1.set_point(j, k, point)?;
        if k == 0 && j == 0 {
            let before = (side + n - 1) % n;
            let mut twin = self.ribbons[before].clone();
            twin.set_point(twin.degree(), 0, point)?;
            moved.push((before, twin));
        } else if k == 0 && j == degree {
            let after = (side + 1) % n;
            let mut twin = self.ribbons[after].clone();
            twin.set_point(0, 0, point)?;
            moved.push((after, twin));
        }
        if let Some((side, _)) = moved.iter().find(|(_, ribbon)| ribbon.collapsed()) {
            return Err(GbError::ZeroLengthSide { side: *side, at: point });
        }
        if moved.len() > 1 {
            let corner = if j == 0 { (side + n - 1) % n } else { side };
            self.keep_corners_apart(corner, point)?;
        }
        for (side, ribbon) in moved {
            self.ribbons[side] = ribbon;
        }
        Ok(())
    }

    /// Refuses a place for a corner that is another corner's within [`CORNER_TOLERANCE`] of the model's size.
    fn keep_corners_apart(&self, corner: usize, point: DVec3) -> Result<(), GbError> {
        let allowed = CORNER_TOLERANCE * self.bounding_box().diagonal();
        for (other, ribbon) in self.ribbons.iter().enumerate().filter(|(other, _)| *other != corner) {
            let distance = ribbon.end().distance(point);
            if distance <= allowed {
                let (first, second) = (corner.min(other), corner.max(other));
                return Err(GbError::EqualCorners { first, second, distance, allowed });
            }
        }
        Ok(())
    }

    /// Moves the central control point.
    ///
    /// # Errors
    /// A point that is not finite or too large.
    pub fn set_center(&mut self, point: DVec3) -> Result<(), GbError> {
        check_point(Place::Center, point)?;
        self.center = Some(point);
        Ok(())
    }

    /// Moves the corner point at `corner`.
    ///
    /// # Errors
    /// No corner point there, or a point that is not finite or too large.
    pub fn set_corner_point(&mut self, corner: usize, point: DVec3) -> Result<(), GbError> {
        check_point(Place::CornerPoint { corner }, point)?;
        let sides = self.sides();
        let found = self.corner_points.iter_mut().find(|c| c.corner == corner);
        found.ok_or(GbError::NoSuchCorner { corner, sides })?.point = point;
        Ok(())
    }
}

/// The surface's jet from six rows of λ.
pub(crate) fn jet_from_rows(net: &Net<'_>, rows: &[f64]) -> SurfaceJet {
    let n = net.ribbons.len();
    formula::jet(net, &|i| Second(std::array::from_fn(|row| rows[row * n + i])))
}
