//! Brakes that creep: friction across the sliding, a dashpot of `mu p / V`, overdamps the modes that slide across.

use crate::prelude::*;

/// Eigenvalues at friction 0.32, and what the command printed, of the brake of the operating matrix at 3 rpm.
fn spectrum(frictions: &str) -> (Vec<c64>, String) {
    let set = [
        "boundaries.Outer_Piston.pressure=1.5e6 ; boundaries.Inner_Piston.pressure=1.5e6 ; \
         motion.Disc_Disc_iron.rotation_speed_rpm=3 ; cea.max_frequency_hz=3000",
        &format!("cea.friction_coefficients={frictions}"),
    ];
    let run = Run::of("cea", shipped("operating-matrix.toml")).args(&["--unset", "sweep"]);
    let answer = run.out("out").set(&set).done();
    // How the input file was read is for `check` to say.
    let said = answer.said();
    has(&said, &["!are numbered from ; !taken from"]);
    (answer.modes("0.32"), said)
}

/// Consistency check: the modes at one friction value do not depend on the values before it, through which branches end.
#[test]
fn modes_that_slow_sliding_overdamps_end_their_branches_and_are_said() {
    let (coarse, said) = spectrum("[0.0, 0.32]");
    has(&said, &["near critical damping ; 2972 Hz from friction 0 on ; mu p / V"]);
    let (fine, _) = spectrum("[0.0, 0.16, 0.32]");
    assert!(coarse.len() >= 5);
    near_each(&coarse, &fine, 8e-9);
}

/// A cup on a ball and a shoe on a shaft, by the unit cube.
fn bent(counterface: &str, [u, v, w]: [f64; 3]) -> [f64; 3] {
    let (along, radius) = (1.2 * (u - 0.5), 0.016 + 0.004 * w);
    if counterface == "cylinder" {
        return [radius * along.cos(), radius * along.sin(), 0.02 * v];
    }
    let arm = [along, 1.2 * (v - 0.5), 1.0];
    arm.map(|x| x / arm.iter().map(|x| x * x).sum::<f64>().sqrt() * radius)
}

/// Independent: a dense decomposition of the exported matrices. Friction overdamps what slides across; nothing else is lost.
#[test]
fn bodies_that_creep_on_cylinders_and_balls_have_every_mode_of_a_dense_decomposition() {
    // At 5000 rpm motions come near critical damping, where iterations do not converge.
    let speeds = [("sphere", "5000.0"), ("sphere", "10.0"), ("sphere", "0.1"), ("cylinder", "1.0")];
    for (counterface, rpm) in speeds {
        let block = Block { name: "part", origin: [0.0; 3], size: [1.0; 3], counts: [3, 3, 1] };
        let folder = folder_with(&[("part.msh", &file_of(&[block], |at| bent(counterface, at)))]);
        let text = include_str!("../cases/creeping-part.toml");
        let set = [format!("contact.counterface={counterface} ; contact.rotation_speed_rpm={rpm}")];
        let run = |command| Run::of_text(command, folder.path(), text).set(&set).out(command);
        let answer = run("cea").done().says(&["mu p / V", "!not converged"]);
        let own = answer.modes("0.3");
        assert_eq!(own.len(), 6, "{}", answer.said());
        let out = run("matrices").args(&["--friction", "0.3"]).done().out;
        let matrices = ["M.mtx", "C.mtx", "K.mtx"].map(|name| market_matrix(&out.join(name)));
        let all = quadratic_eigenvalues(matrices.each_ref());
        // Damping of half of critical makes an eigenvalue 1.16 times its frequency.
        let listed = largest_error(&all, &own);
        let is_due = |l: &c64| l.im > 0.0 && l.im < own[5].im && -l.re < 0.5 * l.norm();
        let due: Vec<c64> = all.into_iter().filter(is_due).collect();
        let error = listed.max(largest_error(&own, &due));
        below(error, 8e-9, format!("{counterface} {rpm}: {own:?} {due:?}"));
    }
}
