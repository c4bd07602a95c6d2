//! Mass against critical friction: `front.csv`, its figure and its table.

use super::{Candidate, ImproveSummary, State, critical};
use crate::chart::{
    Axis, ChartError, Figure, INK, Label, Line, MUTED, Marker, Panel, Points, Rule, Stroke, look,
};
use crate::results::charts::palette::{STABLE, UNSTABLE};
use crate::results::quantity::significant;
use crate::results::report::ReportTable;
use crate::results::table::{Column, write_rows};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::io::{self, Write};

/// Name of the figure.
pub(super) const FRONT: &str = "front";

/// A mass or a removal of some size.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FrontPoint {
    /// What it is, and what it does; `rank` is its place by rising mass.
    #[serde(flatten)]
    pub candidate: Candidate,
    /// Whether it was run again, holds, and no lighter one that holds gets as far.
    pub on_front: bool,
}

/// Writes one row for each point by rising mass.
///
/// # Errors
/// Those of the writer.
pub(super) fn write_front(out: &mut dyn Write, front: &[FrontPoint]) -> io::Result<()> {
    let growth = |state: Option<State>| state.and_then(|state| state.growth_rate_per_s);
    let onset = |state: Option<State>| state.and_then(|state| state.critical_friction);
    let columns: &[Column<'_, &FrontPoint>] = &[
        ("added_mass_kg", &|own| own.candidate.added_mass_kg.into()),
        ("kind", &|own| own.candidate.kind.clone().into()),
        ("node", &|own| own.candidate.node.into()),
        ("x_m", &|own| own.candidate.position_m[0].into()),
        ("y_m", &|own| own.candidate.position_m[1].into()),
        ("z_m", &|own| own.candidate.position_m[2].into()),
        ("predicted_growth_rate_per_s", &|own| growth(Some(own.candidate.predicted)).into()),
        ("predicted_critical_friction", &|own| onset(Some(own.candidate.predicted)).into()),
        ("confirmed_growth_rate_per_s", &|own| growth(own.candidate.confirmed).into()),
        ("confirmed_critical_friction", &|own| onset(own.candidate.confirmed).into()),
        ("on_front", &|own| own.on_front.into()),
        ("verdict", &|own| own.candidate.verdict.clone().into()),
        ("keys", &|own| own.candidate.keys.join("; ").into()),
    ];
    write_rows(out, columns, front)
}

/// Points that were run again, as lines of text.
pub(super) fn text(summary: &ImproveSummary) -> String {
    let friction = summary.friction_coefficient;
    if summary.front.is_empty() {
        return String::new();
    }
    let mut out = format!(
        "\nmass against critical friction, of {} masses and removals (front.csv):\n{:>10}  {:<8} {:<34} {:>10} {:>10}  verdict\n",
        summary.front.len(),
        format!("mass {}", summary.extent.unit("g")),
        "kind",
        "where",
        "predicted",
        "run again",
    );
    for own in again(summary) {
        let onset = |state: &State| critical(state.critical_friction, friction);
        let _ = writeln!(
            out,
            "{:>10}  {:<8} {:<34} {:>10} {:>10}  {}",
            significant_grams(own.candidate.added_mass_kg),
            own.candidate.kind,
            own.candidate.place(),
            onset(&own.candidate.predicted),
            own.candidate.confirmed.as_ref().map_or("-".to_owned(), onset),
            mark(own),
        );
    }
    out.push('\n');
    out
}

/// The same as a table of the report.
pub(super) fn table_of_front(summary: &ImproveSummary) -> ReportTable {
    let friction = summary.friction_coefficient;
    let onset = |state: &State| critical(state.critical_friction, friction);
    let row = |own: &FrontPoint| {
        vec![
            significant_grams(own.candidate.added_mass_kg),
            own.candidate.kind.clone(),
            own.candidate.place(),
            onset(&own.candidate.predicted),
            own.candidate.confirmed.as_ref().map_or(String::new(), onset),
            mark(own),
        ]
    };
    let mass = format!("mass ({})", summary.extent.unit("g"));
    let columns = [
        mass.as_str(),
        "kind",
        "where",
        "critical friction, predicted",
        "critical friction, run again",
        "verdict",
    ];
    ReportTable::new(
        "Masses added and taken away that were run again, the lightest first (all: front.csv)",
        columns,
        again(summary).map(row),
    )
}

