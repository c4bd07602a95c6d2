//! Settings that make no run, and runs that break.

use crate::prelude::*;
use crate::transient::model::{Watch, disc, kicked, model, settings};

fn failure(change: impl FnOnce(&mut TransientSettings)) -> String {
    let annulus = disc(24, 6);
    let model = model(&annulus, 600.0);
    let operator = model.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
    let mut settings = settings(1e-3, &[1]);
    change(&mut settings);
    let result = CentralDifference::start(model, operator.as_ref(), &settings);
    result.err().expect("an error").to_string()
}

#[test]
fn a_setting_that_does_not_fit_is_named_with_its_bound() {
    type Change = fn(&mut TransientSettings);
    let changes: [(Change, &str); 5] = [
        (|s| s.time_step = TimeStep::Seconds(5e-6), "time_step = 5e-6 s is above ; limit of"),
        (|s| s.duration = 0.0, "duration = 0 s"),
        (
            |s| (s.time_step, s.sample_interval) = (TimeStep::Seconds(1e-6), 1e-9),
            "sample_interval = 1e-9 s is below",
        ),
        (|s| s.perturbation = Perturbation::of(&[13], 1e-3), "holds 13, above 12"),
        (|s| s.expansion_time = -1.0, "expansion_time = -1"),
    ];
    for (change, said) in changes {
        has(&failure(change), &[said]);
    }
}

#[test]
fn a_probe_or_snapshot_that_does_not_exist_is_named_with_its_bound() {
    let annulus = disc(24, 6);
    let model = model(&annulus, 600.0);
    let run = started(model, OperatorChoice::Auto, &settings(1e-3, &[1]));
    let failure = |probes: &[usize], snapshots: &[f64]| {
        let (probes, snapshots) = (probes.to_vec(), snapshots.to_vec());
        let wanted = RecorderSettings { probes, snapshots, ..Default::default() };
        Recorder::new(&run, &wanted).unwrap_err().to_string()
    };
    assert!(failure(&[169], &[]).contains("holds 169: the mesh has nodes 1 to 168"));
    assert!(failure(&[0], &[]).contains("holds 0"));
    assert!(failure(&[], &[0.1]).contains("holds 0.1 s: the run covers 0 to 0.001 s"));
}

#[test]
fn the_step_divides_the_sample_interval_and_stays_below_the_limit() {
    let annulus = disc(24, 6);
    let model = model(&annulus, 600.0);
    let operator = model.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
    let plan = model.plan(operator.as_ref(), &settings(1e-3, &[])).unwrap();
    assert!(plan.time_step < plan.limit && plan.time_step > 0.5 * plan.limit);
    let interval = plan.steps_per_sample as f64 * plan.time_step;
    assert!((interval / 4e-6 - 1.0).abs() < 1e-15);
    assert_eq!(plan.samples, 251);
    // A step that divides the interval is kept as it is.
    let mut given = settings(1e-3, &[]);
    given.time_step = TimeStep::Seconds(1e-7);
    let plan = model.plan(operator.as_ref(), &given).unwrap();
    assert_eq!(plan.steps_per_sample, 40);
    assert_eq!(plan.total_steps(), 10_001);
}

#[test]
fn a_run_that_leaves_the_numbers_says_when_where_and_why() {
    let annulus = disc(24, 6);
    let mut model = model(&annulus, 600.0);
    model.contact.rotation_speed = 1e200;
    let mut run = started(model, OperatorChoice::Auto, &kicked(1e-3, &[2], 1e170));
    let error = run.run(&mut Watch(|_: &Sample<'_>| {})).unwrap_err();
    let message = error.to_string();
    assert!(matches!(error, TransientError::Unstable { .. }), "{message}");
    has(&message, &["at t = ; node is  ; degrees ; rotation speed"]);
}
