//! Studies and files of bodies of revolution.

use crate::matrices::array_of;
use crate::prelude::*;
use frictionsim::study::eigenvalues::{modes_below, modes_with_waves_below, unstable_intervals};

const COARSE: [&str; 1] =
    ["mesh.circumferential_elements=24 ; mesh.radial_elements=5 ; mesh.axial_elements=1 ; \
     cea.friction_coefficients=[0.0, 0.6]"];

const DISC: &str = "disc-three-dimensions.toml";

fn run(command: &str, set: &[&str]) -> Answer {
    Run::of(command, shipped(DISC)).out("out").set(&COARSE).set(set).done()
}

/// Cross-method: what `fit` and `uncertainty` ask for is what `cea` finds of the same body, not of its plane section.
#[test]
fn modes_for_a_fit_and_onsets_of_a_sample_are_those_of_the_body_with_its_thickness() {
    let case = shipped_case(DISC, &COARSE);
    let known = modes_and_onsets(&case).unwrap();
    let intervals = unstable_intervals(&case, &[0.3, 0.6], None).unwrap().intervals;
    // Onsets are located to 1e-9, from other friction values.
    within(&criticals(&intervals), &criticals(&known.intervals), 1e-8);
    let modes = modes_below(&case, 10e3).unwrap();
    let point = known.points.iter().find(|point| point.friction_coefficient == 0.3).unwrap();
    assert!(modes.len() > 10);
    let error = largest_error(&eigenvalues_of(&point.modes), &eigenvalues_of(&modes));
    // The reduced spaces reach up to different frequencies.
    below(error, 1e-5, "modes of a fit");
    assert!(modes.iter().all(|mode| mode.axial_share.is_some()));
    // Every mode of a fit has its derivatives.
    let (modes, waves) = modes_with_waves_below(&case, 6e3, &[]).unwrap();
    let waves = waves.unwrap();
    let pairs = pairs(&waves.tangent, &waves.branches, 0.3);
    are_among(&modes, &pairs, 1e-6);
}

/// Holds modes to the eigenvalues of the pairs of their names.
fn are_among(modes: &[ComplexMode], pairs: &[cyclic::WavePair], tolerance: f64) {
    for mode in modes {
        let name = (mode.harmonic, mode.branch, mode.direction);
        let mut own = pairs.iter();
        let own = own.find(|pair| (pair.harmonic, pair.branch, pair.direction) == name);
        near_each(&[own.unwrap().eigenvalue], &[mode.eigenvalue], tolerance);
    }
}

/// Cross-method: of a disc under a ring on springs that its material's damping does not act on. Neither the ring nor the modes at rest
/// excite what these couple: frequencies were wrong by 2e-5, and their derivatives by damping up to a factor of two.
#[test]
fn modes_of_a_damped_disc_on_springs_are_those_of_its_whole_harmonics() {
    let set = [
        "mesh.circumferential_elements=12 ; mesh.radial_elements=4 ; mesh.axial_elements=1",
        "damping.mass_coefficient=40.0 ; damping.stiffness_coefficient=4.5e-7",
        "boundaries.inner={condition=\"support\",normal_stiffness=3e11,tangential_stiffness=1e11,axial_stiffness=2e11}",
        "boundaries.bottom={condition=\"support\",normal_stiffness=1e11,tangential_stiffness=3e10,normal_damping=1e3}",
    ];
    let case = shipped_case("ring-on-disc.toml", &set);
    let (modes, waves) = modes_with_waves_below(&case, 9e3, &[]).unwrap();
    let waves = waves.unwrap();
    let friction = case.contact.sliding.friction_coefficient;
    let pairs = pairs(&waves.tangent, &waves.branches, friction);
    assert!(modes.len() > 4, "{modes:?}");
    are_among(&modes, &pairs, 1e-8);
}

/// Falling friction is a negative dashpot: squeal from a lower friction on, and the law is said.
#[test]
fn friction_that_falls_with_the_speed_is_said_and_destabilizes_a_body_with_thickness() {
    let lowest = |law: &[&str]| {
        let answer = run("cea", law).wrote("sensitivities.csv");
        let onset = answer.summary()["critical_frictions"][0]["critical_friction"].as_f64();
        (answer, onset.unwrap())
    };
    let (answer, falling) =
        lowest(&["contact.static_friction_ratio=1.4 ; contact.decay_speed=2.0"]);
    answer.says(&["friction falls with speed", "rises by 1 %", "decay_speed"]);
    let (answer, constant) = lowest(&[]);
    answer.says(&["!friction falls with speed"]);
    assert!(falling < constant, "{falling} {constant}");
}

#[test]
fn the_contact_file_of_a_body_with_thickness_has_both_parts_of_the_shear() {
    let set = "mesh.element=quad4 ; transient.duration=2e-5 ; transient.initial=steady-sliding";
    let archive = run("transient", &[set]);
    let header = |name: &str| array_of(&archive.path("contact.npz"), name).0;
    // 24 sectors with two rings of nodes, as many frames as of the other part.
    let across = header("shear_across_pa.npy");
    assert_eq!(across, header("shear_pa.npy"));
    assert!(across.contains(",48,)"), "{across}");
}

/// One ring of nodes on springs that carry the base state is pressed over a part of an element, not along a line.
#[test]
fn a_ring_on_springs_of_the_base_state_is_no_line() {
    let set = ["mesh.element=quad4 ; mesh.circumferential_elements=12 ; mesh.radial_elements=3 ; \
         mesh.axial_elements=1 ; cea.friction_coefficients=[0.4]"];
    let run = Run::of("cea", shipped("ring-on-disc.toml")).out("out").set(&set);
    run.done().says(&["1 of 2 rings of contact nodes are open", "!has shrunk"]);
}
