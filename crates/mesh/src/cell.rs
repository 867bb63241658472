/// A cell of a [`VolumeMesh`](crate::VolumeMesh): vertex indices in the order of VTK's linear cells.
///
/// A cell is right side out where its edges from vertex 0 to its neighbours 1, 2 (or 3) and up span a positive volume:
/// the first triangle or quad, run through in order, has its normal point into the cell. A cell may name a vertex more than once; it then
/// has the faces that are left of its own, and [`reduced`](Self::reduced) finds the kind that has just these.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cell {
    /// Four vertices, `(v₁ − v₀) × (v₂ − v₀) · (v₃ − v₀) > 0`.
    Tetrahedron([u32; 4]),
    /// The base 0 1 2 3 and the apex 4.
    Pyramid([u32; 5]),
    /// The triangle 0 1 2 and the triangle 3 4 5 above it.
    Wedge([u32; 6]),
    /// The quad 0 1 2 3 and the quad 4 5 6 7 above it.
    Hexahedron([u32; 8]),
}

const TETRAHEDRON: [&[usize]; 4] = [&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]];
const PYRAMID: [&[usize]; 5] = [&[0, 3, 2, 1], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]];
const WEDGE: [&[usize]; 5] = [&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]];
const HEXAHEDRON: [&[usize]; 6] =
    [&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];

/// A face of a cell, counter-clockwise seen from outside, without repetitions: a triangle or a quad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct CellFace {
    vertices: [u32; 4],
    count: usize,
}

impl CellFace {
    /// What is left of a row of vertices; `None` where that is less than a triangle.
    fn new(row: impl Iterator<Item = u32>) -> Option<Self> {
        let mut face = Self { vertices: [0; 4], count: 0 };
        for vertex in row {
            if !face.vertices[..face.count].contains(&vertex) {
                face.vertices[face.count] = vertex;
                face.count += 1;
            }
        }
        (face.count >= 3).then_some(face)
    }

    pub(crate) fn vertices(&self) -> &[u32] {
        &self.vertices[..self.count]
    }

    /// The triangles of the face, cut by the diagonal from its least vertex: one or two, and the number of them.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        let row = self.vertices();
        let least = (0..row.len()).min_by_key(|&place| row[place]).unwrap_or(0);
        let at = move |place: usize| self.vertices[(least + place) % self.count];
        (1..row.len() - 1).map(move |place| [at(0), at(place), at(place + 1)])
    }
}

impl Cell {
    /// The vertices, in order.
    #[must_use]
    pub fn vertices(&self) -> &[u32] {
        match self {
            Self::Tetrahedron(v) => v,
            Self::Pyramid(v) => v,
            Self::Wedge(v) => v,
            Self::Hexahedron(v) => v,
        }
    }

