//! Summary of `identify`, as it is written, printed and reported.

use crate::finding::keys;
use frictionsim_output::rounded;
use frictionsim_signal::reader::NamedResponse;
use frictionsim_signal::{
    Estimate, FittedMode, HalfPowerBand, Identification, RayleighFit, ResonanceNote,
};

keys! {
    /// Rayleigh coefficients of measured responses.
    IdentificationSummary {
        source: String = "name of the table of the responses";
        quantity: String = "quantity of the first response";
        has_phase: bool = "whether its phase is known";
        lines: usize = "its number of lines";
        responses: Vec<ResponseSummary> = "the responses";
        #[serde(flatten)]
        rayleigh: RayleighFit = "the coefficients";
        reduced_chi_square: f64 = "scatter of the damping factors about equation (3) over what \
            their errors explain, squared";
        half_power: Option<RayleighFit> = "the coefficients from half-power factors alone";
        modes: Vec<ModeSummary> = "modes by frequency";
        unmatched_peaks_hz: Vec<f64> = "peaks of which the fit made no mode, Hz";
        fit: FitSummary = "the fit of the responses";
        notes: Vec<String> = "decisions of the reader";
    }

    /// One response and its noise.
    ResponseSummary {
        name: String = "name as in the table";
        quantity: String = "receptance, mobility or accelerance";
        lines: usize = "number of lines";
        range_hz: [f64; 2] = "lowest and highest frequency, Hz";
        relative_noise: f64 = "noise relative to the modulus";
        additive_noise: f64 = "noise that does not depend on the response, its unit";
    }

    /// One mode with both estimates of its damping.
    ModeSummary {
        frequency_hz: f64 = "undamped natural frequency, Hz";
        damping_factor: f64 = "damping factor";
        frequency_interval_hz: [f64; 2] = "95 % interval, Hz";
        damping_factor_interval: [f64; 2] = "95 % interval";
        half_power: Option<HalfPowerBand> = "by the half-power points";
        used: bool = "whether it enters the coefficients";
        flag: Option<String> = "what is doubtful about it";
    }

    /// The fit of all responses.
    FitSummary {
        range_hz: [f64; 2] = "lowest and highest frequency used, Hz";
        added_poles: usize = "poles added because the residual asked for them";
        relative_noise: f64 = "noise of the first response relative to its modulus";
        additive_noise: f64 = "noise of the first response that does not depend on it";
        residual_correlation: f64 = "factor by which correlated residuals widen the variances";
    }
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
