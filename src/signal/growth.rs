//! Growth rate and frequency of the exponential stage of a vibration.

use super::error::{SignalError, check_positive};
use super::rayleigh::Estimate;
use super::spectrum::{centred, check_signal};
use super::statistics::student_95;
use super::{Window, main_frequency};
use faer::c64;
use std::f64::consts::TAU;

/// Periods in the demodulation window: its pass band is a third of the frequency to either side,
/// and -92 dB outside, so a constant, a drift and superharmonics stay out.
const PERIODS: f64 = 12.0;
/// Largest rms deviation of the logarithmic envelope from a line, tried in turn.
const TOLERANCES: [f64; 4] = [0.01, 0.03, 0.1, 0.2];
/// Ends of the search grid.
const GRID: usize = 300;

/// A stretch of a signal that grows or decays as `A e^{sigma t} cos(2 pi f t + phi)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialStage {
    /// Begin, s after the first sample.
    pub start: f64,
    /// End, s after the first sample.
    pub end: f64,
    /// Growth rate `sigma`, 1/s, with its 95 % interval; negative for a decay.
    pub rate_per_s: Estimate,
    /// Frequency, Hz, with its 95 % interval.
    pub frequency_hz: Estimate,
    /// Amplitude at the start of the stage, unit of the signal.
    pub initial_amplitude: f64,
    /// Root mean square deviation of the logarithmic envelope from the fitted line.
    pub deviation: f64,
}

/// Envelope and phase around one frequency.
struct Demodulated {
    times: Vec<f64>,
    log_amplitude: Vec<f64>,
    phase: Vec<f64>,
    /// Correlated neighbours: window length over sample distance.
    correlated: f64,
    frequency: f64,
    /// Time from the middle of the window, s, and weight of each sample of it; the weights sum to 1.
    taper: Vec<(f64, f64)>,
}

impl Demodulated {
    /// What the window makes of an exponential of the given rate and distance from the demodulation
    /// frequency, rad/s: the modulus of its mean over that at mid-window.
    fn growth_gain(&self, rate: f64, drift: f64) -> f64 {
        let weighted = self
            .taper
            .iter()
            .map(|(t, w)| c64::from_polar(w * (rate * t).exp(), drift * t));
        weighted.sum::<c64>().norm()
    }
}

/// Finds the exponential stage of a signal and fits its rate and frequency.
///
/// The signal is demodulated at `frequency_hz` (left out: the strongest line, then the strongest
/// within the stage found), `z(t) = sum_j w_j x_j e^{-2 pi i f t_j}` over 12 periods; for a pure
/// exponential the filter is exact. The stage is the interval over which `ln |z|` changes most while
/// it deviates from a line by no more than 1 % rms (then 3, 10, 20 %); a growing stage is preferred
/// to a decaying one. A tenth at each end is cut off, where saturation would bias the slope. Rate and
/// frequency are least-squares slopes of `ln |z|` and of the phase; their intervals count one
/// independent value for each window length. Does not separate two modes closer than a third of the
/// frequency: they beat, and the stage found is one where they do not.
///
/// # Errors
/// [`SignalError::NoExponentialStage`] where the envelope nowhere changes by a factor e in such an
/// interval; others for a record shorter than 3 windows or not finite.
pub fn exponential_stage(
    samples: &[f64],
    sampling_rate: f64,
    frequency_hz: Option<f64>,
) -> Result<ExponentialStage, SignalError> {
    check_signal(samples, sampling_rate, 16)?;
    let mut frequency = match frequency_hz {
        Some(f) => f,
        None => main_frequency(samples, sampling_rate)?.frequency_hz,
    };
    let mut stage = search(samples, sampling_rate, frequency)?;
    for _ in 0..2 {
        if frequency_hz.is_some() {
            break;
        }
        // The stage may vibrate elsewhere than the limit cycle that dominates the record.
        let range = |t: f64| ((t * sampling_rate) as usize).min(samples.len());
        let part = &samples[range(stage.start)..range(stage.end)];
        let Ok(line) = main_frequency(part, sampling_rate) else {
            break;
        };
        if (line.frequency_hz / frequency - 1.0).abs() < 0.02 {
            break;
        }
        frequency = line.frequency_hz;
        match search(samples, sampling_rate, frequency) {
            Ok(better) => stage = better,
            Err(_) => break,
        }
    }
    Ok(stage)
}

