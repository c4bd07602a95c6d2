//! Tables, figure and page of an identified damping.

use crate::common::*;
use frictionsim_chart::significant;
use frictionsim_signal::{
    FittedMode, HalfPowerBand, Identification, ModalFit, RayleighFit, ResonanceNote,
    reader::NamedResponse,
};

/// Name of the `[damping]` section in its folder.
pub const DAMPING_BLOCK: &str = "damping.toml";

/// Frequency of a line, response, fitted response.
type FittedLine = (f64, c64, Option<c64>);

columns! {
    /// A mode of the responses; its row has its number before.
    pub(super) MODES: row as (usize, ModeSummary);
    mode: "number by frequency, from 1" = row.0, Always "mode" Count;
    frequency_hz: "undamped natural frequency" = row.1.frequency_hz, Always "frequency" Fixed(2);
    frequency_low_hz: "lower end of its 95 % interval" = row.1.frequency_interval_hz[0];
    frequency_high_hz: "upper end" = row.1.frequency_interval_hz[1];
    damping_factor: "damping factor of the fit" = row.1.damping_factor, Always "damping factor" Percent(4);
    damping_factor_low: "lower end of its 95 % interval" = row.1.damping_factor_interval[0], Always "from" Percent(4);
    damping_factor_high: "upper end" = row.1.damping_factor_interval[1], Always "to" Percent(4);
    half_power_damping_factor: "damping factor of the half-power band, where that can be trusted"
        = row.1.half_power.as_ref().and_then(|b| b.damping_factor),
        IfAny "by half-power" Percent(4);
    half_power_low_hz: "lower half-power frequency" = row.1.half_power.as_ref().and_then(|b| b.band_hz).map(|b| b[0]);
    half_power_high_hz: "upper half-power frequency" = row.1.half_power.as_ref().and_then(|b| b.band_hz).map(|b| b[1]);
    used: "whether it enters the coefficients" = row.1.used, Always "used" Plain;
    flag: "what is doubtful about it" = row.1.flag.clone(), IfAny "remark" Plain;

    /// Rayleigh coefficients of an estimator.
    COEFFICIENTS: row as (&'static str, RayleighFit);
    estimator = row.0, Always "estimator" Plain;
    mass_coefficient_per_s = row.1.mass_coefficient.value, Always "alpha_R" Significant(5);
    mass_coefficient_low = row.1.mass_coefficient.low, Always "from" Significant(5);
    mass_coefficient_high = row.1.mass_coefficient.high, Always "to" Significant(5);
    stiffness_coefficient_s = row.1.stiffness_coefficient.value, Always "beta_R" Significant(5);
    stiffness_coefficient_low = row.1.stiffness_coefficient.low, Always "from" Significant(5);
    stiffness_coefficient_high = row.1.stiffness_coefficient.high, Always "to" Significant(5);

    /// A line of a response and its fit.
    pub(super) FITTED: row as FittedLine;
    frequency_hz: "frequency of the line" = row.0;
    real: "real part of the response, in its unit" = row.1.re;
    imaginary: "imaginary part" = row.1.im;
    fit_real: "real part of the fitted response; empty outside the range of the fit" = row.2.map(|fit| fit.re);
    fit_imaginary: "imaginary part" = row.2.map(|fit| fit.im);
}

/// Tables and sentences.
pub fn document(summary: &IdentificationSummary) -> Document {
    let [low, high] = summary.fit.range_hz;
    let of_response = |own: &ResponseSummary| {
        let [from, to] = own.range_hz;
        format!(
            "{}: response \"{}\" ({}), {} lines from {from} to {to} Hz.",
            summary.source, own.name, own.quantity, own.lines
        )
    };
    let scatter = format!(
        "The response is fitted from {low:.1} to {high:.1} Hz. The damping factors scatter {:.2} times as widely about \
         (alpha_R / omega + beta_R omega) / 2 as their standard errors predict.",
        summary.reduced_chi_square.sqrt(),
    );
    let peaks = summary.unmatched_peaks_hz.iter();
    let peaks = peaks.map(|peak| format!("The peak at {peak:.2} Hz has no mode in the fit."));
    let is_other = summary.reduced_chi_square > 3.0;
    let mut other =
        "The material is not exactly Rayleigh, and the intervals are widened for it.".to_owned();
    if !summary.has_phase {
        other += " It may be two modes under one peak, too, which magnitudes alone do not part: measure the phase.";
    }
    let half = summary.half_power;
    let estimators = std::iter::once(("fit of the response", summary.rayleigh))
        .chain(half.map(|own| ("half-power alone", own)));
    let few = "Half-power alone: fewer than three modes without doubt.";
    let modes = summary.modes.iter().enumerate().map(|(k, mode)| (k + 1, mode.clone()));
    Document::new("Identified damping")
        .section(
            Section::new("Rayleigh coefficients")
                .tables([Table::new("", "Rayleigh coefficients with their 95 % intervals")
                    .columns(COEFFICIENTS, estimators)])
                .text(half.is_none().then(|| few.to_owned()))
                .text(summary.responses.iter().map(of_response))
                .text(std::iter::once(scatter).chain(is_other.then_some(other)).chain(peaks))
                .text([summary.damping_block()])
                .figures([""]),
        )
        .section(
            Section::new("Modes")
                .tables([Table::new("modes.csv", "Modes of the response").columns(MODES, modes)]),
        )
        .notes(&summary.notes)
}

/// Writes `fit.csv` (`fit-2.csv` and so on for further responses).
pub fn write_fits(
    folder: &OutputFolder,
    responses: &[NamedResponse],
    fit: &ModalFit,
) -> Result<(), FolderError> {
    for (k, named) in responses.iter().enumerate() {
        let name = if k == 0 { "fit.csv".to_owned() } else { format!("fit-{}.csv", k + 1) };
        let lines = named.response.frequencies_hz().iter().zip(named.response.values());
        let lines = lines.map(|(&f, &h)| (f, h, fit.evaluate(k, f)));
        folder.write(&name, |out| write_rows(out, FITTED, lines))?;
    }
    Ok(())
}

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

/// The unit of a response quantity by its name; none of any other name.
pub fn response_unit(quantity: &str) -> &'static str {
    match quantity {
        "accelerance" => "m/s²/N",
        "mobility" => "m/s/N",
        "receptance" => "m/N",
        _ => "",
    }
}

