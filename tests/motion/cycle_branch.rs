//! Branches of periodic motions of bodies without symmetry: through folds, beside stable sliding, interrupted and gone on with.
//!
//! Independent: integration from event to event on both sides of a fold; the spectrum of steady sliding. The others are identities.

use crate::prelude::*;
use frictionsim::cycle::periodic::PeriodicBranch;

/// The oscillator's cycles over the speed of its plane: friction falls too slowly at high speed to feed a vibration, and the
/// cycle that sticks lives on beyond the speed at which sliding becomes stable.
pub fn over_speed(folder: &Path, stability: &str, to: f64, further: &[&str]) -> Case {
    let cycle = format!(
        "cycle={{ confirmation_periods = 0, stability = \"{stability}\", continuation = {{ key = \"contact.speed\", from = 0.2, to \
         = {to}, count = 15 }} }}"
    );
    let own = ["transient.time_step=2.5e-8", &cycle];
    oscillator(folder, &[&own, further].concat())
}

/// Larger than any cycle, m and m/s; from 5e-5 m on a node lifts off.
const LARGE: [f64; 4] = [4e-5, 4e-5, 0.0, 0.0];

fn searched(case: &Case, watch: &dyn SweepWatch) -> FoundCycle {
    let study = PeriodicStudy::new(case, SimdLevel::detect()).unwrap();
    study.run(0, watch, &|_| {}).unwrap().remove(0).outcome.unwrap()
}

fn branch(case: &Case) -> PeriodicBranch {
    searched(case, &Unwatched).branch.unwrap()
}

#[test]
fn a_branch_bends_back_at_the_speed_at_which_integration_from_event_to_event_loses_the_cycle() {
    let folder = folder();
    let branch = branch(&over_speed(folder.path(), "branch", 3.0, &[]));
    let folds = branch.folds();
    assert_eq!(folds.len(), 1, "{folds:?} {:?}", branch.ends);
    let (fold, onset) = (folds[0], branch.onsets[0]);
    assert!(fold > 1.02 * onset, "{fold} {onset}");
    // A large start goes on for hundreds of periods below the fold, and dies above it; just below it few end on the cycle.
    let lives = |speed: f64| {
        let case = oscillator(folder.path(), &[&format!("contact.speed={speed}")]);
        EventDriven::new(&case).run(LARGE, 1.2e-8, 300, 20)
    };
    assert!(lives(1.02 * fold).is_none());
    let (frequency, stick) = lives(0.9 * fold).expect("a cycle below the fold");
    assert!(stick > 0.0 && frequency > 0.0);
    // Stable before the fold, unstable after it, down to the onset, where the cycle shrinks into steady sliding.
    let at = branch.motions.iter().position(|own| own.is_fold).unwrap();
    for (own, wanted) in [(&branch.motions[..at], true), (&branch.motions[at + 1..], false)] {
        let verdicts: BTreeSet<bool> = own.iter().filter_map(|own| own.is_stable()).collect();
        assert_eq!(verdicts, BTreeSet::from([wanted]));
    }
    assert_eq!(branch.ends, [BranchEnd::Range, BranchEnd::Birth]);
    near(branch.motions.last().unwrap().value, onset, 0.02);
    assert_eq!(branch.coexistence(), [[onset, fold]]);
}

#[test]
fn cycles_beside_stable_sliding_are_found_from_where_a_mode_grows() {
    let folder = folder();
    let whole = branch(&over_speed(folder.path(), "none", 3.0, &[]));
    let [onset, fold] = whole.coexistence()[0];
    // Between both the case's own sliding is stable: the cycle comes from the end of the range at which it is not.
    let speed = 0.5 * (onset + fold);
    let own = format!("contact.speed={speed}");
    let case = over_speed(folder.path(), "none", 3.0, &[&own]);
    let study = PeriodicStudy::new(&case, SimdLevel::detect()).unwrap();
    let results = study.run(0, &Unwatched, &|_| {}).unwrap();
    assert_eq!(results[0].name.sought_from, Some(0.2));
    let motion = &results[0].outcome.as_ref().unwrap().motion;
    let report = study.report(results.clone());
    assert!(report.steady_sliding_stable);
    has(&report.notes[0], &["contact.speed = 0.2, since none grows"]);
    // Between the case's own speed and that at which a mode grows: the onset beside the branch.
    let critical = report.critical_value.unwrap();
    assert_eq!(critical.key, Parameter::Speed.key());
    near(critical.value, onset, 1e-3);
    // The large one of both cycles, as integration has it.
    let reference = EventDriven::new(&case);
    let (frequency, stick) = reference.run(LARGE, 1.2e-8, 200, 20).unwrap();
    near(motion.frequency_hz, frequency, 1e-4);
    assert!((motion.fractions[0] - stick).abs() < 2e-3);
    // Beyond the fold there is none, which the reason says.
    let beyond = format!("contact.speed={}", 1.1 * fold);
    let results = cycles(&over_speed(folder.path(), "none", 3.0, &[&beyond]));
    let reason = results[0].outcome.as_ref().unwrap_err();
    assert!(reason.contains("no limit cycle beside it"), "{reason}");
}

#[test]
fn a_branch_that_goes_on_after_an_interruption_is_the_same_bit_by_bit() {
    let case = over_speed(folder().path(), "branch", 0.8, &[]);
    let kept = Kept::default();
    let whole = searched(&case, &kept);
    assert!(kept.count() > 4);
    // As an interruption leaves it after two and four steps.
    let whole = format!("{whole:?}");
    for count in [2, 4] {
        assert_eq!(format!("{:?}", searched(&case, &kept.after(count))), whole);
    }
}

#[test]
fn a_branch_without_a_fold_says_so() {
    // A block under constant friction, above its onset.
    let folder = folder();
    let overrides = [
        &coarse_block(folder.path()),
        "contact.friction_coefficient=0.66",
        "cycle={ confirmation_periods = 0, stability = \"none\", continuation = { key = \"contact.friction_coefficient\", from = \
         0.6, to = 0.66, count = 3 } }",
    ];
    let case = shipped_case("sliding-block.toml", &overrides);
    let branch = branch(&case);
    assert!(branch.folds().is_empty() && branch.coexistence().is_empty());
    assert_eq!(branch.ends, [BranchEnd::Range; 2]);
}

/// A first step so long that the branch bends within it leads on, not back along itself beyond a fold that there is none of.
#[test]
fn a_branch_that_bends_within_its_first_step_is_not_followed_back() {
    let folder = folder();
    let mesh = include_bytes!("../cases/uneven-block.msh");
    fs::write(folder.path().join("uneven-block.msh"), mesh).unwrap();
    let text = include_str!("../cases/uneven-block.toml");
    let branch = branch(&case_of::<&str>(folder.path().join("case.toml"), text, &[]));
    let values: Vec<f64> = branch.motions.iter().map(|own| own.value).collect();
    assert!(branch.folds().is_empty() && values.is_sorted(), "{values:?}");
}
