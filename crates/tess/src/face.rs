//! The surfaces that a mesh can be made of.

use casteljau_gb::ConcavePatch;
use casteljau_shape::{Patch, PowerPatch, RationalPatch, RationalTriangle, Triangle};

/// A surface of a model, of any kind.
///
/// Sides are numbered from 0, counter-clockwise seen from the tip of the normal `∂u × ∂v`:
/// - of a rectangle `[a, b] × [c, d]`: 0 is v = c, 1 is u = b, 2 is v = d, 3 is u = a;
/// - of a triangle as by [`edge`](casteljau_shape::BezierTriangle::edge): side i lies across from vertex i, so that 0
///   is λ₁ = 0, 1 is λ₂ = 0, 2 is λ₃ = 0;
/// - of a GB patch: as its ribbons.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Face<'a> {
    /// A concave GB patch.
    Gb(&'a ConcavePatch),
    /// A tensor-product patch.
    Patch(&'a Patch),
    /// A rational tensor-product patch.
    RationalPatch(&'a RationalPatch),
    /// A patch in the power basis. It is brought to Bernstein form first, which costs rounding: its sides
    /// meet those of others where the converted control points are equal.
    PowerPatch(&'a PowerPatch),
    /// A Bézier triangle.
    Triangle(&'a Triangle),
    /// A rational Bézier triangle.
    RationalTriangle(&'a RationalTriangle),
}

/// Whatever is a [`Face`]: lists of one kind of shape are tessellated as they are, mixed ones as lists of faces.
///
/// ```
/// use casteljau_shape::{Patch, Triangle, geom::glam::{DVec3, dvec3}};
/// use casteljau_tess::{Face, TessellationOptions, no_progress, tessellate};
/// // A square and a triangle on its edge from (1, 1) to (1, 0).
/// let square = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, dvec3(1.0, 1.0, 0.0)])?;
/// let triangle = Triangle::new(1, [dvec3(1.0, 1.0, 0.0), DVec3::X, dvec3(2.0, 0.0, 0.0)])?;
/// let faces = [Face::from(&square), Face::from(&triangle)];
/// let (mesh, report) = tessellate(&faces, &TessellationOptions::resolution(4), &mut no_progress)?;
/// assert_eq!(report.open_sides.len(), 5);
/// assert!((mesh.area()? - 1.5).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait AsFace {
    /// The shape as a face.
    fn as_face(&self) -> Face<'_>;
}

impl AsFace for Face<'_> {
    fn as_face(&self) -> Face<'_> {
        *self
    }
}

impl<T: AsFace + ?Sized> AsFace for &T {
    fn as_face(&self) -> Face<'_> {
        (**self).as_face()
    }
}

macro_rules! faces {
    ($($variant:ident($shape:ty)),* $(,)?) => {$(
        impl<'a> From<&'a $shape> for Face<'a> {
            fn from(shape: &'a $shape) -> Self {
                Self::$variant(shape)
            }
        }

        impl AsFace for $shape {
            fn as_face(&self) -> Face<'_> {
                Face::$variant(self)
            }
        }
    )*};
}

faces!(
    Gb(ConcavePatch),
    Patch(Patch),
    RationalPatch(RationalPatch),
    PowerPatch(PowerPatch),
    Triangle(Triangle),
    RationalTriangle(RationalTriangle),
);
