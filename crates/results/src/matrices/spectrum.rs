//! The eigenvalues of a superelement: table, summary, print.

use crate::cea::BRANCH;
use crate::common::*;
use frictionsim_physics::cea::QuadraticMode;

/// The modes of a superelement that stands free.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeSpectrum {
    /// Title of the case.
    pub title: String,
    /// Oscillating modes by frequency.
    pub modes: Vec<QuadraticMode>,
    /// What there is to say of them.
    pub summary: FreeSpectrumSummary,
}

keys! {
    /// `summary.json` of `frictionsim cea` of a superelement.
    FreeSpectrumSummary {
        superelement: String = "name of the superelement";
        dofs: usize = "number of unknowns";
        method: String = "`dense`";
        modes: usize = "number of modes listed";
        unstable: usize = "number of them that grow";
        overdamped: usize = "number of real eigenvalues, which are not listed";
        max_residual: f64 = "largest residual of a mode listed";
    }
}

/// Place of a mode by frequency, from 0, and the mode.
type Row = (usize, QuadraticMode);

columns! {
    /// A mode, with the columns of every eigenvalue analysis: no friction, no harmonic, no direction, no contact.
    MODES: row as Row;
    friction_coefficient: "none" = None::<f64>;
    mode: "number by frequency, from 1" = row.0 + 1, Always "mode" Count;
    real_hz: "real part of the eigenvalue over 2 pi" = row.1.eigenvalue.re / TAU;
    frequency_hz: "imaginary part over 2 pi" = row.1.eigenvalue.im / TAU, Always "frequency" Scientific(6);
    damping_factor: "damping factor" = -row.1.eigenvalue.re / row.1.eigenvalue.norm(), Always "damping factor" Fixed(6);
    growth_rate_per_s: "real part" = row.1.eigenvalue.re, Always "growth" Scientific(5);
    harmonic: "none" = None::<usize>;
    branch: BRANCH = row.0 + 1;
    direction: "none" = None::<i8>;
    unstable: "whether it grows" = row.1.is_unstable();
    residual: "relative residual" = row.1.residual;
    contact_share: "none" = None::<f64>;
}

impl FreeSpectrum {
    fn table(&self) -> Table {
        let rows = self.modes.iter().cloned().enumerate();
        Table::new("eigenvalues.csv", "Eigenvalues").columns(MODES, rows)
    }

    /// Writes `eigenvalues.csv` and the summary.
    pub fn write(&self, folder: &OutputFolder, wall_s: f64) -> Result<Value, FolderError> {
        write_table(folder, &self.table())?;
        write_summary(folder, Head::of(&self.title, wall_s), &self.summary)
    }

    /// What is printed.
    pub fn print(&self) -> String {
        let FreeSpectrumSummary { superelement, dofs, modes, unstable, overdamped, .. } =
            &self.summary;
        format!(
            "superelement {superelement}: {dofs} unknowns, {modes} modes listed, {unstable} \
             unstable; {overdamped} real eigenvalues are not listed\n\n{}",
            self.table().text(),
        )
    }
}
