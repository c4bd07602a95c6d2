//! `sensitivities.csv`: which parameter decides whether a mode grows.

use super::branches::travels;
use crate::common::*;

/// Derivatives of the eigenvalues at one friction coefficient, and the values of the parameters there.
#[derive(Clone, Debug, PartialEq)]
pub struct SensitivityReport {
    /// Names and values of the parameters, the friction coefficient first.
    pub parameters: Vec<(String, f64)>,
    /// One for each branch.
    pub rows: Vec<SensitivityRow>,
}

keys! {
    /// Derivatives of one eigenvalue.
    SensitivityRow, ROWS {
        friction_coefficient: f64 = "friction coefficient";
        harmonic: Option<usize> = "number of nodal diameters; none without symmetry";
        branch: usize = "rank within the harmonic, else among all, from 1";
        direction: Option<i8> = "1 travels with the rotor, -1 against it, 0 stands; none without symmetry";
        /// Eigenvalue, rad/s.
        #[serde(skip)]
        eigenvalue: c64;
        /// `d lambda / d parameter`, in the order of the parameters; `None` of one that the branch does not have.
        #[serde(skip)]
        derivatives: Vec<Option<c64>>;
        /// Where the branch turns unstable first.
        #[serde(skip)]
        onset: Option<OnsetRates>;
    }
}

columns! {
    /// The eigenvalue of a branch; derivatives follow, two for each parameter.
    pub(crate) EIGENVALUES: row as SensitivityRow;
    growth_rate_per_s: "growth rate of the mode" = row.eigenvalue.re;
    frequency_hz: "its frequency" = row.eigenvalue.im / TAU;
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
        let given = row.derivatives.iter().zip(&self.parameters);
        let changes = given.filter_map(|(derivative, (name, value))| {
            Some((name.as_str(), (*derivative)? * (0.01 * value)))
        });
        sorted(changes, |own| -own.1.re.abs())
    }

    /// `sensitivities.csv`, one row for each branch: the derivative of its growth rate (1/s) and of its frequency (Hz)
    /// for each unit of each parameter, empty of one by which there is none; and the first critical friction
    /// coefficient of the branch with its derivatives.
    pub(super) fn table(&self) -> Table {
        let rows = || self.rows.iter();
        let mut table =
            Table::new("sensitivities.csv", "").columns(ROWS, rows()).columns(EIGENVALUES, rows());
        for (at, (name, _)) in self.parameters.iter().enumerate() {
            let part = |of: fn(c64) -> f64| rows().map(move |row| row.derivatives[at].map(of));
            table = table.column(&format!("growth_rate_per_{name}"), None, part(|d| d.re)).column(
                &format!("frequency_hz_per_{name}"),
                None,
                part(|d| d.im / TAU),
            );
        }
        let onsets = || rows().map(|row| row.onset.as_ref());
        table = table.column(
            "critical_friction",
            None,
            onsets().map(|own| Some(own?.critical_friction)),
        );
        for (at, (name, _)) in self.parameters.iter().enumerate().skip(1) {
            let rates = onsets().map(|own| own.and_then(|own| own.derivatives[at]));
            table = table.column(&format!("critical_friction_per_{name}"), None, rates);
        }
        table
    }

    /// Tables of the modes that grow fastest, at most `most`: what one per cent more of each parameter changes, largest
    /// first.
    pub(super) fn tables(&self, most: usize) -> Vec<Table> {
        let rows = sorted(&self.rows, |own| -own.eigenvalue.re);
        rows.into_iter().take(most).map(|row| self.changes(row)).collect()
    }

    fn changes(&self, own: &SensitivityRow) -> Table {
        let mut changes = self.per_cent(own);
        changes.retain(|(_, change)| change.norm() > 0.0);
        let (rate, frequency) = (own.eigenvalue.re, fixed(own.eigenvalue.im / TAU, 2));
        let (name, travels) = (self.name(own), own.direction.map_or("", travels));
        let does = if rate > 0.0 { "grows" } else { "decays" };
        let (rate, friction) = (fixed(rate.abs(), 2), own.friction_coefficient);
        let caption = format!(
            "One per cent more of each parameter changes {name}{travels} ({frequency} Hz, {does} at {rate} 1/s at \
             friction {friction}) by"
        );
        let look = |label, digits| Some((label, Format::Signed(digits)));
        Table::new("", caption)
            .column(
                "parameter",
                look("parameter", 0),
                changes.iter().map(|own| own.0.replace('_', " ")),
            )
            .column("growth_rate_per_s", look("growth rate", 3), changes.iter().map(|own| own.1.re))
            .column("frequency_hz", look("frequency", 3), changes.iter().map(|own| own.1.im / TAU))
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
        let Some(row) = fastest else { return String::new() };
        let changes = self.per_cent(row).into_iter();
        let changes = changes.map(|(name, change)| format!(" {name} {:+.2}", change.re));
        format!(
            "at friction {} mode {} {} at {:.1} 1/s; change of the growth rate when a parameter rises by 1 %:{} 1/s",
            row.friction_coefficient,
            self.name(row),
            if row.eigenvalue.re > 0.0 { "grows" } else { "decays" },
            row.eigenvalue.re.abs(),
            changes.collect::<Vec<_>>().join(","),
        )
    }
}
