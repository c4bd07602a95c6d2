//! Limit cycles: one outcome, one set of columns and of figures, whatever solver has found them.

mod branch;
mod branches;
mod fields;
mod figures;
mod found;
mod record;
mod summary;
mod tables;
mod two_waves;
mod verdicts;
mod words;

pub use branch::{
    BranchRecord, BranchSummary, FamilyRecord, ModeOfChange, MotionBranch, StabilityChangeSummary,
    WaveBranch,
};
pub use branches::draw_branches;
pub use found::{
    Absence, CycleResult, FoundCycle, FoundWave, MotionBody, PeriodicResult, Searched,
};
pub use record::{
    CycleMotion, CycleName, ModeOfCycle, ModeSummary, OnsetSummary, SteppedMotion, WaveOfCycle,
};
pub use summary::*;
pub use two_waves::{TwoWaveRow, TwoWaveSummary};
pub use verdicts::*;

pub(super) use branch::{ALONG, BRANCH};
pub(super) use record::CONTACT_NODES;
pub(super) use tables::{
    BALANCE, ERRORS, HARMONICS, HISTORY, KNOWN, MOTION, NAMES, PATH, POWERS, WAVE_PATH,
};
pub(super) use two_waves::TWO_WAVES;
