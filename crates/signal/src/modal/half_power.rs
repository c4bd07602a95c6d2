//! Resonances of a frequency response and their half-power bandwidths.

use super::NoiseModel;
use crate::{FrequencyResponse, ResponseQuantity, SignalError};
use frictionsim_output::Described;
use serde::Serialize;

/// Frequency lines a half-power band must hold: a parabola through the top and two crossings.
pub(super) const LINES_NEEDED: usize = 5;
/// Least prominence of a resonance, neper (0.87 dB) ...
const PROMINENCE: f64 = 0.1;
/// ... in units of the relative noise at its top ...
const NOISE_PROMINENCE: f64 = 8.0;
/// ... but no more than this, neper (6 dB): coarse lines look like noise.
const ENOUGH_PROMINENCE: f64 = 0.7;
/// Least height of a resonance over noise that does not depend on the response; chance reaches it once in e^18 lines.
const NOISE_FLOOR: f64 = 6.0;

/// Why a half-power damping factor is missing or doubtful.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ResonanceNote {
    /// The half-power band overlaps that of a resonance at this frequency, Hz.
    Overlaps(f64),
    /// The band holds only this many frequency lines.
    TooCoarse(usize),
    /// The response does not fall to half power on one side before it rises again or ends.
    OneSided,
}

/// A resonance `f_0` and its half-power points `f_1`, `f_2`, which give `zeta = (f_2 - f_1) / (2 f_0)`.
///
/// The resonance is the maximum of the mobility, which is the undamped natural frequency. There is a damping factor
/// where both points exist and the band holds lines enough.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct HalfPowerBand {
    /// Peak, Hz.
    pub frequency_hz: f64,
    /// Damping factor, where the band can be trusted.
    pub damping_factor: Option<f64>,
    /// Half-power frequencies, Hz.
    pub band_hz: Option<[f64; 2]>,
    /// Doubts.
    #[serde(skip)]
    pub note: Option<ResonanceNote>,
}

impl HalfPowerBand {
    /// Half the width of the band, Hz, where it has both ends.
    pub(super) fn half_width_hz(&self) -> Option<f64> {
        self.band_hz.map(|[low, high]| 0.5 * (high - low))
    }
}

/// Resonances and damping factors by the half-power method.
///
/// Works on the mobility, for which `zeta = (f_2 - f_1) / (2 f_0)` holds exactly at any damping of a single mode. Near
/// the top `1/|Y|^2` is a parabola in frequency: one is fitted through the top and one through each flank, so that
/// noise neither lifts the peak nor ends the band early. Does not correct for neighbouring modes: the tails of others
/// change the width (see [`fit_modes`](super::fit_modes)); overlapping bands are marked.
///
/// # Errors
/// [`SignalError::NoResonance`] if no peak stands out from the noise.
///
/// Source: D. J. Ewins, "Modal Testing", 2nd ed. (2000), section 4.2.
pub fn half_power(response: &FrequencyResponse) -> Result<Vec<HalfPowerBand>, SignalError> {
    let mobility = response.converted(ResponseQuantity::Mobility)?;
    let f = mobility.frequencies_hz();
    let offset = response.values().len() - f.len();
    // Of the quantity that was measured, in which noise is most likely uniform.
    let noise = NoiseModel::from_differences(response);
    let tops = resonances(&mobility, &response.magnitudes()[offset..], &noise);
    if tops.is_empty() {
        return Err(SignalError::NoResonance { low_hz: f[0], high_hz: f[f.len() - 1] });
    }
    let y = mobility.magnitudes();
    let band = |(k, &top): (usize, &usize)| {
        // The band must end before the valley towards the next resonance.
        let left = if k > 0 { valley(&y, tops[k - 1], top) } else { 0 };
        let right = tops.get(k + 1).map_or(y.len() - 1, |next| valley(&y, top, *next));
        measure(&f[left..=right], &y[left..=right], top - left)
    };
    let mut bands: Vec<HalfPowerBand> = tops.iter().enumerate().map(band).collect();
    mark_overlaps(&mut bands);
    Ok(bands)
}

