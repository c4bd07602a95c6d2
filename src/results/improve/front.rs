//! Mass against critical friction: its points and their figure.

use super::{Candidate, ImproveSummary, State};
use crate::chart::{
    Axis, ChartError, Figure, INK, Label, Line, MUTED, Marker, Panel, Points, Rule, Stroke, look,
};
use crate::output::Described;
use crate::results::charts::palette::{STABLE, UNSTABLE};
use serde::{Deserialize, Serialize};

/// Name of the figure.
pub(super) const FRONT: &str = "front";

/// A mass or a removal of some size.
#[derive(Clone, Debug, Described, Serialize, Deserialize)]
pub struct FrontPoint {
    /// What it is, and what it does; `rank` is its place by rising mass.
    #[serde(flatten)]
    pub candidate: Candidate,
    /// Whether it was run again, holds, and no lighter one that holds gets as far.
    pub on_front: bool,
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
