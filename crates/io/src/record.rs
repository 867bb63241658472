use crate::Reason;
use crate::place::Step;

/// The highest degree of a ribbon.
pub(crate) const MAX_DEGREE: usize = 20;
/// The largest number of layers of a ribbon.
pub(crate) const MAX_LAYERS: usize = 6;
/// The power of the blends where a file names none.
pub(crate) const DEFAULT_BLEND_POWER: u32 = 2;

/// A concave GB patch as files describe it: nothing is computed yet.
///
/// The same description for every format, so that converting is reading and writing. What a file leaves out has its
/// default value here.
///
/// ```
/// use casteljau_io::{GbPatchRecord, LayoutRecord};
/// let record = GbPatchRecord::default();
/// assert_eq!((record.layout, record.blend_power), (LayoutRecord::Projection, 2));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct GbPatchRecord {
    /// One ribbon a side, in order.
    pub ribbons: Vec<RibbonRecord>,
    /// How the domain polygon comes about.
    pub layout: LayoutRecord,
    /// Which generalized barycentric coordinates.
    pub coordinates: CoordinatesName,
    /// The power p of the blends, at least 1.
    pub blend_power: u32,
    /// The central control point, if there is one.
    pub center: Option<[f64; 3]>,
    /// The weight of the central control point.
    pub center_weight: CenterWeightName,
    /// Extra points at concave corners, at most one a corner.
    pub corner_points: Vec<CornerPointRecord>,
}

impl Default for GbPatchRecord {
    fn default() -> Self {
        Self {
            ribbons: Vec::new(),
            layout: LayoutRecord::default(),
            coordinates: CoordinatesName::default(),
            blend_power: DEFAULT_BLEND_POWER,
            center: None,
            center_weight: CenterWeightName::default(),
            corner_points: Vec::new(),
        }
    }
}

/// The control points of a ribbon, `[k][j]`: row 0 is the side itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RibbonRecord {
    /// Rows of equal length.
    pub control_points: Vec<Vec<[f64; 3]>>,
}

/// How the domain polygon comes about.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum LayoutRecord {
    /// The corners, projected on their best plane.
    #[default]
    Projection,
    /// From the lengths of the sides and the angles between them.
    Heuristic,
    /// A regular polygon.
    Regular,
    /// This polygon; vertex i ends side i. It may run clockwise.
    Given(Vec<[f64; 2]>),
}

/// Generalized barycentric coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CoordinatesName {
    /// Solutions of Laplace's equation.
    #[default]
    Harmonic,
    /// Rational, on convex polygons only.
    Wachspress,
    /// Floater's.
    MeanValue,
}

/// The weight of the central control point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CenterWeightName {
    /// 0: a given centre is kept and unused.
    #[default]
    None,
    /// What the other weights lack to 1.
    Deficiency,
    /// `n Σ h_i² (1 − h_i)² h_{i+1}² (1 − h_{i+1})²`.
    Nth,
    /// `(2/9) (1 − 2/n)^(−2n) Π h_i²`.
    Harmonic,
}

