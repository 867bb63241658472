//! Simple polygons in the plane: validation, measures, point location.

mod simple;

use casteljau_geom::glam::DVec2;
use robust::{Coord, orient2d};

use crate::DomainError;

/// Sense in which the vertices of a [`Polygon`] follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Orientation {
    /// The inside is on the left of every side.
    CounterClockwise,
    /// The inside is on the right of every side.
    Clockwise,
}

/// Where a point is with respect to a [`Polygon`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Location {
    /// Inside, at this point.
    Inside(DVec2),
    /// On a side, but not at its ends.
    Side {
        /// The side, from vertex `side − 1` to vertex `side`.
        side: usize,
        /// Place on it: 0 at vertex `side − 1`, 1 at vertex `side`.
        t: f64,
    },
    /// At a vertex.
    Corner(usize),
    /// Outside.
    Outside,
}

/// A simple polygon: at least three vertices, sides of non-zero length that meet in their common ends only.
///
/// Side i runs from vertex i−1 to vertex i. Either orientation is kept as given. Straight corners (interior
/// angle π) are allowed. Indices are cyclic: vertex n is vertex 0. All rules are exact or relative to the
/// polygon's size, so a polygon and its scaled copies behave alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    vertices: Vec<DVec2>,
    orientation: Orientation,
    extent: [DVec2; 2],
    band: f64,
}

impl Polygon {
    /// Largest absolute coordinate; beyond it fourth powers of lengths, which the exact tests need, leave
    /// f64.
    pub const LARGEST_COORDINATE: f64 = 1e75;
    /// Least extent of the bounding box, for the same reason.
    pub const LEAST_SIZE: f64 = 1e-75;
    /// Half-width of the band in which [`Polygon::locate`] takes a point to be on the boundary, in units of
    /// u · (largest absolute coordinate), u = 2⁻⁵³.
    pub const BAND_ULPS: f64 = 8.0;

    /// Checks and keeps the vertices.
    ///
    /// The tests for touching sides are exact: orientations come from the adaptive predicate of Shewchuk
    /// (crate `robust`), so no polygon is refused or accepted by an accident of rounding. Error: fewer than
    /// three vertices, a coordinate that is not finite or out of range, a side of length zero, neighbouring
    /// sides that overlap, other sides that have a point in common. Cost: O(n log n + k), k pairs of sides
    /// whose extents overlap in x; k = n² at worst (10,000 sides: 0.1 s).
    ///
    /// ```
    /// use casteljau_domain::{DomainError, Polygon, glam::dvec2};
    /// let bow_tie = vec![dvec2(0., 0.), dvec2(1., 1.), dvec2(1., 0.), dvec2(0., 1.)];
    /// let wrong = Polygon::new(bow_tie).unwrap_err();
    /// assert_eq!(wrong, DomainError::SidesMeet { first: 1, second: 3, position: [0.5, 0.5] });
    /// ```
    pub fn new(vertices: Vec<DVec2>) -> Result<Self, DomainError> {
        let orientation = simple::check(&vertices)?;
        let extent @ [min, max] = simple::extent(&vertices);
        let band = Self::BAND_ULPS * 0.5 * f64::EPSILON * max.max(-min).max_element();
        Ok(Self { vertices, orientation, extent, band })
    }

    /// The vertices, as given.
    pub fn vertices(&self) -> &[DVec2] {
        &self.vertices
    }

    /// Number n of vertices, and of sides; never zero.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Vertex i, cyclic.
    pub fn vertex(&self, i: usize) -> DVec2 {
        self.vertices[i % self.len()]
    }

    /// Ends of side i: vertex i−1, vertex i.
    pub fn side(&self, i: usize) -> [DVec2; 2] {
        let n = self.len();
        [self.vertices[(i % n + n - 1) % n], self.vertices[i % n]]
    }

    /// Length of side i.
    pub fn side_length(&self, i: usize) -> f64 {
        let [a, b] = self.side(i);
        a.distance(b)
    }

    /// Sum of the lengths of the sides.
    pub fn perimeter(&self) -> f64 {
        (0..self.len()).map(|i| self.side_length(i)).sum()
    }

    /// Orientation, exact.
    pub fn orientation(&self) -> Orientation {
        self.orientation
    }

    /// 1 when counter-clockwise, −1 when clockwise.
    fn sign(&self) -> f64 {
        match self.orientation {
            Orientation::CounterClockwise => 1.0,
            Orientation::Clockwise => -1.0,
        }
    }

