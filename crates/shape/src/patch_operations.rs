//! The same patch with other control points: swapped, reversed, elevated, cut; and the curves on it.

use casteljau_bernstein::{
    BernsteinError, MAX_DEGREE, elevate_tensor, reduce_along, restrict_tensor, subdivide_along, value,
};
use casteljau_geom::Interval;

use crate::control_point::distance_bound;
use crate::error::check_points;
use crate::{BezierCurve, BezierPatch, ControlPoint, ShapeError};

/// One of the four edges of a patch over `[a, b] × [c, d]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PatchEdge {
    /// u = a, run through with v.
    UStart,
    /// u = b, run through with v.
    UEnd,
    /// v = c, run through with u.
    VStart,
    /// v = d, run through with u.
    VEnd,
}

impl PatchEdge {
    /// All four.
    pub const ALL: [Self; 4] = [Self::UStart, Self::UEnd, Self::VStart, Self::VEnd];
}

impl<P: ControlPoint> BezierPatch<P> {
    /// The iso-parameter curve `v ↦ S(u, v)`, of degree n over the interval of v.
    ///
    /// Error of each control point: at most 4(m+2)·u times its combination of absolute values; exact to the
    /// bit at the ends of the interval.
    #[must_use]
    pub fn curve_at_u(&self, u: f64) -> BezierCurve<P> {
        let (x, [_, n]) = (self.intervals()[0].local(u), self.degrees());
        let mut column = Vec::with_capacity(self.degrees()[0] + 1);
        let point = |j: usize| {
            column.clear();
            column.extend(self.control_points().iter().skip(j).step_by(n + 1));
            value(&column, x)
        };
        BezierCurve::checked(self.intervals()[1], (0..=n).map(point).collect())
    }

    /// The iso-parameter curve `u ↦ S(u, v)`, of degree m over the interval of u. Error as for
    /// [`curve_at_u`](Self::curve_at_u).
    #[must_use]
    pub fn curve_at_v(&self, v: f64) -> BezierCurve<P> {
        let (y, [_, n]) = (self.intervals()[1].local(v), self.degrees());
        let points = self.control_points().chunks(n + 1).map(|row| value(row, y)).collect();
        BezierCurve::checked(self.intervals()[0], points)
    }

    /// A boundary curve, its control points those of the net to the bit.
    ///
    /// ```
    /// use casteljau_shape::{Patch, PatchEdge, geom::glam::DVec3};
    /// let square = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0)])?;
    /// assert_eq!(square.edge(PatchEdge::VStart).control_points(), [DVec3::ZERO, DVec3::X]);
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    #[must_use]
    pub fn edge(&self, edge: PatchEdge) -> BezierCurve<P> {
        let [u, v] = self.intervals();
        match edge {
            PatchEdge::UStart => self.curve_at_u(u.start()),
            PatchEdge::UEnd => self.curve_at_u(u.end()),
            PatchEdge::VStart => self.curve_at_v(v.start()),
            PatchEdge::VEnd => self.curve_at_v(v.end()),
        }
    }

    /// The same patch with u and v exchanged; its normal is turned around.
    #[must_use]
    pub fn swapped(&self) -> Self {
        let ([m, n], [u, v]) = (self.degrees(), self.intervals());
        let points = (0..=n).flat_map(|j| self.control_points().iter().skip(j).step_by(n + 1)).copied();
        Self::checked([v, u], [n, m], points.collect())
    }

    /// The same patch with u run backwards; its normal is turned around.
    #[must_use]
    pub fn reversed_u(&self) -> Self {
        let rows = self.control_points().chunks(self.degrees()[1] + 1).rev();
        Self::checked(self.intervals(), self.degrees(), rows.flatten().copied().collect())
    }

    /// The same patch with v run backwards; its normal is turned around.
    #[must_use]
    pub fn reversed_v(&self) -> Self {
        let rows = self.control_points().chunks(self.degrees()[1] + 1);
        Self::checked(
            self.intervals(),
            self.degrees(),
            rows.flat_map(|row| row.iter().rev()).copied().collect(),
        )
    }