    /// The faces, each counter-clockwise seen from outside; those that a repeated vertex leaves less than a triangle of are left out.
    pub(crate) fn faces(&self) -> impl Iterator<Item = CellFace> {
        let rows: &'static [&'static [usize]] = match self {
            Self::Tetrahedron(_) => &TETRAHEDRON,
            Self::Pyramid(_) => &PYRAMID,
            Self::Wedge(_) => &WEDGE,
            Self::Hexahedron(_) => &HEXAHEDRON,
        };
        let vertices = self.vertices();
        rows.iter().filter_map(move |row| CellFace::new(row.iter().map(|&place| vertices[place])))
    }

    /// Turned inside out.
    #[must_use]
    pub fn flipped(self) -> Self {
        match self {
            Self::Tetrahedron([a, b, c, d]) => Self::Tetrahedron([a, c, b, d]),
            Self::Pyramid([a, b, c, d, e]) => Self::Pyramid([a, d, c, b, e]),
            Self::Wedge([a, b, c, d, e, f]) => Self::Wedge([a, c, b, d, f, e]),
            Self::Hexahedron([a, b, c, d, e, f, g, h]) => Self::Hexahedron([a, d, c, b, e, h, g, f]),
        }
    }

    /// The cell of the fitting kind, where vertices are repeated: a hexahedron with a face that is one point is a pyramid,
    /// one with a face that is one edge a wedge. `None` where no volume is left between the faces.
    ///
    /// Where no kind has these faces, as with a hexahedron of which one edge is one point, the cell comes back as it is.
    ///
    /// ```
    /// use casteljau_mesh::Cell;
    /// assert_eq!(Cell::Hexahedron([0, 1, 2, 3, 4, 4, 4, 4]).reduced(), Some(Cell::Pyramid([0, 1, 2, 3, 4])));
    /// assert_eq!(Cell::Wedge([0, 1, 2, 3, 3, 3]).reduced(), Some(Cell::Tetrahedron([0, 1, 2, 3])));
    /// assert_eq!(Cell::Wedge([0, 1, 2, 0, 1, 2]).reduced(), None);
    /// ```
    #[must_use]
    pub fn reduced(self) -> Option<Self> {
        let row = self.vertices();
        let mut different: Vec<u32> = row.to_vec();
        different.sort_unstable();
        different.dedup();
        if different.len() == row.len() {
            return Some(self);
        }
        let mut faces: Vec<CellFace> = self.faces().collect();
        // Two faces of the same vertices lie on each other: there is nothing between them.
        let sorted = |face: &CellFace| {
            let mut row = face.vertices().to_vec();
            row.sort_unstable();
            row
        };
        while let Some((a, b)) = twins(&faces, sorted) {
            faces.remove(b);
            faces.remove(a);
        }
        if faces.len() < 4 {
            return None;
        }
        let apart = |face: &CellFace| different.iter().copied().find(|v| !face.vertices().contains(v));
        let quads: Vec<CellFace> = faces.iter().copied().filter(|face| face.count == 4).collect();
        let triangles: Vec<CellFace> = faces.iter().copied().filter(|face| face.count == 3).collect();
        match (different.len(), &triangles[..], &quads[..]) {
            (4, [first, _, _, _], []) => {
                let [a, b, c, _] = first.vertices;
                apart(first).map(|d| Self::Tetrahedron([a, c, b, d]))
            }
            (5, [_, _, _, _], [base]) => {
                let [a, b, c, d] = base.vertices;
                apart(base).map(|e| Self::Pyramid([a, d, c, b, e]))
            }
            (6, [base, top], [_, _, _]) => {
                let [a, b, c, _] = base.vertices;
                // The quad's vertex beside one of the base and apart from it.
                let above = |v: u32| {
                    quads.iter().find_map(|quad| {
                        let place = quad.vertices.iter().position(|&q| q == v)?;
                        let beside = [quad.vertices[(place + 1) % 4], quad.vertices[(place + 3) % 4]];
                        beside.into_iter().find(|q| top.vertices().contains(q))
                    })
                };
                let [d, e, f] = [above(a)?, above(c)?, above(b)?];
                Some(Self::Wedge([a, c, b, d, e, f]))
            }
            _ => Some(self),
        }
    }

    /// Tetrahedra that fill the cell, without further vertices: from its least vertex to the triangles of the faces that lack
    /// it, which the diagonals from their own least vertices make. Cells that share a face cut it alike.
    ///
    /// Those that a repeated vertex leaves without volume are left out. All are right side out where the cell is convex.
    ///
    /// Source: De Loera, Rambau, Santos, *Triangulations* (2010), sec. 4.3.2 (pulling); Dompierre et al., "How to subdivide
    /// pyramids, prisms, and hexahedra into tetrahedra" (1999).
    pub fn tetrahedra(&self) -> impl Iterator<Item = [u32; 4]> {
        let least = self.vertices().iter().copied().min().unwrap_or(0);
        let faces: Vec<CellFace> = self.faces().filter(|face| !face.vertices().contains(&least)).collect();
        faces.into_iter().flat_map(move |face| {
            let triangles: Vec<[u32; 3]> = face.triangles().collect();
            triangles.into_iter().map(move |[a, b, c]| [a, c, b, least])
        })
    }
}

/// Two faces that have the same vertices.
fn twins(faces: &[CellFace], sorted: impl Fn(&CellFace) -> Vec<u32>) -> Option<(usize, usize)> {
    (0..faces.len()).find_map(|a| {
        let b = (a + 1..faces.len()).find(|&b| sorted(&faces[a]) == sorted(&faces[b]))?;
        Some((a, b))
    })
}
