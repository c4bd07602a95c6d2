//! Results of a convergence study: what is printed, written and drawn.

mod estimate;
mod figures;
mod print;

pub use estimate::{Verdict, estimate};
pub use figures::draw;
pub use print::print;

use crate::results::folder::{FolderError, OutputFolder};
use crate::results::manifest::Manifest;
use crate::results::record::{Record, write_record};
use crate::results::summary::{present, write_summary};
use crate::results::table::{Column, write_rows};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::io::{self, Write};

/// What is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Refinement {
    /// The mesh; sizes are element sizes, m.
    Mesh,
    /// The time step; sizes are steps, s.
    TimeStep,
}

impl Refinement {
    /// Name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mesh => "mesh",
            Self::TimeStep => "time-step",
        }
    }
}

/// A quantity over the levels of its series.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quantity {
    /// Name, with the mode it belongs to.
    pub name: String,
    /// Unit; empty for a pure number.
    pub unit: String,
    /// One value for each level; NaN where there is none.
    pub values: Vec<f64>,
    /// Order and limit.
    pub verdict: Verdict,
    /// Whether the terminal leaves it to the table, as a mode that does not grow.
    #[serde(skip)]
    pub is_minor: bool,
}

impl Quantity {
    /// Judges values on levels of these sizes.
    pub fn new(name: String, unit: &str, sizes: &[f64], values: Vec<f64>) -> Self {
        Self {
            verdict: estimate(sizes, &values),
            name,
            unit: unit.to_owned(),
            values,
            is_minor: false,
        }
    }

    /// A whole number on each level, which is the same on the three finest or has not converged.
    pub fn count(name: String, values: Vec<f64>) -> Self {
        let finest = &values[values.len().saturating_sub(3)..];
        let verdict = if !finest.iter().all(|value| value.is_finite()) {
            Verdict::Missing
        } else if finest.windows(2).all(|pair| pair[0] == pair[1]) {
            Verdict::Settled
        } else {
            Verdict::NotConverging
        };
        Self { name, unit: String::new(), values, verdict, is_minor: false }
    }

    /// Estimated error of each level, the value less the limit; NaN without a limit.
    pub fn errors(&self) -> Vec<f64> {
        let limit = self.verdict.limit().unwrap_or(f64::NAN);
        self.values.iter().map(|value| value - limit).collect()
    }

    /// Spread of the three finest levels: largest less smallest value.
    pub fn spread(&self) -> f64 {
        let finest = &self.values[self.values.len().saturating_sub(3)..];
        let largest = finest.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        largest - finest.iter().copied().fold(f64::INFINITY, f64::min)
    }
}

/// One analysis over refinements of one kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// `cea` or `transient`.
    pub analysis: String,
    /// What is refined.
    pub refinement: Refinement,
    /// Name of each level: `90 x 18`, or the time step.
    pub levels: Vec<String>,
    /// Element size, m, or time step, s, of each level, strictly falling.
    pub sizes: Vec<f64>,
    /// The quantities.
    pub quantities: Vec<Quantity>,
    /// Wall time of each level, s; levels run side by side.
    pub wall_s: Vec<f64>,
    /// What else there is to say.
    pub notes: Vec<String>,
}

/// Everything that a convergence study reports.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConvergenceReport {
    /// Title of the case.
    pub title: String,
    /// What was studied.
    pub series: Vec<Series>,
    /// Wall time, s.
    pub wall_s: f64,
}

impl Record for ConvergenceReport {
    const MAGIC: [u8; 8] = *b"FRICSIMV";
    const VERSION: u32 = 1;

    fn inconsistency(&self) -> Option<&'static str> {
        let is_whole = |series: &Series| {
            let count = series.levels.len();
            let falls = series.sizes.windows(2).all(|pair| pair[0] > pair[1]);
            let is_positive = series.sizes.iter().all(|&size| size > 0.0 && size.is_finite());
            let mut quantities = series.quantities.iter();
            let lengths = [series.sizes.len(), series.wall_s.len()];
            falls
                && is_positive
                && lengths == [count; 2]
                && quantities.all(|quantity| quantity.values.len() == count)
        };
        (!self.series.iter().all(is_whole)).then_some("its levels and values do not fit together")
    }
}

impl ConvergenceReport {
    /// The same without how long anything took: equal studies have equal records, and times are in the summary alone.
    fn timeless(&self) -> Self {
        let mut series = self.series.clone();
        series.iter_mut().for_each(|own| own.wall_s.fill(0.0));
        Self { title: self.title.clone(), series, wall_s: 0.0 }
    }
}

