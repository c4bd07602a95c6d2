//! Interface kinematics, Coulomb's law, node status.

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

/// The rigid rotating cylinder and its friction law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingContact {
    /// Coulomb friction coefficient `mu`.
    pub friction_coefficient: f64,
    /// Radial expansion of the cylinder `delta`, m.
    pub interference: f64,
    /// Rotation speed `Omega` of the cylinder, rad/s, counter-clockwise positive.
    pub rotation_speed: f64,
}

/// Linearised contact of the complex eigenvalue analysis, for each unit of contact area.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactStiffness {
    /// Normal stiffness `k_n`, Pa/m; `None` is rigid contact.
    pub normal_stiffness: Option<f64>,
    /// Normal dashpot, Pa s/m (needs a normal stiffness).
    pub normal_damping: f64,
    /// Tangential dashpot, Pa s/m.
    pub tangential_damping: f64,
}
