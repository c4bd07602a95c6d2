//! How a case takes the tangent of its steady sliding.

use crate::case::Case;
use crate::fem::MassKind;
use crate::prestress::{DampingModel, TangentOptions};

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
