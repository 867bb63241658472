use super::{CgbFile, Warning};
use crate::place::excerpt;
use crate::record::{MAX_DEGREE, MAX_LAYERS};
use crate::{
    CenterWeightName, CornerPointRecord, GbPatchRecord, IoError, LayoutRecord, Place, Reason, RibbonRecord,
};

/// The fewest numbers that a side takes: degree and layers, and one row of two points.
const LEAST_SIDE: usize = 2 + 2 * 3;
/// The numbers that a corner point takes.
const CORNER: usize = 4;

/// Reads a patch from the text of a file; `file` is the name for messages.
///
/// Error: [`IoError::Invalid`] with the line. Memory: linear in the text, whatever counts it promises.
pub fn read(text: &str, file: &str) -> Result<CgbFile, IoError> {
    let mut words = Words::new(text, file);
    if words.left == 0 {
        return Err(IoError::invalid(Place::line(file, 1), Reason::Empty));
    }
    let code = words.integer(|| "the weight of the central point".into())?;
    let center_weight = match code {
        0 => CenterWeightName::Deficiency,
        1 => CenterWeightName::None,
        2 => CenterWeightName::Nth,
        3 => CenterWeightName::Harmonic,
        value => {
            let known = "0 (deficiency), 1 (none), 2 (nth), 3 (harmonic)";
            return words.refuse(Reason::Code { what: "central weight", value, known });
        }
    };
    let mut warnings = Vec::new();
    let layout = match words.integer(|| "the domain type".into())? {
        0 => LayoutRecord::Projection,
        1 => LayoutRecord::Heuristic,
        2 => return words.refuse(Reason::DomainType { value: 2, name: "heuristic with outer angles" }),
        3 => {
            warnings.push(Warning::CurvedDomain { place: words.place() });
            LayoutRecord::Heuristic
        }
        value => {
            let known = "0 (projection), 1 (heuristic)";
            return words.refuse(Reason::Code { what: "domain type", value, known });
        }
    };
    let tolerance = words.tolerance()?;

    let sides = words.integer(|| "the number of sides".into())?;
    if sides < 3 {
        return words.refuse(Reason::Sides { sides });
    }
    let possible = words.left.saturating_sub(3) / LEAST_SIDE;
    let sides = words.promised("sides", sides, possible)?;
    let center = words.point(|| "the central point".into())?;

    let mut ribbons = Vec::new();
    let mut ribbon_lines = Vec::new();
    for side in 0..sides {
        let degree = words.integer(|| format!("side {side}: the degree"))?;
        ribbon_lines.push(words.line);
        let degree = match usize::try_from(degree) {
            Ok(degree @ 1..=MAX_DEGREE) => degree,
            _ => return words.refuse(Reason::Degree { side, degree, limit: MAX_DEGREE }),
        };
        let layers = words.integer(|| format!("side {side}: the number of layers"))?;
        let layers = match usize::try_from(layers) {
            Ok(layers @ 1..=MAX_LAYERS) => layers,
            _ => return words.refuse(Reason::Layers { side, layers, limit: MAX_LAYERS }),
        };
        let mut control_points = Vec::new();
        for row in 0..layers {
            let points = (0..=degree).map(|j| words.point(|| format!("side {side}, row {row}, point {j}")));
            control_points.push(points.collect::<Result<Vec<_>, _>>()?);
        }
        ribbons.push(RibbonRecord { control_points });
    }
    let corner_points = if words.left == 0 { Vec::new() } else { words.corner_points(sides)? };
    if let Some(found) = words.next() {
        return words.refuse(Reason::Trailing { found: excerpt(found) });
    }
    let record = GbPatchRecord {
        ribbons,
        layout,
        center: Some(center),
        center_weight,
        corner_points,
        ..GbPatchRecord::default()
    };
    Ok(CgbFile { record, tolerance, warnings, ribbon_lines })
}

