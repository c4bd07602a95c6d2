//! Results of a search for the boundary between two basins.

mod figures;
mod map;

use super::Finding;
use super::drawing::Declaration;
use super::summary::Bounds;
use crate::finding::keys;
use frictionsim_output::{Document, Section, Table, columns, significant};
use frictionsim_physics::cycle::{BasinBoundary, BasinRun};

pub use map::basin_map;

keys! {
    /// `summary.json` of a basin.
    BasinSummary {
        harmonics: [usize; 2] = "the two waves, nodal diameters; of a body without symmetry the \
            numbers of the two modes, 0 for steady sliding";
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        of_modes: bool = "whether these are numbers of modes";
        winner: Option<usize> = "the wave that wins whatever the seeds, if one does";
        boundary: Bounds = "amplitude ratios at saturation, second wave over first, between which \
            the winner changes";
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
                "{other} wins where its amplitude at saturation is more than {low:.3} to \
                 {high:.3} of that of {one}"
            ),
            _ => "some runs never saturate: no boundary can be named".to_owned(),
        }
    }

    /// The same where steady sliding is kicked along a mode.
    fn answer_to_kick(&self, name: &str) -> String {
        if self.runs.iter().any(|run| !run.is_settled) {
            return format!(
                "no answer: not every transient from a kick along {name} has come to its end \
                 (raise basin.periods)"
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
                 {high:.3} of the one that makes a contact node stick"
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
        let open = is_open.then(|| {
            "Some transients end before one wave has gone: raise basin.periods.".to_owned()
        });
        let runs = Table::new("basin.csv", "Transients in the order of the search")
            .columns(RUNS, &self.runs)
            .shown_column("winner", self.runs.iter().map(|run| self.name(run.winner)));
        Document::new("Basins")
            .section(Section::new("Results").text([self.answer()]).text(open).facts(self.facts()))
            .section(Section::new("Search").tables([runs]).figures(["basin"]))
    }

    fn figures(&self) -> Vec<Declaration<'_>> {
        vec![Box::new(|| Some(figures::search(self)))]
    }
}
