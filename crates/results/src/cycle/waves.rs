//! Rotating waves of a disc as limit cycles.

use super::branch::{BranchRow, BranchSummary, ModeOfChange, StabilityChangeSummary, WaveBranch};
use super::name::{CycleName, WaveOfCycle};
use super::record::{CycleMotion, Exponent};
use super::summary::SoughtCycle;
use super::verdicts::{ConfirmationSummary, Finding, Perturbation, StabilitySummary, known};
use frictionsim_chart::extremes;
use frictionsim_physics::cycle::periodic::{MotionFrame, PeriodicMotion};
use frictionsim_physics::cycle::{
    Confirmation, CycleBranch, FloquetMultipliers, LimitCycle, StabilityChange,
};
use std::f64::consts::TAU;

/// Why a family has no cycle at the case's own operating point.
#[derive(Clone, Debug, PartialEq)]
pub struct Absence {
    /// In words.
    pub reason: String,
    /// Whether that is so because steady sliding is stable against its wave.
    pub is_stable: bool,
}

/// What the search for the limit cycle of one family has led to.
#[derive(Clone, Debug)]
pub struct CycleResult {
    /// Which limit cycle.
    pub name: WaveOfCycle,
    /// The cycle at the case's own operating point, or why there is none.
    pub outcome: Result<FoundWave, Absence>,
    /// Wall time of cycle and branch, s.
    pub wall_s: f64,
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
            motion: Some(motion),
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
