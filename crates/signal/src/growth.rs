//! Growth rate and frequency of the exponential stage of a vibration.

mod beat;
mod demodulation;
mod harmonic;

pub use harmonic::{harmonic_growth, strongest_vibration};

use super::lines::{largest, loudest_parts};
use super::spectrum::{centred, check_signal};
use super::{Window, error::SignalError, main_frequency, modal::Estimate};
use demodulation::{Demodulated, demodulate, line, prefix_sums};
use frictionsim_output::Described;
use serde::Serialize;

/// Periods in the demodulation window: its pass band is a third of the frequency to either side,
/// and -92 dB outside, so a constant, a drift and superharmonics stay out.
const PERIODS: f64 = 12.0;
/// Largest rms deviation of the logarithmic envelope from a line, tried in turn.
const TOLERANCES: [f64; 4] = [0.01, 0.03, 0.1, LARGEST_DEVIATION];
/// Largest rms deviation of the logarithmic envelope of what is still called exponential.
const LARGEST_DEVIATION: f64 = 0.2;
/// Share of a beat in a record.
const LEAST_BEAT: f64 = 0.2;
/// Ends of the search grid.
const GRID: usize = 300;

/// Amplitude below which a vibration is round-off: 1024 eps of the largest amplitude beside it.
///
/// Each step adds an error of about eps of the motion, and the body keeps some tens of them: round-off lies
/// near 10 eps. A hundred times that leaves 1 % of it in an amplitude.
pub fn round_off_floor(largest_motion: f64) -> f64 {
    1024.0 * f64::EPSILON * largest_motion.abs()
}

/// A stretch of a signal that grows or decays as `A e^{sigma t} cos(2 pi f t + phi)`.
///
/// The rate is `sigma`, negative for a decay; the frequency `f` is signed for a complex series.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct ExponentialStage {
    /// Begin, s after the first sample.
    pub start_s: f64,
    /// End, s after the first sample.
    pub end_s: f64,
    /// Rate, 1/s, with its 95 % interval.
    pub rate_per_s: Estimate,
    /// Frequency, Hz, with its 95 % interval.
    pub frequency_hz: Estimate,
    /// Amplitude at the start of the stage, unit of the signal.
    #[serde(skip)]
    pub initial_amplitude: f64,
    /// Root mean square deviation of the logarithmic envelope from a line.
    pub deviation: f64,
}

impl ExponentialStage {
    /// Whether the whole 95 % interval of the rate is positive.
    pub fn is_growing(&self) -> bool {
        self.rate_per_s.low > 0.0
    }

    /// Whether the whole 95 % interval of the rate is negative.
    pub fn is_decaying(&self) -> bool {
        self.rate_per_s.high < 0.0
    }

    /// The stage of a part of a signal that begins so many seconds after the first sample.
    pub fn later(self, by_s: f64) -> Self {
        Self { start_s: self.start_s + by_s, end_s: self.end_s + by_s, ..self }
    }

    /// Until when a signal vibrates that has grown in this stage, s after the first sample.
    ///
    /// That is its end where a line of its last fifth, or else the last instant at which the envelope about the
    /// frequency of the stage, has half the amplitude at the end of the stage.
    pub fn lasts_until(&self, samples: &[f64], sampling_rate: f64) -> f64 {
        let (rate, frequency_hz) = (self.rate_per_s.value, self.frequency_hz.value);
        let half = 0.5 * self.initial_amplitude * (rate * (self.end_s - self.start_s)).exp();
        let line = main_frequency(&samples[samples.len() / 5 * 4..], sampling_rate);
        if line.is_ok_and(|line| line.amplitude >= half) {
            return samples.len() as f64 / sampling_rate;
        }
        let last = demodulated(samples, sampling_rate, frequency_hz).ok().and_then(|signal| {
            let last = signal.log_amplitude.iter().rposition(|level| level.exp() >= half)?;
            Some(signal.times[last] + 0.5 * PERIODS / frequency_hz)
        });
        last.unwrap_or(self.end_s)
    }
}

