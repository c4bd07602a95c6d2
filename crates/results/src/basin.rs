//! Results of a search for the boundary between two basins.

use crate::common::*;
use crate::summary::Bounds;
use crate::sweep::{FRICTION, PointRecord, SPEED, by_other_keys, swept_text};
use frictionsim_physics::cycle::{BasinBoundary, BasinRun};

keys! {
    /// `summary.json` of a basin.
    BasinSummary {
        harmonics: [usize; 2] = "the two waves, nodal diameters; of a body without symmetry the \
            numbers of the two modes, 0 for steady sliding";
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        of_modes: bool = "whether these are numbers of modes";
        winner: Option<usize> = "the wave that wins whatever the seeds, if one does";
        boundary: Bounds = "amplitude ratios at saturation, second wave over first, between which the winner changes";
        transients: usize = "transients spent";
        runs: Vec<BasinRun> = "every transient, in the order of the search";
    }
}

impl BasinSummary {
    /// The summary of the boundary between two rivals, which are waves or modes.
    pub fn new(rivals: [usize; 2], of_modes: bool, found: BasinBoundary) -> Self {
        let winners = found.runs.iter().map(|run| run.winner);
        let first = found.runs.first().map(|run| run.winner);
        let alone = first.filter(|first| winners.clone().all(|winner| winner == *first));
        Self {
            harmonics: rivals,
            of_modes,
            winner: alone,
            boundary: Bounds { low: found.low, high: found.high },
            transients: found.runs.len(),
            runs: found.runs,
        }
    }

    /// A rival in words.
    pub(super) fn name(&self, rival: usize) -> String {
        match (self.of_modes, rival) {
            (false, n) => format!("n = {n}"),
            (true, 0) => "steady sliding".to_owned(),
            (true, mode) => format!("mode {mode}"),
        }
    }

    /// Whether steady sliding is one of the two: ratios are of the amplitude of the other one's seed to the one that
    /// makes a contact node stick.
    fn is_kick(&self) -> bool {
        self.of_modes && self.harmonics[0] == 0
    }

    /// What the ratio is of.
    pub(super) fn ratio(&self) -> String {
        let [first, second] = self.harmonics.map(|rival| self.name(rival));
        match self.is_kick() {
            true => format!("kick along {second} over the one that makes a contact node stick"),
            false => format!("amplitude of {second} over {first} at saturation"),
        }
    }

    /// What was found, in a sentence.
    fn answer(&self) -> String {
        let [first, _] = self.harmonics;
        let [one, other] = self.harmonics.map(|rival| self.name(rival));
        let Bounds { low, high } = self.boundary;
        if self.is_kick() {
            return self.answer_to_kick(&other);
        }
        match (self.winner, low, high) {
            (Some(winner), Some(ratio), _) | (Some(winner), None, Some(ratio)) => format!(
                "{} wins at every ratio looked at, {} {ratio:.3} of {other} over {one} at saturation",
                self.name(winner),
                if winner == first { "up to" } else { "down to" }
            ),
            (None, Some(low), Some(high)) => format!(
                "{other} wins where its amplitude at saturation is more than {low:.3} to {high:.3} of that of {one}"
            ),
            _ => "some runs never saturate: no boundary can be named".to_owned(),
        }
    }

    /// The same where steady sliding is kicked along a mode.
    fn answer_to_kick(&self, name: &str) -> String {
        if self.runs.iter().any(|run| !run.is_settled) {
            return format!(
                "no answer: not every transient from a kick along {name} has come to its end (raise basin.periods)"
            );
        }
        match (self.winner, self.boundary.low, self.boundary.high) {
            (Some(0), Some(low), _) => format!(
                "steady sliding comes back from every kick along {name} looked at, up to {low:.3} \
                 of the one that makes a contact node stick"
            ),
            (None, Some(low), Some(high)) if low > high => format!(
                "steady sliding comes back from a kick along {name} of {low:.3} but not of \
                 {high:.3} of the one that makes a contact node stick. No single boundary lies \
                 between: narrow basin.seed_ratio_from and basin.seed_ratio_to"
            ),
            (None, Some(low), Some(high)) => format!(
                "a kick along {name} tips steady sliding into a limit cycle from {low:.3} to \
                 {high:.3} of the one that makes a contact node stick. Other phases have other bounds"
            ),
            _ => {
                format!("every kick along {name} looked at tips steady sliding into a limit cycle")
            }
        }
    }

