//! Order of the time integration.

use super::*;

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
    for quantity in 0..2 {
        for pair in errors.windows(2) {
            let slope = (pair[0][quantity] / pair[1][quantity]).log2();
            assert!((slope - 2.0).abs() < 0.1, "{slope} {errors:?}");
        }
    }
}
