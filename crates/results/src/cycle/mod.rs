//! Limit cycles: one outcome, one set of columns and of figures, whatever solver has found them.

mod branch;
mod branches;
mod curve;
mod fields;
mod figures;
mod motions;
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
pub use figures::CycleFigures;
pub use motions::{FoundCycle, PeriodicResult};
pub use summary::*;
pub(super) use tables::{
    BALANCE, CONTACT_NODES, ERRORS, HARMONICS, HISTORY, KNOWN, MOTION, NAMES, PATH, POWERS,
    WAVE_PATH,
};
pub(super) use two_waves::TWO_WAVES;
pub use two_waves::{FoundTwoWaves, TwoWaveResult, TwoWaveSummary};
pub use verdicts::*;
pub use waves::{Absence, CycleResult, Finding};

use crate::drawing::DrawingError;
use crate::extent::Extent;
use crate::finding::{write_page, write_table, write_tables};
use crate::folder::{FolderError, OutputFolder};
use crate::summary::{CriticalSummary, Head, write_summary};
use crate::{DrawingOptions, ShownBody};
use frictionsim_physics::contact::{ContactInterface, SlidingContact};
use frictionsim_physics::cycle::{CriticalValue, Onset};
use record::MotionRecord;
use serde_json::Value;

/// Everything a search for limit cycles reports.
#[derive(Clone, Debug)]
pub struct CycleReport<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// The body.
    pub body: ShownBody<'a>,
    /// Thickness, m: scales powers; 1 of a body in three dimensions.
    pub thickness: f64,
    /// What powers are of.
    pub extent: Extent,
    /// Friction coefficient of the case.
    pub friction_coefficient: f64,
    /// Where along the parameter of the case sliding loses its stability, where it is stable at its own operating
    /// point.
    pub critical: Option<CriticalValue>,
    /// What was sought, and found.
    pub search: Search,
    /// Wall time of the run, s.
    pub wall_s: f64,
}

/// What was sought, and found.
#[derive(Clone, Debug)]
pub enum Search {
    /// Rotating waves of a disc.
    Waves(WaveSearch),
    /// Motions of the whole mesh.
    Motions(MotionSearch),
}

/// A search for rotating waves.
#[derive(Clone, Debug)]
pub struct WaveSearch {
    /// Radius of the contact edge, m.
    pub inner_radius: f64,
    /// The contact at the case's own operating point.
    pub contact: SlidingContact,
    /// The onset of lowest friction among those looked for, where there is one.
    pub lowest_onset: Option<Onset>,
    /// One entry for each family.
    pub results: Vec<CycleResult>,
    /// Motions of two waves that live together.
    pub two_waves: Vec<TwoWaveResult>,
}

/// A search for motions of the whole mesh.
#[derive(Clone, Debug)]
pub struct MotionSearch {
    /// The contact nodes.
    pub interface: ContactInterface,
    /// Modes looked at.
    pub modes: usize,
    /// Frequency of the highest, Hz.
    pub highest_hz: f64,
    /// The mode that grows fastest or decays slowest.
    pub least_stable: Option<ModeSummary>,
    /// One entry for each mode that grows, fastest first.
    pub results: Vec<PeriodicResult>,
}

impl CycleReport<'_> {
    /// What is said of each wave or of each mode that was sought from.
    fn each<T>(
        &self,
        of_wave: impl Fn(&CycleResult, &WaveSearch) -> T,
        of_mode: impl Fn(&PeriodicResult, &MotionSearch) -> T,
    ) -> Vec<T> {
        match &self.search {
            Search::Waves(search) => {
                search.results.iter().map(|own| of_wave(own, search)).collect()
            }
            Search::Motions(search) => {
                search.results.iter().map(|own| of_mode(own, search)).collect()
            }
        }
    }

    /// Every cycle that was sought.
    pub fn cycles(&self) -> Vec<SoughtCycle> {
        self.each(|own, search| own.sought(self, search), |own, search| own.sought(self, search))
    }

    /// The branches, for a study that writes no tables of them.
    pub fn curves(&self) -> Vec<FamilyRecord> {
        let thickness = self.thickness;
        let branches =
            self.each(|own, _| own.branch_rows(thickness), |own, _| own.branch_rows(thickness));
        let cycles = self.cycles().into_iter().zip(branches);
        let families = cycles.map(|(own, rows)| FamilyRecord::of(own, rows, self.extent));
        families.filter(|own| own.mode.is_none() || own.branch.is_some()).collect()
    }

    /// What the tables and figures show of each cycle.
    fn records(&self) -> Vec<MotionRecord> {
        let records = self
            .each(|own, search| own.record(self, search), |own, search| own.record(self, search));
        records.into_iter().flatten().collect()
    }

    /// The motions of two waves that were sought.
    fn two_waves(&self) -> &[TwoWaveResult] {
        match &self.search {
            Search::Waves(search) => &search.two_waves,
            Search::Motions(_) => &[],
        }
    }

    /// Whether steady sliding is stable against everything looked at.
    pub fn is_stable(&self) -> bool {
        match &self.search {
            Search::Waves(search) => search.is_stable(self.friction_coefficient),
            Search::Motions(search) => search.is_stable(),
        }
    }

    /// The summary.
    pub fn summary(&self) -> CycleSummary {
        let origin = match &self.search {
            Search::Waves(search) => {
                let lowest_onset = search.lowest_onset.as_ref().map(OnsetSummary::from);
                Origin::Waves { lowest_onset }
            }
            Search::Motions(search) => {
                Origin::Modes { modes: search.modes, least_stable: search.least_stable }
            }
        };
        let two_waves = self.two_waves().iter().map(|own| own.summary(self.thickness));
        CycleSummary {
            steady_sliding_stable: self.is_stable(),
            origin,
            critical_value: self.critical.map(CriticalSummary::from),
            extent: self.extent,
            cycles: self.cycles(),
            two_waves: two_waves.collect(),
            notes: self.notes(),
            curves: None,
        }
    }

    /// Writes all files and gives the summary, as it is and as an object.
    pub fn write(&self, folder: &OutputFolder) -> Result<(CycleSummary, Value), FolderError> {
        let records = self.records();
        let tables = records.iter().flat_map(|own| own.tables(self.body.is_solid()));
        let pairs = self.two_waves().iter().filter_map(|own| own.table(self.thickness));
        tables.chain(pairs).try_for_each(|table| write_table(folder, &table))?;
        fields::write_fields(folder, self)?;
        let summary = self.summary();
        write_tables(folder, &summary.document())?;
        let object = write_summary(folder, Head::of(self.title, self.wall_s), &summary)?;
        Ok((summary, object))
    }
}

impl CycleSummary {
    /// Draws every figure of the cycles and writes the page.
    pub fn draw(
        &self,
        folder: &OutputFolder,
        data: &CycleFigures<'_>,
        options: &DrawingOptions,
    ) -> Result<(), DrawingError> {
        let families = data.report.curves().into_iter();
        let families: Vec<_> = families.map(|own| (String::new(), own)).collect();
        let mut figures = figures::draw_cycles(data);
        figures.extend(draw_branches(&families, data.report.two_waves()));
        write_page(folder, self.document().titled(data.report.title), figures, options)
    }
}
