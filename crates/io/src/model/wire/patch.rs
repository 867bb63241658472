//! The fields of tensor-product patches.

use serde::Deserialize;

use super::Fields;
use super::net::{Level, check_degree, net, rows};
use crate::model::Shape;
use crate::place::Step;
use crate::record::Fault;
use crate::shape_record::UNIT;
use crate::{PatchRecord, PowerPatchRecord, Reason};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Patch {
    kind: Option<String>,
    name: Option<String>,
    degree: [usize; 2],
    control_points: Option<Vec<Vec<[f64; 3]>>>,
    weights: Option<Vec<Vec<f64>>>,
    homogeneous: Option<Vec<Vec<[f64; 4]>>>,
    intervals: Option<[[f64; 2]; 2]>,
}

impl Fields for Patch {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    fn into_shape(self) -> Result<Shape, Fault> {
        self.into_record().map(Shape::Patch)
    }
}

impl Patch {
    /// The word for it.
    pub(super) fn kind(&self) -> Option<&str> {
        self.kind.as_deref()
    }

    pub(super) fn into_record(self) -> Result<PatchRecord, Fault> {
        let degrees @ [m, n] = self.degree;
        for (index, degree) in degrees.into_iter().enumerate() {
            check_degree(degree, &[Step::Field("degree"), Step::Index(index)])?;
        }
        let outer = Level::along(m, "rows");
        let net = net(
            rows("control_points", self.control_points, outer, n)?,
            rows("weights", self.weights, outer, n)?,
            rows("homogeneous", self.homogeneous, outer, n)?,
        )?;
        Ok(PatchRecord { degrees, net, intervals: self.intervals.unwrap_or([UNIT; 2]) })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PowerPatch {
    #[serde(rename = "kind")]
    _kind: String,
    name: Option<String>,
    coefficients: Vec<Vec<[f64; 3]>>,
    intervals: Option<[[f64; 2]; 2]>,
}

impl Fields for PowerPatch {
    fn name(&mut self) -> Option<String> {
        self.name.take()
    }

    /// The degrees are what the first row and the number of rows make them.
    fn into_shape(self) -> Result<Shape, Fault> {
        let at = |row| vec![Step::Field("coefficients"), Step::Index(row)];
        let m = self.coefficients.len().checked_sub(1);
        let n = self.coefficients.first().and_then(|row| row.len().checked_sub(1));
        let (Some(m), Some(n)) = (m, n) else {
            return Err((vec![Step::Field("coefficients")], Reason::NoCoefficients));
        };
        for (row, coefficients) in self.coefficients.iter().enumerate() {
            let (found, expected) = (coefficients.len(), n + 1);
            if found != expected {
                return Err((at(row), Reason::CoefficientRow { row, found, expected }));
            }
        }
        Ok(Shape::PowerPatch(PowerPatchRecord {
            degrees: [m, n],
            coefficients: self.coefficients.into_iter().flatten().collect(),
            intervals: self.intervals.unwrap_or([UNIT; 2]),
        }))
    }
}
