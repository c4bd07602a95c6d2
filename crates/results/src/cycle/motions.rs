//! Motions of the whole mesh as limit cycles.

use super::branch::{BranchRow, BranchSummary, MotionBranch, StabilityChangeSummary};
use super::name::{CycleName, ModeOfCycle};
use super::record::{ContactNode, CycleMotion, MotionRecord, SteppedMotion};
use super::summary::SoughtCycle;
use super::verdicts::{ConfirmationSummary, Finding, Perturbation, StabilitySummary, known};
use crate::ShownBody;
use crate::npz::NpzArchive;
use crate::summary::{MeanPowers, StatusFractions};
use frictionsim_chart::extremes;
use frictionsim_physics::contact::ContactInterface;
use frictionsim_physics::cycle::periodic::{
    PeriodicBranch, PeriodicMotion, REMAINDER, Sound, velocity_level,
};
use frictionsim_physics::cycle::{Confirmation, CyclePowers, FloquetMultipliers, PhasePoint};
use std::io;
use std::sync::Arc;

/// A limit cycle and what is known of it.
#[derive(Clone, Debug)]
pub struct FoundCycle {
    /// The motion.
    pub motion: PeriodicMotion,
    /// What its flat faces radiate, of a body that has any.
    pub sound: Option<Sound>,
    /// Harmonics in which it is told.
    pub harmonic_count: usize,
    /// Its multipliers, where they were asked for, or why there are none.
    pub stability: Finding,
    /// A transient that started beside it, where one was asked for.
    pub confirmation: Option<Confirmation>,
    /// The branch through it over the parameter of the case, where one was asked for.
    pub branch: Option<PeriodicBranch>,
}

/// What the search from one mode has led to.
#[derive(Clone, Debug)]
pub struct PeriodicResult {
    /// The mode.
    pub name: ModeOfCycle,
    /// The cycle, or why there is none.
    pub outcome: Result<FoundCycle, String>,
    /// Wall time, s.
    pub wall_s: f64,
}

/// The powers of a body of such a thickness, W.
pub(super) fn mean_powers(powers: &CyclePowers, thickness: f64) -> MeanPowers {
    let powers = powers.scaled(thickness);
    MeanPowers::of(&powers.contact, powers.material_damping)
}

/// The body that the motions are of.
#[derive(Clone, Copy, Debug)]
pub struct MotionBody<'a> {
    /// In tables, fields and figures.
    pub shown: ShownBody<'a>,
    /// Its contact nodes.
    pub interface: &'a ContactInterface,
    /// Thickness, m; 1 in three dimensions.
    pub thickness: f64,
}

impl MotionBody<'_> {
    /// Label of a contact node, by its place among those of the contact.
    fn label(&self, node: usize) -> usize {
        self.shown.mesh.node_label(self.interface.nodes[node] as usize)
    }

    /// What a motion is, told in so many harmonics.
    fn motion(&self, motion: &PeriodicMotion, harmonic_count: usize) -> CycleMotion {
        let mut told = motion.harmonics.iter().take(harmonic_count);
        CycleMotion {
            main_frequency_hz: motion.frequency_hz,
            status: StatusFractions::of(motion.fractions),
            power_w: mean_powers(&motion.powers, self.thickness),
            balance_residual: motion.powers.balance_residual(),
            amplitude_m: Some(motion.amplitude),
            velocity_level_db: Some(velocity_level(motion.velocity)),
            harmonics: told.clone().map(|harmonic| harmonic.amplitude[1]).collect(),
            stepped: Some(SteppedMotion {
                residual: motion.residual,
                periods: motion.periods,
                steps: motion.steps,
                contact_node: self.label(motion.node),
                kick_velocity: None,
                sound: None,
                harmonic_count,
                harmonic_remainder: told.next_back().map_or(1.0, |last| last.remainder),
                harmonics_needed: motion.harmonics_within(REMAINDER),
            }),
        }
    }

    fn branch(&self, branch: &PeriodicBranch) -> BranchSummary {
        let in_units = |value: f64| branch.parameter.in_key_units(value);
        let coexistence = branch.coexistence().into_iter();
        let changes = branch.stability_changes().into_iter();
        let rows = branch.motions.iter().map(|own| BranchRow {
            value: in_units(own.value),
            harmonic: None,
            // The histories and harmonics of a branch are not kept.
            motion: CycleMotion {
                balance_residual: own.motion.powers.scaled(self.thickness).balance_residual(),
                ..self.motion(&own.motion, 0)
            },
            growth_rate: own.growth_rate(),
            verdict: known(&own.stability).map(FloquetMultipliers::verdict),
            is_fold: Some(own.is_fold),
        });
        let own_value = in_units(branch.own);
        BranchSummary {
            folds: branch.folds().into_iter().map(in_units).collect(),
            stability_changes: changes.map(|at| StabilityChangeSummary::At(in_units(at))).collect(),
            motions: Some(MotionBranch {
                onsets: branch.onsets.iter().map(|&at| in_units(at)).collect(),
                coexistence: coexistence.map(|ends| ends.map(in_units)).collect(),
            }),
            threshold: branch.threshold().map(|own| [own.amplitude, own.kick_velocity()]),
            ..BranchSummary::new(branch.parameter, own_value, branch.ends, rows.collect())
        }
    }
}

