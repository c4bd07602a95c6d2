//! Growth of one circumferential harmonic: a complex series, of which the whole stage is one exponential.

use super::demodulation::{Demodulated, demodulate};
use super::{ExponentialStage, LARGEST_DEVIATION, NoGrowth, round_off_floor};
use crate::forward_transform;
use crate::spectrum::{centred, signed_bin};
use faer::c64;
use std::f64::consts::TAU;

/// Fewest samples that a frequency is read from.
const FEWEST: usize = 64;
/// Fewest periods that a growth rate is read from.
const PERIODS: f64 = 20.0;
/// Lines next to zero that hold the mean and slow drifts, not a vibration (a Hann window is four wide).
const LOWEST_LINE: usize = 4;

/// Growth rate and signed frequency of a harmonic `z(t) ~ e^{(sigma + 2 pi i f) t}` over its linear stage.
///
/// The first third of the stage, which still holds what decays, is left out; of the rest what lies above
/// the floor of round-off, 1024 eps of `largest_motion` (the largest amplitude of any harmonic of the
/// body), must hold 20 periods. The series is demodulated by its strongest line in Hann windows a quarter
/// of its length, which reject other frequencies whatever their growth; rate and frequency are the slopes
/// of logarithm and phase, with their 95 % intervals. A negative frequency travels the other way round.
///
/// # Errors
/// [`NoGrowth`]: too short, below round-off, or a logarithm that deviates from a line by more than 20 % rms.
pub fn harmonic_growth(
    series: &[c64],
    sampling_rate: f64,
    largest_motion: f64,
) -> Result<ExponentialStage, NoGrowth> {
    let floor = round_off_floor(largest_motion);
    let late = &series[series.len() / 3..];
    let largest = late.iter().map(|z| z.norm()).fold(0.0, f64::max);
    let below = |amplitude: f64| NoGrowth::BelowRoundOff(amplitude, floor);
    // What is above the floor; noise a hundred times smaller never is.
    let above = |z: &c64| z.norm() > floor;
    let (Some(first), Some(last)) = (late.iter().position(above), late.iter().rposition(above))
    else {
        return Err(below(largest));
    };
    let part = &late[first..=last];
    let too_short = |periods| NoGrowth::TooShort(periods, PERIODS);
    if part.len() < FEWEST {
        return Err(too_short(0.0));
    }
    let read = |part: &[c64]| {
        let (cycles_per_sample, _) = strongest_line(part);
        let periods = cycles_per_sample.abs() * part.len() as f64;
        if periods < PERIODS {
            return Err(too_short(periods));
        }
        let signal = around(part, sampling_rate, cycles_per_sample);
        // The mean may be above the floor where the vibration is not.
        let weakest = signal.log_amplitude.iter().copied().fold(f64::MAX, f64::min);
        if weakest.exp() <= floor {
            return Err(below(weakest.exp()));
        }
        let stage = signal.fit(0, signal.times.len())?;
        let deviates = NoGrowth::NotExponential(stage.frequency_hz.value.abs());
        (stage.deviation <= LARGEST_DEVIATION).then_some(stage).ok_or(deviates)
    };
    let stage = match read(&centred(part)) {
        // The mean of a strong end may outweigh a weak beginning; differences have none.
        Err(NoGrowth::NotExponential(_)) => {
            let differences = part.windows(2).map(|pair| pair[1] - pair[0]);
            read(&differences.collect::<Vec<_>>())
        }
        found => found,
    }?;
    let begin = (series.len() / 3 + first) as f64 / sampling_rate;
    Ok(stage.later(begin))
}

/// Signed frequency, Hz, and amplitude of the strongest vibration of a complex series about its mean;
/// `None` for fewer than 64 samples or no motion.
pub fn strongest_vibration(series: &[c64], sampling_rate: f64) -> Option<(f64, f64)> {
    let part = (series.len() >= FEWEST).then(|| centred(series))?;
    let (cycles_per_sample, amplitude) = strongest_line(&part);
    let signal = (amplitude > 0.0).then(|| around(&part, sampling_rate, cycles_per_sample))?;
    let stage = signal.fit(0, signal.times.len()).ok()?;
    Some((stage.frequency_hz.value, amplitude))
}

/// Demodulation in overlapping Hann windows a quarter of the series long.
fn around(series: &[c64], sampling_rate: f64, cycles_per_sample: f64) -> Demodulated {
    let length = (series.len() / 4).max(FEWEST / 2);
    let taper: Vec<f64> = (0..length).map(|k| hann(k, length)).collect();
    let frequency_hz = cycles_per_sample * sampling_rate;
    demodulate(series, sampling_rate, frequency_hz, &taper, (length / 8).max(1))
}

