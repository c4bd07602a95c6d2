//! Record of a search for limit cycles, from which its figures are drawn again.

use crate::contact::ContactStatus;
use crate::cycle::periodic::{BranchMotion, PeriodicBranch, PeriodicPowers};
use crate::cycle::{CycleBranch, CycleStability, Family, LimitCycle, TwoWaveMotion, Verdict};
use crate::results::charts::palette::status_of_code;
use crate::results::cycle::{CycleReport, CycleResult, TwoWaveResult, amplitude, known};
use crate::results::record::Record;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Everything that the figures show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CycleRecord {
    /// One entry for each harmonic.
    pub families: Vec<FamilyRecord>,
    /// Branches of two waves that live together.
    pub two_waves: Vec<TwoWaveRecord>,
}

/// Motions of two waves along a branch, in its order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoWaveRecord {
    /// Their harmonics.
    pub harmonics: [usize; 2],
    /// The parameter, in units of its key.
    pub values: Vec<f64>,
    /// Both frequencies, Hz.
    pub frequency_hz: [Vec<f64>; 2],
    /// Both amplitudes of the edge's tangential displacement, m.
    pub amplitude: [Vec<f64>; 2],
}

impl TwoWaveRecord {
    fn is_whole(&self) -> bool {
        let mut columns = self.frequency_hz.iter().chain(&self.amplitude);
        columns.all(|column| column.len() == self.values.len())
    }

    fn of(result: &TwoWaveResult) -> Option<Self> {
        let branch = result.outcome.as_ref().ok()?.branch.as_ref()?;
        let column = |of: &dyn Fn(&TwoWaveMotion) -> f64| branch.motions.iter().map(of).collect();
        let parameter = branch.parameter;
        Some(Self {
            harmonics: result.harmonics,
            values: column(&|own| parameter.in_key_units(parameter.of(&own.state.point))),
            frequency_hz: [0, 1].map(|wave| column(&|own| own.frequencies_hz()[wave])),
            amplitude: [0, 1].map(|wave| column(&|own| own.amplitudes[wave])),
        })
    }
}

impl Record for CycleRecord {
    const MAGIC: [u8; 8] = *b"FRICSIMY";
    const VERSION: u32 = 4;

    fn inconsistency(&self) -> Option<&'static str> {
        let is_whole = |family: &FamilyRecord| {
            let branch = family.branch.as_ref();
            let wave = family.cycle.as_ref();
            (1..=HIGHEST_HARMONIC).contains(&family.harmonic)
                && (1..=HIGHEST_HARMONIC).contains(&family.onset)
                && wave.is_none_or(|wave| {
                    wave.is_whole() && family.harmonic * wave.status.len() <= MOST_PHASES
                })
                && branch.is_none_or(BranchRecord::is_whole)
        };
        let is_whole = self.families.iter().all(is_whole)
            && self.two_waves.iter().all(TwoWaveRecord::is_whole);
        (!is_whole).then_some("its harmonics, phases and branches do not fit together")
    }
}

/// More harmonics and onsets than any mesh has.
const HIGHEST_HARMONIC: usize = 100_000;

/// More phases around the whole circle than any cycle has.
const MOST_PHASES: usize = 1_000_000;

/// The limit cycles of one harmonic.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FamilyRecord {
    /// Circumferential harmonic `n`; 0 of a body without rotating waves, whose cycles have a mode.
    pub harmonic: usize,
    /// Onset of that harmonic at which the cycles are born, from 1.
    pub onset: usize,
    /// The mode that leads to the cycles of a body without rotating waves.
    #[serde(default)]
    pub mode: Option<usize>,
    /// Critical friction and frequency (Hz) of every onset.
    pub onsets: Vec<[f64; 2]>,
    /// The cycle at the case's own operating point.
    pub cycle: Option<WaveRecord>,
    /// Its branch.
    pub branch: Option<BranchRecord>,
}

