//! How a case takes the tangent of its steady sliding, and what its forces are of.

use crate::*;
use frictionsim_results::Extent;

/// Whether forces, torques, powers and energies of a case are of its whole body, or for each metre of a plane body's
/// thickness, which the case does not give.
pub fn extent_of(case: &Case) -> Extent {
    let is_whole = case.body.dimension() == 3 || case.raw.find("geometry.thickness").is_some();
    if is_whole { Extent::WholeBody } else { Extent::MetreOfThickness }
}

/// How a case takes the tangent of steady sliding: geometric stiffness as its `[cea]` or its body says, damping of body
/// or of body and contact, contact stiffness and dashpots.
pub fn tangent_options(case: &Case, mass: MassKind) -> TangentOptions {
    TangentOptions {
        mass,
        geometric_stiffness: case.has_geometric_stiffness(),
        damping: case.damping.rayleigh,
        damping_model: match case.damping.include_contact {
            true => DampingModel::WholeTangent,
            false => DampingModel::BodyOnly,
        },
        contact: case.contact.stiffness,
    }
}

/// Modes of lowest frequency that are looked at as the transient has them where the case has no `[cea]`.
pub(super) const MODES_IN_TIME: usize = 30;

/// What the transient has: lumped mass, no geometric stiffness.
pub(super) fn options_in_time(case: &Case) -> TangentOptions {
    TangentOptions { geometric_stiffness: false, ..tangent_options(case, MassKind::Lumped) }
}
