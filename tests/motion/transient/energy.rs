//! The energy balance.

use super::*;

/// Theory: the discrete energy identity is exact whatever contact and damping do, for one body and for a disc on its shaft.
#[test]
fn every_joule_is_accounted_for_through_stick_slip_and_separation() {
    use OperatorChoice::{Cyclic, Sparse};
    let (alone, shafted) = (disc(45, 9), on_shaft(disc(30, 6).specification, 2));
    let shafted = AnnulusMesh::generate(&shafted).unwrap();
    let damped = ContactStiffness { tangential_damping: 1e4, ..RIGID };
    let springs = compliant(2e12, [1e5, 1e4]);
    let [[first, first_damped], [second, second_damped]] =
        LAWS.map(stiffening).map(|law| [law, ContactStiffness { normal_damping: 1e5, ..law }]);
    for (annulus, contact, stiffness, choice) in [
        (&alone, contact(610.0), RIGID, Cyclic),
        (&alone, contact(610.0), RIGID, Sparse),
        (&shafted, contact(610.0), RIGID, Cyclic),
        (&shafted, contact(610.0), RIGID, Sparse),
        (&alone, falling(610.0), RIGID, Cyclic),
        (&alone, contact(610.0), damped, Cyclic),
        (&alone, contact(610.0), springs, Cyclic),
        (&alone, falling(610.0), springs, Cyclic),
        (&alone, contact(610.0), first, Cyclic),
        (&alone, contact(610.0), first_damped, Cyclic),
        (&alone, contact(610.0), second, Cyclic),
        (&alone, contact(610.0), second_damped, Cyclic),
    ] {
        let settings = kicked(6e-3, &[1, 2], 2.0);
        let (record, _) = recorded(on_contact(annulus, contact, stiffness), choice, &settings);
        for row in &record.rows {
            // Ten thousand steps of round-off 1e-16.
            let left = row.balance_residual;
            assert!(left < 1e-12, "{contact:?} {stiffness:?}, {} s: {left:e}", row.time);
            let powers = &row.powers;
            let parts = powers.stick + powers.slide + powers.contact_dissipated;
            assert!((powers.external - parts).abs() <= 1e-10 * powers.external.abs().max(1.0));
        }
        let sum = |of: fn(&SampleRow) -> f64| record.rows.iter().map(of).sum::<f64>();
        assert!(sum(|row| row.material_damping) > 0.0);
        assert!(sum(|row| row.counts.open as f64) > 0.0);
        let has_springs = stiffness.normal_stiffness.is_some();
        assert_eq!(sum(|row| row.contact_energy) > 0.0, has_springs);
        let has_dashpots = stiffness.tangential_damping.max(stiffness.normal_damping) > 0.0;
        assert_eq!(sum(|row| row.powers.damping) > 0.0, has_dashpots);
    }
}

/// Theory: with neither damping nor contact the discrete energy is constant.
#[test]
fn free_undamped_vibration_keeps_its_energy_over_a_million_steps() {
    let annulus = disc(12, 3);
    let model = free(&annulus);
    let mut settings = kicked(1.0, &[1, 2, 3], 1.0);
    settings.expansion_time = 0.0;
    settings.time_step = TimeStep::Seconds(1e-6);
    settings.sample_interval = 1e-3;
    let mut run = started(model, OperatorChoice::Cyclic, &settings);
    let (mut first, mut worst) = (None, 0.0_f64);
    watch(&mut run, |sample| {
        let energy = sample.row.kinetic_energy + sample.row.strain_energy;
        let first = *first.get_or_insert(energy);
        worst = worst.max((energy / first - 1.0).abs());
    });
    assert_eq!(run.steps_done(), 1_000_001);
    // A random walk of a million roundings; a drift would give 1e-10.
    below(worst, 2e-12, "largest relative change of energy");
}
