//! `casteljau convert`: the same shapes in another file, in another basis, of another degree.

use std::path::Path;

use casteljau::io::model::{Model, NamedShape, Shape};
use casteljau::io::{Geometry, IoError, ModelFormat, vtu, write_model};
use casteljau::shape::ShapeError;

use crate::arguments::{BasisName, Convert, ModelFormatName};
use crate::failure::Failure;
use crate::input::{Input, is_dash};
use crate::output::write;

/// The endings of what can be written.
const ENDINGS: &str = "json, cgb, vtu";

enum Format {
    Model(ModelFormat),
    Vtu,
}

pub fn run(options: &Convert) -> Result<(), Failure> {
    let format = match is_dash(&options.output) {
        true => named(options.format),
        false => of_path(&options.output)?,
    };
    let input = Input::read(&options.selection)?;
    let mut shapes = Vec::with_capacity(input.shapes.len());
    for (_, mut shape) in input.shapes {
        if let Some(basis) = options.to {
            shape = in_basis(shape, basis)?;
        }
        if let Some(by) = options.elevate {
            shape = elevated(shape, by)?;
        }
        shapes.push(shape);
    }
    let model = Model { shapes };
    // What cannot be written is placed in the input, which a file that is being written does not know.
    if let Format::Vtu = format {
        vtu::write(&model, &mut std::io::sink())?;
    }
    write(&options.output, |out| match format {
        Format::Model(format) => write_model(&model, format, out),
        Format::Vtu => vtu::write(&model, out),
    })
}

fn named(format: ModelFormatName) -> Format {
    match format {
        ModelFormatName::Json => Format::Model(ModelFormat::Json),
        ModelFormatName::Cgb => Format::Model(ModelFormat::Cgb),
        ModelFormatName::Vtu => Format::Vtu,
    }
}

fn of_path(path: &Path) -> Result<Format, Failure> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("vtu")) {
        return Ok(Format::Vtu);
    }
    match ModelFormat::of_path(path) {
        Ok(format) => Ok(Format::Model(format)),
        Err(IoError::Ending { file, ending, .. }) => {
            Err(IoError::Ending { file, ending, known: ENDINGS.into() }.into())
        }
        Err(error) => Err(error.into()),
    }
}

/// What a shape refuses, at its place in the file.
fn placed(named: &NamedShape) -> impl Fn(ShapeError) -> Failure + use<> {
    let place = named.place();
    move |error| Failure::Bad(format!("{place}: {error}"))
}

/// The shape in a basis; one that has it is left as it is.
fn in_basis(named: NamedShape, basis: BasisName) -> Result<NamedShape, Failure> {
    let refused = |what: &str| Err(Failure::Bad(format!("{}: {what} has no power basis", named.place())));
    let refuse = placed(&named);
    let shape = match (basis, &named.shape) {
        (_, Shape::GbPatch(_)) => return Ok(named),
        (BasisName::Bezier, _) => match named.to_geometry()? {
            Geometry::PowerCurve(curve) => Shape::Curve((&curve.to_bezier().map_err(&refuse)?).into()),
            Geometry::PowerPatch(patch) => Shape::Patch((&patch.to_bezier().map_err(&refuse)?).into()),
            _ => return Ok(named),
        },
        (BasisName::Power, _) => match named.to_geometry()? {
            Geometry::Curve(curve) => Shape::PowerCurve((&curve.to_power().map_err(&refuse)?).into()),
            Geometry::Patch(patch) => Shape::PowerPatch((&patch.to_power().map_err(&refuse)?).into()),
            Geometry::RationalCurve(_) => return refused("a rational curve"),
            Geometry::RationalPatch(_) => return refused("a rational patch"),
            Geometry::Triangle(_) | Geometry::RationalTriangle(_) => return refused("a triangle"),
            _ => return Ok(named),
        },
    };
    Ok(NamedShape::new(named.name, shape))
}

fn elevated(named: NamedShape, by: usize) -> Result<NamedShape, Failure> {
    let refused = |what: &str| Err(Failure::Bad(format!("{}: {what}", named.place())));
    let refuse = placed(&named);
    let shape = match named.shape {
        Shape::GbPatch(_) => return refused("concave GB patches are not elevated yet"),
        Shape::PowerCurve(_) | Shape::PowerPatch(_) => {
            return refused("a power basis needs no higher degree; give --to bezier");
        }
        _ => match named.to_geometry()? {
            Geometry::Curve(curve) => Shape::Curve((&curve.elevated(by).map_err(&refuse)?).into()),
            Geometry::RationalCurve(curve) => Shape::Curve((&curve.elevated(by).map_err(&refuse)?).into()),
            Geometry::Patch(patch) => Shape::Patch((&patch.elevated([by; 2]).map_err(&refuse)?).into()),
            Geometry::RationalPatch(patch) => {
                Shape::Patch((&patch.elevated([by; 2]).map_err(&refuse)?).into())
            }
            Geometry::Triangle(triangle) => {
                Shape::Triangle((&triangle.elevated(by).map_err(&refuse)?).into())
            }
            Geometry::RationalTriangle(triangle) => {
                Shape::Triangle((&triangle.elevated(by).map_err(&refuse)?).into())
            }
            _ => return Ok(named),
        },
    };
    Ok(NamedShape::new(named.name, shape))
}
