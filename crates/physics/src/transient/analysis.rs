//! Frequencies, growth rates and mean powers of a recorded run.

use super::recorder::HARMONIC_COUNT;
use super::settling::{Settling, Unsettled};
use super::vibration::{amplitudes, last_fifth, main_vibration, rms, series};
use super::{ContactPowers, Recorder, SampleRow, StatusCounts};
use crate::signal::{ExponentialStage, NoGrowth, harmonic_growth, strongest_vibration};
use std::ops::Range;

/// Highest power of a growing wave that is told from a mode of its harmonic.
const HIGHEST_POWER: usize = 3;
/// Relative distance of rate and frequency within which a wave is such a power.
const POWER_RATE: f64 = 0.03;
const POWER_FREQUENCY: f64 = 1e-3;

/// Growth (or decay) of one vibration of the contact edge in the linear stage.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Circumferential harmonic; none of the strongest vibration of a body without symmetry, whose modes are no harmonics.
    pub harmonic: Option<usize>,
    /// Rate (1/s) and signed frequency (Hz) with their 95 % intervals, or why there are none.
    pub stage: Result<ExponentialStage, NoGrowth>,
    /// Sense of rotation of the cylinder, +1 counter-clockwise.
    rotation_direction: f64,
}

impl Growth {
    /// +1 travels with the rotor, -1 against it; 0 without a stage, and on a body without symmetry.
    pub fn direction(&self) -> i8 {
        // exp(i (n theta + omega t)) travels towards negative angles.
        match &self.stage {
            _ if self.harmonic.is_none() => 0,
            Ok(stage) if stage.frequency_hz.value * self.rotation_direction > 0.0 => -1,
            Ok(_) => 1,
            Err(_) => 0,
        }
    }
}

/// Means over the last fifth of a run, for each metre of thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct LastFifth {
    /// Frequency of the strongest harmonic of the contact edge's tangential displacement, Hz; `None` if it does not vibrate.
    pub main_frequency_hz: Option<f64>,
    /// Circumferential harmonic of that vibration; a body without symmetry has none.
    pub main_harmonic: Option<usize>,
    /// Its root mean square amplitude, m.
    pub main_amplitude: Option<f64>,
    /// Fractions of contact nodes `[stick, slip, open]`.
    pub status: [f64; 3],
    /// Mean contact powers, W/m.
    pub powers: ContactPowers,
    /// Mean power of material damping, W/m.
    pub material_damping: f64,
    /// Mean amplitude of harmonic `n` of the tangential displacement of the contact edge, m; for `n = 0` the mean twist.
    pub harmonics: [f64; HARMONIC_COUNT],
    /// The same of every harmonic `n >= 1` that is above a thousandth of the largest of them.
    pub significant: Vec<(usize, f64)>,
    /// Motion of each probe: radially, tangentially, and along the axis of a body in three dimensions.
    pub probes: Vec<Vec<ProbeMotion>>,
}

/// Motion in one direction.
#[derive(Clone, Copy, Debug, PartialEq, crate::output::Described, serde::Serialize)]
pub struct ProbeMotion {
    /// Half the range of the displacement, m.
    pub displacement_amplitude_m: f64,
    /// Root mean square acceleration, m/s2.
    pub acceleration_rms_m_per_s2: f64,
    /// Largest acceleration, m/s2.
    pub acceleration_peak_m_per_s2: f64,
}

/// What a run did.
#[derive(Clone, Debug, PartialEq)]
pub struct TransientAnalysis {
    /// Its last fifth.
    pub last_fifth: LastFifth,
    /// Whether it has settled, and on what.
    pub settling: Settling,
    /// Growth in the linear stage: of each perturbed harmonic, or of the strongest vibration of a body without symmetry.
    pub growth: Vec<Growth>,
    /// End of the linear stage, the longest time with every contact node slipping (but those that steady sliding leaves open):
    /// when the first node sticks or opens, s. `None` if there is no linear stage or it lasts to the end of the run.
    pub first_nonlinearity: Option<f64>,
    /// Largest balance residual.
    pub largest_residual: f64,
}

impl TransientAnalysis {
    /// Reads the `record` of a body whose motion has circumferential harmonics; growth is fitted for those of `harmonics` that it follows.
    pub fn of(record: &Recorder, harmonics: &[usize]) -> Self {
        let mut analysis = Self::without_growth(record);
        let stage = grown_samples(record);
        let fitted = harmonics.iter();
        analysis.growth = fitted.filter_map(|&n| growth(record, stage.clone(), n)).collect();
        refuse_powers(&mut analysis.growth);
        analysis
    }

