//! Explicit dynamics of the disc against the rotating cylinder, from rest to limit cycle.
//!
//! [`CentralDifference`] is the time loop: half-step central differences with a lumped mass, and an energy balance that closes to
//! round-off. Contact is by the forward increment Lagrange multipliers of [`LagrangeContact`]. It knows no files: an [`Observer`] gets a
//! [`Sample`] at fixed intervals. [`Recorder`] is the observer that keeps what results need, and [`TransientAnalysis`] reads frequencies,
//! growth and powers from it.

mod analysis;
mod boundary;
mod central_difference;
mod compliance;
mod contact;
mod error;
mod force_rows;
mod model;
mod perturbation;
mod recorder;
mod relaxation;
mod sample;
mod settings;
mod settling;
mod vibration;

pub use analysis::{Growth, LastFifth, ProbeMotion, TransientAnalysis};
pub use central_difference::{CentralDifference, EnergyAccount, RunEnd, TransientState};
pub use contact::{ContactPowers, LagrangeContact, StatusCounts};
pub use error::{Breakdown, TransientError};
pub use model::{SteppedBody, TransientModel};
pub use perturbation::{Perturbation, StandingWave};
pub use recorder::{ContactFrame, Recorder, RecorderSettings, SampleRow, Snapshot};
pub use sample::{Observer, Sample};
pub use settings::{
    InitialState, OperatorChoice, SAFETY, StepPlan, TimeStep, TransientSettings, stable_step_limit,
    whole_intervals,
};
pub use settling::{Drift, EndState, Settling, Unsettled};
pub use vibration::{TwoFrequencies, WEAKEST_LINE, rms, strongest_two};
