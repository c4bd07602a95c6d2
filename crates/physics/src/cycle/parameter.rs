//! Parameters of a limit cycle, and those over which a branch can be followed.

use crate::contact::SlidingContact;
use crate::fem::RayleighDamping;
use crate::output::rounded;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Contact and damping of one limit cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OperatingPoint {
    /// The rotating cylinder and its friction law.
    pub contact: SlidingContact,
    /// Rayleigh coefficients of the body.
    pub damping: RayleighDamping,
}

/// A parameter that a branch of limit cycles is followed over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// `mu`.
    FrictionCoefficient,
    /// `Omega`, rad/s, of a round counterface.
    RotationSpeed,
    /// `V`, m/s, of a plane one.
    Speed,
    /// `delta`, m.
    Interference,
    /// `alpha_R`, 1/s.
    MassDamping,
    /// `beta_R`, s.
    StiffnessDamping,
}

impl Parameter {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::FrictionCoefficient,
        Self::RotationSpeed,
        Self::Speed,
        Self::Interference,
        Self::MassDamping,
        Self::StiffnessDamping,
    ];

    /// Its case key.
    pub fn key(self) -> &'static str {
        match self {
            Self::FrictionCoefficient => "contact.friction_coefficient",
            Self::RotationSpeed => "contact.rotation_speed_rpm",
            Self::Speed => "contact.speed",
            Self::Interference => "contact.interference",
            Self::MassDamping => "damping.mass_coefficient",
            Self::StiffnessDamping => "damping.stiffness_coefficient",
        }
    }

    /// Whether a counterface that is round, or plane, has it.
    pub fn suits(self, is_round: bool) -> bool {
        match self {
            Self::RotationSpeed => is_round,
            Self::Speed => !is_round,
            _ => true,
        }
    }

    /// Whether solid bodies that slide on each other have it: friction of the first contact, to which the others keep their ratio,
    /// and damping; each motion and each load has keys of its own.
    pub fn is_of_solid_bodies(self) -> bool {
        matches!(self, Self::FrictionCoefficient | Self::MassDamping | Self::StiffnessDamping)
    }

    /// The parameter of a case key.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|parameter| parameter.key() == key)
    }

    /// Whether it is one of the contact, not of the body.
    pub fn is_of_contact(self) -> bool {
        !matches!(self, Self::MassDamping | Self::StiffnessDamping)
    }

    /// What a change of it is to the friction coefficient.
    pub(super) fn friction_in(self, change: f64) -> f64 {
        if self == Self::FrictionCoefficient { change } else { 0.0 }
    }

    /// SI value of one unit of the case key.
    pub fn unit(self) -> f64 {
        match self {
            Self::RotationSpeed => TAU / 60.0,
            _ => 1.0,
        }
    }

    /// Its SI value at an operating point.
    pub fn of(self, point: &OperatingPoint) -> f64 {
        let mut own = *point;
        *self.place(&mut own)
    }

    /// Its value in units of the case key, rounded to 14 digits so that 6000 rpm and back is 6000 rpm.
    pub fn in_key_units(self, value: f64) -> f64 {
        rounded(value / self.unit(), 14)
    }

    /// Sets its SI value.
    pub fn set(self, point: &mut OperatingPoint, value: f64) {
        *self.place(point) = value;
    }

    fn place(self, point: &mut OperatingPoint) -> &mut f64 {
        match self {
            Self::FrictionCoefficient => &mut point.contact.friction_coefficient,
            Self::RotationSpeed | Self::Speed => &mut point.contact.rotation_speed,
            Self::Interference => &mut point.contact.interference,
            Self::MassDamping => &mut point.damping.mass_coefficient,
            Self::StiffnessDamping => &mut point.damping.stiffness_coefficient,
        }
    }
}
