//! `sensitivities.csv`: which parameter decides whether a mode grows.

use super::direction_name;
use crate::linalg::c64;
use crate::results::report::ReportTable;
use crate::results::table::{Table, format_number};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Derivatives of the eigenvalues at one friction coefficient, and the values of the parameters there.
#[derive(Clone, Debug, PartialEq)]
pub struct SensitivityReport {
    /// Names of the parameters, the friction coefficient first.
    pub parameters: Vec<String>,
    /// Their values; that of the friction coefficient is each row's own.
    pub values: Vec<f64>,
    /// One for each branch.
    pub rows: Vec<SensitivityRow>,
}

/// Derivatives of one eigenvalue.
#[derive(Clone, Debug, PartialEq)]
pub struct SensitivityRow {
    /// Where the derivatives are taken.
    pub friction_coefficient: f64,
    /// Nodal diameters, where modes have them.
    pub harmonic: Option<usize>,
    /// Branch.
    pub branch: usize,
    /// Direction of travel, of a body that has harmonics.
    pub direction: Option<i8>,
    /// Eigenvalue, rad/s.
    pub eigenvalue: c64,
    /// `d lambda / d parameter`, in the order of the parameters; `None` of one that the branch does not have.
    pub derivatives: Vec<Option<c64>>,
    /// Where the branch turns unstable first.
    pub onset: Option<OnsetRates>,
}

/// How the critical friction coefficient of a branch moves.
#[derive(Clone, Debug, PartialEq)]
pub struct OnsetRates {
    /// The critical friction coefficient `mu_c`.
    pub critical_friction: f64,
    /// `d mu_c / d parameter`, in the order of the parameters; nothing by the friction coefficient itself.
    pub derivatives: Vec<Option<f64>>,
}

impl SensitivityReport {
    /// Change of the eigenvalue, 1/s, for one per cent more of each parameter, that of the growth rate largest first.
    fn per_cent<'a>(&'a self, row: &'a SensitivityRow) -> Vec<(&'a str, c64)> {
        let own = [row.friction_coefficient];
        let values = own.iter().chain(self.values.iter().skip(1));
        let given = row.derivatives.iter().zip(values).zip(&self.parameters);
        let mut changes: Vec<(&str, c64)> = given
            .filter_map(|((derivative, value), name)| {
                Some((name.as_str(), (*derivative)? * (0.01 * value)))
            })
            .collect();
        changes.sort_by(|a, b| b.1.re.abs().total_cmp(&a.1.re.abs()));
        changes
    }

    /// Names of the columns.
    fn columns(&self) -> Vec<String> {
        let mut columns: Vec<String> = [
            "friction_coefficient",
            "harmonic",
            "branch",
            "direction",
            "growth_rate_per_s",
            "frequency_hz",
        ]
        .map(str::to_owned)
        .to_vec();
        for name in &self.parameters {
            columns.push(format!("growth_rate_per_{name}"));
            columns.push(format!("frequency_hz_per_{name}"));
        }
        columns.push("critical_friction".to_owned());
        let names = self.parameters.iter().skip(1);
        columns.extend(names.map(|name| format!("critical_friction_per_{name}")));
        columns
    }

    /// Writes one row for each branch: the derivative of its growth rate (1/s) and of its frequency (Hz) for each unit of
    /// each parameter, empty of one by which there is none; and the first critical friction coefficient
    ///  of the branch with its derivatives.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let columns = self.columns();
        let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
        let mut table = Table::new(out, &columns)?;
        for row in &self.rows {
            let mut cells = vec![
                format_number(row.friction_coefficient),
                row.harmonic.map_or(String::new(), |n| n.to_string()),
                row.branch.to_string(),
                row.direction.map_or(String::new(), |way| way.to_string()),
                format_number(row.eigenvalue.re),
                format_number(row.eigenvalue.im / TAU),
            ];
            for derivative in &row.derivatives {
                let parts = derivative.map_or([f64::NAN; 2], |d| [d.re, d.im / TAU]);
                cells.extend(parts.map(format_number));
            }
            let critical = row.onset.as_ref().map(|onset| onset.critical_friction);
            let rate = |i: usize| row.onset.as_ref().and_then(|onset| onset.derivatives[i]);
            let all = std::iter::once(critical).chain((1..self.parameters.len()).map(rate));
            cells.extend(all.map(|value| format_number(value.unwrap_or(f64::NAN))));
            table.row(cells)?;
        }
        table.finish()
    }

    /// Tables of the modes that grow fastest, at most `most`: what one per cent more of each parameter changes, largest first.
    pub(super) fn tables(&self, most: usize) -> Vec<ReportTable> {
        let mut rows: Vec<&SensitivityRow> = self.rows.iter().collect();
        rows.sort_by(|a, b| b.eigenvalue.re.total_cmp(&a.eigenvalue.re));
        rows.into_iter().take(most).map(|row| self.table(row)).collect()
    }

    fn table(&self, own: &SensitivityRow) -> ReportTable {
        let row = |(name, change): (&str, c64)| {
            vec![
                name.replace('_', " "),
                format!("{:+.3}", change.re + 0.0),
                format!("{:+.3}", change.im / TAU + 0.0),
            ]
        };
        let changes = self.per_cent(own).into_iter();
        let changes = changes.filter(|(_, change)| change.norm() > 0.0);
        let (rate, frequency) = (own.eigenvalue.re, own.eigenvalue.im / TAU);
        let travels = own.direction.map(|way| format!(", {} the rotor", direction_name(way)));
        let travels = travels.unwrap_or_default();
        ReportTable::new(
            format!(
                "One per cent more of each parameter changes {}{travels} ({frequency:.1} Hz, {} at {:.1} 1/s at friction {}) by",
                self.name(own),
                if rate > 0.0 { "grows" } else { "decays" },
                rate.abs(),
                own.friction_coefficient,
            ),
            ["parameter", "growth rate (1/s)", "frequency (Hz)"],
            changes.map(row),
        )
    }

    fn name(&self, row: &SensitivityRow) -> String {
        match row.harmonic {
            Some(harmonic) => format!("n = {harmonic}, branch {}", row.branch),
            None => format!("branch {}", row.branch),
        }
    }

    /// What decides the growth of the mode that grows fastest, in words.
    pub fn print(&self) -> String {
        let fastest = self.rows.iter().max_by(|a, b| a.eigenvalue.re.total_cmp(&b.eigenvalue.re));
        let Some(row) = fastest else {
            return String::new();
        };
        let mut text = format!(
            "at friction {} mode {} {} at {:.1} 1/s; change of the growth rate when a parameter rises by 1 %:",
            row.friction_coefficient,
            self.name(row),
            if row.eigenvalue.re > 0.0 { "grows" } else { "decays" },
            row.eigenvalue.re.abs(),
        );
        for (index, (name, change)) in self.per_cent(row).into_iter().enumerate() {
            let separator = if index == 0 { "" } else { "," };
            let _ = write!(text, "{separator} {name} {:+.2}", change.re);
        }
        text + " 1/s"
    }
}
