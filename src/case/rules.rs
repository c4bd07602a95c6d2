//! Rules between sections.

use super::diagnosis;
use super::diagnostic::Diagnostic;
use super::plausibility::{bar_wave_speed, material_key, modulus_key};
use super::{Case, InitialState, TimeStep};

/// Steps beyond which no machine finishes a transient.
const MOST_STEPS: f64 = 1e13;

/// Times the estimated limit beyond which a time step is unstable on any mesh like it: the estimate
/// lies less than that far below the limit of the matrices.
const UNSTABLE: f64 = 4.0;

/// Contact stiffness, in units of the modulus over the radius, that leaves no digit of the body's own.
const LARGEST_STIFFNESS: f64 = 1e14;

/// Friction coefficient beyond which nothing slides.
const LARGEST_FRICTION: f64 = 1000.0;

/// Speeds of waves in a bar that no material has, m/s.
const SLOWEST_WAVES: f64 = 1e-3;
const FASTEST_WAVES: f64 = 1e6;

/// The first friction coefficient that is none, with its key.
fn absurd_friction(case: &Case) -> Option<(&'static str, f64)> {
    let own = ("contact.friction_coefficient", case.contact.sliding.friction_coefficient);
    let cea = case.cea.iter();
    let swept = cea.flat_map(|cea| {
        let named = |key: &'static str, values: &[f64]| -> Vec<(&'static str, f64)> {
            values.iter().map(|value| (key, *value)).collect()
        };
        let swept = named("cea.friction_coefficients", &cea.friction_coefficients);
        swept.into_iter().chain(named("cea.shapes_at", &cea.shapes_at))
    });
    let mut all = std::iter::once(own).chain(swept);
    all.find(|(_, value)| *value > LARGEST_FRICTION)
}

/// What a case that is right key by key asks for in vain.
pub(super) fn infeasible(case: &Case) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    if let (Some(transient), Some(cost)) = (&case.transient, case.cost().transient) {
        let (duration, interval) = (transient.duration, case.output.sample_interval);
        match transient.time_step {
            TimeStep::Seconds(step) if step > UNSTABLE * cost.stable_step => {
                errors.push(diagnosis!(
                case, "transient.time_step",
                "transient.time_step = {step:?} s is far above the stability limit of this mesh, \
                 about {:.2e} s", cost.stable_step;
                "at most about {:.2e}", cost.stable_step; "lower it, or use \"auto\""))
            }
            TimeStep::Seconds(step) if interval < step => errors.push(diagnosis!(
                case, "output.sample_interval",
                "output.sample_interval = {interval:?} s is below transient.time_step = {step:?} s";
                "at least {step:?}"; "raise it to the time step or above")),
            _ => {}
        }
        let steps = duration / cost.time_step.min(interval);
        if steps > MOST_STEPS {
            errors.push(diagnosis!(case, "transient.duration",
                "transient.duration = {duration:?} s takes about {steps:.1e} time steps";
                "at most {MOST_STEPS:e} steps"; "lower it, or coarsen the mesh"));
        }
    }
    if let Some((key, value)) = absurd_friction(case) {
        errors.push(diagnosis!(case, key, "{key} = {value:e} is beyond any friction coefficient";
            "at most {LARGEST_FRICTION}";
            "a friction coefficient is the ratio of tangential and normal force"));
    }
    let speed = bar_wave_speed(case);
    if !(SLOWEST_WAVES..=FASTEST_WAVES).contains(&speed) {
        let key = modulus_key(case);
        errors.push(diagnosis!(case, &key,
            "{key} = {:e} Pa and {} = {:e} kg/m3 give waves of {speed:.1e} m/s, as no material has \
             them", case.material.young_modulus, material_key(case, "density"), case.material.density;
            "waves of {SLOWEST_WAVES:e} to {FASTEST_WAVES:e} m/s"; "a case is in SI: Pa and kg/m3"));
    }
    let perturbation = case.transient.as_ref().map(|run| &run.perturbation);
    let seeds = perturbation.iter().flat_map(|seeds| {
        let waves = seeds.waves.iter().map(|wave| wave.velocity.abs());
        waves.chain([seeds.noise])
    });
    let fastest = seeds.fold(0.0, f64::max);
    if fastest > speed {
        errors.push(diagnosis!(case, "transient.perturbation.velocity",
            "transient.perturbation: a seed of {fastest:e} m/s is faster than waves in the \
             material, {speed:.0} m/s";
            "below {speed:.0} m/s"; "give metres per second, about 1e-3 for a linear stage"));
    }
    let starts_on_cycle = case
        .transient
        .as_ref()
        .is_some_and(|transient| matches!(transient.initial, InitialState::LimitCycle { .. }));
    if starts_on_cycle && case.contact.sliding.decay.is_some() {
        errors.push(diagnosis!(case, "transient.initial",
            "transient.initial = \"limit-cycle\" needs a constant friction coefficient";
            "friction falls with speed";
            "use initial = \"steady-sliding\", or set contact.static_friction_ratio = 1.0"));
    }
    if starts_on_cycle && case.contact.stiffness.law.is_some() {
        errors.push(diagnosis!(case, "transient.initial",
            "transient.initial = \"limit-cycle\" is a rotating wave of rigid contact, whose \
             pressure is another one than on a contact that stiffens";
            "contact.normal_law is not linear";
            "use initial = \"steady-sliding\", or leave contact.normal_law out"));
    }
    let scale = case.material.young_modulus / case.body.contact_length();
    let mut springs = case.springs().into_iter();
    if let Some(springs) = springs.find(|own| own.stiffness > LARGEST_STIFFNESS * scale) {
        errors.push(diagnosis!(case, &springs.key(),
            "{} = {:e} Pa/m is {:.1e} times the modulus over the radius: round-off would drown the \
             body", springs.name(), springs.stiffness, springs.stiffness / scale;
            "at most {:e}", LARGEST_STIFFNESS * scale; "{}", case.rigid_remedy(&springs)));
    }
    errors
}
