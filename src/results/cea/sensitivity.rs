//! `sensitivities.csv`: which parameter decides whether a mode grows.

use super::direction_name;
use crate::cea::cyclic::Sensitivity;
use crate::linalg::c64;
use crate::results::report::ReportTable;
use crate::results::table::{Table, format_number};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Derivatives of the eigenvalues at one friction coefficient, and the values of the parameters there.
#[derive(Clone, Debug, PartialEq)]
pub struct SensitivityReport {
    /// One entry for each branch.
    pub branches: Vec<Sensitivity>,
    /// Normal stiffness, `alpha_R`, `beta_R`, `E`, `nu`, `rho`, static over kinetic friction and decay speed of the case, then
    /// `E`, `nu`, `rho`, `alpha_R`, `beta_R` of its shaft (0 for rigid contact, constant friction, no shaft).
    pub values: [f64; 13],
}

/// Short names of the parameters, the friction coefficient first.
const NAMES: [&str; 14] = [
    "friction_coefficient",
    "normal_stiffness",
    "mass_coefficient",
    "stiffness_coefficient",
    "young_modulus",
    "poisson_ratio",
    "density",
    "static_friction_ratio",
    "decay_speed",
    "shaft_young_modulus",
    "shaft_poisson_ratio",
    "shaft_density",
    "shaft_mass_coefficient",
    "shaft_stiffness_coefficient",
];

/// Of those, the columns that every table has.
const ALWAYS: usize = 7;

/// Derivatives in the order of [`NAMES`]; none with respect to a contact stiffness that is rigid, to how constant
/// friction falls, or to a shaft that is not there.
fn derivatives(branch: &Sensitivity) -> [Option<c64>; 14] {
    let [modulus, ratio, density, mass, stiffness] = branch.shaft;
    [
        Some(branch.friction),
        branch.normal_stiffness,
        Some(branch.mass_coefficient),
        Some(branch.stiffness_coefficient),
        branch.young_modulus,
        branch.poisson_ratio,
        Some(branch.density),
        branch.static_friction_ratio,
        branch.decay_speed,
        modulus,
        ratio,
        density,
        mass,
        stiffness,
    ]
}

impl SensitivityReport {
    /// Change of growth rate, 1/s, for one per cent more of each parameter, largest first.
    fn per_cent(&self, branch: &Sensitivity) -> Vec<(&'static str, f64)> {
        let friction = [branch.friction_coefficient];
        let values = friction.iter().chain(&self.values);
        let mut changes: Vec<(&'static str, f64)> = derivatives(branch)
            .into_iter()
            .zip(values)
            .zip(NAMES)
            .filter_map(|((derivative, value), name)| Some((name, 0.01 * value * derivative?.re)))
            .collect();
        changes.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        changes
    }

    /// Writes one row for each branch: the derivative of its growth rate (1/s) and of its frequency (Hz)
    /// for each unit of each parameter; empty where the contact is rigid. Columns of a friction law that falls with
    /// speed, and of a shaft, are there where the case has one.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
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
        let all: Vec<_> = self.branches.iter().map(derivatives).collect();
        let is_given = |i: &usize| *i < ALWAYS || all.iter().any(|row| row[*i].is_some());
        let given: Vec<usize> = (0..NAMES.len()).filter(is_given).collect();
        for name in given.iter().map(|&i| NAMES[i]) {
            columns.push(format!("growth_rate_per_{name}"));
            columns.push(format!("frequency_hz_per_{name}"));
        }
        let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
        let mut table = Table::new(out, &columns)?;
        for (branch, derivatives) in self.branches.iter().zip(&all) {
            let mut row = vec![
                format_number(branch.friction_coefficient),
                branch.harmonic.to_string(),
                branch.branch.to_string(),
                branch.direction.to_string(),
                format_number(branch.eigenvalue.re),
                format_number(branch.eigenvalue.im / TAU),
            ];
            for &i in &given {
                let parts = derivatives[i].map_or([f64::NAN; 2], |d| [d.re, d.im / TAU]);
                row.extend(parts.map(format_number));
            }
            table.row(row)?;
        }
        table.finish()
    }

    /// Tables of the modes that grow fastest, at most `most`: what one per cent more of each parameter changes, largest first.
    pub(super) fn tables(&self, most: usize) -> Vec<ReportTable> {
        let mut branches: Vec<&Sensitivity> = self.branches.iter().collect();
        branches.sort_by(|a, b| b.eigenvalue.re.total_cmp(&a.eigenvalue.re));
        branches
            .into_iter()
            .take(most)
            .map(|branch| self.table(branch))
            .collect()
    }

    fn table(&self, branch: &Sensitivity) -> ReportTable {
        let friction = [branch.friction_coefficient];
        let values = friction.iter().chain(&self.values);
        let derivatives = derivatives(branch).into_iter().zip(values).zip(NAMES);
        let mut changes: Vec<(&str, c64)> = derivatives
            .filter_map(|((derivative, value), name)| Some((name, derivative? * (0.01 * value))))
            .filter(|(_, change)| change.norm() > 0.0)
            .collect();
        changes.sort_by(|a, b| b.1.re.abs().total_cmp(&a.1.re.abs()));
        let row = |(name, change): (&str, c64)| {
            vec![
                name.replace('_', " "),
                format!("{:+.3}", change.re + 0.0),
                format!("{:+.3}", change.im / TAU + 0.0),
            ]
        };
        let (rate, frequency) = (branch.eigenvalue.re, branch.eigenvalue.im / TAU);
        ReportTable {
            caption: format!(
                "One per cent more of each parameter changes n = {}, branch {}, {} the rotor ({frequency:.1} Hz, {} at {:.1} 1/s \
                 at friction {}) by",
                branch.harmonic,
                branch.branch,
                direction_name(branch.direction),
                if rate > 0.0 { "grows" } else { "decays" },
                rate.abs(),
                branch.friction_coefficient,
            ),
            columns: ["parameter", "growth rate (1/s)", "frequency (Hz)"]
                .map(String::from)
                .to_vec(),
            rows: changes.into_iter().map(row).collect(),
        }
    }

    /// What decides the growth of the mode that grows fastest, in words.
    pub fn print(&self) -> String {
        let fastest = self
            .branches
            .iter()
            .max_by(|a, b| a.eigenvalue.re.total_cmp(&b.eigenvalue.re));
        let Some(branch) = fastest else {
            return String::new();
        };
        let mut text = format!(
            "at friction {} mode n = {}, branch {} {} at {:.1} 1/s; change of the growth rate when a parameter rises by 1 %:",
            branch.friction_coefficient,
            branch.harmonic,
            branch.branch,
            if branch.eigenvalue.re > 0.0 {
                "grows"
            } else {
                "decays"
            },
            branch.eigenvalue.re.abs(),
        );
        for (index, (name, change)) in self.per_cent(branch).into_iter().enumerate() {
            let separator = if index == 0 { "" } else { "," };
            let _ = write!(text, "{separator} {name} {change:+.2}");
        }
        text + " 1/s"
    }
}
