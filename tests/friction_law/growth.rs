//! Growth of a seeded wave in the transient against the eigenvalue.

use crate::disc::{DAMPING, POLYCARBONATE, annulus};
use crate::falling;
use frictionsim::cea::cyclic::sweep;
use frictionsim::cea::{ModeLimit, SweepRequest};
use frictionsim::contact::{ContactStiffness, SlidingContact};
use frictionsim::fem::MassKind;
use frictionsim::fem::operator::SimdLevel;
use frictionsim::mesh::{AnnulusMesh, ElementKind};
use frictionsim::prestress::{DampingModel, TangentOptions};
use frictionsim::transient::{
    CentralDifference, InitialState, OperatorChoice, Perturbation, Recorder, RecorderSettings,
    TimeStep, TransientAnalysis, TransientModel, TransientSettings, build_operator,
};

/// Largest growth rate of a harmonic (1/s) as the time loop has it: lumped mass, no geometric stiffness.
fn eigenvalue(contact: &SlidingContact, stiffness: ContactStiffness, harmonic: usize) -> f64 {
    let options = TangentOptions {
        mass: MassKind::Lumped,
        geometric_stiffness: false,
        damping: DAMPING,
        damping_model: DampingModel::WholeTangent,
        contact: stiffness,
    };
    let request = SweepRequest {
        friction_coefficients: &[contact.friction_coefficient],
        limit: ModeLimit::Lowest(24),
        shapes_at: &[],
    };
    let specification = annulus(ElementKind::Quad4, 60, 12);
    let found = sweep(&specification, &POLYCARBONATE, &options, contact, &request).unwrap();
    let modes = found.sweep.points[0].modes.iter();
    let own = modes.filter(|mode| mode.harmonic == harmonic);
    own.map(|mode| mode.growth_rate())
        .fold(f64::NEG_INFINITY, f64::max)
}

fn settings(duration: f64, perturbation: Perturbation) -> TransientSettings {
    TransientSettings {
        duration,
        time_step: TimeStep::Auto,
        sample_interval: 4e-6,
        expansion_time: 1e-4,
        initial: InitialState::SteadySliding,
        perturbation,
    }
}

/// Growth rate of a seeded harmonic in a transient that stays linear, 1/s.
fn growth(contact: &SlidingContact, harmonic: usize) -> f64 {
    let annulus = AnnulusMesh::generate(&annulus(ElementKind::Quad4, 60, 12)).unwrap();
    let model = TransientModel::of_annulus(&annulus, &POLYCARBONATE, DAMPING, *contact);
    let operator = build_operator(&model, OperatorChoice::Auto, SimdLevel::detect()).unwrap();
    let settings = settings(0.012, Perturbation::of(&[harmonic], 1e-8));
    let mut run = CentralDifference::start(model, operator.as_ref(), &settings).unwrap();
    let mut record = Recorder::new(&run, &RecorderSettings::default()).unwrap();
    run.run(&mut record).unwrap();
    assert!(run.largest_residual() < 1e-10);
    let analysis = TransientAnalysis::of(&record, &[harmonic]);
    assert_eq!(analysis.first_nonlinearity, None);
    analysis.growth[0].stage.as_ref().unwrap().rate_per_s.value
}

/// Cross-method, at a friction coefficient that the constant law leaves stable: where the law falls the wave grows,
/// at a speed that leaves little of its fall it dies out.
#[test]
fn a_seeded_wave_grows_or_decays_as_its_eigenvalue_says_at_two_speeds() {
    let rigid = ContactStiffness::default();
    let mut rates = Vec::new();
    for (rpm, harmonic) in [(100.0, 2), (1800.0, 2)] {
        let contact = SlidingContact {
            friction_coefficient: 0.1,
            ..falling(rpm)
        };
        let exact = eigenvalue(&contact, rigid, harmonic);
        let found = growth(&contact, harmonic);
        println!("{rpm} rpm: {found} 1/s, eigenvalue {exact} 1/s");
        assert!((found / exact - 1.0).abs() < 0.01);
        let constant = SlidingContact {
            decay: None,
            ..contact
        };
        println!("constant {}", eigenvalue(&constant, rigid, harmonic));
        assert!(eigenvalue(&constant, rigid, harmonic) < 0.0);
        rates.push(found);
    }
    assert!(rates[0] > 0.0 && rates[1] < 0.0);
}

/// Theory: the energy identity is exact whatever the law.
#[test]
fn every_joule_is_accounted_for_under_a_falling_law() {
    let annulus = AnnulusMesh::generate(&annulus(ElementKind::Quad4, 45, 9)).unwrap();
    let model = TransientModel::of_annulus(&annulus, &POLYCARBONATE, DAMPING, falling(610.0));
    let operator = build_operator(&model, OperatorChoice::Auto, SimdLevel::detect()).unwrap();
    let mut settings = settings(6e-3, Perturbation::of(&[1, 2], 2.0));
    settings.initial = InitialState::Rest;
    let mut run = CentralDifference::start(model, operator.as_ref(), &settings).unwrap();
    let mut record = Recorder::new(&run, &RecorderSettings::default()).unwrap();
    run.run(&mut record).unwrap();
    for row in &record.rows {
        // Ten thousand steps of round-off 1e-16.
        assert!(row.balance_residual < 1e-12, "{:e}", row.balance_residual);
    }
    let stuck: u64 = record.rows.iter().map(|row| row.counts.stick).sum();
    let open: u64 = record.rows.iter().map(|row| row.counts.open).sum();
    assert!(stuck > 0 && open > 0);
}
