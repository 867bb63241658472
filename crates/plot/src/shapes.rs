//! What can be drawn beside GB patches: curves, patches and triangles, all in rational Bernstein form.

use casteljau_geom::glam::{DVec3, DVec4, Vec4Swizzles};
use casteljau_shape::{
    Curve, Patch, PowerCurve, PowerPatch, RationalCurve, RationalPatch, RationalTriangle, ShapeError,
    Triangle,
};

/// A curve to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveShape(pub(crate) RationalCurve);

/// A surface to draw.
#[derive(Clone, Debug, PartialEq)]
pub enum SurfaceShape {
    /// A tensor-product patch.
    Patch(RationalPatch),
    /// A triangle.
    Triangle(RationalTriangle),
}

impl From<&Curve> for CurveShape {
    fn from(curve: &Curve) -> Self {
        Self(curve.clone().into())
    }
}

impl From<&RationalCurve> for CurveShape {
    fn from(curve: &RationalCurve) -> Self {
        Self(curve.clone())
    }
}

impl TryFrom<&PowerCurve> for CurveShape {
    type Error = ShapeError;

    /// The curve with the control points that it has over its interval.
    fn try_from(curve: &PowerCurve) -> Result<Self, ShapeError> {
        Ok(Self(curve.to_bezier()?.into()))
    }
}

impl From<&Patch> for SurfaceShape {
    fn from(patch: &Patch) -> Self {
        Self::Patch(patch.clone().into())
    }
}

impl From<&RationalPatch> for SurfaceShape {
    fn from(patch: &RationalPatch) -> Self {
        Self::Patch(patch.clone())
    }
}

impl From<&Triangle> for SurfaceShape {
    fn from(triangle: &Triangle) -> Self {
        Self::Triangle(triangle.clone().into())
    }
}

impl From<&RationalTriangle> for SurfaceShape {
    fn from(triangle: &RationalTriangle) -> Self {
        Self::Triangle(triangle.clone())
    }
}

impl TryFrom<&PowerPatch> for SurfaceShape {
    type Error = ShapeError;

    /// The patch with the control points that it has over its rectangle.
    fn try_from(patch: &PowerPatch) -> Result<Self, ShapeError> {
        Ok(Self::Patch(patch.to_bezier()?.into()))
    }
}

/// The point in space; `None` at infinity.
pub(crate) fn in_space(p: DVec4) -> Option<DVec3> {
    let point = p.xyz() / p.w;
    point.is_finite().then_some(point)
}
