//! Limit cycles of discs that are not the paper's: rings of steel and aluminium, coarse meshes.
//!
//! Onsets are held to the eigenvalue analysis, results to scaling, stability and power to transients that start beside the
//! cycle. The transients are independent of the grid of phases: they share with it the element matrices alone.

use crate::prelude::*;

/// Aluminium, 30 to 75 mm.
fn aluminium([around, across]: [usize; 2]) -> (DiscModel, SlidingContact) {
    let material = elastic(70e9, 0.33, 2700.0, PlaneStress);
    let damping = rayleigh_damping(0.0, 1.5e-7);
    let specification = ring([0.03, 0.075], Quad4, around, across);
    let model = DiscModel { specification, material, damping };
    (model, sliding_at(0.35, 10e-6, 900.0 * TAU / 60.0))
}

/// Steel, 100 to 240 mm.
fn steel([around, across]: [usize; 2]) -> (DiscModel, SlidingContact) {
    let material = elastic(210e9, 0.3, 7850.0, PlaneStrain);
    let damping = rayleigh_damping(100.0, 4e-7);
    let specification = ring([0.1, 0.24], Quad4, around, across);
    let model = DiscModel { specification, material, damping };
    (model, sliding_at(0.5, 40e-6, 750.0 * TAU / 60.0))
}

/// The cycle that is born at an onset on so many phases, with its solver.
fn found(
    (model, contact): &(DiscModel, SlidingContact),
    onset: &Onset,
    phases: Option<usize>,
) -> (CycleSolver, LimitCycle) {
    let family = Family::lowest(onset.harmonic);
    let solver = CycleSolver::born_at(model, family, onset, phases).unwrap();
    let point = OperatingPoint { contact: *contact, damping: model.damping };
    let cycle = solver.find(&point).unwrap();
    (solver, cycle)
}

#[test]
fn every_unstable_wave_of_the_eigenvalue_analysis_has_its_family() {
    let disc = aluminium([150, 24]);
    let onsets = disc.0.onsets(disc.1.friction_coefficient, Lowest(40)).unwrap();
    // Up to 66 kHz, far above what a fixed grid of frequencies would cover.
    assert_eq!(onsets.len(), 7, "{onsets:?}");
    assert!(onsets.iter().any(|onset| onset.frequency > TAU * 40e3));
    for onset in &onsets {
        let (_, cycle) = found(&disc, onset, None);
        // Born at the onset, a cycle has about its frequency.
        let ratio = cycle.state.frequency() / onset.frequency;
        assert!((0.85..1.15).contains(&ratio), "{onset:?}: {ratio}");
    }
}

#[test]
fn scaled_lengths_moduli_densities_and_times_scale_the_results() {
    let (model, contact) = aluminium([60, 10]);
    let (length, modulus, density) = (3.7_f64, 0.02_f64, 11.0_f64);
    let time = length * (density / modulus).sqrt();
    let mut other = model;
    other.specification.inner_radius *= length;
    other.specification.outer_radius *= length;
    other.material.young_modulus *= modulus;
    other.material.density *= density;
    other.damping.stiffness_coefficient *= time;
    let other_contact = SlidingContact {
        interference: contact.interference * length,
        rotation_speed: contact.rotation_speed / time,
        ..contact
    };
    let [one, two] = [(model, contact), (other, other_contact)].map(|disc| {
        let onset = disc.0.onsets(0.35, Lowest(20)).unwrap()[0];
        let (solver, cycle) = found(&disc, &onset, None);
        let stepping = solver.stepping(SimdLevel::detect()).unwrap();
        (onset, stepping.settle(&cycle, None).unwrap())
    });
    assert_eq!(one.0.harmonic, two.0.harmonic);
    near(one.0.friction_coefficient, two.0.friction_coefficient, 1e-9);
    near(one.0.frequency, two.0.frequency * time, 1e-9);
    let [first, second] = [&one.1, &two.1];
    near(first.cycle.state.frequency(), second.cycle.state.frequency() * time, 1e-8);
    // W/m: stress times length times velocity.
    let power = modulus * length * length / time;
    let [own, other] = [first, second].map(|own| own.cycle.powers.contact.external);
    near(own * power, other, 1e-4);
    let leading = |s: &SteppedCycle| {
        let own = s.stability.leading().unwrap();
        c64::new(own.growth_rate, own.mode.unwrap().frequency)
    };
    let difference = (leading(first) - leading(second) * time).norm();
    // A hundredth of a per cent of omega: where a node lands between two steps is round-off's choice.
    below(difference, 1e-4 * first.cycle.state.frequency(), "exponents");
}

#[test]
fn leading_exponent_does_not_depend_on_the_number_of_phases_beyond_its_uncertainty() {
    let disc = steel([150, 24]);
    let onset = disc.0.onset_of(Family::lowest(1), Lowest(20)).unwrap();
    let phases = sized(&[81, 121][..], &[81, 99, 121, 141, 181]).iter();
    let found = phases.map(|&phases| {
        let (solver, cycle) = found(&disc, &onset, Some(phases));
        let stability = crate::cycle::stability_of(&solver, &cycle);
        let leading = stability.leading().unwrap();
        (leading.growth_rate, leading.uncertainty)
    });
    let found: Vec<(f64, f64)> = found.collect();
    for (a, doubt) in &found {
        let is_one = |(b, other): &(f64, f64)| (a - b).abs() <= doubt + other;
        assert!(found.iter().all(is_one), "{found:?}");
    }
}

#[test]
fn external_power_is_the_transients_and_the_verdict_is_what_transients_do() {
    let disc = steel([150, 24]);
    for family in [1, 2, 3].map(Family::lowest) {
        let onset = disc.0.onset_of(family, Lowest(30)).unwrap();
        let (solver, cycle) = found(&disc, &onset, None);
        let stepping = solver.stepping(SimdLevel::detect()).unwrap();
        let settled = stepping.settle(&cycle, None).unwrap();
        // A hundred periods and more, seeded in the leading harmonic.
        let run = stepping.confirm(&settled.cycle, Some(&settled.stability), 100).unwrap();
        let external = settled.cycle.powers.contact.external;
        println!("{family}: {:?} {run:?} {external}", settled.stability.leading());
        let verdict = settled.stability.verdict();
        let is_stable = verdict == Verdict::Stable;
        assert!(verdict == Verdict::Undecided || run.agrees == is_stable, "{family}");
        if is_stable {
            near(external, run.external_power, 7e-3);
        }
    }
}
