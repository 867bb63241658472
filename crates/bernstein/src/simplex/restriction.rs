//! Polynomials over a part of their simplex, or beyond it.

use super::de_casteljau::raised;
use super::de_casteljau::step;
use super::elevation::lowered;
use super::index::{multi_indices, simplex_count, simplex_index};
use super::net::{SimplexNet, TetrahedronNet, TriangleNet};
use crate::error::least_length;
use crate::line::check_length;
use crate::{BernsteinError, Point};

/// The corners of the four triangles that the midpoints of the edges make: three at the vertices, then the one in
/// the middle, all with the orientation of the whole.
pub const TRIANGLE_QUARTERS: [[[f64; 3]; 3]; 4] = {
    let [a, b, c] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let [bc, ca, ab] = [[0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]]
};

/// The corners of eight tetrahedra of equal volume: four at the vertices, then four around the diagonal of the
/// octahedron between them that joins the midpoints of the edges 0–2 and 1–3; all with the orientation of the
/// whole.
///
/// Source: Bey, "Tetrahedral grid refinement", Computing 55 (1995).
pub const TETRAHEDRON_EIGHTHS: [[[f64; 4]; 4]; 8] = {
    let [a, b] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]];
    let [c, d] = [[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let [ab, ac, ad] = [[0.5, 0.5, 0.0, 0.0], [0.5, 0.0, 0.5, 0.0], [0.5, 0.0, 0.0, 0.5]];
    let [bc, bd, cd] = [[0.0, 0.5, 0.5, 0.0], [0.0, 0.5, 0.0, 0.5], [0.0, 0.0, 0.5, 0.5]];
    [
        [a, ab, ac, ad],
        [ab, b, bc, bd],
        [ac, bc, c, cd],
        [ad, bd, cd, d],
        [ab, ac, ad, bd],
        [ac, ab, bc, bd],
        [ac, ad, bd, cd],
        [bc, ac, bd, cd],
    ]
};

impl<P: Point, const V: usize> SimplexNet<'_, P, V> {
    /// Restriction to the simplex with the given corners, in barycentric coordinates of this one:
    /// `Q_β = p[c₁, …, c₁, c₂, …, c_V]`, the blossom with βₐ times the corner cₐ.
    ///
    /// Corners may lie outside, in any order and even on one line: nothing is divided by. Levels of de
    /// Casteljau's algorithm are taken in an order that depends on the corners alone, so that two parts with
    /// corners in common have the same points there, to the bit, and a corner at a vertex keeps its point to the
    /// bit. Error of each point: at most `4(n+2)·u` times the same blossom with everything taken absolutely.
    /// Cost: about `C(n+2V−1, 2V−1)` affine combinations, n⁵/120 for a triangle. `scratch` holds
    /// V·[`simplex_count`]`::<V>(n)` points.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless `out` holds as many points as the net, and `scratch` enough.
    ///
    /// ```
    /// use casteljau_bernstein::TriangleNet;
    /// let net = TriangleNet::new(&[0.0, 4.0, 8.0], 1)?;
    /// let mut part = [0.0; 3];
    /// net.restrict([[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5]], &mut part, &mut [0.0; 9])?;
    /// assert_eq!(part, [0.0, 2.0, 4.0]);
    /// # Ok::<(), casteljau_bernstein::BernsteinError>(())
    /// ```
    ///
    /// Source: Seidel, "A general subdivision theorem for Bézier triangles" (1989); Farin, *Curves and Surfaces
    /// for CAGD*, 5th ed., sec. 17.5.
    pub fn restrict(
        &self,
        corners: [[f64; V]; V],
        out: &mut [P],
        scratch: &mut [P],
    ) -> Result<(), BernsteinError> {
        let (count, n) = (simplex_count::<V>(self.degree()), self.degree());
        check_length("out", out.len(), count)?;
        least_length("scratch", count.saturating_mul(V), scratch.len())?;
        self.copy_to(&mut scratch[..count]);
        let mut order: [usize; V] = std::array::from_fn(|corner| corner);
        order.sort_by(|&a, &b| {
            let pairs = corners[a].iter().zip(&corners[b]);
            pairs.map(|(x, y)| y.total_cmp(x)).find(|o| o.is_ne()).unwrap_or(a.cmp(&b))
        });
        blossoms(n, &corners, &order, [0; V], scratch, count, out);
        Ok(())
    }

    /// Subdivision at a point into V parts: part a, at `a·count` of `out`, has the point in place of vertex a.
    ///
    /// Parts share their faces to the bit; faces of the whole are kept to the bit. A point on a face gives
    /// degenerate parts for the vertices apart from it. Error of each point: at most `4(n+2)·u` times its
    /// combination of absolute values. Cost: de Casteljau's algorithm once a part.
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless `out` holds V nets.
    pub fn split_at(&self, lambda: [f64; V], out: &mut [P]) -> Result<(), BernsteinError> {
        let count = simplex_count::<V>(self.degree());
        check_length("out", out.len(), count.saturating_mul(V))?;
        for (vertex, part) in out.chunks_exact_mut(count).enumerate() {
            self.copy_to(part);
            replace_vertex(self.degree(), 1, vertex, lambda, part);
        }
        Ok(())
    }

    /// Subdivision of the edge from vertex a to vertex b at `(1−t) a + t b`: `near_a` has the point in place of b,
    /// `near_b` in place of a.
    ///
    /// Bits and error as for [`split_at`](Self::split_at). t may lie outside `[0, 1]`.
    ///
    /// # Errors
    /// [`BernsteinError::Vertices`] unless a and b are two of the vertices, [`BernsteinError::BufferLength`].
    pub fn split_edge(
        &self,
        [a, b]: [usize; 2],
        t: f64,
        near_a: &mut [P],
        near_b: &mut [P],
    ) -> Result<(), BernsteinError> {
        check_vertices::<V>(&[a, b])?;
        let count = simplex_count::<V>(self.degree());
        check_length("near_a", near_a.len(), count)?;
        check_length("near_b", near_b.len(), count)?;
        let mut lambda = [0.0; V];
        (lambda[a], lambda[b]) = (1.0 - t, t);
        for (vertex, part) in [(b, near_a), (a, near_b)] {
            self.copy_to(part);
            replace_vertex(self.degree(), 1, vertex, lambda, part);
        }
        Ok(())
    }

    /// [`restrict`](Self::restrict) to each of several parts, whose nets follow one another in `out`.
    fn restrict_to_all(
        &self,
        parts: &[[[f64; V]; V]],
        out: &mut [P],
        scratch: &mut [P],
    ) -> Result<(), BernsteinError> {
        let count = simplex_count::<V>(self.degree());
        check_length("out", out.len(), count.saturating_mul(parts.len()))?;
        for (&corners, part) in parts.iter().zip(out.chunks_exact_mut(count)) {
            self.restrict(corners, part, scratch)?;
        }
        Ok(())
    }
}

