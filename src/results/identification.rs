//! Tables of an identified damping.

mod figures;
mod report;

pub use figures::{IdentificationRecord, draw, unit_of};
pub use report::draw_report;

use super::folder::{FolderError, OutputFolder};
use super::table::{Table, format_number};
use crate::signal::{
    Estimate, FrequencyResponse, Identification, IdentifiedMode, RayleighFit, ResonanceNote,
};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Name of the `[damping]` section in its folder.
const DAMPING_BLOCK: &str = "damping.toml";

/// What `identify` found, and where.
#[derive(Clone, Debug)]
pub struct IdentificationReport<'a> {
    /// Name of the table of the response.
    pub source: String,
    /// The response.
    pub response: &'a FrequencyResponse,
    /// Modes and coefficients.
    pub identification: &'a Identification,
    /// Decisions of the reader.
    pub notes: Vec<String>,
    /// Wall time, s.
    pub wall_s: f64,
}

/// Writes `modes.csv`, `fit.csv`, `damping.toml` and `summary.json`; returns the summary.
///
/// # Errors
/// Those of the folder.
pub fn write(folder: &OutputFolder, report: &IdentificationReport) -> Result<Value, FolderError> {
    folder.write("modes.csv", |out| write_modes(out, report.identification))?;
    folder.write("fit.csv", |out| write_fit(out, report))?;
    folder.write(DAMPING_BLOCK, |out| {
        out.write_all(damping_block(report).as_bytes())
    })?;
    let mut summary = summary(report);
    summary["manifest"] = json!(folder.manifest());
    folder.write("summary.json", |out| {
        serde_json::to_writer_pretty(&mut *out, &summary)?;
        out.write_all(b"\n")
    })?;
    Ok(summary)
}

/// A `[damping]` section ready to paste into a case.
pub fn damping_block(report: &IdentificationReport) -> String {
    let fit = &report.identification.rayleigh;
    let line = |key: &str, e: Estimate, unit: &str| {
        let [value, low, high] = rounded(e);
        format!("{key} = {value} # {unit}, 95 % between {low} and {high}\n")
    };
    format!(
        "[damping] # identified from {}\n{}{}",
        report.source.replace(['\n', '\r'], " "),
        line("mass_coefficient", fit.mass_coefficient, "1/s"),
        line("stiffness_coefficient", fit.stiffness_coefficient, "s"),
    )
}

/// Value and interval to the digits that the interval justifies, as TOML floats.
fn rounded(e: Estimate) -> [String; 3] {
    let width = (e.high - e.low).abs().max(1e-6 * e.value.abs());
    let digits = |x: f64| {
        if x == 0.0 || !x.is_finite() || width == 0.0 {
            return "0.0".to_owned();
        }
        // Two digits of the interval's width.
        let decimals =
            (x.abs().log10().floor() - width.log10().floor()).clamp(0.0, 8.0) as usize + 1;
        let text = format!("{x:.decimals$e}");
        let value: f64 = text.parse().unwrap_or(x);
        format!("{value:?}")
    };
    [digits(e.value), digits(e.low), digits(e.high)]
}

fn summary(report: &IdentificationReport) -> Value {
    let found = report.identification;
    let fit = &found.fit;
    json!({
        "command": "identify",
        "source": report.source,
        "quantity": report.response.quantity().name(),
        "has_phase": report.response.has_phase(),
        "lines": report.response.values().len(),
        "mass_coefficient": found.rayleigh.mass_coefficient,
        "stiffness_coefficient": found.rayleigh.stiffness_coefficient,
        "reduced_chi_square": found.rayleigh.reduced_chi_square,
        "half_power": found.half_power_rayleigh.map(|r| json!({
            "mass_coefficient": r.mass_coefficient,
            "stiffness_coefficient": r.stiffness_coefficient,
        })),
        "modes": found.modes.iter().map(mode_summary).collect::<Vec<_>>(),
        "unmatched_peaks_hz": found.unmatched.iter().map(|b| b.frequency_hz).collect::<Vec<_>>(),
        "fit": {
            "range_hz": [fit.range_hz.0, fit.range_hz.1],
            "added_poles": fit.added_poles,
            "relative_noise": fit.noise.relative,
            "additive_noise": fit.noise.additive,
            "residual_correlation": fit.correlation,
        },
        "notes": report.notes,
        "wall_s": report.wall_s,
    })
}

fn mode_summary(mode: &IdentifiedMode) -> Value {
    let (f, zeta) = (mode.fitted.frequency_hz, mode.fitted.damping_factor);
    json!({
        "frequency_hz": f.value,
        "damping_factor": zeta.value,
        "frequency_interval_hz": [f.low, f.high],
        "damping_factor_interval": [zeta.low, zeta.high],
        "half_power": mode.half_power.map(|b| json!({
            "frequency_hz": b.frequency_hz,
            "damping_factor": b.damping_factor,
            "band_hz": b.band_hz.map(|(low, high)| [low, high]),
        })),
        "used": mode.is_used,
        "flag": flag(mode),
    })
}

