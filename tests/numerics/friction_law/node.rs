//! The implicit law at one node.

use crate::prelude::*;

const DECAY: FrictionDecay = FrictionDecay { static_ratio: 1.4, decay_speed: 0.2 };

const LAW: CoulombFriction = CoulombFriction { friction_coefficient: 0.3, decay: Some(DECAY) };

fn resolve(inertia: f64, free_slip: f64, slip_before: f64, normal: f64) -> Friction<f64> {
    let node = Slipping { inertia, free_slip, slip_before };
    LAW.resolve(&node, normal)
}

/// Theory: the force moves the node to the slip velocity that the law asks the force for, or holds it within the cone.
#[test]
fn the_force_on_a_node_is_that_of_the_slip_that_it_leads_to() {
    let (inertia, normal) = (8800.0, 2000.0);
    for k in -400..=400 {
        let free = 0.005 * f64::from(k);
        for before in [-2.0, -0.1, 0.0, 0.1, 2.0] {
            let found = resolve(inertia, free, before, normal);
            let slip = free - found.force / inertia;
            let largest = 0.3 * normal * DECAY.share(0.0);
            assert!(!found.is_ambiguous);
            if found.status == ContactStatus::Stick {
                // One rounding of the force.
                assert!(slip.abs() < 1e-15 && found.force.abs() <= largest);
            } else {
                assert!(slip * free > 0.0 && free.abs() * inertia > largest);
                // The mean velocity of the step, from rest where the slip turns round.
                let turns = before * slip < 0.0;
                let speed = if turns { 0.5 * slip } else { 0.5 * (before + slip) };
                let law = 0.3 * normal * DECAY.share(speed) * slip.signum();
                assert!((found.force - law).abs() < 1e-12 * largest, "{free} {slip}");
            }
        }
    }
}

/// Theory: at the turn from stick to slip the force is continuous in the slip velocity before, whose sign is one of rounding there.
#[test]
fn rounding_of_a_node_that_stuck_does_not_choose_its_force() {
    let (inertia, normal) = (8800.0, 2000.0);
    for free in [0.0955, 0.1, 0.3, -0.1] {
        let of = |before: f64| resolve(inertia, free, before, normal).force;
        let still = of(0.0);
        near_each(&[1e-17, -1e-17].map(of), &[still; 2], 1e-14);
        let surface = [1e-17, -1e-17].map(|before| {
            let node = Slipping { inertia, free_slip: [free, 0.0], slip_before: [before, before] };
            LAW.resolve_point(&node, normal).force[0]
        });
        near_each(&surface, &[still; 2], 1e-14);
    }
}

/// Theory: where the law falls faster than the inertia of a node allows, a range of motions has three answers, and
/// the node keeps to the side that it is on.
#[test]
fn a_law_too_steep_for_the_inertia_is_reported_and_keeps_stick_and_slip_apart() {
    // N |mu'(0)| = 1200, twice the inertia.
    let (inertia, normal) = (600.0, 2000.0);
    // Sticks up to 1.4 where it stuck, slips down to 1.338 where it slipped.
    let held = resolve(inertia, 1.37, 0.0, normal);
    let moving = resolve(inertia, 1.37, 0.5, normal);
    assert_eq!(held.status, ContactStatus::Stick);
    assert_eq!(moving.status, ContactStatus::Slip);
    assert!(held.is_ambiguous && moving.is_ambiguous);
    let slip = 1.37 - moving.force / inertia;
    let law = 0.3 * normal * DECAY.share(slip);
    assert!(slip > 0.0 && (moving.force / law - 1.0).abs() < 1e-12);
    let starts = [(1.41, 0.0, ContactStatus::Slip), (1.3, 0.5, ContactStatus::Stick)];
    for (free, before, status) in starts {
        let found = resolve(inertia, free, before, normal);
        assert_eq!(found.status, status);
        assert!(!found.is_ambiguous);
    }
}
