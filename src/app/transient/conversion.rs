//! From the case's terms to those of the time loop, and its errors back to keys of the case.

use crate::app::Failure;
use crate::case::{Case, Transient};
use crate::mesh::AnnulusMesh;
use crate::transient::{
    InitialState, Perturbation, RecorderSettings, TransientError, TransientModel, TransientSettings,
};

pub fn model<'a>(case: &Case, annulus: &'a AnnulusMesh) -> TransientModel<'a> {
    TransientModel {
        annulus,
        material: case.material,
        damping: case.damping.rayleigh,
        contact: case.contact.sliding,
    }
}

pub fn settings(case: &Case, transient: &Transient) -> TransientSettings {
    TransientSettings {
        duration: transient.duration,
        time_step: transient.time_step,
        sample_interval: case.output.sample_interval,
        expansion_time: transient.expansion_time,
        initial: transient.initial,
        perturbation: Perturbation {
            harmonics: transient.perturbation.harmonics.clone(),
            velocity: transient.perturbation.velocity,
        },
    }
}

pub fn initial_name(transient: &Transient) -> &'static str {
    match transient.initial {
        InitialState::Rest => "rest",
        InitialState::SteadySliding => "steady-sliding",
        InitialState::LimitCycle { .. } => "limit-cycle",
    }
}

pub fn recorder_settings(case: &Case) -> RecorderSettings {
    RecorderSettings {
        probes: case.output.probes.clone(),
        snapshots: case.output.snapshots.clone(),
    }
}

/// An error of the case at its key where there is one, else of the run.
pub fn failure(case: &Case, error: &TransientError) -> Failure {
    let (key, label) = match error {
        TransientError::StepAboveLimit { limit, .. } => {
            ("transient.time_step", format!("at most {limit:.4e}"))
        }
        TransientError::SampleBelowStep { step, .. } => {
            ("output.sample_interval", format!("at least {step:.4e}"))
        }
        TransientError::Time { key, .. } => (*key, "a positive time".to_owned()),
        TransientError::Negative { key, .. } => (*key, "zero or more".to_owned()),
        TransientError::HarmonicAboveNyquist { limit, .. } => (
            "transient.perturbation.harmonics",
            format!("at most {limit}"),
        ),
        TransientError::UnknownProbe { count, .. } => ("output.probes", format!("1 to {count}")),
        TransientError::SnapshotOutsideRun { duration, .. } => {
            ("output.snapshots", format!("0 to {duration}"))
        }
        TransientError::Operator(_) => ("transient.operator", "not on this mesh".to_owned()),
        TransientError::Unstable { .. }
        | TransientError::ForeignState { .. }
        | TransientError::FieldsMissing { .. }
        | TransientError::Prestress(_) => return Failure::run(error),
    };
    Failure::Case(case.error_at(key, error.to_string(), label, None))
}