    /// The same patch with its degrees raised by `by`.
    ///
    /// Error of each control point: at most 4(m+n+Σby+2)·u times its convex combination of absolute values; the
    /// corners are kept to the bit.
    ///
    /// # Errors
    /// [`ShapeError::Kernel`] where a degree becomes larger than [`MAX_DEGREE`].
    pub fn elevated(&self, by: [usize; 2]) -> Result<Self, ShapeError> {
        let [m, n] = self.degrees();
        let to = [m.saturating_add(by[0]), n.saturating_add(by[1])];
        if let Some(&degree) = to.iter().find(|&&d| d > MAX_DEGREE) {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE }.into());
        }
        let mut points = vec![P::ZERO; (to[0] + 1) * (to[1] + 1)];
        elevate_tensor(self.control_points(), [m, n], to, &mut points)?;
        Ok(Self::checked(self.intervals(), to, points))
    }

    /// A near patch of lower degrees with the same corners, and a bound on its distance from this one at equal
    /// parameters, over its rectangle, in model units.
    ///
    /// Each row and then each column is replaced by the nearest one with the same ends; see
    /// [`BezierCurve::reduced`]. A patch that was elevated comes back as it was.
    ///
    /// # Errors
    /// [`ShapeError::Kernel`] where a degree is above that of the patch, [`ShapeError::Unbounded`] for a
    /// rational patch whose weights, or whose reduced weights, do not all have one sign.
    pub fn reduced(&self, degrees: [usize; 2]) -> Result<(Self, f64), ShapeError> {
        let [m, n] = self.degrees();
        for (from, to) in [(m, degrees[0]), (n, degrees[1])] {
            if to > from {
                return Err(BernsteinError::ReducedDegree { from, to }.into());
            }
        }
        let mut work = vec![P::ZERO; m.max(n) + 1];
        let mut middle = vec![P::ZERO; (m + 1) * (degrees[1] + 1)];
        let first = reduce_along(self.control_points(), [m, n], 1, degrees[1], &mut middle, &mut work[..=n])?;
        let mut points = vec![P::ZERO; (degrees[0] + 1) * (degrees[1] + 1)];
        let second = reduce_along(&middle, [m, degrees[1]], 0, degrees[0], &mut points, &mut work[..=m])?;
        let reduced = Self::checked(self.intervals(), degrees, points);
        if !P::RATIONAL {
            return Ok((reduced, first + second));
        }
        let raised = reduced.elevated([m - degrees[0], n - degrees[1]])?;
        let error = distance_bound(self.control_points(), raised.control_points(), m + n)?;
        Ok((reduced, error))
    }

    /// The patch over `[a, u]` and that over `[u, b]`, each on its own `[0, 1]`; they share the curve at `u` to
    /// the bit. The interval of v stays.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`] where `u` is not finite, [`ShapeError::Coordinate`] where a `u` far outside
    /// the interval makes points out of range.
    pub fn split_u(&self, u: f64) -> Result<(Self, Self), ShapeError> {
        self.split(0, u)
    }

    /// The patch over `[c, v]` and that over `[v, d]`. Otherwise as [`split_u`](Self::split_u).
    ///
    /// # Errors
    /// Those of [`split_u`](Self::split_u).
    pub fn split_v(&self, v: f64) -> Result<(Self, Self), ShapeError> {
        self.split(1, v)
    }

    fn split(&self, axis: usize, t: f64) -> Result<(Self, Self), ShapeError> {
        if !t.is_finite() {
            return Err(ShapeError::Parameter { value: t });
        }
        let mut intervals = self.intervals();
        let local = intervals[axis].local(t);
        intervals[axis] = Interval::UNIT;
        let mut left = vec![P::ZERO; self.control_points().len()];
        let mut right = left.clone();
        subdivide_along(self.control_points(), self.degrees(), axis, local, &mut left, &mut right)?;
        check_points(&left)?;
        check_points(&right)?;
        let part = |points| Self::checked(intervals, self.degrees(), points);
        Ok((part(left), part(right)))
    }

    /// The part of the patch over other intervals, which keeps its parameters: `part.point(u, v)` is
    /// `whole.point(u, v)`.
    ///
    /// The intervals may reach beyond those of the patch, which is then continued. Error of each control point:
    /// at most 4(m+n+2)·u times its combination of absolute values.
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`] where a far continuation makes points out of range.
    pub fn restricted(&self, intervals: [Interval; 2]) -> Result<Self, ShapeError> {
        let mut points = vec![P::ZERO; self.control_points().len()];
        let part = [0, 1].map(|axis| {
            let own = self.intervals()[axis];
            [own.local(intervals[axis].start()), own.local(intervals[axis].end())]
        });
        restrict_tensor(self.control_points(), self.degrees(), part, &mut points)?;
        check_points(&points)?;
        Ok(Self::checked(intervals, self.degrees(), points))
    }
}
