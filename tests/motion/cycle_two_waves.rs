//! Motions of two frequencies against a transient of the mesh, their energy, and birth where the cycle loses its stability.

use crate::prelude::*;

const FRICTION: f64 = 0.2;

fn solver([around, across]: [usize; 2]) -> CycleSolver {
    crate::cycle::solver_of(&annulus(Quad4, around, across), 1)
}

fn cycle(solver: &CycleSolver, rpm: f64) -> LimitCycle {
    let contact = SlidingContact { friction_coefficient: FRICTION, ..contact(rpm) };
    solver.find(&OperatingPoint { contact, damping: DAMPING }).unwrap()
}

/// At friction 0.2 and 1000 rpm one and two nodal diameters live together; the transient is independent but for the matrices.
#[test]
fn two_waves_that_live_together_have_the_frequencies_of_a_transient() {
    let solver = solver([90, 18]);
    let cycle = cycle(&solver, 1000.0);
    let stepping = solver.stepping(SimdLevel::detect()).unwrap();
    let found = stepping.two_waves(&cycle, 2, None, &Unwatched).unwrap();
    let own = found.motion.state.frequencies();
    for k in 0..2 {
        near(own[k], found.settled.frequencies[k], 1e-3);
        near(found.motion.amplitudes[k], found.settled.amplitudes[k], 0.05);
    }
    // No common fundamental, and the wave that the transient of a case has there: 10.36 and 9.5 kHz.
    assert!((own[0] / TAU - 10_345.0).abs() < 15.0 && (own[1] / TAU - 9_533.0).abs() < 15.0);
    assert!(found.agrees(), "{:?}", found.confirmation);
    // The identity is exact; what remains is round-off of the linear systems.
    assert!(found.motion.powers.balance_residual() < 1e-9);
    // Signorini and Coulomb hold at every point of both phases.
    let state = &found.motion.state;
    let mean = state.normal.iter().sum::<f64>() / state.normal.len() as f64;
    for (i, contact) in state.contact.iter().enumerate() {
        let (normal, shear) = (state.normal[i], state.tangential[i]);
        assert!(normal >= -1e-3 * mean);
        assert!(shear.abs() <= FRICTION * normal.max(0.0) + 1e-3 * mean);
        if contact.status() == ContactStatus::Open {
            assert_eq!((normal, shear), (0.0, 0.0));
        }
    }
}

/// The branch over the speed goes down to where the second wave vanishes: there the cycle's own exponent changes its sign.
#[test]
fn two_waves_are_born_where_the_cycle_loses_its_stability() {
    let solver = solver(sized([72, 14], [90, 18]));
    let stepping = solver.stepping(SimdLevel::detect()).unwrap();
    let rpm = TAU / 60.0;
    let above = cycle(&solver, 700.0);
    let speed = Parameter::RotationSpeed;
    let values = [500.0 * rpm, 650.0 * rpm, 800.0 * rpm];
    let phases = Some(sized(31, 41));
    let run = |kept: &Kept| {
        let found = stepping.two_waves(&above, 2, phases, kept).unwrap();
        found.waves.follow(&found.motion, speed, &values, kept)
    };
    let kept = Kept::default();
    let branch = run(&kept);
    // What an interrupted search has kept, and the rest anew, is the same bit by bit.
    let count = kept.count();
    let resumed = run(&kept.after(3 * count / 4));
    assert!(count > 6 && format!("{resumed:?}") == format!("{branch:?}"));
    assert_eq!(branch.ends, [BranchEnd::Birth, BranchEnd::Range]);
    let [stable, unstable] =
        [560.0, 700.0].map(|rpm| stepping.settle(&cycle(&solver, rpm), None).unwrap());
    let change = stepping.stability_change(speed, &stable, &unstable).unwrap();
    assert_eq!(change.harmonic, 2);
    // The coarse grid of phases is what is between them.
    near(branch.births[0], change.value, 0.02);
}
