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
pub use record::{CycleMotion, SteppedMotion};
pub use summary::*;
pub(super) use tables::{
    BALANCE, ERRORS, HARMONICS, HISTORY, KNOWN, MOTION, NAMES, PATH, POWERS, WAVE_PATH,
};
pub(super) use two_waves::TWO_WAVES;
pub use two_waves::{TwoWaveRow, TwoWaveSummary};
pub use verdicts::*;
pub use waves::{Absence, CycleResult, Finding, FoundWave};

use crate::ShownBody;
use crate::finding::write_table;
use crate::folder::{FolderError, OutputFolder};
use figures::CycleFigures;
use frictionsim_chart::Figure;
use frictionsim_physics::fem::MaterialField;

impl CycleSummary {
    /// Writes what its document has no table of: each cycle over its period and along its branch, and whole fields of
    /// the body.
    pub fn write(&self, folder: &OutputFolder, body: &ShownBody<'_>) -> Result<(), FolderError> {
        let tables = self.cycles.iter().flat_map(|own| own.tables(body.is_solid()));
        let pairs = self.two_waves.iter().filter_map(TwoWaveSummary::table);
        tables.chain(pairs).try_for_each(|table| write_table(folder, &table))?;
        fields::write_fields(folder, body, self)
    }

    /// Every figure of the cycles; `surfaces` are the contacts of an assembly, each with the boundary that has its
    /// points, `materials` those of the stress fields.
    pub fn figures(
        &self,
        body: &ShownBody<'_>,
        surfaces: Vec<(String, usize)>,
        materials: &dyn MaterialField,
    ) -> Vec<Figure> {
        let families = self.families().into_iter();
        let families: Vec<_> = families.map(|own| (String::new(), own)).collect();
        let mut figures = CycleFigures::new(self, body, surfaces, materials).draw();
        figures.extend(draw_branches(&families, &self.two_waves));
        figures
    }
}
