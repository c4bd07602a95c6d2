//! Frequencies, growth rates and mean powers of a recorded run.

use super::recorder::HARMONIC_COUNT;
use super::settling::Settling;
use super::vibration::{amplitudes, last_fifth, main_vibration, rms, series};
use super::{ContactPowers, Recorder, SampleRow, StatusCounts};
use crate::signal::{ExponentialStage, NoGrowth, harmonic_growth};
use std::ops::Range;

/// Growth (or decay) of one harmonic of the contact edge in the linear stage.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Circumferential harmonic.
    pub harmonic: usize,
    /// Rate (1/s) and signed frequency (Hz) with their 95 % intervals, or why there are none.
    pub stage: Result<ExponentialStage, NoGrowth>,
    /// Sense of rotation of the cylinder, +1 counter-clockwise.
    rotation_direction: f64,
}

impl Growth {
    /// +1 travels with the rotor, -1 against it; 0 without a stage.
    pub fn direction(&self) -> i8 {
        // exp(i (n theta + omega t)) travels towards negative angles.
        match &self.stage {
            Ok(stage) if stage.frequency_hz.value * self.rotation_direction > 0.0 => -1,
            Ok(_) => 1,
            Err(_) => 0,
        }
    }
}

/// Means over the last fifth of a run, for each metre of thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct LastFifth {
    /// Frequency of the strongest harmonic of the contact edge's tangential displacement, Hz; `None` if it does
    /// not vibrate.
    pub main_frequency_hz: Option<f64>,
    /// Circumferential harmonic of that vibration.
    pub main_harmonic: Option<usize>,
    /// Its root mean square amplitude, m.
    pub main_amplitude: Option<f64>,
    /// Fractions of contact nodes `[stick, slip, open]`.
    pub status: [f64; 3],
    /// Mean contact powers, W/m.
    pub powers: ContactPowers,
    /// Mean power of material damping, W/m.
    pub material_damping: f64,
    /// Mean amplitude of harmonic `n` of the tangential displacement of the contact edge, m; for `n = 0` the mean
    /// twist.
    pub harmonics: [f64; HARMONIC_COUNT],
    /// The same of every harmonic `n >= 1` that is above a thousandth of the largest of them.
    pub significant: Vec<(usize, f64)>,
    /// Motion of each probe.
    pub probes: Vec<ProbeMotion>,
}

/// How a probe moves, radially and tangentially.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProbeMotion {
    /// Half the range of the displacement, m.
    pub displacement_amplitude: [f64; 2],
    /// Root mean square of the acceleration, m/s2.
    pub acceleration_rms: [f64; 2],
    /// Largest magnitude of the acceleration, m/s2.
    pub acceleration_peak: [f64; 2],
    /// The same three along the axis of a body in three dimensions.
    pub axial: Option<[f64; 3]>,
}

/// What a run did.
#[derive(Clone, Debug, PartialEq)]
pub struct TransientAnalysis {
    /// Its last fifth.
    pub last_fifth: LastFifth,
    /// Whether it has settled, and on what.
    pub settling: Settling,
    /// Growth of each perturbed harmonic in the linear stage.
    pub growth: Vec<Growth>,
    /// End of the linear stage, the longest time with every contact node slipping (but those that steady sliding leaves open):
    /// when the first node sticks or opens, s. `None` if there is no linear stage or it lasts to the end of the run.
    pub first_nonlinearity: Option<f64>,
    /// Largest balance residual.
    pub largest_residual: f64,
}

impl TransientAnalysis {
    /// Reads `record`; growth is fitted for those of `harmonics` that it follows.
    pub fn of(record: &Recorder, harmonics: &[usize]) -> Self {
        let rows = &record.rows;
        let stage = linear_stage(rows);
        let ended = stage.end < rows.len() && !stage.is_empty();
        let residuals = rows.iter().map(|row| row.balance_residual);
        // What is seeded later grows from there.
        let seeded = rows.partition_point(|row| row.time < record.seed_time);
        let grown = stage.start.max(seeded).min(stage.end)..stage.end;
        Self {
            last_fifth: LastFifth::of(record),
            settling: Settling::of(record),
            growth: harmonics
                .iter()
                .filter_map(|&n| growth(record, grown.clone(), n))
                .collect(),
            first_nonlinearity: ended.then(|| rows[stage.end].time),
            largest_residual: residuals.fold(0.0, f64::max),
        }
    }
}

