//! From a polygon in the plane to the parameters of a rectangle or a triangle.

use casteljau_domain::{DomainError, Location, Polygon};
use casteljau_geom::glam::{DVec2, dvec2};

/// Corners of the triangle that all charts over a triangle are drawn in: edges of length 1.
const TRIANGLE: [DVec2; 3] = [dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(0.5, 0.866_025_403_784_438_6)];
/// A rectangle is drawn no narrower than this.
const NARROWEST: f64 = 1e-3;

/// How the polygon lies over the parameters, which run over `[0, 1]²` or the unit triangle here.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Map {
    /// (x/a, y/b).
    Rectangle([f64; 2]),
    /// λ₁ and λ₂ are barycentric; the triangle's vertex 0 belongs to λ₁, 1 to λ₂, 2 to λ₃.
    Triangle,
    /// A rectangle of which this side is one point of the surface: a triangle whose vertex 2 is that point. Along
    /// the opposite side s = λ₂/(λ₁ + λ₂), towards the point h = λ₃.
    Pole(usize),
}

/// A polygon with its map to the parameters.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    pub polygon: Polygon,
    map: Map,
}

impl Chart {
    /// For a rectangle that is a × b in space, roughly.
    pub fn rectangle([a, b]: [f64; 2]) -> Result<Self, DomainError> {
        let longest = a.max(b);
        let size = if longest > 0.0 && longest.is_finite() {
            [a, b].map(|x| (x / longest).max(NARROWEST))
        } else {
            [1.0; 2]
        };
        let [a, b] = size;
        let polygon = Polygon::new(vec![dvec2(a, 0.0), dvec2(a, b), dvec2(0.0, b), dvec2(0.0, 0.0)])?;
        Ok(Self { polygon, map: Map::Rectangle(size) })
    }

    /// For a triangle.
    pub fn triangle() -> Result<Self, DomainError> {
        Ok(Self { polygon: Polygon::new(TRIANGLE.to_vec())?, map: Map::Triangle })
    }

    /// For a rectangle whose side `side` is collapsed.
    pub fn pole(side: usize) -> Result<Self, DomainError> {
        Ok(Self { map: Map::Pole(side), ..Self::triangle()? })
    }

    /// The shape's number of a side of the polygon.
    pub fn side_name(&self, side: usize) -> usize {
        match self.map {
            Map::Pole(collapsed) => (collapsed + 1 + side) % 4,
            // The polygon's sides run towards the corners, those of the shape lie across from them.
            Map::Triangle => (side + 1) % 3,
            Map::Rectangle(_) => side,
        }
    }

    /// The parameters at a location, in `[0, 1]²` or (λ₁, λ₂); exact on sides.
    pub fn parameters(&self, location: Location) -> [f64; 2] {
        match (location, self.map) {
            (Location::Inside(p), Map::Rectangle([a, b])) => [p.x / a, p.y / b],
            (Location::Inside(p), Map::Triangle) => {
                let [x, y, _] = barycentric(p);
                [x, y]
            }
            (Location::Inside(p), Map::Pole(side)) => {
                let [a, b, h] = barycentric(p);
                from_side((side + 2) % 4, b / (a + b), h)
            }
            (Location::Side { side, t }, Map::Triangle) => match side {
                0 => [t, 0.0],
                1 => [1.0 - t, t],
                _ => [0.0, 1.0 - t],
            },
            (Location::Side { side, t }, _) => from_side(self.side_name(side), t, 0.0),
            (Location::Corner(corner), Map::Triangle) => [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]][corner % 3],
            // The middle of the collapsed side, where the normal has its limit.
            (Location::Corner(2), Map::Pole(side)) => from_side(side, 0.5, 0.0),
            (Location::Corner(corner), _) => from_side(self.side_name(corner), 1.0, 0.0),
            (Location::Outside, _) => [f64::NAN; 2],
        }
    }
}

/// The point of `[0, 1]²` at t along a side and h inwards.
fn from_side(side: usize, t: f64, h: f64) -> [f64; 2] {
    match side {
        0 => [t, h],
        1 => [1.0 - h, t],
        2 => [1.0 - t, 1.0 - h],
        _ => [h, 1.0 - t],
    }
}

/// Barycentric coordinates in [`TRIANGLE`].
fn barycentric(p: DVec2) -> [f64; 3] {
    let h = p.y / TRIANGLE[2].y;
    let b = p.x - 0.5 * h;
    [1.0 - b - h, b, h]
}
