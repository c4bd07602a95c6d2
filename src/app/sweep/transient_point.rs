//! The transient of one point of a sweep, from case to summary, without a file.

use crate::app::Failure;
use crate::case::{self, Case};
use crate::fem::operator::SimdLevel;
use crate::mesh::AnnulusMesh;
use crate::results::Manifest;
use crate::transient::{
    CentralDifference, InitialState, OperatorChoice, Perturbation, Recorder, RecorderSettings,
    TimeStep, TransientAnalysis, TransientModel, TransientSettings, build_operator,
};
use serde_json::{Value, json};
use std::time::Instant;

pub fn summarize(case: &Case, manifest: &Manifest) -> Result<Value, Failure> {
    let start = Instant::now();
    let asked = case.require_transient()?;
    let annulus = AnnulusMesh::generate(&case.annulus).map_err(Failure::usage)?;
    let model = TransientModel {
        annulus: &annulus,
        material: case.material,
        damping: case.damping.rayleigh,
        contact: case.contact.sliding,
    };
    let settings = settings(case, asked);
    let simd = SimdLevel::choose(&manifest.simd).map_err(Failure::usage)?;
    let choice = match asked.operator {
        case::OperatorChoice::Auto => OperatorChoice::Auto,
        case::OperatorChoice::Cyclic => OperatorChoice::Cyclic,
        case::OperatorChoice::Sparse => OperatorChoice::Sparse,
    };
    let operator = build_operator(&model, choice, simd).map_err(Failure::run)?;
    let mut run =
        CentralDifference::start(model, operator.as_ref(), &settings).map_err(Failure::run)?;
    let mut record = Recorder::new(&run, &RecorderSettings::default()).map_err(Failure::run)?;
    run.run(&mut record).map_err(Failure::run)?;
    let analysis = TransientAnalysis::of(&record, &settings.perturbation.harmonics);
    let cycle = &analysis.limit_cycle;
    let (steps, wall_s) = (run.steps_done(), start.elapsed().as_secs_f64());
    let element_steps = annulus.mesh.elements.len() as f64 * steps as f64;
    let w = |power: f64| power * case.thickness;
    let growth: Vec<Value> = analysis
        .growth
        .iter()
        .map(|g| json!({"harmonic": g.harmonic, "rate_per_s": g.rate, "frequency_hz": g.frequency_hz}))
        .collect();
    Ok(json!({
        "command": "transient",
        "steps": steps,
        "time_step_s": run.plan().time_step,
        "wall_s": wall_s,
        "element_steps_per_s": element_steps / wall_s,
        "max_balance_residual": analysis.largest_residual,
        "main_frequency_hz": cycle.main_frequency_hz,
        "main_harmonic": cycle.main_harmonic,
        "status": {"stick": cycle.status[0], "slip": cycle.status[1], "open": cycle.status[2]},
        "power_w": {
            "external": w(cycle.powers.external),
            "stick": w(cycle.powers.stick),
            "slide": w(cycle.powers.slide),
            "contact_dissipated": w(cycle.powers.contact_dissipated),
            "material_damping": w(cycle.material_damping),
        },
        "harmonics": cycle.harmonics,
        "growth": growth,
        "first_nonlinearity_s": analysis.first_nonlinearity,
    }))
}

fn settings(case: &Case, asked: &case::Transient) -> TransientSettings {
    TransientSettings {
        duration: asked.duration,
        time_step: match asked.time_step {
            case::TimeStep::Auto => TimeStep::Auto,
            case::TimeStep::Seconds(step) => TimeStep::Seconds(step),
        },
        sample_interval: case.output.sample_interval,
        expansion_time: asked.expansion_time,
        initial: match asked.initial {
            case::InitialState::Rest => InitialState::Rest,
            case::InitialState::SteadySliding => InitialState::SteadySliding,
        },
        perturbation: Perturbation {
            harmonics: asked.perturbation.harmonics.clone(),
            velocity: asked.perturbation.velocity,
        },
    }
}
