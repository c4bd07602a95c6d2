//! Choices of the linearisation.

use crate::contact::ContactStiffness;
use crate::fem::{MassKind, RayleighDamping};

/// What `beta_R` multiplies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DampingModel {
    /// `C = alpha_R M + beta_R K_t`: contact and friction terms included.
    WholeTangent,
    /// `C = alpha_R M + beta_R K_e`: the body's elastic stiffness alone. Friction still follows all of the normal force.
    BodyOnly,
}

/// Choices of the linearisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentOptions {
    /// Consistent or lumped mass.
    pub mass: MassKind,
    /// Whether the stress of the base state acts back (with the follower terms of the contact).
    pub geometric_stiffness: bool,
    /// Rayleigh coefficients.
    pub damping: RayleighDamping,
    /// What the stiffness coefficient multiplies.
    pub damping_model: DampingModel,
    /// Penalty or rigid contact, and dashpots.
    pub contact: ContactStiffness,
}

impl TangentOptions {
    /// The coefficients of the whole tangent, of which that of the stiffness multiplies prestress and contact.
    pub fn damping_of_tangent(&self) -> RayleighDamping {
        match self.damping_model {
            DampingModel::WholeTangent => self.damping,
            DampingModel::BodyOnly => RayleighDamping::default(),
        }
    }

    /// Those of bodies without contact and stress, `C = alpha_R M + beta_R K`.
    pub fn of_free(mass: MassKind, damping: RayleighDamping) -> Self {
        Self {
            mass,
            geometric_stiffness: false,
            damping,
            damping_model: DampingModel::WholeTangent,
            contact: ContactStiffness::default(),
        }
    }
}
