//! Consistency checks of warnings: what is possible but hardly meant is said, with the reason.

use super::*;

#[test]
fn shipped_cases_are_plausible() {
    for text in [DISC, RUN, STUDY] {
        assert_eq!(valid(text, &[]).warnings, []);
    }
    // An interference of 4 % of the radius.
    assert_eq!(valid(DISC, &["contact.interference=9e-4"]).warnings, []);
    assert!(valid(RUN, &[]).deny_warnings(&[]).is_ok());
}

#[test]
fn keys_that_an_analysis_ignores_are_said() {
    let case = shipped_case("limit-cycle.toml", &["contact.normal_stiffness=7e12"]);
    let said = "contact.normal_stiffness is not used by cycle: its contact is rigid";
    assert_eq!(case.ignored_by("cycle")[0].message, said);
    assert!(case.ignored_by("cea").is_empty());
    // Contact that stiffens has no rotating waves: every command uses its law.
    let law = KEYS.iter().find(|key| key.name == "contact.normal_law").unwrap();
    assert!(law.of_waves.is_empty());
    assert!(valid(RUN, &["contact.normal_stiffness=7e12"]).ignored_by("transient").is_empty());
    let rigid = valid(RUN, &["contact.normal_stiffness=rigid", "damping.include_contact=true"]);
    assert!(rigid.ignored_by("transient").is_empty());
}

#[test]
fn a_slip_of_units_is_named_before_what_it_makes_impossible() {
    let text = report(RUN, &["damping.stiffness_coefficient=45"]);
    let [slip, consequence] =
        ["modes there do not vibrate", "time steps"].map(|part| text.find(part).expect(part));
    assert!(slip < consequence, "{text}");
}
