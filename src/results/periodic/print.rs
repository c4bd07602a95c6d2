//! Printed result of a search for the limit cycles of a body without symmetry.

use super::{FoundCycle, PeriodicReport, PeriodicResult, summary_of};
use crate::cycle::Verdict;
use crate::cycle::periodic::{ASTRAY, FloquetMultiplier, FloquetMultipliers, REMAINDER};
use crate::results::cycle_table::{branch_sentence, printed_cycle, printed_heading};
use std::fmt::Write as _;

/// The report as text.
pub fn print(report: &PeriodicReport<'_>) -> String {
    let mut out = String::new();
    if !report.title.is_empty() {
        let _ = writeln!(out, "{}", report.title);
    }
    if let Some(text) = report.stable_sliding() {
        let _ = writeln!(out, "{text}");
        return out;
    }
    let start = report.results.iter().find_map(|result| result.start);
    let start = start.map_or_else(
        || format!("friction {}", report.friction_coefficient),
        |(key, value)| format!("{key} = {value}, since none grows at the case's own"),
    );
    let _ = writeln!(
        out,
        "limit cycles as periodic motions of the whole mesh, from {} of {} modes that grow at {start}\n",
        report.results.len(),
        report.modes,
    );
    if let Some(critical) = report.critical {
        let _ = writeln!(out, "steady sliding loses its stability at {critical}\n");
    }
    let _ = writeln!(out, "{:>4} {:>9} {}", "mode", "growth", printed_heading());
    for result in &report.results {
        result_line(&mut out, report, result);
    }
    for result in &report.results {
        if let Some(found) = result.own() {
            found_lines(&mut out, report, result, found);
        }
    }
    if let Some(note) = report.extent.note() {
        let _ = writeln!(out, "{note}");
    }
    let _ = writeln!(out, "{:.3} s", report.wall_s);
    out
}

fn result_line(out: &mut String, report: &PeriodicReport<'_>, result: &PeriodicResult) {
    let mode = &result.mode;
    let _ = write!(out, "{:>4} {:>9.1} ", mode.number, mode.growth_rate);
    let found = match (&result.outcome, result.same_as) {
        (Err(reason), _) => {
            let _ = writeln!(out, "{reason}");
            return;
        }
        (Ok(_), Some(other)) => {
            let _ = writeln!(out, "the cycle of mode {other}");
            return;
        }
        (Ok(found), None) => found,
    };
    let motion = &found.motion;
    let powers = motion.powers.scaled(report.thickness).contact;
    let powers = [powers.external, powers.stick, powers.slide, powers.contact_dissipated];
    let (frequency, fractions) = (motion.frequency_hz, motion.fractions);
    let line = printed_cycle(frequency, fractions, powers, report.extent);
    let _ = writeln!(out, "{line}");
}

fn found_lines(
    out: &mut String,
    report: &PeriodicReport<'_>,
    result: &PeriodicResult,
    found: &FoundCycle,
) {
    let (mode, motion) = (&result.mode, &found.motion);
    let remainder = motion.harmonics[..found.harmonic_count].last();
    let _ = writeln!(
        out,
        "{mode}: repeats itself to {:.1e} after {} periods of {} steps, energy balance {:.1e}; {} harmonics leave {:.1e} of the \
         motion of the contact, whose amplitude is {:.3e} m; velocity level {:.1} dB over 5e-8 m/s, root mean square over time and \
         mass",
        motion.residual,
        motion.periods,
        motion.steps,
        motion.powers.balance_residual(),
        found.harmonic_count,
        remainder.map_or(1.0, |last| last.remainder),
        motion.amplitude,
        motion.velocity_level(),
    );
    let off = motion.frequency_hz / mode.frequency_hz - 1.0;
    if off.abs() > ASTRAY {
        let side = if off > 0.0 { "above" } else { "below" };
        let _ = writeln!(
            out,
            "{mode}: the frequency of this cycle is {:.1} % {side} that of the mode: what grows from it may end in the motion of another",
            100.0 * off.abs(),
        );
    }
    if let Some(sound) = &found.sound {
        let _ = writeln!(
            out,
            "{mode}: sound power {:.1} dB over 1e-12 W, an estimate: Rayleigh integral over {:.4} m2 of flat faces, each in an infinite \
             rigid baffle, harmonics up to 20 kHz",
            sound.level(),
            sound.area,
        );
    }
    if let Some(text) = confirmation_text(report, result) {
        let _ = writeln!(out, "{text}");
    }
    match &found.stability {
        None => {}
        Some(Err(error)) => {
            let _ = writeln!(out, "{mode}: {error}");
        }
        Some(Ok(multipliers)) => {
            let _ = writeln!(out, "{mode}: {}", stability_text(multipliers));
        }
    }
    // As the page says it.
    let told = serde_json::to_value(summary_of(report, result)).ok();
    if let Some(text) = told.as_ref().and_then(branch_sentence) {
        let _ = writeln!(out, "{text}");
    }
}

