//! The model file: JSON, `{"casteljau": 1, "shapes": [ … ]}`.
//!
//! A shape has a `kind`, an optional `name`, and the fields of its kind. Points are `[x, y, z]`; in nets, i runs with u, j
//! with v, k with w, and the points of triangles and tetrahedra stand in descending lexicographic order, (n,0,0),
//! (n−1,1,0), (n−1,0,1), ….
//!
//! | kind | fields |
//! | --- | --- |
//! | `curve` | `degree`, `control_points` `[i]`, `weights`, `interval` `[a, b]` (default `[0, 1]`) |
//! | `power_curve` | `coefficients` `[i]`, `interval` |
//! | `patch` | `degree` `[m, n]`, `control_points` `[i][j]`, `weights`, `intervals` `[[a, b], [c, d]]` |
//! | `power_patch` | `coefficients` `[i][j]`, `intervals` |
//! | `triangle` | `degree`, `control_points` `[i]`, `weights` |
//! | `tetrahedron` | `degree`, `control_points` `[i]`, `weights` |
//! | `hexahedron` | `degree` `[l, m, n]`, `control_points` `[i][j][k]`, `weights`, `intervals` `[[a, b], [c, d], [e, f]]` |
//! | `wedge` | `degree` `[n, o]` (triangle, height), `control_points` `[i][k]` (i as for a triangle), `weights`, `interval` `[a, b]` of the height |
//! | `transitional_solid` | `patch`, `curve`: the patch translated along the curve |
//! | `rotational_solid` | `curve`: the full solid of its rotation about the z axis |
//! | `twisted_solid` | `patch`, `curve`, and `angle` (radians by which each layer of control points is turned about the z axis further than the one before) or `rigid_angle` (radians in all, each section turned as a rigid body) |
//!
//! `weights`, of the net's shape, may be left out: the shape is then polynomial. `homogeneous`, `[w·x, w·y, w·z, w]` in the
//! net's shape, may stand in place of `control_points` and `weights`. `interval` and `intervals` may be left out. `patch` and
//! `curve` inside a solid are shapes of that kind; their `kind` may be left out.
//!
//! `gb_patch` of form `concave` has the fields
//!
//! | field | value |
//! | --- | --- |
//! | `ribbons` | `[{"control_points": [k][j]}]`, one a side; row k = 0 is the side itself |
//! | `layout` | `"projection"` (default), `"heuristic"`, `"regular"` |
//! | `domain` | in place of `layout`: `[[u, v], …]`, vertex i ends side i; it may run clockwise |
//! | `coordinates` | `"harmonic"` (default), `"wachspress"`, `"mean_value"` |
//! | `blend_power` | positive integer, default 2 |
//! | `center` | `[x, y, z]` |
//! | `center_weight` | `"none"` (default), `"deficiency"`, `"nth"`, `"harmonic"` |
//! | `corner_points` | `[{"corner": i, "point": [x, y, z]}]` |
//!
//! Unknown fields are refused. Numbers read to the nearest f64 and are written in the shortest form that reads back to
//! the same bits: writing a model that was read gives the same values.

use std::io::Write;
use std::sync::Arc;

use crate::place::{Step, path_text};
use crate::record::Fault;
use crate::{
    CurveRecord, GbPatchRecord, HexahedronRecord, IoError, PatchRecord, Place, PowerCurveRecord,
    PowerPatchRecord, RotationalRecord, TetrahedronRecord, TransitionalRecord, TriangleRecord, TwistedRecord,
    WedgeRecord,
};

mod locate;
mod wire;
mod write;

/// The shapes of a file, in its order.
///
/// ```
/// use casteljau_io::model::{Model, Shape};
/// let text = r#"{"casteljau": 1, "shapes": [{"kind": "gb_patch", "name": "tile", "ribbons": [
///   {"control_points": [[[0, 0, 0], [1, 0, 0]]]},
///   {"control_points": [[[1, 0, 0], [0, 1, 0]]]},
///   {"control_points": [[[0, 1, 0], [0, 0, 0.1]]]}]}]}"#;
/// let model = Model::read(text, "tile.json")?;
/// let Shape::GbPatch(tile) = &model.shapes[0].shape else { return Ok(()) };
/// assert_eq!(tile.ribbons[2].control_points[0][1], [0.0, 0.0, 0.1]);
///
/// let mut again = Vec::new();
/// model.write(&mut again)?;
/// assert_eq!(Model::read(str::from_utf8(&again)?, "again.json")?, model);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// The shapes.
    pub shapes: Vec<NamedShape>,
}

