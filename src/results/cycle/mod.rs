//! Results of a search for limit cycles: what is printed and what is written.

mod confirmation;
mod fields;
mod print;
mod stability;
mod summary;

pub use confirmation::ConfirmationSummary;
pub use confirmation::doubt;
pub use fields::CycleFrame;
pub use print::print;
pub use stability::{ExponentSummary, Finding, StabilitySummary, known};
pub use summary::{CycleSummary, FamilySummary, LimitCycleSummary, summary};

use crate::contact::ContactStatus;
use crate::cycle::{
    Confirmation, CycleBranch, CycleStability, Family, LimitCycle, Onset, StabilityChange,
};
use crate::mesh::Mesh2d;
use crate::results::cycle_figures::CycleRecord;
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::record::write_record;
use crate::results::summary::write_summary;
use crate::results::table::{Table, format_number};
use serde_json::Value;
use std::f64::consts::TAU;
use std::io::{self, Write};

/// Why a family has no cycle at the case's own operating point.
#[derive(Clone, Debug, PartialEq)]
pub struct Absence {
    /// In words.
    pub reason: String,
    /// Whether that is so because steady sliding is stable against its wave.
    pub is_stable: bool,
}

/// The limit cycle of one harmonic, and its branch.
#[derive(Clone, Debug)]
pub struct CycleResult {
    /// Which limit cycle.
    pub family: Family,
    /// Every onset of the harmonic, by rising friction; the cycle is born at that of its family.
    pub onsets: Vec<Onset>,
    /// The cycle at the case's own operating point, or why there is none.
    pub cycle: Result<LimitCycle, Absence>,
    /// The whole field at times over one period, from zero on; empty where there is no cycle.
    pub frames: Vec<CycleFrame>,
    /// Points along the phase.
    pub phases: usize,
    /// A transient that started on that cycle, where one was asked for.
    pub confirmation: Option<Result<Confirmation, String>>,
    /// Stability of that cycle, where it was asked for.
    pub stability: Finding,
    /// Stability of each cycle of the branch, where it was asked for; else empty.
    pub branch_stability: Vec<Finding>,
    /// Where the branch changes its stability, in its order.
    pub stability_changes: Vec<StabilityChange>,
    /// The branch over the case's parameter, where one was asked for and there is a cycle to start from.
    pub branch: Option<CycleBranch>,
    /// Wall time of cycle and branch, s.
    pub wall_s: f64,
}

impl CycleReport<'_> {
    /// That steady sliding is stable against every wave looked at, in words; nothing where it is not.
    pub fn stable_sliding(&self) -> Option<String> {
        let is_stable =
            |result: &CycleResult| matches!(&result.cycle, Err(absence) if absence.is_stable);
        let friction = self.friction_coefficient;
        let onset = self.lowest_onset.as_ref();
        if !self.results.iter().all(is_stable)
            || onset.is_some_and(|onset| onset.friction_coefficient < friction)
        {
            return None;
        }
        Some(match onset {
            Some(onset) => format!(
                "{friction} < {:.4}: steady sliding is stable, so no limit cycle is sought; the first wave to grow has {} \
                 nodal diameters and {:.2} Hz (raise contact.friction_coefficient above {:.4})",
                onset.friction_coefficient,
                onset.harmonic,
                onset.frequency / TAU,
                onset.friction_coefficient,
            ),
            None => {
                format!("steady sliding is stable at contact.friction_coefficient = {friction}")
            }
        })
    }
}

impl CycleResult {
    /// The onset that the cycle is born at.
    pub fn birth(&self) -> Option<&Onset> {
        self.onsets.get(self.family.onset - 1)
    }
}

/// Everything a search for limit cycles reports.
#[derive(Clone, Debug)]
pub struct CycleReport<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// The mesh.
    pub mesh: &'a Mesh2d,
    /// Radius of the contact edge, m.
    pub inner_radius: f64,
    /// Thickness, m: scales powers.
    pub thickness: f64,
    /// Friction coefficient of the case.
    pub friction_coefficient: f64,
    /// The onset of lowest friction among those looked for, where there is one.
    pub lowest_onset: Option<Onset>,
    /// One entry for each harmonic.
    pub results: Vec<CycleResult>,
    /// Wall time of the run, s.
    pub wall_s: f64,
}

