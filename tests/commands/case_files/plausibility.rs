//! Consistency checks of warnings: what is possible but hardly meant is said, with the reason.

use super::{DISC, RUN, STUDY, assert_reports, report, valid};
use frictionsim::case::KEYS;

#[test]
fn slips_of_units_are_said() {
    for (overrides, parts) in [
        (vec!["contact.interference=25"], ["of geometry.inner_radius", "25e-6"]),
        (vec!["contact.interference=9e-4"], ["0.04", ""]),
        (vec!["contact.friction_coefficient=30"], ["above 2", "ratio"]),
        (vec!["cea.shapes_at=[0.3, 3]"], ["cea.shapes_at = 3", "above 2"]),
        (
            vec!["geometry.inner_radius=20.5", "geometry.outer_radius=90.5"],
            ["geometry.inner_radius = 20.5", "millimetres"],
        ),
        (vec!["material.young_modulus=2500"], ["waves of", "not MPa"]),
        (vec!["material.density=1.228"], ["waves of", "g/cm3"]),
        (vec!["material.poisson_ratio=0.495"], ["incompressible", "time step"]),
        (vec!["contact.normal_stiffness=1e21"], ["contact.normal_stiffness", "rigid"]),
        (vec!["damping.stiffness_coefficient=1e-3"], ["damping factor", "do not vibrate"]),
    ] {
        let case = valid(DISC, &overrides);
        let all: Vec<String> = case.warnings.iter().map(ToString::to_string).collect();
        if parts[0] == "0.04" {
            assert!(all.is_empty(), "{all:?}");
            continue;
        }
        assert_eq!(all.len(), 1, "{overrides:?}: {all:?}");
        assert_reports(&all[0], &parts);
    }
}

#[test]
fn a_pressure_near_the_modulus_is_said() {
    // A thin ring between its two edges: a strain of 0.2 over its width.
    let case = valid(DISC, &["geometry.outer_radius=0.0225", "contact.interference=4e-4"]);
    let warning = case.warnings[0].to_string();
    assert_reports(&warning, &["contact pressure", "strains are not small"]);
}

#[test]
fn shipped_cases_are_plausible() {
    for text in [DISC, RUN, STUDY] {
        assert_eq!(valid(text, &[]).warnings, []);
    }
}

#[test]
fn denied_warnings_are_errors_with_their_place() {
    let case = valid(RUN, &["contact.friction_coefficient=30"]);
    let errors = case.deny_warnings(&[]).unwrap_err().to_string();
    assert_reports(&errors, &["above 2", "--set:1:", "^"]);
    assert!(valid(RUN, &[]).deny_warnings(&[]).is_ok());
}

#[test]
fn keys_that_an_analysis_ignores_are_said() {
    const CYCLES: &str = include_str!("../../../cases/limit-cycle.toml");
    let case = valid(CYCLES, &["contact.normal_stiffness=7e12"]);
    let ignored = case.ignored_by("cycle");
    assert_eq!(
        ignored[0].message,
        "contact.normal_stiffness is not used by cycle: its contact is rigid"
    );
    assert!(case.ignored_by("cea").is_empty());
    // Contact that stiffens has no rotating waves: every command uses its law.
    let law = KEYS.iter().find(|key| key.name == "contact.normal_law").unwrap();
    assert!(law.of_waves.is_empty());
    let compliant = valid(RUN, &["contact.normal_stiffness=7e12"]);
    assert!(compliant.ignored_by("transient").is_empty());
    let sliding = valid(RUN, &["transient.initial=\"steady-sliding\""]);
    assert_reports(&sliding.warnings[0].to_string(), &["transient.expansion_time is not used"]);
    let rigid = valid(RUN, &["contact.normal_stiffness=rigid", "damping.include_contact=true"]);
    assert!(rigid.ignored_by("transient").is_empty());
}

#[test]
fn slips_of_thickness_and_of_seeds_are_said_by_their_own_key() {
    let thick = valid(RUN, &["geometry.thickness=9"]);
    assert_reports(
        &thick.warnings[0].to_string(),
        &["geometry.thickness = 9 m is outside the plausible range", "to 1 m"],
    );
    let seeds = ["transient.perturbation.harmonics=[2]", "transient.perturbation.velocity=1000"];
    let fast = valid(RUN, &seeds);
    assert_reports(
        &fast.warnings[0].to_string(),
        &["transient.perturbation.velocity", "strains are not small"],
    );
}

/// What cannot run because of a slip of units names the slip before its consequence.
#[test]
fn a_slip_of_units_is_named_before_what_it_makes_impossible() {
    let text = report(RUN, &["damping.stiffness_coefficient=45"]);
    let [slip, consequence] =
        ["modes there do not vibrate", "time steps"].map(|part| text.find(part).expect(part));
    assert!(slip < consequence, "{text}");
}

#[test]
fn numbers_beyond_reason_are_refused() {
    for (overrides, parts) in [
        (
            vec!["contact.friction_coefficient=1e18"],
            ["beyond any friction coefficient", "at most 1000"],
        ),
        (
            vec!["cea.friction_coefficients=[0.1, 1e18]"],
            ["cea.friction_coefficients = 1e18", "at most 1000"],
        ),
        (vec!["material.young_modulus=1e18"], ["as no material has them", "Pa and kg/m3"]),
    ] {
        assert_reports(&report(DISC, &overrides), &parts);
    }
    let seeds = ["transient.perturbation.harmonics=[2]", "transient.perturbation.velocity=1e100"];
    assert_reports(&report(RUN, &seeds), &["faster than waves in the material"]);
}

/// A deviation in the unit of the key is the classic slip.
#[test]
fn a_log_normal_deviation_in_the_unit_of_the_key_is_refused() {
    let distributions = "[uncertainty.distributions]\n\"contact.normal_stiffness\" = ";
    let of = |scatter: &str| format!("{DISC}\n{distributions}{{ log_normal = {scatter} }}\n");
    let text = report(&of("[7.4e12, 7.4e11]"), &[]);
    assert_reports(&text, &["standard deviation of the natural logarithm", "[median, 0.1]"]);
    assert!(valid(&of("[7.4e12, 0.3]"), &[]).uncertainty.is_some());
}

#[test]
fn an_annulus_under_a_pressure_is_refused_for_the_pressure_alone() {
    let pressed = [
        "contact.interference=0",
        "boundaries={ outer = { condition = \"pressure\", pressure = 1e6 } }",
    ];
    let text = report(DISC, &pressed);
    assert!(text.contains("nothing holds the disc"), "{text}");
    assert!(!text.contains("contact.interference = 0.0 must be positive"), "{text}");
}

#[test]
fn slips_of_stiffness_density_and_speed_are_said_by_their_own_key() {
    for (change, said) in [
        ("contact.normal_stiffness=1e3", "the body hardly feels it"),
        ("material.density=1.1", "material.density"),
        ("contact.rotation_speed_rpm=3e6", "the contact slides at"),
    ] {
        let warnings = valid(RUN, &[change]).warnings;
        assert!(warnings.iter().any(|own| own.message.contains(said)), "{change}: {warnings:?}");
    }
}
