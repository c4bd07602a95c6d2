//! Transients that cannot run, or hardly show what they are meant to.

use super::{Limit, contact::lame_pressure, material::bar_wave_speed};
use crate::*;
use crate::{InitialState, TimeStep};

/// Steps beyond which no machine finishes a transient.
const MOST_STEPS: f64 = 1e13;
/// Times the estimated limit beyond which a time step is unstable on any mesh like it: the estimate
/// lies less than that far below the limit of the matrices.
const UNSTABLE: f64 = 4.0;
/// Share of the speed of bar waves beyond which a seeded velocity is no small strain.
const LARGEST_SEED: f64 = 0.01;

/// A time step that is unstable, or longer than the samples.
pub(super) fn time_step(case: &Case) -> Option<Diagnostic> {
    let TimeStep::Seconds(step) = case.transient.as_ref()?.settings.time_step else { return None };
    let (stable, interval) = (case.cost().transient?.stable_step, case.output.sample_interval);
    if step > UNSTABLE * stable {
        return Some(diagnosis!(case, "transient.time_step",
            "transient.time_step = {step:?} s is far above the stability limit of this mesh, about \
             {stable:.2e} s"; "at most about {stable:.2e}"; "lower it, or use \"auto\""));
    }
    (interval < step).then(|| {
        diagnosis!(case, "output.sample_interval",
            "output.sample_interval = {interval:?} s is below transient.time_step = {step:?} s";
            "at least {step:?}"; "raise it to the time step or above")
    })
}

/// A run that no machine finishes.
pub(super) fn duration(case: &Case) -> Option<Diagnostic> {
    let duration = case.transient.as_ref()?.settings.duration;
    let steps = duration / case.cost().transient?.time_step.min(case.output.sample_interval);
    (steps > MOST_STEPS).then(|| {
        diagnosis!(case, "transient.duration",
            "transient.duration = {duration:?} s takes about {steps:.1e} time steps";
            "at most {MOST_STEPS:e} steps"; "lower it, or coarsen the mesh")
    })
}

/// A start on a limit cycle that is no rotating wave.
pub(super) fn start(case: &Case) -> Option<Diagnostic> {
    let InitialState::LimitCycle { .. } = case.transient.as_ref()?.settings.initial else {
        return None;
    };
    let [what, label, remedy] = case.body.without_waves(&case.contact)?;
    Some(diagnosis!(case, "transient.initial", "transient.initial = \"limit-cycle\" {what}";
        "{label}"; "use initial = \"steady-sliding\", or {remedy}"))
}

/// Seeded velocities whose strain, `v / c`, is not small.
pub(super) fn seeds(case: &Case) -> Option<Limit> {
    let perturbation = &case.transient.as_ref()?.settings.perturbation;
    let waves = perturbation.waves.iter().map(|wave| wave.velocity.abs());
    let wave = waves.fold(0.0, f64::max);
    let (key, largest) = match wave >= perturbation.noise {
        true => ("transient.perturbation.velocity", wave),
        false => ("transient.perturbation.noise", perturbation.noise),
    };
    let speed = bar_wave_speed(case);
    let share = largest / speed;
    (share > LARGEST_SEED).then(|| {
        let said = diagnosis!(case, key,
            "{key}: a seed of {largest:e} m/s is {share:.1e} times the speed of waves in the \
             material, {speed:.1e} m/s: its strains are not small"; "metres per second?";
            "seeds of a linear stage are about 1e-3 m/s, or with relative = true a small share of the slip speed");
        Limit { is_possible: share <= 1.0, said }
    })
}

/// Half the mass of a contact element for each unit of edge (kg/m2), and the time step of the transient of a generated
/// body.
fn edge_inertia(case: &Case) -> Option<[f64; 2]> {
    let grid = case.body.grid()?;
    let step = case.cost().transient?.time_step;
    let depth = (grid.outer_radius - grid.inner_radius) / grid.radial_elements as f64;
    let mass = 0.5 * case.material.density * depth;
    Some([mass, step])
}

/// Springs whose own motion of the contact nodes the time step does not resolve, `k dt^2 > 4 m`: those of contact that
/// stiffens at the pressure of rigid contact.
pub(super) fn unresolved_springs(case: &Case) -> Option<Diagnostic> {
    let springs = case.springs().into_iter().next()?;
    let [mass, step] = edge_inertia(case)?;
    let most = 4.0 * mass / (step * step);
    let pressed = springs.law.zip(lame_pressure(case));
    let (stiffness, name) = match pressed {
        Some((law, pressure)) => (
            law.stiffness(law.approach(pressure)),
            format!("the stiffness of the contact at {pressure:.1e} Pa"),
        ),
        None => (springs.stiffness, springs.name.clone()),
    };
    (stiffness > most).then(|| {
        diagnosis!(case, &springs.key,
            "{name} = {stiffness:e} Pa/m is more than the time step of the transient, {step:.2e} s, resolves on this \
             mesh, about {most:.1e} Pa/m. The status of contact nodes would flicker";
            "nearly rigid"; "{}, or a smaller transient.time_step", case.rigid_remedy(&springs))
    })
}

/// Friction that falls faster with speed than the inertia of contact nodes allows, `dt p |mu'(0)| > m`.
pub(super) fn steep_friction(case: &Case) -> Option<Diagnostic> {
    let contact = &case.contact.sliding;
    let decay = contact.decay?;
    let [mass, step] = edge_inertia(case)?;
    let fall = contact.friction_coefficient * decay.steepest_fall();
    let most = mass / (lame_pressure(case)? * fall);
    (step > most).then(|| {
        diagnosis!(case, "contact.decay_speed",
            "contact.decay_speed = {} m/s lets friction fall faster than the contact nodes can \
             follow within a time step of the transient, {step:.2e} s. Nodes may jump between \
             sticking and slipping", decay.decay_speed; "a steep law";
            "use a transient.time_step below about {most:.1e}, or a larger contact.decay_speed")
    })
}
