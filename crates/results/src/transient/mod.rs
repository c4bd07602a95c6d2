//! Results of an explicit transient: what is printed and what is written.

mod checkpoint;
mod energy;
mod figures;
mod files;
mod run;
mod signals;
mod summary;
mod tables;

pub use checkpoint::{CHECKPOINT, Checkpoint, read_checkpoint, write_checkpoint};
pub use figures::draw_run;
pub use files::write;
pub(super) use files::{ENERGY, STATUS};
pub use run::{LinearStage, RecordedRun};
pub use summary::{TransientSummary, summary};
pub use tables::document;

use frictionsim_physics::transient::{Recorder, StepPlan, TransientAnalysis};

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