/// The first response with its fit and its half-power points, and the damping factors with the fitted curve of equation
/// (3).
pub fn identification(response: &FrequencyResponse, found: &Identification) -> Figure {
    let frequencies = response.frequencies_hz();
    let magnitude = response.magnitudes();
    let fitted =
        frequencies.iter().map(|f| found.fit.evaluate(0, *f).map_or(f64::NAN, |h| h.norm()));
    let fitted: Vec<f64> = fitted.collect();
    let highest = extremes(frequencies.iter().copied()).1;
    let at = |frequency: f64| {
        let index = frequencies.partition_point(|&f| f < frequency);
        magnitude.get(index).or(magnitude.last()).copied().unwrap_or(f64::NAN)
    };
    let bands = found.fit.modes.iter().filter_map(|mode| mode.half_power);
    let halves = bands.filter_map(|band| Some((band.frequency_hz, band.band_hz?)));
    let halves = halves.flat_map(|(peak, [low, high])| {
        // By definition they lie a factor sqrt(2) below the peak.
        [low, high].map(|f| (f, at(peak) / std::f64::consts::SQRT_2))
    });
    let place = |mode: &FittedMode| (mode.frequency_hz.value, mode.damping_factor.value);
    let tick = |mode: &FittedMode| {
        Rule::vertical(place(mode).0).stroke(Stroke::dotted(INK, 0.5)).name("fitted mode")
    };
    let response = Panel::new(
        Axis::kilohertz().tight(),
        Axis::new("|*H*|", response_unit(response.quantity().name())).logarithmic(),
    )
    .height(150.0)
    .layers(found.fit.modes.iter().map(tick))
    .layer(Line::new(frequencies, &magnitude).solid(SERIES[0], 0.9).name("measured"))
    .layer(Line::new(frequencies, &fitted).stroke(Stroke::dashed(SERIES[6], 0.7)).name("fitted"))
    .layer(Points::new(halves).marker(Marker::Diamond, 1.3, UNSTABLE).name("half-power points"));
    let (alpha, beta) = (found.rayleigh.mass_coefficient, found.rayleigh.stiffness_coefficient);
    let omegas = (1..=300).map(|i| TAU * highest * f64::from(i) / 300.0);
    let curve = |mass: f64, stiffness: f64| -> Vec<f64> {
        // (3)
        omegas.clone().map(|omega| 0.5 * (mass / omega + stiffness * omega)).collect()
    };
    let hertz: Vec<f64> = omegas.clone().map(|omega| omega / TAU).collect();
    let line = |mass: f64, stiffness: f64| Line::new(&hertz, &curve(mass, stiffness));
    let used = |is_used: bool| found.fit.modes.iter().filter(move |mode| mode.is_used() == is_used);
    let top = 1.35 * extremes(found.fit.modes.iter().map(|mode| place(mode).1)).1;
    let bars = used(true).map(|mode| {
        let ((f, factor), reach) = (place(mode), 1.96 * mode.standard_error);
        Line::through([(f, factor - reach), (f, factor + reach)]).solid(INK, 0.7)
    });
    let (low, high) = (curve(alpha.low, beta.low), curve(alpha.high, beta.high));
    let band = Fill::between(&hertz, &low, &high, SERIES[0]);
    // Bounds to a digit more than the coefficient, so that they do not round onto it.
    let named = |symbol: &str, own: Estimate, unit: &str| {
        let [low, high] = [own.low, own.high].map(|end| significant(end, 5));
        format!("{symbol} = {} [{low}, {high}] {unit}", significant(own.value, 4))
    };
    let dashed = |colour| Stroke::dashed(colour, 0.9);
    let damping = Panel::new(
        Axis::kilohertz().between(0.0, highest),
        Axis::new("damping factor *ζ*", "%").times(100.0).between(0.0, top),
    )
    .height(150.0)
    .layer(band.opacity(0.2))
    .layer(line(alpha.value, 0.0).stroke(dashed(SERIES[2])).name(named("*α*_{R}", alpha, "1/s")))
    .layer(line(0.0, beta.value).stroke(dashed(SERIES[1])).name(named("*β*_{R}", beta, "s")))
    .layer(
        line(alpha.value, beta.value)
            .solid(SERIES[0], 1.2)
            .name("*ζ* = (*α*_{R}/*ω* + *β*_{R}*ω*)/2"),
    )
    .layers(bars)
    .layer(
        Points::new(used(false).map(place))
            .marker(Marker::Circle, 1.8, INK)
            .name("factor not used"),
    )
    .layer(Points::new(used(true).map(place)).marker(Marker::Disc, 1.8, INK).name("fitted factor"));
    Figure::new(
        "identification",
        "Measured and fitted response with half-power points (a). Damping factors of the fitted \
         modes with 95 % intervals, and the curve of the identified coefficients (b).",
    )
    .columns(2)
    .panel(response)
    .panel(damping)
}
