//! `casteljau plot`: pictures.

use casteljau::gb::ConcavePatch;
use casteljau::io::Geometry;
use casteljau::plot::{
    CurveShape, CurveStyle, DomainStyle, Isolines, PatchStyle, PlotError, Shading, SolidShape, SurfaceShape,
    SurfaceStyle, View, curve_picture, domain_picture, patch_picture, solid_picture, surface_picture,
};

use crate::arguments::{IsolinesName, Plot, ShadingName, ViewName};
use crate::failure::Failure;
use crate::input::{Input, is_dash};
use crate::output::write;
use crate::parameters::numbers;

pub fn run(options: &Plot) -> Result<(), Failure> {
    check_ending(options)?;
    let input = Input::read(&options.selection)?;
    let picture = if options.domain { domain(options, &input)? } else { shapes(options, &input)? };
    let picture = picture.map_err(|error| match error {
        PlotError::Option { .. } => Failure::Usage(error.to_string()),
        _ => Failure::Bad(format!("{}: {error}", input.name)),
    })?;
    write(&options.output, |out| Ok(out.write_all(picture.as_bytes())?))
}

type Picture = Result<String, PlotError>;

fn domain(options: &Plot, input: &Input) -> Result<Picture, Failure> {
    match &input.patches()?[..] {
        [patch] => Ok(domain_picture(patch.coordinates(), &domain_style(options, patch))),
        patches => {
            let (name, count) = (&input.name, patches.len());
            Err(Failure::Bad(format!("{name}: the file has {count} shapes: choose one with --shape")))
        }
    }
}

/// One picture of all shapes, which are of one family.
fn shapes(options: &Plot, input: &Input) -> Result<Picture, Failure> {
    let shapes = input.shapes.iter().map(|(_, named)| input.geometry(named));
    let shapes = shapes.collect::<Result<Vec<Geometry>, _>>()?;
    if shapes.iter().all(|shape| shape.as_curve().is_some()) {
        let curves: Result<Vec<_>, PlotError> = shapes.iter().filter_map(curve).collect();
        let style = curve_style(options)?;
        return Ok(curves.and_then(|curves| curve_picture(&curves, &style)));
    }
    if shapes.iter().all(|shape| shape.as_surface().is_some()) {
        let surfaces: Result<Vec<_>, PlotError> = shapes.iter().filter_map(surface).collect();
        let style = surface_style(options)?;
        return Ok(surfaces.and_then(|surfaces| surface_picture(&surfaces, &style)));
    }
    if shapes.iter().all(|shape| shape.as_solid().is_some()) {
        refuse(options.construction.is_some(), "--construction is drawn for curves, patches and triangles")?;
        let solids: Vec<SolidShape> = shapes.iter().filter_map(solid).collect();
        return Ok(solid_picture(&solids, &surface_style(options)?));
    }
    let patches: Vec<ConcavePatch> = shapes.iter().filter_map(Geometry::as_gb_patch).cloned().collect();
    if patches.len() == shapes.len() {
        refuse(options.construction.is_some(), "--construction is drawn for curves, patches and triangles")?;
        refuse_curve_options(options)?;
        return Ok(patch_picture(&patches, &patch_style(options)));
    }
    Err(Failure::Bad(format!(
        "{}: curves, surfaces, solids and GB patches are drawn in pictures of their own: choose a shape with --shape",
        input.name
    )))
}

fn curve(shape: &Geometry) -> Option<Result<CurveShape, PlotError>> {
    match shape {
        Geometry::Curve(curve) => Some(Ok(curve.into())),
        Geometry::RationalCurve(curve) => Some(Ok(curve.into())),
        Geometry::PowerCurve(curve) => Some(curve.try_into().map_err(PlotError::from)),
        _ => None,
    }
}

fn surface(shape: &Geometry) -> Option<Result<SurfaceShape, PlotError>> {
    match shape {
        Geometry::Patch(patch) => Some(Ok(patch.into())),
        Geometry::RationalPatch(patch) => Some(Ok(patch.into())),
        Geometry::PowerPatch(patch) => Some(patch.try_into().map_err(PlotError::from)),
        Geometry::Triangle(triangle) => Some(Ok(triangle.into())),
        Geometry::RationalTriangle(triangle) => Some(Ok(triangle.into())),
        _ => None,
    }
}

fn solid(shape: &Geometry) -> Option<SolidShape> {
    match shape {
        Geometry::Tetrahedron(solid) => Some(solid.into()),
        Geometry::RationalTetrahedron(solid) => Some(solid.into()),
        Geometry::Hexahedron(solid) => Some(solid.into()),
        Geometry::RationalHexahedron(solid) => Some(solid.into()),
        Geometry::Wedge(solid) => Some(solid.into()),
        Geometry::RationalWedge(solid) => Some(solid.into()),
        Geometry::Constructed(solid) => Some(solid.hexahedron().into()),
        _ => None,
    }
}