/// One limit cycle: contact and motion of the edge along the phase, and the whole field at time zero.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaveRecord {
    /// Main frequency, Hz.
    pub frequency_hz: f64,
    /// Amplitude of the edge's tangential displacement, m.
    pub amplitude: f64,
    /// Status at each phase: 0 open, 1 stick, 2 slip.
    pub status: Vec<u8>,
    /// Contact pressure, Pa.
    pub pressure: Vec<f64>,
    /// Contact shear, Pa.
    pub shear: Vec<f64>,
    /// `u_r, u_theta`, m.
    pub displacement: [Vec<f64>; 2],
    /// `v_r, v_theta`, m/s.
    pub velocity: [Vec<f64>; 2],
    /// Displacement of every dof in nodal frames, m.
    pub displacement_field: Vec<f64>,
    /// Velocity, m/s.
    pub velocity_field: Vec<f64>,
}

/// Cycles along a branch, in its order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BranchRecord {
    /// Case key of the parameter.
    pub key: String,
    /// The parameter at each cycle, in units of the key.
    pub values: Vec<f64>,
    /// The case's own value.
    pub own_value: f64,
    /// Main frequency, Hz.
    pub frequency_hz: Vec<f64>,
    /// Amplitude of the edge's tangential displacement, m.
    pub amplitude: Vec<f64>,
    /// Fractions that stick, slip, are open.
    pub status: [Vec<f64>; 3],
    /// Powers relative to the external one: stick, slide, dissipated in the contact, material damping, normal contact.
    pub shares: [Vec<f64>; 5],
    /// Whether the cycle is stable, where that is known.
    pub stable: Vec<Option<bool>>,
    /// Growth rate of its leading perturbation, 1/s, where it is known.
    pub growth_rate: Vec<Option<f64>>,
    /// Parameter values at which the branch turns back.
    pub folds: Vec<f64>,
}

impl CycleRecord {
    /// What the figures show of a report.
    pub fn of(report: &CycleReport<'_>) -> Self {
        Self {
            families: report.results.iter().map(FamilyRecord::of).collect(),
            two_waves: (report.two_waves.iter()).filter_map(TwoWaveRecord::of).collect(),
        }
    }
}

impl FamilyRecord {
    /// Which limit cycles.
    pub fn family(&self) -> Family {
        Family { harmonic: self.harmonic, onset: self.onset }
    }

    /// What the figures show of the cycles of one harmonic.
    pub fn of(result: &CycleResult) -> Self {
        let onsets = result.onsets.iter();
        let found = result.cycle.as_ref().ok();
        let branch = result.branch.as_ref().zip(found);
        Self {
            harmonic: result.family.harmonic,
            onset: result.family.onset,
            mode: None,
            onsets: onsets
                .map(|onset| [onset.friction_coefficient, onset.frequency / TAU])
                .collect(),
            cycle: found
                .zip(result.frames.first())
                .map(|(cycle, frame)| WaveRecord::of(cycle, &frame.fields)),
            branch: branch.map(|(branch, cycle)| BranchRecord::of(branch, cycle, result)),
        }
    }
}

impl FamilyRecord {
    /// The branch of a mode of a body without rotating waves.
    pub fn of_mode(mode: usize, branch: &PeriodicBranch) -> Self {
        Self {
            harmonic: 0,
            onset: 0,
            mode: Some(mode),
            onsets: Vec::new(),
            cycle: None,
            branch: Some(BranchRecord::of_motions(branch)),
        }
    }
}

impl WaveRecord {
    fn is_whole(&self) -> bool {
        let count = self.status.len();
        let columns = [&self.pressure, &self.shear]
            .into_iter()
            .chain(&self.displacement)
            .chain(&self.velocity);
        (1..=MOST_PHASES).contains(&count) && columns.into_iter().all(|c| c.len() == count)
    }

