//! Growth of a seeded wave in the transient against the eigenvalue.

use crate::friction_law::falling;
use crate::prelude::*;
use frictionsim::cea::cyclic::sweep;
use frictionsim::transient::SampleRow;

/// Largest growth rate of a harmonic (1/s) as the time loop has it: lumped mass, no geometric stiffness.
fn eigenvalue(contact: &SlidingContact, stiffness: ContactStiffness, harmonic: usize) -> f64 {
    let options = TangentOptions { mass: MassKind::Lumped, contact: stiffness, ..TANGENT };
    let at = [contact.friction_coefficient];
    let request = sweep_request(&at, ModeLimit::Lowest(24));
    let specification = annulus(ElementKind::Quad4, 60, 12);
    let found = sweep(&specification, &POLYCARBONATE, &options, contact, &request).unwrap();
    let modes = found.sweep.points[0].modes.iter();
    let own = modes.filter(|mode| mode.harmonic == harmonic);
    own.map(|mode| mode.growth_rate()).fold(f64::NEG_INFINITY, f64::max)
}

fn settings(duration: f64, perturbation: Perturbation) -> TransientSettings {
    transient_settings(duration, 4e-6, 1e-4, InitialState::SteadySliding, perturbation)
}

/// Growth rate of a seeded harmonic in a transient that stays linear, 1/s.
fn growth(contact: &SlidingContact, stiffness: ContactStiffness, harmonic: usize) -> f64 {
    let annulus = AnnulusMesh::generate(&annulus(ElementKind::Quad4, 60, 12)).unwrap();
    let model = TransientModel {
        stiffness: stiffness.damped_by(DAMPING.stiffness_coefficient),
        ..TransientModel::of_annulus(&annulus, &POLYCARBONATE, DAMPING, *contact)
    };
    let settings = settings(0.012, Perturbation::of(&[harmonic], 1e-8));
    let (record, residual) = recorded(model, OperatorChoice::Auto, &settings);
    assert!(residual < 1e-10);
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
        let contact = SlidingContact { friction_coefficient: 0.1, ..falling(rpm) };
        let exact = eigenvalue(&contact, rigid, harmonic);
        let found = growth(&contact, rigid, harmonic);
        println!("{rpm} rpm: {found} 1/s, eigenvalue {exact} 1/s");
        assert!((found / exact - 1.0).abs() < 0.01);
        let constant = SlidingContact { decay: None, ..contact };
        println!("constant {}", eigenvalue(&constant, rigid, harmonic));
        assert!(eigenvalue(&constant, rigid, harmonic) < 0.0);
        rates.push(found);
    }
    assert!(rates[0] > 0.0 && rates[1] < 0.0);
}

/// Cross-method: springs and dashpots of the contact are those of the eigenvalue analysis, with constant and with
/// falling friction.
#[test]
fn a_wave_on_a_compliant_contact_grows_as_its_eigenvalue_says() {
    let compliant = compliant(5e11, [1e5, 1e4]);
    let rigid = ContactStiffness::default();
    for contact in [contact(610.0), falling(610.0)] {
        let exact = eigenvalue(&contact, compliant, 2);
        let found = growth(&contact, compliant, 2);
        println!("compliant: {found} 1/s, eigenvalue {exact} 1/s");
        assert!((found / exact - 1.0).abs() < 0.01);
        assert!((eigenvalue(&contact, rigid, 2) / exact - 1.0).abs() > 0.1);
    }
}

/// Theory: the energy identity is exact whatever law and compliance.
#[test]
fn every_joule_is_accounted_for_under_a_falling_law_and_with_contact_springs() {
    let annulus = AnnulusMesh::generate(&annulus(ElementKind::Quad4, 45, 9)).unwrap();
    let rigid = ContactStiffness::default();
    let damped = ContactStiffness { tangential_damping: 1e4, ..rigid };
    let compliant =
        ContactStiffness { normal_stiffness: Some(2e12), normal_damping: 1e5, ..damped };
    for (contact, stiffness) in [
        (falling(610.0), rigid),
        (contact(610.0), damped),
        (contact(610.0), compliant),
        (falling(610.0), compliant),
    ] {
        let model = TransientModel {
            stiffness,
            ..TransientModel::of_annulus(&annulus, &POLYCARBONATE, DAMPING, contact)
        };
        let mut settings = settings(4e-3, Perturbation::of(&[1, 2], 2.0));
        settings.initial = InitialState::Rest;
        let (record, _) = recorded(model, OperatorChoice::Auto, &settings);
        for row in &record.rows {
            // Ten thousand steps of round-off 1e-16.
            assert!(row.balance_residual < 1e-12, "{:e}", row.balance_residual);
        }
        let sum = |of: fn(&SampleRow) -> f64| record.rows.iter().map(of).sum::<f64>();
        assert!(sum(|row| row.counts.open as f64) > 0.0);
        let has_springs = stiffness.normal_stiffness.is_some();
        assert_eq!(sum(|row| row.contact_energy) > 0.0, has_springs);
        let has_dashpots = stiffness.tangential_damping > 0.0;
        assert_eq!(sum(|row| row.powers.damping) > 0.0, has_dashpots);
    }
}

/// Theory: steady sliding on a compliant contact is that on a rigid one, and at rest against the springs nothing moves.
#[test]
fn steady_sliding_does_not_depend_on_the_contact_stiffness() {
    let annulus = AnnulusMesh::generate(&annulus(ElementKind::Quad4, 45, 9)).unwrap();
    let forces = |normal_stiffness: Option<f64>| {
        let model = TransientModel {
            stiffness: ContactStiffness { normal_stiffness, ..RIGID },
            ..TransientModel::of_annulus(&annulus, &POLYCARBONATE, DAMPING, falling(610.0))
        };
        let operator = model.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
        let settings = settings(1e-3, Perturbation::default());
        let mut run = CentralDifference::start(model, operator.as_ref(), &settings).unwrap();
        let mut record = Recorder::new(&run, &RecorderSettings::default()).unwrap();
        run.run(&mut record).unwrap();
        run.contact().normal_force.clone()
    };
    let rigid = forces(None);
    for stiffness in [1e11, 7.4e12] {
        for (a, b) in forces(Some(stiffness)).iter().zip(&rigid) {
            assert!((a / b - 1.0).abs() < 1e-6, "{stiffness:e} {a} {b}");
        }
    }
}
