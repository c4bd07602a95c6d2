//! `report.html` of a transient: figures, the end of the run, growth.

use super::print::ending;
use super::summary::TransientSummary;
use super::{RunFigures, draw_run};
use crate::results::drawing::{DrawingError, DrawingOptions, write_report};
use crate::results::folder::OutputFolder;
use crate::results::quantity::{fixed, quantity};
use crate::results::report::{Report, ReportSection, ReportTable};
use crate::transient::EndState;

/// Draws every figure that the run has data for into `figures/`, each as SVG and PNG, and writes
/// `report.html`.
///
/// # Errors
/// Those of the folder; a figure that cannot be drawn although there is something to draw.
pub fn draw(
    folder: &OutputFolder,
    run: &RunFigures<'_>,
    summary: &TransientSummary,
    options: &DrawingOptions,
) -> Result<(), DrawingError> {
    let state = run.analysis.settling.state;
    let mut report = html_report(summary, state, &run.growth_rates, run.growing_mode());
    report.sections[1].figures = draw_run(run, options)?;
    write_report(folder, &report, options)
}

/// The report without figures, from the summary of the run; `predicted` are harmonics and growth rates
/// (1/s) of the eigenvalue analysis, `growing_mode` frequency (Hz) and rate of the mode of a body without symmetry that grows.
pub fn html_report(
    summary: &TransientSummary,
    state: EndState,
    predicted: &[(usize, f64)],
    growing_mode: Option<(f64, f64)>,
) -> Report {
    let heading = match state {
        EndState::LimitCycle => "Limit cycle",
        EndState::TwoFrequency(_) => "Vibration of two frequencies",
        EndState::SteadySliding => "Steady sliding",
        EndState::AtRest | EndState::Separated => "Rest",
        EndState::Unsettled => "End of the run, not settled",
    };
    let end = format!(
        "{}. The numbers are means over the last fifth of the run.",
        capitalized(&ending(summary, state))
    );
    let mut paragraphs = vec![end];
    paragraphs.extend(summary.extent.note().map(|note| format!("{note}.")));
    paragraphs.extend(summary.notes.iter().map(|note| capitalized(note)));
    Report {
        title: summary.title.clone(),
        sections: vec![
            ReportSection::results(paragraphs, results(summary)),
            ReportSection::new("Course of the run").with_paragraphs([course(summary)]),
            ReportSection::new(heading).with_tables([
                motion_table(summary),
                growth_table(summary, predicted, growing_mode),
            ]),
        ],
        manifest: summary.manifest.clone(),
    }
}

fn capitalized(sentence: &str) -> String {
    let mut letters = sentence.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => String::new(),
    }
}

fn course(summary: &TransientSummary) -> String {
    let end = if summary.finished { "complete" } else { "stopped before its end" };
    let first = match summary.first_nonlinearity_s {
        Some(time) => {
            format!("the first contact node sticks or opens at {} ms", fixed(1e3 * time, 3))
        }
        None => "there is no linear stage that ends in stick or separation".into(),
    };
    format!(
        "{} ms in {} steps of {} µs ({end}), from {}, {} operator; {first}; the energy \
         balance closes to {:.1e}.",
        fixed(1e3 * summary.end_time_s, 3),
        summary.steps,
        fixed(1e6 * summary.time_step_s, 4),
        summary.initial,
        summary.operator,
        summary.max_balance_residual,
    )
}

/// What decides, over the last fifth of the run.
fn results(summary: &TransientSummary) -> Vec<(String, String)> {
    let (status, power) = (&summary.status, &summary.power_w);
    let entry = |key: &str, value: Option<f64>| {
        let quantity = quantity(key);
        Some((quantity.caption.to_owned(), quantity.text(value?)))
    };
    let watts = |key: &str, value: Option<f64>| {
        let quantity = quantity(key);
        let text = format!("{} {}", quantity.number(value?), summary.extent.unit("W"));
        Some((quantity.caption.to_owned(), text))
    };
    let share = |name: &str, value: Option<f64>| {
        Some((name.to_owned(), format!("{} %", fixed(100.0 * value?, 2))))
    };
    let settled = match (summary.settled, summary.settled_from_s) {
        (true, Some(time)) => format!("from {} ms on", fixed(1e3 * time, 3)),
        (true, None) => "yes".to_owned(),
        (false, _) => "no".to_owned(),
    };
    let harmonic = summary.main_harmonic.map(|n| n as f64);
    let second = summary.frequencies_hz.map(|frequencies| frequencies[1]);
    let rows = [
        entry("main_frequency_hz", summary.main_frequency_hz),
        entry("main_harmonic", harmonic),
        entry("second_frequency_hz", second),
        entry("envelope_ratio", summary.envelope_ratio),
        Some(("settled".to_owned(), settled)),
        share("contact nodes that stick", status.stick),
        share("contact nodes that slip", status.slip),
        share("contact nodes that are open", status.open),
        watts("power_w.external", power.external),
        watts("power_w.stick", power.stick),
        watts("power_w.slide", power.slide),
        watts("power_w.contact_dissipated", power.contact_dissipated),
        watts("power_w.material_damping", power.material_damping),
        watts("power_w.normal_contact", power.normal_contact),
    ];
    rows.into_iter().flatten().collect()
}

/// Accelerations of the probes over the last fifth of the run.
fn motion_table(summary: &TransientSummary) -> ReportTable {
    let rows = summary.probes.iter().flat_map(|(node, motion)| {
        let directions = [
            ("radial", Some(&motion.radial)),
            ("tangential", Some(&motion.tangential)),
            ("axial", motion.axial.as_ref()),
        ];
        let known = directions.into_iter().filter_map(|(name, motion)| Some((name, motion?)));
        known.map(|(direction, motion)| {
            vec![
                node.clone(),
                direction.to_owned(),
                fixed(motion.acceleration_rms_m_per_s2, 0),
                fixed(motion.acceleration_peak_m_per_s2, 0),
            ]
        })
    });
    ReportTable::new(
        "Accelerations over the last fifth of the run",
        ["node", "direction", "root mean square (m/s²)", "peak (m/s²)"],
        rows,
    )
}

fn growth_table(
    summary: &TransientSummary,
    predicted: &[(usize, f64)],
    growing_mode: Option<(f64, f64)>,
) -> ReportTable {
    let own = |harmonic: usize| {
        let found = predicted.iter().find(|(n, _)| *n == harmonic);
        found.map_or(String::new(), |(_, rate)| fixed(*rate, 2))
    };
    let fitted = summary.growth.iter().map(|growth| {
        vec![
            growth.harmonic.map_or("strongest".into(), |n| n.to_string()),
            fixed(growth.rate_per_s, 2),
            format!("{} to {}", fixed(growth.rate_low_per_s, 2), fixed(growth.rate_high_per_s, 2)),
            match growth.harmonic {
                Some(harmonic) => own(harmonic),
                None => growing_mode.map_or(String::new(), |(_, rate)| fixed(rate, 2)),
            },
            fixed(growth.frequency_hz, 1),
        ]
    });
    let others = summary.no_growth.iter().map(|(vibration, reason)| {
        let harmonic = vibration.strip_prefix('n').unwrap_or(vibration);
        let own = harmonic.parse().map_or(String::new(), own);
        vec![harmonic.to_owned(), "none".into(), reason.clone(), own, String::new()]
    });
    ReportTable::new(
        "Growth in the linear stage",
        [
            "harmonic n",
            "rate (1/s)",
            "95 % interval",
            "rate of the eigenvalue analysis (1/s)",
            "frequency (Hz)",
        ],
        fitted.chain(others),
    )
}
