//! Rotating waves of a disc as limit cycles.

use super::branch::{
    BranchRow, BranchRows, BranchSummary, ModeOfChange, StabilityChangeSummary, WaveBranch,
};
use super::motions::mean_powers;
use super::record::MotionRecord;
use super::summary::{CycleMotion, CycleName, OnsetSummary, SoughtCycle, WaveOfCycle};
use super::verdicts::{ConfirmationSummary, KnownStability, Perturbation, StabilitySummary, known};
use super::{CycleReport, WaveSearch};
use crate::summary::{StatusFractions, present};
use frictionsim_chart::extremes;
use frictionsim_physics::cycle::periodic::{MotionFrame, velocity_level};
use frictionsim_physics::cycle::{
    Confirmation, CycleBranch, CycleStability, Family, FloquetExponent, LimitCycle, Onset,
    StabilityChange, Verdict,
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

/// What is known of the stability of a cycle.
pub type Finding = Option<Result<CycleStability, String>>;

/// The limit cycle of one harmonic, and its branch.
#[derive(Clone, Debug)]
pub struct CycleResult {
    /// Which limit cycle.
    pub family: Family,
    /// Every onset of the harmonic, by rising friction; the cycle is born at that of its family.
    pub onsets: Vec<Onset>,
    /// The cycle at the case's own operating point, or why there is none.
    pub cycle: Result<LimitCycle, Absence>,
    /// The whole field at times over one period, from zero on; empty where there is no cycle.
    pub frames: Vec<MotionFrame>,
    /// Root mean square of the velocity of that cycle over the mass that moves, m/s.
    pub velocity: Option<f64>,
    /// Points along the phase.
    pub phases: usize,
    /// A transient that started on that cycle, where one was asked for.
    pub confirmation: Option<Result<Confirmation, String>>,
    /// Stability of that cycle, where it was asked for.
    pub stability: Finding,
    /// Stability of each cycle of the branch, where it was asked for; else empty.
    pub branch_stability: Vec<Finding>,
    /// Where the branch changes its stability, in its order.
    pub stability_changes: Vec<StabilityChange>,
    /// The branch over the case's parameter, where one was asked for and there is a cycle to start from.
    pub branch: Option<CycleBranch>,
    /// Wall time of cycle and branch, s.
    pub wall_s: f64,
}

impl WaveSearch {
    /// Whether steady sliding is stable against every wave looked at.
    pub(super) fn is_stable(&self, friction: f64) -> bool {
        let is_stable =
            |result: &CycleResult| matches!(&result.cycle, Err(absence) if absence.is_stable);
        let onset = self.lowest_onset.as_ref();
        self.results.iter().all(is_stable)
            && onset.is_none_or(|onset| onset.friction_coefficient >= friction)
    }
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

/// Value of the parameter of a branch at a cycle, in units of its key.
fn value(branch: &CycleBranch, cycle: &LimitCycle) -> f64 {
    branch.parameter.in_key_units(branch.parameter.of(&cycle.state.point))
}

/// What an exponent is.
fn perturbation(own: &FloquetExponent) -> Perturbation {
    Perturbation {
        growth_rate_per_s: own.exponent.re,
        class: Some(own.class),
        wave_frequency_rad_per_s: Some(own.exponent.im),
        harmonic: Some(own.harmonic),
        frequency_hz: Some(own.frequency_hz),
        uncertainty_per_s: present(own.uncertainty),
        ..Perturbation::default()
    }
}

/// What the exponents say, in the summary; nothing where they were not asked for.
fn stability(finding: &Finding) -> Option<StabilitySummary> {
    Some(match finding.as_ref()? {
        Err(error) => StabilitySummary::Failed { error: error.clone() },
        Ok(found) => StabilitySummary::Known(Box::new(KnownStability {
            growing_harmonics: Some(found.growing_harmonics()),
            ..KnownStability::new(found.verdict(), found.leading().map(perturbation))
        })),
    })
}

impl CycleResult {
    /// The onset that the cycle is born at.
    pub fn birth(&self) -> Option<&Onset> {
        self.onsets.get(self.family.onset - 1)
    }

    /// What the summary says of it.
    pub(super) fn sought(&self, report: &CycleReport<'_>, search: &WaveSearch) -> SoughtCycle {
        let absence = self.cycle.as_ref().err();
        let reason = |is_stable: bool| {
            let absence = absence.filter(|absence| absence.is_stable == is_stable);
            absence.map(|absence| absence.reason.clone())
        };
        SoughtCycle {
            name: CycleName::Wave(WaveOfCycle {
                harmonic: self.family.harmonic,
                onset: self.family.onset,
                critical_friction: self.birth().map(|onset| onset.friction_coefficient),
                direction: self.birth().map(|onset| onset.direction),
                phases: self.phases,
                onsets: self.onsets.iter().map(OnsetSummary::from).collect(),
            }),
            wall_s: self.wall_s,
            cycle: self.cycle.as_ref().ok().map(|cycle| CycleMotion {
                main_frequency_hz: cycle.frequency_hz(),
                status: StatusFractions::of(cycle.fractions),
                power_w: mean_powers(&cycle.powers, report.thickness),
                balance_residual: cycle.powers.balance_residual(),
                amplitude_m: present(amplitude(cycle)),
                velocity_level_db: self.velocity.map(velocity_level),
                harmonics: cycle.harmonics.to_vec(),
                stepped: None,
            }),
            absent: reason(true),
            error: reason(false),
            confirmation: self.confirmed(report.thickness),
            stability: stability(&self.stability),
            branch: self.branch.as_ref().map(|branch| self.branch(branch, search.inner_radius)),
        }
    }

    /// What a transient that started on the cycle says, where there are both.
    fn confirmed(&self, thickness: f64) -> Option<ConfirmationSummary> {
        Some(match self.confirmation.as_ref()? {
            Ok(found) => {
                let agrees = found.agrees(self.cycle.as_ref().ok()?);
                ConfirmationSummary::ran(found, agrees, thickness)
            }
            Err(error) => ConfirmationSummary::Failed { agrees: false, error: error.clone() },
        })
    }

    fn branch(&self, branch: &CycleBranch, inner_radius: f64) -> BranchSummary {
        let in_units = |value: f64| branch.parameter.in_key_units(value);
        let (low, high) = extremes(branch.cycles.iter().map(|cycle| value(branch, cycle)));
        let saturation = branch.cycles.iter().find_map(|own| own.saturation_speed(inner_radius));
        let changes = self.stability_changes.iter();
        let changes = changes.map(|change| {
            StabilityChangeSummary::By(ModeOfChange {
                at: in_units(change.value),
                harmonic: change.harmonic,
                frequency_hz: change.frequency_hz,
                to_two_frequencies: change.harmonic != self.family.harmonic,
            })
        });
        BranchSummary {
            key: branch.parameter.key().to_owned(),
            cycles: branch.cycles.len(),
            range: (low <= high).then_some([low, high]),
            folds: branch.folds.iter().map(|&fold| in_units(fold)).collect(),
            ends: branch.ends.map(|end| end.describe().to_owned()),
            stability_changes: changes.collect(),
            waves: Some(WaveBranch {
                saturation_speed_rpm: saturation.map(|speed| speed * 60.0 / TAU),
                factorizations: branch.factorizations,
            }),
            motions: None,
        }
    }

    /// The exponents of the cycle at the case's own operating point, then along the branch, each with the value of its
    /// parameter.
    fn exponents(&self, own: &LimitCycle) -> Vec<(Option<f64>, Perturbation)> {
        let mut findings = vec![(0.0, &self.stability)];
        if let Some(branch) = &self.branch {
            findings[0].0 = value(branch, own);
            let along = branch.cycles.iter().map(|cycle| value(branch, cycle));
            findings.extend(along.zip(&self.branch_stability));
        }
        let rows = findings.into_iter().flat_map(|(at, finding)| {
            let exponents = known(finding).into_iter().flat_map(|found| &found.exponents);
            exponents.map(move |own| (Some(at), perturbation(own)))
        });
        rows.collect()
    }

    /// The rows of its branch.
    pub(super) fn branch_rows(&self, thickness: f64) -> Option<BranchRows> {
        let (branch, own) = (self.branch.as_ref()?, self.cycle.as_ref().ok()?);
        let rows = branch.cycles.iter().enumerate().map(|(at, cycle)| {
            let found = self.branch_stability.get(at).and_then(known);
            BranchRow {
                value: value(branch, cycle),
                harmonic: Some(cycle.harmonic),
                main_frequency_hz: cycle.frequency_hz(),
                fractions: cycle.fractions,
                powers: mean_powers(&cycle.powers, thickness),
                amplitude_m: amplitude(cycle),
                balance_residual: cycle.powers.balance_residual(),
                growth_rate: found.and_then(CycleStability::leading).map(|own| own.exponent.re),
                verdict: found.map(CycleStability::verdict),
                stepped: None,
            }
        });
        Some(BranchRows {
            key: branch.parameter.key(),
            own_value: value(branch, own),
            threshold: None,
            rows: rows.collect(),
        })
    }

    /// What the tables and figures show of its cycle and branch.
    pub(super) fn record(
        &self,
        report: &CycleReport<'_>,
        search: &WaveSearch,
    ) -> Option<MotionRecord> {
        let cycle = self.cycle.as_ref().ok()?;
        Some(MotionRecord {
            tag: self.family.tag(),
            diameters: self.family.harmonic,
            mode: 0,
            frequency_hz: cycle.frequency_hz(),
            history: cycle.points.clone(),
            edge: cycle.points.clone(),
            status: Vec::new(),
            node: 0,
            counterface_speed: search.contact.rotation_speed * search.inner_radius,
            friction_coefficient: Some(search.contact.friction_coefficient),
            nodes: Vec::new(),
            harmonics: Vec::new(),
            fields: self.frames.first().map_or_else(Default::default, |own| own.fields.clone()),
            exponents: self.stability.is_some().then(|| self.exponents(cycle)),
            branch: self.branch_rows(report.thickness),
        })
    }
}

impl KnownStability {
    /// Of a verdict and the leading perturbation.
    pub(super) fn new(verdict: Verdict, leading: Option<Perturbation>) -> Self {
        Self {
            verdict: verdict.word().to_owned(),
            is_stable: verdict.is_stable(),
            growing_harmonics: None,
            leading,
            shift: None,
        }
    }
}
