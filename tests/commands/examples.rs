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

macro_rules! examples_run {
    ($($test:ident: $example:ident,)*) => {
        $(#[test]
        fn $test() {
            $example::main().unwrap();
        })*
    };
}

examples_run! {
    modes_of_an_annulus_are_those_of_the_continuum: annulus_modes,
    friction_sweep_finds_the_wave_that_turns_unstable_first: friction_sweep,
    a_parameter_study_finds_friction_to_decide: parameter_study,
    limit_cycle_closes_its_energy_balance: limit_cycle,
    studies_of_shipped_cases_take_a_handful_of_calls: studies,
}

/// `examples/gallery` draws one picture of each case, and `cases/README.md` shows it.
#[test]
fn the_gallery_has_a_picture_of_every_shipped_case() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = std::fs::read_to_string(root.join("cases/README.md")).unwrap();
    let script = std::fs::read_to_string(root.join("examples/gallery")).unwrap();
    for case in frictionsim::app::shipped::all_cases() {
        let picture = format!("examples/figures/gallery/{}.png", case.name());
        assert!(root.join(&picture).exists(), "{picture}: run examples/gallery");
        assert!(readme.contains(&format!("(../{picture})")), "{picture}");
        assert!(script.contains(&format!("\ndraw {} ", case.name())), "{picture}");
    }
}
