//! What the certificate and the integrals say of a solid, in its own parameters.

use casteljau_geom::Interval;
use casteljau_shape::ControlPoint;

use crate::{
    BezierHexahedron, BezierTetrahedron, BezierWedge, DEFAULT_OPERATIONS, JacobianVerdict, MassProperties,
    SolidError, SolidNet, jacobian_verdict, mass_properties,
};

impl<P: ControlPoint> BezierHexahedron<P> {
    /// The solid as [`jacobian_verdict`], [`mass_properties`] and
    /// [`JacobianCoefficients`](crate::JacobianCoefficients) see it: its net over `[0, 1]³`.
    #[must_use]
    pub fn as_net(&self) -> SolidNet<'_, P> {
        SolidNet::Hexahedron { points: self.control_points(), degrees: self.degrees() }
    }

    /// Whether the Jacobian is positive over the whole solid, proven; see [`jacobian_verdict`]. Parameters and values are
    /// those of the solid's intervals; in the names of corners, edges and faces 0 and 1 are their ends.
    ///
    /// ```
    /// use casteljau_solid::{Axis, Hexahedron, JacobianVerdict};
    /// let cube = Hexahedron::unit_cube();
    /// assert_eq!(cube.jacobian_verdict()?, JacobianVerdict::Positive);
    /// let mirrored = cube.reversed(Axis::U).jacobian_verdict()?;
    /// assert!(matches!(mirrored, JacobianVerdict::Invalid { value: -1.0, .. }));
    /// # Ok::<(), casteljau_solid::SolidError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`jacobian_verdict`].
    pub fn jacobian_verdict(&self) -> Result<JacobianVerdict, SolidError> {
        let verdict = jacobian_verdict(&self.as_net(), DEFAULT_OPERATIONS)?;
        Ok(over(self.intervals(), verdict))
    }

    /// Volume, centroid and second moments; see [`mass_properties`].
    ///
    /// # Errors
    /// Those of [`mass_properties`].
    pub fn mass_properties(&self, relative: f64) -> Result<MassProperties, SolidError> {
        mass_properties(&self.as_net(), relative)
    }
}

impl<P: ControlPoint> BezierTetrahedron<P> {
    /// The solid as [`jacobian_verdict`] and [`mass_properties`] see it.
    #[must_use]
    pub fn as_net(&self) -> SolidNet<'_, P> {
        SolidNet::Tetrahedron { points: self.control_points(), degree: self.degree() }
    }

    /// Whether the Jacobian is positive over the whole solid, proven; see [`jacobian_verdict`].
    ///
    /// # Errors
    /// Those of [`jacobian_verdict`].
    pub fn jacobian_verdict(&self) -> Result<JacobianVerdict, SolidError> {
        jacobian_verdict(&self.as_net(), DEFAULT_OPERATIONS)
    }

    /// Volume, centroid and second moments; see [`mass_properties`].
    ///
    /// # Errors
    /// Those of [`mass_properties`].
    pub fn mass_properties(&self, relative: f64) -> Result<MassProperties, SolidError> {
        mass_properties(&self.as_net(), relative)
    }
}

impl<P: ControlPoint> BezierWedge<P> {
    /// The solid as [`jacobian_verdict`] and [`mass_properties`] see it: its net over the height `[0, 1]`.
    #[must_use]
    pub fn as_net(&self) -> SolidNet<'_, P> {
        SolidNet::Wedge { points: self.control_points(), degrees: self.degrees() }
    }

    /// Whether the Jacobian is positive over the whole solid, proven; see [`jacobian_verdict`] and
    /// [`BezierHexahedron::jacobian_verdict`].
    ///
    /// # Errors
    /// Those of [`jacobian_verdict`].
    pub fn jacobian_verdict(&self) -> Result<JacobianVerdict, SolidError> {
        let verdict = jacobian_verdict(&self.as_net(), DEFAULT_OPERATIONS)?;
        Ok(over([Interval::UNIT, Interval::UNIT, self.height()], verdict))
    }

    /// Volume, centroid and second moments; see [`mass_properties`].
    ///
    /// # Errors
    /// Those of [`mass_properties`].
    pub fn mass_properties(&self, relative: f64) -> Result<MassProperties, SolidError> {
        mass_properties(&self.as_net(), relative)
    }
}

/// From parameters on `[0, 1]` to those of intervals, by which the Jacobian is divided.
fn over(intervals: [Interval; 3], verdict: JacobianVerdict) -> JacobianVerdict {
    if intervals == [Interval::UNIT; 3] {
        return verdict;
    }
    let global = |at: [f64; 3]| std::array::from_fn(|axis| intervals[axis].at(at[axis]));
    let by_volume = |value: f64| intervals.iter().fold(value, |value, interval| value / interval.length());
    match verdict {
        JacobianVerdict::Invalid { witness, value } => {
            // Negative stays negative, whatever the size.
            let nearest = if value < 0.0 { -f64::MIN_POSITIVE } else { 0.0 };
            let value = by_volume(value).clamp(f64::MIN, nearest);
            JacobianVerdict::Invalid { witness: global(witness), value }
        }
        JacobianVerdict::Undecided { near, least, largest } => JacobianVerdict::Undecided {
            near: global(near),
            least: by_volume(least),
            largest: by_volume(largest),
        },
        sign => sign,
    }
}
