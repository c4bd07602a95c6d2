//! The stencil that steps disc and shaft, and the contact between its rows.

use crate::prelude::*;
use crate::shaft::model::{STEEL, model, on, rigid_contact, with_shaft};

fn settings(duration: f64, perturbation: Perturbation) -> TransientSettings {
    transient_settings(duration, 4e-6, 1e-4, InitialState::SteadySliding, perturbation)
}

fn run(
    annulus: &AnnulusMesh,
    materials: &AnnulusMaterials,
    choice: OperatorChoice,
    settings: &TransientSettings,
) -> Recorder {
    let model = TransientModel::of_annulus(annulus, materials, DAMPING, contact(610.0));
    let (record, _) = recorded(model, choice, settings);
    record
}

/// Cross-method check: the eigenvalue analysis of both bodies.
#[test]
fn a_wave_in_disc_and_shaft_grows_as_the_complex_eigenvalue_predicts() {
    let specification = with_shaft(Quad4, 48, [4, 10]);
    let annulus = AnnulusMesh::generate(&specification).unwrap();
    let mut steel = on(STEEL);
    steel.shaft.as_mut().unwrap().damping = Some(rayleigh_damping(20.0, 1e-8));
    let options = TangentOptions { mass: Lumped, ..rigid_contact(false) };
    for (materials, n, duration) in [(on(POLYCARBONATE), 2, 0.006), (steel, 2, 0.006)] {
        let limit = MaxFrequency(20e3);
        let found = model(specification, materials.clone(), options).swept(&[0.0, 0.3], limit);
        let modes = &found.sweep.points[1].modes;
        let of_harmonic = modes.iter().filter(|mode| mode.harmonic == n);
        let predicted =
            of_harmonic.map(|mode| mode.eigenvalue).max_by(|a, b| a.re.total_cmp(&b.re)).unwrap();
        assert!(predicted.re > 0.0);
        let settings = settings(duration, Perturbation::of(&[n], 1e-8));
        let record = run(&annulus, &materials, OperatorChoice::Cyclic, &settings);
        // Two bodies alike have short waves that grow much faster, out of round-off: the fit ends before them.
        grows_as(&record, n, predicted, 1e-3);
    }
}

/// Theory: the discrete energy identity holds for both bodies through stick, slip and opening; both operators agree.
#[test]
fn every_joule_of_both_bodies_is_accounted_for() {
    let specification = with_shaft(Quad4, 36, [3, 6]);
    let annulus = AnnulusMesh::generate(&specification).unwrap();
    let mut settings = settings(3e-3, Perturbation::of(&[1, 2], 3.0));
    settings.initial = InitialState::Rest;
    let ends = [OperatorChoice::Cyclic, OperatorChoice::Sparse].map(|choice| {
        let record = run(&annulus, &on(POLYCARBONATE), choice, &settings);
        let (mut sticks, mut opens) = (0, 0);
        for row in &record.rows {
            assert!(row.balance_residual < 1e-12, "{:e}", row.balance_residual);
            let powers = &row.powers;
            let parts = powers.stick + powers.slide + powers.contact_dissipated;
            assert!((powers.external - parts).abs() <= 1e-10 * powers.external.abs().max(1.0));
            sticks += row.counts.stick;
            opens += row.counts.open;
        }
        assert!(sticks > 0 && opens > 0);
        record.rows[100].strain_energy
    });
    // Round-off, grown over some thousand steps.
    assert!((ends[0] / ends[1] - 1.0).abs() < 1e-9, "{ends:?}");
}
