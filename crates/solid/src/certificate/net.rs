//! The control net of any solid, and the order of the coefficients over its domain.

use casteljau_bernstein::{MAX_DEGREE, binomial, multi_indices, simplex_count, simplex_index};
use casteljau_shape::{ControlPoint, LARGEST_COORDINATE, ShapeError};

use crate::SolidError;

/// A solid seen as its control net, borrowed: what determinants, volumes and moments are computed from.
///
/// `DVec3` makes a polynomial solid, `DVec4` = (w·x, w·y, w·z, w) a rational one.
#[derive(Debug, Clone, Copy)]
pub enum SolidNet<'a, P> {
    /// `Σ Bᵢˡ(u) Bⱼᵐ(v) Bₖⁿ(w) Pᵢⱼₖ`; k runs fastest.
    Hexahedron {
        /// The control points.
        points: &'a [P],
        /// l, m and n.
        degrees: [usize; 3],
    },
    /// `Σ n!/β! λ^β P_β`, multi-indices in descending lexicographic order; the parameters are λ₁, λ₂, λ₃.
    Tetrahedron {
        /// The control points.
        points: &'a [P],
        /// n.
        degree: usize,
    },
    /// `Σ n!/β! λ^β Bₖᵒ(w) P_βₖ`; k runs fastest; the parameters are λ₁, λ₂ and w.
    Wedge {
        /// The control points.
        points: &'a [P],
        /// n of the triangle and o of the height.
        degrees: [usize; 2],
    },
}

/// The degrees of a polynomial over the domain of a solid; with them goes the order of its coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolidDegrees {
    /// With u, v and w.
    Hexahedron([usize; 3]),
    /// The total degree.
    Tetrahedron(usize),
    /// Of the triangle and of the height.
    Wedge([usize; 2]),
}

impl<'a, P: ControlPoint> SolidNet<'a, P> {
    /// The control points.
    #[must_use]
    pub const fn points(&self) -> &'a [P] {
        match *self {
            Self::Hexahedron { points, .. }
            | Self::Tetrahedron { points, .. }
            | Self::Wedge { points, .. } => points,
        }
    }

    /// The degrees.
    #[must_use]
    pub const fn degrees(&self) -> SolidDegrees {
        match *self {
            Self::Hexahedron { degrees, .. } => SolidDegrees::Hexahedron(degrees),
            Self::Tetrahedron { degree, .. } => SolidDegrees::Tetrahedron(degree),
            Self::Wedge { degrees, .. } => SolidDegrees::Wedge(degrees),
        }
    }

    /// Refuses nets that do not fit their degrees, and numbers out of range.
    pub(crate) fn check(&self) -> Result<(), SolidError> {
        let degrees = self.degrees();
        let highest = degrees.along().into_iter().fold(0, usize::max);
        if highest > MAX_DEGREE {
            return Err(ShapeError::Degree { degree: highest, limit: MAX_DEGREE }.into());
        }
        let (needed, given) = (degrees.count(), self.points().len());
        if needed != given {
            return Err(SolidError::NetLength { needed, given });
        }
        for (place, p) in self.points().iter().enumerate() {
            for (axis, &value) in p.components().iter().enumerate() {
                if value.is_nan() || value.abs() > LARGEST_COORDINATE {
                    return Err(ShapeError::Coordinate { place, axis, value }.into());
                }
            }
        }
        Ok(())
    }
}

/// Determinants with more coefficients than this are not expanded.
const MOST_COEFFICIENTS: usize = 1_000_000;

impl SolidDegrees {
    /// Refuses degrees whose determinant has too many coefficients: it is of less than three times the degrees, or four
    /// times those of a rational solid.
    pub(crate) fn check_determinant(self, rational: bool) -> Result<(), SolidError> {
        let factor = if rational { 4 } else { 3 };
        let (needed, limit) = (self.scaled(factor).count(), MOST_COEFFICIENTS);
        if needed > limit {
            return Err(SolidError::Coefficients { needed, limit });
        }
        self.check_multiplicities(factor)
    }

    /// Refuses degrees whose basis functions, multiplied `factor` of them, carry numbers out of range, or so large that
    /// sums of products with the control points, brought near 1, are.
    pub(crate) fn check_multiplicities(self, factor: usize) -> Result<(), SolidError> {
        let product = self.scaled(factor);
        // The largest multinomial coefficient is that in the middle.
        let middle = match product {
            Self::Hexahedron(degrees) => degrees.map(|d| d / 2),
            Self::Tetrahedron(n) => [n / 4; 3],
            Self::Wedge([n, o]) => [n / 3, n / 3, o / 2],
        };
        let degrees = self.along();
        // Derivatives carry their degrees; determinants of differences of numbers below 2 stay below 2¹².
        let size = degrees.iter().fold(4096.0, |size, &d| size * d.max(1) as f64);
        if (product.multiplicity(middle) * size).is_finite() {
            Ok(())
        } else {
            Err(SolidError::Multiplicities { degrees })
        }
    }

    /// So many times the degrees.
    const fn scaled(self, factor: usize) -> Self {
        match self {
            Self::Hexahedron([l, m, n]) => Self::Hexahedron([factor * l, factor * m, factor * n]),
            Self::Tetrahedron(n) => Self::Tetrahedron(factor * n),
            Self::Wedge([n, o]) => Self::Wedge([factor * n, factor * o]),
        }
    }

    /// The greatest exponent of each of the three parameters.
    #[must_use]
    pub const fn along(self) -> [usize; 3] {
        match self {
            Self::Hexahedron(degrees) => degrees,
            Self::Tetrahedron(n) => [n; 3],
            Self::Wedge([n, o]) => [n, n, o],
        }
    }