/// A shape, its name, and where it came from.
///
/// Two are equal if name and shape are, wherever they came from.
#[derive(Clone, Debug)]
pub struct NamedShape {
    /// The name, if it has one.
    pub name: Option<String>,
    /// The shape.
    pub shape: Shape,
    origin: Option<(Arc<Origin>, usize)>,
}

/// What a shape can be.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A Bézier curve.
    Curve(CurveRecord),
    /// A polynomial curve in the power basis.
    PowerCurve(PowerCurveRecord),
    /// A tensor-product Bézier patch.
    Patch(PatchRecord),
    /// A polynomial patch in the power basis.
    PowerPatch(PowerPatchRecord),
    /// A Bézier triangle.
    Triangle(TriangleRecord),
    /// A Bézier tetrahedron.
    Tetrahedron(TetrahedronRecord),
    /// A tensor-product Bézier solid.
    Hexahedron(HexahedronRecord),
    /// A Bézier wedge.
    Wedge(WedgeRecord),
    /// A patch translated along a curve.
    TransitionalSolid(TransitionalRecord),
    /// A curve rotated about the z axis.
    RotationalSolid(RotationalRecord),
    /// A patch translated along a curve and turned about the z axis.
    TwistedSolid(TwistedRecord),
    /// A concave GB patch.
    GbPatch(GbPatchRecord),
}

impl Shape {
    /// The word for it in model files.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Curve(_) => "curve",
            Self::PowerCurve(_) => "power_curve",
            Self::Patch(_) => "patch",
            Self::PowerPatch(_) => "power_patch",
            Self::Triangle(_) => "triangle",
            Self::Tetrahedron(_) => "tetrahedron",
            Self::Hexahedron(_) => "hexahedron",
            Self::Wedge(_) => "wedge",
            Self::TransitionalSolid(_) => "transitional_solid",
            Self::RotationalSolid(_) => "rotational_solid",
            Self::TwistedSolid(_) => "twisted_solid",
            Self::GbPatch(_) => "gb_patch",
        }
    }

    /// Refuses what is no net. The nets of Bézier shapes are all that they are, so that these are built; whether ribbons
    /// make a GB patch is for the patch to say.
    fn check(&self) -> Result<(), Fault> {
        match self {
            Self::Curve(record) => record.build().map(drop),
            Self::PowerCurve(record) => record.build().map(drop),
            Self::Patch(record) => record.build().map(drop),
            Self::PowerPatch(record) => record.build().map(drop),
            Self::Triangle(record) => record.build().map(drop),
            Self::Tetrahedron(record) => record.build().map(drop),
            Self::Hexahedron(record) => record.build().map(drop),
            Self::Wedge(record) => record.build().map(drop),
            Self::TransitionalSolid(record) => record.build().map(drop),
            Self::RotationalSolid(record) => record.build().map(drop),
            Self::TwistedSolid(record) => record.build().map(drop),
            Self::GbPatch(record) => record.check(),
        }
    }
}

/// The file that a shape came from, kept so that what is found out later can still be placed.
#[derive(Debug)]
pub(crate) enum Origin {
    /// A model file and its text: lines are looked up when they are needed, by reading once more.
    Json { file: String, text: Box<str> },
    /// A `.cgb` file and the line on which each ribbon starts.
    Cgb { file: String, ribbons: Vec<usize> },
    /// A `.vtu` file and the line on which the points of the shape's piece start.
    Vtu { file: String, line: usize },
}

impl Model {
    /// Reads a model from the text of a file; `file` is the name for messages.
    ///
    /// Error: [`IoError::Invalid`] with the line, the column and the path in the document.
    pub fn read(text: &str, file: &str) -> Result<Self, IoError> {
        let shapes = wire::read(text, file)?;
        let origin = Arc::new(Origin::Json { file: file.into(), text: text.into() });
        let shapes = shapes.into_iter().enumerate().map(|(index, (name, shape))| NamedShape {
            name,
            shape,
            origin: Some((origin.clone(), index)),
        });
        Self::checked(shapes.collect())
    }

