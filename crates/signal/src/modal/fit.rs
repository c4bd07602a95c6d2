//! Modal frequencies and damping factors from a fit of whole frequency responses.

use super::basis::{ModalModel, Pole};
use super::least_squares::{Fitted, Problem};
use super::{Estimate, HalfPowerBand, NoiseModel};
use crate::statistics::{NORMAL_95, median};
use crate::{FrequencyResponse, SignalError, error::too_short};
use faer::{Mat, c64};

/// Remainder terms to begin with: `s^-3 .. s^0`.
const REMAINDER: usize = 4;
/// Most remainder terms: up to `s^6`.
const MOST_REMAINDER: usize = 10;
/// A further pole must lower chi-square by this share at least, whatever its significance.
const LEAST_SHARE: f64 = 5e-3;
/// Bandwidths to either side over which a further pole is looked for.
const REACH: f64 = 10.0;
/// Largest damping factor of a pole that is called a mode.
const MOST_DAMPED: f64 = 0.3;
/// The fit begins at this share of the first resonance: below, a suspension or the damping of
/// rigid-body motion bends the response.
const BELOW_FIRST: f64 = 0.5;
/// Largest relative standard error of a damping factor that still enters the Rayleigh fit.
const LARGEST_RELATIVE_ERROR: f64 = 0.1;

/// A mode of the fitted model within the frequency range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedMode {
    /// Undamped natural frequency, Hz.
    pub frequency_hz: Estimate,
    /// Damping factor.
    pub damping_factor: Estimate,
    /// Standard error of the damping factor.
    pub standard_error: f64,
    /// Frequency of another mode whose half-power band overlaps this one's, Hz.
    pub overlaps_hz: Option<f64>,
    /// From the half-power points, where the mode shows a peak and those were looked for.
    pub half_power: Option<HalfPowerBand>,
}

impl FittedMode {
    /// Whether the damping factor enters the Rayleigh coefficients: its standard error is below 10 %.
    pub fn is_used(&self) -> bool {
        self.standard_error < LARGEST_RELATIVE_ERROR * self.damping_factor.value
    }

    /// Frequency and damping factor without their intervals.
    pub fn pole(&self) -> Pole {
        let (frequency_hz, damping_factor) = (self.frequency_hz.value, self.damping_factor.value);
        Pole { frequency_hz, damping_factor }
    }
}

/// A modal model fitted to one or more frequency responses.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalFit {
    /// The model, out-of-range poles included.
    pub model: ModalModel,
    /// Modes within the range, by frequency.
    pub modes: Vec<FittedMode>,
    /// Covariance of the modes' damping factors.
    pub damping_covariance: Mat<f64>,
    /// Noise of each response, found from the residuals.
    pub noise: Vec<NoiseModel>,
    /// Poles added to those given, because the residual asked for them, in and out of range.
    pub added_poles: usize,
    /// Factor by which correlation of the residuals along frequency widens the variances; 1 for a
    /// complete model under white noise.
    pub correlation: f64,
    /// Lowest and highest frequency used, Hz.
    pub range_hz: (f64, f64),
}

impl ModalFit {
    /// The fitted response number `response` at a frequency, Hz; `None` outside the range of the fit.
    pub fn evaluate(&self, response: usize, frequency_hz: f64) -> Option<c64> {
        let (low, high) = self.range_hz;
        let inside = (low..=high).contains(&frequency_hz) && frequency_hz > 0.0;
        inside.then(|| self.model.evaluate(response, frequency_hz))
    }
}

