//! The disc of the source paper with its thickness.

use super::*;

/// Independent prototype, exact in theta: good to 2e-4 in plane; torsion is that of the plane.
#[test]
fn modes_in_the_plane_of_the_thick_disc_are_those_of_an_independent_solution() {
    let model = disc(Quad8, [60, 12, 2]);
    let modes = modes(&model, 0.3, 11_200.0);
    for (harmonic, frequency, real) in [
        (0, 5855.1, -51.7),
        (0, 11_086.0, -177.0),
        (1, 6904.6, 108.0),
        (2, 8810.4, 94.0),
        (1, 10_320.0, 174.0),
    ] {
        let is_near = |mode: &&ComplexMode| {
            let is_equal = (mode.frequency_hz() / frequency - 1.0).abs() < 2e-3;
            mode.harmonic == harmonic && is_equal && (mode.real_hz() - real).abs() < 3.0
        };
        let found: Vec<_> = modes.iter().filter(is_near).collect();
        assert_eq!(found.len(), 1, "n = {harmonic}, {frequency} Hz");
        assert!(found[0].axial_share.unwrap() < 0.01);
    }
}

/// The paper's claim: what moves out of the plane decays.
#[test]
fn every_mode_with_axial_motion_decays() {
    let modes = modes(&disc(Quad8, [36, 8, 2]), 0.3, 11_000.0);
    let (axial, plane): (Vec<&ComplexMode>, Vec<_>) =
        modes.iter().partition(|mode| mode.axial_share.unwrap() > 0.5);
    assert!(axial.len() > 15 && axial.iter().all(|mode| mode.growth_rate() < 0.0));
    assert!(plane.iter().any(|mode| mode.is_unstable()));
}

/// The same prototype: 2.599 MPa, 2.828 MPa in plane strain.
#[test]
fn mean_pressure_of_the_thick_disc_is_that_of_an_independent_solution() {
    let (sector, base) = base(&disc(Quad8, [36, 12, 2])).unwrap();
    near(base.mean_pressure(&sector), 2.599e6, 1e-3);
}

/// One branch of harmonic 1 is lost with ordinary steps just before friction 0.6.
#[test]
fn a_branch_that_needs_small_steps_makes_no_other_take_them() {
    let mut model = disc(Quad4, [180, 35, 4]);
    model.options.geometric_stiffness = true;
    let values: Vec<f64> = (0..21).map(|i| 0.03 * f64::from(i)).collect();
    let found = model.swept(&values, Lowest(30));
    let modes: usize = found.sweep.points.iter().map(|p| p.modes.len()).sum();
    // Branches above the range are followed too, and strongly coupled ones take several steps; small steps all along spend 18.
    let spent = found.coverage.factorizations;
    assert!(spent < 8 * modes, "{spent} for {modes} modes");
}
