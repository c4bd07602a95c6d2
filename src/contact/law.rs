//! Coulomb's law of friction, and the status that it gives a contact node.

/// Status of a contact node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum ContactStatus {
    /// No contact.
    #[default]
    Open = 0,
    /// In contact, moving with the counterface.
    Stick = 1,
    /// In contact, sliding over the counterface.
    Slip = 2,
}

impl ContactStatus {
    /// Every status, at the place of its code.
    pub const ALL: [Self; 3] = [Self::Open, Self::Stick, Self::Slip];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Stick => "stick",
            Self::Slip => "slip",
        }
    }
}

/// Coulomb's law `|T| <= mu N`, with equality while a node slips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoulombFriction {
    /// Friction coefficient `mu`.
    pub friction_coefficient: f64,
}

impl CoulombFriction {
    /// Largest tangential force `mu N` under the normal force `normal`, N/m.
    pub fn cone(&self, normal: f64) -> f64 {
        self.friction_coefficient * normal
    }

    /// The tangential force of a node that `trial` would make stick, and its status: the projection of `trial`
    /// onto the cone.
    pub fn project(&self, trial: f64, normal: f64) -> (f64, ContactStatus) {
        let cone = self.cone(normal);
        let status = if trial.abs() <= cone {
            ContactStatus::Stick
        } else {
            ContactStatus::Slip
        };
        (trial.clamp(-cone, cone), status)
    }
}
