//! `summary.json` of a search for limit cycles.

use super::branch::{BranchRecord, BranchSummary, FamilyRecord};
use super::record::{CycleMotion, CycleName, Exponent, ModeSummary, OnsetSummary};
use super::two_waves::TwoWaveSummary;
use super::verdicts::{ConfirmationRun, ConfirmationSummary, KnownStability, StabilitySummary};
use crate::common::*;

keys! {
    /// `summary.json` of `frictionsim cycle`.
    CycleSummary {
        steady_sliding_stable: bool = "whether nothing looked at grows";
        #[serde(flatten)]
        origin: Origin = "where the search has started";
        critical_value?: CriticalValue = "where along the parameter of the case sliding \
            loses its stability, where it is stable at its own operating point";
        extent: Extent = "what powers are of, in the tables too";
        cycles: Vec<SoughtCycle> = "the cycles that were sought, each with its motion or why there is none";
        #[serde(skip_serializing_if = "Vec::is_empty")]
        two_waves: Vec<TwoWaveSummary> = "motions of two waves that live together";
        notes: Vec<String> = "what there is to say";
        curves?: Vec<FamilyRecord> = "the branches, where no tables hold them: at a point of a study";
        #[serde(skip)]
        friction_coefficient: f64 = "friction coefficient of the case";
    }
}

impl CycleSummary {
    /// Of what a search has led to, with what is to be said of it.
    pub fn new(
        origin: Origin,
        critical_value: Option<CriticalValue>,
        (friction_coefficient, extent): (f64, Extent),
        cycles: Vec<SoughtCycle>,
        two_waves: Vec<TwoWaveSummary>,
    ) -> Self {
        let steady_sliding_stable = match &origin {
            Origin::Waves { lowest_onset } => {
                cycles.iter().all(|own| own.absent.is_some())
                    && lowest_onset
                        .is_none_or(|onset| onset.critical_friction >= friction_coefficient)
            }
            Origin::Modes { least_stable, .. } => {
                least_stable.is_none_or(|mode| mode.growth_rate_per_s <= 0.0)
            }
        };
        let own = Self {
            steady_sliding_stable,
            origin,
            critical_value,
            extent,
            cycles,
            two_waves,
            notes: Vec::new(),
            curves: None,
            friction_coefficient,
        };
        Self { notes: own.said(), ..own }
    }

    /// The branches, for a study that writes no tables of them.
    pub fn families(&self) -> Vec<FamilyRecord> {
        let families = self.cycles.iter().map(|own| own.family(self.extent));
        families.filter(|own| own.mode.is_none() || own.branch.is_some()).collect()
    }

    /// The contact of motions of the whole mesh.
    pub(super) fn interface(&self) -> Option<&ContactInterface> {
        if let Origin::Modes { interface, .. } = &self.origin { Some(interface) } else { None }
    }
}

/// What a search has started from.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
#[serde(untagged)]
pub enum Origin {
    /// From modes of steady sliding of a body without rotating waves.
    Modes {
        /// Modes of steady sliding looked at.
        modes: usize,
        /// The mode that grows fastest or decays slowest.
        least_stable: Option<ModeSummary>,
        /// Frequency of the highest, Hz.
        #[serde(skip)]
        highest_hz: f64,
        /// Case key and value at which the search has started, where no mode grows at the case's own.
        #[serde(skip)]
        start: Option<(&'static str, f64)>,
        /// The contact nodes.
        #[serde(skip)]
        interface: ContactInterface,
    },
    /// From waves of a disc.
    Waves {
        /// The lowest onset of all.
        lowest_onset: Option<OnsetSummary>,
    },
}

keys! {
    /// A limit cycle that was sought.
    SoughtCycle {
        #[serde(flatten)]
        name: CycleName = "what leads to it";
        wall_s: f64 = "wall time, s";
        #[serde(flatten)]
        cycle: Option<CycleMotion> = "the cycle, where there is one that no other has led to before";
        absent?: String = "that there is none because steady sliding is stable against the wave";
        error?: String = "why none was found";
        confirmation: Option<ConfirmationSummary> = "what a transient says of it, where one was asked for";
        stability: Option<StabilitySummary> = "its stability, where it was asked for";
        branch?: BranchSummary = "its branch over the case's parameter";
        #[serde(skip)]
        motion: PeriodicMotion = "its motion, where there is a cycle, which tables and figures show";
        #[serde(skip)]
        exponents: Option<Vec<Exponent>> = "its exponents or multipliers, where they are known";
    }
}

impl SoughtCycle {
    /// One of which nothing is known.
    pub(super) fn new(name: CycleName, wall_s: f64) -> Self {
        Self {
            name,
            wall_s,
            cycle: None,
            absent: None,
            error: None,
            confirmation: None,
            stability: None,
            branch: None,
            motion: PeriodicMotion::default(),
            exponents: None,
        }
    }