/// Writes all files and returns the summary.
///
/// # Errors
/// Those of the folder.
pub fn write(folder: &OutputFolder, report: &CycleReport<'_>) -> Result<Value, FolderError> {
    for result in &report.results {
        if let Ok(cycle) = &result.cycle {
            let name = format!("cycle-{}.csv", result.family.tag());
            folder.write(&name, |out| write_phases(out, cycle))?;
        }
        if let Some(branch) = &result.branch {
            let name = format!("branch-{}.csv", result.family.tag());
            folder.write(&name, |out| {
                write_branch(out, branch, &result.branch_stability, report)
            })?;
        }
        if result.stability.is_some() {
            let name = format!("stability-{}.csv", result.family.tag());
            folder.write(&name, |out| stability::write_stability(out, result))?;
        }
    }
    fields::write_fields(folder, report)?;
    write_record(folder, &CycleRecord::of(report))?;
    write_summary(folder, &summary(report, folder.manifest()))
}

/// Writes contact and motion of the edge along the phase, which is also the history of the contact node at angle zero.
///
/// # Errors
/// Those of the writer.
pub fn write_phases(out: &mut dyn Write, cycle: &LimitCycle) -> io::Result<()> {
    let columns = [
        "phase_rad",
        "time_s",
        "status",
        "pressure_pa",
        "shear_pa",
        "u_r_m",
        "u_theta_m",
        "v_r_m_per_s",
        "v_theta_m_per_s",
    ];
    let mut table = Table::new(out, &columns)?;
    for point in &cycle.points {
        let status = match point.status {
            ContactStatus::Open => "open",
            ContactStatus::Stick => "stick",
            ContactStatus::Slip => "slip",
        };
        table.row([
            format_number(point.phase),
            format_number(point.phase / cycle.state.frequency),
            status.to_owned(),
            format_number(point.pressure),
            format_number(point.shear),
            format_number(point.displacement[0]),
            format_number(point.displacement[1]),
            format_number(point.velocity[0]),
            format_number(point.velocity[1]),
        ])?;
    }
    table.finish()
}

/// Writes one row for each cycle of a branch, in the order of the branch.
///
/// # Errors
/// Those of the writer.
pub fn write_branch(
    out: &mut dyn Write,
    branch: &CycleBranch,
    stability: &[Finding],
    report: &CycleReport<'_>,
) -> io::Result<()> {
    let columns = [
        branch.parameter.key(),
        "harmonic",
        "main_frequency_hz",
        "stick",
        "slip",
        "open",
        "external_w",
        "stick_w",
        "slide_w",
        "contact_dissipated_w",
        "material_damping_w",
        "normal_contact_w",
        "amplitude_m",
        "balance_residual",
        "growth_rate_per_s",
    ];
    let mut table = Table::new(out, &columns)?;
    for (i, cycle) in branch.cycles.iter().enumerate() {
        let leading = stability.get(i).and_then(known);
        let leading = leading.and_then(CycleStability::leading);
        let powers = cycle.powers.scaled(report.thickness);
        let [stick, slip, open] = cycle.fractions;
        table.numbers(&[
            branch
                .parameter
                .in_key_units(branch.parameter.of(&cycle.state.point)),
            cycle.harmonic as f64,
            cycle.frequency_hz(),
            stick,
            slip,
            open,
            powers.external,
            powers.stick,
            powers.slide,
            powers.contact_dissipated,
            powers.material_damping,
            powers.normal_contact,
            amplitude(cycle),
            cycle.powers.balance_residual(),
            leading.map_or(f64::NAN, |leading| leading.exponent.re),
        ])?;
    }
    table.finish()
}

/// Amplitude of the wave's own harmonic of the edge's tangential displacement, m; half the peak-to-peak motion where the
/// summary's harmonics do not reach.
pub(super) fn amplitude(cycle: &LimitCycle) -> f64 {
    match cycle.harmonics.get(cycle.harmonic) {
        Some(&amplitude) => amplitude,
        None => {
            let motion = cycle.points.iter().map(|point| point.displacement[1]);
            let largest = motion.clone().fold(f64::NEG_INFINITY, f64::max);
            0.5 * (largest - motion.fold(f64::INFINITY, f64::min))
        }
    }
}