    /// The model, once every shape is one.
    pub(crate) fn checked(shapes: Vec<NamedShape>) -> Result<Self, IoError> {
        shapes.iter().try_for_each(NamedShape::check)?;
        Ok(Self { shapes })
    }

    /// Writes the model, one row of control points a line.
    ///
    /// Error: a shape that reading would refuse, or what the stream says.
    pub fn write(&self, out: &mut (impl Write + ?Sized)) -> Result<(), IoError> {
        for (index, shape) in self.shapes.iter().enumerate() {
            shape.check_as(index)?;
        }
        write::write(self, out)
    }
}

impl NamedShape {
    /// A shape that comes from no file.
    pub fn new(name: Option<String>, shape: Shape) -> Self {
        Self { name, shape, origin: None }
    }

    pub(crate) fn from_cgb(record: GbPatchRecord, file: &str, ribbons: Vec<usize>) -> Self {
        let origin = Arc::new(Origin::Cgb { file: file.into(), ribbons });
        Self { name: None, shape: Shape::GbPatch(record), origin: Some((origin, 0)) }
    }

    /// Of a cell, and the line where its points stand.
    pub(crate) fn from_vtu(shape: Shape, file: &str, line: usize, cell: usize) -> Self {
        Self { name: None, shape, origin: Some((Arc::new(Origin::Vtu { file: file.into(), line }), cell)) }
    }

    /// Where the shape is described: file, line and path.
    pub fn place(&self) -> Place {
        self.place_of(&[])
    }

    /// Where a part of the shape is described; a part that the file leaves out is placed with what holds it.
    ///
    /// ```
    /// # use casteljau_io::{Step, model::Model};
    /// # let text = "{\"casteljau\": 1, \"shapes\": [{\"kind\": \"gb_patch\", \"ribbons\": [
    /// # {\"control_points\": [[[0, 0, 0], [1, 0, 0]]]},
    /// # {\"control_points\": [[[1, 0, 0], [0, 1, 0]]]},
    /// # {\"control_points\": [[[0, 1, 0], [0, 0, 0.1]]]}]}]}";
    /// let model = Model::read(text, "tile.json")?;
    /// let place = model.shapes[0].place_of(&[Step::Field("ribbons"), Step::Index(2)]);
    /// assert_eq!(place.to_string(), "tile.json:4: shapes[0].ribbons[2]");
    /// # Ok::<(), casteljau_io::IoError>(())
    /// ```
    pub fn place_of(&self, part: &[Step]) -> Place {
        match &self.origin {
            None => Place { path: path_text(part), ..Place::file("model") },
            Some((origin, index)) => match origin.as_ref() {
                Origin::Json { file, text } => {
                    let steps = [&[Step::Field("shapes"), Step::Index(*index)], part].concat();
                    let line = locate::locate(text, &steps);
                    Place { line, path: path_text(&steps), ..Place::file(file) }
                }
                Origin::Cgb { file, ribbons } => {
                    let line = match part {
                        [Step::Field("ribbons"), Step::Index(side), ..] => ribbons.get(*side).copied(),
                        _ => None,
                    };
                    // These files have no names for their parts: those of the model file say what is meant. What is no
                    // ribbon is said of the whole, which begins on line 1.
                    let path = if line.is_none() { path_text(part) } else { String::new() };
                    Place { path, ..Place::line(file, line.unwrap_or(1)) }
                }
                Origin::Vtu { file, line } => {
                    let steps = [&[Step::Field("cells"), Step::Index(*index)], part].concat();
                    Place { path: path_text(&steps), ..Place::line(file, *line) }
                }
            },
        }
    }

    fn check(&self) -> Result<(), IoError> {
        self.shape.check().map_err(|(steps, reason)| IoError::invalid(self.place_of(&steps), reason))
    }

    /// Checks a shape that is to be written as the one of this number.
    fn check_as(&self, index: usize) -> Result<(), IoError> {
        self.shape.check().map_err(|(steps, reason)| {
            let steps = [vec![Step::Field("shapes"), Step::Index(index)], steps].concat();
            IoError::invalid(Place { path: path_text(&steps), ..Place::file(crate::error::STREAM) }, reason)
        })
    }
}

impl PartialEq for NamedShape {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && self.shape == other.shape
    }
}
