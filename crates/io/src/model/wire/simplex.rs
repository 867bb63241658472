//! The fields of triangles and tetrahedra.

use casteljau_shape::bernstein::simplex_count;
use serde::Deserialize;

use super::Fields;
use super::net::{check_degree, flat, net};
use crate::model::Shape;
use crate::place::Step;
use crate::record::Fault;
use crate::{NetRecord, TetrahedronRecord, TriangleRecord};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Simplex<const V: usize> {
    #[serde(rename = "kind")]
    _kind: String,
    name: Option<String>,
    degree: usize,
    control_points: Option<Vec<[f64; 3]>>,
    weights: Option<Vec<f64>>,
    homogeneous: Option<Vec<[f64; 4]>>,
}

impl<const V: usize> Simplex<V> {
    fn into_net(self) -> Result<(usize, NetRecord), Fault> {
        let degree = self.degree;
        check_degree(degree, &[Step::Field("degree")])?;
        let expected = simplex_count::<V>(degree);
        let net = net(
            flat("control_points", self.control_points, degree, expected)?,
            flat("weights", self.weights, degree, expected)?,
            flat("homogeneous", self.homogeneous, degree, expected)?,
        )?;
        Ok((degree, net))
    }
}

impl Fields for Simplex<3> {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        let (degree, net) = self.into_net()?;
        Ok(Shape::Triangle(TriangleRecord { degree, net }))
    }
}

impl Fields for Simplex<4> {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        let (degree, net) = self.into_net()?;
        Ok(Shape::Tetrahedron(TetrahedronRecord { degree, net }))
    }
}