/// Positions of the maxima of the mobility that stand out of the noise of the `measured` moduli.
fn resonances(mobility: &FrequencyResponse, measured: &[f64], noise: &NoiseModel) -> Vec<usize> {
    let y = mobility.magnitudes();
    let stands_out = |&i: &usize| {
        let relative = noise.variance(measured[i]).sqrt() / measured[i];
        let threshold = (NOISE_PROMINENCE * relative).clamp(PROMINENCE, ENOUGH_PROMINENCE);
        let is_top = y[i] > y[i - 1] && y[i] >= y[i + 1];
        is_top && measured[i] > NOISE_FLOOR * noise.additive && prominence(&y, i) >= threshold
    };
    (1..y.len() - 1).filter(stands_out).collect()
}

/// Position of the smallest value between two positions.
fn valley(y: &[f64], first: usize, last: usize) -> usize {
    (first..=last).fold(first, |lowest, i| if y[i] < y[lowest] { i } else { lowest })
}

/// Height of the maximum at `top` above the higher of the two lowest passes to higher ground, neper:
/// `ln(y_top / max(y_left, y_right))`.
pub fn prominence(y: &[f64], top: usize) -> f64 {
    let descent = |walk: &mut dyn Iterator<Item = usize>| {
        walk.map(|i| y[i]).take_while(|own| *own <= y[top]).fold(y[top], f64::min)
    };
    let left = descent(&mut (0..top).rev());
    let right = descent(&mut (top + 1..y.len()));
    let pass = left.max(right);
    if pass > 0.0 { (y[top] / pass).ln() } else { f64::INFINITY }
}

/// Top and half-power points around one maximum.
fn measure(f: &[f64], y: &[f64], top: usize) -> HalfPowerBand {
    // Inverse power relative to the largest sample: 1 at the top, 2 at half power.
    let inverse = |i: usize| (y[top] / y[i]).powi(2);
    let walk = |limit: f64, step: isize| {
        let mut i = top;
        while let Some(next) = i.checked_add_signed(step).filter(|n| *n < y.len()) {
            if inverse(next) > limit {
                break;
            }
            i = next;
        }
        i
    };
    let (mut f0, mut least) = (f[top], 1.0);
    let (first, last) = (walk(1.4, -1), walk(1.4, 1));
    if last - first >= 4
        && let Some([c, b, a]) = parabola(f, first..last + 1, f[top], inverse)
    {
        let shift = -0.5 * b / a;
        if a > 0.0 && f[first] <= f[top] + shift && f[top] + shift <= f[last] {
            f0 = f[top] + shift;
            least = c - 0.25 * b * b / a;
        }
    }
    let low = crossing(f, top, -1, least, inverse);
    let high = crossing(f, top, 1, least, inverse);
    let (frequency_hz, note) = (f0, Some(ResonanceNote::OneSided));
    let mut band = HalfPowerBand { frequency_hz, band_hz: None, damping_factor: None, note };
    // A parabola through a flank of noise may end on the wrong side of the top.
    if let (Some(low), Some(high)) = (low, high)
        && low < f0
        && f0 < high
    {
        band.band_hz = Some([low, high]);
        let lines = f.partition_point(|f| *f <= high) - f.partition_point(|f| *f < low);
        if lines < LINES_NEEDED {
            band.note = Some(ResonanceNote::TooCoarse(lines));
        } else {
            band.note = None;
            band.damping_factor = Some(0.5 * (high - low) / f0);
        }
    }
    band
}