    /// Signed area, ½ Σ pᵢ₋₁ × pᵢ, positive when counter-clockwise.
    ///
    /// Taken about vertex 0. Error: n·u·diameter²; the sign is that of the exact orientation.
    pub fn signed_area(&self) -> f64 {
        let o = self.vertices[0];
        let twice: f64 = self.vertices[1..].windows(2).map(|w| (w[0] - o).perp_dot(w[1] - o)).sum();
        (0.5 * twice).abs() * self.sign()
    }

    /// Lower left and upper right corner of the bounding box.
    pub fn bounding_box(&self) -> [DVec2; 2] {
        self.extent
    }

    /// Largest distance between two vertices. Cost: O(n²), 30 ms for 10,000 vertices.
    pub fn diameter(&self) -> f64 {
        let v = &self.vertices;
        let pairs =
            v.iter().enumerate().flat_map(|(i, a)| v[i + 1..].iter().map(move |b| a.distance_squared(*b)));
        pairs.fold(0.0, f64::max).sqrt()
    }

    /// Interior angle at vertex i, in radians, within (0, 2π) (to rounding); π at a straight corner.
    ///
    /// Which side of π it lies on is exact.
    pub fn interior_angle(&self, i: usize) -> f64 {
        let [before, at] = self.side(i);
        let after = self.vertex(i + 1);
        // Zero is added because −0 would make the angle of a straight corner −π.
        let cross = self.sign() * turn(before, at, after) + 0.0;
        let dot = (before - at).dot(after - at);
        let angle = cross.atan2(dot);
        if cross < 0.0 { angle + std::f64::consts::TAU } else { angle }
    }

    /// Whether the interior angle at vertex i is larger than π, exactly.
    pub fn is_concave(&self, i: usize) -> bool {
        let [before, at] = self.side(i);
        self.sign() * turn(before, at, self.vertex(i + 1)) < 0.0
    }

    /// Whether no corner is concave.
    pub fn is_convex(&self) -> bool {
        (0..self.len()).all(|i| !self.is_concave(i))
    }

    /// Least distance between a vertex and a side that it does not end.
    ///
    /// From four vertices on this is the least distance between two sides that are no neighbours; of a
    /// triangle it is the least height. No side is shorter. Error: a few u, relative, where two sides are
    /// close. Cost: O(n²), with boxes compared first (10,000 sides: 0.3 s).
    pub fn clearance(&self) -> f64 {
        simple::clearance(&self.vertices)
    }

    /// Where `p` is.
    ///
    /// A point within [`Polygon::BAND_ULPS`]·u·(largest absolute coordinate) of a vertex is at the nearest
    /// such vertex, one within that distance of a side is on the nearest side; for all others inside and
    /// outside are decided exactly. A point that is not finite is outside. Cost: O(n).
    pub fn locate(&self, p: DVec2) -> Location {
        let [min, max] = self.extent;
        // Written so that NaN is outside too.
        if !((min - p).max(p - max).max_element() <= self.band && p.is_finite()) {
            return Location::Outside;
        }
        let mut corner = (self.band, None);
        let mut side = (self.band, None);
        let mut inside = false;
        let mut a = self.vertices[self.len() - 1];
        for (i, &b) in self.vertices.iter().enumerate() {
            let gap = p.distance(b);
            if gap <= corner.0 {
                corner = (gap, Some(i));
            }
            let (gap, t) = simple::distance_to_segment(p, a, b);
            if gap <= side.0 {
                side = (gap, Some((i, t)));
            }
            // Half-open in y, so that a ray through a vertex counts once; the orientation says which side p
            // is on.
            if (a.y > p.y) != (b.y > p.y) && (turn(a, b, p) > 0.0) == (b.y > a.y) {
                inside = !inside;
            }
            a = b;
        }
        match (corner.1, side.1) {
            (Some(i), _) => Location::Corner(i),
            (None, Some((side, t))) => Location::Side { side, t },
            (None, None) if inside => Location::Inside(p),
            (None, None) => Location::Outside,
        }
    }

    /// The point at a location, `None` for [`Location::Outside`].
    ///
    /// On a side (1−t)·pᵢ₋₁ + t·pᵢ, which is exact at both ends.
    pub fn at(&self, location: Location) -> Option<DVec2> {
        match location {
            Location::Inside(p) => Some(p),
            Location::Side { side, t } => {
                let [a, b] = self.side(side);
                Some(a * (1.0 - t) + b * t)
            }
            Location::Corner(i) => Some(self.vertex(i)),
            Location::Outside => None,
        }
    }
}

/// Twice the signed area of the triangle abc, with exact sign: positive when it turns left.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}