fn curve_style(options: &Plot) -> Result<CurveStyle, Failure> {
    let turned = options.view.is_some() || options.azimuth.is_some() || options.elevation.is_some();
    Ok(CurveStyle {
        view: turned.then(|| view(options)),
        polygon: !options.no_net,
        comb: options.comb,
        frames: options.frames,
        construction: construction::<1>(options, "one number, t")?.map(|[t]| t),
        width: options.width,
    })
}

fn surface_style(options: &Plot) -> Result<SurfaceStyle, Failure> {
    refuse_curve_options(options)?;
    let default = SurfaceStyle::default();
    Ok(SurfaceStyle {
        view: view(options),
        shading: shading(options),
        levels: match options.isolines {
            IsolinesName::None => 0,
            IsolinesName::Grid => options.levels.unwrap_or(default.levels),
            IsolinesName::Distances | IsolinesName::Side(_) => {
                return Err(Failure::Usage("--isolines of sides are those of GB patches".into()));
            }
        },
        net: !options.no_net,
        construction: construction(options, "two numbers, u,v or λ1,λ2")?,
        triangles: options.triangles.unwrap_or(default.triangles),
        width: options.width,
    })
}

/// The parameter of de Casteljau's construction.
fn construction<const N: usize>(options: &Plot, words: &str) -> Result<Option<[f64; N]>, Failure> {
    let Some(text) = &options.construction else { return Ok(None) };
    let wrong = |why: String| Failure::Usage(format!("--construction {text}: {why}"));
    let given = numbers(text).map_err(wrong)?;
    let count = given.len();
    let given =
        given.try_into().map_err(|_| wrong(format!("{count} numbers where there must be {words}")))?;
    Ok(Some(given))
}

fn refuse(wrong: bool, why: &str) -> Result<(), Failure> {
    if wrong { Err(Failure::Usage(why.into())) } else { Ok(()) }
}

fn refuse_curve_options(options: &Plot) -> Result<(), Failure> {
    refuse(options.comb || options.frames > 0, "--comb and --frames are drawn for curves")
}

fn check_ending(options: &Plot) -> Result<(), Failure> {
    let output = &options.output;
    let ending = output.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    if is_dash(output) || ending.as_deref() == Some("svg") {
        return Ok(());
    }
    let (name, ending) = (output.display(), ending.unwrap_or_default());
    Err(Failure::Bad(match ending.as_str() {
        "png" => format!("{name}: pictures as .png are not supported yet; supported: svg"),
        _ => format!("{name}: the ending `{}` is not known; known endings: svg", ending.escape_debug()),
    }))
}

fn patch_style(options: &Plot) -> PatchStyle {
    let default = PatchStyle::default();
    PatchStyle {
        view: view(options),
        shading: shading(options),
        isolines: match options.isolines {
            IsolinesName::None => Isolines::None,
            IsolinesName::Grid => Isolines::Grid,
            IsolinesName::Distances => Isolines::Distances,
            IsolinesName::Side(side) => Isolines::Side(side),
        },
        levels: options.levels.unwrap_or(default.levels),
        net: !options.no_net,
        triangles: options.triangles.unwrap_or(default.triangles),
        width: options.width,
    }
}

fn shading(options: &Plot) -> Shading {
    match options.shading {
        ShadingName::None => Shading::None,
        ShadingName::Light => Shading::Light,
        ShadingName::Gaussian => Shading::Gaussian,
        ShadingName::Mean => Shading::Mean,
    }
}

fn view(options: &Plot) -> View {
    let name = match options.view {
        None => {
            return View::from_angles(options.azimuth.unwrap_or(-60.0), options.elevation.unwrap_or(35.0));
        }
        Some(ViewName::Iso) => "iso",
        Some(ViewName::Top) => "top",
        Some(ViewName::Bottom) => "bottom",
        Some(ViewName::Front) => "front",
        Some(ViewName::Back) => "back",
        Some(ViewName::Left) => "left",
        Some(ViewName::Right) => "right",
    };
    View::named(name).unwrap_or_default()
}

fn domain_style(options: &Plot, patch: &ConcavePatch) -> DomainStyle {
    let default = DomainStyle::default();
    let polygon = patch.domain();
    let first_concave = (0..polygon.len()).find(|&i| polygon.is_concave(i));
    DomainStyle {
        coordinate: Some(options.coordinate.or(first_concave).unwrap_or(0)),
        levels: options.levels.unwrap_or(default.levels),
        triangulation: !options.no_triangulation,
        triangles: options.triangles.unwrap_or(default.triangles),
        width: options.width,
    }
}
