//! Consistency checks of the case parser: shipped cases, overrides, ranges, messages, robustness.

mod agreement;
mod friction_law;
mod keys;
mod plausibility;
mod sizes;
mod suggestions;

use crate::prelude::*;
use frictionsim::case::{CeaMethod, RawCase, Spacing, range_values};
use proptest::prelude::*;

const CYCLES: &str = include_str!("../../../cases/limit-cycle.toml");
const DISC: &str = include_str!("../../../cases/polycarbonate-disc.toml");
const RUN: &str = include_str!("../../../cases/polycarbonate-610rpm.toml");
const STUDY: &str = include_str!("../../../cases/speed-friction-study.toml");

fn parse(text: &str, overrides: &[&str]) -> Result<Case, CaseErrors> {
    read_case("case.toml", text, overrides)
}

fn valid(text: &str, overrides: &[&str]) -> Case {
    case_of("case.toml", text, overrides)
}

fn report(text: &str, overrides: &[&str]) -> String {
    parse(text, overrides).expect_err("a valid case").to_string()
}

#[test]
fn the_disc_case_holds_the_model_of_the_paper() {
    let case = valid(DISC, &[]);
    let cea = case.require_cea().unwrap();
    assert_eq!(case.body.grid().unwrap().element, Quad8);
    assert_eq!(case.body.grid().unwrap().circumferential_elements, 150);
    assert_eq!(cea.friction_coefficients.len(), 51);
    assert!(cea.friction_coefficients.contains(&0.3));
    assert_eq!(cea.shapes_at, [0.3]);
    assert_eq!(cea.modes, MaxFrequency(17500.0));
    assert_eq!(cea.method, CeaMethod::Auto);
    assert_eq!(case.contact.stiffness.normal_stiffness, Some(7.4e12));
    // 610 revolutions a minute.
    assert_eq!(case.contact.sliding.rotation_speed, 610.0 * TAU / 60.0);
}

#[test]
fn every_key_is_known_where_the_table_of_keys_puts_it() {
    for key in KEYS.iter() {
        let text = format!("{}={}", key.name, key.example);
        let errors = parse("", &[&text]).expect_err("an empty case is valid");
        for error in &errors.diagnostics {
            has(&error.message, &["!unknown", "! must be "]);
        }
    }
}

#[test]
fn the_swept_points_are_the_grid_in_order_with_the_last_key_fastest() {
    let case = valid(STUDY, &[]);
    let sweep = case.require_sweep().unwrap();
    assert_eq!(sweep.point_count(), 72);
    assert_eq!(sweep.overrides(25)[0], "contact.friction_coefficient=0.3");
    let speeds = range_values(10.0, 6000.0, 24, Spacing::Logarithmic);
    for index in [0, 25, 71] {
        let raw = case.raw.sweep_point(&sweep.overrides(index)).unwrap();
        let speed = Case::from_raw(raw).unwrap().contact.sliding.rotation_speed / TAU * 60.0;
        // Two roundings of a product by 2 pi / 60.
        assert!((speed / speeds[index % 24] - 1.0).abs() < 1e-15);
    }
}

#[test]
fn zipped_keys_run_side_by_side() {
    let zipped =
        valid(STUDY, &["sweep.combine=zip", "sweep.\"contact.rotation_speed_rpm\"=[70, 300, 610]"]);
    let sweep = zipped.require_sweep().unwrap();
    assert_eq!(sweep.point_count(), 3);
    let keys = ["contact.friction_coefficient=0.3", "contact.rotation_speed_rpm=300"];
    assert_eq!(sweep.overrides(1), keys);
}

#[test]
fn swept_keys_may_be_written_with_or_without_quotes() {
    let plain = STUDY.replace("\"contact.friction_coefficient\"", "contact.friction_coefficient");
    let keys = |text: &str| valid(text, &[]).sweep.unwrap().keys.len();
    assert_eq!(keys(&plain), keys(STUDY));
}

#[test]
fn overrides_change_exactly_their_key() {
    let case = valid(
        DISC,
        &["contact.friction_coefficient=0.45 ; mesh.element=quad4 ; mesh.radial_elements=12 ; \
             cea.friction_coefficients={ from = 0, to = 0.6, count = 3 }"],
    );
    assert_eq!(case.contact.sliding.friction_coefficient, 0.45);
    assert_eq!(case.body.grid().unwrap().element, Quad4);
    assert_eq!(case.body.grid().unwrap().radial_elements, 12);
    assert_eq!(case.body.grid().unwrap().circumferential_elements, 150);
    assert_eq!(case.cea.unwrap().friction_coefficients, [0.0, 0.3, 0.6]);
    // A part of a range, one way to select modes in place of the other, and a word in place of a number.
    let case = valid(DISC, &["cea.friction_coefficients.count=101"]);
    assert_eq!(case.cea.unwrap().friction_coefficients.len(), 101);
    assert_eq!(valid(DISC, &["cea.modes=28"]).cea.unwrap().modes, Lowest(28));
    let case = valid(DISC, &["contact.normal_stiffness=rigid"]);
    assert_eq!(case.contact.stiffness.normal_stiffness, None);
}

