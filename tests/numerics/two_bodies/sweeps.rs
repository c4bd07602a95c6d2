//! Steps whose sweeps over the contact between two bodies end before the forces have converged: consistency of what is said.

use super::*;

/// A heavy block on a light one, so many elements along the contact.
fn write_case(folder: &Path, along: [usize; 2]) {
    let lower = rectangle([0.0, -0.02], [0.04, 0.02], [along[0], 2]);
    let upper = rectangle([0.0, 0.0], [0.04, 0.03], [along[1], 3]);
    fs::write(folder.join("blocks.msh"), blocks_of([lower, upper])).unwrap();
    let text = include_str!("../../commands/refused/blocks.toml");
    fs::write(folder.join("case.toml"), text).unwrap();
}

fn run(folder: &Path, options: &[&str]) -> Answer {
    Run::of("transient", "case.toml").within(folder).out("out").args(options).done()
}

/// Forty nodes of a heavy body on four of a light one: their forces are all but indeterminate, and the sweeps end before
/// they settle. With the curves of one fineness each node meets its own, and one sweep is enough.
#[test]
fn steps_whose_sweeps_end_early_are_counted_and_said_where_there_are_any() {
    let folder = folder();
    write_case(folder.path(), [4, 40]);
    let answer = run(folder.path(), &[]);
    let summary = answer.summary();
    let steps = summary["steps"].as_u64().unwrap();
    let unconverged = summary["unconverged_steps"].as_u64().unwrap();
    assert!(unconverged > 0 && unconverged <= steps, "{unconverged} of {steps}");
    let sentence = format!("had not converged in {unconverged} of {steps} steps");
    has(&answer.stdout, &[&sentence, "exchange the two sides of the contact"]);
    // The energy of a step closes whatever its forces are.
    assert!(summary["max_balance_residual"].as_f64().unwrap() < 1e-10);
    let matching = TempDir::new().unwrap();
    write_case(matching.path(), [10, 10]);
    let answer = run(matching.path(), &[]).says(&["!converged"]);
    assert!(answer.summary().get("unconverged_steps").is_none());
}

/// The count belongs to the whole run: one that goes on ends with the same record and summary.
#[test]
fn a_run_that_goes_on_keeps_the_count_of_its_steps_without_converged_forces() {
    let folder = folder();
    write_case(folder.path(), [4, 40]);
    let whole = run(folder.path(), &[]);
    let (steps, record) = (whole.summary()["unconverged_steps"].clone(), whole.bytes("record.bin"));
    let shorter = ["--force", "--set", "transient.duration=1e-4"];
    let first = run(folder.path(), &shorter).summary();
    assert!(first["unconverged_steps"].as_u64() < steps.as_u64());
    let extended = run(folder.path(), &["--resume"]);
    assert_eq!(extended.summary()["unconverged_steps"], steps);
    assert!(record == extended.bytes("record.bin"));
}