/// What a user should know of a mode, or nothing.
fn flag(mode: &IdentifiedMode) -> Option<String> {
    let note = mode.half_power.and_then(|b| b.note);
    match (mode.fitted.overlaps_hz, note) {
        (Some(other), _) => Some(format!("close: overlaps the mode at {other:.1} Hz")),
        (None, Some(ResonanceNote::Overlaps(other))) => Some(format!(
            "close: half-power band reaches that at {other:.1} Hz"
        )),
        (None, Some(ResonanceNote::TooCoarse(lines))) => {
            Some(format!("coarse: {lines} lines in the half-power band"))
        }
        (None, Some(ResonanceNote::OneSided)) => Some("no half-power point on one side".to_owned()),
        (None, None) if mode.half_power.is_none() => Some("no peak: found by the fit".to_owned()),
        (None, None) => None,
    }
}

fn write_modes(out: &mut dyn std::io::Write, found: &Identification) -> std::io::Result<()> {
    let mut table = Table::new(
        out,
        &[
            "mode",
            "frequency_hz",
            "frequency_low_hz",
            "frequency_high_hz",
            "damping_factor",
            "damping_factor_low",
            "damping_factor_high",
            "half_power_damping_factor",
            "half_power_low_hz",
            "half_power_high_hz",
            "used",
            "flag",
        ],
    )?;
    for (k, mode) in found.modes.iter().enumerate() {
        let (f, zeta) = (mode.fitted.frequency_hz, mode.fitted.damping_factor);
        let band = mode.half_power.and_then(|b| b.band_hz);
        let numbers = [
            f.value,
            f.low,
            f.high,
            zeta.value,
            zeta.low,
            zeta.high,
            mode.half_power
                .and_then(|b| b.damping_factor)
                .unwrap_or(f64::NAN),
            band.map_or(f64::NAN, |b| b.0),
            band.map_or(f64::NAN, |b| b.1),
        ];
        let mut cells = vec![(k + 1).to_string()];
        cells.extend(numbers.iter().map(|v| format_number(*v)));
        cells.push(u8::from(mode.is_used).to_string());
        cells.push(flag(mode).unwrap_or_default());
        table.row(cells)?;
    }
    table.finish()
}

fn write_fit(out: &mut dyn std::io::Write, report: &IdentificationReport) -> std::io::Result<()> {
    let mut table = Table::new(
        out,
        &[
            "frequency_hz",
            "real",
            "imaginary",
            "fit_real",
            "fit_imaginary",
        ],
    )?;
    let fit = &report.identification.fit;
    let response = report.response;
    for (f, h) in response.frequencies_hz().iter().zip(response.values()) {
        let inside = (fit.range_hz.0..=fit.range_hz.1).contains(f);
        let model = inside.then(|| fit.model.evaluate(*f));
        let part = |v: Option<f64>| v.unwrap_or(f64::NAN);
        table.numbers(&[
            *f,
            h.re,
            h.im,
            part(model.map(|m| m.re)),
            part(model.map(|m| m.im)),
        ])?;
    }
    table.finish()
}

/// Modes and coefficients for a person.
pub fn print(report: &IdentificationReport) -> String {
    let found = report.identification;
    let mut text = format!(
        "{}: {}, {} lines from {} to {} Hz\n",
        report.source,
        report.response.quantity().name(),
        report.response.values().len(),
        report.response.frequencies_hz()[0],
        report.response.frequencies_hz()[report.response.values().len() - 1],
    );
    text.push_str("mode  frequency_hz  damping_factor        95 %          half_power  \n");
    for (k, mode) in found.modes.iter().enumerate() {
        let zeta = mode.fitted.damping_factor;
        let half = mode.half_power.and_then(|b| b.damping_factor);
        let _ = writeln!(
            text,
            "{:>4}  {:>12.2}  {:>14.6}  +- {:<10.6}  {:>12}  {}{}",
            k + 1,
            mode.fitted.frequency_hz.value,
            zeta.value,
            0.5 * (zeta.high - zeta.low),
            half.map_or("-".to_owned(), |z| format!("{z:.6}")),
            if mode.is_used { "" } else { "not used; " },
            flag(mode).unwrap_or_default(),
        );
    }
    for band in &found.unmatched {
        let _ = writeln!(
            text,
            "      {:>12.2}  peak without a mode in the fit",
            band.frequency_hz
        );
    }
    let line = |name: &str, r: &RayleighFit| {
        let ([a, al, ah], [b, bl, bh]) = (
            rounded(r.mass_coefficient),
            rounded(r.stiffness_coefficient),
        );
        format!("{name:<12} alpha_R = {a} 1/s [{al}, {ah}]   beta_R = {b} s [{bl}, {bh}]\n")
    };
    text.push_str(&line("fit", &found.rayleigh));
    match &found.half_power_rayleigh {
        Some(r) => text.push_str(&line("half-power", r)),
        None => text.push_str("half-power   fewer than three modes without doubt\n"),
    }
    if found.rayleigh.reduced_chi_square > 3.0 {
        let _ = writeln!(
            text,
            "the damping factors scatter {:.1} times more about equation 3 than their errors: the \
             material is not exactly Rayleigh, and the intervals are widened for it",
            found.rayleigh.reduced_chi_square.sqrt()
        );
    }
    text.push('\n');
    text.push_str(&damping_block(report));
    text
}
