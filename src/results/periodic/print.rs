//! Printed result of a search for the limit cycles of a body without symmetry.

use super::{FoundCycle, PeriodicReport, PeriodicResult};
use crate::cycle::Verdict;
use crate::cycle::periodic::{FloquetMultipliers, PeriodicBranch};
use crate::results::quantity::significant;
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
    let _ = writeln!(
        out,
        "limit cycles as periodic motions of the whole mesh, from {} of {} modes at friction {}\n",
        report.results.len(),
        report.modes,
        report.friction_coefficient,
    );
    let _ = writeln!(
        out,
        "{:>4} {:>9} {:>12} {:>7} {:>7} {:>7} {:>12} {:>7} {:>7} {:>10}",
        "mode",
        "growth",
        "frequency",
        "stick",
        "slip",
        "open",
        "external",
        "stick",
        "slide",
        "dissipated"
    );
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
    let [stick, slip, open] = motion.fractions;
    let share = |power: f64| power / powers.external;
    let _ = writeln!(
        out,
        "{:>9.2} Hz {stick:>7.3} {slip:>7.3} {open:>7.3} {:>10.2} {} {:>7.3} {:>7.3} {:>10.3}",
        motion.frequency_hz,
        powers.external,
        report.extent.unit("W"),
        share(powers.stick),
        share(powers.slide),
        share(powers.contact_dissipated),
    );
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
         motion of the contact, whose amplitude is {:.3e} m",
        motion.residual,
        motion.periods,
        motion.steps,
        motion.powers.balance_residual(),
        found.harmonic_count,
        remainder.map_or(1.0, |last| last.remainder),
        motion.amplitude,
    );
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
    if let Some(branch) = &found.branch {
        let _ = writeln!(out, "{mode}: {}", branch_text(branch));
    }
}

/// Where a branch ends and changes its stability, in words.
fn branch_text(branch: &PeriodicBranch) -> String {
    let parameter = branch.parameter;
    let value = |value: f64| significant(parameter.in_key_units(value), 5);
    let Some((first, last)) = branch.motions.first().zip(branch.motions.last()) else {
        return format!(
            "no cycle at the values of {} that were asked for ({})",
            parameter.key(),
            branch.ends[1].describe()
        );
    };
    let changes: Vec<String> = branch.stability_changes().into_iter().map(value).collect();
    let changes = match changes.is_empty() {
        true => String::new(),
        false => format!(", stability changes at {}", changes.join(", ")),
    };
    format!(
        "{} cycles over {} from {} ({}) to {} ({}){changes}",
        branch.motions.len(),
        parameter.key(),
        value(first.value),
        branch.ends[0].describe(),
        value(last.value),
        branch.ends[1].describe(),
    )
}

/// Whether small perturbations grow, in words.
fn stability_text(found: &FloquetMultipliers) -> String {
    let verdict = match found.verdict() {
        Verdict::Unstable => "UNSTABLE",
        verdict => verdict.word(),
    };
    match found.leading() {
        Some(leading) => format!(
            "{verdict}; the leading perturbation, {:.0} Hz from a harmonic, {} at {:.0} +- {:.0} 1/s",
            leading.beat_hz,
            if leading.growth_rate > 0.0 {
                "grows"
            } else {
                "decays"
            },
            leading.growth_rate.abs(),
            leading.uncertainty,
        ),
        None => "stable; every perturbation decays fast".to_owned(),
    }
}

/// Whether a transient is expected to leave the cycle.
fn leaves(found: &FoundCycle) -> bool {
    let known = found
        .stability
        .as_ref()
        .and_then(|found| found.as_ref().ok());
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

/// Why a result should not be trusted, if so.
pub fn doubt(report: &PeriodicReport<'_>, result: &PeriodicResult) -> Option<String> {
    let found = result.own()?;
    let run = found.confirmation.as_ref()?;
    let is_good = run.agrees(&found.motion) || leaves(found);
    let text = confirmation_text(report, result)?;
    (!is_good).then(|| {
        format!(
            "{text}; trust the transient, or give it more periods (cycle.confirmation_periods): a slow perturbation may take them"
        )
    })
}