/// Writes `convergence.csv` and `summary.json`; returns the summary.
///
/// # Errors
/// Those of the folder.
pub fn write(folder: &OutputFolder, report: &ConvergenceReport) -> Result<Value, FolderError> {
    folder.write("convergence.csv", |out| write_table(out, report))?;
    write_record(folder, &report.timeless())?;
    let summary = ConvergenceSummary {
        command: "convergence".to_owned(),
        title: report.title.clone(),
        series: report.series.iter().map(SeriesSummary::of).collect(),
        wall_s: report.wall_s,
        manifest: folder.manifest().clone(),
    };
    write_summary(folder, &summary)
}

/// `summary.json` of `frictionsim convergence`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConvergenceSummary {
    /// `convergence`.
    pub command: String,
    /// Title of the case.
    pub title: String,
    /// What was studied.
    pub series: Vec<SeriesSummary>,
    /// Wall time, s.
    pub wall_s: f64,
    /// What it was made from.
    pub manifest: Manifest,
}

/// One analysis over refinements of one kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeriesSummary {
    /// Analysis, with the family of its limit cycles.
    pub analysis: String,
    /// `mesh` or `time-step`.
    pub refinement: String,
    /// Name of each level.
    pub levels: Vec<String>,
    /// Element size, m, or time step, s.
    pub sizes: Vec<f64>,
    /// Wall time of each level, s.
    pub wall_s: Vec<f64>,
    /// What else there is to say.
    pub notes: Vec<String>,
    /// The quantities.
    pub quantities: Vec<QuantitySummary>,
}

/// One quantity over the levels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuantitySummary {
    /// Name, with the mode it belongs to.
    pub name: String,
    /// Unit; empty for a pure number.
    pub unit: String,
    /// One value for each level, where there is one.
    pub values: Vec<Option<f64>>,
    /// What the values say.
    pub verdict: String,
    /// Observed order.
    pub order: Option<f64>,
    /// Richardson-extrapolated value.
    pub extrapolated: Option<f64>,
    /// Values less that one.
    pub errors: Option<Vec<Option<f64>>>,
    /// Spread of the three finest levels.
    pub spread: Option<f64>,
}

impl SeriesSummary {
    fn of(series: &Series) -> Self {
        Self {
            analysis: series.analysis.clone(),
            refinement: series.refinement.name().to_owned(),
            levels: series.levels.clone(),
            sizes: series.sizes.clone(),
            wall_s: series.wall_s.clone(),
            notes: series.notes.clone(),
            quantities: series.quantities.iter().map(QuantitySummary::of).collect(),
        }
    }
}

impl QuantitySummary {
    fn of(quantity: &Quantity) -> Self {
        let all = |values: &[f64]| values.iter().map(|&value| present(value)).collect();
        let limit = quantity.verdict.limit();
        Self {
            name: quantity.name.clone(),
            unit: quantity.unit.clone(),
            values: all(&quantity.values),
            verdict: quantity.verdict.name().to_owned(),
            order: quantity.verdict.order(),
            extrapolated: limit,
            errors: limit.map(|_| all(&quantity.errors())),
            spread: present(quantity.spread()),
        }
    }
}

/// Writes one row for each quantity on each level.
fn write_table(out: &mut dyn Write, report: &ConvergenceReport) -> io::Result<()> {
    type Row<'a> = (&'a Series, &'a Quantity, usize);
    let columns: &[Column<'_, Row<'_>>] = &[
        ("analysis", &|(series, ..)| (&series.analysis).into()),
        ("refinement", &|(series, ..)| series.refinement.name().into()),
        ("quantity", &|(_, quantity, _)| (&quantity.name).into()),
        ("unit", &|(_, quantity, _)| (&quantity.unit).into()),
        ("level", &|(series, _, level)| (&series.levels[*level]).into()),
        ("size", &|(series, _, level)| series.sizes[*level].into()),
        ("value", &|(_, quantity, level)| quantity.values[*level].into()),
        ("error", &|(_, quantity, level)| quantity.errors()[*level].into()),
        ("extrapolated", &|(_, quantity, _)| quantity.verdict.limit().into()),
        ("order", &|(_, quantity, _)| quantity.verdict.order().into()),
        ("verdict", &|(_, quantity, _)| quantity.verdict.name().into()),
    ];
    let all = report.series.iter();
    let each = all.flat_map(|series| series.quantities.iter().map(move |of| (series, of)));
    let rows = each.flat_map(|(series, quantity)| {
        (0..series.levels.len()).map(move |level| (series, quantity, level))
    });
    write_rows(out, columns, rows)
}
