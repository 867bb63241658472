//! What is said of solids: is the Jacobian positive, and how large is the volume.

use casteljau::io::Geometry;
use casteljau::io::model::NamedShape;
use casteljau::solid::{JacobianVerdict, MassProperties, SolidError};
use serde::Serialize;

use crate::failure::Failure;
use crate::input::Input;
use crate::number::{brief, human, tuple};
use crate::output::Lines;

/// Relative accuracy that the volume of a rational solid is computed to.
pub const VOLUME_ACCURACY: f64 = 1e-12;

/// The verdict on a solid. `except` names the corners, edges and faces where the Jacobian is zero; `witness` are parameters
/// where it is not positive, and `jacobian` is what it is there. `volume` is signed, the integral of the Jacobian;
/// null, with an `error`, where it could not be found.
#[derive(Serialize)]
struct VerdictLine {
    shape: usize,
    verdict: &'static str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    except: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    witness: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    jacobian: Option<f64>,
    volume: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
    ok: bool,
}

/// The certificate and the integrals of a solid; `None` for what is none.
pub fn certify(geometry: &Geometry) -> Option<Result<JacobianVerdict, SolidError>> {
    Some(match geometry {
        Geometry::Tetrahedron(solid) => solid.jacobian_verdict(),
        Geometry::RationalTetrahedron(solid) => solid.jacobian_verdict(),
        Geometry::Hexahedron(solid) => solid.jacobian_verdict(),
        Geometry::RationalHexahedron(solid) => solid.jacobian_verdict(),
        Geometry::Constructed(solid) => solid.hexahedron().jacobian_verdict(),
        Geometry::Wedge(solid) => solid.jacobian_verdict(),
        Geometry::RationalWedge(solid) => solid.jacobian_verdict(),
        _ => return None,
    })
}

/// Volume, centroid and second moments of a solid; `None` for what is none.
pub fn integrate(geometry: &Geometry) -> Option<Result<MassProperties, SolidError>> {
    Some(match geometry {
        Geometry::Tetrahedron(solid) => solid.mass_properties(VOLUME_ACCURACY),
        Geometry::RationalTetrahedron(solid) => solid.mass_properties(VOLUME_ACCURACY),
        Geometry::Hexahedron(solid) => solid.mass_properties(VOLUME_ACCURACY),
        Geometry::RationalHexahedron(solid) => solid.mass_properties(VOLUME_ACCURACY),
        Geometry::Constructed(solid) => solid.hexahedron().mass_properties(VOLUME_ACCURACY),
        Geometry::Wedge(solid) => solid.mass_properties(VOLUME_ACCURACY),
        Geometry::RationalWedge(solid) => solid.mass_properties(VOLUME_ACCURACY),
        _ => return None,
    })
}

/// The verdict on a solid and its volume: tells its line, and whether the solid keeps what it promises, a Jacobian that is
/// negative nowhere.
pub fn verdict(
    named: &(usize, NamedShape),
    solid: &Geometry,
    json: bool,
    lines: &mut Lines,
) -> Result<bool, Failure> {
    let place = named.1.place();
    let refused = |error: SolidError| Failure::Bad(format!("{place}: shape {}: {error}", named.0));
    let (Some(verdict), Some(properties)) = (certify(solid), integrate(solid)) else { return Ok(true) };
    let verdict = verdict.map_err(refused)?;
    let (volume, error) = match properties {
        Ok(properties) => (Some(properties.volume), None),
        Err(error) => (None, Some(error.to_string())),
    };
    let ok = verdict.is_valid();
    let except = verdict.exceptions().iter().map(ToString::to_string).collect();
    let (word, witness, jacobian) = match verdict {
        JacobianVerdict::Positive => ("positive", None, None),
        JacobianVerdict::PositiveExcept(_) => ("positive-except", None, None),
        JacobianVerdict::Invalid { witness, value } => ("invalid", Some(witness), Some(value)),
        JacobianVerdict::Undecided { .. } => ("undecided", None, None),
    };
    let line = VerdictLine { shape: named.0, verdict: word, except, witness, jacobian, volume, error, ok };
    if json {
        lines.json(&line)?;
    } else {
        lines.text(&format!("{}: {}", Input::title(named), words(&line)))?;
    }
    Ok(ok)
}

fn words(line: &VerdictLine) -> String {
    let jacobian = match (&line.witness, line.jacobian) {
        (Some(at), Some(value)) => format!("INVALID, Jacobian {} at {}", brief(value), tuple(at)),
        _ if !line.except.is_empty() => format!("Jacobian positive but on {}", line.except.join("; ")),
        _ if line.ok => "Jacobian positive".into(),
        _ => "UNDECIDED whether the Jacobian is positive".into(),
    };
    match (line.volume, &line.error) {
        (Some(volume), _) => format!("{jacobian}; volume {}", human(volume)),
        (None, Some(error)) => format!("{jacobian}; no volume: {error}"),
        (None, None) => jacobian,
    }
}