/// Fits poles and numerators of a [`ModalModel`] to responses, starting from `starts`.
///
/// Maximum likelihood under Gaussian noise with the variance of [`NoiseModel`], which is estimated along with the
/// model. Several responses share the poles; numerators, remainder and noise are their own. While the residual shows
/// it, the smooth remainder gets more terms (Akaike's criterion) and poles are added, within the range or beyond its
/// ends (Bayes' criterion): a close pair that shows one peak is found as two. Standard errors come from the normal
/// matrix, the residual variance and the correlation of successive residuals; they do not cover a wrong calibration nor
/// leakage, nor poles that differ from one response to the next. Without phase no poles are added and signs of the
/// numerators may be wrong, which the residual then tells.
///
/// # Errors
/// [`SignalError::NoResonance`] without starts; [`SignalError::Unfit`] for fewer lines than
/// unknowns, or normal equations that are singular.
pub fn fit_modes(
    responses: &[FrequencyResponse],
    starts: &[Pole],
) -> Result<ModalFit, SignalError> {
    let (begin, end) = range(responses);
    let Some(lowest) = starts.iter().map(|p| p.frequency_hz).reduce(f64::min) else {
        return Err(SignalError::NoResonance { low_hz: begin, high_hz: end });
    };
    let parts: Vec<FrequencyResponse> = responses
        .iter()
        .map(|r| r.within((BELOW_FIRST * lowest).max(r.frequencies_hz()[0]), end))
        .collect::<Result<_, _>>()?;
    // The noise of the data weighs the first fit, that of the residuals the last.
    let needed = (2 + 2 * parts.len()) * starts.len() + parts.len() * REMAINDER + 1;
    let mut noise: Vec<NoiseModel> = parts.iter().map(NoiseModel::from_differences).collect();
    let moduli: Vec<Vec<f64>> = parts.iter().map(|r| r.magnitudes()).collect();
    let mut problem = Problem::new(&parts, &noise, &moduli);
    if problem.data_count() <= needed {
        let count = parts.iter().map(|r| r.values().len()).sum();
        let remedy = "more lines than unknowns are needed; measure finer or restrict the range";
        return Err(too_short("the frequency response", count, needed, remedy));
    }
    let mut fitted = problem.fit(starts, REMAINDER)?;
    fitted = extended(&problem, fitted, starts.len(), &parts)?;
    for _ in 0..2 {
        let moduli;
        (noise, moduli) = problem.noise(&fitted.model);
        problem = Problem::new(&parts, &noise, &moduli);
        let terms = fitted.model.shares[0].remainder.len();
        fitted = problem.fit(&fitted.model.poles, terms)?;
    }
    Ok(summarised(&problem, fitted, noise, starts.len(), &parts))
}

/// Lowest and highest frequency of all responses, Hz.
fn range(responses: &[FrequencyResponse]) -> (f64, f64) {
    let ends = responses.iter().map(|r| {
        let f = r.frequencies_hz();
        (f[0], f[f.len() - 1])
    });
    ends.fold((f64::INFINITY, 0.0), |(low, high), (first, last)| (first.min(low), last.max(high)))
}

/// Adds remainder terms and poles while the residual asks for them.
fn extended(
    problem: &Problem,
    mut best: Fitted,
    starts: usize,
    parts: &[FrequencyResponse],
) -> Result<Fitted, SignalError> {
    let most_poles =
        if parts.iter().all(|part| part.has_phase()) { 2 * starts + 4 } else { starts };
    let (count, responses) = (problem.data_count(), parts.len());
    for _ in 0..(starts + 8) {
        let poles = best.model.poles.clone();
        let terms = best.model.shares[0].remainder.len();
        let unknowns = (2 + 2 * responses) * poles.len() + responses * terms;
        let room = |more: usize| unknowns + more < count / 2;
        let (mut gain, mut next) = (0.0, None);
        if terms + 2 <= MOST_REMAINDER
            && room(2 * responses)
            && let Ok(trial) = problem.fit(&poles, terms + 2)
        {
            let gained = best.chi_square - trial.chi_square - 4.0 * responses as f64;
            // The variance unit is only an estimate, hence the share of the misfit.
            if gained > 1e-6 * best.chi_square {
                (gain, next) = (gained, Some(trial));
            }
        }
        let more_unknowns = 2 + 2 * responses;
        if poles.len() < most_poles
            && room(more_unknowns)
            && let Some(candidate) = candidate(problem, &best, range(parts))
        {
            let more: Vec<Pole> = poles.iter().copied().chain([candidate]).collect();
            let bayes = more_unknowns as f64 * (count as f64).ln();
            let penalty = bayes.max(LEAST_SHARE * best.chi_square);
            if let Ok(trial) = problem.fit(&more, terms) {
                let gained = best.chi_square - trial.chi_square - penalty;
                if gained > gain && are_modes(&trial.model.poles) {
                    next = Some(trial);
                }
            }
        }
        let Some(trial) = next else { break };
        best = trial;
    }
    Ok(best)
}

/// Whether all poles could be modes, none twice the same.
fn are_modes(poles: &[Pole]) -> bool {
    let plausible = poles.iter().all(|p| p.damping_factor > 1e-6 && p.damping_factor < 0.89);
    let distinct = poles.iter().enumerate().all(|(i, p)| {
        poles[..i].iter().all(|q| {
            let apart = (p.frequency_hz - q.frequency_hz).abs()
                + (p.bandwidth_hz() - q.bandwidth_hz()).abs();
            apart > 0.02 * p.bandwidth_hz().min(q.bandwidth_hz())
        })
    });
    plausible && distinct
}

