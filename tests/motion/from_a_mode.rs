//! Transients that start from a mode of the eigenvalue analysis: both have one model.

use crate::cycle_solids::pad;
use crate::prelude::*;
use frictionsim::study::eigenvalues::modes_with_waves_below;

/// A lining glued to a plate that presses it on a turning disc.
const GLUED: &str = include_str!("../cases/lining-glued-to-a-plate.toml");
const BLOCK: &str = include_str!("../cases/block-under-falling-friction.toml");

/// Changes with which the eigenvalue analysis has what the transient has.
const AS_STEPPED: &str = "cea.mass=\"lumped\" ; cea.geometric_stiffness=false";

/// Cross-method: on a coarse mesh the transient of a case starts from the mode of its eigenvalue analysis that grows most, and stays
/// on it. The springs of both are at the nodes.
#[track_caller]
fn grows_from_its_mode(case: &Case, limit_hz: f64) {
    let own = [case.contact.sliding.friction_coefficient];
    let (modes, _) = modes_with_waves_below(case, limit_hz, &own).unwrap();
    let study = TransientStudy::new(case, SimdLevel::detect()).unwrap();
    grows_from(study.body(), fastest(&modes));
}

/// A pad of six bricks on a disc that turns, half of its nodes open.
#[test]
fn a_pad_on_springs_on_a_disc_grows_from_its_mode() {
    let springs = "contacts.pad.normal_stiffness=1e11";
    grows_from_its_mode(&pad(folder().path(), 16, &[AS_STEPPED, springs]), 6e3);
}

/// A damped lining glued to a plate of another mesh, whose nodes it follows: velocities of such nodes counted twice.
#[test]
fn a_damped_lining_that_follows_a_plate_grows_from_its_mode() {
    let blocks = [
        brick("disc", [0.0; 3], [0.06, 0.06, 0.008], [3, 3, 1]),
        brick("lining", [0.01, 0.01, 0.008], [0.04, 0.04, 0.006], [2, 2, 1]),
        brick("plate", [0.01, 0.01, 0.014], [0.04, 0.04, 0.004], [3, 3, 1]),
    ];
    let mesh = file_of(&blocks, |point| point);
    for damping in ["stiffness_coefficient=1e-6", "mass_coefficient=3000.0"] {
        let damping = format!("materials.lining.{damping}");
        let changes = [AS_STEPPED, damping.as_str()];
        let case = case_beside("lining-from-a-mode", &[("body.msh", &mesh)], GLUED, &changes);
        grows_from_its_mode(&case, 3e4);
    }
}

/// Rigid contact, springs, and springs of which a row is open.
#[test]
fn a_block_on_a_rigid_plane_grows_from_its_mode() {
    let block = [brick("block", [0.0; 3], [0.04, 0.03, 0.02], [3, 2, 2])];
    let open = "contact.normal_stiffness=1e12 ; contact.friction_coefficient=0.8 ; \
                contact.interference=1e-7";
    let kinds = [
        (1, "contact.speed=1.0", 8e3),
        (1, "contact.normal_stiffness=1e12", 8e3),
        (1, open, 2e4),
        (2, "contact.normal_stiffness=1e12", 8e3),
    ];
    for (order, changes, limit_hz) in kinds {
        let file = file_of_order(&block, order, |point| point);
        let changes = [AS_STEPPED, "transient.duration=0.01", changes];
        let case = case_beside("block-from-a-mode", &[("body.msh", &file)], BLOCK, &changes);
        grows_from_its_mode(&case, limit_hz);
    }
}