/// Frequency where the inverse power passes `2 least` on one side of the top.
fn crossing(
    f: &[f64],
    top: usize,
    step: isize,
    least: f64,
    inverse: impl Fn(usize) -> f64 + Copy,
) -> Option<f64> {
    let level = 2.0 * least;
    let next = |i: usize| i.checked_add_signed(step).filter(|n| *n < f.len());
    // The flank from 1.5 to 2.7 times the least inverse power; it must be left upwards.
    let (mut near, mut far) = (top, top);
    while let Some(i) = next(far) {
        far = i;
        if inverse(i) < 1.5 * least {
            near = i;
        }
        if inverse(i) > 2.7 * least {
            break;
        }
    }
    let range = near.min(far)..near.max(far) + 1;
    if range.len() >= 8 {
        let centre = 0.5 * (f[near] + f[far]);
        if let Some([c, b, a]) = parabola(f, range, centre, inverse) {
            // Newton from the centre of the flank, where the slope cannot vanish.
            let mut x = 0.0;
            for _ in 0..20 {
                x -= (c + x * (b + a * x) - level) / (b + 2.0 * a * x);
            }
            let reach = (f[far] - f[near]).abs();
            if x.abs() <= reach {
                return Some(centre + x);
            }
        }
    }
    // Few lines: linear between the two around the level.
    let mut i = top;
    loop {
        let after = next(i)?;
        if inverse(after) >= level {
            let t = (level - inverse(i)) / (inverse(after) - inverse(i));
            return Some(f[i] + t * (f[after] - f[i]));
        }
        i = after;
    }
}

/// Least-squares parabola `c + b x + a x^2`, `x = f - centre`, through the inverse power.
fn parabola(
    f: &[f64],
    range: std::ops::Range<usize>,
    centre: f64,
    inverse: impl Fn(usize) -> f64,
) -> Option<[f64; 3]> {
    let scale = (f[range.end - 1] - f[range.start]).max(f64::MIN_POSITIVE);
    let mut normal = nalgebra::Matrix3::<f64>::zeros();
    let mut right = nalgebra::Vector3::<f64>::zeros();
    for i in range {
        let x = (f[i] - centre) / scale;
        let row = nalgebra::Vector3::new(1.0, x, x * x);
        normal += row * row.transpose();
        right += row * inverse(i);
    }
    let s = normal.lu().solve(&right)?;
    Some([s[0], s[1] / scale, s[2] / (scale * scale)])
}

/// Marks bands that reach into one another.
fn mark_overlaps(bands: &mut [HalfPowerBand]) {
    for i in 1..bands.len() {
        let (left, right) = (bands[i - 1], bands[i]);
        let reach = left.band_hz.map_or(left.frequency_hz, |b| b[1]);
        let begin = right.band_hz.map_or(right.frequency_hz, |b| b[0]);
        if reach > begin {
            bands[i - 1].note = Some(ResonanceNote::Overlaps(right.frequency_hz));
            bands[i].note = Some(ResonanceNote::Overlaps(left.frequency_hz));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::c64;
    use std::f64::consts::TAU;

    fn single(zeta: f64, f0: f64, quantity: ResponseQuantity, step: f64) -> FrequencyResponse {
        let w0 = TAU * f0;
        let f: Vec<f64> = (1..(2.0 * f0 / step) as usize).map(|i| i as f64 * step).collect();
        let h = f
            .iter()
            .map(|f| {
                let s = c64::new(0.0, TAU * f);
                s.powi(quantity.derivatives()) / (s * s + s * (2.0 * zeta * w0) + w0 * w0)
            })
            .collect();
        FrequencyResponse::new(f, h, quantity).unwrap()
    }

    #[test]
    fn one_mode_gives_its_damping_factor_from_every_quantity() {
        for quantity in [
            ResponseQuantity::Receptance,
            ResponseQuantity::Mobility,
            ResponseQuantity::Accelerance,
        ] {
            for zeta in [0.003, 0.02, 0.1] {
                let bands = half_power(&single(zeta, 2000.0, quantity, 0.5)).unwrap();
                assert_eq!(bands.len(), 1);
                let found = bands[0].damping_factor.unwrap();
                // The parabolas through the flanks: 0.3 %, growing with the band's asymmetry.
                assert!((found / zeta - 1.0).abs() < 3e-3 + 0.1 * zeta, "{zeta} {found}");
                assert!((bands[0].frequency_hz / 2000.0 - 1.0).abs() < 0.2 * zeta);
            }
        }
    }

    #[test]
    fn coarse_lines_are_reported_instead_of_a_damping_factor() {
        let bands = half_power(&single(0.004, 2000.0, ResponseQuantity::Accelerance, 7.0)).unwrap();
        assert!(matches!(bands[0].note, Some(ResonanceNote::TooCoarse(1..=4))));
        assert_eq!(bands[0].damping_factor, None);
    }
}
