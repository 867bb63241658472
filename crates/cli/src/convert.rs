//! `casteljau convert`: the same shapes in another file, in another basis, of another degree.

use casteljau::io::model::{Model, NamedShape, Shape};
use casteljau::io::{Geometry, ModelFormat, write_model};
use casteljau::solid::SolidError;

use crate::arguments::{BasisName, Convert, ModelFormatName};
use crate::failure::Failure;
use crate::input::{Input, is_dash};
use crate::output::write;

pub fn run(options: &Convert) -> Result<(), Failure> {
    let format = match is_dash(&options.output) {
        true => named(options.format),
        false => ModelFormat::of_path(&options.output)?,
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
    if format == ModelFormat::Vtu {
        write_model(&model, format, &mut std::io::sink())?;
    }
    write(&options.output, |out| write_model(&model, format, out))
}

fn named(format: ModelFormatName) -> ModelFormat {
    match format {
        ModelFormatName::Json => ModelFormat::Json,
        ModelFormatName::Cgb => ModelFormat::Cgb,
        ModelFormatName::Vtu => ModelFormat::Vtu,
    }
}

/// What a shape refuses, at its place in the file.
fn placed<E: std::fmt::Display>(named: &NamedShape) -> impl Fn(E) -> Failure + use<E> {
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
            shape if shape.as_solid().is_some() => return refused("a solid"),
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
            solid => match elevated_solid(&solid, by).transpose().map_err(placed(&named))? {
                Some(shape) => shape,
                None => return Ok(named),
            },
        },
    };
    Ok(NamedShape::new(named.name, shape))
}

/// A solid with its degrees raised; one that is made of patches and curves becomes the hexahedron that it is.
fn elevated_solid(solid: &Geometry, by: usize) -> Option<Result<Shape, SolidError>> {
    Some(match solid {
        Geometry::Tetrahedron(solid) => solid.elevated(by).map(|s| Shape::Tetrahedron((&s).into())),
        Geometry::RationalTetrahedron(solid) => solid.elevated(by).map(|s| Shape::Tetrahedron((&s).into())),
        Geometry::Hexahedron(solid) => solid.elevated([by; 3]).map(|s| Shape::Hexahedron((&s).into())),
        Geometry::RationalHexahedron(solid) => {
            solid.elevated([by; 3]).map(|s| Shape::Hexahedron((&s).into()))
        }
        Geometry::Wedge(solid) => solid.elevated([by; 2]).map(|s| Shape::Wedge((&s).into())),
        Geometry::RationalWedge(solid) => solid.elevated([by; 2]).map(|s| Shape::Wedge((&s).into())),
        Geometry::Constructed(solid) => {
            solid.hexahedron().elevated([by; 3]).map(|s| Shape::Hexahedron((&s).into()))
        }
        _ => return None,
    })
}
