//! Errors of the time loop at their keys of the case.

use crate::StudyError;
use frictionsim_case::Case;
use frictionsim_physics::transient::{Breakdown, TransientError};

/// Settings that stand in `[output]`; the others stand in `[transient]`.
const OUTPUT: [&str; 3] = ["probes", "sample_interval", "snapshots"];

/// An error of the case at its key where there is one, else of the run.
pub fn study_error(case: &Case, error: TransientError) -> StudyError {
    let (key, message, label) = match &error {
        TransientError::Setting { setting, fitting, .. } => {
            let is_output = OUTPUT.contains(setting);
            let section = if is_output { "output" } else { "transient" };
            (format!("{section}.{setting}"), format!("{section}.{error}"), fitting.clone())
        }
        TransientError::Operator(_) => {
            let label = "not on this mesh".to_owned();
            ("transient.operator".to_owned(), error.to_string(), label)
        }
        TransientError::Unstable { cause, .. } => {
            let remedy = remedy(*cause);
            return StudyError::Unstable { error, remedy };
        }
        _ => return StudyError::Transient(error),
    };
    StudyError::Case(case.error_at(&key, message, label, None))
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
