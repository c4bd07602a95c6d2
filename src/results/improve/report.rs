//! `report.html` of `improve`.

use super::front::{FRONT, table_of_front};
use super::{Candidate, ImproveSummary, State, critical};
use crate::results::Manifest;
use crate::results::quantity::significant;
use crate::results::report::{NamedFigure, Report, ReportSection, ReportTable};

/// The report with its figures.
pub(super) fn report(
    summary: &ImproveSummary,
    figures: Vec<NamedFigure>,
    manifest: &Manifest,
) -> Report {
    let (of_front, figures) = figures.into_iter().partition(|figure| figure.name == FRONT);
    let paragraphs = vec![summary.answer()].into_iter().chain(summary.notes.iter().cloned());
    Report {
        title: summary.title.clone(),
        sections: [
            ReportSection::results(paragraphs.collect(), numbers(summary)),
            ReportSection::new("Candidates").with_tables([table(summary)]),
            front_section(summary, of_front),
            ReportSection::new("Where it helps").with_figures(figures),
        ]
        .into_iter()
        .filter(|section| !section.heading.is_empty())
        .collect(),
        manifest: manifest.clone(),
    }
}

/// Mass against critical friction, where it was looked for.
fn front_section(summary: &ImproveSummary, figures: Vec<NamedFigure>) -> ReportSection {
    if summary.front.is_empty() {
        return ReportSection::default();
    }
    ReportSection::new("Mass against critical friction")
        .with_tables([table_of_front(summary)])
        .with_figures(figures)
}

/// Name and value of what decides.
fn numbers(summary: &ImproveSummary) -> Vec<(String, String)> {
    let friction = summary.friction_coefficient;
    let sizes = &summary.sizes;
    let text = |name: &str, value: f64, unit: &str| {
        (name.to_owned(), format!("{} {unit}", significant(value, 4)))
    };
    let onset = critical(summary.base.critical_friction, friction);
    let mut rows = vec![
        ("friction coefficient".to_owned(), friction.to_string()),
        ("critical friction as it is".to_owned(), onset),
    ];
    rows.extend(summary.modes.iter().map(|mode| {
        let name = format!("mode {}, {} Hz", mode.mode, significant(mode.frequency_hz, 6));
        text(&name, mode.growth_rate_per_s, "1/s")
    }));
    let unit = |unit: &str| summary.extent.unit(unit);
    rows.extend([
        text("added mass", sizes.mass_kg, &unit("kg")),
        text("spring", sizes.stiffness_n_per_m, &unit("N/m")),
        text("dashpot", sizes.damping_n_s_per_m, &unit("N s/m")),
        text("patch radius", sizes.patch_radius_m, "m"),
        text("patch damping", sizes.patch_damping_s, "s"),
        text("farthest way of the hole", sizes.offset_m, "m"),
    ]);
    rows
}

fn table(summary: &ImproveSummary) -> ReportTable {
    let friction = summary.friction_coefficient;
    let growth = |value: Option<f64>| value.map_or(String::new(), |v| significant(v, 4));
    let both = |state: Option<&State>| match state {
        Some(state) => {
            [growth(state.growth_rate_per_s), critical(state.critical_friction, friction)]
        }
        None => [String::new(), String::new()],
    };
    let row = |own: &Candidate| {
        let [predicted, onset] = both(Some(&own.predicted));
        let [confirmed, confirmed_onset] = both(own.confirmed.as_ref());
        vec![
            own.rank.to_string(),
            own.kind.clone(),
            own.place(),
            growth(own.first_order_growth_rate_per_s),
            predicted,
            confirmed,
            onset,
            confirmed_onset,
            own.verdict.clone(),
            own.keys.join("; "),
        ]
    };
    ReportTable::new(
        "Modifications, the best first: growth rates (1/s) and critical friction, predicted and run again",
        [
            "rank",
            "kind",
            "where",
            "growth, first order",
            "growth, predicted",
            "growth, run again",
            "critical friction, predicted",
            "critical friction, run again",
            "verdict",
            "keys",
        ],
        summary.candidates.iter().map(row),
    )
}