    /// Numbers that decide, name and value.
    fn facts(&self) -> Vec<(String, String)> {
        let [first, second] = self.harmonics.map(|rival| self.name(rival));
        let bound = |value: Option<f64>| value.map_or("-".to_owned(), |v| significant(v, 5));
        vec![
            ("rivals".to_owned(), format!("{first} and {second}")),
            ("ratio".to_owned(), self.ratio()),
            (format!("largest ratio at which {first} wins"), bound(self.boundary.low)),
            (format!("smallest ratio at which {second} wins"), bound(self.boundary.high)),
            ("transients".to_owned(), self.transients.to_string()),
        ]
    }
}

columns! {
    /// A transient.
    pub(super) RUNS: run as BasinRun;
    seed_ratio: "seed of the second rival over that of the first, or the kick"
        = run.seed_ratio, Always "ratio of the seeds" Significant(5);
    saturation_ratio: "ratio of their amplitudes when the first node sticks or opens"
        = run.saturation_ratio, IfAny "ratio at saturation" Significant(5);
    winner: "nodal diameters or number of the motion that wins, 0 for steady sliding" = run.winner;
    is_settled: "whether that is settled" = run.is_settled, Always "settled" Plain;
    duration_s: "simulated time" = run.duration_s, Always "simulated time" Significant(4);
}

impl Finding for BasinSummary {
    fn document(&self) -> Document {
        let is_open = !self.is_kick() && self.runs.iter().any(|run| !run.is_settled);
        let open = "Some transients end before one wave has gone: raise basin.periods.";
        let runs = Table::new("basin.csv", "Transients in the order of the search")
            .columns(RUNS, &self.runs)
            .shown_column("winner", self.runs.iter().map(|run| self.name(run.winner)));
        Document::new("Basins")
            .section(
                Section::new("Results")
                    .text([self.answer()])
                    .text(is_open.then(|| open.to_owned()))
                    .facts(self.facts()),
            )
            .section(Section::new("Search").tables([runs]).figures(["basin"]))
    }

    fn figures(&self) -> Vec<Declaration<'_>> {
        vec![Box::new(|| Some(search(self)))]
    }
}

/// The boundary at one value of the key along the axis.
struct Boundary {
    value: f64,
    low: Option<f64>,
    high: Option<f64>,
}

