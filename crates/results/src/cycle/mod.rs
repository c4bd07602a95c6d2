//! Limit cycles: one outcome, one set of columns and of figures, whatever solver has found them.

mod branch;
mod branches;
mod curve;
mod fields;
mod figures;
mod motions;
mod name;
mod record;
mod summary;
mod tables;
mod two_waves;
mod verdicts;
mod waves;
mod words;

pub(super) use branch::{ALONG, BRANCH};
pub use branch::{
    BranchRecord, BranchSummary, FamilyRecord, ModeOfChange, MotionBranch, StabilityChangeSummary,
    WaveBranch,
};
pub use branches::draw_branches;
pub use motions::{FoundCycle, MotionBody, PeriodicResult};
pub use name::*;
pub(super) use record::CONTACT_NODES;
pub use record::{CycleMotion, SoundSummary, SteppedMotion};
pub use summary::*;
pub(super) use tables::{
    BALANCE, ERRORS, HARMONICS, HISTORY, KNOWN, MOTION, NAMES, PATH, POWERS, WAVE_PATH,
};
pub(super) use two_waves::TWO_WAVES;
pub use two_waves::{TwoWaveRow, TwoWaveSummary};
pub use verdicts::*;
pub use waves::{Absence, CycleResult, Finding, FoundWave};

use crate::drawing::DrawingError;
use crate::extent::Extent;
use crate::finding::{write_page, write_table, write_tables};
use crate::folder::{FolderError, OutputFolder};
use crate::summary::{CriticalSummary, Head, write_summary};
use crate::{DrawingOptions, ShownBody};
use figures::CycleFigures;
use frictionsim_physics::contact::ContactInterface;
use frictionsim_physics::cycle::CriticalValue;
use frictionsim_physics::fem::MaterialField;
use record::MotionRecord;
use serde_json::Value;

/// Everything a search for limit cycles reports.
#[derive(Clone, Debug)]
pub struct CycleReport<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// The body.
    pub body: ShownBody<'a>,
    /// What powers are of.
    pub extent: Extent,
    /// Friction coefficient of the case.
    pub friction_coefficient: f64,
    /// Where along the parameter of the case sliding loses its stability, where it is stable at its own operating
    /// point.
    pub critical: Option<CriticalValue>,
    /// What the search has started from.
    pub origin: Origin,
    /// One entry for each wave, or for each mode that grows, fastest first.
    pub cycles: Vec<SoughtCycle>,
    /// Motions of two waves that live together.
    pub two_waves: Vec<TwoWaveSummary>,
    /// Wall time of the run, s.
    pub wall_s: f64,
}

impl CycleReport<'_> {
    /// The branches, for a study that writes no tables of them.
    pub fn curves(&self) -> Vec<FamilyRecord> {
        let families = self.cycles.iter().map(|own| own.family(self.extent));
        families.filter(|own| own.mode.is_none() || own.branch.is_some()).collect()
    }

    /// What the tables and figures show of each cycle.
    fn records(&self) -> impl Iterator<Item = &MotionRecord> {
        self.cycles.iter().filter_map(|own| own.record.as_deref())
    }

    /// The contact of motions of the whole mesh.
    fn interface(&self) -> Option<&ContactInterface> {
        match &self.origin {
            Origin::Modes { interface, .. } => Some(interface),
            Origin::Waves { .. } => None,
        }
    }

    /// Whether steady sliding is stable against everything looked at.
    pub fn is_stable(&self) -> bool {
        match &self.origin {
            Origin::Waves { lowest_onset } => {
                let friction = self.friction_coefficient;
                self.cycles.iter().all(|own| own.absent.is_some())
                    && lowest_onset.is_none_or(|onset| onset.critical_friction >= friction)
            }
            Origin::Modes { least_stable, .. } => {
                least_stable.is_none_or(|mode| mode.growth_rate_per_s <= 0.0)
            }
        }
    }

    /// The summary.
    pub fn summary(&self) -> CycleSummary {
        CycleSummary {
            steady_sliding_stable: self.is_stable(),
            origin: self.origin.clone(),
            critical_value: self.critical.map(CriticalSummary::from),
            extent: self.extent,
            cycles: self.cycles.clone(),
            two_waves: self.two_waves.clone(),
            notes: self.notes(),
            curves: None,
        }
    }

    /// Writes all files and gives the summary, as it is and as an object.
    pub fn write(&self, folder: &OutputFolder) -> Result<(CycleSummary, Value), FolderError> {
        let tables = self.cycles.iter().flat_map(|own| own.tables(self.body.is_solid()));
        let pairs = self.two_waves.iter().filter_map(TwoWaveSummary::table);
        tables.chain(pairs).try_for_each(|table| write_table(folder, &table))?;
        fields::write_fields(folder, self)?;
        let summary = self.summary();
        write_tables(folder, &summary.document())?;
        let object = write_summary(folder, Head::of(self.title, self.wall_s), &summary)?;
        Ok((summary, object))
    }

    /// Draws every figure of the cycles and writes the page; `surfaces` are the contacts of an assembly, each with the
    /// boundary that has its points, `materials` those of the stress fields.
    pub fn draw(
        &self,
        folder: &OutputFolder,
        surfaces: Vec<(String, usize)>,
        materials: &dyn MaterialField,
        options: &DrawingOptions,
    ) -> Result<(), DrawingError> {
        let families = self.curves().into_iter();
        let families: Vec<_> = families.map(|own| (String::new(), own)).collect();
        let mut figures = CycleFigures::new(self, surfaces, materials).draw();
        figures.extend(draw_branches(&families, &self.two_waves));
        write_page(folder, self.summary().document().titled(self.title), figures, options)
    }
}
