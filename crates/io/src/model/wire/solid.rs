//! The fields of hexahedra and wedges.

use serde::Deserialize;

use super::Fields;
use super::net::{Level, check_degree, net, rows, slabs};
use crate::model::Shape;
use crate::place::Step;
use crate::record::Fault;
use crate::shape_record::UNIT;
use crate::{HexahedronRecord, WedgeRecord};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Hexahedron {
    #[serde(rename = "kind")]
    _kind: String,
    name: Option<String>,
    degree: [usize; 3],
    control_points: Option<Vec<Vec<Vec<[f64; 3]>>>>,
    weights: Option<Vec<Vec<Vec<f64>>>>,
    homogeneous: Option<Vec<Vec<Vec<[f64; 4]>>>>,
    intervals: Option<[[f64; 2]; 3]>,
}

impl Fields for Hexahedron {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        let degrees = self.degree;
        check_degrees(&degrees)?;
        let net = net(
            slabs("control_points", self.control_points, degrees)?,
            slabs("weights", self.weights, degrees)?,
            slabs("homogeneous", self.homogeneous, degrees)?,
        )?;
        let intervals = self.intervals.unwrap_or([UNIT; 3]);
        Ok(Shape::Hexahedron(HexahedronRecord { degrees, net, intervals }))
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Wedge {
    #[serde(rename = "kind")]
    _kind: String,
    name: Option<String>,
    degree: [usize; 2],
    control_points: Option<Vec<Vec<[f64; 3]>>>,
    weights: Option<Vec<Vec<f64>>>,
    homogeneous: Option<Vec<Vec<[f64; 4]>>>,
    interval: Option<[f64; 2]>,
}

impl Fields for Wedge {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        let degrees @ [n, o] = self.degree;
        check_degrees(&degrees)?;
        let outer = Level::columns(n);
        let net = net(
            rows("control_points", self.control_points, outer, o)?,
            rows("weights", self.weights, outer, o)?,
            rows("homogeneous", self.homogeneous, outer, o)?,
        )?;
        Ok(Shape::Wedge(WedgeRecord { degrees, net, interval: self.interval.unwrap_or(UNIT) }))
    }
}

fn check_degrees(degrees: &[usize]) -> Result<(), Fault> {
    let mut degrees = degrees.iter().enumerate();
    degrees
        .try_for_each(|(index, &degree)| check_degree(degree, &[Step::Field("degree"), Step::Index(index)]))
}
