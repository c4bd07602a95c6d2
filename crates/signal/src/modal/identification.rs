//! From frequency responses to Rayleigh coefficients, by two estimators side by side.

use super::basis::Pole;
use super::fit::{FittedMode, ModalFit, fit_modes};
use super::half_power::{HalfPowerBand, LINES_NEEDED, ResonanceNote, half_power};
use super::rayleigh::{RayleighFit, fit_rayleigh};
use crate::{FrequencyResponse, SignalError};
use faer::Mat;

/// Modes, Rayleigh coefficients and the evidence for them.
#[derive(Clone, Debug, PartialEq)]
pub struct Identification {
    /// Coefficients from the fitted damping factors.
    pub rayleigh: RayleighFit,
    /// Coefficients from the half-power factors alone, where at least three modes have one that is not in doubt.
    pub half_power_rayleigh: Option<RayleighFit>,
    /// Peaks of which the fit made no mode.
    pub unmatched: Vec<HalfPowerBand>,
    /// The fit, each of its modes with its half-power band.
    pub fit: ModalFit,
}

/// Finds the resonances of responses within a range of frequencies, Hz, or of all, their damping factors and the
/// Rayleigh coefficients.
///
/// [`half_power`] finds the peaks; [`fit_modes`] starts from them; [`fit_rayleigh`] takes the fitted factors with their
/// covariance, and beside it the half-power factors without. Several responses of one body are fitted with common
/// poles; a peak that several of them show counts once. Close modes are marked in both lists: the half-power Rayleigh
/// fit leaves them out, the other takes them with the covariance that their overlap gives them.
///
/// # Errors
/// [`SignalError`]: no resonance in any response, resolution too coarse for every one of them, too few modes.
pub fn identify(
    responses: &[FrequencyResponse],
    range_hz: Option<(f64, f64)>,
) -> Result<Identification, SignalError> {
    let (low, high) = range_hz.unwrap_or((0.0, f64::INFINITY));
    let cut: Vec<FrequencyResponse> =
        responses.iter().map(|response| response.within(low, high)).collect::<Result<_, _>>()?;
    let bands = peaks(&cut)?;
    refuse_coarse(&cut, &bands)?;
    let mut fit = fit_modes(&cut, &starts(&bands))?;
    let mut unmatched = Vec::new();
    for mut band in bands {
        let Some(mode) = nearest(&mut fit.modes, band.frequency_hz) else {
            unmatched.push(band);
            continue;
        };
        // A single peak over two modes looks sound to the half-power method; the fit knows better.
        band.note = band.note.or(mode.overlaps_hz.map(ResonanceNote::Overlaps));
        mode.half_power = Some(band);
    }
    let used: Vec<usize> = (0..fit.modes.len()).filter(|&k| fit.modes[k].is_used()).collect();
    let samples: Vec<Pole> = used.iter().map(|&k| fit.modes[k].pole()).collect();
    let covariance =
        Mat::from_fn(used.len(), used.len(), |i, j| fit.damping_covariance[(used[i], used[j])]);
    Ok(Identification {
        rayleigh: fit_rayleigh(&samples, Some(&covariance))?,
        half_power_rayleigh: half_power_rayleigh(&fit.modes),
        unmatched,
        fit,
    })
}

/// The peaks of all responses by frequency. Of those closer than half a bandwidth one is kept: the first
/// that is not in doubt, or else the first.
fn peaks(responses: &[FrequencyResponse]) -> Result<Vec<HalfPowerBand>, SignalError> {
    let found: Vec<Result<Vec<HalfPowerBand>, SignalError>> =
        responses.iter().map(half_power).collect();
    if found.iter().all(Result::is_err) {
        let first = found.into_iter().find_map(Result::err);
        return Err(first.unwrap_or(SignalError::NoResonance { low_hz: 0.0, high_hz: 0.0 }));
    }
    let mut kept: Vec<HalfPowerBand> = Vec::new();
    for bands in found.into_iter().flatten() {
        // Peaks of one response are different ones, however close.
        let earlier = kept.len();
        for band in bands {
            let half_width = |b: &HalfPowerBand| b.half_width_hz().unwrap_or(5e-3 * b.frequency_hz);
            let apart = |b: &HalfPowerBand| (b.frequency_hz - band.frequency_hz).abs();
            let is_same = |b: &HalfPowerBand| apart(b) < half_width(b).max(half_width(&band));
            match kept[..earlier].iter_mut().find(|b| is_same(b)) {
                Some(known) if known.note.is_some() && band.note.is_none() => *known = band,
                Some(_) => {}
                None => kept.push(band),
            }
        }
    }
    kept.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    Ok(kept)
}

/// Coefficients from half-power factors that carry no doubt.
fn half_power_rayleigh(modes: &[FittedMode]) -> Option<RayleighFit> {
    let bands = modes.iter().filter_map(|m| m.half_power).filter(|b| b.note.is_none());
    let samples = bands.filter_map(|HalfPowerBand { frequency_hz, damping_factor, .. }| {
        Some(Pole { frequency_hz, damping_factor: damping_factor? })
    });
    fit_rayleigh(&samples.collect::<Vec<_>>(), None).ok()
}

/// A response whose every half-power band is too coarse cannot give a damping factor.
fn refuse_coarse(
    responses: &[FrequencyResponse],
    bands: &[HalfPowerBand],
) -> Result<(), SignalError> {
    let steps = responses.iter().flat_map(|response| response.frequencies_hz().windows(2));
    let resolution_hz = steps.map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    let coarse = |b: &HalfPowerBand| matches!(b.note, Some(ResonanceNote::TooCoarse(_)));
    match bands.first() {
        Some(first) if bands.iter().all(coarse) => Err(SignalError::Unresolved(format!(
            "the frequency resolution of {resolution_hz} Hz is too coarse: the half-power band of \
             the resonance at {} Hz holds fewer than {LINES_NEEDED} lines. Measure longer, or zoom",
            first.frequency_hz
        ))),
        _ => Ok(()),
    }
}

/// First poles for the fit: half-power widths, or the typical damping where there is none.
fn starts(bands: &[HalfPowerBand]) -> Vec<Pole> {
    let width = |b: &HalfPowerBand| b.half_width_hz().map(|half| half / b.frequency_hz);
    let known: Vec<f64> = bands.iter().filter_map(width).collect();
    let typical = if known.is_empty() { 0.01 } else { crate::statistics::median(&known) };
    let damping = |b: &HalfPowerBand| width(b).unwrap_or(typical).clamp(1e-5, 0.2);
    let pole =
        |b: &HalfPowerBand| Pole { frequency_hz: b.frequency_hz, damping_factor: damping(b) };
    bands.iter().map(pole).collect()
}

/// The mode whose fitted frequency is nearest to a peak, within its bandwidth; none that has a peak already.
fn nearest(modes: &mut [FittedMode], frequency_hz: f64) -> Option<&mut FittedMode> {
    let miss = |mode: &FittedMode| (mode.frequency_hz.value - frequency_hz).abs();
    let free = modes.iter_mut().filter(|mode| mode.half_power.is_none());
    let mode = free.min_by(|a, b| miss(a).total_cmp(&miss(b)))?;
    (miss(mode) <= mode.pole().bandwidth_hz()).then_some(mode)
}