    /// Whether it is a wave of a disc.
    pub(super) fn is_wave(&self) -> bool {
        self.name.wave().is_some()
    }

    /// Nodal diameters of a wave; 0 of a motion of the whole mesh.
    pub(super) fn diameters(&self) -> usize {
        self.name.wave().map_or(0, |wave| wave.harmonic)
    }

    /// Whose it is: `2 nodal diameters`, or its frequency.
    pub(super) fn whose(&self) -> String {
        match &self.name {
            CycleName::Wave(wave) => format!("{} nodal diameters", wave.harmonic),
            CycleName::Mode(_) => format!("{:.2} Hz", self.motion.frequency_hz),
        }
    }

    /// The heading of its pictures.
    pub(super) fn heading(&self) -> String {
        let name = match &self.name {
            CycleName::Wave(wave) => format!("*n* = {}", wave.harmonic),
            CycleName::Mode(own) => own.mode.to_string(),
        };
        format!("{name}, {:.2} kHz", self.motion.frequency_hz * 1e-3)
    }

    /// All contact nodes at time zero, of a wave along the phase.
    pub(super) fn edge(&self) -> &[PhasePoint] {
        self.motion.instants.first().map_or(&[], Vec::as_slice)
    }

    /// Contact and motion over the period: of the contact node that moves most, of a wave of any.
    pub(super) fn history(&self) -> Vec<PhasePoint> {
        match self.is_wave() {
            true => self.edge().to_vec(),
            false => self.motion.instants.iter().map(|at| at[self.motion.node]).collect(),
        }
    }

    /// Its stability, where it is known.
    pub(super) fn known(&self) -> Option<&KnownStability> {
        if let Some(StabilitySummary::Known(known)) = &self.stability { Some(known) } else { None }
    }

    /// The transient that started on it, if one ran.
    pub(super) fn run(&self) -> Option<&ConfirmationRun> {
        if let Some(ConfirmationSummary::Ran(run)) = &self.confirmation { Some(run) } else { None }
    }

    /// Whether a transient that started on it has stayed there.
    pub(super) fn agrees(&self) -> Option<bool> {
        self.confirmation.as_ref()?;
        Some(self.run().is_some_and(|run| run.agrees))
    }

    /// Its family, and the columns of its branch.
    pub(super) fn family(&self, extent: Extent) -> FamilyRecord {
        let onset = |own: &OnsetSummary| [own.critical_friction, own.frequency_hz];
        let (harmonic, onset, mode, onsets) = match &self.name {
            CycleName::Wave(own) => {
                (own.harmonic, own.onset, None, own.onsets.iter().map(onset).collect())
            }
            CycleName::Mode(own) => (0, 0, Some(own.mode.mode), Vec::new()),
        };
        let amplitude = |own: &CycleMotion| own.amplitude_m.unwrap_or(f64::NAN);
        let cycle = self.cycle.as_ref().map(|own| [own.main_frequency_hz, amplitude(own)]);
        let branch = self.branch.as_ref().map(|branch| BranchRecord::of(branch, extent));
        FamilyRecord { harmonic, onset, mode, onsets, cycle, branch }
    }
}
