//! Limit cycles of bodies in three dimensions: motions of the whole mesh, as of plane bodies.
//!
//! Independent: a transient that grows into its cycle from noise, with a step of its own. The others are identities.

use crate::cycle_periodic::{found, hold_to_transient};
use crate::prelude::*;

/// A pad on a disc that turns, the seam of the disc glued.
const PAD: &str = include_str!("../cases/pad-on-a-turning-disc.toml");

pub fn pad(folder: &Path, around: usize, overrides: &[&str]) -> Case {
    let blocks = [
        brick("disc", [0.03, 0.0, 0.0], [0.04, TAU, 0.006], [2, around, 1]),
        brick("pad", [0.045, -0.3, 0.006], [0.022, 0.6, 0.01], [2, 3, 1]),
    ];
    fs::write(folder.join("body.msh"), file_of(&blocks, polar)).unwrap();
    case_of(folder.join("pad.toml"), PAD, overrides)
}

#[test]
fn the_cycle_of_a_pad_on_a_disc_is_that_of_its_transient() {
    let result = hold_to_transient(&pad(folder().path(), 16, &[]));
    let cycle = found(&result);
    let motion = &cycle.motion;
    // The balance of the time loop closes; what the motion misses its start by is left.
    assert!(motion.powers.balance_residual() < 1e-6);
    assert!(cycle.confirmation.as_ref().unwrap().agrees);
    // Nodes lift off and strike again: no linear vibration.
    let lifts = |share: &[f64; 3]| share[1] > 0.01 && share[2] > 0.01;
    assert!(motion.shares.iter().any(lifts), "{:?}", motion.shares);
    // Sound of the two faces of the disc and what is flat of the pad.
    let sound = cycle.sound.as_ref().unwrap();
    assert!(sound.power_w > 0.0 && sound.area_m2 > 0.02, "{sound:?}");
}

/// A body of revolution in three dimensions, whose friction is a vector on a ring: its transient grows into a rotating wave.
#[test]
fn the_cycle_of_a_ring_on_a_layer_is_that_of_its_transient() {
    let result = hold_to_transient(&shipped_case(
        "ring-on-layer.toml",
        &["mesh.circumferential_elements=24 ; mesh.radial_elements=7 ; mesh.axial_elements=1 ; \
             contact.friction_coefficient=0.4 ; cycle={ onsets = \"lowest\" } ; \
             transient.duration=0.03 ; transient.time_step=1e-6 ; \
             transient.perturbation={ harmonics = [1, 2], velocity = 0.01 } ; output.snapshots=[]"],
    ));
    let cycle = found(&result);
    assert!(cycle.motion.powers.balance_residual() < 1e-6);
    assert!(cycle.confirmation.as_ref().unwrap().agrees);
}

/// Consistency: what was kept when it stopped, and the rest anew, is the same, bit by bit.
#[test]
fn a_branch_of_solid_bodies_goes_on_after_an_interruption_bit_by_bit() {
    // More values than the twenty points between which what is done is kept.
    let count = sized(21, 24);
    let range = format!(
        "cycle={{ confirmation_periods = 0, stability = \"none\", continuation = {{ key = \
                 \"contact.friction_coefficient\", from = 0.46, to = 0.5, count = {count} }} }}"
    );
    let case = pad(folder().path(), sized(12, 16), &[&range]);
    let run = |kept: &Kept| -> Vec<PeriodicResult> {
        PeriodicStudy::new(&case, SimdLevel::detect()).unwrap().run(1, kept, &|_| {}).unwrap()
    };
    let first = Kept::default();
    let whole = run(&first);
    let steps = first.count();
    assert!(steps > 2, "{steps}");
    let resumed = run(&first.after(steps - 1));
    assert_eq!(whole.len(), resumed.len());
    for (a, b) in whole.iter().zip(&resumed) {
        let (a, b) = (found(a), found(b));
        assert_eq!(a.motion, b.motion);
        let [a, b] = [a, b].map(|own| &own.branch.as_ref().unwrap().motions);
        assert!(a.len() > count - 1 && a.len() == b.len(), "{} {}", a.len(), b.len());
        assert!(a.iter().zip(b).all(|(a, b)| (a.value, &a.motion) == (b.value, &b.motion)));
    }
}