/// Fits rate and frequency over a given interval, `start..end` in s after the first sample.
///
/// As [`exponential_stage`], without search or cut.
///
/// # Errors
/// [`SignalError::TooShort`] for an interval under three window lengths (12 periods each).
pub fn stage_in_interval(
    samples: &[f64],
    sampling_rate: f64,
    frequency_hz: f64,
    start: f64,
    end: f64,
) -> Result<ExponentialStage, SignalError> {
    check_signal(samples, sampling_rate, 16)?;
    let signal = demodulate(samples, sampling_rate, frequency_hz)?;
    let first = signal.times.partition_point(|t| *t < start);
    let last = signal.times.partition_point(|t| *t <= end);
    fit(&signal, first, last)
}

fn search(
    samples: &[f64],
    sampling_rate: f64,
    frequency: f64,
) -> Result<ExponentialStage, SignalError> {
    let signal = demodulate(samples, sampling_rate, frequency)?;
    let none = SignalError::NoExponentialStage {
        frequency_hz: frequency,
    };
    for tolerance in TOLERANCES {
        for growing in [true, false] {
            if let Some((first, last)) = longest_line(&signal, tolerance, growing) {
                let cut = (last - first) / 10;
                if let Ok(stage) = fit(&signal, first + cut, last - cut) {
                    return Ok(stage);
                }
            }
        }
    }
    Err(none)
}

/// Complex demodulation at one value each period.
fn demodulate(
    samples: &[f64],
    sampling_rate: f64,
    frequency: f64,
) -> Result<Demodulated, SignalError> {
    check_positive("frequency", frequency, "")?;
    let block = (PERIODS * sampling_rate / frequency).round() as usize;
    let hop = ((sampling_rate / frequency).round() as usize).max(1);
    if block < 32 || samples.len() < 3 * block {
        return Err(SignalError::TooShort {
            what: "the signal",
            count: samples.len(),
            needed: (3 * block).max(96),
            remedy: "36 periods at more than 2.7 samples each are needed for a growth rate",
        });
    }
    let taper = Window::BlackmanHarris.coefficients(block);
    let gain = 2.0 / taper.iter().sum::<f64>();
    let x = centred(samples);
    let step = TAU * frequency / sampling_rate;
    let carrier: Vec<c64> = taper
        .iter()
        .enumerate()
        .map(|(j, w)| c64::from_polar(gain * w, -step * j as f64))
        .collect();
    let mut out = Demodulated {
        times: Vec::new(),
        log_amplitude: Vec::new(),
        phase: Vec::new(),
        correlated: block as f64 / hop as f64,
        frequency,
        taper: (taper.iter().enumerate())
            .map(|(j, w)| {
                let offset = (j as f64 - 0.5 * block as f64) / sampling_rate;
                (offset, 0.5 * gain * w)
            })
            .collect(),
    };
    let mut turns = 0.0;
    for start in (0..=x.len() - block).step_by(hop) {
        let z: c64 = x[start..start + block]
            .iter()
            .zip(&carrier)
            .map(|(x, c)| c * *x)
            .sum();
        let raw = z.arg() - (step * start as f64).rem_euclid(TAU);
        if let Some(last) = out.phase.last() {
            turns = ((last - raw) / TAU).round() * TAU;
        }
        out.phase.push(raw + turns);
        out.times
            .push((start as f64 + 0.5 * block as f64) / sampling_rate);
        // Silence has no logarithm; the smallest normal number stands for it.
        out.log_amplitude.push(z.norm().max(f64::MIN_POSITIVE).ln());
    }
    Ok(out)
}

