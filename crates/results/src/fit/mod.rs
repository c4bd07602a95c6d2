//! Results of a fit to measured modes: tables, figure, page.

mod figures;
mod summary;

pub use summary::{BLOCK, FitSummary, FittedParameter, LineSummary, ModeSummary, SearchSummary};
pub(super) use summary::{DIFFERENCES, MEASURED, MODES};

use super::Finding;
use super::drawing::Declaration;
use frictionsim_output::{Document, Section, Table, columns};

columns! {
    /// Whether a mode grows.
    pub(super) GROWS: mode as ModeSummary;
    unstable: "whether the mode grows" = mode.is_unstable();
}

columns! {
    /// A fitted parameter.
    PARAMETERS: row as (String, FittedParameter);
    parameter = row.0.clone(), Always "parameter" Plain;
    value = row.1.value, Always "value" Significant(6);
    unit = row.1.unit.clone(), Always "unit" Plain;
    low = row.1.low, Always "95 % from" Significant(6);
    high = row.1.high, Always "to" Significant(6);
    from = row.1.bounds[0], Always "sought from" Significant(6);
    to = row.1.bounds[1], Always "to" Significant(6);
}

impl Finding for FitSummary {
    fn document(&self) -> Document {
        let lines = || self.residuals.iter();
        let parameters = Table::new("", "Parameters with their 95 % intervals")
            .columns(PARAMETERS, self.parameters.clone());
        let residuals = Table::new("fit.csv", "Measured lines and their modes")
            .columns(MEASURED, lines())
            .group("model_", "model ", MODES, lines().map(|line| Some(&line.mode)))
            .columns(DIFFERENCES, lines())
            .without_empty("mac");
        let modes = Table::new("modes.csv", "Modes of the fitted model")
            .columns(MODES, &self.modes)
            .columns(GROWS, &self.modes);
        let fitted = format!(
            "Fitted to {} lines of {} at friction coefficient {}; the worst frequency differs by {:.3} %. {} of {} \
             searches, from the best of {} points, ended here.",
            self.residuals.len(),
            self.measurement,
            self.friction_coefficient,
            self.worst_percent,
            self.search.arrived,
            self.search.searches,
            self.search.starts,
        );
        let pairs = self.correlations.iter().flat_map(|(a, row)| {
            let later = row.iter().filter(move |(b, _)| a < *b);
            later.map(move |(b, value)| format!("Correlation of {a} and {b}: {value:+.3}."))
        });
        Document::new("Fit to measured modes")
            .section(
                Section::new("Fitted parameters")
                    .text(std::iter::once(fitted).chain(pairs))
                    .aside([self.block()])
                    .tables([parameters])
                    .figures(["fit"]),
            )
            .section(Section::new("Lines and modes").tables([residuals]))
            .file(modes)
            .notes(&self.notes)
    }

    fn figures(&self) -> Vec<Declaration<'_>> {
        vec![Box::new(|| Some(figures::fit(self)))]
    }
}
