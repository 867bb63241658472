//! The model file as serde sees it.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::locate::locate;
use crate::place::{Step, path_text, shorten};
use crate::{
    CenterWeightName, CoordinatesName, CornerPointRecord, GbPatchRecord, IoError, LayoutRecord, Place,
    Reason, RibbonRecord,
};

/// The kinds of the format that are still to come.
const KINDS_NOT_YET: [&str; 11] = [
    "curve",
    "power_curve",
    "patch",
    "power_patch",
    "triangle",
    "tetrahedron",
    "hexahedron",
    "wedge",
    "transitional_solid",
    "rotational_solid",
    "twisted_solid",
];

/// Name and description of every shape.
pub(super) fn read(text: &str, file: &str) -> Result<Vec<(Option<String>, GbPatchRecord)>, IoError> {
    if text.trim_ascii().is_empty() {
        return Err(IoError::invalid(Place::line(file, 1), Reason::Empty));
    }
    check_head(text, file)?;
    let document: Object<Document> = parse(text).map_err(|fault| fault.into_error(file))?;
    let records = document.0.shapes.into_iter().enumerate().map(|(index, shape)| {
        let name = shape.0.name.clone();
        let record = shape.0.into_record().map_err(|(field, reason)| {
            refuse(text, file, &[Step::Field("shapes"), Step::Index(index), Step::Field(field)], reason)
        })?;
        Ok((name, record))
    });
    records.collect()
}

/// Looks at version, kinds and forms alone: a file of another version or kind is named as such, not by the first field
/// that looks strange here.
fn check_head(text: &str, file: &str) -> Result<(), IoError> {
    // A syntax error stands in the same place for both, but here it may hide in a field that is skipped.
    let head: Object<Head> = parse(text).map_err(|fault| match parse::<Object<Document>>(text) {
        Err(deeper) if deeper.at() == fault.at() => deeper.into_error(file),
        _ => fault.into_error(file),
    })?;
    let version = head.0.casteljau;
    if version.as_u64() != Some(1) {
        let found = shorten(&version.to_string(), 40);
        return Err(refuse(text, file, &[Step::Field("casteljau")], Reason::Version { found }));
    }
    for (index, Object(shape)) in head.0.shapes.into_iter().enumerate() {
        let at = |field, reason| {
            refuse(text, file, &[Step::Field("shapes"), Step::Index(index), Step::Field(field)], reason)
        };
        if KINDS_NOT_YET.contains(&shape.kind.as_str()) {
            return Err(at("kind", Reason::KindNotYet { kind: shape.kind }));
        }
        if shape.kind != "gb_patch" {
            return Err(at("kind", Reason::KindUnknown { kind: shorten(&shape.kind, 40) }));
        }
        match shape.form.as_deref() {
            None | Some("concave") => {}
            Some("convex") => return Err(at("form", Reason::FormNotYet { form: "convex".into() })),
            Some(form) => return Err(at("form", Reason::FormUnknown { form: shorten(form, 40) })),
        }
    }
    Ok(())
}

/// What serde says, and the path it was on.
struct Fault {
    path: String,
    error: serde_json::Error,
}

/// Parses the whole text.
fn parse<'a, T: Deserialize<'a>>(text: &'a str) -> Result<T, Fault> {
    let mut json = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let path = error.path().to_string();
        Fault { path: if path == "." { String::new() } else { path }, error: error.into_inner() }
    })?;
    json.end().map_err(|error| Fault { path: String::new(), error })?;
    Ok(value)
}

impl Fault {
    /// Line and column, of a text that is no JSON.
    fn at(&self) -> Option<(usize, usize)> {
        (!self.error.is_data()).then(|| (self.error.line(), self.error.column()))
    }

