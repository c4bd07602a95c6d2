//! Stability of limit cycles: tables, summary and words.

use super::cycle::CycleResult;
use super::table::{Table, format_number};
use crate::cycle::{CycleBranch, CycleStability, LimitCycle};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::io::{self, Write};

/// What is known of the stability of a cycle.
pub type Verdict = Option<Result<CycleStability, String>>;

/// Its analysis, where there is one.
pub fn known(verdict: &Verdict) -> Option<&CycleStability> {
    verdict.as_ref().and_then(|verdict| verdict.as_ref().ok())
}

/// Writes the leading exponents of each class, one row each: for the cycle at the case's own operating point, then along the
/// branch.
///
/// # Errors
/// Those of the writer.
pub fn write_stability(out: &mut dyn Write, result: &CycleResult) -> io::Result<()> {
    let key = result.branch.as_ref().map(|branch| branch.parameter.key());
    let columns = [
        key.unwrap_or("point"),
        "class",
        "growth_rate_per_s",
        "wave_frequency_rad_per_s",
        "harmonic",
        "frequency_hz",
    ];
    let mut table = Table::new(out, &columns)?;
    let mut rows = |at: f64, verdict: &Verdict| -> io::Result<()> {
        for class in known(verdict).into_iter().flat_map(|found| &found.classes) {
            for found in &class.exponents {
                table.row([
                    format_number(at),
                    class.class.to_string(),
                    format_number(found.exponent.re),
                    format_number(found.exponent.im),
                    found.harmonic.to_string(),
                    format_number(found.frequency_hz),
                ])?;
            }
        }
        Ok(())
    };
    match (&result.branch, &result.cycle) {
        (Some(branch), Ok(own)) => {
            rows(value(branch, own), &result.stability)?;
            for (cycle, verdict) in branch.cycles.iter().zip(&result.branch_stability) {
                rows(value(branch, cycle), verdict)?;
            }
        }
        _ => rows(0.0, &result.stability)?,
    }
    table.finish()
}

fn value(branch: &CycleBranch, cycle: &LimitCycle) -> f64 {
    let value = branch.parameter.of(&cycle.state.point);
    branch.parameter.in_key_units(value)
}

/// The summary's object.
pub fn stability_object(verdict: &Verdict) -> Value {
    match verdict {
        None => Value::Null,
        Some(Err(error)) => json!({ "error": error }),
        Some(Ok(stability)) => {
            let leading = stability.leading().map(|leading| {
                json!({
                    "growth_rate_per_s": leading.exponent.re,
                    "wave_frequency_rad_per_s": leading.exponent.im,
                    "harmonic": leading.harmonic,
                    "frequency_hz": leading.frequency_hz,
                })
            });
            json!({
                "is_stable": stability.is_stable(),
                "growing_harmonics": stability.growing_harmonics(),
                "leading": leading,
            })
        }
    }
}

/// One line on the cycle at the case's own operating point, and one for each change along the branch.
pub fn print_stability(out: &mut String, result: &CycleResult) {
    let family = result.family;
    match &result.stability {
        None => {}
        Some(Err(error)) => {
            let _ = writeln!(out, "{family}: {error}");
        }
        Some(Ok(stability)) => {
            let _ = match stability.leading() {
                Some(leading) if stability.is_stable() => writeln!(
                    out,
                    "{family}: stable; the slowest perturbation, {} at {:.0} Hz, decays at {:.0} 1/s",
                    diameters(leading.harmonic),
                    leading.frequency_hz,
                    -leading.exponent.re,
                ),
                Some(leading) => writeln!(
                    out,
                    "{family}: UNSTABLE to {} at {:.0} Hz, growing at {:.0} 1/s",
                    diameters(leading.harmonic),
                    leading.frequency_hz,
                    leading.exponent.re,
                ),
                None => writeln!(out, "{family}: stable; every perturbation decays fast"),
            };
        }
    }
    let key = result
        .branch
        .as_ref()
        .map_or("", |branch| branch.parameter.key());
    for change in &result.stability_changes {
        let value = result.branch.as_ref().map_or(f64::NAN, |branch| {
            branch.parameter.in_key_units(change.value)
        });
        let _ = writeln!(
            out,
            "{family}: stability changes at {key} = {value:.1} ({} at {:.0} Hz)",
            diameters(change.harmonic),
            change.frequency_hz,
        );
    }
}

fn diameters(harmonic: usize) -> String {
    match harmonic {
        1 => "1 nodal diameter".to_owned(),
        n => format!("{n} nodal diameters"),
    }
}
