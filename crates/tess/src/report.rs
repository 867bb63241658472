/// One side of one patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SideId {
    /// The patch, in the order given.
    pub patch: usize,
    /// The side of that patch.
    pub side: usize,
}

/// Angles of triangles, those that touch the boundary of their patch counted apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Triangles without a vertex on a side.
    pub interior: usize,
    /// Least angle of those, in radians; π/3 where there are none.
    pub interior_least: f64,
    /// How many of those have an angle below 19°.
    pub interior_below_19: usize,
    /// Triangles with a vertex on a side.
    pub boundary: usize,
    /// Least angle of those, in radians; π/3 where there are none.
    pub boundary_least: f64,
    /// How many of those have an angle below 10°.
    pub boundary_below_10: usize,
}

impl Default for Quality {
    fn default() -> Self {
        let third = std::f64::consts::FRAC_PI_3;
        Self {
            interior: 0,
            interior_least: third,
            interior_below_19: 0,
            boundary: 0,
            boundary_least: third,
            boundary_below_10: 0,
        }
    }
}

impl Quality {
    /// Counts a triangle with that cotangent of its least angle.
    pub(crate) fn count(&mut self, cotangent: f64, at_boundary: bool) {
        let angle = 1f64.atan2(cotangent);
        if at_boundary {
            self.boundary += 1;
            self.boundary_least = self.boundary_least.min(angle);
            self.boundary_below_10 += usize::from(angle < 10f64.to_radians());
        } else {
            self.interior += 1;
            self.interior_least = self.interior_least.min(angle);
            self.interior_below_19 += usize::from(angle < 19f64.to_radians());
        }
    }
}

/// What a tessellation reached.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Vertices pushed.
    pub vertices: usize,
    /// Triangles pushed.
    pub triangles: usize,
    /// Largest chord error, in model units: on sides a bound, inside measured at centroids and edge midpoints (where
    /// the normals foretell less than half the tolerance nothing is measured). None
    /// for a mesh by resolution, where nothing is measured.
    pub chord_error: Option<f64>,
    /// Angles in the domain polygons.
    pub domain: Quality,
    /// Angles in space.
    pub space: Quality,
    /// Sides that no other side follows to the bit: the boundary of the mesh.
    pub open_sides: Vec<SideId>,
    /// Pairs of patches' sides that run the same way along their common curve: one of the two patches has its outside
    /// where the other has its inside. Curves that look the same from both ends decide nothing and are left out.
    pub misoriented: Vec<[SideId; 2]>,
    /// Sides whose curve belongs to more than two sides: the mesh is no manifold there.
    pub crowded_sides: Vec<SideId>,
    /// Vertices without a normal of any kind, surface or triangles; they got (0, 0, 1).
    pub without_normal: usize,
}

impl Report {
    /// Whether each side is shared by exactly two, running opposite ways: the model is closed and oriented.
    pub fn is_closed(&self) -> bool {
        self.open_sides.is_empty() && self.misoriented.is_empty() && self.crowded_sides.is_empty()
    }
}
