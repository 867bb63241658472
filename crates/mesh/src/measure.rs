use casteljau_geom::glam::DVec3;

use crate::edges::Edges;
use crate::{MeshError, TriangleMesh};

/// The largest coordinate that [`TriangleMesh::area`], [`TriangleMesh::signed_volume`], [`TriangleMesh::audit`] and
/// [`TriangleTree`](crate::TriangleTree) accept: squared areas and summed volumes stay finite.
pub const MAX_COORDINATE: f64 = 1e75;

/// Refuses a point with a coordinate that is not finite or beyond [`MAX_COORDINATE`].
pub(crate) fn check_range(what: &'static str, index: usize, point: DVec3) -> Result<(), MeshError> {
    crate::sink::check_finite(what, index, point)?;
    match point.to_array().into_iter().find(|c| c.abs() > MAX_COORDINATE) {
        Some(value) => Err(MeshError::TooLarge { what, index, value, limit: MAX_COORDINATE }),
        None => Ok(()),
    }
}

impl TriangleMesh {
    /// [`validate`](Self::validate), and no coordinate beyond [`MAX_COORDINATE`].
    pub(crate) fn validate_measurable(&self) -> Result<(), MeshError> {
        self.validate()?;
        self.positions.iter().enumerate().try_for_each(|(index, &p)| check_range("position", index, p))
    }

    /// The corner positions of every triangle, of a mesh whose indices have been checked.
    pub(crate) fn triangle_corners(&self) -> impl Iterator<Item = [DVec3; 3]> {
        self.triangles.iter().map(|corners| corners.map(|index| self.positions[index as usize]))
    }

    /// The area, `½ Σ |(b − a) × (c − a)|` over the triangles, 0 without any.
    ///
    /// Error: relative 16u, plus what the coordinates' own rounding makes of the edges; compensated summation keeps it
    /// independent of the number of triangles.
    ///
    /// ```
    /// # use casteljau_mesh::{TriangleMesh, glam::DVec3};
    /// # let mesh = TriangleMesh { positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y], triangles: vec![[0, 1, 2]], ..Default::default() };
    /// assert_eq!(mesh.area()?, 0.5);
    /// # Ok::<(), casteljau_mesh::MeshError>(())
    /// ```
    pub fn area(&self) -> Result<f64, MeshError> {
        self.validate_measurable()?;
        Ok(0.5 * sum(self.triangle_corners().map(|[a, b, c]| (b - a).cross(c - a).length())))
    }

    /// The volume inside a closed, consistently oriented mesh,
    /// `⅙ Σ (a − o)·((b − o) × (c − o))`, positive where the triangles are counter-clockwise seen from outside.
    ///
    /// The origin `o` is the first vertex, so that a model far from the origin loses nothing. An empty mesh
    /// has volume 0. An edge of four triangles (two solids that touch) is accepted if as many run along it one way as
    /// the other. Triangles that name a vertex twice are ignored.
    ///
    /// Error: [`MeshError::NotClosed`] where an edge belongs to one triangle only, [`MeshError::NotOriented`] where the
    /// directions along an edge do not balance. Rounding: 16u·Σ|terms|. Cost: O(T log T), for the check.
    pub fn signed_volume(&self) -> Result<f64, MeshError> {
        self.validate_measurable()?;
        let edges = Edges::new(self)?;
        let mut boundary = edges.iter().filter(|edge| edge.len() == 1);
        if let Some(&[side]) = boundary.next() {
            let [from, to] = side.ends();
            return Err(MeshError::NotClosed { boundary_edges: 1 + boundary.count(), from, to });
        }
        for edge in edges.iter() {
            let backward = edge.iter().filter(|side| side.backward).count();
            if 2 * backward != edge.len() {
                let (low, high) = (edge[0].low, edge[0].high);
                let [from, to] = if 2 * backward > edge.len() { [high, low] } else { [low, high] };
                return Err(MeshError::NotOriented { from, to });
            }
        }
        let origin = self.positions.first().copied().unwrap_or(DVec3::ZERO);
        let terms = self.triangle_corners().map(|corners| {
            let [a, b, c] = corners.map(|p| p - origin);
            a.dot(b.cross(c))
        });
        Ok(sum(terms) / 6.0)
    }
}

/// Compensated sum (Neumaier): the error is that of the last rounding, as long as the terms number below 1/u.
pub(crate) fn sum(terms: impl Iterator<Item = f64>) -> f64 {
    let (mut total, mut lost) = (0.0_f64, 0.0_f64);
    for term in terms {
        let next = total + term;
        lost += if total.abs() >= term.abs() { (total - next) + term } else { (term - next) + total };
        total = next;
    }
    total + lost
}
