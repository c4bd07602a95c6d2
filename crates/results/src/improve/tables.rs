//! Tables and sentences of `improve`.

use super::{Candidate, ImproveSummary, PREDICTED, STATES, critical};
use frictionsim_output::{Document, Format, Section, Table, columns, significant};

columns! {
    /// A modification and its place.
    pub(crate) CANDIDATES: own as Candidate;
    rank: "place in the list, from 1" = own.rank, Always "rank" Count;
    kind: "mass, spring, dashpot, removal, damping or offset"
        = own.kind.clone(), Always "kind" Plain;
    node: "number of its node" = own.node;
    x_m: "where it is; the way of the hole for an offset" = own.position_m[0];
    y_m: "where it is; the way of the hole for an offset" = own.position_m[1];
    z_m: "where it is; the way of the hole for an offset" = own.position_m[2];
}

columns! {
    /// The direction of a spring or dashpot, and what a modification weighs.
    pub(crate) EFFECTS: own as Candidate;
    direction_x: "direction of a spring or dashpot" = own.direction.map(|d| d[0]);
    direction_y: "direction of a spring or dashpot" = own.direction.map(|d| d[1]);
    direction_z: "direction of a spring or dashpot" = own.direction.map(|d| d[2]);
    added_mass_kg: "mass that it adds; negative where material is taken away"
        = own.added_mass_kg, Always "mass" Significant(4);
    first_order_growth_rate_per_s: "largest growth rate of the targets to first order"
        = own.first_order_growth_rate_per_s, IfAny "growth, first order" Significant(4);
}

columns! {
    /// What a run comes to, and how to make it.
    pub(crate) VERDICTS: own as Candidate;
    verdict: "what the run with it comes to" = own.verdict.clone(), Always "verdict" Plain;
    keys: "keys of the case that make it" = own.keys.join("; ");
}

/// Tables and sentences.
pub fn document(summary: &ImproveSummary) -> Document {
    Document::new("Modifications")
        .section(Section::new("Results").facts(facts(summary)).text([summary.answer()]))
        .section(Section::new("Candidates").tables([candidates(summary)]))
        .notes(&summary.notes)
        .section(Section::new("Where it helps").figures([""]))
}

fn candidates(summary: &ImproveSummary) -> Table {
    let all = || &summary.candidates;
    Table::new(
        "candidates.csv",
        "Modifications, the best first; no critical friction: not run again, or none up to the case's",
    )
    .columns(CANDIDATES, all())
    .column("", Some(("where", Format::Plain)), all().iter().map(Candidate::place))
    .columns(EFFECTS, all())
    .group("predicted_", "predicted ", PREDICTED, all().iter().map(|own| Some(own.predicted)))
    .group("confirmed_", "confirmed ", STATES, all().iter().map(|own| own.confirmed))
    .columns(VERDICTS, all())
}

/// Name and value of what decides.
fn facts(summary: &ImproveSummary) -> Vec<(String, String)> {
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
        let name =
            format!("growth of mode {}, {} Hz", mode.mode, significant(mode.frequency_hz, 6));
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
