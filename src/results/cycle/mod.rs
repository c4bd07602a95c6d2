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
pub use branches::{NamedFamily, draw_branches};
pub use figures::CycleFigures;
pub use motions::{FoundCycle, PeriodicResult};
pub use record::MotionRecord;
pub use summary::*;
pub(super) use tables::{
    BALANCE, CONTACT_NODES, ERRORS, HARMONICS, HISTORY, KNOWN, MOTION, NAMES, PATH, POWERS,
    WAVE_PATH,
};
pub(super) use two_waves::TWO_WAVES;
pub use two_waves::{FoundTwoWaves, TwoWaveResult, TwoWaveSummary};
pub use verdicts::*;
pub use waves::{Absence, CycleResult, Finding, known};

use crate::contact::{ContactInterface, SlidingContact};
use crate::cycle::periodic::MotionHarmonic;
use crate::cycle::{CriticalValue, Onset, PhasePoint};
use crate::results::drawing::DrawingError;
use crate::results::extent::Extent;
use crate::results::finding::{write_page, write_table, write_tables};
use crate::results::folder::{FolderError, OutputFolder};
use crate::results::summary::{CriticalSummary, Head, write_summary};
use crate::results::{DrawingOptions, ShownBody};
use branch::BranchRow;
use motions::ContactNode;
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

/// What the tables of a cycle are made from.
struct Told {
    /// Part of their names.
    tag: String,
    is_wave: bool,
    history: Vec<PhasePoint>,
    nodes: Vec<ContactNode>,
    archive: Option<Vec<u8>>,
    harmonics: Vec<(usize, f64, MotionHarmonic)>,
    /// Whether there is a table of exponents, if of none.
    has_exponents: bool,
    /// Key of the parameter of the branch.
    key: Option<&'static str>,
    /// Exponents, those of waves with the value of that parameter.
    exponents: Vec<(Option<f64>, Perturbation)>,
    branch: Option<Vec<BranchRow>>,
}

impl CycleReport<'_> {
    /// Every cycle that was sought.
    pub fn cycles(&self) -> Vec<SoughtCycle> {
        match &self.search {
            Search::Waves(search) => {
                search.results.iter().map(|result| result.sought(self, search)).collect()
            }
            Search::Motions(search) => {
                search.results.iter().map(|result| result.sought(self, search)).collect()
            }
        }
    }

    /// The branches, for a study that writes no tables of them.
    pub fn curves(&self) -> Vec<FamilyRecord> {
        match &self.search {
            Search::Waves(search) => {
                let all = search.results.iter();
                all.map(|own| own.family_record(self, search.inner_radius)).collect()
            }
            Search::Motions(search) => {
                let all = search.results.iter();
                all.filter_map(|own| own.family_record(self)).collect()
            }
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
        let (origin, two_waves) = match &self.search {
            Search::Waves(search) => {
                let lowest_onset = search.lowest_onset.as_ref().map(OnsetSummary::from);
                let pairs = search.two_waves.iter().map(|own| own.summary(self.thickness));
                (Origin::Waves(WavesSought { lowest_onset }), pairs.collect())
            }
            Search::Motions(search) => {
                let MotionSearch { modes, least_stable, .. } = *search;
                (Origin::Modes(ModesSought { modes, least_stable }), Vec::new())
            }
        };
        CycleSummary {
            steady_sliding_stable: self.is_stable(),
            origin,
            critical_value: self.critical.map(CriticalSummary::from),
            extent: self.extent,
            cycles: self.cycles(),
            two_waves,
            notes: self.notes(),
            curves: None,
        }
    }

    /// Writes all files and gives the summary, as it is and as an object.
    pub fn write(&self, folder: &OutputFolder) -> Result<(CycleSummary, Value), FolderError> {
        let told: std::io::Result<Vec<Told>> = match &self.search {
            Search::Waves(search) => search.results.iter().map(|own| Ok(own.told(self))).collect(),
            Search::Motions(search) => {
                let all = search.results.iter();
                all.filter_map(|own| own.told(self, search).transpose()).collect()
            }
        };
        let told = told.map_err(|error| FolderError::io("write", folder.path(), error))?;
        for own in &told {
            own.tables(self.body.is_solid())
                .iter()
                .try_for_each(|table| write_table(folder, table))?;
            if let Some(archive) = &own.archive {
                let name = format!("contact-{}.npz", own.tag);
                folder.write_bulk(&name, |out| out.write_all(archive))?;
            }
        }
        fields::write_fields(folder, self)?;
        if let Search::Waves(search) = &self.search {
            let mut pairs = search.two_waves.iter().filter_map(|own| own.table(self.thickness));
            pairs.try_for_each(|table| write_table(folder, &table))?;
        }
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
        let families = data.report.curves();
        let families: Vec<NamedFamily<'_>> =
            families.iter().map(|own| (String::new(), own)).collect();
        let two_waves = match &data.report.search {
            Search::Waves(search) => &search.two_waves[..],
            Search::Motions(_) => &[],
        };
        let mut figures = figures::draw_cycles(data)?;
        figures.extend(draw_branches(&families, two_waves)?);
        write_page(folder, self.document().titled(data.report.title), figures, options)
    }
}
