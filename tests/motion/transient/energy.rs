//! The energy balance.

use crate::prelude::*;
use crate::transient::model::{Watch, disc, model, settings};

/// Theory: the discrete energy identity is exact, whatever contact and damping do.
#[test]
fn every_joule_is_accounted_for_through_stick_slip_and_separation() {
    let annulus = disc(45, 9);
    for choice in [OperatorChoice::Cyclic, OperatorChoice::Sparse] {
        let model = model(&annulus, 610.0);
        let mut settings = settings(6e-3, &[1, 2]);
        settings.perturbation = Perturbation::of(&[1, 2], 2.0);
        let (record, _) = recorded(model, choice, &settings);
        for row in &record.rows {
            // Ten thousand steps of round-off 1e-16.
            assert!(row.balance_residual < 1e-12, "{} s: {:e}", row.time, row.balance_residual);
            let powers = &row.powers;
            let parts = powers.stick + powers.slide + powers.contact_dissipated;
            assert!((powers.external - parts).abs() <= 1e-10 * powers.external.abs().max(1.0));
        }
        let dissipated: f64 = record.rows.iter().map(|row| row.material_damping).sum();
        assert!(dissipated > 0.0);
    }
}

/// Theory: with neither damping nor contact the discrete energy is constant.
#[test]
fn free_undamped_vibration_keeps_its_energy_over_a_million_steps() {
    let annulus = disc(12, 3);
    let mut model = model(&annulus, 0.0);
    model.damping = RayleighDamping::default();
    // The cylinder shrinks away and never touches.
    model.contact.interference = -1.0;
    let operator = model.operator(OperatorChoice::Cyclic, SimdLevel::detect()).unwrap();
    let mut settings = settings(1.0, &[1, 2, 3]);
    settings.expansion_time = 0.0;
    settings.perturbation = Perturbation::of(&[1, 2, 3], 1.0);
    settings.time_step = TimeStep::Seconds(1e-6);
    settings.sample_interval = 1e-3;
    let mut run = CentralDifference::start(model, operator.as_ref(), &settings).unwrap();
    let (mut first, mut worst) = (None, 0.0_f64);
    run.run(&mut Watch(|sample: &Sample<'_>| {
        let energy = sample.kinetic_energy + sample.strain_energy;
        let first = *first.get_or_insert(energy);
        worst = worst.max((energy / first - 1.0).abs());
    }))
    .unwrap();
    assert_eq!(run.steps_done(), 1_000_001);
    println!("largest relative change of energy {worst:.1e}");
    // A random walk of a million roundings; a drift would give 1e-10.
    assert!(worst < 2e-12, "{worst:e}");
}