/// Amplitude ratio at saturation above which the second wave wins, over the rotation speed or the first swept key; one
/// line for each choice of the other keys.
pub fn basin_map(records: &[PointRecord]) -> Option<Figure> {
    let first = records.first()?;
    let keys = || first.swept.keys();
    let key = keys().find(|key| *key == SPEED).or_else(|| keys().next())?;
    let mut harmonics = [1, 2];
    let boundaries = records.iter().filter_map(|record| {
        let summary = record.summaries.get("basin")?;
        for (place, harmonic) in harmonics.iter_mut().enumerate() {
            let found = summary["harmonics"][place].as_f64();
            *harmonic = found.map_or(*harmonic, |n| n as usize);
        }
        let boundary = Boundary {
            value: record.swept[key].as_f64().unwrap_or(f64::NAN),
            low: summary["boundary"]["low"].as_f64(),
            high: summary["boundary"]["high"].as_f64(),
        };
        Some((record, boundary))
    });
    let series = by_other_keys(boundaries, key, |rest| match rest.get(FRICTION) {
        Some(friction) if rest.len() == 1 => format!("*μ* = {friction}"),
        _ => literal(&swept_text(rest)),
    });
    let [one, two] = harmonics;
    let values = series.iter().flat_map(|(_, all)| all).map(|b| b.value);
    let axis = parameter_axis(key).scaled(Scale::for_values(values, 10.0));
    let ratio = Axis::new("amplitude ratio at saturation", "").logarithmic();
    let only = [
        format!("*n* = {one} wins up to here, the largest ratio tried"),
        format!("*n* = {two} wins down to here, the smallest ratio tried"),
    ];
    let mut panel = Panel::new(axis, ratio).height(180.0);
    for (index, (name, boundaries)) in series.iter().enumerate() {
        let colour = look(index).0;
        let all = || boundaries.iter();
        let middle = all().filter_map(|b| Some((b.value, (b.low? * b.high?).sqrt())));
        let bars = all().map(|b| {
            let ends = [b.low, b.high].into_iter().flatten();
            Line::through(ends.map(|end| (b.value, end))).solid(colour, 3.0)
        });
        let low =
            Points::new(all().filter(|b| b.high.is_none()).filter_map(|b| Some((b.value, b.low?))));
        let high =
            Points::new(all().filter(|b| b.low.is_none()).filter_map(|b| Some((b.value, b.high?))));
        let one_sided = [low, high].into_iter().zip(&only).zip(Marker::ALL);
        let one_sided = one_sided.map(|((points, text), marker)| {
            let points = points.marker(marker, 2.6, colour);
            if index == 0 { points.name(text) } else { points }
        });
        panel = panel
            .layer(Line::through(middle).nth(index).name(name.clone()))
            .layers(bars)
            .layers(one_sided);
    }
    let caption = format!(
        "Amplitude of *n* = {two} over that of *n* = {one} at the first stick or opening, above \
         which *n* = {two} wins; bars: the bounds found."
    );
    Some(Figure::new("basins", caption).panel(panel))
}

/// The winner of each transient over the ratio of the amplitudes at the first stick or opening.
fn search(summary: &BasinSummary) -> Figure {
    let [first, second] = summary.harmonics;
    let place = |run: &BasinRun| {
        let at = if run.winner == first { 0.0 } else { 1.0 };
        Some((run.saturation_ratio?, at))
    };
    let shown = |rival: usize| summary.name(rival).replace("n = ", "*n* = ");
    let wins = |rival: usize| format!("{} wins", shown(rival));
    let kinds = [
        (first, true, Marker::Disc, SERIES[0], wins(first)),
        (second, true, Marker::Square, SERIES[1], wins(second)),
        (first, false, Marker::Circle, INK, "not settled".to_owned()),
        (second, false, Marker::Circle, INK, "not settled".to_owned()),
    ];
    let points = kinds.map(|(winner, is_settled, marker, colour, name)| {
        let own = summary.runs.iter();
        let own = own.filter(|run| run.winner == winner && run.is_settled == is_settled);
        Points::new(own.filter_map(place)).marker(marker, 2.6, colour).name(name)
    });
    let bounds = [summary.boundary.low, summary.boundary.high].into_iter().flatten().map(|ratio| {
        Rule::vertical(ratio).stroke(Stroke::dashed(INK, 0.8)).name("winner changes between")
    });
    let names = [(0.0, shown(first)), (1.0, shown(second))];
    let ratio = summary.ratio().replace("n = ", "*n* = ");
    let panel = Panel::new(
        Axis::new(&ratio, "–").logarithmic().room(0.1),
        Axis::new("winner", "").between(-0.5, 1.5).ticks(names),
    )
    .height(90.0)
    .layers(bounds)
    .layers(points);
    let what = match summary.of_modes {
        true => "What wins over the ratio",
        false => {
            "The wave that wins over the ratio of the amplitudes of both at the first stick or opening"
        }
    };
    Figure::new("basin", format!("{what}, one point for each transient.")).panel(panel)
}
