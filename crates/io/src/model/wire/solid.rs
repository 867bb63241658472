//! The fields of solids.

use casteljau_shape::bernstein::simplex_count;
use serde::Deserialize;

use super::Fields;
use super::net::{Level, check_degree, flat, net, rows, slabs};
use crate::model::Shape;
use crate::place::Step;
use crate::record::Fault;
use crate::shape_record::UNIT;
use crate::{HexahedronRecord, TetrahedronRecord, WedgeRecord};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Tetrahedron {
    #[serde(rename = "kind")]
    _kind: String,
    name: Option<String>,
    degree: usize,
    control_points: Option<Vec<[f64; 3]>>,
    weights: Option<Vec<f64>>,
    homogeneous: Option<Vec<[f64; 4]>>,
}

impl Fields for Tetrahedron {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        let degree = self.degree;
        check_degree(degree, &[Step::Field("degree")])?;
        let expected = simplex_count::<4>(degree);
        let net = net(
            flat("control_points", self.control_points, degree, expected)?,
            flat("weights", self.weights, degree, expected)?,
            flat("homogeneous", self.homogeneous, degree, expected)?,
        )?;
        Ok(Shape::Tetrahedron(TetrahedronRecord { degree, net }))
    }
}

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
