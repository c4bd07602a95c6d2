//! The unknowns of a rotating wave: contact forces along the phase, and the frequency.

use super::parameter::OperatingPoint;
use crate::contact::ContactStatus;
use crate::transient::StatusCounts;
use serde::{Deserialize, Serialize};

/// Contact state of one point of the wave.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum PointState {
    /// No contact.
    Open,
    /// Moving with the cylinder.
    Stick,
    /// Slower than the cylinder, dragged forward: `T = +mu N`.
    SlipForward,
    /// Faster than the cylinder, held back: `T = -mu N`.
    SlipBackward,
}

impl PointState {
    /// That of a point under a tangential force and a limit to it.
    pub(super) fn of(is_open: bool, shear: f64, limit: f64) -> Self {
        match () {
            () if is_open => Self::Open,
            () if shear > limit => Self::SlipForward,
            () if shear < -limit => Self::SlipBackward,
            () => Self::Stick,
        }
    }

    /// `T / (mu N)` where it is fixed: +1 or -1 in slip, else 0.
    pub fn drag(self) -> f64 {
        match self {
            Self::Open | Self::Stick => 0.0,
            Self::SlipForward => 1.0,
            Self::SlipBackward => -1.0,
        }
    }

    /// The inequalities that hold at a point in this state.
    pub(super) fn events(self) -> &'static [fn(usize) -> Event] {
        match self {
            Self::Open => &[Event::Touch],
            Self::Stick => &[Event::Lift, Event::SlideForward, Event::SlideBackward], // N >= 0, mu N - T >= 0, mu N + T >= 0.
            Self::SlipForward | Self::SlipBackward => &[Event::Lift, Event::Rest], // N >= 0, drag (v_t - V) <= 0.
        }
    }

    /// Its status as of a contact node.
    pub fn status(self) -> ContactStatus {
        match self {
            Self::Open => ContactStatus::Open,
            Self::Stick => ContactStatus::Stick,
            Self::SlipForward | Self::SlipBackward => ContactStatus::Slip,
        }
    }
}

/// The first inequality to break.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// A normal force vanishes: the point opens.
    Lift(usize),
    /// A gap vanishes: the point touches.
    Touch(usize),
    /// Stick reaches `+mu N`.
    SlideForward(usize),
    /// Stick reaches `-mu N`.
    SlideBackward(usize),
    /// Slip comes to rest.
    Rest(usize),
}

impl Event {
    /// What the inequality leaves, N/m, of the normal and tangential force, the gap and the slip as forces and the friction limit at
    /// its point, or the rate of that along the rates of these.
    pub(super) fn slack(self, drag: f64, [normal, tangential, gap, slip, limit]: [f64; 5]) -> f64 {
        match self {
            Self::Lift(_) => normal,
            Self::Touch(_) => gap,
            Self::SlideForward(_) => limit - tangential,
            Self::SlideBackward(_) => limit + tangential,
            Self::Rest(_) => -drag * slip, // Friction opposes the sliding.
        }
    }

    /// The point at which it breaks.
    pub(super) fn point(self) -> usize {
        match self {
            Self::Lift(i)
            | Self::Touch(i)
            | Self::SlideForward(i)
            | Self::SlideBackward(i)
            | Self::Rest(i) => i,
        }
    }
}

/// The phase of one wave.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Phase {
    /// `omega`, rad/s.
    pub frequency: f64,
    /// Phase of the first harmonic of the edge's tangential displacement, rad: which point of the wave is called zero.
    pub origin: f64,
}

/// Contact forces of a rotating wave along its phase, or of two along both, frequencies, and what it lives on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaveState {
    /// Normal force on a contact node at each phase, N/m.
    pub normal: Vec<f64>,
    /// Tangential force, N/m.
    pub tangential: Vec<f64>,
    /// Contact state at each phase.
    pub contact: Vec<PointState>,
    /// The phase of each wave, one or two.
    pub phases: Vec<Phase>,
    /// Contact and damping.
    pub point: OperatingPoint,
}

impl WaveState {
    /// `omega` of the first wave, rad/s.
    pub fn frequency(&self) -> f64 {
        self.frequencies()[0]
    }

    /// `omega_1, omega_2`, rad/s; zero for a second wave that is not there.
    pub fn frequencies(&self) -> [f64; 2] {
        [0, 1].map(|wave| self.phases.get(wave).map_or(0.0, |own| own.frequency))
    }

    /// Points in contact, and points that stick, in rising order.
    pub fn active(&self) -> (Vec<usize>, Vec<usize>) {
        let those = |wanted: fn(PointState) -> bool| {
            let points = self.contact.iter().enumerate();
            points.filter_map(|(i, &state)| wanted(state).then_some(i)).collect()
        };
        (those(|state| state != PointState::Open), those(|state| state == PointState::Stick))
    }

    /// Imposes Coulomb's law where points slip and no force where they are open.
    pub fn impose_law(&mut self) {
        let friction = self.point.contact.friction_coefficient;
        for i in 0..self.contact.len() {
            match self.contact[i] {
                PointState::Open => (self.normal[i], self.tangential[i]) = (0.0, 0.0),
                PointState::Stick => {}
                slip => self.tangential[i] = slip.drag() * friction * self.normal[i],
            }
        }
    }

    /// Fractions of points that stick, slip, and are open.
    pub fn fractions(&self) -> [f64; 3] {
        let mut counts = StatusCounts::default();
        self.contact.iter().for_each(|state| counts += state.status());
        counts.fractions()
    }
}
