//! Envelope and phase of a vibration around one frequency, and the exponential through them.

use super::{ExponentialStage, NoGrowth};
use crate::{Estimate, statistics::student_95};
use faer::c64;
use std::{f64::consts::TAU, ops::Mul};

/// Envelope and phase around one frequency, one value for each position of the window.
pub(super) struct Demodulated {
    /// Middle of each window, s after the first sample.
    pub times: Vec<f64>,
    pub log_amplitude: Vec<f64>,
    /// Unwrapped phase against the demodulation frequency, rad.
    pub phase: Vec<f64>,
    /// Correlated neighbours: window length over the distance of windows.
    pub correlated: f64,
    frequency_hz: f64,
    /// Time from the middle of the window, s, and weight of each sample of it; the weights sum to 1.
    taper: Vec<(f64, f64)>,
}

/// `z(t) = sum_j w_j x_j e^{-2 pi i f t_j}` over windows of the length of `taper`, `hop` samples apart;
/// the weights are scaled to sum 1.
pub(super) fn demodulate<T: Copy + Mul<c64, Output = c64>>(
    series: &[T],
    sampling_rate: f64,
    frequency_hz: f64,
    taper: &[f64],
    hop: usize,
) -> Demodulated {
    let block = taper.len();
    let step = TAU * frequency_hz / sampling_rate;
    let sum = taper.iter().sum::<f64>();
    let turned = |(j, w): (usize, &f64)| c64::from_polar(w / sum, -step * j as f64);
    let carrier: Vec<c64> = taper.iter().enumerate().map(turned).collect();
    let timed = |(j, w): (usize, &f64)| ((j as f64 - 0.5 * block as f64) / sampling_rate, w / sum);
    let taper = taper.iter().enumerate().map(timed).collect();
    let correlated = block as f64 / hop as f64;
    let (times, log_amplitude, phase) = (Vec::new(), Vec::new(), Vec::new());
    let mut out = Demodulated { times, log_amplitude, phase, correlated, frequency_hz, taper };
    let mut turns = 0.0;
    for start in (0..=series.len() - block).step_by(hop) {
        let window = series[start..start + block].iter().zip(&carrier);
        let z: c64 = window.map(|(x, c)| *x * *c).sum();
        // The carrier begins anew in each window: its phase at the window's start is taken off.
        let raw = z.arg() - (step * start as f64).rem_euclid(TAU);
        if let Some(last) = out.phase.last() {
            turns = ((last - raw) / TAU).round() * TAU;
        }
        out.phase.push(raw + turns);
        let middle = start as f64 + 0.5 * block as f64;
        out.times.push(middle / sampling_rate);
        // Silence has no logarithm; the smallest normal number stands for it.
        out.log_amplitude.push(z.norm().max(f64::MIN_POSITIVE).ln());
    }
    out
}

impl Demodulated {
    /// What the window makes of an exponential of the given rate and distance from the demodulation
    /// frequency, rad/s: the modulus of its mean over that at mid-window.
    fn growth_gain(&self, rate: f64, drift: f64) -> f64 {
        let weigh = |(t, w): &(f64, f64)| c64::from_polar(w * (rate * t).exp(), drift * t);
        self.taper.iter().map(weigh).sum::<c64>().norm()
    }

    /// Rate and frequency over windows `first..last`, at least two window lengths.
    pub(super) fn fit(&self, first: usize, last: usize) -> Result<ExponentialStage, NoGrowth> {
        let needed = (2.0 * self.correlated).ceil() as usize;
        if last < first + needed {
            let period = 1.0 / self.frequency_hz.abs();
            let hop = self.times.get(1).map_or(0.0, |t| t - self.times[0]);
            let [periods, needed] =
                [last.saturating_sub(first), needed].map(|own| own as f64 * hop / period);
            return Err(NoGrowth::TooShort(periods, needed));
        }
        let t = &self.times[first..last];
        let (rate, deviation) = slope(t, &self.log_amplitude[first..last], self.correlated);
        let (drift, _) = slope(t, &self.phase[first..last], self.correlated);
        let mean_time = t.iter().sum::<f64>() / t.len() as f64;
        let mean_log = self.log_amplitude[first..last].iter().sum::<f64>() / t.len() as f64;
        Ok(ExponentialStage {
            start_s: t[0],
            end_s: t[t.len() - 1],
            rate_per_s: rate,
            frequency_hz: drift.map(|radians| self.frequency_hz + radians / TAU),
            initial_amplitude: (mean_log + rate.value * (t[0] - mean_time)).exp()
                / self.growth_gain(rate.value, drift.value),
            deviation,
        })
    }
}

/// Running sums of `[t, y, t t, t y, y y]` about the mid values, which keeps the digits.
pub(super) fn prefix_sums(t: &[f64], y: &[f64]) -> Vec<[f64; 5]> {
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
pub(super) fn line(sums: &[[f64; 5]], first: usize, last: usize) -> (f64, f64) {
    let n = (last - first) as f64;
    let s: [f64; 5] = std::array::from_fn(|k| sums[last][k] - sums[first][k]);
    let tt = s[2] - s[0] * s[0] / n;
    let ty = s[3] - s[0] * s[1] / n;
    let yy = s[4] - s[1] * s[1] / n;
    let slope = ty / tt;
    (slope, ((yy - slope * ty) / n).max(0.0).sqrt())
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
    (Estimate::around(value, error), deviation)
}
