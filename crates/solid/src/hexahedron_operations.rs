//! The same hexahedron with other control points: turned, elevated, reduced, cut; its faces, edges and sections.

use casteljau_bernstein::{
    BernsteinError, MAX_DEGREE, elevate_tensor, reduce_along, restrict_tensor, subdivide_along, value,
};
use casteljau_geom::Interval;
use casteljau_shape::control_net::{check_points, distance_bound};
use casteljau_shape::{BezierCurve, BezierPatch, ControlPoint, Parameters};

use crate::{BezierHexahedron, SolidError};

/// A parameter of a hexahedron.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Axis {
    /// The first.
    U,
    /// The second.
    V,
    /// The third.
    W,
}

impl Axis {
    /// All three.
    pub const ALL: [Self; 3] = [Self::U, Self::V, Self::W];

    /// The other two, in their order.
    #[must_use]
    pub const fn others(self) -> [Self; 2] {
        match self {
            Self::U => [Self::V, Self::W],
            Self::V => [Self::U, Self::W],
            Self::W => [Self::U, Self::V],
        }
    }

    const fn index(self) -> usize {
        self as usize
    }
}

/// One of the six faces of a hexahedron, where a parameter is at an end of its interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct HexahedronFace {
    /// The parameter that is constant.
    pub axis: Axis,
    /// Whether it is at the end of its interval, not at the start.
    pub at_end: bool,
}

impl HexahedronFace {
    /// All six: u at its start and end, then v, then w.
    pub const ALL: [Self; 6] = [
        Self { axis: Axis::U, at_end: false },
        Self { axis: Axis::U, at_end: true },
        Self { axis: Axis::V, at_end: false },
        Self { axis: Axis::V, at_end: true },
        Self { axis: Axis::W, at_end: false },
        Self { axis: Axis::W, at_end: true },
    ];

    /// Whether the normal of the face's patch points out of a solid with a positive Jacobian.
    ///
    /// The patch has the other two parameters in their order, so that its normal points along the rising parameter for
    /// u and w, against it for v.
    #[must_use]
    pub const fn is_outward(self) -> bool {
        self.at_end != matches!(self.axis, Axis::V)
    }
}

impl<P: ControlPoint> BezierHexahedron<P> {
    /// The patch on which a parameter is constant; the other two, in their order, are the patch's u and v.
    ///
    /// Error of each control point: at most 4(d+2)·u times its combination of absolute values, d being the degree
    /// along `axis`; exact to the bit at the ends of the interval.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`](casteljau_shape::ShapeError::Parameter) where t is not finite,
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where a far continuation leaves the range,
    /// [`ShapeError::NoWeight`](casteljau_shape::ShapeError::NoWeight) where all weights on the patch vanish.
    pub fn patch_at(&self, axis: Axis, t: f64) -> Result<BezierPatch<P>, SolidError> {
        Parameters::Curve(t).finite()?;
        let [first, second] = axis.others().map(Axis::index);
        let (degrees, intervals) = (self.degrees(), self.intervals());
        let points = self.section(axis.index(), intervals[axis.index()].local(t));
        let patch = BezierPatch::from_net(
            [intervals[first], intervals[second]],
            [degrees[first], degrees[second]],
            points,
        )?;
        Ok(patch)
    }

    /// The curve along `axis` on which the other two parameters, in their order, are constant. Otherwise as
    /// [`patch_at`](Self::patch_at).
    ///
    /// # Errors
    /// Those of [`patch_at`](Self::patch_at).
    pub fn curve_at(&self, axis: Axis, others: [f64; 2]) -> Result<BezierCurve<P>, SolidError> {
        let patch = self.patch_at(axis.others()[1], others[1])?;
        // What is left of the others is the first or, along w, the second parameter of the patch.
        Ok(match axis {
            Axis::U => patch.curve_at_v(others[0]),
            Axis::V | Axis::W => patch.curve_at_u(others[0]),
        })
    }