    /// Reads the `record` of a body without symmetry, whose vibrations are modes and no harmonics; growth is that of the
    /// strongest vibration of its contact edge at the end of the linear stage.
    pub fn without_symmetry(record: &Recorder) -> Self {
        let mut analysis = Self::without_growth(record);
        let stage = grown_samples(record);
        let late = stage.start + 2 * stage.len() / 3..stage.end;
        let size = |n: usize| {
            let series = series(record, late.clone(), n)?;
            Some(strongest_vibration(&series, 1.0 / record.sample_interval)?.1)
        };
        let sizes = record.followed_harmonics().map(|n| (n, size(n).unwrap_or(0.0)));
        // The edge moves with its modes: its harmonics are so many sensors.
        let sensor = sizes.max_by(|a, b| a.1.total_cmp(&b.1));
        analysis.growth = sensor.and_then(|(n, _)| growth(record, stage, n)).into_iter().collect();
        analysis.growth.iter_mut().for_each(|growth| growth.harmonic = None);
        if let Some(Unsettled::Growing { harmonic, .. }) = &mut analysis.settling.reason {
            *harmonic = None;
        }
        analysis.last_fifth.main_harmonic = None;
        analysis.last_fifth.significant = Vec::new();
        analysis
    }

    /// Reads a record of which no growth is wanted.
    fn without_growth(record: &Recorder) -> Self {
        let rows = &record.rows;
        let stage = linear_stage(rows);
        let ended = stage.end < rows.len() && !stage.is_empty();
        let residuals = rows.iter().map(|row| row.balance_residual);
        Self {
            last_fifth: LastFifth::of(record),
            settling: Settling::of(record),
            growth: Vec::new(),
            first_nonlinearity: ended.then(|| rows[stage.end].time),
            largest_residual: residuals.fold(0.0, f64::max),
        }
    }
}

/// Samples of the linear stage after the perturbation: what is seeded later grows from there.
fn grown_samples(record: &Recorder) -> Range<usize> {
    let stage = linear_stage(&record.rows);
    let seeded = record.rows.partition_point(|row| row.time < record.seed_time);
    stage.start.max(seeded).min(stage.end)..stage.end
}

/// Takes the rate from harmonics that only hold the square or the cube of a growing wave: where friction depends on speed,
/// a wave `e^{i n theta + lambda t}` drives `e^{2 i n theta + 2 lambda t}`, which is no mode of harmonic `2 n`.
fn refuse_powers(growths: &mut [Growth]) {
    let waves: Vec<(usize, f64, f64)> = growths
        .iter()
        .filter_map(|growth| {
            let stage = growth.stage.as_ref().ok()?;
            let (rate, frequency) = (stage.rate_per_s.value, stage.frequency_hz.value);
            Some((growth.harmonic?, rate, frequency))
        })
        .filter(|wave| wave.1 > 0.0 && wave.0 > 0)
        .collect();
    for growth in growths {
        let (Some(own), Ok(stage)) = (growth.harmonic, &growth.stage) else { continue };
        let is_near = |value: f64, expected: f64, share: f64| {
            (value - expected).abs() < share * expected.abs()
        };
        let power = |&(harmonic, rate, frequency): &(usize, f64, f64)| {
            let mut powers = 2..=HIGHEST_POWER;
            powers.any(|k| {
                own == k * harmonic
                    && is_near(stage.rate_per_s.value, k as f64 * rate, POWER_RATE)
                    && is_near(stage.frequency_hz.value, k as f64 * frequency, POWER_FREQUENCY)
            })
        };
        if let Some(&(harmonic, ..)) = waves.iter().find(|wave| power(wave)) {
            growth.stage = Err(NoGrowth::Power(harmonic));
        }
    }
}

