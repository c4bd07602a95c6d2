//! A limit cycle put to the test: does a transient that starts on it stay there?

use crate::app::transient::cycle_fields;
use crate::case::Case;
use crate::cycle::{CycleSolver, LimitCycle};
use crate::fem::operator::SimdLevel;
use crate::mesh::AnnulusMesh;
use crate::results::cycle_confirmation::Confirmation;
use crate::transient::{
    CentralDifference, InitialState, OperatorChoice, Perturbation, Recorder, RecorderSettings,
    StepPlan, TimeStep, TransientAnalysis, TransientError, TransientModel, TransientSettings,
    build_operator,
};

/// Samples for each period.
const SAMPLES: f64 = 64.0;

/// Steps the disc through `periods` periods from the cycle, unperturbed, and reads the last fifth.
///
/// # Errors
/// A run that becomes unstable.
pub fn confirm(
    case: &Case,
    annulus: &AnnulusMesh,
    solver: &CycleSolver,
    cycle: &LimitCycle,
    periods: usize,
    simd: SimdLevel,
) -> Result<Confirmation, TransientError> {
    let model = TransientModel {
        annulus,
        material: case.material,
        damping: cycle.state.point.damping,
        contact: cycle.state.point.contact,
    };
    let period = 1.0 / cycle.frequency_hz();
    let settings = TransientSettings {
        duration: periods as f64 * period,
        time_step: TimeStep::Auto,
        sample_interval: period / SAMPLES,
        expansion_time: 0.0,
        initial: InitialState::LimitCycle {
            harmonic: cycle.harmonic,
            onset: solver.family().onset,
        },
        perturbation: Perturbation::default(),
    };
    let operator = build_operator(&model, OperatorChoice::Auto, simd)?;
    let operator = operator.as_ref();
    let step = StepPlan::new(operator, &model.damping, &settings)?.time_step;
    let [displacement, velocity] = cycle_fields(solver, cycle, step);
    let mut run =
        CentralDifference::start_from(model, operator, &settings, &displacement, velocity)?;
    let mut record = Recorder::new(&run, &RecorderSettings::default())?;
    run.run(&mut record)?;
    let found = TransientAnalysis::of(&record, &[]).last_fifth;
    Ok(Confirmation {
        periods,
        main_frequency_hz: found.main_frequency_hz,
        main_harmonic: found.main_harmonic,
        status: found.status,
        external_power: found.powers.external,
    })
}
