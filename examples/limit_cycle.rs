//! The polycarbonate disc from rest into its friction-induced limit cycle, on a coarse mesh.
//!
//! `cargo run --release --example limit_cycle`

use frictionsim::contact::SlidingContact;
use frictionsim::fem::operator::SimdLevel;
use frictionsim::fem::{ElasticMaterial, PlaneFormulation, RayleighDamping};
use frictionsim::mesh::{AnnulusMesh, AnnulusSpecification, BoundaryCondition, ElementKind};
use frictionsim::transient::{
    CentralDifference, InitialState, OperatorChoice, Perturbation, Recorder, RecorderSettings,
    TimeStep, TransientAnalysis, TransientModel, TransientSettings,
};
use std::error::Error;
use std::f64::consts::TAU;

/// Runs and prints.
pub fn main() -> Result<(), Box<dyn Error>> {
    let annulus = AnnulusMesh::generate(&AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements: 60,
        radial_elements: 12,
        radial_grading: 1.0,
        element: ElementKind::Quad4,
        outer: BoundaryCondition::Clamped,
        shaft: None,
    })?;
    let material = ElasticMaterial {
        young_modulus: 2.5e9,
        poisson_ratio: 0.3805,
        density: 1228.0,
        formulation: PlaneFormulation::PlaneStrain,
        ..ElasticMaterial::PLAIN
    };
    let damping = RayleighDamping { mass_coefficient: 40.0, stiffness_coefficient: 4.5e-7 };
    let contact = SlidingContact {
        decay: None,
        friction_coefficient: 0.3,
        interference: 25e-6,
        rotation_speed: 610.0 * TAU / 60.0,
    };
    let model = TransientModel::of_annulus(&annulus, &material, damping, contact);
    let harmonics = [2];
    let settings = TransientSettings {
        duration: 0.03,
        time_step: TimeStep::Auto,
        sample_interval: 2e-6,
        expansion_time: 5e-4,
        initial: InitialState::Rest,
        perturbation: Perturbation::of(&harmonics, 1e-3),
    };
    let operator = model.operator(OperatorChoice::Auto, SimdLevel::detect())?;
    let mut run = CentralDifference::start(model, operator.as_ref(), &settings)?;
    let mut record = Recorder::new(&run, &RecorderSettings::default())?;
    run.run(&mut record)?;
    let analysis = TransientAnalysis::of(&record, &harmonics);
    let end = &analysis.last_fifth;
    let [stick, slip, open] = end.status;
    println!(
        "{} steps, {:?} at {:?} Hz",
        run.steps_done(),
        analysis.settling.state,
        end.main_frequency_hz
    );
    println!("stick {stick:.3}, slip {slip:.3}, open {open:.3}");
    println!("external power {:.1} kW/m", end.powers.external / 1e3);
    println!("energy balance residual {:.0e}", analysis.largest_residual);
    assert!(analysis.largest_residual < 1e-10);
    Ok(())
}
