//! The examples run, and the claims that they assert hold.

#[path = "../../examples/annulus_modes.rs"]
mod annulus_modes;
#[path = "../../examples/friction_sweep.rs"]
mod friction_sweep;
#[path = "../../examples/limit_cycle.rs"]
mod limit_cycle;
#[path = "../../examples/parameter_study.rs"]
mod parameter_study;
#[path = "../../examples/studies.rs"]
mod studies;

#[test]
fn modes_of_an_annulus_are_those_of_the_continuum() {
    annulus_modes::main().unwrap();
}

#[test]
fn friction_sweep_finds_the_wave_that_turns_unstable_first() {
    friction_sweep::main().unwrap();
}

#[test]
fn a_parameter_study_finds_friction_to_decide() {
    parameter_study::main().unwrap();
}

#[test]
fn limit_cycle_closes_its_energy_balance() {
    limit_cycle::main().unwrap();
}

#[test]
fn studies_of_shipped_cases_take_a_handful_of_calls() {
    studies::main().unwrap();
}
