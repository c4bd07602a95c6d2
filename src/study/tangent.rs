//! Small motions around the steady sliding of a case.

use crate::case::Case;
use crate::cea::cyclic::sweep;
use crate::cea::{CeaError, ComplexMode, ModeLimit, SweepRequest};
use crate::fem::MassKind;
use crate::prestress::{DampingModel, TangentOptions};

/// How a case takes the tangent of steady sliding: geometric stiffness unless its `[cea]` says otherwise, damping of body
/// or of body and contact, contact stiffness and dashpots.
pub fn tangent_options(case: &Case, mass: MassKind) -> TangentOptions {
    TangentOptions {
        mass,
        geometric_stiffness: case.cea.as_ref().is_none_or(|cea| cea.geometric_stiffness),
        damping: case.damping.rayleigh,
        damping_model: match case.damping.include_contact {
            true => DampingModel::WholeTangent,
            false => DampingModel::BodyOnly,
        },
        contact: case.contact.stiffness,
    }
}

/// The modes of an annulus at the case's own friction coefficient, by frequency; no shapes.
///
/// # Errors
/// Those of [`sweep`].
pub fn modes_at_own_friction(
    case: &Case,
    options: &TangentOptions,
    limit: ModeLimit,
) -> Result<Vec<ComplexMode>, CeaError> {
    let sliding = &case.contact.sliding;
    let request = SweepRequest {
        friction_coefficients: &[sliding.friction_coefficient],
        limit,
        shapes_at: &[],
    };
    let found = sweep(&case.annulus, &case.material, options, sliding, &request)?;
    let point = found.sweep.points.into_iter().next();
    Ok(point.map_or_else(Vec::new, |point| point.modes))
}
