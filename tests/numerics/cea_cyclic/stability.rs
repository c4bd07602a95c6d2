//! Onsets, intervals, completeness and maps, against the paper, the continuum and each other.

use crate::prelude::*;

#[test]
fn eigenvalues_equal_table_1_of_the_paper() {
    let found = paper(Quad8, 180, 35).swept(&[0.3], Lowest(28));
    let rows = TABLE_1.iter().zip(&found.sweep.points[0].modes).zip(1..);
    for (((real, frequency, harmonic, branch), mode), row) in rows {
        assert_eq!((mode.harmonic, mode.branch), (*harmonic, *branch), "{mode:?}");
        // Row 26 sits on the stability boundary.
        assert!(row == 26 || mode.is_unstable() == [3, 5, 7].contains(&row), "{mode:?}");
        near(mode.frequency_hz(), *frequency, 3e-3);
        // The paper's mesh is its own; 10 Hz is a tenth of a percent of the frequencies.
        assert!((mode.real_hz() - real).abs() < 10.0, "{real} {mode:?}");
        // Unstable waves travel against the rotor.
        assert!(!mode.is_unstable() || mode.direction == -1, "{mode:?}");
    }
}

/// One sweep straight to friction 5 and one in 1250 steps find the same intervals, also one that lies
/// between 0.0077 and 0.0142, and at each end the branch neither grows nor decays.
#[test]
fn unstable_intervals_do_not_depend_on_the_grid() {
    let mut model = paper(Quad4, 40, 10);
    model.options.contact.normal_stiffness = Some(1e11);
    model.options.damping.stiffness_coefficient = 0.0;
    model.material.poisson_ratio = 0.45;
    let solve = |frictions: &[f64]| model.swept(frictions, MaxFrequency(20000.0));
    let steps: Vec<f64> = (0..=1250).map(|i| 0.004 * f64::from(i)).collect();
    let (fine, coarse) = (solve(&steps).sweep.intervals, solve(&[5.0]));
    let narrow = |i: &&UnstableInterval| i.restabilized.is_some_and(|(end, _)| end < 0.02);
    assert_eq!(fine.iter().filter(narrow).count(), 1);
    let mut compared = 0;
    for a in &coarse.sweep.intervals {
        let name = (a.harmonic, a.branch, a.direction);
        let is_same = |b: &&UnstableInterval| {
            let apart = (b.critical_friction - a.critical_friction).abs();
            (b.harmonic, b.branch, b.direction) == name && apart < 1e-10
        };
        let b = fine.iter().find(is_same).unwrap();
        assert_eq!(a.restabilized.is_some(), b.restabilized.is_some());
        let ends = [Some(a.critical_friction), a.restabilized.map(|r| r.0)];
        for end in ends.into_iter().flatten() {
            let branches = solve(&[end]).branches;
            let mut own = branches.iter().filter(|b| (b.harmonic, b.branch, b.direction) == name);
            let lambda = own.next().unwrap().interpolate(end).unwrap();
            assert!(lambda.re.abs() < 1e-10 * lambda.norm(), "{lambda}");
            compared += 1;
        }
    }
    assert!(compared > 8);
}

#[test]
fn every_other_harmonic_is_proven_to_hold_no_mode_of_the_range() {
    for normal_stiffness in [Some(7.4e12), None] {
        let mut model = paper(Quad4, 180, 35);
        model.options.contact.normal_stiffness = normal_stiffness;
        let coverage = model.swept(&[0.0, 1.0], Lowest(30)).coverage;
        assert_eq!(coverage.followed, (0..=8).collect::<Vec<_>>());
        assert_eq!(coverage.proven_empty, (9..=90).collect::<Vec<_>>());
        assert!(coverage.counted_empty.is_empty());
    }
}

#[test]
fn results_are_the_same_to_the_last_bit_on_any_number_of_threads() {
    let model = paper(Quad4, 40, 8);
    let solve = |threads: usize| on_threads(threads, || model.swept(&[0.0, 0.3, 0.7], Lowest(30)));
    let (one, four) = (solve(1), solve(4));
    assert_eq!(one.sweep, four.sweep);
    assert_eq!(one.branches, four.branches);
}

/// Where an eigenvalue is predicted exact to the last bit, `T(theta)` has a pivot of zero: 4 of 1000 random moduli have one.
#[test]
fn branches_are_followed_past_an_eigenvalue_predicted_to_the_last_bit() {
    let frictions: Vec<f64> = (0..11).map(|k| f64::from(k) / 10.0).collect();
    let intervals = |young_modulus: f64| {
        let model = WaveModel {
            material: ElasticMaterial { young_modulus, ..POLYCARBONATE },
            options: TangentOptions { mass: Lumped, ..TANGENT },
            contact: contact(1000.0),
            ..paper(Quad4, 90, 18)
        };
        model.swept(&frictions, MaxFrequency(17_500.0)).sweep.intervals
    };
    let [exact, beside] = [2_540_479_684.482_66, 2_540_479_684.482_67].map(intervals);
    assert!(!exact.is_empty());
    // Onsets are located to 1e-9.
    within(&criticals(&exact), &criticals(&beside), 1e-8);
}

/// Of 0.35 and the number before it a cubic through both is noise.
#[test]
fn branches_are_followed_past_two_friction_values_a_rounding_apart() {
    let model = paper(Quad4, 40, 8);
    let intervals = |frictions: &[f64]| model.swept(frictions, MaxFrequency(12e3)).sweep.intervals;
    let once = intervals(&[0.0, 0.1, 0.35, 0.4, 0.7]);
    let twice = intervals(&[0.0, 0.1, 0.35_f64.next_down(), 0.35, 0.4, 0.7]);
    assert!(!once.is_empty());
    within(&criticals(&once), &criticals(&twice), 1e-9);
}
