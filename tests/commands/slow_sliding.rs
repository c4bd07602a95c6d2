//! Brakes that creep: friction across the sliding, a dashpot of `mu p / V`, overdamps the modes that slide across.

use crate::prelude::*;

/// Frequencies and growth rates at friction 0.32, and what the command printed, of the brake of the operating matrix at 3 rpm.
fn spectrum(frictions: &str) -> (Vec<[f64; 2]>, String) {
    let folder = folder();
    let set = [
        "boundaries.Outer_Piston.pressure=1.5e6 ; boundaries.Inner_Piston.pressure=1.5e6 ; \
         motion.Disc_Disc_iron.rotation_speed_rpm=3 ; cea.max_frequency_hz=3100",
        &format!("cea.friction_coefficients={frictions}"),
    ];
    let run = Run::of("cea", shipped("operating-matrix.toml")).args(&["--unset", "sweep"]);
    let answer = run.out(folder.path()).set(&set).done();
    let rows = answer.rows("eigenvalues.csv").into_iter();
    let own = rows.filter(|row| row["friction_coefficient"] == "0.32");
    let modes = own.map(|row| row.numbers(["frequency_hz", "growth_rate_per_s"]));
    // How the input file was read is for `check` to say.
    let said = answer.said();
    assert!(!said.contains("are numbered from") && !said.contains("taken from"), "{said}");
    (modes.collect(), said)
}

/// Consistency check: the modes at one friction value do not depend on the values before it, through which branches end.
#[test]
fn modes_that_slow_sliding_overdamps_end_their_branches_and_are_said() {
    let (coarse, said) = spectrum("[0.0, 0.32]");
    for part in ["near critical damping", "2972 Hz from friction 0 on", "mu p / V"] {
        assert!(said.contains(part), "{part:?} is not in\n{said}");
    }
    let (fine, _) = spectrum("[0.0, 0.02, 0.16, 0.32]");
    assert_eq!(coarse.len(), fine.len());
    assert!(coarse.len() >= 5);
    for (a, b) in coarse.iter().zip(&fine) {
        let error = (a[0] - b[0]).hypot((a[1] - b[1]) / TAU) / a[0];
        assert!(error < 1e-8, "{a:?} {b:?}");
    }
}
