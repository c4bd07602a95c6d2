//! The unknowns of a rotating wave: contact forces along the phase, and the frequency.

use super::parameter::OperatingPoint;
use crate::contact::ContactStatus;

/// Contact state of one point of the wave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// `T / (mu N)` where it is fixed: +1 or -1 in slip, else 0.
    pub fn drag(self) -> f64 {
        match self {
            Self::Open | Self::Stick => 0.0,
            Self::SlipForward => 1.0,
            Self::SlipBackward => -1.0,
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

/// Contact forces of a rotating wave along its phase, its frequency, and what it lives on.
#[derive(Clone, Debug, PartialEq)]
pub struct WaveState {
    /// Normal force on a contact node at each phase, N/m.
    pub normal: Vec<f64>,
    /// Tangential force, N/m.
    pub tangential: Vec<f64>,
    /// `omega`, rad/s.
    pub frequency: f64,
    /// Contact state at each phase.
    pub contact: Vec<PointState>,
    /// Phase of the first harmonic of the edge's tangential displacement, rad: which point of the wave is called zero.
    pub origin: f64,
    /// Contact and damping.
    pub point: OperatingPoint,
}

impl WaveState {
    /// Points in contact, and points that stick, in rising order.
    pub fn active(&self) -> (Vec<usize>, Vec<usize>) {
        let those = |wanted: fn(PointState) -> bool| {
            let points = self.contact.iter().enumerate();
            points
                .filter_map(|(i, &state)| wanted(state).then_some(i))
                .collect()
        };
        (
            those(|state| state != PointState::Open),
            those(|state| state == PointState::Stick),
        )
    }

    /// Normal force where the point slips, with the sign of its drag: `dT / dmu`.
    pub fn slipping_normal(&self) -> Vec<f64> {
        let pairs = self.contact.iter().zip(&self.normal);
        pairs.map(|(state, normal)| state.drag() * normal).collect()
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
        let share = |status: ContactStatus| {
            let count = self.contact.iter().filter(|state| state.status() == status);
            count.count() as f64 / self.contact.len() as f64
        };
        [
            ContactStatus::Stick,
            ContactStatus::Slip,
            ContactStatus::Open,
        ]
        .map(share)
    }
}
