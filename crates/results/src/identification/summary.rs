//! Summary of `identify`, as it is written, printed and reported.

use frictionsim_output::{Described, rounded};
use frictionsim_signal::reader::NamedResponse;
use frictionsim_signal::{
    Estimate, FittedMode, HalfPowerBand, Identification, RayleighFit, ResonanceNote,
};
use serde::Serialize;

/// Rayleigh coefficients of measured responses.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct IdentificationSummary {
    /// Name of the table of the responses.
    pub source: String,
    /// Quantity of the first response.
    pub quantity: String,
    /// Whether its phase is known.
    pub has_phase: bool,
    /// Its number of lines.
    pub lines: usize,
    /// The responses.
    pub responses: Vec<ResponseSummary>,
    /// The coefficients.
    #[serde(flatten)]
    pub rayleigh: RayleighFit,
    /// Scatter of the damping factors about equation (3) over what their errors explain, squared.
    pub reduced_chi_square: f64,
    /// The coefficients from half-power factors alone.
    pub half_power: Option<RayleighFit>,
    /// Modes by frequency.
    pub modes: Vec<ModeSummary>,
    /// Peaks of which the fit made no mode, Hz.
    pub unmatched_peaks_hz: Vec<f64>,
    /// The fit of the responses.
    pub fit: FitSummary,
    /// Decisions of the reader.
    pub notes: Vec<String>,
}

/// One response and its noise.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct ResponseSummary {
    /// Name as in the table.
    pub name: String,
    /// Receptance, mobility or accelerance.
    pub quantity: String,
    /// Number of lines.
    pub lines: usize,
    /// Lowest and highest frequency, Hz.
    pub range_hz: [f64; 2],
    /// Noise relative to the modulus.
    pub relative_noise: f64,
    /// Noise that does not depend on the response, its unit.
    pub additive_noise: f64,
}

/// One mode with both estimates of its damping.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct ModeSummary {
    /// Undamped natural frequency, Hz.
    pub frequency_hz: f64,
    /// Damping factor.
    pub damping_factor: f64,
    /// 95 % interval, Hz.
    pub frequency_interval_hz: [f64; 2],
    /// 95 % interval.
    pub damping_factor_interval: [f64; 2],
    /// By the half-power points.
    pub half_power: Option<HalfPowerBand>,
    /// Whether it enters the coefficients.
    pub used: bool,
    /// What is doubtful about it.
    pub flag: Option<String>,
}

/// The fit of all responses.
#[derive(Clone, Debug, PartialEq, Described, Serialize)]
pub struct FitSummary {
    /// Lowest and highest frequency used, Hz.
    pub range_hz: [f64; 2],
    /// Poles added because the residual asked for them.
    pub added_poles: usize,
    /// Noise of the first response relative to its modulus.
    pub relative_noise: f64,
    /// Noise of the first response that does not depend on it.
    pub additive_noise: f64,
    /// Factor by which correlated residuals widen the variances.
    pub residual_correlation: f64,
}

impl IdentificationSummary {
    /// The findings of a run.
    pub fn new(
        source: &str,
        responses: &[NamedResponse],
        found: &Identification,
        notes: Vec<String>,
    ) -> Self {
        let (fit, first) = (&found.fit, &responses[0].response);
        let described = responses.iter().zip(&fit.noise).map(|(named, noise)| {
            let f = named.response.frequencies_hz();
            ResponseSummary {
                name: named.name.clone(),
                quantity: named.response.quantity().name().to_owned(),
                lines: f.len(),
                range_hz: [f[0], f[f.len() - 1]],
                relative_noise: noise.relative,
                additive_noise: noise.additive,
            }
        });
        Self {
            source: source.to_owned(),
            quantity: first.quantity().name().to_owned(),
            has_phase: first.has_phase(),
            lines: first.values().len(),
            responses: described.collect(),
            rayleigh: found.rayleigh,
            reduced_chi_square: found.rayleigh.reduced_chi_square,
            half_power: found.half_power_rayleigh,
            modes: fit.modes.iter().map(ModeSummary::of).collect(),
            unmatched_peaks_hz: found.unmatched.iter().map(|b| b.frequency_hz).collect(),
            fit: FitSummary {
                range_hz: [fit.range_hz.0, fit.range_hz.1],
                added_poles: fit.added_poles,
                relative_noise: fit.noise[0].relative,
                additive_noise: fit.noise[0].additive,
                residual_correlation: fit.correlation,
            },
            notes,
        }
    }

    /// A `[damping]` section ready to paste into a case.
    pub fn damping_block(&self) -> String {
        let line = |key: &str, e: Estimate, unit: &str| {
            let [value, low, high] = justified(e);
            format!("{key} = {value} # {unit}, 95 % between {low} and {high}\n")
        };
        format!(
            "[damping] # identified from {}\n{}{}",
            self.source.replace(['\n', '\r'], " "),
            line("mass_coefficient", self.rayleigh.mass_coefficient, "1/s"),
            line("stiffness_coefficient", self.rayleigh.stiffness_coefficient, "s"),
        )
    }
}

impl ModeSummary {
    fn of(mode: &FittedMode) -> Self {
        let (f, zeta) = (mode.frequency_hz, mode.damping_factor);
        Self {
            frequency_hz: f.value,
            damping_factor: zeta.value,
            frequency_interval_hz: [f.low, f.high],
            damping_factor_interval: [zeta.low, zeta.high],
            half_power: mode.half_power,
            used: mode.is_used(),
            flag: flag(mode),
        }
    }
}

/// What a user should know of a mode, or nothing.
fn flag(mode: &FittedMode) -> Option<String> {
    let note = mode.half_power.and_then(|b| b.note);
    Some(match (mode.overlaps_hz, note) {
        (Some(other), _) => format!("close: overlaps the mode at {other:.1} Hz"),
        (None, Some(ResonanceNote::Overlaps(other))) => {
            format!("close: half-power band reaches that at {other:.1} Hz")
        }
        (None, Some(ResonanceNote::TooCoarse(lines))) => {
            format!("coarse: {lines} lines in the half-power band")
        }
        (None, Some(ResonanceNote::OneSided)) => "no half-power point on one side".to_owned(),
        (None, None) if mode.half_power.is_none() => "no peak: found by the fit".to_owned(),
        (None, None) => return None,
    })
}

/// Value and interval to the digits that the interval justifies, as TOML floats.
fn justified(e: Estimate) -> [String; 3] {
    let width = (e.high - e.low).abs().max(1e-6 * e.value.abs());
    let digits = |x: f64| {
        if x == 0.0 || !x.is_finite() || width == 0.0 {
            return "0.0".to_owned();
        }
        // Two digits of the interval's width.
        let decimals =
            (x.abs().log10().floor() - width.log10().floor()).clamp(0.0, 8.0) as usize + 1;
        format!("{:?}", rounded(x, decimals + 1))
    };
    [digits(e.value), digits(e.low), digits(e.high)]
}