    /// A face, its control points those of the net to the bit.
    ///
    /// ```
    /// use casteljau_solid::{Hexahedron, HexahedronFace, geom::glam::DVec3};
    /// for face in HexahedronFace::ALL {
    ///     let normal = Hexahedron::unit_cube().face(face)?.normal(0.5, 0.5).unwrap();
    ///     let outward = if face.is_outward() { normal } else { -normal };
    ///     assert_eq!(outward.element_sum(), if face.at_end { 1.0 } else { -1.0 });
    /// }
    /// # Ok::<(), casteljau_solid::SolidError>(())
    /// ```
    ///
    /// # Errors
    /// [`ShapeError::NoWeight`](casteljau_shape::ShapeError::NoWeight) where all its weights are zero.
    pub fn face(&self, face: HexahedronFace) -> Result<BezierPatch<P>, SolidError> {
        let interval = self.intervals()[face.axis.index()];
        self.patch_at(face.axis, if face.at_end { interval.end() } else { interval.start() })
    }

    /// The edge along `axis` where each of the other two parameters, in their order, is at the start or the end of its
    /// interval; control points to the bit.
    ///
    /// # Errors
    /// [`ShapeError::NoWeight`](casteljau_shape::ShapeError::NoWeight) where all its weights are zero.
    pub fn edge(&self, axis: Axis, at_end: [bool; 2]) -> Result<BezierCurve<P>, SolidError> {
        let [first, second] = axis.others().map(|other| self.intervals()[other.index()]);
        let end = |interval: Interval, at_end| if at_end { interval.end() } else { interval.start() };
        self.curve_at(axis, [end(first, at_end[0]), end(second, at_end[1])])
    }

    /// The net of the section where local parameter `axis` is x.
    fn section(&self, axis: usize, x: f64) -> Vec<P> {
        let [l, m, n] = self.degrees();
        let strides = [(m + 1) * (n + 1), n + 1, 1];
        let counts = [l + 1, m + 1, n + 1];
        let [first, second] = Axis::ALL[axis].others().map(Axis::index);
        let mut line = Vec::with_capacity(counts[axis]);
        let mut point = |start: usize| {
            line.clear();
            line.extend(self.control_points().iter().skip(start).step_by(strides[axis]).take(counts[axis]));
            value(&line, x)
        };
        let starts = (0..counts[first])
            .flat_map(|i| (0..counts[second]).map(move |j| i * strides[first] + j * strides[second]));
        starts.map(&mut point).collect()
    }

    /// The same solid with a parameter run backwards; the Jacobian changes its sign.
    #[must_use]
    pub fn reversed(&self, axis: Axis) -> Self {
        let [_, m, n] = self.degrees();
        let layer = [(m + 1) * (n + 1), n + 1, 1][axis.index()];
        let slab = layer * (self.degrees()[axis.index()] + 1);
        let slabs = self.control_points().chunks(slab);
        let points = slabs.flat_map(|slab| slab.chunks(layer).rev().flatten()).copied().collect();
        Self::checked(self.intervals(), self.degrees(), points)
    }

    /// The same solid with its parameters in another order: parameter a of the new one is `axes[a]` of this one. An odd
    /// permutation changes the sign of the Jacobian.
    ///
    /// # Errors
    /// [`SolidError::Axes`] unless these are U, V and W in some order.
    pub fn permuted(&self, axes: [Axis; 3]) -> Result<Self, SolidError> {
        let order = axes.map(Axis::index);
        if (0..3).any(|axis| !order.contains(&axis)) {
            return Err(SolidError::Axes { axes });
        }
        let [_, m, n] = self.degrees();
        let strides = order.map(|axis| [(m + 1) * (n + 1), n + 1, 1][axis]);
        let degrees = order.map(|axis| self.degrees()[axis]);
        let mut points = Vec::with_capacity(self.control_points().len());
        for i in 0..=degrees[0] {
            for j in 0..=degrees[1] {
                let start = i * strides[0] + j * strides[1];
                points.extend((0..=degrees[2]).map(|k| self.control_points()[start + k * strides[2]]));
            }
        }
        Ok(Self::checked(order.map(|axis| self.intervals()[axis]), degrees, points))
    }