impl FoundCycle {
    /// What it is, with the kick that tips stable sliding into it.
    fn summary(&self, body: &MotionBody<'_>, kick_velocity: Option<f64>) -> CycleMotion {
        let mut cycle = body.motion(&self.motion, self.harmonic_count);
        if let Some(stepped) = &mut cycle.stepped {
            stepped.kick_velocity = kick_velocity;
            stepped.sound.clone_from(&self.sound);
        }
        cycle
    }

    /// What the tables and figures show of it.
    fn record(self, name: CycleName, body: &MotionBody<'_>) -> MotionRecord {
        let motion = self.motion;
        let nodes = (0..body.interface.len()).map(|node| contact_node(&motion, node, body));
        let exponents = known(&self.stability).map(|found| {
            found.multipliers.iter().map(|own| (None, Perturbation::of(own))).collect()
        });
        MotionRecord {
            name,
            frequency_hz: motion.frequency_hz,
            history: motion.instants.iter().map(|at| at[motion.node]).collect(),
            edge: motion.instants.first().cloned().unwrap_or_default(),
            node: motion.node,
            counterface_speed: motion.counterface_speed,
            friction_coefficient: motion.friction_coefficient,
            nodes: nodes.collect(),
            harmonics: motion.harmonics.iter().take(self.harmonic_count).copied().collect(),
            instants: motion.instants,
            frames: motion.frames,
            exponents,
        }
    }
}

impl PeriodicResult {
    /// What is reported of it.
    pub fn sought(self, body: &MotionBody<'_>) -> SoughtCycle {
        let same_as = self.name.same_as;
        let name = CycleName::Mode(self.name);
        let sought = SoughtCycle::new(name.clone(), self.wall_s);
        match (self.outcome, same_as) {
            (Err(error), _) => SoughtCycle { error: Some(error), ..sought },
            (Ok(_), Some(_)) => sought,
            (Ok(found), None) => {
                let branch = found.branch.as_ref().map(|branch| body.branch(branch));
                let kick = branch.as_ref().and_then(|branch| Some(branch.threshold?[1]));
                SoughtCycle {
                    cycle: Some(found.summary(body, kick)),
                    confirmation: found.confirmation.as_ref().map(|run| {
                        let agrees = run.agrees_with(&found.motion);
                        ConfirmationSummary::ran(run, agrees, body.thickness)
                    }),
                    stability: StabilitySummary::of(&found.stability),
                    branch,
                    record: Some(Arc::new(found.record(name, body))),
                    ..sought
                }
            }
        }
    }
}

/// Means and amplitudes of a contact node, by its place among those of the contact.
fn contact_node(motion: &PeriodicMotion, i: usize, body: &MotionBody<'_>) -> ContactNode {
    let own = || motion.instants.iter().map(|at| &at[i]);
    let mean = |of: fn(&PhasePoint) -> f64| own().map(of).sum::<f64>() / own().len() as f64;
    let half_range = |component: usize| {
        let (low, high) = extremes(own().map(|at| at.displacement[component]));
        0.5 * (high - low)
    };
    let [x_m, y_m, z_m] = body.shown.position(body.interface.nodes[i] as usize);
    let [stick, slip, open] = motion.shares[i];
    ContactNode {
        node: body.label(i),
        x_m,
        y_m,
        z_m,
        stick,
        slip,
        open,
        mean_pressure_pa: mean(|at| at.pressure),
        mean_shear_pa: mean(|at| at.shear),
        amplitude_n_m: half_range(0),
        amplitude_t_m: half_range(1),
    }
}

/// The arrays `time_s (F)`, `angle_rad (N)`, `status (F, N)`, `pressure_pa (F, N)`, `shear_pa (F, N)`, `u_n_m (F, N)`
/// and `u_t_m (F, N)` for `F` instants and `N` contact nodes, with the codes of `status`, as in the `contact.npz` of a
/// transient.
pub(super) fn encode_contact(
    interface: &ContactInterface,
    instants: &[Vec<PhasePoint>],
) -> io::Result<Vec<u8>> {
    let shape = [instants.len(), interface.len()];
    let mut archive = NpzArchive::default();
    let times = instants.iter().filter_map(|at| Some(at.first()?.time));
    archive.array("time_s", &shape[..1], times)?;
    archive.array("angle_rad", &shape[1..], interface.angles.iter().copied())?;
    let points = || instants.iter().flatten();
    archive.array("status", &shape, points().map(|own| own.status as u8))?;
    archive.array("pressure_pa", &shape, points().map(|own| own.pressure))?;
    archive.array("shear_pa", &shape, points().map(|own| own.shear))?;
    for (component, name) in ["u_n_m", "u_t_m"].into_iter().enumerate() {
        archive.array(name, &shape, points().map(|own| own.displacement[component]))?;
    }
    archive.status_codes()?;
    archive.finish()
}
