//! What the mesher asks of a surface.

use std::borrow::Cow::{Borrowed, Owned};

use casteljau_domain::{Orientation, Polygon};
use casteljau_gb::{ConcavePatch, GbError, Location, SampleSet};
use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_shape::ShapeError;

use crate::charted::Charted;
use crate::poles::{refuse_in_patch, refuse_in_triangle};
use crate::{Face, TessError};

/// A surface over a polygon. Locations are those of the polygon.
pub(crate) trait Surface {
    /// The polygon, one side for each side that has a length.
    fn domain(&self) -> &Polygon;

    /// The number that side `side` of the polygon has in the shape.
    fn side_name(&self, side: usize) -> usize {
        side
    }

    /// Homogeneous control points of the curve along a side of the polygon, in its direction.
    fn side_net(&self, side: usize) -> Vec<DVec4>;

    /// Whether the outside is seen where the polygon runs clockwise.
    fn clockwise(&self) -> bool {
        self.domain().orientation() == Orientation::Clockwise
    }

    /// The largest absolute coordinate of a control point.
    fn largest(&self) -> f64;

    /// Points, and unit normals where wanted; a normal is zero where there is none.
    fn sample(
        &self,
        locations: &[Location],
        points: &mut [DVec3],
        normals: Option<&mut [DVec3]>,
    ) -> Result<(), Fault>;
}

/// Why a surface has no answer.
#[derive(Clone, Debug)]
pub(crate) enum Fault {
    Gb(GbError),
    Shape(ShapeError),
}

impl From<GbError> for Fault {
    fn from(error: GbError) -> Self {
        Self::Gb(error)
    }
}

impl From<ShapeError> for Fault {
    fn from(error: ShapeError) -> Self {
        Self::Shape(error)
    }
}

impl Fault {
    /// The error that says which surface it was.
    pub fn of(self, patch: usize) -> TessError {
        match self {
            Self::Gb(source) => TessError::Patch { patch, source },
            Self::Shape(source) => TessError::Shape { patch, source },
        }
    }
}

/// Prepares face number `index` for the mesher.
pub(crate) fn open(face: Face<'_>, index: usize) -> Result<Box<dyn Surface + '_>, TessError> {
    let wrong = |source: ShapeError| Fault::from(source).of(index);
    let domain = |source| TessError::Domain { patch: index, source };
    Ok(match face {
        Face::Gb(patch) => Box::new(patch),
        Face::Patch(patch) => Box::new(Charted::patch(Borrowed(patch)).map_err(domain)?),
        Face::RationalPatch(patch) => {
            refuse_in_patch(patch).map_err(wrong)?;
            Box::new(Charted::patch(Borrowed(patch)).map_err(domain)?)
        }
        Face::PowerPatch(patch) => {
            let patch = patch.to_bezier().map_err(wrong)?;
            Box::new(Charted::patch(Owned(patch)).map_err(domain)?)
        }
        Face::Triangle(triangle) => Box::new(Charted::triangle(Borrowed(triangle)).map_err(domain)?),
        Face::RationalTriangle(triangle) => {
            refuse_in_triangle(triangle).map_err(wrong)?;
            Box::new(Charted::triangle(Borrowed(triangle)).map_err(domain)?)
        }
    })
}

impl Surface for &ConcavePatch {
    fn domain(&self) -> &Polygon {
        (**self).domain()
    }

    fn side_net(&self, side: usize) -> Vec<DVec4> {
        self.ribbons()[side].row(0).iter().map(|p| p.extend(1.0)).collect()
    }

    fn largest(&self) -> f64 {
        let all = self.bounding_box();
        all.max.abs().max(all.min.abs()).max_element()
    }

    fn sample(
        &self,
        locations: &[Location],
        points: &mut [DVec3],
        normals: Option<&mut [DVec3]>,
    ) -> Result<(), Fault> {
        let Some(normals) = normals else {
            let samples = SampleSet::new(self.coordinates(), locations, 0)?;
            return Ok(self.evaluate_samples(&samples, points)?);
        };
        // On the outline the ribbons know the normal: derivatives of the coordinates are not needed there.
        let inside = |location: &Location| matches!(location, Location::Inside(_));
        let outline = locations.iter().position(inside).unwrap_or(locations.len());
        let (outline, inside) = locations.split_at(outline);
        let (outline_points, points) = points.split_at_mut(outline.len());
        let (outline_normals, normals) = normals.split_at_mut(outline.len());
        let samples = SampleSet::new(self.coordinates(), outline, 0)?;
        self.evaluate_samples(&samples, outline_points)?;
        for (normal, &location) in outline_normals.iter_mut().zip(outline) {
            *normal = self.normal_at(location).unwrap_or(DVec3::ZERO);
        }
        let samples = SampleSet::new(self.coordinates(), inside, 1)?;
        self.evaluate_sample_normals(&samples, points, normals)?;
        Ok(())
    }
}
