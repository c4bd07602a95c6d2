//! Settings that make no run, and runs that break.

use super::*;

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
