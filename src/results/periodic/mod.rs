//! Results of a search for the limit cycles of a body without symmetry: what is printed and what is written.

mod branch_figure;
mod figures;
mod on_bodies;
mod print;
mod record;
mod report;
mod summary;
mod tables;

pub use figures::PeriodicFigures;
pub use print::{doubt, print};
pub use record::{CurveRecord, MotionRecord, PeriodicRecord};
pub use report::draw;
pub use summary::{
    MotionSummary, MultiplierSummary, PeriodicBranchSummary, PeriodicConfirmation,
    PeriodicStability, PeriodicSummary, SoughtSummary, SoundSummary, summary, summary_of,
};

use crate::contact::ContactInterface;
use crate::cycle::CriticalValue;
use crate::cycle::periodic::{
    FloquetMultipliers, MotionConfirmation, PeriodicBranch, PeriodicMotion, Sound,
};
use crate::mesh::{Mesh, SolidSector};
use crate::results::cycle_table::write_cycles;
use crate::results::extent::Extent;
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::record::write_record;
use crate::results::summary::write_summary;
use serde_json::Value;
use std::fmt;

/// A mode of steady sliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoughtMode {
    /// Number by frequency, from 1, among the modes of the case's own friction coefficient.
    pub number: usize,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Growth rate, 1/s.
    pub growth_rate: f64,
}

/// `mode 15`.
impl fmt::Display for SoughtMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "mode {}", self.number)
    }
}

/// A limit cycle and what is known of it.
#[derive(Clone, Debug)]
pub struct FoundCycle {
    /// The motion.
    pub motion: PeriodicMotion,
    /// What its flat faces radiate, of a body that has any.
    pub sound: Option<Sound>,
    /// Harmonics in which it is told.
    pub harmonic_count: usize,
    /// Its multipliers, where they were asked for, or why there are none.
    pub stability: Option<Result<FloquetMultipliers, String>>,
    /// A transient that started beside it, where one was asked for.
    pub confirmation: Option<MotionConfirmation>,
    /// The branch through it over the parameter of the case, where one was asked for.
    pub branch: Option<PeriodicBranch>,
}

impl FoundCycle {
    /// Velocity of a kick that tips stable sliding into it, m/s, where an unstable cycle lies between both.
    pub fn kick_velocity(&self) -> Option<f64> {
        Some(self.branch.as_ref()?.threshold()?.kick_velocity())
    }
}

/// What the search from one mode has led to.
#[derive(Clone, Debug)]
pub struct PeriodicResult {
    /// The mode.
    pub mode: SoughtMode,
    /// The cycle, or why there is none.
    pub outcome: Result<FoundCycle, String>,
    /// Mode that has led to the same cycle before.
    pub same_as: Option<usize>,
    /// Case key and value at which the search has started from its mode, where no mode grows at the case's own.
    pub start: Option<(&'static str, f64)>,
    /// Wall time, s.
    pub wall_s: f64,
}

impl PeriodicResult {
    /// Part of a file name: `mode15`.
    pub fn tag(&self) -> String {
        format!("mode{}", self.mode.number)
    }

    /// The cycle, where this mode is the first to lead to it.
    pub fn own(&self) -> Option<&FoundCycle> {
        let found = self.outcome.as_ref().ok();
        found.filter(|_| self.same_as.is_none())
    }
}

/// Everything that a search reports.
#[derive(Clone, Debug)]
pub struct PeriodicReport<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// The mesh; of a body of revolution in three dimensions the section across the axis.
    pub mesh: &'a Mesh,
    /// One sector of a body of revolution in three dimensions.
    pub solid: Option<&'a SolidSector>,
    /// The contact nodes.
    pub interface: ContactInterface,
    /// Thickness, m: scales powers; 1 of a body in three dimensions.
    pub thickness: f64,
    /// What powers are of.
    pub extent: Extent,
    /// Friction coefficient of the case.
    pub friction_coefficient: f64,
    /// Modes looked at.
    pub modes: usize,
    /// Frequency of the highest, Hz.
    pub highest_hz: f64,
    /// The mode that grows fastest or decays slowest.
    pub least_stable: Option<SoughtMode>,
    /// Where sliding loses its stability, where it is stable at the case's own operating point.
    pub critical: Option<CriticalValue>,
    /// One entry for each mode that grows, fastest first.
    pub results: Vec<PeriodicResult>,
    /// Wall time of the run, s.
    pub wall_s: f64,
}

impl PeriodicReport<'_> {
    /// Whether the body is one in three dimensions.
    pub fn is_solid(&self) -> bool {
        self.solid.is_some() || self.mesh.dimension == 3
    }

    /// Displacement components of a node.
    pub fn components(&self) -> usize {
        if self.is_solid() { 3 } else { 2 }
    }

    /// Where a node of the whole body is, m.
    pub fn position(&self, node: u32) -> [f64; 3] {
        match self.solid {
            Some(sector) => {
                let (own, turn) =
                    (node as usize % sector.node_count(), node as usize / sector.node_count());
                let (sine, cosine) = sector.angle(own, turn).sin_cos();
                let place = &sector.nodes[own];
                [place.radius * cosine, place.radius * sine, place.height]
            }
            None => self.mesh.nodes[node as usize],
        }
    }

    /// Label of a node of the whole body in the case's own counting.
    pub fn node_label(&self, node: u32) -> usize {
        match self.solid {
            Some(_) => node as usize + 1,
            None => self.mesh.node_label(node as usize),
        }
    }

    /// Whether no mode looked at grows at the case's own operating point.
    pub fn is_stable(&self) -> bool {
        self.least_stable.is_none_or(|mode| mode.growth_rate <= 0.0)
    }

    /// That steady sliding is stable, in words; nothing where it is not.
    pub fn stable_sliding(&self) -> Option<String> {
        if !self.is_stable() || !self.results.is_empty() {
            return None;
        }
        let slowest = self.least_stable.map_or_else(String::new, |mode| {
            format!(
                "; the slowest to decay is {mode}, {:.2} Hz, at {:.1} 1/s",
                mode.frequency_hz, mode.growth_rate
            )
        });
        let advice = self.critical.map_or_else(
            || {
                "raise the friction coefficient; `cea` over cea.friction_coefficients finds the onsets"
                    .to_owned()
            },
            |critical| format!("it loses its stability at {critical}"),
        );
        Some(format!(
            "steady sliding is stable at contact.friction_coefficient = {}, so no limit cycle is born there: none of {} modes up \
             to {:.0} Hz grows{slowest} ({advice})",
            self.friction_coefficient, self.modes, self.highest_hz,
        ))
    }
}

/// Writes all files and returns the summary.
///
/// # Errors
/// Those of the folder.
pub fn write(folder: &OutputFolder, report: &PeriodicReport<'_>) -> Result<Value, FolderError> {
    for result in &report.results {
        if let Some(found) = result.own() {
            tables::write(folder, report, &result.tag(), found)?;
        }
    }
    write_record(folder, &PeriodicRecord::of(report))?;
    let summary = write_summary(folder, &summary(report, folder.manifest()))?;
    folder.write("cycle.csv", |out| write_cycles(out, &summary))?;
    Ok(summary)
}