/// Whether small perturbations grow, in words.
fn stability_text(found: &FloquetMultipliers) -> String {
    let verdict = match found.verdict() {
        Verdict::Unstable => "UNSTABLE",
        verdict => verdict.word(),
    };
    let leads_to = |leading: &FloquetMultiplier| match leading.verdict() {
        Verdict::Unstable => format!(" ({})", leading.kind()),
        _ => String::new(),
    };
    match found.leading() {
        Some(leading) => format!(
            "{verdict}; the leading perturbation, {:.0} Hz from a harmonic, {} at {:.0} +- {:.0} 1/s{}",
            leading.beat_hz,
            if leading.growth_rate > 0.0 { "grows" } else { "decays" },
            leading.growth_rate.abs(),
            leading.uncertainty,
            leads_to(leading),
        ),
        None => "stable; every perturbation decays fast".to_owned(),
    }
}

/// Whether a transient is expected to leave the cycle.
fn leaves(found: &FoundCycle) -> bool {
    let known = found.stability.as_ref().and_then(|found| found.as_ref().ok());
    known.is_some_and(|found| found.verdict() == Verdict::Unstable)
}

/// What a transient says of the cycle, in words; nothing where none was asked for.
fn confirmation_text(report: &PeriodicReport<'_>, result: &PeriodicResult) -> Option<String> {
    let found = result.own()?;
    let run = found.confirmation.as_ref()?;
    let [stick, slip, open] = run.status;
    let verdict = match (run.agrees(&found.motion), leaves(found)) {
        (true, false) => "a transient stays on it".to_owned(),
        (true, true) => format!(
            "a transient is still on it, in a time in which the leading perturbation makes {:.1} e-folds: too few to tell",
            run.e_folds
        ),
        (false, true) => "a transient leaves it, as its leading perturbation says".to_owned(),
        (false, false) => "NOT CONFIRMED: a transient does not stay on it".to_owned(),
    };
    Some(format!(
        "{}: {verdict}: after {} periods {:.2} Hz, stick {stick:.3}, slip {slip:.3}, open {open:.3}, {:.2} {}",
        result.mode,
        run.periods,
        run.main_frequency_hz,
        run.external_power * report.thickness,
        report.extent.unit("W"),
    ))
}

/// That the harmonics asked for do not tell the motion, if so, and how many would.
fn coarse_harmonics(result: &PeriodicResult, found: &FoundCycle) -> Option<String> {
    let motion = &found.motion;
    let left = motion.harmonics[..found.harmonic_count].last()?.remainder;
    let enough = motion.harmonics_within(REMAINDER);
    (found.harmonic_count < enough).then(|| {
        format!(
            "{}: {} harmonics leave {left:.1e} of the motion of the contact: {enough} leave less than a thousandth (raise \
             cycle.harmonic_count, or leave it out)",
            result.mode, found.harmonic_count,
        )
    })
}

/// Why a result should not be trusted, if so.
pub fn doubt(report: &PeriodicReport<'_>, result: &PeriodicResult) -> Option<String> {
    let found = result.own()?;
    if let Some(text) = coarse_harmonics(result, found) {
        return Some(text);
    }
    let run = found.confirmation.as_ref()?;
    let is_good = run.agrees(&found.motion) || leaves(found);
    let text = confirmation_text(report, result)?;
    (!is_good).then(|| {
        format!(
            "{text}; trust the transient, or give it more periods (cycle.confirmation_periods): a slow perturbation may take them"
        )
    })
}
