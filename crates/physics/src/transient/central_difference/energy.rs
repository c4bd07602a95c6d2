//! The energy of the body, a velocity added to it, and energies that stopped making sense.

use super::CentralDifference;
use crate::fem::operator::scatter;
use crate::transient::{Breakdown, TransientError};
use serde::{Deserialize, Serialize};

/// Relative energy residual beyond which the numbers are not to be trusted; honest runs stay ten million times below it.
const RESIDUAL_LIMIT: f64 = 1e-6;

/// What the energy balance of a run is made of, J/m.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyAccount {
    /// Energy at the start.
    pub initial: f64,
    /// Net work of contact and damping so far.
    pub net_work: f64,
    /// Largest energy so far.
    pub largest: f64,
    /// Largest balance residual so far, relative.
    pub largest_residual: f64,
}

impl CentralDifference<'_> {
    /// Kinetic and strain energy (8) at `n + 1/2`, from `K u_{n+1}` and the copy of `u_n`.
    pub(super) fn energies(&self) -> [f64; 2] {
        let masses = self.operator.masses();
        let kinetic: f64 = self.fields.velocity.iter().zip(masses).map(|(v, m)| m * v * v).sum();
        let forces = self.fields.elastic.iter().zip(masses);
        let strain: f64 =
            forces.zip(self.displacement_before.iter()).map(|((q, m), u)| m * q * u).sum();
        [0.5 * kinetic, 0.5 * strain + self.relaxation.energy()]
    }

    /// The first step is to come: `K u`, `K v` and the energy of the fields as they are.
    pub(super) fn open_account(&mut self) {
        let fields = &mut self.fields;
        self.operator.multiply(&mut fields.displacement, &mut fields.elastic);
        self.operator.multiply(&mut fields.velocity, &mut fields.elastic_rate);
        let initial = self.energy_before_step();
        self.account = EnergyAccount { initial, largest: initial, ..EnergyAccount::default() };
    }

    /// `E_{n-1/2}` (8) before step `n`, with `u_{n-1} = u_n - dt v_{n-1/2}`.
    pub(super) fn energy_before_step(&self) -> f64 {
        let dt = self.plan.time_step;
        let fields = &self.fields;
        let dofs = 0..self.operator.dof_count();
        dofs.map(|dof| {
            let k = self.operator.position(dof);
            let (u, v) = (fields.displacement[k], fields.velocity[k]);
            let force = fields.elastic[k] - dt * fields.elastic_rate[k];
            0.5 * self.operator.masses()[k] * (v * v + u * force)
        })
        .sum::<f64>()
            + self.contact_energy()
            + self.relaxation.energy()
    }

    /// Energy of the contact's springs at `n - 1/2`, `n` the next step.
    pub(super) fn contact_energy(&self) -> f64 {
        let [before, now, _] = self.shares(self.next_step);
        let dt = self.plan.time_step;
        self.contact.energy(&self.fields, [before, now], dt)
    }

    /// Adds a velocity (m/s, over all dofs in nodal frames) to `v_{n-1/2}`; the energy that comes with it counts as work.
    pub(super) fn kick(&mut self, velocity: &[f64]) {
        let before = self.energy_before_step();
        let kick = scatter(self.operator, velocity);
        let fields = &mut self.fields;
        fields.velocity.iter_mut().zip(kick.iter()).for_each(|(v, added)| *v += added);
        self.operator.multiply(&mut fields.velocity, &mut fields.elastic_rate);
        if self.next_step > 0 {
            self.relaxation.rewind(&self.fields, self.plan.time_step);
        }
        self.account.net_work += self.energy_before_step() - before;
    }

    /// Refuses energies that no honest run has.
    pub(super) fn check(&self, energy: f64, residual: f64) -> Result<(), TransientError> {
        let unit = ["J/m", "J"][self.model.components() - 2];
        let (symptom, cause) = if !energy.is_finite() || !residual.is_finite() {
            ("the energy is not a number any more".to_owned(), Breakdown::Overflow)
        } else if energy < -1e-9 * self.account.largest {
            (format!("the energy is negative, {energy:.3e} {unit}"), Breakdown::StepTooLong)
        } else if residual > RESIDUAL_LIMIT {
            (
                format!("the energy balance is off by a fraction of {residual:.1e}"),
                Breakdown::RoundOff,
            )
        } else {
            return Ok(());
        };
        Err(self.unstable(symptom, cause))
    }

    fn unstable(&self, symptom: String, cause: Breakdown) -> TransientError {
        let count = self.model.components();
        let speed = |node: usize| {
            let component =
                |c: usize| self.fields.velocity[self.operator.position(count * node + c)];
            let speed = (1..count).fold(component(0), |size, c| size.hypot(component(c)));
            if speed.is_finite() { speed } else { f64::MAX }
        };
        let speeds = (0..self.operator.dof_count() / count).map(|node| (node, speed(node)));
        let fastest = speeds.reduce(|best, own| if own.1 > best.1 { own } else { best });
        let (node, largest) = fastest.unwrap_or_default();
        let [radius, angle] = self.model.place(node);
        let step = self.next_step - 1;
        let problem = format!(
            "t = {:.6e} s (step {step}): {symptom}. The fastest node is {}, at {:.2} degrees and \
             radius {radius:.4e} m, moving at {largest:.3e} m/s",
            step as f64 * self.plan.time_step,
            node + 1,
            angle.to_degrees(),
        );
        TransientError::Unstable { problem, cause }
    }
}