    fn of(cycle: &LimitCycle, [displacement, velocity]: &[Vec<f64>; 2]) -> Self {
        let points = &cycle.points;
        let component = |i: usize| points.iter().map(|p| p.displacement[i]).collect();
        let speed = |i: usize| points.iter().map(|p| p.velocity[i]).collect();
        Self {
            frequency_hz: cycle.frequency_hz(),
            amplitude: amplitude(cycle),
            status: points.iter().map(|p| p.status as u8).collect(),
            pressure: points.iter().map(|p| p.pressure).collect(),
            shear: points.iter().map(|p| p.shear).collect(),
            displacement: [component(0), component(1)],
            velocity: [speed(0), speed(1)],
            displacement_field: displacement.clone(),
            velocity_field: velocity.clone(),
        }
    }

    /// Status at each phase.
    pub fn statuses(&self) -> Vec<ContactStatus> {
        let codes = self.status.iter();
        codes.map(|&code| status_of_code(code)).collect()
    }
}

impl BranchRecord {
    fn is_whole(&self) -> bool {
        let count = self.values.len();
        let mut columns = [&self.frequency_hz, &self.amplitude]
            .into_iter()
            .chain(&self.status)
            .chain(&self.shares);
        let known = [self.stable.len(), self.growth_rate.len()];
        columns.all(|column| column.len() == count) && known == [count; 2]
    }

    fn of_motions(branch: &PeriodicBranch) -> Self {
        let in_units = |value: f64| branch.parameter.in_key_units(value);
        let column = |of: &dyn Fn(&BranchMotion) -> f64| -> Vec<f64> {
            branch.motions.iter().map(of).collect()
        };
        let share = |of: fn(&PeriodicPowers) -> f64| {
            column(&|own| of(&own.motion.powers) / own.motion.powers.contact.external)
        };
        Self {
            key: branch.parameter.key().to_owned(),
            values: column(&|own| in_units(own.value)),
            own_value: in_units(branch.own),
            frequency_hz: column(&|own| own.motion.frequency_hz),
            amplitude: column(&|own| own.motion.amplitude),
            status: [0, 1, 2].map(|i| column(&|own| own.motion.fractions[i])),
            shares: [
                share(|powers| powers.contact.stick),
                share(|powers| powers.contact.slide),
                share(|powers| powers.contact.contact_dissipated),
                share(|powers| powers.material_damping),
                share(|powers| powers.contact.normal),
            ],
            stable: branch.motions.iter().map(BranchMotion::is_stable).collect(),
            growth_rate: branch.motions.iter().map(BranchMotion::growth_rate).collect(),
            folds: branch.folds().into_iter().map(in_units).collect(),
        }
    }

    fn of(branch: &CycleBranch, own: &LimitCycle, result: &CycleResult) -> Self {
        let value = |cycle: &LimitCycle| {
            let value = branch.parameter.of(&cycle.state.point);
            branch.parameter.in_key_units(value)
        };
        let column = |of: &dyn Fn(&LimitCycle) -> f64| -> Vec<f64> {
            branch.cycles.iter().map(of).collect()
        };
        let share = |of: fn(&LimitCycle) -> f64| column(&|c| of(c) / c.powers.external);
        let verdicts = || {
            let cycles = 0..branch.cycles.len();
            cycles.map(|i| result.branch_stability.get(i).and_then(known))
        };
        Self {
            key: branch.parameter.key().to_owned(),
            values: column(&value),
            own_value: value(own),
            frequency_hz: column(&LimitCycle::frequency_hz),
            amplitude: column(&amplitude),
            status: [0, 1, 2].map(|i| column(&|c| c.fractions[i])),
            shares: [
                share(|c| c.powers.stick),
                share(|c| c.powers.slide),
                share(|c| c.powers.contact_dissipated),
                share(|c| c.powers.material_damping),
                share(|c| c.powers.normal_contact),
            ],
            stable: verdicts()
                .map(|found| match found?.verdict() {
                    Verdict::Undecided => None,
                    verdict => Some(verdict == Verdict::Stable),
                })
                .collect(),
            growth_rate: verdicts()
                .map(|found| {
                    let leading = found.and_then(CycleStability::leading);
                    leading.map(|leading| leading.exponent.re)
                })
                .collect(),
            folds: branch.folds.iter().map(|&fold| branch.parameter.in_key_units(fold)).collect(),
        }
    }
}