    /// The number of coefficients.
    #[must_use]
    pub const fn count(self) -> usize {
        match self {
            Self::Hexahedron([l, m, n]) => (l + 1) * (m + 1) * (n + 1),
            Self::Tetrahedron(n) => simplex_count::<4>(n),
            Self::Wedge([n, o]) => simplex_count::<3>(n) * (o + 1),
        }
    }

    /// Those of a constant over the same domain.
    pub(crate) const fn constant(self) -> Self {
        match self {
            Self::Hexahedron(_) => Self::Hexahedron([0; 3]),
            Self::Tetrahedron(_) => Self::Tetrahedron(0),
            Self::Wedge(_) => Self::Wedge([0; 2]),
        }
    }

    /// `∫ 1` over the domain: the integral of a polynomial is the mean of its coefficients, times this.
    pub(crate) const fn measure(self) -> f64 {
        match self {
            Self::Hexahedron(_) => 1.0,
            Self::Tetrahedron(_) => 1.0 / 6.0,
            Self::Wedge(_) => 0.5,
        }
    }

    /// The degrees of a derivative with respect to parameter `axis`; `None` where the polynomial does not depend on it.
    pub(crate) fn lowered(self, axis: usize) -> Option<Self> {
        match self {
            Self::Hexahedron(mut degrees) => {
                degrees[axis] = degrees[axis].checked_sub(1)?;
                Some(Self::Hexahedron(degrees))
            }
            Self::Tetrahedron(n) => Some(Self::Tetrahedron(n.checked_sub(1)?)),
            Self::Wedge([n, o]) if axis < 2 => Some(Self::Wedge([n.checked_sub(1)?, o])),
            Self::Wedge([n, o]) => Some(Self::Wedge([n, o.checked_sub(1)?])),
        }
    }

    /// The degrees of a product.
    pub(crate) fn times(self, other: Self) -> Self {
        match (self, other) {
            (Self::Hexahedron(a), Self::Hexahedron(b)) => {
                Self::Hexahedron(std::array::from_fn(|axis| a[axis] + b[axis]))
            }
            (Self::Tetrahedron(a), Self::Tetrahedron(b)) => Self::Tetrahedron(a + b),
            (Self::Wedge(a), Self::Wedge(b)) => Self::Wedge([a[0] + b[0], a[1] + b[1]]),
            // Nets of one solid only are multiplied.
            _ => self,
        }
    }

    /// The place of the coefficient with these indices: (i, j, k), the first three barycentric ones, or the first two and
    /// k. Places of products are not sums of places, but indices of products are sums of indices.
    pub(crate) const fn place(self, [a, b, c]: [usize; 3]) -> usize {
        match self {
            Self::Hexahedron([_, m, n]) => (a * (m + 1) + b) * (n + 1) + c,
            Self::Tetrahedron(n) => simplex_index([a, b, c, n - a - b - c]),
            Self::Wedge([n, o]) => simplex_index([a, b, n - a - b]) * (o + 1) + c,
        }
    }

    /// All indices in the order of the net.
    pub(crate) fn indices(self) -> Vec<[usize; 3]> {
        match self {
            Self::Hexahedron([l, m, n]) => {
                (0..=l).flat_map(|i| (0..=m).flat_map(move |j| (0..=n).map(move |k| [i, j, k]))).collect()
            }
            Self::Tetrahedron(n) => multi_indices::<4>(n).map(|[a, b, c, _]| [a, b, c]).collect(),
            Self::Wedge([n, o]) => {
                multi_indices::<3>(n).flat_map(|[a, b, _]| (0..=o).map(move |k| [a, b, k])).collect()
            }
        }
    }

    /// The number that a basis function carries: `C(l,i) C(m,j) C(n,k)`, or `n!/β!`, or `n!/β!·C(o,k)`.
    pub(crate) fn multiplicity(self, [a, b, c]: [usize; 3]) -> f64 {
        match self {
            Self::Hexahedron([l, m, n]) => binomial(l, a) * binomial(m, b) * binomial(n, c),
            Self::Tetrahedron(n) => binomial(n, a) * binomial(n - a, b) * binomial(n - a - b, c),
            Self::Wedge([n, o]) => binomial(n, a) * binomial(n - a, b) * binomial(o, c),
        }
    }

    /// Which ends and vertices of the domain the basis function is drawn to, as bits: it vanishes on a face unless all of
    /// its bits are among the face's.
    ///
    /// Bits 0 and 1 stand for u = 0 and u = 1, 2 and 3 for v, 4 and 5 for w; over a tetrahedron bits 0 to 3 for the
    /// vertices; over a wedge bits 0 to 2 for the vertices, 3 and 4 for w = 0 and w = 1.
    pub(crate) fn support(self, [a, b, c]: [usize; 3]) -> u8 {
        let bit = |condition: bool, place: u8| u8::from(condition) << place;
        let ends = |index: usize, degree: usize| bit(index < degree, 0) | bit(index > 0, 1);
        match self {
            Self::Hexahedron([l, m, n]) => ends(a, l) | ends(b, m) << 2 | ends(c, n) << 4,
            Self::Tetrahedron(n) => bit(a > 0, 0) | bit(b > 0, 1) | bit(c > 0, 2) | bit(a + b + c < n, 3),
            Self::Wedge([n, o]) => bit(a > 0, 0) | bit(b > 0, 1) | bit(a + b < n, 2) | ends(c, o) << 3,
        }
    }
}