fn hann(index: usize, count: usize) -> f64 {
    let sin = (0.5 * TAU * (index as f64 + 0.5) / count as f64).sin();
    sin * sin
}

/// Signed frequency in cycles per sample, and amplitude, of the strongest line of a Hann spectrum.
fn strongest_line(series: &[c64]) -> (f64, f64) {
    let count = series.len();
    let windowed = series.iter().enumerate();
    let mut spectrum: Vec<c64> = windowed.map(|(k, v)| v * hann(k, count)).collect();
    forward_transform(count).process(&mut spectrum);
    let lines = LOWEST_LINE..count + 1 - LOWEST_LINE;
    let best = lines.max_by(|&a, &b| spectrum[a].norm_sqr().total_cmp(&spectrum[b].norm_sqr()));
    let best = best.unwrap_or(0);
    let amplitude = 2.0 * spectrum[best].norm() / count as f64;
    (signed_bin(best, count) / count as f64, amplitude)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::sampled;

    const RATE: f64 = 5e5;

    /// A wave that travels backwards and grows, with the twist of the prestress and a mode that dies out.
    fn wave(count: usize, rate_per_s: f64, amplitude: f64) -> Vec<c64> {
        sampled(count, RATE, |t| {
            c64::from_polar(amplitude * (rate_per_s * t).exp(), -TAU * 9930.0 * t)
                + c64::from_polar(3.0 * amplitude * (-6000.0 * t).exp(), TAU * 15_000.0 * t)
        })
    }

    #[test]
    fn growth_of_a_travelling_wave_has_rate_signed_frequency_and_interval() {
        let stage = harmonic_growth(&wave(4500, 952.0, 1e-9), RATE, 9e-6).unwrap();
        let rate = stage.rate_per_s;
        assert!((rate.value / 952.0 - 1.0).abs() < 1e-3, "{stage:?}");
        assert!(rate.low <= rate.value && rate.value <= rate.high);
        assert!((stage.frequency_hz.value + 9930.0).abs() < 0.5, "{stage:?}");
        assert!(stage.is_growing() && !stage.is_decaying());
        // The same wave from round-off on: what is below the floor is left out, and it still grows.
        let faint = harmonic_growth(&wave(4500, 1471.0, 1e-19), RATE, 9e-6).unwrap();
        assert!((faint.rate_per_s.value / 1471.0 - 1.0).abs() < 1e-3);
    }

    /// A real vibration that grows by `e^16` over its stage, about a compression ten thousand times its end.
    #[test]
    fn growth_by_a_factor_of_ten_millions_over_twenty_periods_is_read() {
        let series = sampled(960, RATE, |t| {
            c64::new(1e-6 + 1e-21 * (12_865.0 * t).exp() * (TAU * 17_331.0 * t).cos(), 0.0)
        });
        let stage = harmonic_growth(&series, RATE, 1e-10).unwrap();
        assert!((stage.rate_per_s.value / 12_865.0 - 1.0).abs() < 0.01, "{stage:?}");
        assert!((stage.frequency_hz.value.abs() / 17_331.0 - 1.0).abs() < 0.01, "{stage:?}");
    }

    #[test]
    fn round_off_a_short_stage_and_a_beat_have_no_growth_rate() {
        // 1e-19 m beside a twist of 9 um: the residue of a wave that has died out.
        let dead = harmonic_growth(&wave(25_000, 3.5, 1e-19), RATE, 9e-6);
        assert!(matches!(dead, Err(NoGrowth::BelowRoundOff(..))), "{dead:?}");
        // 1 ms holds ten periods, of which the last two thirds count.
        let short = harmonic_growth(&wave(500, 952.0, 1e-9), RATE, 9e-6);
        assert!(matches!(short, Err(NoGrowth::TooShort(..))), "{short:?}");
        let beat = |t: f64| c64::from_polar(1e-9, TAU * 9930.0 * t) * (TAU * 40.0 * t).cos();
        let beat = harmonic_growth(&sampled(20_000, RATE, beat), RATE, 9e-6);
        assert!(matches!(beat, Err(NoGrowth::NotExponential(_))), "{beat:?}");
        assert!(harmonic_growth(&[], RATE, 0.0).is_err());
        let still = vec![c64::new(0.0, 0.0); 1000];
        assert!(harmonic_growth(&still, RATE, 0.0).is_err());
        assert_eq!(strongest_vibration(&still, RATE), None);
    }
}
