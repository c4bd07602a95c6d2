//! Interface kinematics, Coulomb's law, node status.
//!
//! The counterface is a rigid cylinder of radius `a + delta` turning at `Omega` inside the contact
//! edge. At each contact node the frame is `(n, t) = (e_r, e_theta)`: the contact pushes the body
//! along `+n` with the nodal force `N >= 0`, and drags it along `s t` with `s = sign(Omega)` while it
//! slips: `T = s mu N`.

mod interface;

pub use interface::ContactInterface;

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

impl SlidingContact {
    /// Sense in which steady sliding drags the body, `s = sign(Omega)`; `+1` for a cylinder at rest,
    /// taken as on the point of turning counter-clockwise.
    pub fn sliding_direction(&self) -> f64 {
        if self.rotation_speed < 0.0 { -1.0 } else { 1.0 }
    }
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