/// Longest range of samples over which every contact node slipped all the time, but for those that were open from the start of
/// a run from steady sliding.
fn linear_stage(rows: &[SampleRow]) -> Range<usize> {
    let (mut best, mut start) = (0..0, 0);
    let first = rows
        .first()
        .map_or_else(StatusCounts::default, |row| row.counts);
    let opened = match first.stick == 0 && first.slip > 0 {
        true => first.open,
        false => 0,
    };
    let is_base = |counts: &StatusCounts| {
        // Samples count the nodes of one step or of several.
        counts.stick == 0 && counts.open * first.slip == opened * counts.slip
    };
    for (i, row) in rows.iter().enumerate() {
        let is_linear = match opened {
            0 => row.counts.stick + row.counts.open == 0,
            _ => is_base(&row.counts),
        };
        if !is_linear {
            start = i + 1;
        } else if i + 1 - start > best.len() {
            best = start..i + 1;
        }
    }
    best
}

impl LastFifth {
    fn of(record: &Recorder) -> Self {
        let range = last_fifth(record);
        let rows = &record.rows[range.clone()];
        let mut counts = StatusCounts::default();
        let mut powers = ContactPowers::default();
        let (mut material_damping, mut harmonics) = (0.0, [0.0; HARMONIC_COUNT]);
        let share = 1.0 / rows.len() as f64;
        for row in rows {
            counts += row.counts;
            powers += row.powers.scaled(share);
            material_damping += share * row.material_damping;
            for (sum, [re, im]) in harmonics.iter_mut().zip(row.harmonics) {
                *sum += share * re.hypot(im);
            }
        }
        let main = main_vibration(record, range.clone());
        let main_amplitude = main.and_then(|(n, _)| Some(rms(&series(record, range.clone(), n)?)));
        Self {
            main_frequency_hz: main.map(|(_, frequency)| frequency.abs()),
            main_harmonic: main.map(|(harmonic, _)| harmonic),
            main_amplitude,
            status: counts.fractions(),
            powers,
            material_damping,
            harmonics,
            significant: significant(record, range.clone()),
            probes: record
                .probe_rows
                .iter()
                .enumerate()
                .map(|(probe, rows)| ProbeMotion {
                    axial: record
                        .axial_rows
                        .get(probe)
                        .map(|rows| axial_motion(&rows[range.clone()])),
                    ..ProbeMotion::of(&rows[range.clone()])
                })
                .collect(),
        }
    }
}

/// Mean amplitudes of the harmonics that matter, without the mean twist.
fn significant(record: &Recorder, range: Range<usize>) -> Vec<(usize, f64)> {
    let share = 1.0 / range.len() as f64;
    let mean = |n: usize| {
        let amplitudes = range.clone().filter_map(|k| record.amplitude(k, n));
        amplitudes.map(|[re, im]| share * re.hypot(im)).sum::<f64>()
    };
    let followed = record.followed_harmonics().skip(1);
    let means: Vec<(usize, f64)> = followed.map(|n| (n, mean(n))).collect();
    let largest = means.iter().fold(0.0, |m: f64, (_, a)| m.max(*a));
    let limit = super::recorder::SIGNIFICANT_SHARE * largest;
    let above = |&(_, amplitude): &(usize, f64)| amplitude > 0.0 && amplitude >= limit;
    means.into_iter().filter(above).collect()
}

impl ProbeMotion {
    fn of(rows: &[[f64; 6]]) -> Self {
        let both = |of: &dyn Fn(usize) -> f64| [of(0), of(1)];
        let column = |c: usize| rows.iter().map(move |row| row[c]);
        let largest = |c: usize| column(c).fold(f64::NEG_INFINITY, f64::max);
        let smallest = |c: usize| column(c).fold(f64::INFINITY, f64::min);
        let mean_square = |c: usize| column(c).map(|v| v * v).sum::<f64>() / rows.len() as f64;
        Self {
            displacement_amplitude: both(&|c| 0.5 * (largest(c) - smallest(c))),
            acceleration_rms: both(&|c| mean_square(4 + c).sqrt()),
            acceleration_peak: both(&|c| column(4 + c).fold(0.0, |m, v| m.max(v.abs()))),
            axial: None,
        }
    }
}

/// Half the range of `u_z` (m), root mean square and largest magnitude of `a_z` (m/s2).
fn axial_motion(rows: &[[f64; 4]]) -> [f64; 3] {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut square, mut peak) = (0.0, 0.0_f64);
    for [u, _, a, _] in rows {
        (low, high) = (low.min(*u), high.max(*u));
        square += a * a;
        peak = peak.max(a.abs());
    }
    let rms = (square / rows.len() as f64).sqrt();
    [0.5 * (high - low), rms, peak]
}

fn growth(record: &Recorder, stage: Range<usize>, harmonic: usize) -> Option<Growth> {
    let series = amplitudes(record, stage.clone(), harmonic)?;
    let motion = record.largest_motion(stage);
    Some(Growth {
        harmonic,
        stage: harmonic_growth(&series, 1.0 / record.sample_interval, motion),
        rotation_direction: record.rotation_direction,
    })
}