    /// The same solid with its degrees raised by `by`.
    ///
    /// Error of each control point: at most 4(l+m+n+Σby+2)·u times its convex combination of absolute values; the
    /// corners are kept to the bit.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] where a degree becomes larger than [`MAX_DEGREE`].
    pub fn elevated(&self, by: [usize; 3]) -> Result<Self, SolidError> {
        let degrees = self.degrees();
        let to: [usize; 3] = std::array::from_fn(|axis| degrees[axis].saturating_add(by[axis]));
        if let Some(&degree) = to.iter().find(|&&d| d > MAX_DEGREE) {
            return Err(BernsteinError::Degree { degree, limit: MAX_DEGREE }.into());
        }
        let mut points = vec![P::ZERO; to.iter().map(|d| d + 1).product()];
        elevate_tensor(self.control_points(), degrees, to, &mut points)?;
        Ok(Self::checked(self.intervals(), to, points))
    }

    /// A near solid of lower degrees with the same corners, and a bound on its distance from this one at equal
    /// parameters, over its box, in model units.
    ///
    /// The lines along w, then v, then u are replaced by the nearest ones with the same ends; see
    /// [`BezierCurve::reduced`]. A solid that was elevated comes back as it was.
    ///
    /// # Errors
    /// [`SolidError::Kernel`] where a degree is above that of the solid,
    /// [`ShapeError::Unbounded`](casteljau_shape::ShapeError::Unbounded) for a rational solid whose weights, or whose
    /// reduced weights, do not all have one sign.
    pub fn reduced(&self, degrees: [usize; 3]) -> Result<(Self, f64), SolidError> {
        for (from, to) in self.degrees().into_iter().zip(degrees) {
            if to > from {
                return Err(BernsteinError::ReducedDegree { from, to }.into());
            }
        }
        let (mut from, mut points, mut error) = (self.degrees(), self.control_points().to_vec(), 0.0);
        for axis in [2, 1, 0] {
            let mut lower = from;
            lower[axis] = degrees[axis];
            let mut out = vec![P::ZERO; lower.iter().map(|d| d + 1).product()];
            let mut work = vec![P::ZERO; from[axis] + 1];
            error += reduce_along(&points, from, axis, degrees[axis], &mut out, &mut work)?;
            (from, points) = (lower, out);
        }
        let reduced = Self::checked(self.intervals(), degrees, points);
        if !P::RATIONAL {
            return Ok((reduced, error));
        }
        let by = std::array::from_fn(|axis| self.degrees()[axis] - degrees[axis]);
        let raised = reduced.elevated(by)?;
        let total = self.degrees().iter().sum();
        let error = distance_bound(self.control_points(), raised.control_points(), total)?;
        Ok((reduced, error))
    }

    /// The solid below and that above the parameter t along an axis, each on its own `[0, 1]` there; they share the
    /// patch at t to the bit. The other intervals stay.
    ///
    /// # Errors
    /// [`ShapeError::Parameter`](casteljau_shape::ShapeError::Parameter) where t is not finite,
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where a t far outside the interval makes
    /// points out of range.
    pub fn split(&self, axis: Axis, t: f64) -> Result<(Self, Self), SolidError> {
        Parameters::Curve(t).finite()?;
        let mut intervals = self.intervals();
        let x = intervals[axis.index()].local(t);
        intervals[axis.index()] = Interval::UNIT;
        let mut below = vec![P::ZERO; self.control_points().len()];
        let mut above = below.clone();
        subdivide_along(self.control_points(), self.degrees(), axis.index(), x, &mut below, &mut above)?;
        check_points(&below)?;
        check_points(&above)?;
        let part = |points| Self::checked(intervals, self.degrees(), points);
        Ok((part(below), part(above)))
    }

    /// The part of the solid over other intervals, which keeps its parameters: `part.point(at)` is `whole.point(at)`.
    ///
    /// The intervals may reach beyond those of the solid, which is then continued. Error of each control point: at most
    /// 4(l+m+n+2)·u times its combination of absolute values.
    ///
    /// # Errors
    /// [`ShapeError::Coordinate`](casteljau_shape::ShapeError::Coordinate) where a far continuation makes points out of
    /// range.
    pub fn restricted(&self, intervals: [Interval; 3]) -> Result<Self, SolidError> {
        let mut points = vec![P::ZERO; self.control_points().len()];
        let part = std::array::from_fn(|axis| {
            let own = self.intervals()[axis];
            [own.local(intervals[axis].start()), own.local(intervals[axis].end())]
        });
        restrict_tensor(self.control_points(), self.degrees(), part, &mut points)?;
        check_points(&points)?;
        Ok(Self::checked(intervals, self.degrees(), points))
    }
}