#[test]
fn the_hash_sees_values_and_not_their_spelling() {
    let hash = |text: &str, overrides: &[&str]| valid(text, overrides).raw.hash();
    let plain = hash(DISC, &[]);
    let respelt = DISC
        .replace("40.0 ", "4e1 ")
        .replace("  # paper", "# from the paper")
        .replace("radial_grading = 1.0", "radial_grading = 1")
        .replace("[damping]\n", "\n\n[damping]\n\n");
    assert_ne!(respelt, DISC);
    assert_eq!(hash(&respelt, &[]), plain);
    assert_eq!(hash(DISC, &["contact.friction_coefficient=0.30"]), plain);
    assert_ne!(hash(DISC, &["contact.friction_coefficient=0.31"]), plain);
}

#[test]
fn canonical_text_is_a_case_of_the_same_hash() {
    for text in [DISC, RUN, STUDY] {
        let case = valid(text, &[]);
        let again = valid(&case.raw.canonical(), &[]);
        assert_eq!(again.raw.hash(), case.raw.hash());
        assert_eq!(again.cea, case.cea);
        assert_eq!(again.transient, case.transient);
    }
}

#[test]
fn all_errors_of_a_case_are_reported_at_once() {
    let text = DISC
        .replace("density = 1228.0", "density = -1\ncolour = \"red\"")
        .replace("inner_radius = 0.0205", "inner_radius = 0.1")
        .replace("[damping]", "[dampng]");
    let errors = parse(&text, &["contact.interference=0"]).unwrap_err();
    assert_eq!(errors.diagnostics.len(), 5, "{errors}");
    let said = "did you mean `damping`? ; material.colour ; must be above ; --set:1:";
    has(&errors.to_string(), &[said]);
}

#[test]
fn windows_line_ends_and_a_byte_order_mark_are_read() {
    let text = format!("\u{feff}{}", DISC.replace('\n', "\r\n"));
    assert_eq!(valid(&text, &[]).raw.hash(), valid(DISC, &[]).raw.hash());
    let [case, deck] = ["brake.toml", "meshes/brake.inp"].map(shipped);
    let deck = fs::read_to_string(deck).unwrap().replace('\n', "\r\n");
    let case = fs::read_to_string(case).unwrap().replace("meshes/", "");
    let files = [("brake.toml", case), ("brake.inp", format!("\u{feff}{deck}"))];
    Run::of("check", "brake.toml").beside(&files).done();
}

#[test]
fn shapes_are_solved_for_beside_the_values_of_the_tables() {
    let overrides = ["cea.friction_coefficients=[0.5, 0.1]", "cea.shapes_at=[0.3, 0.5]"];
    let cea = valid(DISC, &overrides).cea.unwrap();
    assert_eq!(cea.friction_coefficients, [0.1, 0.5]);
    assert_eq!(cea.solved_friction_coefficients(), [0.1, 0.3, 0.5]);
}

#[test]
fn estimated_step_bounds_the_known_highest_frequency() {
    // The highest frequency of this mesh is 5.0e6 rad/s, which with this damping allows 0.153 us.
    let step = valid(RUN, &[]).cost().transient.unwrap().time_step;
    assert!((0.11e-6..0.153e-6).contains(&step), "{step}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn any_number_for_any_key_is_read_or_refused(
        which in 0..KEYS.len(),
        value in prop_oneof![
            any::<f64>().prop_map(|value| format!("{value:e}")),
            any::<i64>().prop_map(|value| value.to_string()),
        ],
    ) {
        let overrides = [format!("{}={value}", KEYS[which].name)];
        if let Ok(case) = Case::parse("x", RUN.as_bytes(), &overrides) {
            prop_assert!(case.cost().nodes > 0);
        }
    }

    #[test]
    fn an_override_reads_back_the_number_it_was_given(value in 1e-300..1e25f64) {
        let overrides = [format!("contact.normal_stiffness={value:?}")];
        let raw = RawCase::parse("x", DISC.as_bytes(), &overrides).unwrap();
        let case = Case::from_raw(raw).unwrap();
        prop_assert_eq!(case.contact.stiffness.normal_stiffness, Some(value));
    }
}

#[test]
fn a_start_on_a_limit_cycle_names_its_harmonic_and_onset() {
    for (harmonic, onset, more) in [(2, 1, ""), (1, 2, " ; transient.limit_cycle_onset=2")] {
        let start = "transient.initial=\"limit-cycle\" ; transient.limit_cycle_harmonic";
        let case = valid(RUN, &[&format!("{start}={harmonic}{more}")]);
        let initial = case.require_transient().unwrap().settings.initial;
        assert_eq!(initial, InitialState::LimitCycle { harmonic, onset });
    }
}