impl LayoutRecord {
    /// The words of the model file.
    pub(crate) const WORDS: [(&'static str, Self); 3] =
        [("projection", Self::Projection), ("heuristic", Self::Heuristic), ("regular", Self::Regular)];
}

impl CoordinatesName {
    /// The words of the model file.
    pub(crate) const WORDS: [(&'static str, Self); 3] =
        [("harmonic", Self::Harmonic), ("wachspress", Self::Wachspress), ("mean_value", Self::MeanValue)];
}

impl CenterWeightName {
    /// The words of the model file.
    pub(crate) const WORDS: [(&'static str, Self); 4] = [
        ("none", Self::None),
        ("deficiency", Self::Deficiency),
        ("nth", Self::Nth),
        ("harmonic", Self::Harmonic),
    ];
}

/// The word for a value; nothing for one that has none.
pub(crate) fn word<T: PartialEq>(words: &[(&'static str, T)], value: &T) -> &'static str {
    words.iter().find(|(_, v)| v == value).map_or("", |(word, _)| word)
}

/// An extra control point at a concave corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CornerPointRecord {
    /// The corner between sides `corner` and `corner + 1`.
    pub corner: usize,
    /// The point.
    pub point: [f64; 3],
}

/// A reason, and the steps from the record to what it is about.
pub(crate) type Fault = (Vec<Step>, Reason);

impl GbPatchRecord {
    /// Refuses a description that is no net: wrong counts, rows of different lengths, numbers that are not finite.
    /// Whether the net is a patch (corners meet, sides have a length, …) is for the patch to say.
    pub(crate) fn check(&self) -> Result<(), Fault> {
        let sides = self.ribbons.len();
        if sides < 3 {
            return Err((vec![Step::Field("ribbons")], Reason::Sides { sides: sides as i64 }));
        }
        for (side, ribbon) in self.ribbons.iter().enumerate() {
            ribbon.check(side)?;
        }
        if let LayoutRecord::Given(domain) = &self.layout {
            let steps = || vec![Step::Field("domain")];
            if domain.len() != sides {
                return Err((steps(), Reason::DomainVertices { found: domain.len(), expected: sides }));
            }
            for (vertex, uv) in domain.iter().enumerate() {
                finite(
                    uv,
                    || format!("domain vertex {vertex}"),
                    || [steps(), vec![Step::Index(vertex)]].concat(),
                )?;
            }
        }
        if self.blend_power == 0 {
            return Err((vec![Step::Field("blend_power")], Reason::BlendPower { value: 0 }));
        }
        if let Some(center) = &self.center {
            finite(center, || "center".into(), || vec![Step::Field("center")])?;
        }
        let mut used = vec![false; sides];
        for (index, entry) in self.corner_points.iter().enumerate() {
            let steps = |field| vec![Step::Field("corner_points"), Step::Index(index), Step::Field(field)];
            let corner = entry.corner;
            match used.get_mut(corner) {
                None => {
                    let corner = i64::try_from(corner).unwrap_or(i64::MAX);
                    return Err((steps("corner"), Reason::Corner { corner, sides }));
                }
                Some(true) => return Err((steps("corner"), Reason::RepeatedCorner { corner })),
                Some(used) => *used = true,
            }
            finite(&entry.point, || format!("the point of corner {corner}"), || steps("point"))?;
        }
        Ok(())
    }
}

impl RibbonRecord {
    fn check(&self, side: usize) -> Result<(), Fault> {
        let steps = || vec![Step::Field("ribbons"), Step::Index(side), Step::Field("control_points")];
        let layers = self.control_points.len();
        if !(1..=MAX_LAYERS).contains(&layers) {
            return Err((steps(), Reason::Layers { side, layers: layers as i64, limit: MAX_LAYERS }));
        }
        let expected = self.control_points[0].len();
        for (row, points) in self.control_points.iter().enumerate() {
            let at_row = || [steps(), vec![Step::Index(row)]].concat();
            if row == 0 && !(2..=MAX_DEGREE + 1).contains(&expected) {
                let degree = expected as i64 - 1;
                return Err((at_row(), Reason::Degree { side, degree, limit: MAX_DEGREE }));
            }
            if points.len() != expected {
                return Err((at_row(), Reason::RowLength { side, row, found: points.len(), expected }));
            }
            for (j, point) in points.iter().enumerate() {
                let what = || format!("side {side}, row {row}, point {j}");
                finite(point, what, || [at_row(), vec![Step::Index(j)]].concat())?;
            }
        }
        Ok(())
    }
}

/// Refuses a point with a coordinate that is not finite.
fn finite(
    point: &[f64],
    what: impl FnOnce() -> String,
    steps: impl FnOnce() -> Vec<Step>,
) -> Result<(), Fault> {
    match point.iter().enumerate().find(|(_, c)| !c.is_finite()) {
        None => Ok(()),
        Some((index, &value)) => {
            let what = format!("{}: coordinate {index}", what());
            Err(([steps(), vec![Step::Index(index)]].concat(), Reason::NotFinite { what, value }))
        }
    }
}