    /// Line and column move from the end of the message to its front.
    fn into_error(self, file: &str) -> IoError {
        let message = self.error.to_string();
        let (line, column) = (self.error.line(), self.error.column());
        let message = message.strip_suffix(&format!(" at line {line} column {column}")).unwrap_or(&message);
        // What a person calls the types that serde names.
        let words = [("f64", "a number"), ("u32", "an integer from 0 up"), ("usize", "an integer from 0 up")];
        let plain = words.iter().find_map(|(name, word)| {
            let start = message.strip_suffix(name)?;
            start.ends_with(", expected ").then(|| format!("{start}{word}"))
        });
        let message = plain.as_deref().unwrap_or(message);
        let place = Place {
            file: file.into(),
            line: Some(line.max(1)),
            column: Some(column.max(1)),
            path: shorten(&self.path, 200),
        };
        IoError::invalid(place, Reason::Json { message: shorten(message, 200) })
    }
}

/// A reason, at the value that the steps lead to.
fn refuse(text: &str, file: &str, steps: &[Step], reason: Reason) -> IoError {
    let place = Place { line: locate(text, steps), path: path_text(steps), ..Place::file(file) };
    IoError::invalid(place, reason)
}

/// A structure given as an object. By itself serde would take an array of the fields' values, too.
struct Object<T>(T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Object<T> {
    fn deserialize<D: Deserializer<'de>>(json: D) -> Result<Self, D::Error> {
        struct OnlyMaps<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de>> Visitor<'de> for OnlyMaps<T> {
            type Value = T;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
                T::deserialize(MapAccessDeserializer::new(map))
            }
        }

        json.deserialize_map(OnlyMaps(PhantomData)).map(Object)
    }
}

#[derive(Deserialize)]
struct Head {
    casteljau: serde_json::Number,
    shapes: Vec<Object<HeadShape>>,
}

#[derive(Deserialize)]
struct HeadShape {
    kind: String,
    form: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    #[serde(rename = "casteljau")]
    _version: u64,
    shapes: Vec<Object<GbPatch>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GbPatch {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "form")]
    _form: Option<String>,
    name: Option<String>,
    ribbons: Vec<Object<Ribbon>>,
    layout: Option<String>,
    domain: Option<Vec<[f64; 2]>>,
    coordinates: Option<String>,
    blend_power: Option<u32>,
    center: Option<[f64; 3]>,
    center_weight: Option<String>,
    #[serde(default)]
    corner_points: Vec<Object<CornerPoint>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Ribbon {
    control_points: Vec<Vec<[f64; 3]>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CornerPoint {
    corner: usize,
    point: [f64; 3],
}

impl GbPatch {
    /// Fills in the defaults; names the field that is too much.
    fn into_record(self) -> Result<GbPatchRecord, (&'static str, Reason)> {
        let default = GbPatchRecord::default();
        let layout = match (self.layout, self.domain) {
            (Some(_), Some(_)) => return Err(("domain", Reason::LayoutAndDomain)),
            (None, Some(domain)) => LayoutRecord::Given(domain),
            (word, None) => named("layout", word, &LayoutRecord::WORDS, default.layout)?,
        };
        let coordinates =
            named("coordinates", self.coordinates, &CoordinatesName::WORDS, default.coordinates)?;
        let center_weight =
            named("center_weight", self.center_weight, &CenterWeightName::WORDS, default.center_weight)?;
        let ribbons = self.ribbons.into_iter().map(|r| RibbonRecord { control_points: r.0.control_points });
        let corners = self
            .corner_points
            .into_iter()
            .map(|c| CornerPointRecord { corner: c.0.corner, point: c.0.point });
        Ok(GbPatchRecord {
            ribbons: ribbons.collect(),
            layout,
            coordinates,
            blend_power: self.blend_power.unwrap_or(default.blend_power),
            center: self.center,
            center_weight,
            corner_points: corners.collect(),
        })
    }
}

/// The value that a word stands for.
fn named<T: Clone>(
    field: &'static str,
    word: Option<String>,
    known: &[(&'static str, T)],
    default: T,
) -> Result<T, (&'static str, Reason)> {
    let Some(word) = word else { return Ok(default) };
    match known.iter().find(|(name, _)| *name == word) {
        Some((_, value)) => Ok(value.clone()),
        None => {
            let known = known.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
            Err((field, Reason::Word { found: shorten(&word, 40), known }))
        }
    }
}