/// The interval over which the logarithmic envelope changes most while it stays within
/// `tolerance` rms of a line; `None` if the change is below a factor e.
fn longest_line(signal: &Demodulated, tolerance: f64, growing: bool) -> Option<(usize, usize)> {
    let n = signal.times.len();
    let sums = prefix_sums(&signal.times, &signal.log_amplitude);
    let stride = n.div_ceil(GRID);
    let shortest = (2.0 * signal.correlated).ceil() as usize;
    let mut best = None;
    let mut best_gain = 1.0;
    for first in (0..n).step_by(stride) {
        for last in ((first + shortest)..=n).rev().step_by(stride) {
            let (slope, deviation) = line(&sums, first, last);
            let gain = slope * (signal.times[last - 1] - signal.times[first]);
            let gain = if growing { gain } else { -gain };
            if gain > best_gain && deviation <= tolerance {
                best_gain = gain;
                best = Some((first, last));
            }
        }
    }
    best
}

/// Running sums of `[t, y, t t, t y, y y]` about the mid values, which keeps the digits.
fn prefix_sums(t: &[f64], y: &[f64]) -> Vec<[f64; 5]> {
    let (t0, y0) = (t[t.len() / 2], y[y.len() / 2]);
    let mut sums = vec![[0.0; 5]];
    for (t, y) in t.iter().zip(y) {
        let (t, y) = (t - t0, y - y0);
        let mut s = sums[sums.len() - 1];
        for (s, v) in s.iter_mut().zip([t, y, t * t, t * y, y * y]) {
            *s += v;
        }
        sums.push(s);
    }
    sums
}

/// Slope and rms deviation of the least-squares line through samples `first..last`.
fn line(sums: &[[f64; 5]], first: usize, last: usize) -> (f64, f64) {
    let n = (last - first) as f64;
    let s: Vec<f64> = (0..5).map(|k| sums[last][k] - sums[first][k]).collect();
    let tt = s[2] - s[0] * s[0] / n;
    let ty = s[3] - s[0] * s[1] / n;
    let yy = s[4] - s[1] * s[1] / n;
    let slope = ty / tt;
    (slope, ((yy - slope * ty) / n).max(0.0).sqrt())
}

/// Rate and frequency over demodulated samples `first..last`.
fn fit(signal: &Demodulated, first: usize, last: usize) -> Result<ExponentialStage, SignalError> {
    let needed = (2.0 * signal.correlated).ceil() as usize;
    if last < first + needed {
        return Err(SignalError::TooShort {
            what: "the exponential stage (counted in periods)",
            count: last.saturating_sub(first),
            needed,
            remedy: "take a longer interval",
        });
    }
    let t = &signal.times[first..last];
    let (rate, deviation) = slope(t, &signal.log_amplitude[first..last], signal.correlated);
    let (drift, _) = slope(t, &signal.phase[first..last], signal.correlated);
    let mean_time = t.iter().sum::<f64>() / t.len() as f64;
    let mean_log = signal.log_amplitude[first..last].iter().sum::<f64>() / t.len() as f64;
    let hertz = |radians: f64| signal.frequency + radians / TAU;
    Ok(ExponentialStage {
        start: t[0],
        end: t[t.len() - 1],
        rate_per_s: rate,
        frequency_hz: Estimate {
            value: hertz(drift.value),
            low: hertz(drift.low),
            high: hertz(drift.high),
        },
        initial_amplitude: (mean_log + rate.value * (t[0] - mean_time)).exp()
            / signal.growth_gain(rate.value, drift.value),
        deviation,
    })
}