/// Longest range of samples over which every contact node slipped all the time, but for those that were open from the start of
/// a run from steady sliding.
fn linear_stage(rows: &[SampleRow]) -> Range<usize> {
    let (mut best, mut start) = (0..0, 0);
    let first = rows.first().map_or_else(StatusCounts::default, |row| row.counts);
    // Open and slipping nodes at the start: samples count the nodes of one step or of several.
    let is_base = first.stick == 0 && first.slip > 0;
    let [opened, slipped] = if is_base { [first.open, first.slip] } else { [0, 1] };
    for (i, row) in rows.iter().enumerate() {
        if row.counts.stick > 0 || row.counts.open * slipped != opened * row.counts.slip {
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
        let (mut counts, mut powers) = (StatusCounts::default(), ContactPowers::default());
        let share = 1.0 / rows.len() as f64;
        for row in rows {
            counts += row.counts;
            powers += row.powers.scaled(share);
        }
        let material_damping = rows.iter().map(|row| share * row.material_damping).sum();
        let mean = |n: usize| -> f64 {
            let amplitudes = range.clone().filter_map(|k| record.amplitude(k, n));
            amplitudes.map(|[re, im]| share * re.hypot(im)).sum()
        };
        let main = main_vibration(record, range.clone());
        let main_amplitude = main.and_then(|(n, _)| Some(rms(&series(record, range.clone(), n)?)));
        Self {
            main_frequency_hz: main.map(|(_, frequency)| frequency.abs()),
            main_harmonic: main.map(|(harmonic, _)| harmonic),
            main_amplitude,
            status: counts.fractions(),
            powers,
            material_damping,
            harmonics: std::array::from_fn(mean),
            significant: record.significant(mean),
            probes: probes(record, &range),
        }
    }
}

/// Motion of each probe in its two or three directions.
fn probes(record: &Recorder, range: &Range<usize>) -> Vec<Vec<ProbeMotion>> {
    let probes = record.probe_rows.iter().enumerate().map(|(probe, rows)| {
        let rows = &rows[range.clone()];
        let plane = [0, 1].map(|c| ProbeMotion::of(rows.iter().map(|row| [row[c], row[4 + c]])));
        let moved = |row: &[f64; 4]| [row[0], row[2]];
        let axial = record.axial_rows.get(probe).map(|rows| rows[range.clone()].iter().map(moved));
        plane.into_iter().chain(axial.map(ProbeMotion::of)).collect()
    });
    probes.collect()
}

impl ProbeMotion {
    /// Of samples of displacement (m) and acceleration (m/s2).
    fn of(samples: impl ExactSizeIterator<Item = [f64; 2]> + Clone) -> Self {
        let count = samples.len() as f64;
        let [low, high] = crate::order::range(samples.clone().map(|[u, _]| u));
        let (mut square, mut peak) = (0.0, 0.0_f64);
        for [_, a] in samples {
            square += a * a;
            peak = peak.max(a.abs());
        }
        Self {
            displacement_amplitude_m: 0.5 * (high - low),
            acceleration_rms_m_per_s2: (square / count).sqrt(),
            acceleration_peak_m_per_s2: peak,
        }
    }
}

fn growth(record: &Recorder, stage: Range<usize>, harmonic: usize) -> Option<Growth> {
    let series = amplitudes(record, stage.clone(), harmonic)?;
    let motion = record.largest_motion(stage);
    let found = harmonic_growth(&series, 1.0 / record.sample_interval, motion);
    let is_clear = |own: &ExponentialStage| own.is_growing() || own.is_decaying();
    Some(Growth {
        harmonic: Some(harmonic),
        stage: found.and_then(|own| {
            if is_clear(&own) { Ok(own) } else { Err(NoGrowth::Unclear(own.rate_per_s)) }
        }),
        rotation_direction: record.rotation_direction,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::Estimate;

    #[test]
    fn the_square_of_a_growing_wave_is_no_stage_of_twice_its_harmonic() {
        let exactly = |value: f64| Estimate { value, low: value, high: value };
        let growth = |harmonic: usize, rate: f64, frequency: f64| Growth {
            harmonic: Some(harmonic),
            stage: Ok(ExponentialStage {
                start_s: 0.0,
                end_s: 1.0,
                rate_per_s: exactly(rate),
                frequency_hz: exactly(frequency),
                initial_amplitude: 1e-9,
                deviation: 0.0,
            }),
            rotation_direction: 1.0,
        };
        let mut growths = [
            growth(1, 1480.0, -10_500.0),
            growth(2, 2962.0, -21_001.0),
            growth(3, 4440.0, -31_500.0),
            growth(4, 2960.0, -21_000.0),
            growth(2, 950.0, -9930.0),
        ];
        refuse_powers(&mut growths);
        let is_own = growths.map(|growth| growth.stage.is_ok());
        assert_eq!(is_own, [true, false, false, true, true]);
    }

    /// A dashpot of 1e300 Pa s/m asks for that: `check` ended in an overflow.
    #[test]
    fn more_steps_than_can_be_counted_are_the_most_that_can() {
        let plan = crate::transient::settings::StepPlan {
            time_step: 1e-300,
            limit: 1e-300,
            largest_frequency: 1e300,
            steps_per_sample: u64::MAX,
            samples: 3,
            sample_interval: 1e-6,
        };
        assert_eq!(plan.total_steps(), u64::MAX);
    }
}
