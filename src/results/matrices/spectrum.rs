//! The eigenvalues of a superelement: table, summary, print.

use crate::cea::QuadraticMode;
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::manifest::Manifest;
use crate::results::summary::write_summary;
use crate::results::table::{Table, format_number};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// The modes of a superelement that stands free.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeSpectrum {
    /// Title of the case.
    pub title: String,
    /// Name of the superelement.
    pub name: String,
    /// Number of unknowns.
    pub dofs: usize,
    /// Oscillating modes by frequency.
    pub modes: Vec<QuadraticMode>,
    /// Number of real eigenvalues.
    pub overdamped: usize,
}

/// `summary.json` of `frictionsim cea` of a superelement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FreeSpectrumSummary {
    /// `cea`.
    pub command: String,
    /// Title of the case.
    pub title: String,
    /// Name of the superelement.
    pub superelement: String,
    /// Number of unknowns.
    pub dofs: usize,
    /// `dense`.
    pub method: String,
    /// Wall time, s.
    pub wall_s: f64,
    /// Number of modes listed.
    pub modes: usize,
    /// Number of them that grow.
    pub unstable: usize,
    /// Number of real eigenvalues, which are not listed.
    pub overdamped: usize,
    /// Largest residual of a mode listed.
    pub max_residual: f64,
    /// What it was made from.
    pub manifest: Manifest,
}

impl FreeSpectrum {
    /// Writes `eigenvalues.csv`, with the columns of every eigenvalue analysis, and the summary.
    ///
    /// # Errors
    /// Those of the folder.
    pub fn write(&self, folder: &OutputFolder, wall_s: f64) -> Result<Value, FolderError> {
        folder.write("eigenvalues.csv", |out| {
            let columns = [
                "friction_coefficient",
                "mode",
                "real_hz",
                "frequency_hz",
                "damping_factor",
                "growth_rate_per_s",
                "harmonic",
                "branch",
                "direction",
                "unstable",
                "residual",
                "contact_share",
            ];
            let mut table = Table::new(out, &columns)?;
            for (k, mode) in self.modes.iter().enumerate() {
                let lambda = mode.eigenvalue;
                let numbers =
                    [lambda.re / TAU, lambda.im / TAU, -lambda.re / lambda.norm(), lambda.re];
                // No friction coefficient, no harmonic, no direction, no contact.
                let mut row = vec![String::new(), (k + 1).to_string()];
                row.extend(numbers.map(format_number));
                row.extend([String::new(), k.to_string(), String::new()]);
                row.push((lambda.re > 0.0).to_string());
                row.extend([format_number(mode.residual), String::new()]);
                table.row(row)?;
            }
            table.finish()
        })?;
        write_summary(
            folder,
            &FreeSpectrumSummary {
                command: "cea".to_owned(),
                title: self.title.clone(),
                superelement: self.name.clone(),
                dofs: self.dofs,
                method: "dense".to_owned(),
                wall_s,
                modes: self.modes.len(),
                unstable: self.unstable(),
                overdamped: self.overdamped,
                max_residual: self.modes.iter().map(|mode| mode.residual).fold(0.0, f64::max),
                manifest: folder.manifest().clone(),
            },
        )
    }

    fn unstable(&self) -> usize {
        let unstable = self.modes.iter().filter(|mode| mode.eigenvalue.re > 0.0);
        unstable.count()
    }

    /// What is printed.
    pub fn print(&self) -> String {
        let mut text = format!(
            "superelement {}: {} unknowns, {} modes listed, {} unstable; {} real eigenvalues are not listed\n\n",
            self.name,
            self.dofs,
            self.modes.len(),
            self.unstable(),
            self.overdamped,
        );
        let _ = writeln!(text, "  mode  frequency Hz    growth 1/s  damping factor");
        for (k, mode) in self.modes.iter().enumerate() {
            let lambda = mode.eigenvalue;
            let _ = writeln!(
                text,
                "  {:>4} {:>13.6e} {:>13.5e} {:>15.6}",
                k + 1,
                lambda.im / TAU,
                lambda.re,
                -lambda.re / lambda.norm(),
            );
        }
        text
    }
}
