//! Contact that stiffens with pressure, step by step.

use crate::prelude::*;
use crate::transient::model::{Watch, settings};
use frictionsim::cea::cyclic::sweep;

const LAWS: [NormalLaw; 2] = [
    NormalLaw::Exponential { reference_pressure: 2e5, height: 2e-6 },
    NormalLaw::Cubic { stiffness: 5e11, cubic_stiffness: 2e23 },
];

fn disc(stiffness: ContactStiffness, mesh: &AnnulusMesh) -> TransientModel<'_> {
    TransientModel {
        stiffness,
        ..TransientModel::of_annulus(mesh, &POLYCARBONATE, DAMPING, contact(610.0))
    }
}

/// Theory: the energy identity is exact whatever the law, through stick, slip and separation.
#[test]
fn every_joule_is_accounted_for_on_contact_that_stiffens() {
    let mesh = AnnulusMesh::generate(&annulus(ElementKind::Quad4, 45, 9)).unwrap();
    for law in LAWS {
        let damped = ContactStiffness { normal_damping: 1e5, ..stiffening(law) };
        for stiffness in [stiffening(law), damped] {
            let model = disc(stiffness, &mesh);
            let mut settings = settings(4e-3, &[]);
            settings.perturbation = Perturbation::of(&[1, 2], 2.0);
            let (record, residual) = recorded(model, OperatorChoice::Auto, &settings);
            for row in &record.rows {
                // Ten thousand steps of round-off 1e-16.
                assert!(row.balance_residual < 1e-12, "{law:?} {:e}", row.balance_residual);
            }
            let open: u64 = record.rows.iter().map(|row| row.counts.open).sum();
            let stored = record.rows.iter().map(|row| row.contact_energy);
            println!("{law:?}: open {open}, {:e}", residual);
            assert!(open > 0 && stored.fold(0.0, f64::max) > 0.0);
        }
    }
}

/// Cross-method: steady sliding, solved by Newton's method, is an equilibrium of the time steps.
#[test]
fn steady_sliding_on_a_law_stays_where_it_is() {
    let mesh = AnnulusMesh::generate(&annulus(ElementKind::Quad4, 36, 7)).unwrap();
    for law in LAWS {
        let model = disc(stiffening(law), &mesh);
        let operator = model.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
        let mut settings = settings(5e-4, &[]);
        settings.initial = InitialState::SteadySliding;
        let elastic = assemble_stiffness(&mesh.mesh, model.material);
        let base = SteadySliding::solve_with(&mesh.mesh, &elastic, &model.contact, Some(law));
        let exact = base.unwrap().normal_forces(0.3);
        let mut run = CentralDifference::start(model, operator.as_ref(), &settings).unwrap();
        run.run(&mut Watch(|sample: &Sample<'_>| {
            for (found, exact) in sample.normal_force().iter().zip(&exact) {
                assert!((found / exact - 1.0).abs() < 1e-8, "{law:?} {found} {exact}");
            }
        }))
        .unwrap();
    }
}

/// Cross-method: a seeded wave grows as the eigenvalue of the tangent at the base state's pressure says, stiffness damping of
/// the contact included.
#[test]
fn a_wave_on_contact_that_stiffens_grows_as_its_eigenvalue_says() {
    let specification = annulus(ElementKind::Quad4, 60, 12);
    let mesh = AnnulusMesh::generate(&specification).unwrap();
    let harmonic = 2;
    for law in LAWS {
        let options =
            TangentOptions { mass: MassKind::Lumped, contact: stiffening(law), ..TANGENT };
        let request = sweep_request(&[0.3], ModeLimit::MaxFrequency(17600.0));
        let sliding = contact(610.0);
        let found = sweep(&specification, &POLYCARBONATE, &options, &sliding, &request).unwrap();
        let modes = found.sweep.points[0].modes.iter();
        let own = modes.filter(|mode| mode.harmonic == harmonic);
        let exact = own.map(|mode| mode.growth_rate()).fold(f64::MIN, f64::max);

        let stiffness = stiffening(law).damped_by(DAMPING.stiffness_coefficient);
        let model = disc(stiffness, &mesh);
        let mut settings = settings(0.012, &[harmonic]);
        settings.initial = InitialState::SteadySliding;
        settings.perturbation = Perturbation::of(&[harmonic], 1e-8);
        let (record, _) = recorded(model, OperatorChoice::Auto, &settings);
        let analysis = TransientAnalysis::of(&record, &[harmonic]);
        let rate = analysis.growth[0].stage.as_ref().unwrap().rate_per_s.value;
        println!("{law:?}: {rate} 1/s, eigenvalue {exact} 1/s");
        assert!((rate / exact - 1.0).abs() < 0.01);
    }
}
