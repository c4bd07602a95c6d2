//! Tables, figure and page of an identified damping.

mod figures;
mod summary;

pub use figures::{identification, unit_of};
pub use summary::{FitSummary, IdentificationSummary, ModeSummary, ResponseSummary};

use super::{FolderError, OutputFolder};
use frictionsim_output::{Document, Section, Table, columns, write_rows};
use frictionsim_physics::linalg::c64;
use frictionsim_signal::reader::NamedResponse;
use frictionsim_signal::{ModalFit, RayleighFit};

/// Name of the `[damping]` section in its folder.
pub const DAMPING_BLOCK: &str = "damping.toml";

columns! {
    /// A mode of the responses; its row has its number before.
    pub(super) MODES: row as (usize, ModeSummary);
    mode: "number by frequency, from 1" = row.0, Always "mode" Count;
    frequency_hz: "undamped natural frequency" = row.1.frequency_hz, Always "frequency" Fixed(2);
    frequency_low_hz: "lower end of its 95 % interval" = row.1.frequency_interval_hz[0];
    frequency_high_hz: "upper end" = row.1.frequency_interval_hz[1];
    damping_factor: "damping factor of the fit"
        = row.1.damping_factor, Always "damping factor" Percent(4);
    damping_factor_low: "lower end of its 95 % interval"
        = row.1.damping_factor_interval[0], Always "from" Percent(4);
    damping_factor_high: "upper end" = row.1.damping_factor_interval[1], Always "to" Percent(4);
    half_power_damping_factor: "damping factor of the half-power band, where that can be trusted"
        = row.1.half_power.as_ref().and_then(|b| b.damping_factor),
        IfAny "by half-power" Percent(4);
    half_power_low_hz: "lower half-power frequency"
        = row.1.half_power.as_ref().and_then(|b| b.band_hz).map(|b| b[0]);
    half_power_high_hz: "upper half-power frequency"
        = row.1.half_power.as_ref().and_then(|b| b.band_hz).map(|b| b[1]);
    used: "whether it enters the coefficients" = row.1.used, Always "used" Plain;
    flag: "what is doubtful about it" = row.1.flag.clone(), IfAny "remark" Plain;
}

columns! {
    /// Rayleigh coefficients of an estimator.
    COEFFICIENTS: row as (&'static str, RayleighFit);
    estimator = row.0, Always "estimator" Plain;
    mass_coefficient_per_s = row.1.mass_coefficient.value, Always "alpha_R" Significant(5);
    mass_coefficient_low = row.1.mass_coefficient.low, Always "from" Significant(5);
    mass_coefficient_high = row.1.mass_coefficient.high, Always "to" Significant(5);
    stiffness_coefficient_s = row.1.stiffness_coefficient.value, Always "beta_R" Significant(5);
    stiffness_coefficient_low = row.1.stiffness_coefficient.low, Always "from" Significant(5);
    stiffness_coefficient_high = row.1.stiffness_coefficient.high, Always "to" Significant(5);
}

/// Frequency of a line, response, fitted response.
type FittedLine = (f64, c64, Option<c64>);

columns! {
    /// A line of a response and its fit.
    pub(super) FITTED: row as FittedLine;
    frequency_hz: "frequency of the line" = row.0;
    real: "real part of the response, in its unit" = row.1.re;
    imaginary: "imaginary part" = row.1.im;
    fit_real: "real part of the fitted response; empty outside the range of the fit"
        = row.2.map(|fit| fit.re);
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
        "The response is fitted from {low:.1} to {high:.1} Hz. The damping factors scatter {:.2} times as much about \
         (alpha_R / omega + beta_R omega) / 2 as their errors say.",
        summary.reduced_chi_square.sqrt(),
    );
    let peaks = summary.unmatched_peaks_hz.iter();
    let peaks = peaks.map(|peak| format!("The peak at {peak:.2} Hz has no mode in the fit."));
    let is_other = summary.reduced_chi_square > 3.0;
    let other = is_other.then(|| {
        "The material is not exactly Rayleigh, and the intervals are widened for it.".to_owned()
    });
    let half = summary.half_power;
    let estimators = std::iter::once(("fit of the response", summary.rayleigh))
        .chain(half.map(|own| ("half-power alone", own)));
    let few = half
        .is_none()
        .then(|| "Half-power alone: fewer than three modes without doubt.".to_owned());
    let modes = summary.modes.iter().enumerate().map(|(k, mode)| (k + 1, mode.clone()));
    Document::new("Identified damping")
        .section(
            Section::new("Rayleigh coefficients")
                .tables([Table::new("", "Rayleigh coefficients with their 95 % intervals")
                    .columns(COEFFICIENTS, estimators)])
                .text(few)
                .text(summary.responses.iter().map(of_response))
                .text(std::iter::once(scatter).chain(other).chain(peaks))
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
        let name = match k {
            0 => "fit.csv".to_owned(),
            _ => format!("fit-{}.csv", k + 1),
        };
        let lines = named.response.frequencies_hz().iter().zip(named.response.values());
        let lines = lines.map(|(&f, &h)| (f, h, fit.evaluate(k, f)));
        folder.write(&name, |out| write_rows(out, FITTED, lines))?;
    }
    Ok(())
}