/// The pole whose functions take most out of the residual, on a grid reaching a tenth beyond the range.
fn candidate(problem: &Problem, fitted: &Fitted, (begin, end): (f64, f64)) -> Option<Pole> {
    let model = &fitted.model;
    let residuals = problem.weighted_residuals(model);
    let dampings: Vec<f64> = model.poles.iter().map(|p| p.damping_factor).collect();
    let typical = median(&dampings).clamp(1e-4, 0.1);
    let (mut best, mut best_gain) = (None, 0.0);
    for share in [0.5, 1.0, 2.0] {
        let damping_factor = share * typical;
        let step = 1.0 + (2.0 * damping_factor).max(0.002);
        let mut frequency_hz = 0.97 * begin;
        while frequency_hz < 1.1 * end {
            let pole = Pole { frequency_hz, damping_factor };
            let gain = problem.projection(&residuals, pole, REACH);
            if gain > best_gain {
                (best, best_gain) = (Some(pole), gain);
            }
            frequency_hz *= step;
        }
    }
    best
}

/// `1 + 2 sum rho_k` over the first lags at which the residuals are correlated beyond chance.
fn correlation(residuals: &[Vec<c64>]) -> f64 {
    let n: usize = residuals.iter().map(Vec::len).sum();
    let power: f64 = residuals.iter().flatten().map(|r| r.norm_sqr()).sum();
    let chance = 2.0 / (n as f64).sqrt();
    let mut factor = 1.0;
    for lag in 1..(n / 8).max(2) {
        let sum: f64 = residuals
            .iter()
            .flat_map(|residual| residual.iter().skip(lag).zip(residual))
            .map(|(a, b)| a.re * b.re + a.im * b.im)
            .sum();
        let rho = sum / power;
        if rho < chance || !rho.is_finite() {
            break;
        }
        factor += 2.0 * rho;
    }
    factor
}

/// Frequency of the nearest other pole whose half-power band overlaps that of `pole`, Hz.
fn overlapping(pole: Pole, others: impl Iterator<Item = Pole>) -> Option<f64> {
    let miss = |frequency_hz: f64| (frequency_hz - pole.frequency_hz).abs();
    let reach = |q: &Pole| 0.5 * (q.bandwidth_hz() + pole.bandwidth_hz());
    let near = others.filter(|q| *q != pole && miss(q.frequency_hz) < reach(q));
    near.map(|q| q.frequency_hz).reduce(|a, b| if miss(a) <= miss(b) { a } else { b })
}

/// Modes within the range, with their errors.
fn summarised(
    problem: &Problem,
    fitted: Fitted,
    noise: Vec<NoiseModel>,
    starts: usize,
    parts: &[FrequencyResponse],
) -> ModalFit {
    let Fitted { model, chi_square, inverse_normal } = fitted;
    // The variance that the residuals show, in units of the assumed one.
    let residuals = problem.weighted_residuals(&model);
    let unknowns = inverse_normal.nrows() as f64;
    let correlation = correlation(&residuals);
    let variance = correlation * chi_square / (problem.data_count() as f64 - unknowns).max(1.0);
    // Modes are the poles within the range, by frequency.
    let (begin, end) = range(parts);
    let is_mode = |&k: &usize| {
        let p = model.poles[k];
        (begin..=end).contains(&p.frequency_hz) && p.damping_factor < MOST_DAMPED
    };
    let mut inside: Vec<usize> = (0..model.poles.len()).filter(is_mode).collect();
    inside.sort_by(|i, j| model.poles[*i].frequency_hz.total_cmp(&model.poles[*j].frequency_hz));
    // Unknowns are logarithms: their errors are relative.
    let estimate = |value: f64, relative_error: f64| Estimate {
        value,
        low: value * (1.0 - NORMAL_95 * relative_error),
        high: value * (1.0 + NORMAL_95 * relative_error),
    };
    let error = |column: usize| (variance * inverse_normal[(column, column)]).max(0.0).sqrt();
    let modes = inside
        .iter()
        .map(|&k| {
            let pole = model.poles[k];
            let others = inside.iter().map(|&j| model.poles[j]);
            FittedMode {
                frequency_hz: estimate(pole.frequency_hz, error(2 * k)),
                damping_factor: estimate(pole.damping_factor, error(2 * k + 1)),
                standard_error: pole.damping_factor * error(2 * k + 1),
                overlaps_hz: overlapping(pole, others),
                half_power: None,
            }
        })
        .collect();
    let damping_covariance = Mat::from_fn(inside.len(), inside.len(), |i, j| {
        let (p, q) = (inside[i], inside[j]);
        let zetas = model.poles[p].damping_factor * model.poles[q].damping_factor;
        variance * zetas * inverse_normal[(2 * p + 1, 2 * q + 1)]
    });
    let (added_poles, range_hz) = (model.poles.len() - starts, (begin, end));
    ModalFit { model, modes, damping_covariance, noise, added_poles, correlation, range_hz }
}
