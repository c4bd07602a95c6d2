//! The summary of a search for limit cycles.

use super::confirmation::confirmation_object;
use super::stability::stability_object;
use super::{CycleReport, CycleResult};
use crate::cycle::{CycleBranch, LimitCycle, Onset};
use crate::results::manifest::Manifest;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// The summary object.
pub fn summary(report: &CycleReport<'_>, manifest: &Manifest) -> Value {
    let cycles: Vec<Value> = report
        .results
        .iter()
        .map(|result| result_object(report, result))
        .collect();
    json!({
        "command": "cycle",
        "title": report.title,
        "wall_s": report.wall_s,
        "steady_sliding_stable": report.stable_sliding().is_some(),
        "lowest_onset": report.lowest_onset.as_ref().map(onset_object),
        "cycles": cycles,
        "manifest": manifest,
    })
}

fn result_object(report: &CycleReport<'_>, result: &CycleResult) -> Value {
    let onsets: Vec<Value> = result.onsets.iter().map(onset_object).collect();
    let mut object = json!({
        "harmonic": result.family.harmonic,
        "onset": result.family.onset,
        "critical_friction": result.birth().map(|onset| onset.friction_coefficient),
        "direction": result.birth().map(|onset| onset.direction),
        "phases": result.phases,
        "onsets": onsets,
        "wall_s": result.wall_s,
    });
    match &result.cycle {
        Ok(cycle) => {
            let found = cycle_object(report, cycle);
            let found = found.as_object().into_iter().flatten();
            for (key, value) in found {
                object[key] = value.clone();
            }
        }
        Err(absence) if absence.is_stable => object["absent"] = json!(absence.reason),
        Err(absence) => object["error"] = json!(absence.reason),
    }
    object["confirmation"] = confirmation_object(report, result);
    object["stability"] = stability_object(&result.stability);
    if let Some(branch) = &result.branch {
        object["branch"] = branch_object(report, branch);
        let changes = result.stability_changes.iter();
        let changes = changes.map(|change| {
            json!({
                "at": branch.parameter.in_key_units(change.value),
                "harmonic": change.harmonic,
                "frequency_hz": change.frequency_hz,
            })
        });
        object["branch"]["stability_changes"] = changes.collect();
    }
    object
}

fn onset_object(onset: &Onset) -> Value {
    json!({
        "harmonic": onset.harmonic,
        "direction": onset.direction,
        "critical_friction": onset.friction_coefficient,
        "frequency_hz": onset.frequency / TAU,
    })
}

fn cycle_object(report: &CycleReport<'_>, cycle: &LimitCycle) -> Value {
    let powers = cycle.powers.scaled(report.thickness);
    let [stick, slip, open] = cycle.fractions;
    json!({
        "main_frequency_hz": cycle.frequency_hz(),
        "status": { "stick": stick, "slip": slip, "open": open },
        "power_w": {
            "external": powers.external,
            "stick": powers.stick,
            "slide": powers.slide,
            "contact_dissipated": powers.contact_dissipated,
            "material_damping": powers.material_damping,
            "normal_contact": powers.normal_contact,
        },
        "harmonics": cycle.harmonics,
        "balance_residual": cycle.powers.balance_residual(),
    })
}

fn branch_object(report: &CycleReport<'_>, branch: &CycleBranch) -> Value {
    let folds = branch.folds.iter();
    let folds: Vec<f64> = folds
        .map(|&fold| branch.parameter.in_key_units(fold))
        .collect();
    let saturation = branch
        .cycles
        .iter()
        .find_map(|cycle| cycle.saturation_speed(report.inner_radius))
        .map(|speed| speed * 60.0 / TAU);
    json!({
        "key": branch.parameter.key(),
        "cycles": branch.cycles.len(),
        "folds": folds,
        "ends": branch.ends.map(|end| end.describe()),
        "saturation_speed_rpm": saturation,
        "factorizations": branch.factorizations,
    })
}
