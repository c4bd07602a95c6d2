//! Sums of contact forces and powers over nodes and steps.

use crate::contact::ContactStatus;
use serde::{Deserialize, Serialize};
use std::ops::AddAssign;

/// Powers that cross the contact edge, W for each metre of thickness, with every velocity the mean `v_n = (v_{n+1/2} + v_{n-1/2}) / 2`.
///
/// `external = stick + slide + contact_dissipated` holds term by term (equation (10) of Brunetti et al.). A
/// node that starts or ends to stick within the step still slides in its mean velocity; that part is counted as
/// dissipated, which the paper's sum over slipping nodes leaves open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ContactPowers {
    /// `sum T Omega a` (equation (9)).
    pub external: f64,
    /// `sum T v_t` over sticking nodes.
    pub stick: f64,
    /// `sum T v_t` over slipping nodes.
    pub slide: f64,
    /// `sum T (Omega a - v_t)`.
    pub contact_dissipated: f64,
    /// Of the normal forces: `sum N v_n`, impacts and the expansion of the cylinder; for compliant contact, whose springs
    /// and dashpots keep accounts of their own, `N` times the normal velocity of the counterface.
    pub normal: f64,
    /// What the dashpots of the contact dissipate.
    pub damping: f64,
    /// Of the pressures on boundaries, `sum f v`: it crosses these instead.
    pub pressure: f64,
}

impl AddAssign for ContactPowers {
    fn add_assign(&mut self, other: Self) {
        *self = self.with(&other, |own, other| own + other);
    }
}

impl ContactPowers {
    /// Every power times `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        self.with(self, |own, _| factor * own)
    }

    /// Each power with the same one of others.
    fn with(&self, other: &Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            external: of(self.external, other.external),
            stick: of(self.stick, other.stick),
            slide: of(self.slide, other.slide),
            contact_dissipated: of(self.contact_dissipated, other.contact_dissipated),
            normal: of(self.normal, other.normal),
            damping: of(self.damping, other.damping),
            pressure: of(self.pressure, other.pressure),
        }
    }
}

/// Number of contact nodes in each status.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct StatusCounts {
    /// Sticking.
    pub stick: u64,
    /// Slipping.
    pub slip: u64,
    /// Not in contact.
    pub open: u64,
    /// Of those in contact, how many could have stuck and slipped alike: friction falls faster with speed than the
    /// inertia of the node allows.
    pub ambiguous: u64,
}

impl AddAssign for StatusCounts {
    fn add_assign(&mut self, other: Self) {
        self.stick += other.stick;
        self.slip += other.slip;
        self.open += other.open;
        self.ambiguous += other.ambiguous;
    }
}

/// One more node.
impl AddAssign<ContactStatus> for StatusCounts {
    fn add_assign(&mut self, status: ContactStatus) {
        match status {
            ContactStatus::Stick => self.stick += 1,
            ContactStatus::Slip => self.slip += 1,
            ContactStatus::Open => self.open += 1,
        }
    }
}

impl StatusCounts {
    /// Fractions `[stick, slip, open]`; zeros if nothing was counted.
    pub fn fractions(&self) -> [f64; 3] {
        let total = (self.stick + self.slip + self.open).max(1) as f64;
        [self.stick, self.slip, self.open].map(|count| count as f64 / total)
    }
}
