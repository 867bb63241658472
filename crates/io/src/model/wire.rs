//! The model file as serde sees it.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::MapAccessDeserializer;
use serde::de::{DeserializeSeed, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::Shape;
use super::locate::locate;
use crate::place::{Step, path_text, shorten};
use crate::record::Fault;
use crate::{IoError, Place, Reason};

mod anything;
mod construction;
mod curve;
mod gb_patch;
mod net;
mod patch;
mod simplex;
mod solid;

/// The kinds, with the words for them.
const KINDS: [(&str, Kind); 12] = [
    ("curve", Kind::Curve),
    ("power_curve", Kind::PowerCurve),
    ("patch", Kind::Patch),
    ("power_patch", Kind::PowerPatch),
    ("triangle", Kind::Triangle),
    ("tetrahedron", Kind::Tetrahedron),
    ("hexahedron", Kind::Hexahedron),
    ("wedge", Kind::Wedge),
    ("transitional_solid", Kind::Transitional),
    ("rotational_solid", Kind::Rotational),
    ("twisted_solid", Kind::Twisted),
    ("gb_patch", Kind::GbPatch),
];

#[derive(Clone, Copy)]
enum Kind {
    Curve,
    PowerCurve,
    Patch,
    PowerPatch,
    Triangle,
    Tetrahedron,
    Hexahedron,
    Wedge,
    Transitional,
    Rotational,
    Twisted,
    GbPatch,
}

/// A name, and the description or what is wrong with it.
type Described = (Option<String>, Result<Shape, Fault>);

/// The fields of a kind of shape, as they stand in the file.
trait Fields {
    /// The name, taken out.
    fn name(&mut self) -> Option<String>;

    /// Fills in the defaults and brings the net into its order; the steps of a fault start at the shape.
    fn into_shape(self) -> Result<Shape, Fault>;
}

/// Name and description of every shape.
pub(super) fn read(text: &str, file: &str) -> Result<Vec<(Option<String>, Shape)>, IoError> {
    if text.trim_ascii().is_empty() {
        return Err(IoError::invalid(Place::line(file, 1), Reason::Empty));
    }
    let kinds = check_head(text, file)?;
    let shapes = parse(text, Document(&kinds)).map_err(|fault| fault.into_error(file))?;
    let shapes = shapes.into_iter().enumerate().map(|(index, (name, shape))| {
        let shape = shape.map_err(|(steps, reason)| {
            let steps = [vec![Step::Field("shapes"), Step::Index(index)], steps].concat();
            refuse(text, file, &steps, reason)
        })?;
        Ok((name, shape))
    });
    shapes.collect()
}

/// Looks at version, kinds and forms alone: a file of another version or kind is named as such, not by the first field
/// that looks strange here.
fn check_head(text: &str, file: &str) -> Result<Vec<Kind>, IoError> {
    // A syntax error may hide in a field that is skipped here; what skips nothing knows the path to it.
    let head: Object<Head> =
        parse(text, PhantomData).map_err(|fault| match parse(text, anything::Anything) {
            Err(deeper) if deeper.at() == fault.at() => deeper.into_error(file),
            _ => fault.into_error(file),
        })?;
    let version = head.0.casteljau;
    if version.as_u64() != Some(1) {
        let found = shorten(&version.to_string(), 40);
        return Err(refuse(text, file, &[Step::Field("casteljau")], Reason::Version { found }));
    }
    let mut kinds = Vec::with_capacity(head.0.shapes.len());
    for (index, Object(shape)) in head.0.shapes.into_iter().enumerate() {
        let at = |field, reason| {
            refuse(text, file, &[Step::Field("shapes"), Step::Index(index), Step::Field(field)], reason)
        };
        let Some((_, kind)) = KINDS.iter().find(|(word, _)| *word == shape.kind) else {
            let supported = KINDS.map(|(word, _)| format!("`{word}`")).join(", ");
            let kind = shorten(&shape.kind, 40);
            return Err(at("kind", Reason::KindUnknown { kind, supported }));
        };
        kinds.push(*kind);
        match shape.form.as_deref() {
            None | Some("concave") => {}
            Some("convex") => return Err(at("form", Reason::FormNotYet { form: "convex".into() })),
            Some(form) => return Err(at("form", Reason::FormUnknown { form: shorten(form, 40) })),
        }
    }
    Ok(kinds)
}

/// What serde says, and the path it was on.
struct ParseFault {
    path: String,
    error: serde_json::Error,
}

/// Parses the whole text.
fn parse<'a, S: DeserializeSeed<'a>>(text: &'a str, seed: S) -> Result<S::Value, ParseFault> {
    let mut json = serde_json::Deserializer::from_str(text);
    let mut track = serde_path_to_error::Track::new();
    let value =
        seed.deserialize(serde_path_to_error::Deserializer::new(&mut json, &mut track)).map_err(|error| {
            let path = track.path().to_string();
            ParseFault { path: if path == "." { String::new() } else { path }, error }
        })?;
    json.end().map_err(|error| ParseFault { path: String::new(), error })?;
    Ok(value)
}

impl ParseFault {
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

/// The whole file, its shapes of the kinds that its head names.
struct Document<'k>(&'k [Kind]);

#[derive(Deserialize)]
#[serde(field_identifier, rename_all = "snake_case")]
enum DocumentField {
    Casteljau,
    Shapes,
}

impl<'de> DeserializeSeed<'de> for Document<'_> {
    type Value = Vec<Described>;

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<Self::Value, D::Error> {
        json.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Document<'_> {
    type Value = Vec<Described>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        // The head has found each field once.
        let mut shapes = Vec::new();
        while let Some(field) = map.next_key()? {
            match field {
                DocumentField::Casteljau => drop(map.next_value::<u64>()?),
                DocumentField::Shapes => shapes = map.next_value_seed(Shapes(self.0))?,
            }
        }
        Ok(shapes)
    }
}

/// The array of shapes.
struct Shapes<'k>(&'k [Kind]);

impl<'de> DeserializeSeed<'de> for Shapes<'_> {
    type Value = Vec<Described>;

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<Self::Value, D::Error> {
        json.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Shapes<'_> {
    type Value = Vec<Described>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut shapes = Vec::with_capacity(self.0.len());
        for kind in self.0 {
            shapes.extend(seq.next_element_seed(*kind)?);
        }
        Ok(shapes)
    }
}

impl<'de> DeserializeSeed<'de> for Kind {
    type Value = Described;

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<Described, D::Error> {
        match self {
            Self::Curve => described::<curve::Curve, D>(json),
            Self::PowerCurve => described::<curve::PowerCurve, D>(json),
            Self::Patch => described::<patch::Patch, D>(json),
            Self::PowerPatch => described::<patch::PowerPatch, D>(json),
            Self::Triangle => described::<simplex::Simplex<3>, D>(json),
            Self::Tetrahedron => described::<simplex::Simplex<4>, D>(json),
            Self::Hexahedron => described::<solid::Hexahedron, D>(json),
            Self::Wedge => described::<solid::Wedge, D>(json),
            Self::Transitional => described::<construction::Transitional, D>(json),
            Self::Rotational => described::<construction::Rotational, D>(json),
            Self::Twisted => described::<construction::Twisted, D>(json),
            Self::GbPatch => described::<gb_patch::GbPatch, D>(json),
        }
    }
}

fn described<'de, F: Fields + Deserialize<'de>, D: Deserializer<'de>>(
    json: D,
) -> Result<Described, D::Error> {
    let Object(mut fields) = Object::<F>::deserialize(json)?;
    Ok((fields.name(), fields.into_shape()))
}
