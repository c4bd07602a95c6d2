//! Rules between sections.

use super::diagnostic::Diagnostic;
use super::{Case, InitialState, TimeStep};

/// Steps beyond which no machine finishes a transient.
const MOST_STEPS: f64 = 1e13;

/// Times the estimated limit beyond which a time step is unstable on any mesh like it: the estimate
/// lies less than that far below the limit of the matrices.
const UNSTABLE: f64 = 4.0;

/// Contact stiffness, in units of the modulus over the radius, that leaves no digit of the body's own.
const LARGEST_STIFFNESS: f64 = 1e14;

/// What a case that is right key by key asks for in vain.
pub(super) fn infeasible(case: &Case) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    let mut refuse = |key: &str, message: String, label: String, help: &str| {
        let help = Some(help.to_owned());
        errors.push(Diagnostic::error(message, label, case.raw.place(key), help));
    };
    if let (Some(transient), Some(cost)) = (&case.transient, case.cost().transient) {
        let (duration, interval) = (transient.duration, case.output.sample_interval);
        match transient.time_step {
            TimeStep::Seconds(step) if step > UNSTABLE * cost.stable_step => refuse(
                "transient.time_step",
                format!(
                    "transient.time_step = {step:?} s is far above the stability limit of this mesh, \
                     about {:.2e} s",
                    cost.stable_step
                ),
                format!("at most about {:.2e}", cost.stable_step),
                "lower it, or use \"auto\"",
            ),
            TimeStep::Seconds(step) if interval < step => refuse(
                "output.sample_interval",
                format!(
                    "output.sample_interval = {interval:?} s is below \
                     transient.time_step = {step:?} s"
                ),
                format!("at least {step:?}"),
                "raise it to the time step or above",
            ),
            _ => {}
        }
        let steps = duration / cost.time_step.min(interval);
        if steps > MOST_STEPS {
            refuse(
                "transient.duration",
                format!("transient.duration = {duration:?} s takes about {steps:.1e} time steps"),
                format!("at most {MOST_STEPS:e} steps"),
                "lower it, or coarsen the mesh",
            );
        }
    }
    let starts_on_cycle = case
        .transient
        .as_ref()
        .is_some_and(|transient| matches!(transient.initial, InitialState::LimitCycle { .. }));
    if starts_on_cycle && case.contact.sliding.decay.is_some() {
        refuse(
            "transient.initial",
            "transient.initial = \"limit-cycle\" needs a constant friction coefficient".to_owned(),
            "friction falls with speed".to_owned(),
            "use initial = \"steady-sliding\", or set contact.static_friction_ratio = 1.0",
        );
    }
    let scale = case.material.young_modulus / case.body.contact_length();
    if let Some(stiffness) = case.contact.stiffness.normal_stiffness
        && stiffness > LARGEST_STIFFNESS * scale
    {
        refuse(
            "contact.normal_stiffness",
            format!(
                "contact.normal_stiffness = {stiffness:e} Pa/m is {:.1e} times the modulus over the \
                 radius: round-off would drown the body",
                stiffness / scale
            ),
            format!("at most {:e}", LARGEST_STIFFNESS * scale),
            "use \"rigid\", which is exact",
        );
    }
    errors
}
