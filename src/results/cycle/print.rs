//! Printed result of a search for limit cycles.

use super::confirmation::confirmation_text;
use super::stability::print_stability;
use super::summary::family;
use super::two_waves::print_two_waves;
use super::{CycleReport, CycleResult};
use crate::cycle::periodic::velocity_level;
use crate::results::cycle_table::{branch_sentence, printed_cycle, printed_heading};
use std::fmt::Write as _;

/// The report as text.
pub fn print(report: &CycleReport<'_>) -> String {
    let mut out = String::new();
    if !report.title.is_empty() {
        let _ = writeln!(out, "{}", report.title);
    }
    if let Some(text) = report.stable_sliding() {
        let _ = writeln!(out, "{text}");
        return out;
    }
    let mut phases: Vec<String> =
        report.results.iter().map(|result| result.phases.to_string()).collect();
    phases.dedup();
    let _ = writeln!(out, "limit cycles as rotating waves, {} phases\n", phases.join(", "));
    let _ = writeln!(out, "{:>3} {:>10} {}", "n", "friction >", printed_heading());
    for result in &report.results {
        result_line(&mut out, report, result);
    }
    for result in &report.results {
        if let Some(text) = confirmation_text(report, result) {
            let _ = writeln!(out, "{text}");
        }
        if let Some(velocity) = result.velocity {
            let _ = writeln!(
                out,
                "{}: velocity level {:.1} dB over 5e-8 m/s, root mean square over time and mass",
                result.family,
                velocity_level(velocity),
            );
        }
        print_stability(&mut out, result);
        // As the page says it.
        let told = serde_json::to_value(family(report, result)).ok();
        if let Some(text) = told.as_ref().and_then(branch_sentence) {
            let _ = writeln!(out, "{text}");
        }
    }
    for result in &report.two_waves {
        print_two_waves(&mut out, result);
    }
    if let Some(note) = report.extent.note() {
        let _ = writeln!(out, "{note}");
    }
    let _ = writeln!(out, "{:.3} s", report.wall_s);
    out
}

fn result_line(out: &mut String, report: &CycleReport<'_>, result: &CycleResult) {
    let critical = match result.birth() {
        Some(onset) => format!("{:.5}", onset.friction_coefficient),
        None => "-".to_owned(),
    };
    let _ = write!(out, "{:>3} {critical:>10} ", result.family.harmonic);
    let _ = match &result.cycle {
        Ok(cycle) => {
            let powers = cycle.powers.scaled(report.thickness);
            let powers = [powers.external, powers.stick, powers.slide, powers.contact_dissipated];
            let frequency = cycle.frequency_hz();
            let line = printed_cycle(frequency, cycle.fractions, powers, report.extent);
            writeln!(out, "{line}")
        }
        Err(absence) => writeln!(out, "{}", absence.reason),
    };
}