/// Why a signal has no growth rate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoGrowth {
    /// Too few periods: those there are, and those needed.
    #[error("too short: {0:.0} periods, {1:.0} are needed for a growth rate")]
    TooShort(f64, f64),
    /// Too few samples in a period: those there are, and those needed.
    #[error(
        "{0:.2} samples a period are too few for a growth rate: sample {1:.1} times as fast or faster"
    )]
    TooCoarse(f64, f64),
    /// An amplitude that is made of round-off, and the smallest of a vibration, unit of the signal.
    #[error(
        "no vibration above round-off: its amplitude of {0:.1e} is within {1:.1e}, 1024 eps of the largest motion"
    )]
    BelowRoundOff(f64, f64),
    /// An envelope that is no exponential.
    #[error(
        "the envelope at {0:.1} Hz has no exponential stretch over which it changes by a factor e"
    )]
    NotExponential(f64),
    /// A part of the beat of two steady vibrations about a frequency, and their distance, Hz.
    #[error(
        "the envelope at {0:.1} Hz is the beat of two lines {1:.3} Hz apart, not growth or decay"
    )]
    Beat(f64, f64),
    /// A rate whose interval holds zero.
    #[error(
        "its rate of {:.3} 1/s may be anything from {:.3} to {:.3} 1/s: neither growth nor decay",
        .0.value, .0.low, .0.high
    )]
    Unclear(Estimate),
    /// A power of another wave, which grows so many times as fast at so many times its frequency.
    #[error("it holds a power of the growing wave of harmonic {0}, and no mode of its own")]
    Power(usize),
    /// No vibration stands out of the noise of so many seconds.
    #[error("no line stands out from the noise between 0 and {0:.4} s")]
    NoLine(f64),
    /// A signal that cannot be analysed.
    #[error(transparent)]
    Signal(#[from] SignalError),
}

/// Finds the exponential stage of a signal and fits its rate and frequency.
///
/// The signal is demodulated at its strongest line, or the part about its loudest block at the line of that where the
/// whole has none (a burst) or where that neither grows nor decays (a hum), then at the strongest within the stage,
/// `z(t) = sum_j w_j x_j e^{-2 pi i f t_j}` over 12 periods; for a pure exponential the filter is exact. The stage is
/// the interval over which `ln |z|` changes most while it deviates from a line by no more than 1 % rms (then 3, 10,
/// 20 %) and stays above 1024 eps of the largest sample; a growing stage is preferred to a decaying one. A tenth at
/// each end is cut off, where saturation would bias the slope. Rate and frequency are least-squares slopes of `ln |z|`
/// and of the phase; their intervals count one independent value for each window length. A stage lasts 24 periods at
/// least, and its rate's interval leaves out zero. Does not separate two modes closer than a third of the frequency:
/// they beat, and the stage found is one where they do not; where both are steady there is none.
///
/// # Errors
/// [`NoGrowth`]: a record under 36 periods, nothing above round-off, no such interval, samples that are not finite.
pub fn exponential_stage(
    samples: &[f64],
    sampling_rate: f64,
) -> Result<ExponentialStage, NoGrowth> {
    check_signal(samples, sampling_rate, 16)?;
    let (frequency, part) = match main_frequency(samples, sampling_rate) {
        Err(SignalError::NoResonance { .. }) => {
            let none = NoGrowth::NoLine(samples.len() as f64 / sampling_rate);
            loudest_parts(samples, sampling_rate).next().ok_or(none)?
        }
        line => (line?.frequency_hz, 0..samples.len()),
    };
    let begin = part.start as f64 / sampling_rate;
    let stage = stage_at(&samples[part], sampling_rate, frequency);
    stage.map(|own| own.later(begin)).or_else(|none| {
        // Beside a steady hum another line may grow, of which the loudest part has more.
        let louder =
            loudest_parts(samples, sampling_rate).find(|(own, _)| !is_near(*own, frequency));
        louder.and_then(|(own, _)| stage_at(samples, sampling_rate, own).ok()).ok_or(none)
    })
}

/// Whether two frequencies are of one vibration, which changes a little as it grows.
fn is_near(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() < 0.02
}

/// The exponential stage about a frequency, Hz, or about that of the stage found.
fn stage_at(
    samples: &[f64],
    sampling_rate: f64,
    mut frequency: f64,
) -> Result<ExponentialStage, NoGrowth> {
    let mut stage = search(samples, sampling_rate, frequency)?;
    // The stage may vibrate elsewhere than the limit cycle that dominates the record.
    for _ in 0..2 {
        let range = |t: f64| ((t * sampling_rate) as usize).min(samples.len());
        let part = &samples[range(stage.start_s)..range(stage.end_s)];
        let Ok(line) = main_frequency(part, sampling_rate) else { break };
        if is_near(line.frequency_hz, frequency) {
            break;
        }
        let Ok(better) = search(samples, sampling_rate, line.frequency_hz) else { break };
        (stage, frequency) = (better, line.frequency_hz);
    }
    let signal = demodulated(samples, sampling_rate, frequency)?;
    // Growth along a straight line looks like a small part of a beat.
    let least = LEAST_BEAT * sampling_rate / samples.len() as f64;
    match beat::beat(&signal, &stage) {
        Some(apart_hz) if apart_hz < least => Err(NoGrowth::NotExponential(frequency)),
        Some(apart_hz) => Err(NoGrowth::Beat(frequency, apart_hz)),
        None => Ok(stage),
    }
}

