//! `casteljau plot`: pictures.

use casteljau::gb::ConcavePatch;
use casteljau::plot::{
    DomainStyle, Isolines, PatchStyle, PlotError, Shading, View, domain_picture, patch_picture,
};

use crate::arguments::{IsolinesName, Plot, ShadingName, ViewName};
use crate::failure::Failure;
use crate::input::{Input, is_dash};
use crate::output::write;

pub fn run(options: &Plot) -> Result<(), Failure> {
    check_ending(options)?;
    let input = Input::read(&options.selection)?;
    let patches = input.patches()?;
    let picture = match (options.domain, &patches[..]) {
        (false, patches) => patch_picture(patches, &patch_style(options)),
        (true, [patch]) => domain_picture(patch.coordinates(), &domain_style(options, patch)),
        (true, _) => {
            let count = patches.len();
            let name = &input.name;
            return Err(Failure::Bad(format!(
                "{name}: the file has {count} shapes: choose one with --shape"
            )));
        }
    };
    let picture = picture.map_err(|error| match error {
        PlotError::Option { .. } => Failure::Usage(error.to_string()),
        _ => Failure::Bad(format!("{}: {error}", input.name)),
    })?;
    write(&options.output, |out| Ok(out.write_all(picture.as_bytes())?))
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
        shading: match options.shading {
            ShadingName::None => Shading::None,
            ShadingName::Light => Shading::Light,
            ShadingName::Gaussian => Shading::Gaussian,
            ShadingName::Mean => Shading::Mean,
        },
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
