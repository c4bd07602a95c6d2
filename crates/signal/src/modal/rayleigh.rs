//! Rayleigh coefficients from modal damping factors (equation (3)).

use super::Pole;
use crate::statistics::{NORMAL_95, student_95};
use crate::{SignalError, error::failed_fit};
use faer::Mat;
use frictionsim_output::Described;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A value with its 95 % confidence interval.
#[derive(Clone, Copy, Debug, Default, PartialEq, Described, Serialize, Deserialize)]
pub struct Estimate {
    /// the value
    pub value: f64,
    /// lower end of its 95 % interval
    pub low: f64,
    /// upper end
    pub high: f64,
}

impl Estimate {
    /// The interval of an error to either side of a value.
    pub fn around(value: f64, error: f64) -> Self {
        Self { value, low: value - error, high: value + error }
    }

    /// The estimate of what rises with this.
    pub fn map(self, of: impl Fn(f64) -> f64) -> Self {
        Self { value: of(self.value), low: of(self.low), high: of(self.high) }
    }
}

/// Coefficients of Rayleigh damping fitted to modal damping factors.
#[derive(Clone, Copy, Debug, PartialEq, Described, Serialize)]
pub struct RayleighFit {
    /// `alpha_R`, 1/s.
    pub mass_coefficient: Estimate,
    /// `beta_R`, s.
    pub stiffness_coefficient: Estimate,
    /// Chi-square for each degree of freedom: about 1 where the scatter of the modes about the curve is what their
    /// uncertainties explain; 1 by construction where those are unknown.
    #[serde(skip)]
    pub reduced_chi_square: f64,
}

/// Fits `zeta = (alpha_R / omega + beta_R omega) / 2` with `alpha_R, beta_R >= 0`.
///
/// Generalised least squares with the given covariance of the damping factors. Without one, errors are taken
/// proportional to the factors and their size is found from the scatter. Intervals: 95 %, normal where the scatter
/// agrees with the covariance, widened to Student's t of the scatter where it is larger (material that is not exactly
/// Rayleigh). A coefficient that would be negative is set to zero, and its interval begins there.
///
/// # Errors
/// [`SignalError::Unfit`] for fewer than 2 modes, or fewer than 3 without covariance, for a covariance that is singular
/// and for modes at one frequency; [`SignalError::Asked`] for a frequency not positive.
pub fn fit_rayleigh(
    samples: &[Pole],
    covariance: Option<&Mat<f64>>,
) -> Result<RayleighFit, SignalError> {
    let m = samples.len();
    if m < 2 || (m < 3 && covariance.is_none()) {
        return Err(SignalError::Unfit(format!(
            "{m} usable damping factor(s): alpha_R and beta_R with an uncertainty need at least 2 modes of known \
             uncertainty, or 3 without. Widen the frequency range"
        )));
    }
    for s in samples {
        crate::error::check_positive("modal frequency", s.frequency_hz, " (Hz)")?;
    }
    // Unknowns scaled to the geometric mean frequency, where both terms are comparable.
    let mean_log = samples.iter().map(|s| s.frequency_hz.ln()).sum::<f64>() / m as f64;
    let reference = TAU * mean_log.exp();
    let design = DMatrix::from_fn(m, 2, |i, k| {
        let x = TAU * samples[i].frequency_hz / reference;
        if k == 0 { 0.5 / x } else { 0.5 * x }
    });
    let zeta = DVector::from_iterator(m, samples.iter().map(|s| s.damping_factor));
    let singular = || failed_fit("the covariance of the damping factors is singular");
    let weight = match covariance {
        Some(c) => {
            DMatrix::from_fn(m, m, |i, j| c[(i, j)]).cholesky().ok_or_else(singular)?.inverse()
        }
        None => DMatrix::from_diagonal(&zeta.map(|z| 1.0 / (z * z).max(f64::MIN_POSITIVE))),
    };
    let normal = design.transpose() * &weight * &design;
    let right = design.transpose() * &weight * &zeta;
    let same = "the modes lie at one frequency, which cannot tell alpha_R from beta_R";
    let spread = normal.clone().try_inverse().ok_or_else(|| failed_fit(same))?;
    let mut x = &spread * &right;
    for k in 0..2 {
        if x[k] < 0.0 {
            x[k] = 0.0;
            x[1 - k] = (right[1 - k] / normal[(1 - k, 1 - k)]).max(0.0);
        }
    }
    let misfit = &zeta - &design * &x;
    let degrees = m as f64 - 2.0;
    let chi_square = (misfit.transpose() * &weight * &misfit)[(0, 0)];
    let scatter = if m > 2 { (chi_square / degrees).sqrt() } else { 0.0 };
    let known = if covariance.is_some() { NORMAL_95 } else { 0.0 };
    let factor = known.max(if m > 2 { student_95(degrees) * scatter } else { 0.0 });
    let estimate = |k: usize, unit: f64| {
        let error = factor * spread[(k, k)].max(0.0).sqrt();
        let own = Estimate::around(x[k], error);
        Estimate { low: own.low.max(0.0), ..own }.map(|own| own * unit)
    };
    Ok(RayleighFit {
        mass_coefficient: estimate(0, reference),
        stiffness_coefficient: estimate(1, 1.0 / reference),
        reduced_chi_square: if covariance.is_some() { scatter * scatter } else { 1.0 },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(alpha: f64, beta: f64, frequencies: &[f64]) -> Vec<Pole> {
        frequencies
            .iter()
            .map(|f| Pole {
                frequency_hz: *f,
                damping_factor: 0.5 * (alpha / (TAU * f) + beta * TAU * f),
            })
            .collect()
    }

    #[test]
    fn exact_damping_factors_return_the_coefficients_of_the_paper() {
        let fit =
            fit_rayleigh(&curve(40.0, 4.5e-7, &[1200.0, 3000.0, 5600.0, 9000.0]), None).unwrap();
        assert!((fit.mass_coefficient.value / 40.0 - 1.0).abs() < 1e-12);
        assert!((fit.stiffness_coefficient.value / 4.5e-7 - 1.0).abs() < 1e-12);
        assert!(fit.mass_coefficient.high - fit.mass_coefficient.low < 1e-9);
    }

    #[test]
    fn damping_that_rises_faster_than_stiffness_gives_no_negative_mass_coefficient() {
        let mut samples = curve(0.0, 4.5e-7, &[2000.0, 4000.0, 8000.0]);
        samples[0].damping_factor *= 0.8;
        let fit = fit_rayleigh(&samples, None).unwrap();
        assert_eq!(fit.mass_coefficient.value, 0.0);
        assert_eq!(fit.mass_coefficient.low, 0.0);
        assert!(fit.stiffness_coefficient.value > 0.0);
    }

    #[test]
    fn two_modes_need_a_known_uncertainty() {
        let samples = curve(40.0, 4.5e-7, &[2000.0, 8000.0]);
        let few = fit_rayleigh(&samples, None).unwrap_err().to_string();
        assert!(few.starts_with("2 usable damping factor(s)"), "{few}");
        let covariance = Mat::from_fn(2, 2, |i, j| if i == j { 1e-10 } else { 0.0 });
        let fit = fit_rayleigh(&samples, Some(&covariance)).unwrap();
        assert!(fit.mass_coefficient.low < 40.0 && 40.0 < fit.mass_coefficient.high);
    }
}