fn search(
    samples: &[f64],
    sampling_rate: f64,
    frequency_hz: f64,
) -> Result<ExponentialStage, NoGrowth> {
    let signal = demodulated(samples, sampling_rate, frequency_hz)?;
    let floor = round_off_floor(largest(samples));
    let amplitude = signal.log_amplitude.iter().copied().fold(f64::MIN, f64::max).exp();
    if amplitude <= floor {
        return Err(NoGrowth::BelowRoundOff(amplitude, floor));
    }
    for tolerance in TOLERANCES {
        for growing in [true, false] {
            if let Some((first, last)) = longest_line(&signal, floor.ln(), tolerance, growing) {
                let cut = (last - first) / 10;
                let stage = signal.fit(first + cut, last - cut).ok();
                if let Some(stage) = stage.filter(|own| own.is_growing() || own.is_decaying()) {
                    return Ok(stage);
                }
            }
        }
    }
    Err(NoGrowth::NotExponential(frequency_hz))
}

/// Complex demodulation at one value each period; the envelope is the amplitude of the real vibration.
fn demodulated(
    samples: &[f64],
    sampling_rate: f64,
    frequency_hz: f64,
) -> Result<Demodulated, NoGrowth> {
    super::error::check_positive("frequency", frequency_hz, "")?;
    let block = (PERIODS * sampling_rate / frequency_hz).round() as usize;
    let hop = ((sampling_rate / frequency_hz).round() as usize).max(1);
    if block < 32 {
        let each = sampling_rate / frequency_hz;
        return Err(NoGrowth::TooCoarse(each, 32.0 / PERIODS / each));
    }
    if samples.len() < 3 * block {
        let periods = samples.len() as f64 * frequency_hz / sampling_rate;
        return Err(NoGrowth::TooShort(periods, 3.0 * PERIODS));
    }
    // Half of a real vibration turns one way, half the other.
    let doubled: Vec<f64> = centred(samples).iter().map(|x| 2.0 * x).collect();
    let taper = Window::BlackmanHarris.coefficients(block);
    Ok(demodulate(&doubled, sampling_rate, frequency_hz, &taper, hop))
}

