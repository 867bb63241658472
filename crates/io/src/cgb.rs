//! `.cgb` files: one concave GB patch of independent ribbons and one outer loop, as numbers between blanks.
//!
//! | numbers | meaning |
//! | --- | --- |
//! | w t a b | weight of the centre: 0 deficiency, 1 none, 2 nth, 3 harmonic; domain type; tolerance and dilation |
//! | n | sides |
//! | x y z | central control point |
//! | n times: d l, l·(d + 1)·3 numbers | degree, layers, and the rows of points, row 0 the side itself |
//! | m, m times: i x y z | extra corner points; may be missing altogether |
//!
//! Domain type 0 is the layout by projection, 1 the heuristic. Type 2 (heuristic with outer angles) is refused; type 3
//! (curved) is read as the heuristic, with a [`Warning`]. Two orders of the third and fourth number are in use: if exactly one
//! of the two is 0 the other is the tolerance of the published solver, otherwise the first is. It is a hint, kept and
//! not used here. A dilation other than 0 is refused. The blends have power 2 and the coordinates are harmonic.

use std::fmt;
use std::io::Write;

use crate::error::STREAM;
use crate::{CenterWeightName, CoordinatesName, GbPatchRecord, IoError, LayoutRecord, Place, Reason};

mod read;

pub use read::read;

/// The tolerance that is written where none was read: that of the published models.
pub const DEFAULT_TOLERANCE: f64 = 0.2;

/// What a `.cgb` file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct CgbFile {
    /// The patch.
    pub record: GbPatchRecord,
    /// The tolerance of the published program's bitmap solver: a hint that is not used here.
    pub tolerance: f64,
    /// What could not be taken as it stands.
    pub warnings: Vec<Warning>,
    /// The line on which each ribbon starts, counted from 1.
    pub ribbon_lines: Vec<usize>,
}

/// What was read as something else than it says.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Warning {
    /// Domain type 3, a domain with curved sides.
    CurvedDomain {
        /// Where it stands.
        place: Place,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CurvedDomain { place } => {
                write!(
                    f,
                    "{place}: domain type 3 (curved) is not supported yet; the heuristic layout is used instead"
                )
            }
        }
    }
}

/// Writes a patch, the tolerance before the dilation 0.
///
/// The format holds only patches with blend power 2, harmonic coordinates and a layout by projection or heuristic,
/// others are refused. It must hold a centre: one that is missing is written as the mean of the corners, with weight 0.
/// Numbers are in the shortest form that reads back to the same bits.
///
/// ```
/// use casteljau_io::{GbPatchRecord, RibbonRecord, cgb};
/// let side = |a, b| RibbonRecord { control_points: vec![vec![a, b]] };
/// let (a, b, c) = ([0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]);
/// let record = GbPatchRecord { ribbons: vec![side(a, b), side(b, c), side(c, a)], ..Default::default() };
/// let mut text = Vec::new();
/// cgb::write(&record, cgb::DEFAULT_TOLERANCE, &mut text)?;
/// let again = cgb::read(str::from_utf8(&text)?, "triangle.cgb")?;
/// assert_eq!(again.record, GbPatchRecord { center: Some([1.0, 1.0, 0.0]), ..record });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(record: &GbPatchRecord, tolerance: f64, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    let refuse = |path: String, reason| Err(IoError::invalid(Place { path, ..Place::file(STREAM) }, reason));
    if let Err((steps, reason)) = record.check() {
        return refuse(crate::place::path_text(&steps), reason);
    }
    let unwritable = |what: String| refuse(String::new(), Reason::Unwritable { format: "cgb", what });
    let layout = match record.layout {
        LayoutRecord::Projection => 0,
        LayoutRecord::Heuristic => 1,
        LayoutRecord::Regular => return unwritable("a regular domain".into()),
        LayoutRecord::Given(_) => return unwritable("a given domain polygon".into()),
    };
    if record.coordinates != CoordinatesName::Harmonic {
        return unwritable(format!("{:?} coordinates", record.coordinates));
    }
    if record.blend_power != crate::record::DEFAULT_BLEND_POWER {
        return unwritable(format!("blend power {}", record.blend_power));
    }
    if !tolerance.is_finite() {
        return unwritable(format!("the tolerance {tolerance}"));
    }
    let weight = match record.center_weight {
        CenterWeightName::Deficiency => 0,
        CenterWeightName::None => 1,
        CenterWeightName::Nth => 2,
        CenterWeightName::Harmonic => 3,
    };
    writeln!(out, "{weight}\n{layout}\n{tolerance:?}\n0\n{}", record.ribbons.len())?;
    write_point(&record.center.unwrap_or_else(|| mean_corner(record)), out)?;
    for ribbon in &record.ribbons {
        // Checked: there is a row, and it has two points or more.
        let degree = ribbon.control_points[0].len() - 1;
        writeln!(out, "{degree} {}", ribbon.control_points.len())?;
        for point in ribbon.control_points.iter().flatten() {
            write_point(point, out)?;
        }
    }
    writeln!(out, "{}", record.corner_points.len())?;
    for entry in &record.corner_points {
        write!(out, "{} ", entry.corner)?;
        write_point(&entry.point, out)?;
    }
    Ok(())
}

fn write_point([x, y, z]: &[f64; 3], out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
    Ok(writeln!(out, "{x:?} {y:?} {z:?}")?)
}

/// The mean of the first points of the sides; each is divided first, so that it cannot overflow.
fn mean_corner(record: &GbPatchRecord) -> [f64; 3] {
    let n = record.ribbons.len() as f64;
    let corners = record.ribbons.iter().filter_map(|ribbon| ribbon.control_points.first()?.first());
    corners.fold([0.0; 3], |[x, y, z], p| [x + p[0] / n, y + p[1] / n, z + p[2] / n])
}
