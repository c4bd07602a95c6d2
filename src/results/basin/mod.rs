//! Results of a search for the boundary between two basins.

mod map;
mod report;

use super::summary::{Bounds, Entry, Summary};
use super::table::{Column, write_rows};
use super::{FolderError, Manifest, OutputFolder};
use crate::cycle::{BasinBoundary, BasinRequest, BasinRun};
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;

pub use map::basin_map;
pub use report::draw_basin;

/// `summary.json` of a basin.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BasinSummary {
    /// Its command.
    pub command: String,
    /// Title of the case.
    pub title: String,
    /// Wall time, s.
    pub wall_s: f64,
    /// The two waves, nodal diameters.
    pub harmonics: [usize; 2],
    /// The wave that wins whatever the seeds, if one does.
    pub winner: Option<usize>,
    /// Amplitude ratios at saturation, second wave over first, between which the winner changes.
    pub boundary: Bounds,
    /// Transients spent.
    pub transients: usize,
    /// Every transient, in the order of the search.
    pub runs: Vec<RunSummary>,
    /// What it was made from.
    pub manifest: Manifest,
}

/// One transient.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct RunSummary {
    /// Seed of the second wave over that of the first.
    pub seed_ratio: f64,
    /// Ratio of their amplitudes when the first node sticks or opens.
    pub saturation_ratio: Option<f64>,
    /// The wave that wins.
    pub winner: usize,
    /// Whether that is settled.
    pub is_settled: bool,
    /// Simulated time, s.
    pub duration_s: f64,
}

impl From<&BasinRun> for RunSummary {
    fn from(run: &BasinRun) -> Self {
        Self {
            seed_ratio: run.seed_ratio,
            saturation_ratio: run.saturation_ratio,
            winner: run.winner,
            is_settled: run.is_settled,
            duration_s: run.duration,
        }
    }
}

impl BasinSummary {
    /// The summary of a boundary.
    pub fn new(
        title: &str,
        request: &BasinRequest,
        found: &BasinBoundary,
        wall_s: f64,
        manifest: &Manifest,
    ) -> Self {
        let winners = found.runs.iter().map(|run| run.winner);
        let first = found.runs.first().map(|run| run.winner);
        let alone = first.filter(|first| winners.clone().all(|winner| winner == *first));
        Self {
            command: "basin".to_owned(),
            title: title.to_owned(),
            wall_s,
            harmonics: request.harmonics,
            winner: alone,
            boundary: Bounds {
                low: found.low,
                high: found.high,
            },
            transients: found.runs.len(),
            runs: found.runs.iter().map(RunSummary::from).collect(),
            manifest: manifest.clone(),
        }
    }

    /// What was found, in a sentence.
    fn answer(&self) -> String {
        let [first, second] = self.harmonics;
        match (self.winner, self.boundary.low, self.boundary.high) {
            (Some(winner), Some(ratio), _) | (Some(winner), None, Some(ratio)) => format!(
                "n = {winner} wins at every ratio looked at, {} {ratio:.3} of n = {second} over n = {first} at saturation",
                if winner == first { "up to" } else { "down to" }
            ),
            (None, Some(low), Some(high)) => format!(
                "n = {second} wins where its amplitude at saturation is more than {low:.3} to {high:.3} of that of n = {first}"
            ),
            _ => "some runs never saturate: no boundary can be named".to_owned(),
        }
    }

    /// As text.
    pub fn text(&self) -> String {
        let mut out = format!("{}\n{}\n", self.title, self.answer());
        if self.runs.iter().any(|run| !run.is_settled) {
            out.push_str("some transients end before one wave has gone: raise basin.periods\n");
        }
        for run in &self.runs {
            let ratio = run
                .saturation_ratio
                .map_or("-".to_owned(), |r| format!("{r:.4}"));
            let _ = writeln!(
                out,
                "  seeds 1 : {:<10.4} at saturation {ratio:>9}  n = {}{}",
                run.seed_ratio,
                run.winner,
                if run.is_settled {
                    ""
                } else {
                    "  (not settled)"
                },
            );
        }
        out
    }
}

impl Summary for BasinSummary {
    fn headline(&self) -> Vec<Entry> {
        vec![
            Entry::new("winner", self.winner),
            Entry::new("boundary.low", self.boundary.low),
            Entry::new("boundary.high", self.boundary.high),
        ]
    }
}

/// Writes `basin.csv`, one row for each transient.
///
/// # Errors
/// Those of the folder.
pub fn write_basin(folder: &OutputFolder, summary: &BasinSummary) -> Result<(), FolderError> {
    let columns: &[Column<'_, &RunSummary>] = &[
        ("seed_ratio", &|run| run.seed_ratio.into()),
        ("saturation_ratio", &|run| run.saturation_ratio.into()),
        ("winner", &|run| run.winner.into()),
        ("is_settled", &|run| u8::from(run.is_settled).into()),
        ("duration_s", &|run| run.duration_s.into()),
    ];
    folder.write("basin.csv", |out| write_rows(out, columns, &summary.runs))?;
    Ok(())
}
