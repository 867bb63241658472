//! Scalar fields over solids.

use casteljau_geom::glam::DVec4;
use casteljau_geom::{UNIT_ROUNDOFF, power_of_two_below, rounding_bound};
use casteljau_shape::bernstein::{MAX_DEGREE, simplex_count};

use super::net::{Degrees, SolidNet};
use crate::TessError;

/// A scalar polynomial in Bernstein form over the domain of a solid, of degrees of its own: a temperature, a density.
///
/// Coefficients stand in memory as the control points of a solid of that kind do. The parameters are those of the
/// solid brought to `[0, 1]`, or its barycentric coordinates.
///
/// ```
/// use casteljau_tess::SolidField;
/// let height = SolidField::hexahedron([0, 0, 1], [0.0, 1.0])?; // w
/// assert_eq!(height.value([0.25, 0.5, 0.75]), 0.75);
/// # Ok::<(), casteljau_tess::TessError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SolidField {
    pub(crate) degrees: Degrees,
    pub(crate) coefficients: Vec<f64>,
}

impl SolidField {
    /// Over a box: degrees with u, v and w, the last index fastest.
    ///
    /// # Errors
    /// [`TessError::Field`] for a wrong number of coefficients, one that is not finite, or a degree above [`MAX_DEGREE`].
    pub fn hexahedron(degrees: [usize; 3], coefficients: impl Into<Vec<f64>>) -> Result<Self, TessError> {
        Self::new(
            Degrees::Hexahedron(degrees),
            &degrees,
            |d| d.iter().map(|n| n + 1).product(),
            coefficients.into(),
        )
    }

    /// Over a tetrahedron.
    ///
    /// # Errors
    /// Those of [`hexahedron`](Self::hexahedron).
    pub fn tetrahedron(degree: usize, coefficients: impl Into<Vec<f64>>) -> Result<Self, TessError> {
        let count = |d: &[usize]| simplex_count::<4>(d[0]);
        Self::new(Degrees::Tetrahedron(degree), &[degree], count, coefficients.into())
    }

    /// Over a wedge: the degrees of the triangle and of the height, the latter's index fastest.
    ///
    /// # Errors
    /// Those of [`hexahedron`](Self::hexahedron).
    pub fn wedge(degrees: [usize; 2], coefficients: impl Into<Vec<f64>>) -> Result<Self, TessError> {
        let count = |d: &[usize]| simplex_count::<3>(d[0]) * (d[1] + 1);
        Self::new(Degrees::Wedge(degrees), &degrees, count, coefficients.into())
    }

    fn new(
        degrees: Degrees,
        each: &[usize],
        count: impl Fn(&[usize]) -> usize,
        coefficients: Vec<f64>,
    ) -> Result<Self, TessError> {
        if let Some(&degree) = each.iter().find(|&&d| d > MAX_DEGREE) {
            return Err(TessError::Field { what: "degree", value: degree as f64 });
        }
        if coefficients.len() != count(each) {
            return Err(TessError::Field {
                what: "number of coefficients",
                value: coefficients.len() as f64,
            });
        }
        if let Some(&value) = coefficients.iter().find(|c| !c.is_finite()) {
            return Err(TessError::Field { what: "coefficient", value });
        }
        Ok(Self { degrees, coefficients })
    }

    /// The value at parameters on `[0, 1]³`, at three barycentric coordinates, or at two and the height on `[0, 1]`.
    #[must_use]
    pub fn value(&self, at: [f64; 3]) -> f64 {
        self.degrees.value(&self.coefficients, self.degrees.completed(at))
    }
}

/// What a surface is sought of in a solid: where a polynomial over its domain vanishes.
#[derive(Clone, Debug)]
pub(crate) struct Level {
    pub degrees: Degrees,
    pub coefficients: Vec<f64>,
    /// Values below this are rounding.
    pub rounding: f64,
    /// Bounds on the derivatives by the steps of the lattice's cubes.
    pub slopes: [f64; 3],
}

impl Level {
    /// The field less a value.
    pub fn of_field(field: &SolidField, value: f64) -> Self {
        let scale = field.coefficients.iter().fold(value.abs(), |max, c| max.max(c.abs()));
        // Brought near 1, so that no square of a slope leaves the range of numbers.
        let unit = power_of_two_below(scale);
        let coefficients = field.coefficients.iter().map(|c| c / unit - value / unit).collect();
        Self::new(field.degrees, coefficients, 2.0 * (scale / unit))
    }

    /// The distance from a plane with the unit normal n times the weight, `n·(wX) − d·w`, of the sign of the weights.
    pub fn of_plane(net: &SolidNet, plane: DVec4) -> Self {
        let points = net.homogeneous();
        let sign = if points.first().is_some_and(|p| p.w < 0.0) { -1.0 } else { 1.0 };
        let scale = points.iter().fold(0.0, |max: f64, p| max.max((*p * plane).abs().element_sum()));
        Self::new(net.degrees, points.iter().map(|p| sign * p.dot(plane)).collect(), scale)
    }

    fn new(degrees: Degrees, coefficients: Vec<f64>, scale: f64) -> Self {
        // The coefficients' own rounding, and that of the evaluation.
        let rounding = rounding_bound(degrees.total(), 0, scale) + 4.0 * UNIT_ROUNDOFF * scale;
        let nets = [0, 1, 2].map(|by| degrees.derivative(&coefficients, by).1);
        let largest = |net: &mut dyn Iterator<Item = f64>| net.fold(0.0, |max: f64, c| max.max(c.abs()));
        let single = |by: usize| largest(&mut nets[by].iter().copied());
        let difference = |a: usize, b: usize| largest(&mut nets[a].iter().zip(&nets[b]).map(|(x, y)| x - y));
        let slopes = match degrees {
            // The cubes of a tetrahedron: its barycentric coordinates are (1 − x, x − y, y − z, z).
            Degrees::Tetrahedron(_) => [difference(0, 1), difference(1, 2), single(2)],
            _ => [single(0), single(1), single(2)],
        };
        Self { degrees, coefficients, rounding, slopes }
    }
}
