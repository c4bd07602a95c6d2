//! What solvers have found as limit cycles: motions of the whole mesh, and rotating waves of a disc.

use super::branch::{
    BranchRow, BranchSummary, ModeOfChange, MotionBranch, StabilityChangeSummary, WaveBranch,
};
use super::record::{
    ContactNode, CycleMotion, CycleName, Exponent, ModeOfCycle, SteppedMotion, WaveOfCycle,
};
use super::summary::SoughtCycle;
use super::verdicts::{ConfirmationSummary, Finding, Perturbation, StabilitySummary, known};
use crate::common::*;
use crate::npz::NpzArchive;
use frictionsim_physics::cycle::periodic::{PeriodicBranch, REMAINDER};
use frictionsim_physics::cycle::{CycleBranch, LimitCycle, StabilityChange};

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

/// What the search for one limit cycle has led to.
#[derive(Clone, Debug)]
pub struct Searched<Name, Cycle, Reason> {
    /// What leads to the cycle.
    pub name: Name,
    /// The cycle at the case's own operating point, or why there is none.
    pub outcome: Result<Cycle, Reason>,
    /// Wall time of cycle and branch, s.
    pub wall_s: f64,
}

/// From one mode.
pub type PeriodicResult = Searched<ModeOfCycle, FoundCycle, String>;
/// Of one family of waves.
pub type CycleResult = Searched<WaveOfCycle, FoundWave, Absence>;

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
    fn branch(&self, branch: &PeriodicBranch) -> BranchSummary {
        let in_units = |value: f64| branch.parameter.in_key_units(value);
        let coexistence = branch.coexistence().into_iter();
        let changes = branch.stability_changes().into_iter();
        let rows = branch.motions.iter().map(|own| BranchRow {
            value: in_units(own.value),
            harmonic: None,
            motion: CycleMotion {
                balance_residual: own.motion.powers.scaled(self.thickness).balance_residual(),
                ..CycleMotion::of(&own.motion, self.thickness)
            },
            residual: Some(own.motion.residual),
            periods: Some(own.motion.periods),
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

/// Label of a contact node, by its place among those of the contact.
fn label(body: &ShownBody<'_>, interface: &ContactInterface, node: usize) -> usize {
    body.mesh.node_label(interface.nodes[node] as usize)
}

impl PeriodicResult {
    /// What is reported of it.
    pub fn sought(self, body: &MotionBody<'_>) -> SoughtCycle {
        let same_as = self.name.same_as;
        let sought = SoughtCycle::new(CycleName::Mode(self.name), self.wall_s);
        match (self.outcome, same_as) {
            (Err(error), _) => SoughtCycle { error: Some(error), ..sought },
            (Ok(_), Some(_)) => sought,
            (Ok(found), None) => found.told(body, sought),
        }
    }
}

impl FoundCycle {
    /// What is reported of it, with the kick that tips stable sliding into it.
    fn told(self, body: &MotionBody<'_>, sought: SoughtCycle) -> SoughtCycle {
        let branch = self.branch.as_ref().map(|branch| body.branch(branch));
        let ran = |run: &Confirmation| ConfirmationSummary::ran(run, body.thickness);
        let confirmation = self.confirmation.as_ref().map(ran);
        let exponents = known(&self.stability).map(|found| {
            found.multipliers.iter().map(|own| (None, Perturbation::of(own))).collect()
        });
        let mut motion = self.motion;
        let harmonics_needed = motion.harmonics_within(REMAINDER);
        // What is left are the harmonics in which it is told.
        motion.harmonics.truncate(self.harmonic_count);
        let stepped = SteppedMotion {
            residual: motion.residual,
            periods: motion.periods,
            steps: motion.steps,
            contact_node: label(&body.shown, body.interface, motion.node),
            kick_velocity: branch.as_ref().and_then(|branch| Some(branch.threshold?[1])),
            sound: self.sound,
            harmonic_count: self.harmonic_count,
            harmonic_remainder: motion.harmonics.last().map_or(1.0, |last| last.remainder),
            harmonics_needed,
        };
        let cycle = CycleMotion {
            harmonics: motion.harmonics.iter().map(|own| own.amplitude[1]).collect(),
            stepped: Some(stepped),
            ..CycleMotion::of(&motion, body.thickness)
        };
        SoughtCycle {
            cycle: Some(cycle),
            confirmation,
            stability: StabilitySummary::of(&self.stability),
            branch,
            motion,
            exponents,
            ..sought
        }
    }
}

/// Means and amplitudes of a contact node, by its place among those of the contact.
pub(super) fn contact_node(
    motion: &PeriodicMotion,
    i: usize,
    body: &ShownBody<'_>,
    interface: &ContactInterface,
) -> ContactNode {
    let own = || motion.instants.iter().map(|at| &at[i]);
    let mean = |of: fn(&PhasePoint) -> f64| own().map(of).sum::<f64>() / own().len() as f64;
    let half_range = |component: usize| {
        let (low, high) = extremes(own().map(|at| at.displacement[component]));
        0.5 * (high - low)
    };
    let [x_m, y_m, z_m] = body.position(interface.nodes[i] as usize);
    let [stick, slip, open] = motion.shares[i];
    ContactNode {
        node: label(body, interface, i),
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

/// Why a family has no cycle at the case's own operating point.
#[derive(Clone, Debug, PartialEq)]
pub struct Absence {
    /// In words.
    pub reason: String,
    /// Whether that is so because steady sliding is stable against its wave.
    pub is_stable: bool,
}

/// A limit cycle, its branch, and what is known of both.
#[derive(Clone, Debug)]
pub struct FoundWave {
    /// The cycle.
    pub cycle: LimitCycle,
    /// The whole field at times over one period, from zero on.
    pub frames: Vec<MotionFrame>,
    /// Root mean square of its velocity over the mass that moves, m/s.
    pub velocity: f64,
    /// A transient that started on it, where one was asked for.
    pub confirmation: Option<Result<Confirmation, String>>,
    /// Its stability, where it was asked for.
    pub stability: Finding,
    /// Stability of each cycle of the branch, where it was asked for; else empty.
    pub branch_stability: Vec<Finding>,
    /// Where the branch changes its stability, in its order.
    pub stability_changes: Vec<StabilityChange>,
    /// The branch over the case's parameter, where one was asked for.
    pub branch: Option<CycleBranch>,
}

/// Amplitude of the wave's own harmonic of the edge's tangential displacement, m; half the peak-to-peak motion where
/// the summary's harmonics do not reach.
fn amplitude(cycle: &LimitCycle) -> f64 {
    match cycle.harmonics.get(cycle.harmonic) {
        Some(&amplitude) => amplitude,
        None => {
            let (low, high) = extremes(cycle.points.iter().map(|point| point.displacement[1]));
            0.5 * (high - low)
        }
    }
}

/// A wave as a motion over its period, without its histories and its velocity; `inner_radius` (m) is that of the
/// contact edge.
fn periodic(cycle: &LimitCycle, inner_radius: f64) -> PeriodicMotion {
    let contact = cycle.state.point.contact;
    PeriodicMotion {
        frequency_hz: cycle.frequency_hz(),
        powers: cycle.powers,
        fractions: cycle.fractions,
        counterface_speed: contact.rotation_speed * inner_radius,
        friction_coefficient: Some(contact.friction_coefficient),
        amplitude: amplitude(cycle),
        ..PeriodicMotion::default()
    }
}

/// Value of the parameter of a branch at a cycle, in units of its key.
fn value(branch: &CycleBranch, cycle: &LimitCycle) -> f64 {
    branch.parameter.in_key_units(branch.parameter.of(&cycle.state.point))
}

impl CycleResult {
    /// What is reported of it, on a disc of such a thickness and radius of the contact edge.
    pub fn sought(self, thickness: f64, inner_radius: f64) -> SoughtCycle {
        let sought = SoughtCycle::new(CycleName::Wave(self.name), self.wall_s);
        match self.outcome {
            Err(Absence { reason, is_stable: true }) => {
                SoughtCycle { absent: Some(reason), ..sought }
            }
            Err(Absence { reason, .. }) => SoughtCycle { error: Some(reason), ..sought },
            Ok(found) => found.told(sought, thickness, inner_radius),
        }
    }
}

impl FoundWave {
    /// What is reported of it.
    fn told(self, sought: SoughtCycle, thickness: f64, inner_radius: f64) -> SoughtCycle {
        let (confirmation, branch) =
            (self.confirmed(thickness), self.branch(thickness, inner_radius));
        let stability = StabilitySummary::of(&self.stability);
        let exponents = self.stability.is_some().then(|| self.exponents());
        let motion = PeriodicMotion {
            velocity: self.velocity,
            frames: self.frames,
            ..periodic(&self.cycle, inner_radius)
        };
        let cycle = CycleMotion {
            harmonics: self.cycle.harmonics.to_vec(),
            ..CycleMotion::of(&motion, thickness)
        };
        // Every node of the edge goes through the same, a phase apart.
        let motion = PeriodicMotion { instants: vec![self.cycle.points], ..motion };
        SoughtCycle {
            cycle: Some(cycle),
            confirmation,
            stability,
            branch,
            motion,
            exponents,
            ..sought
        }
    }

    /// What a transient that started on the cycle says.
    fn confirmed(&self, thickness: f64) -> Option<ConfirmationSummary> {
        Some(match self.confirmation.as_ref()? {
            Ok(run) => ConfirmationSummary::ran(run, thickness),
            Err(error) => ConfirmationSummary::Failed { agrees: false, error: error.clone() },
        })
    }

    fn branch(&self, thickness: f64, inner_radius: f64) -> Option<BranchSummary> {
        let branch = self.branch.as_ref()?;
        let in_units = |value: f64| branch.parameter.in_key_units(value);
        let saturation = branch.cycles.iter().find_map(|own| own.saturation_speed(inner_radius));
        let changes = self.stability_changes.iter().map(|change| {
            StabilityChangeSummary::By(ModeOfChange {
                at: in_units(change.value),
                harmonic: change.harmonic,
                frequency_hz: change.frequency_hz,
                to_two_frequencies: change.harmonic != self.cycle.harmonic,
            })
        });
        let rows = branch.cycles.iter().enumerate().map(|(at, cycle)| {
            let found = self.branch_stability.get(at).and_then(known);
            BranchRow {
                value: value(branch, cycle),
                harmonic: Some(cycle.harmonic),
                motion: CycleMotion::of(&periodic(cycle, inner_radius), thickness),
                growth_rate: found.and_then(FloquetMultipliers::leading).map(|own| own.growth_rate),
                verdict: found.map(FloquetMultipliers::verdict),
                ..BranchRow::default()
            }
        });
        let own_value = value(branch, &self.cycle);
        Some(BranchSummary {
            folds: branch.folds.iter().map(|&fold| in_units(fold)).collect(),
            stability_changes: changes.collect(),
            waves: Some(WaveBranch {
                saturation_speed_rpm: saturation.map(|speed| speed * 60.0 / TAU),
                factorizations: branch.factorizations,
            }),
            ..BranchSummary::new(branch.parameter, own_value, branch.ends, rows.collect())
        })
    }

    /// The exponents of the cycle at the case's own operating point, then along the branch, each with the value of its
    /// parameter.
    fn exponents(&self) -> Vec<Exponent> {
        let mut findings = vec![(0.0, &self.stability)];
        if let Some(branch) = &self.branch {
            findings[0].0 = value(branch, &self.cycle);
            let along = branch.cycles.iter().map(|cycle| value(branch, cycle));
            findings.extend(along.zip(&self.branch_stability));
        }
        let rows = findings.into_iter().flat_map(|(at, finding)| {
            let all = known(finding).into_iter().flat_map(|found| &found.multipliers);
            all.map(move |own| (Some(at), Perturbation::of(own)))
        });
        rows.collect()
    }
}
