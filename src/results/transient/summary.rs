//! `summary.json` of a transient.

use super::TransientReport;
use crate::results::manifest::Manifest;
use crate::transient::Perturbation;
use serde_json::{Value, json};

/// The summary object.
pub fn summary(report: &TransientReport<'_>, manifest: &Manifest) -> Value {
    let (plan, analysis) = (&report.plan, report.analysis);
    let cycle = &analysis.limit_cycle;
    let watts = |power: f64| power * report.thickness;
    let [stick, slip, open] = cycle.status;
    let powers = &cycle.powers;
    let growth: Vec<Value> = analysis
        .growth
        .iter()
        .map(|growth| {
            json!({
                "harmonic": growth.harmonic,
                "rate_per_s": growth.rate,
                "frequency_hz": growth.frequency_hz,
                "direction": growth.direction,
            })
        })
        .collect();
    json!({
        "command": "transient",
        "title": report.title,
        "finished": report.is_finished,
        "steps": report.steps,
        "time_step_s": plan.time_step,
        "end_time_s": (report.steps.saturating_sub(1)) as f64 * plan.time_step,
        "stability_limit_s": plan.limit,
        "largest_frequency_rad_per_s": plan.largest_frequency,
        "operator": report.operator,
        "initial": report.initial,
        "perturbation": perturbation(report.perturbation),
        "wall_s": report.wall_s,
        "element_steps_per_s": report.element_steps_per_second(),
        "max_balance_residual": analysis.largest_residual,
        "main_frequency_hz": cycle.main_frequency_hz,
        "main_harmonic": cycle.main_harmonic,
        "status": { "stick": stick, "slip": slip, "open": open },
        "power_w": {
            "external": watts(powers.external),
            "stick": watts(powers.stick),
            "slide": watts(powers.slide),
            "contact_dissipated": watts(powers.contact_dissipated),
            "material_damping": watts(cycle.material_damping),
            "normal_contact": watts(powers.normal),
        },
        "harmonics": cycle.harmonics,
        "growth": growth,
        "first_nonlinearity_s": analysis.first_nonlinearity,
        "manifest": manifest,
    })
}

/// The velocity that was added: one amplitude (m/s) and phase (degrees) for all harmonics, or one for each.
fn perturbation(perturbation: &Perturbation) -> Value {
    let of_all = |values: Vec<f64>| match values.as_slice() {
        [first, others @ ..] if others.iter().all(|v| v == first) => json!(first),
        _ => json!(values),
    };
    let waves = perturbation.waves.iter();
    let phases = waves.clone().map(|wave| wave.phase.to_degrees()).collect();
    json!({
        "harmonics": perturbation.harmonics(),
        "velocity": of_all(waves.map(|wave| wave.velocity).collect()),
        "phase_deg": of_all(phases),
        "noise": perturbation.noise,
        "noise_seed": perturbation.noise_seed,
        "at_s": perturbation.time,
    })
}
