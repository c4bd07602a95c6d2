//! Keys of friction that falls with speed.

use super::*;
use frictionsim::study::cycle::CycleStudy;

const RATIO: &str = "contact.static_friction_ratio=1.4";
const SPEED: &str = "contact.decay_speed=0.2";

#[test]
fn both_keys_make_a_falling_law_and_a_ratio_of_one_a_constant_one() {
    let falling = FrictionDecay { static_ratio: 1.4, decay_speed: 0.2 };
    assert_eq!(valid(DISC, &[RATIO, SPEED]).contact.sliding.decay, Some(falling));
    let constant = ["contact.static_friction_ratio=1.0", SPEED];
    assert_eq!(valid(DISC, &constant).contact, valid(DISC, &[]).contact);
}

#[test]
fn what_needs_constant_friction_says_so() {
    let parts = ["constant friction", "static_friction_ratio"];
    let cycles = shipped_case("limit-cycle.toml", &[RATIO, SPEED]);
    let waves = CycleStudy::new(&cycles, SimdLevel::detect()).err().unwrap();
    has(&waves.to_string(), &parts);
    assert!(cycles.require_cycle().is_ok() && !cycles.has_rotating_waves());
    // Modes compete instead of waves.
    let basin = shipped_case("basin.toml", &[RATIO, SPEED]).require_basin().unwrap_err();
    has(&basin.to_string(), &["basin.harmonics is not used", "basin.modes"]);
}

#[test]
fn laws_and_springs_that_the_time_step_resolves_are_plausible() {
    for resolved in [&[RATIO, SPEED][..], &["contact.normal_stiffness=7.4e12"]] {
        assert_eq!(valid(RUN, resolved).warnings, []);
    }
}
