//! Results of an explicit transient: what is printed and what is written.

mod checkpoint;
mod energy;
mod figures;
mod files;
mod run;
mod signals;
mod stages;
mod summary;
mod tables;

pub use checkpoint::{CHECKPOINT, Checkpoint, read_checkpoint, write_checkpoint};
pub use figures::draw_run;
pub use files::write;
pub(super) use files::{ENERGY, STATUS};
pub use run::{LinearStage, RecordedRun};
pub use summary::{TransientSummary, summary};
pub use tables::document;

use crate::summary::Head;
use frictionsim_physics::transient::{Recorder, StepPlan, TransientAnalysis, TransientSettings};

/// What came of a run.
#[derive(Clone, Debug)]
pub struct SolvedTransient {
    /// What was recorded.
    pub record: Recorder,
    /// What it says.
    pub analysis: TransientAnalysis,
    /// Time step and samples.
    pub plan: StepPlan,
    /// Name of the operator.
    pub operator: &'static str,
    /// Steps done since the start, those before a resume included.
    pub steps: u64,
    /// Steps done by this process.
    pub steps_timed: u64,
    /// Wall time of those steps, s.
    pub stepping_s: f64,
    /// Whether the run reached its end, or where it settles.
    pub is_finished: bool,
}

/// Everything a transient reports. Forces, powers and energies of the record are for one metre of thickness;
/// tables and summary scale them by the thickness.
#[derive(Clone, Debug)]
pub struct TransientReport<'a> {
    /// Title of the case, and wall time of the run.
    pub head: Head<'a>,
    /// What came of the run.
    pub solved: &'a SolvedTransient,
    /// Its record, and the body that it is of.
    pub run: RecordedRun<'a>,
    /// Friction coefficient, for the snapshots.
    pub friction_coefficient: f64,
    /// Choices of the run.
    pub settings: &'a TransientSettings,
    /// Probes that were asked for by their place: node, counted from 0, and place, m.
    pub places: Vec<(usize, [f64; 2])>,
    /// What to know before its numbers are used.
    pub notes: Vec<String>,
}

impl TransientReport<'_> {
    /// Elements times steps for each second of stepping.
    pub fn element_steps_per_second(&self) -> f64 {
        let body = &self.run.body;
        let layers = body.sector.map_or(1, |sector| sector.divisions()[1]);
        let elements = (layers * body.mesh.element_count()) as f64;
        let stepping_s = self.solved.stepping_s.max(f64::MIN_POSITIVE);
        elements * self.solved.steps_timed as f64 / stepping_s
    }

    /// Sine and cosine of the angle of a probe's axes, of a plane body that is no annulus about the origin.
    fn turn_of_probe(&self, probe: usize) -> Option<(f64, f64)> {
        let body = &self.run.body;
        let has_axes = !body.is_solid() && !body.mesh.is_cyclic;
        let node = self.run.record.probes[probe] - 1;
        has_axes.then(|| body.mesh.frame_angles()[node].sin_cos())
    }
}
