//! Results of a search for limit cycles: what is printed and what is written.

mod confirmation;
mod fields;
mod print;
mod stability;
mod summary;
mod two_waves;

pub use confirmation::ConfirmationSummary;
pub use confirmation::doubt;
pub use fields::CycleFrame;
pub use print::print;
pub use stability::{ExponentSummary, Finding, StabilitySummary, known};
pub use summary::{CycleSummary, FamilySummary, LimitCycleSummary, summary};
pub use two_waves::{FoundTwoWaves, TwoWaveResult, TwoWaveSummary};

use crate::cycle::{
    Confirmation, CriticalValue, CycleBranch, CyclePowers, CycleStability, Family, LimitCycle,
    Onset, PhasePoint, StabilityChange,
};
use crate::mesh::Mesh;
use crate::results::cycle_figures::CycleRecord;
use crate::results::cycle_table::write_cycles;
use crate::results::extent::Extent;
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::record::write_record;
use crate::results::summary::write_summary;
use crate::results::table::{Column, write_rows};
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
    /// Root mean square of the velocity of that cycle over the mass that moves, m/s.
    pub velocity: Option<f64>,
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
                 nodal diameters and {:.2} Hz ({})",
                onset.friction_coefficient,
                onset.harmonic,
                onset.frequency / TAU,
                match self.critical {
                    Some(critical) => format!("sliding loses its stability at {critical}"),
                    None => format!(
                        "raise contact.friction_coefficient above {:.4}",
                        onset.friction_coefficient
                    ),
                },
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
    pub mesh: &'a Mesh,
    /// Radius of the contact edge, m.
    pub inner_radius: f64,
    /// Thickness, m: scales powers.
    pub thickness: f64,
    /// What powers are of.
    pub extent: Extent,
    /// Friction coefficient of the case.
    pub friction_coefficient: f64,
    /// The onset of lowest friction among those looked for, where there is one.
    pub lowest_onset: Option<Onset>,
    /// Where along the parameter of the case sliding loses its stability, where it is stable at its own operating point.
    pub critical: Option<CriticalValue>,
    /// One entry for each harmonic.
    pub results: Vec<CycleResult>,
    /// Motions of two waves that live together.
    pub two_waves: Vec<TwoWaveResult>,
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
            folder
                .write(&name, |out| write_branch(out, branch, &result.branch_stability, report))?;
        }
        if result.stability.is_some() {
            let name = format!("stability-{}.csv", result.family.tag());
            folder.write(&name, |out| stability::write_stability(out, result))?;
        }
    }
    two_waves::write_two_waves(folder, report)?;
    fields::write_fields(folder, report)?;
    write_record(folder, &CycleRecord::of(report))?;
    let summary = write_summary(folder, &summary(report, folder.manifest()))?;
    folder.write("cycle.csv", |out| write_cycles(out, &summary))?;
    Ok(summary)
}

/// Writes contact and motion of the edge along the phase, which is also the history of the contact node at angle zero.
///
/// # Errors
/// Those of the writer.
pub fn write_phases(out: &mut dyn Write, cycle: &LimitCycle) -> io::Result<()> {
    let columns: &[Column<'_, &PhasePoint>] = &[
        ("phase_rad", &|point| point.phase.into()),
        ("time_s", &|point| (point.phase / cycle.state.frequency).into()),
        ("status", &|point| point.status.name().into()),
        ("pressure_pa", &|point| point.pressure.into()),
        ("shear_pa", &|point| point.shear.into()),
        ("u_r_m", &|point| point.displacement[0].into()),
        ("u_theta_m", &|point| point.displacement[1].into()),
        ("v_r_m_per_s", &|point| point.velocity[0].into()),
        ("v_theta_m_per_s", &|point| point.velocity[1].into()),
    ];
    write_rows(out, columns, &cycle.points)
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
    type Row<'a> = (&'a LimitCycle, CyclePowers, f64);
    let value = |cycle: &LimitCycle| {
        let value = branch.parameter.of(&cycle.state.point);
        branch.parameter.in_key_units(value)
    };
    let columns: &[Column<'_, Row<'_>>] = &[
        (branch.parameter.key(), &|row| value(row.0).into()),
        ("harmonic", &|row| row.0.harmonic.into()),
        ("main_frequency_hz", &|row| row.0.frequency_hz().into()),
        ("stick", &|row| row.0.fractions[0].into()),
        ("slip", &|row| row.0.fractions[1].into()),
        ("open", &|row| row.0.fractions[2].into()),
        ("external_w", &|row| row.1.external.into()),
        ("stick_w", &|row| row.1.stick.into()),
        ("slide_w", &|row| row.1.slide.into()),
        ("contact_dissipated_w", &|row| row.1.contact_dissipated.into()),
        ("material_damping_w", &|row| row.1.material_damping.into()),
        ("normal_contact_w", &|row| row.1.normal_contact.into()),
        ("amplitude_m", &|row| amplitude(row.0).into()),
        ("balance_residual", &|row| row.0.powers.balance_residual().into()),
        ("growth_rate_per_s", &|row| row.2.into()),
    ];
    let rows = branch.cycles.iter().enumerate().map(|(i, cycle)| {
        let leading = stability.get(i).and_then(known);
        let leading = leading.and_then(CycleStability::leading);
        let growth = leading.map_or(f64::NAN, |leading| leading.exponent.re);
        (cycle, cycle.powers.scaled(report.thickness), growth)
    });
    write_rows(out, columns, rows)
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
