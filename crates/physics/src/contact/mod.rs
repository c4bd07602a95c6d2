//! Interface kinematics, Coulomb's law, node status, and contact linearised around steady sliding.
//!
//! A contact [`Point`] is rows over the degrees of freedom of one body or two: separation, slip along the sliding and
//! across it. [`linearized`] makes the terms of small motions of such points, whatever they come from, [`turned`] those of forces
//! that turn with the surfaces.
//!
//! A plane body touches a rigid cylinder that turns inside the contact edge or around it. Or it touches a rigid plane that moves along
//! itself, or another body. `delta` is how far it is pushed in. At each contact node the frame is `(n, t)`: its normal into the body and
//! the direction a quarter turn ahead, `(e_r, e_theta)` around a shaft. The contact pushes the body along `+n` with the nodal force
//! `N >= 0`. While it slips it drags the body along `s t`, with `s` the sense of sliding: `T = s mu(v) N`. The coefficient may fall with the
//! slip speed `v`.
//!
//! Solid bodies touch where faces of two of their surfaces lie over each other ([`SurfacePair`]): [`ContactSurface`] has the
//! points, from the quadrature of the common segments or from dual mortar weights of nodes, and slides as a [`Motion`] says. A
//! [`RigidCounterface`] may stand in place of the other surface.

mod counterpart;
mod dual;
mod interface;
mod law;
mod linearized;
mod mortar;
mod normal_law;
mod opposite;
mod pairing;
mod point;
mod polygon;
mod surface;
mod surface_law;
mod topography;
mod turning;

pub use counterpart::{Counterpart, RigidCounterface, RigidMotion, RigidShape};
pub use interface::ContactInterface;
pub use law::{ContactStatus, CoulombFriction, Friction, FrictionDecay, Slipping, SteadyFriction};
pub use linearized::{PressedState, linearized};
pub use mortar::{MortarNode, mortar_nodes};
pub use normal_law::NormalLaw;
pub use opposite::OppositeMotion;
pub use pairing::{ContactSite, ContactSurface, Motion, PairFriction, PointKind};
pub use point::{Point, Row, row_along, scaled, summed};
pub use surface::{SegmentPoint, SurfacePair, SurfacePoint};
pub use topography::Topography;
pub use turning::{Turning, turned};

/// Why two surfaces make no contact or tie, and what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct PairError(String);

/// The rigid moving counterface and its friction law.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SlidingContact {
    /// Coulomb friction coefficient `mu`, at high speed.
    pub friction_coefficient: f64,
    /// How friction falls with the slip speed; `None` is a constant coefficient.
    pub decay: Option<FrictionDecay>,
    /// How far the counterface is pushed into the body `delta`, m: the radial expansion of a cylinder.
    pub interference: f64,
    /// Rotation speed `Omega` of a cylinder, rad/s, counter-clockwise positive; the speed of a plane, m/s.
    pub rotation_speed: f64,
}

impl SlidingContact {
    /// The friction law.
    pub fn law(&self) -> CoulombFriction {
        CoulombFriction { friction_coefficient: self.friction_coefficient, decay: self.decay }
    }

    /// Friction of steady sliding at the surface speed `surface_speed` (m/s) of the counterface in the sense `direction`.
    pub fn steady_friction(&self, direction: f64, surface_speed: f64) -> SteadyFriction {
        let own = SteadyFriction::at(self.decay, surface_speed);
        SteadyFriction { drag: direction * own.drag, ..own }
    }

    /// Sense in which steady sliding drags the body, `s = sign(Omega)`; `+1` for a cylinder at rest,
    /// taken as on the point of turning counter-clockwise.
    pub fn sliding_direction(&self) -> f64 {
        if self.rotation_speed < 0.0 { -1.0 } else { 1.0 }
    }
}

/// Springs and dashpots between edge and counterface, for each unit of contact area.
///
/// Dashpots act on the motion of the body alone: steady sliding does not feel them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactStiffness {
    /// Normal stiffness `k_n`, Pa/m; `None` is rigid contact.
    pub normal_stiffness: Option<f64>,
    /// Normal dashpot, Pa s/m (needs a normal stiffness).
    pub normal_damping: f64,
    /// Tangential dashpot, Pa s/m.
    pub tangential_damping: f64,
    /// Whether the normal stiffness carries the base state of a body in three dimensions too; otherwise that is rigid contact's.
    pub is_base_compliant: bool,
    /// How the contact stiffens with pressure, `normal_stiffness` then without pressure; `None` where it does not. Such a law
    /// carries the base state too.
    pub law: Option<NormalLaw>,
    /// A normal dashpot of so many times the stiffness of the law at the base state's pressure, s.
    pub law_damping: f64,
    /// Structural damping `eta` of the normal stiffness: `k_n (1 + i eta)` at positive frequencies, which friction follows.
    pub loss_factor: f64,
}

impl ContactStiffness {
    /// The springs that carry the base state of a body in three dimensions; `None` is rigid contact.
    pub fn base_law(&self) -> Option<NormalLaw> {
        let linear = self.normal_stiffness.filter(|_| self.is_base_compliant);
        self.law.or(linear.map(NormalLaw::linear))
    }

    /// The same with the dashpot `beta_R k_n` of a stiffness damping that acts on the contact too.
    pub fn damped_by(self, stiffness_coefficient: f64) -> Self {
        if self.law.is_some() {
            return Self { law_damping: self.law_damping + stiffness_coefficient, ..self };
        }
        let added = stiffness_coefficient * self.normal_stiffness.unwrap_or(0.0);
        Self { normal_damping: self.normal_damping + added, ..self }
    }
}
