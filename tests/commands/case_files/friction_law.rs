//! Keys of friction that falls with speed.

use super::{DISC, RUN, assert_reports, parse, report, valid};
use frictionsim::contact::FrictionDecay;

const RATIO: &str = "contact.static_friction_ratio=1.4";
const SPEED: &str = "contact.decay_speed=0.2";

#[test]
fn both_keys_make_a_falling_law_and_a_ratio_of_one_a_constant_one() {
    assert_eq!(
        valid(DISC, &[RATIO, SPEED]).contact.sliding.decay,
        Some(FrictionDecay { static_ratio: 1.4, decay_speed: 0.2 })
    );
    let constant = ["contact.static_friction_ratio=1.0", SPEED];
    assert_eq!(valid(DISC, &constant).contact, valid(DISC, &[]).contact);
}

#[test]
fn a_law_that_rises_stands_still_or_is_half_given_is_refused_with_the_key() {
    for (overrides, parts) in [
        (
            vec!["contact.static_friction_ratio=0.9", SPEED],
            ["contact.static_friction_ratio = 0.9", "must be 1 or more"],
        ),
        (vec![RATIO, "contact.decay_speed=0.0"], ["contact.decay_speed = 0 ", "must be positive"]),
        (
            vec![RATIO, "contact.decay_speed=-0.2"],
            ["contact.decay_speed = -0.2", "must be positive"],
        ),
        (vec![RATIO], ["contact.static_friction_ratio = 1.4 needs", "decay_speed = 0.2"]),
        (vec![SPEED], ["without contact.static_friction_ratio", "static_friction_ratio = 1.4"]),
    ] {
        let report = report(DISC, &overrides);
        assert_reports(&report, &parts);
        assert_reports(&report, &["--set:"]);
    }
}

#[test]
fn what_needs_constant_friction_says_so() {
    const CYCLES: &str = include_str!("../../../cases/limit-cycle.toml");
    const BASIN: &str = include_str!("../../../cases/basin.toml");
    let parts = ["constant friction", "static_friction_ratio"];
    let cycles = valid(CYCLES, &[RATIO, SPEED]);
    let waves = cycles.require_rotating_waves().unwrap_err();
    assert_reports(&waves.to_string(), &parts);
    assert!(cycles.require_cycle().is_ok() && !cycles.has_rotating_waves());
    // Modes compete instead of waves.
    let basin = valid(BASIN, &[RATIO, SPEED]).require_basin().unwrap_err();
    assert_reports(&basin.to_string(), &["basin.harmonics is not used", "basin.modes"]);
    let start =
        [RATIO, SPEED, "transient.initial=\"limit-cycle\"", "transient.limit_cycle_harmonic=2"];
    assert_reports(&parse(RUN, &start).unwrap_err().to_string(), &parts);
}

#[test]
fn laws_and_springs_that_the_time_step_does_not_resolve_are_said() {
    let warned = |overrides: &[&str]| {
        let warnings = valid(RUN, overrides).warnings;
        warnings.iter().map(|w| w.to_string()).collect::<String>()
    };
    assert_eq!(warned(&[RATIO, SPEED]), "");
    assert_eq!(warned(&["contact.normal_stiffness=7.4e12"]), "");
    assert_reports(
        &warned(&[RATIO, "contact.decay_speed=0.01"]),
        &["contact.decay_speed", "transient.time_step below about"],
    );
    assert_reports(
        &warned(&["contact.normal_stiffness=1e16"]),
        &["contact.normal_stiffness", "flicker", "\"rigid\""],
    );
}
