//! What contact forces do within a step.

use super::{ContactPoint, ContactPowers, LagrangeContact, StatusCounts, Step, TouchingSurfaces};
use crate::contact::ContactStatus;
use crate::fem::operator::MotionFields;

impl LagrangeContact {
    /// Takes the multipliers out of the elastic accelerations after the step, and returns what they did; statuses are counted by points.
    pub(super) fn settle_points<const TANGENTS: usize, const IS_SINGLE: bool>(
        &self,
        fields: &mut MotionFields,
        step: &Step,
    ) -> (ContactPowers, StatusCounts) {
        let (dt, rows) = (step.coefficients.time_step, TANGENTS + 1);
        let (velocity, elastic_rate) = (&fields.velocity[..], &fields.elastic_rate[..]);
        let elastic = &mut fields.elastic[..];
        if !IS_SINGLE {
            for dof in &self.dofs {
                elastic[dof.place] = dof.before[1] + dt * elastic_rate[dof.place];
            }
        }
        let counts = StatusCounts { ambiguous: self.ambiguous, ..StatusCounts::default() };
        let mut sums = (ContactPowers::default(), counts);
        for surfaces in &self.surfaces {
            for (place, i) in surfaces.points.clone().enumerate() {
                let (status, forces, mut mean);
                if IS_SINGLE {
                    // Rows are single dofs, points are nodes.
                    let across = if TANGENTS > 1 { self.across_force[i] } else { 0.0 };
                    forces = [self.normal_force[i], self.tangential_force[i], across];
                    (status, mean) = (self.status[i], [0.0; 3]);
                    if status != ContactStatus::Open {
                        for (c, dof) in self.dofs[rows * i..rows * (i + 1)].iter().enumerate() {
                            let [v, q] = dof.before;
                            elastic[dof.place] = q + dt * elastic_rate[dof.place];
                            let along =
                                if TANGENTS > 1 { self.entries[rows * i + c].1 } else { 1.0 };
                            mean[c] = along * (0.5 * (v + velocity[dof.place]));
                        }
                    }
                } else {
                    let own = &self.turns[i].forces;
                    forces = [own.whole[0], own.friction[0], own.friction[1]];
                    (status, mean) = (own.status, [0.0; 3]);
                    for (c, mean) in mean[..rows].iter_mut().enumerate() {
                        *mean = 0.5 * self.along(i, c, |dof| dof.before[0] + velocity[dof.place]);
                    }
                }
                let point = (place, &self.points[i], status);
                surfaces.account::<TANGENTS>(&mut sums, point, forces, mean, step);
            }
        }
        sums
    }
}

impl TouchingSurfaces {
    /// Adds a point to the sums of a step, with its place among these, its forces (normal, friction along the sliding and across it) and
    /// its mean velocities along the rows.
    #[inline(always)]
    fn account<const TANGENTS: usize>(
        &self,
        (powers, counts): &mut (ContactPowers, StatusCounts),
        (place, point, status): (usize, &ContactPoint, ContactStatus),
        [normal, along, across]: [f64; 3],
        mean: [f64; 3],
        step: &Step,
    ) {
        if let Some(springs) = &self.springs {
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
            * match &self.springs {
                None => mean[0],
                Some(_) => {
                    let [earlier, _, later] =
                        step.shares.map(|share| self.pushed(place, point, share));
                    0.5 * (later - earlier) / step.coefficients.time_step
                }
            };
        if !self.is_plain {
            let [_, slip, other] = mean;
            powers.damping += match TANGENTS {
                1 => point.dashpot * slip * slip,
                _ => point.dashpot * (slip * slip + other * other),
            };
        }
    }
}
