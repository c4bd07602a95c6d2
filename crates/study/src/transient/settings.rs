//! Errors of the time loop at their keys of the case.

use crate::StudyError;
use frictionsim_case::Case;
use frictionsim_physics::transient::{Breakdown, TransientError};

/// Settings that stand in `[output]`; the others stand in `[transient]`.
const OUTPUT: [&str; 3] = ["probes", "sample_interval", "snapshots"];

/// An error of the case at its key where there is one, else of the run.
pub fn study_error(case: &Case, error: TransientError) -> StudyError {
    let label = match &error {
        TransientError::StepAboveLimit { limit, .. } => format!("at most {limit:.4e}"),
        TransientError::SampleBelowStep { step, .. } => format!("at least {step:.4e}"),
        TransientError::Time { .. } => "a positive time".to_owned(),
        TransientError::Negative { .. } => "zero or more".to_owned(),
        TransientError::BeyondEnd { duration, .. } => format!("at most {duration:?}"),
        TransientError::HarmonicAboveNyquist { limit, .. } => format!("at most {limit}"),
        TransientError::UnknownProbe { count, .. } => format!("1 to {count}"),
        TransientError::SnapshotOutsideRun { duration, .. } => format!("0 to {duration}"),
        TransientError::Unstable { cause, .. } => {
            let remedy = remedy(*cause);
            return StudyError::Unstable { error, remedy };
        }
        _ => "not on this mesh".to_owned(),
    };
    match (error.setting(), &error) {
        (Some(setting), _) => {
            let is_output = OUTPUT.contains(&setting);
            let section = if is_output { "output" } else { "transient" };
            let (key, message) = (format!("{section}.{setting}"), format!("{section}.{error}"));
            StudyError::Case(case.error_at(&key, message, label, None))
        }
        (None, TransientError::Operator(_)) => {
            StudyError::Case(case.error_at("transient.operator", error.to_string(), label, None))
        }
        _ => StudyError::Transient(error),
    }
}

/// Which keys to change after a breakdown.
fn remedy(cause: Breakdown) -> &'static str {
    match cause {
        Breakdown::Overflow => {
            "check contact.rotation_speed_rpm, contact.interference and transient.perturbation, \
             or lower transient.time_step"
        }
        Breakdown::StepTooLong => "lower transient.time_step",
        Breakdown::RoundOff => {
            "lower transient.time_step, or check contact.interference and contact.rotation_speed_rpm"
        }
    }
}