/// The interval over which the logarithmic envelope changes most while it stays within
/// `tolerance` rms of a line and above `floor`; `None` if the change is below a factor e.
fn longest_line(
    signal: &Demodulated,
    floor: f64,
    tolerance: f64,
    growing: bool,
) -> Option<(usize, usize)> {
    let n = signal.times.len();
    let sums = prefix_sums(&signal.times, &signal.log_amplitude);
    let stride = n.div_ceil(GRID);
    let shortest = (2.0 * signal.correlated).ceil() as usize;
    let (mut best, mut best_gain) = (None, 1.0);
    for first in (0..n).step_by(stride) {
        let above = signal.log_amplitude[first..].iter().take_while(|a| **a > floor);
        let end = first + above.count();
        for last in ((first + shortest)..=end).rev().step_by(stride) {
            let (slope, deviation) = line(&sums, first, last);
            let gain = slope * (signal.times[last - 1] - signal.times[first]);
            let gain = if growing { gain } else { -gain };
            if gain > best_gain && deviation <= tolerance {
                (best, best_gain) = (Some((first, last)), gain);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{gaussian_sequence, sampled};
    use std::f64::consts::TAU;

    /// Rate and frequency over the whole record, without search or cut.
    fn over_all(samples: &[f64], sampling_rate: f64, frequency_hz: f64) -> ExponentialStage {
        let signal = demodulated(samples, sampling_rate, frequency_hz).unwrap();
        signal.fit(0, signal.times.len()).unwrap()
    }

    /// Growth from a small amplitude into a limit cycle of lower frequency, over an offset.
    fn squeal(rate_per_s: f64, linear_hz: f64, cycle_hz: f64) -> Vec<f64> {
        let rate = 5e5;
        let mut phase = 0.0;
        let mut amplitude: f64 = 1e-4;
        (0..25_000)
            .map(|j| {
                let saturation = amplitude * amplitude;
                amplitude += rate_per_s * amplitude * (1.0 - saturation) / rate;
                phase += TAU * (linear_hz + (cycle_hz - linear_hz) * saturation) / rate;
                let ramp = (j as f64 / 250.0).min(1.0);
                0.3 * ramp
                    + amplitude * phase.sin()
                    + 0.3 * amplitude * saturation * (2.0 * phase).sin()
            })
            .collect()
    }

    #[test]
    fn rate_and_frequency_of_the_linear_stage_are_found_before_a_limit_cycle() {
        for sigma in [300.0, 700.0, 1500.0] {
            let stage = exponential_stage(&squeal(sigma, 9870.0, 9440.0), 5e5).unwrap();
            // The stage is cut where the envelope deviates by 1 %: the slope keeps 1 %.
            assert!((stage.rate_per_s.value / sigma - 1.0).abs() < 0.01, "{stage:?}");
            assert!((stage.frequency_hz.value / 9870.0 - 1.0).abs() < 1e-3, "{stage:?}");
        }
    }

    #[test]
    fn rate_of_a_pure_exponential_is_exact_in_a_given_interval() {
        let rate = 1e5;
        let x = sampled(5000, rate, |t| (150.0 * t).exp() * (TAU * 1000.0 * t + 0.3).cos());
        let stage = over_all(&x, rate, 1010.0);
        // Leakage of the negative frequency and of the removed mean through the window: -92 dB.
        assert!((stage.rate_per_s.value - 150.0).abs() < 0.05, "{stage:?}");
        assert!((stage.frequency_hz.value - 1000.0).abs() < 0.01, "{stage:?}");
        let start = (150.0 * stage.start_s).exp();
        assert!((stage.initial_amplitude / start - 1.0).abs() < 1e-3, "{stage:?}");
    }

    #[test]
    fn a_ring_down_gives_a_negative_rate_and_a_steady_tone_none() {
        let rate = 1e5;
        let tone =
            |sigma: f64| sampled(8000, rate, |t| (sigma * t).exp() * (TAU * 2000.0 * t).sin());
        let stage = exponential_stage(&tone(-80.0), rate).unwrap();
        assert!((stage.rate_per_s.value + 80.0).abs() < 0.5, "{stage:?}");
        assert!(matches!(exponential_stage(&tone(0.0), rate), Err(NoGrowth::NotExponential(_))));
    }

    /// A vibration at 3456.7 Hz with an envelope over so many seconds, in noise, sampled at 51.2 kHz.
    fn heard(duration: f64, noise: f64, envelope: impl Fn(f64) -> f64) -> Vec<f64> {
        let (rate, mut gaussian) = (51_200.0, gaussian_sequence(11));
        let heard = |t| envelope(t) * (TAU * 3456.7 * t).cos() + noise * gaussian();
        sampled((duration * rate) as usize, rate, heard)
    }

    #[test]
    fn a_burst_far_above_the_noise_has_its_rate_wherever_it_stands_in_a_long_record() {
        for (duration, begin) in [(1.0, 0.0), (1.0, 0.02), (3.0, 1.7), (3.0, 2.9)] {
            let ring = |t: f64| if t < begin { 0.0 } else { 0.5 * (-120.0 * (t - begin)).exp() };
            let stage = exponential_stage(&heard(duration, 1e-3, ring), 51_200.0).unwrap();
            assert!((stage.rate_per_s.value / -120.0 - 1.0).abs() < 0.01, "{begin}: {stage:?}");
            assert!((stage.frequency_hz.value / 3456.7 - 1.0).abs() < 1e-4, "{stage:?}");
            assert!(begin <= stage.start_s && stage.end_s < begin + 0.06, "{begin}: {stage:?}");
        }
        // Weaker ones, by what the noise leaves of their rate; one that grows to the end.
        for (rate, noise, room) in [(-60.0, 1e-2, 0.03), (-20.0, 0.02, 0.03), (120.0, 1e-3, 0.01)] {
            let envelope = |t: f64| 0.5 * (rate * if rate > 0.0 { t - 1.0 } else { t }).exp();
            let stage = exponential_stage(&heard(1.0, noise, envelope), 51_200.0).unwrap();
            assert!((stage.rate_per_s.value / rate - 1.0).abs() < room, "{rate}: {stage:?}");
        }
        let none = exponential_stage(&heard(3.0, 1e-3, |_| 0.0), 51_200.0).unwrap_err();
        assert_eq!(none, NoGrowth::NoLine(3.0));
    }

    /// Closed form: two steady lines, whose envelope rises and falls by `(1 + r) / (1 - r)`; one that grows beside one.
    #[test]
    fn steady_lines_that_beat_neither_grow_nor_decay() {
        let mut gaussian = gaussian_sequence(5);
        let mut beside = |apart_hz: f64, envelope: &dyn Fn(f64) -> f64| -> Vec<f64> {
            let tones = |t: f64| {
                (TAU * 1000.0 * t).sin() + envelope(t) * (TAU * (1000.0 + apart_hz) * t + 1.0).sin()
            };
            sampled(20_000, 2e4, |t| tones(t) + 1e-3 * gaussian())
        };
        for (apart_hz, r) in
            [(0.5, 1.0), (2.0, 0.5), (2.0, 0.9), (3.0, 0.5), (5.0, 1.0), (8.0, 0.7)]
        {
            let found = exponential_stage(&beside(apart_hz, &|_| r), 2e4);
            let Err(NoGrowth::Beat(_, own)) = found else { panic!("{apart_hz} {r}: {found:?}") };
            assert!((own / apart_hz - 1.0).abs() < 0.05, "{own} {apart_hz}");
        }
        let grown = beside(3.0, &|t| 0.05 * (6.0 * t).exp());
        assert!(exponential_stage(&grown, 2e4).is_ok_and(|stage| stage.is_growing()));
    }

    #[test]
    fn what_grows_beside_a_steady_hum_is_found() {
        let mut gaussian = gaussian_sequence(3);
        for (rate, first) in [(8.0, 1e-3), (12.0, 1e-5), (40.0, 1e-9)] {
            let samples = sampled(20_000, 2e4, |t| {
                let squeal = (first * (rate * t).exp()).min(3.0) * (TAU * 3010.0 * t).sin();
                0.1 * (TAU * 500.0 * t).sin() + squeal + 1e-4 * gaussian()
            });
            let stage = exponential_stage(&samples, 2e4).unwrap();
            assert!((stage.rate_per_s.value / rate - 1.0).abs() < 0.02, "{rate}: {stage:?}");
            assert!((stage.frequency_hz.value / 3010.0 - 1.0).abs() < 1e-3, "{stage:?}");
        }
    }

    #[test]
    fn a_squeal_lasts_until_it_is_over_or_to_the_end_of_the_record() {
        let grown = |t: f64| 1e-3 * (147.0 * (t - 0.5)).exp().min(100.0);
        for (over, expected) in [(0.9, 0.9), (9.0, 2.0)] {
            let envelope = |t: f64| if (0.5..over).contains(&t) { grown(t) } else { 0.0 };
            let samples = heard(2.0, 2e-3, envelope);
            let stage = exponential_stage(&samples, 51_200.0).unwrap();
            let until = stage.lasts_until(&samples, 51_200.0);
            // The window of 12 periods blurs the end.
            assert!(stage.is_growing() && (until - expected).abs() < 4e-3, "{until} {stage:?}");
        }
    }

    /// Closed form: the rate of `a + t` is `1 / (a + t)`, no one number, and it is no beat; 9990 Hz at 20 kHz is two
    /// samples a period.
    #[test]
    fn growth_along_a_straight_line_and_a_coarse_record_have_no_rate() {
        for noise in [0.0, 1e-3] {
            let mut gaussian = gaussian_sequence(3);
            let mut stage = |of: &dyn Fn(f64) -> f64| {
                exponential_stage(&sampled(20_000, 2e4, |t| of(t) + noise * gaussian()), 2e4)
            };
            let line = stage(&|t| (0.01 + t) * (TAU * 800.0 * t).sin());
            assert!(matches!(line, Err(NoGrowth::NotExponential(_))), "{line:?}");
            let coarse = stage(&|t| (TAU * 9990.0 * t).sin());
            assert!(matches!(coarse, Err(NoGrowth::TooCoarse(..))), "{coarse:?}");
        }
    }

    #[test]
    fn intervals_cover_the_true_rate_under_noise() {
        let rate = 1e5;
        let mut noise = gaussian_sequence(7);
        let mut covered = 0;
        for _ in 0..100 {
            let noisy = |t: f64| (40.0 * t).exp() * (TAU * 2000.0 * t).sin() + 0.05 * noise();
            let x = sampled(6000, rate, noisy);
            let stage = over_all(&x, rate, 2000.0);
            covered += i32::from(stage.rate_per_s.low <= 40.0 && 40.0 <= stage.rate_per_s.high);
        }
        // 95 expected; 88 is three standard deviations of the count below.
        assert!(covered >= 88, "{covered}");
    }
}
