//! The fields of curves.

use serde::Deserialize;

use super::Fields;
use super::net::{check_degree, flat, net};
use crate::model::Shape;
use crate::place::Step;
use crate::record::Fault;
use crate::shape_record::UNIT;
use crate::{CurveRecord, PowerCurveRecord, Reason};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Curve {
    kind: Option<String>,
    name: Option<String>,
    degree: usize,
    control_points: Option<Vec<[f64; 3]>>,
    weights: Option<Vec<f64>>,
    homogeneous: Option<Vec<[f64; 4]>>,
    interval: Option<[f64; 2]>,
}

impl Fields for Curve {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        self.into_record().map(Shape::Curve)
    }
}

impl Curve {
    /// The word for it.
    pub(super) fn kind(&self) -> Option<&str> {
        self.kind.as_deref()
    }

    pub(super) fn into_record(self) -> Result<CurveRecord, Fault> {
        let degree = self.degree;
        check_degree(degree, &[Step::Field("degree")])?;
        let net = net(
            flat("control_points", self.control_points, degree, degree + 1)?,
            flat("weights", self.weights, degree, degree + 1)?,
            flat("homogeneous", self.homogeneous, degree, degree + 1)?,
        )?;
        Ok(CurveRecord { net, interval: self.interval.unwrap_or(UNIT) })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PowerCurve {
    #[serde(rename = "kind")]
    _kind: String,
    name: Option<String>,
    coefficients: Vec<[f64; 3]>,
    interval: Option<[f64; 2]>,
}

impl Fields for PowerCurve {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        if self.coefficients.is_empty() {
            return Err((vec![Step::Field("coefficients")], Reason::NoCoefficients));
        }
        let interval = self.interval.unwrap_or(UNIT);
        Ok(Shape::PowerCurve(PowerCurveRecord { coefficients: self.coefficients, interval }))
    }
}