/// The points that were run again.
fn again(summary: &ImproveSummary) -> impl Iterator<Item = &FrontPoint> {
    let front = summary.front.iter();
    front.filter(|own| own.candidate.verdict != "not run again")
}

fn mark(own: &FrontPoint) -> String {
    match own.on_front {
        true => format!("{}, on the front", own.candidate.verdict),
        false => own.candidate.verdict.clone(),
    }
}

fn significant_grams(mass: f64) -> String {
    significant(1e3 * mass, 4)
}

/// Critical friction over the mass that is added or taken away: every place and size that was looked at, those that were run
/// again, and the front through those that hold.
///
/// # Errors
/// [`ChartError::Empty`] where no front was looked for.
pub(super) fn front_figure(summary: &ImproveSummary) -> Result<Figure, ChartError> {
    if summary.front.is_empty() {
        return Err(ChartError::empty("mass against critical friction"));
    }
    let friction = summary.friction_coefficient;
    let onset = |state: &State| state.critical_friction.unwrap_or(friction);
    let start = onset(&summary.base);

    let steps = steps(summary, start);
    let y = Axis::new("critical friction *μ*_{c}", "–").including(start);
    let mut panel = Panel::new(
        Axis::new("mass added or taken away", &summary.extent.unit("g")).times(1e3).including(0.0),
        y,
    )
    .height(170.0)
    .layer(
        Rule::horizontal(friction)
            .stroke(Stroke::dotted(MUTED, 0.9))
            .stretching()
            .name("friction of the case: points on it are silenced"),
    )
    .layer(Rule::horizontal(start).stroke(Stroke::dashed(INK, 0.8)).name("as it is"))
    .layer(Line::through(steps).solid(STABLE, 1.4).name("front of those that hold"));
    for (index, (kind, marker)) in
        [("mass", Marker::Disc), ("removal", Marker::Square)].into_iter().enumerate()
    {
        panel = panel.layers(points(summary, kind, (marker, look(index + 4).0)));
    }
    let ends = summary.front.iter().rev().find(|own| own.on_front);
    let labels = ends.and_then(|own| {
        let place = (weight(own), onset(own.candidate.confirmed.as_ref()?));
        Some(Label::new(place, own.candidate.place()).moved(4.0, 9.0))
    });
    let caption = "Critical friction over the mass that is added or taken away at one place: predictions at the best places of each \
         size, those of them run again that nothing lighter was predicted to beat, and the front of those that hold.";
    Ok(Figure::new(FRONT, caption).panel(panel.layers(labels)))
}

/// Size of the mass of a point, kg.
fn weight(own: &FrontPoint) -> f64 {
    own.candidate.added_mass_kg.abs()
}

/// The front goes up in steps from `start` on: each point holds until a heavier one gets farther.
fn steps(summary: &ImproveSummary, start: f64) -> Vec<(f64, f64)> {
    let heaviest = summary.front.iter().map(weight).fold(0.0, f64::max);
    let (mut steps, mut height) = (vec![(0.0, start)], start);
    for own in summary.front.iter().filter(|own| own.on_front) {
        let Some(state) = &own.candidate.confirmed else {
            continue;
        };
        steps.push((weight(own), height));
        height = state.critical_friction.unwrap_or(summary.friction_coefficient);
        steps.push((weight(own), height));
    }
    steps.push((heaviest, height));
    steps
}

/// The points of one kind: predicted ones small, those run again large.
fn points(
    summary: &ImproveSummary,
    kind: &str,
    (marker, colour): (Marker, &'static str),
) -> Vec<Points> {
    let friction = summary.friction_coefficient;
    let onset = |state: &State| state.critical_friction.unwrap_or(friction);
    let own = || {
        let all = summary.front.iter();
        all.filter(move |own| own.candidate.kind == kind)
    };
    let predicted = own().map(|own| (weight(own), onset(&own.candidate.predicted)));
    let mut layers =
        vec![Points::new(predicted).marker(marker, 1.5, colour).name(format!("{kind}, predicted"))];
    for (holds, colour, name) in [
        (true, STABLE, format!("{kind}, run again")),
        (false, UNSTABLE, format!("{kind}, run again and struck off")),
    ] {
        let again = own().filter(|own| own.candidate.verdict.starts_with("struck off") != holds);
        let again =
            again.filter_map(|own| Some((weight(own), onset(own.candidate.confirmed.as_ref()?))));
        layers.push(Points::new(again).marker(marker, 2.8, colour).name(name));
    }
    layers
}
