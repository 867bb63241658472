//! The fields of triangles.

use casteljau_shape::bernstein::simplex_count;
use serde::Deserialize;

use super::Fields;
use super::net::{check_degree, flat, net};
use crate::TriangleRecord;
use crate::model::Shape;
use crate::place::Step;
use crate::record::Fault;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Triangle {
    #[serde(rename = "kind")]
    _kind: String,
    name: Option<String>,
    degree: usize,
    control_points: Option<Vec<[f64; 3]>>,
    weights: Option<Vec<f64>>,
    homogeneous: Option<Vec<[f64; 4]>>,
}

impl Fields for Triangle {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        let degree = self.degree;
        check_degree(degree, &[Step::Field("degree")])?;
        let expected = simplex_count::<3>(degree);
        let net = net(
            flat("control_points", self.control_points, degree, expected)?,
            flat("weights", self.weights, degree, expected)?,
            flat("homogeneous", self.homogeneous, degree, expected)?,
        )?;
        Ok(Shape::Triangle(TriangleRecord { degree, net }))
    }
}
