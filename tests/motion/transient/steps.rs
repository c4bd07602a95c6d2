//! Time steps: their length, their order, and runs that break.

use super::*;

#[test]
fn the_step_divides_the_sample_interval_and_stays_below_the_limit() {
    let annulus = disc(24, 6);
    let model = model(&annulus, 600.0);
    let operator = model.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
    let plan = model.plan(operator.as_ref(), &settings(1e-3, &[])).unwrap();
    assert!(plan.time_step < plan.limit && plan.time_step > 0.5 * plan.limit);
    let interval = plan.steps_per_sample as f64 * plan.time_step;
    near(interval, 4e-6, 1e-15);
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

/// Displacement and velocity of free undamped vibration after 0.2 ms with this many steps.
fn end(steps: u32) -> (Vec<f64>, Vec<f64>) {
    let annulus = disc(24, 5);
    let model = free(&annulus);
    let mut settings = settings(2e-4, &[2]);
    settings.expansion_time = 0.0;
    settings.sample_interval = 2e-4;
    settings.time_step = TimeStep::Seconds(2e-4 / f64::from(steps));
    let mut run = started(model, OperatorChoice::Cyclic, &settings);
    let mut last = None;
    watch(&mut run, |sample| {
        last = Some((sample.displacement(), sample.velocity()));
    });
    last.unwrap()
}

/// Theory: errors fall with the square of the step.
#[test]
fn smooth_linear_motion_converges_with_order_two_in_time() {
    let reference = end(51_200);
    let errors = [400, 800, 1600].map(|steps| {
        let found = end(steps);
        [(found.0, &reference.0), (found.1, &reference.1)].map(|(a, b)| largest_difference(&a, b))
    });
    for pair in errors.windows(2) {
        let slopes = [0, 1].map(|quantity| (pair[0][quantity] / pair[1][quantity]).log2());
        within(&slopes, &[2.0; 2], 0.1);
    }
}