impl<P: Point> TriangleNet<'_, P> {
    /// The uniform split into [`TRIANGLE_QUARTERS`], whose nets follow one another in `out`.
    ///
    /// Otherwise as [`restrict`](Self::restrict).
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless `out` holds 4 nets and `scratch` 3.
    pub fn split_uniform(&self, out: &mut [P], scratch: &mut [P]) -> Result<(), BernsteinError> {
        self.restrict_to_all(&TRIANGLE_QUARTERS, out, scratch)
    }
}

impl<P: Point> TetrahedronNet<'_, P> {
    /// The uniform split into [`TETRAHEDRON_EIGHTHS`], whose nets follow one another in `out`.
    ///
    /// Otherwise as [`restrict`](Self::restrict).
    ///
    /// # Errors
    /// [`BernsteinError::BufferLength`] unless `out` holds 8 nets and `scratch` 4.
    pub fn split_uniform(&self, out: &mut [P], scratch: &mut [P]) -> Result<(), BernsteinError> {
        self.restrict_to_all(&TETRAHEDRON_EIGHTHS, out, scratch)
    }
}

/// Whether these are different vertices of a simplex.
pub(crate) fn check_vertices<const V: usize>(vertices: &[usize]) -> Result<(), BernsteinError> {
    for (place, &vertex) in vertices.iter().enumerate() {
        if vertex >= V || vertices[..place].contains(&vertex) {
            return Err(BernsteinError::Vertices { vertex, vertices: V });
        }
    }
    Ok(())
}

/// All points of a restriction, corner after corner: the net of degree m at the beginning of `nets` has taken the
/// arguments that `index` counts; the corners left are those in `order`.
fn blossoms<P: Point, const V: usize>(
    m: usize,
    corners: &[[f64; V]; V],
    order: &[usize],
    mut index: [usize; V],
    nets: &mut [P],
    count: usize,
    out: &mut [P],
) {
    let Some((&corner, later)) = order.split_first() else { return };
    if later.is_empty() {
        for lower in (0..m).rev() {
            step(lower, corners[corner], nets);
        }
        index[corner] = m;
        out[simplex_index(index)] = nets[0];
        return;
    }
    let (net, below) = nets.split_at_mut(count);
    for taken in 0..=m {
        if taken > 0 {
            step(m - taken, corners[corner], net);
        }
        index[corner] = taken;
        let used = simplex_count::<V>(m - taken);
        below[..used].copy_from_slice(&net[..used]);
        blossoms(m - taken, corners, later, index, below, count, out);
    }
}

/// The net over the simplex with λ in place of one vertex: `Q_β` is level `β_vertex` of de Casteljau's scheme.
/// Points are rows of `width` places.
pub(crate) fn replace_vertex<P: Point, const V: usize>(
    n: usize,
    width: usize,
    vertex: usize,
    lambda: [f64; V],
    net: &mut [P],
) {
    // Multi-indices with the entry of that vertex first: it descends, and what a level reads beside it is older.
    let swapped = |mut index: [usize; V]| {
        index.swap(0, vertex);
        index
    };
    for level in 1..=n {
        for index in multi_indices::<V>(n).take_while(|index| index[0] >= level).map(swapped) {
            let base = lowered(index, vertex);
            let target = simplex_index(index) * width;
            let rows: [usize; V] = std::array::from_fn(|a| simplex_index(raised(base, a)) * width);
            for k in 0..width {
                let term = |a: usize| net[rows[a] + k] * lambda[a];
                net[target + k] = (1..V).fold(term(0), |sum, a| sum + term(a));
            }
        }
    }
}
