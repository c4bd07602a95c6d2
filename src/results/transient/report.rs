//! `report.html` of a transient: figures, the end of the run, growth.

use super::print::ending;
use super::summary::TransientSummary;
use super::{RunFigures, draw_run};
use crate::results::drawing::{DrawingError, DrawingOptions, write_report};
use crate::results::folder::OutputFolder;
use crate::results::quantity::fixed;
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
    let mut report = html_report(summary, state, run.growth_rates.as_slice());
    report.sections[0].figures = draw_run(run, options)?;
    write_report(folder, &report, options)
}

/// The report without figures, from the summary of the run; `predicted` are harmonics and growth rates
/// (1/s) of the eigenvalue analysis.
pub fn html_report(
    summary: &TransientSummary,
    state: EndState,
    predicted: &[(usize, f64)],
) -> Report {
    let heading = match state {
        EndState::LimitCycle => "Limit cycle",
        EndState::SteadySliding => "Steady sliding",
        EndState::AtRest | EndState::Separated => "Rest",
        EndState::Unsettled => "End of the run, not settled",
    };
    let end = format!(
        "{}. The numbers are means over the last fifth of the run.",
        capitalized(&ending(summary, state))
    );
    Report {
        title: summary.title.clone(),
        sections: vec![
            ReportSection {
                heading: "Course of the run".into(),
                paragraphs: vec![course(summary)],
                tables: Vec::new(),
                figures: Vec::new(),
            },
            ReportSection {
                heading: heading.into(),
                paragraphs: vec![end],
                tables: vec![
                    end_table(summary, heading),
                    growth_table(summary, predicted),
                ],
                figures: Vec::new(),
            },
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
    let end = if summary.finished {
        "complete"
    } else {
        "stopped before its end"
    };
    let first = match summary.first_nonlinearity_s {
        Some(time) => format!(
            "the first contact node sticks or opens at {} ms",
            fixed(1e3 * time, 3)
        ),
        None => "there is no linear stage that ends in stick or separation".into(),
    };
    format!(
        "{} ms in {} steps of {} µs ({end}), from {}, {} operator, {} s; {first}; the energy \
         balance closes to {:.1e}.",
        fixed(1e3 * summary.end_time_s, 3),
        summary.steps,
        fixed(1e6 * summary.time_step_s, 4),
        summary.initial,
        summary.operator,
        fixed(summary.wall_s, 1),
        summary.max_balance_residual,
    )
}

fn end_table(summary: &TransientSummary, caption: &str) -> ReportTable {
    let (status, power) = (&summary.status, &summary.power_w);
    let mut rows = Vec::new();
    let mut add = |name: &str, value: Option<f64>, decimals: usize| {
        if let Some(value) = value {
            rows.push(vec![name.to_owned(), fixed(value, decimals)]);
        }
    };
    add("main frequency (Hz)", summary.main_frequency_hz, 1);
    add("its harmonic n", summary.main_harmonic.map(|n| n as f64), 0);
    add(
        "contact nodes that stick (%)",
        status.stick.map(|share| 100.0 * share),
        2,
    );
    add(
        "contact nodes that slip (%)",
        status.slip.map(|share| 100.0 * share),
        2,
    );
    add(
        "contact nodes that are open (%)",
        status.open.map(|share| 100.0 * share),
        2,
    );
    add("power of the rotor (W)", power.external, 2);
    add("  of it while sticking (W)", power.stick, 2);
    add("  of it while sliding (W)", power.slide, 2);
    add(
        "  of it dissipated in the contact (W)",
        power.contact_dissipated,
        2,
    );
    add("material damping (W)", power.material_damping, 2);
    for (node, motion) in &summary.probes {
        for (direction, motion) in [
            ("radial", &motion.radial),
            ("tangential", &motion.tangential),
        ] {
            let name = |what: &str| format!("node {node}, {direction} {what} (m/s²)");
            let (rms, peak) = (
                motion.acceleration_rms_m_per_s2,
                motion.acceleration_peak_m_per_s2,
            );
            add(&name("acceleration, root mean square"), Some(rms), 0);
            add(&name("acceleration, peak"), Some(peak), 0);
        }
    }
    ReportTable {
        caption: caption.into(),
        columns: ["quantity", "value"].map(String::from).to_vec(),
        rows,
    }
}

fn growth_table(summary: &TransientSummary, predicted: &[(usize, f64)]) -> ReportTable {
    let own = |harmonic: usize| {
        let found = predicted.iter().find(|(n, _)| *n == harmonic);
        found.map_or(String::new(), |(_, rate)| fixed(*rate, 2))
    };
    let fitted = summary.growth.iter().map(|growth| {
        vec![
            growth.harmonic.to_string(),
            fixed(growth.rate_per_s, 2),
            format!(
                "{} to {}",
                fixed(growth.rate_low_per_s, 2),
                fixed(growth.rate_high_per_s, 2)
            ),
            own(growth.harmonic),
            fixed(growth.frequency_hz, 1),
        ]
    });
    let others = summary.no_growth.iter().map(|(harmonic, reason)| {
        let harmonic = &harmonic[1..];
        let own = harmonic.parse().map_or(String::new(), own);
        vec![
            harmonic.to_owned(),
            "none".into(),
            reason.clone(),
            own,
            String::new(),
        ]
    });
    ReportTable {
        caption: "Growth of the perturbed harmonics in the linear stage".into(),
        columns: [
            "harmonic n",
            "rate (1/s)",
            "95 % interval",
            "rate of the eigenvalue analysis (1/s)",
            "frequency (Hz)",
        ]
        .map(String::from)
        .to_vec(),
        rows: fitted.chain(others).collect(),
    }
}
