//! Small motions around the steady sliding of a case.

use crate::case::Case;
use crate::cea::cyclic::{SolidModel, solid_sweep};
use crate::cea::{CeaError, ComplexMode, ModeLimit, SweepRequest, cyclic, sparse};
use crate::fem::{MassKind, assemble_stiffness};
use crate::prestress::{DampingModel, SlidingTangent, SteadySliding, TangentOptions};

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

/// The modes of a case at its own friction coefficient, by frequency; no shapes. On the annulus by its symmetry, on any
/// other body of the whole mesh.
///
/// # Errors
/// Those of the mesh, of steady sliding, and of [`cyclic::sweep`] or [`sparse::sweep`].
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
    let materials = case.materials();
    let found = if let Some(specification) = case.solid {
        let model = SolidModel {
            specification,
            material: case.material,
            options: *options,
            contact: *sliding,
        };
        solid_sweep(&model, &request)?.sweep
    } else if case.is_annulus() {
        cyclic::sweep(&case.annulus, materials, options, sliding, &request)?.sweep
    } else {
        let mesh = case.mesh()?;
        let stiffness = assemble_stiffness(&mesh, materials);
        let base = SteadySliding::solve(&mesh, &stiffness, sliding)?;
        let tangent = SlidingTangent::linearize(&mesh, materials, &stiffness, &base, options);
        sparse::sweep(&tangent, &request, &|_| {})?
    };
    let point = found.points.into_iter().next();
    Ok(point.map_or_else(Vec::new, |point| point.modes))
}