/// The words of a text, with the line of the last one.
struct Words<'t> {
    words: Box<dyn Iterator<Item = (usize, &'t str)> + 't>,
    file: &'t str,
    /// Line of the last word that was taken.
    line: usize,
    /// How many words are left.
    left: usize,
}

impl<'t> Words<'t> {
    fn new(text: &'t str, file: &'t str) -> Self {
        let lines = (1..).zip(text.lines());
        let words =
            lines.flat_map(|(line, content)| content.split_whitespace().map(move |word| (line, word)));
        Self { words: Box::new(words), file, line: 1, left: text.split_whitespace().count() }
    }

    fn place(&self) -> Place {
        Place::line(self.file, self.line)
    }

    /// Fails at the last word.
    fn refuse<T>(&self, reason: Reason) -> Result<T, IoError> {
        Err(IoError::invalid(self.place(), reason))
    }

    fn next(&mut self) -> Option<&'t str> {
        let (line, word) = self.words.next()?;
        self.line = line;
        self.left -= 1;
        Some(word)
    }

    /// The next word, or the error that the file ends.
    fn word(&mut self, what: impl FnOnce() -> String) -> Result<&'t str, IoError> {
        match self.next() {
            Some(word) => Ok(word),
            None => self.refuse(Reason::Truncated { what: what() }),
        }
    }

    fn integer(&mut self, what: impl Fn() -> String) -> Result<i64, IoError> {
        let word = self.word(&what)?;
        match word.parse() {
            Ok(value) => Ok(value),
            Err(_) => self.refuse(Reason::NotInteger { what: what(), found: excerpt(word) }),
        }
    }

    fn number(&mut self, what: impl Fn() -> String) -> Result<f64, IoError> {
        let word = self.word(&what)?;
        match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(value) => self.refuse(Reason::NotFinite { what: what(), value }),
            Err(_) => self.refuse(Reason::NotNumber { what: what(), found: excerpt(word) }),
        }
    }

    fn point(&mut self, what: impl Fn() -> String) -> Result<[f64; 3], IoError> {
        let mut point = [0.0; 3];
        for (coordinate, axis) in point.iter_mut().zip(["x", "y", "z"]) {
            *coordinate = self.number(|| format!("{}: {axis}", what()))?;
        }
        Ok(point)
    }

    /// Tolerance and dilation, in either order; the dilation must be 0.
    fn tolerance(&mut self) -> Result<f64, IoError> {
        let first = self.number(|| "the domain tolerance".into())?;
        let second = self.number(|| "the dilation".into())?;
        if first == 0.0 {
            // Either the dilation comes first, or both are 0.
            Ok(second)
        } else if second == 0.0 {
            Ok(first)
        } else {
            self.refuse(Reason::Dilation { value: second })
        }
    }

    /// A count that the words left can fulfil. Nothing is allocated before.
    fn promised(&self, what: &'static str, promised: i64, possible: usize) -> Result<usize, IoError> {
        match usize::try_from(promised) {
            Ok(count) if count <= possible => Ok(count),
            _ => self.refuse(Reason::Promised { what, promised, left: self.left, possible }),
        }
    }

    fn corner_points(&mut self, sides: usize) -> Result<Vec<CornerPointRecord>, IoError> {
        let count = self.integer(|| "the number of corner points".into())?;
        let count = self.promised("corner points", count, self.left / CORNER)?;
        let mut points: Vec<CornerPointRecord> = Vec::new();
        let mut used = vec![false; sides];
        for index in 0..count {
            let number = self.integer(|| format!("corner point {index}: the corner"))?;
            let corner = match usize::try_from(number) {
                Ok(corner) if corner < sides => corner,
                _ => return self.refuse(Reason::Corner { corner: number, sides }),
            };
            if std::mem::replace(&mut used[corner], true) {
                return self.refuse(Reason::RepeatedCorner { corner });
            }
            points.push(CornerPointRecord {
                corner,
                point: self.point(|| format!("the point of corner {corner}"))?,
            });
        }
        Ok(points)
    }
}
