//! What contact forces do within a step.

use super::{ContactPoint, ContactPowers, StatusCounts, Step, TouchingSurfaces};
use crate::contact::ContactStatus;

/// Sums over the points of a step.
pub(super) struct Account {
    pub powers: ContactPowers,
    pub counts: StatusCounts,
}

impl Account {
    pub fn new(ambiguous: u64) -> Self {
        let counts = StatusCounts { ambiguous, ..StatusCounts::default() };
        Self { powers: ContactPowers::default(), counts }
    }

    /// Adds a point, with its place among the `surfaces`, its forces (normal, friction along the sliding and across it) and its
    /// mean velocities along the rows.
    #[inline(always)]
    pub fn add<const TANGENTS: usize>(
        &mut self,
        surfaces: &TouchingSurfaces,
        (place, point, status): (usize, &ContactPoint, ContactStatus),
        [normal, along, across]: [f64; 3],
        mean: [f64; 3],
        step: &Step,
    ) {
        let (powers, counts) = (&mut self.powers, &mut self.counts);
        if let Some(springs) = &surfaces.springs {
            powers.damping += springs[place].dissipation;
        }
        let mut power = along * mean[1];
        if TANGENTS > 1 {
            power += across * mean[2];
        }
        *counts += status;
        match status {
            ContactStatus::Open => return,
            ContactStatus::Stick => powers.stick += power,
            ContactStatus::Slip => powers.slide += power,
        }
        // (9) and (10).
        let external = along * point.speed;
        powers.external += external;
        powers.contact_dissipated +=
            if TANGENTS > 1 { external - power } else { along * (point.speed - mean[1]) };
        powers.normal += normal
            * match &surfaces.springs {
                None => mean[0],
                Some(_) => {
                    let [earlier, _, later] =
                        step.shares.map(|share| surfaces.pushed(place, point, share));
                    0.5 * (later - earlier) / step.coefficients.time_step
                }
            };
        if !surfaces.is_plain {
            let [_, slip, other] = mean;
            powers.damping += match TANGENTS {
                1 => point.dashpot * slip * slip,
                _ => point.dashpot * (slip * slip + other * other),
            };
        }
    }
}