/// Least-squares slope with its 95 % interval, and the rms deviation. Of every `correlated`
/// successive values one counts as independent.
fn slope(t: &[f64], y: &[f64], correlated: f64) -> (Estimate, f64) {
    let sums = prefix_sums(t, y);
    let (value, deviation) = line(&sums, 0, t.len());
    let n = t.len() as f64;
    let mean = t.iter().sum::<f64>() / n;
    let spread: f64 = t.iter().map(|t| (t - mean) * (t - mean)).sum();
    let degrees = (n / correlated - 2.0).max(1.0);
    let error = deviation * (n / (degrees * spread)).sqrt() * student_95(degrees);
    let estimate = Estimate {
        value,
        low: value - error,
        high: value + error,
    };
    (estimate, deviation)
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let stage = exponential_stage(&squeal(sigma, 9870.0, 9440.0), 5e5, None).unwrap();
            // The stage is cut where the envelope deviates by 1 %: the slope keeps 1 %.
            assert!(
                (stage.rate_per_s.value / sigma - 1.0).abs() < 0.01,
                "{stage:?}"
            );
            assert!(
                (stage.frequency_hz.value / 9870.0 - 1.0).abs() < 1e-3,
                "{stage:?}"
            );
        }
    }

    #[test]
    fn rate_of_a_pure_exponential_is_exact_in_a_given_interval() {
        let rate = 1e5;
        let x: Vec<f64> = (0..5000)
            .map(|j| {
                let t = j as f64 / rate;
                (150.0 * t).exp() * (TAU * 1000.0 * t + 0.3).cos()
            })
            .collect();
        let stage = stage_in_interval(&x, rate, 1010.0, 0.0, 0.05).unwrap();
        // Leakage of the negative frequency and of the removed mean through the window: -92 dB.
        assert!((stage.rate_per_s.value - 150.0).abs() < 0.05, "{stage:?}");
        assert!(
            (stage.frequency_hz.value - 1000.0).abs() < 0.01,
            "{stage:?}"
        );
        let start = (150.0 * stage.start).exp();
        assert!(
            (stage.initial_amplitude / start - 1.0).abs() < 1e-3,
            "{stage:?}"
        );
    }

    #[test]
    fn a_ring_down_gives_a_negative_rate_and_a_steady_tone_none() {
        let rate = 1e5;
        let tone = |sigma: f64| -> Vec<f64> {
            (0..8000)
                .map(|j| {
                    let t = j as f64 / rate;
                    (sigma * t).exp() * (TAU * 2000.0 * t).sin()
                })
                .collect()
        };
        let stage = exponential_stage(&tone(-80.0), rate, None).unwrap();
        assert!((stage.rate_per_s.value + 80.0).abs() < 0.5, "{stage:?}");
        assert!(matches!(
            exponential_stage(&tone(0.0), rate, None),
            Err(SignalError::NoExponentialStage { .. })
        ));
    }

    #[test]
    fn intervals_cover_the_true_rate_under_noise() {
        let rate = 1e5;
        let mut state = 7u64;
        let mut noise = move || {
            let mut sum = -6.0;
            for _ in 0..12 {
                state = state
                    .wrapping_mul(6364136223846793005)
                    .wrapping_add(1442695040888963407);
                sum += (state >> 11) as f64 / (1u64 << 53) as f64;
            }
            sum
        };
        let mut covered = 0;
        for _ in 0..100 {
            let x: Vec<f64> = (0..6000)
                .map(|j| {
                    let t = j as f64 / rate;
                    (40.0 * t).exp() * (TAU * 2000.0 * t).sin() + 0.05 * noise()
                })
                .collect();
            let stage = stage_in_interval(&x, rate, 2000.0, 0.0, 0.06).unwrap();
            covered += i32::from(stage.rate_per_s.low <= 40.0 && 40.0 <= stage.rate_per_s.high);
        }
        // 95 expected; 88 is three standard deviations of the count below.
        assert!(covered >= 88, "{covered}");
    }
}
