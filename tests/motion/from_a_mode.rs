//! Transients that start from a mode of the eigenvalue analysis: both have one model.

use crate::prelude::*;
use frictionsim::study::eigenvalues::modes_with_waves_below;
use frictionsim::study::transient::TransientStudy;

/// A pad on a disc that turns, the seam of the disc glued.
const PAD: &str = include_str!("../cases/pad-on-a-turning-disc.toml");
const BLOCK: &str = include_str!("../cases/block-under-falling-friction.toml");

/// Holds the growth and the frequency that a body has in steps of 0.1 us to those of a mode from which it starts; its fields are to
/// stay a multiple of the shape.
#[track_caller]
pub fn grows_from(model: TransientModel<'_>, mode: &ComplexMode) {
    let (lambda, shape) = (mode.eigenvalue, mode.shape.as_ref().unwrap());
    let duration = 4.0 * TAU / lambda.im;
    let (initial, none) = (InitialState::SteadySliding, Perturbation::default());
    let mut settings = transient_settings([duration, duration, 0.0], initial, none);
    settings.time_step = TimeStep::Seconds(1e-7);
    let operator = model.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
    let operator = operator.as_ref();
    let step = model.plan(operator, &settings).unwrap().time_step;
    let base = model.sliding_displacement().unwrap();
    // Small against the compression, large against its round-off.
    let largest = base.iter().map(|u| u.abs()).fold(0.0, f64::max);
    let scale = 1e-5 * largest / shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
    let along = |factor: c64| shape.iter().map(move |x| scale * (factor * x).re);
    let start: Vec<f64> = base.iter().zip(along(c64::ONE)).map(|(u, x)| u + x).collect();
    let velocity = along(lambda * (-0.5 * step * lambda).exp()).collect();
    let mut run =
        CentralDifference::start_from(model, operator, &settings, &start, velocity).unwrap();
    let mut record = Recorder::new(&run, &RecorderSettings::default()).unwrap();
    run.run(&mut record).unwrap();

    // The factor of the shape at the end, by least squares.
    let end = run.state();
    let moved: Vec<f64> =
        end.displacement.iter().zip(&base).map(|(u, b)| (u - b) / scale).collect();
    let parts = DMatrix::from_fn(shape.len(), 2, |i, k| [shape[i].re, -shape[i].im][k]);
    let moved = DMatrix::from_vec(shape.len(), 1, moved);
    let factor = (parts.transpose() * &parts).lu().solve(&(parts.transpose() * &moved)).unwrap();
    let rest = (&moved - &parts * &factor).norm() / moved.norm();
    let time = end.step as f64 * step;
    let beyond = c64::new(factor[0], factor[1]) * (-time * lambda).exp();
    let found = lambda + c64::new(beyond.norm().ln(), beyond.arg()) / time;
    let what = format!("{found}, eigenvalue {lambda}, beside the shape {rest:e}");
    println!("{what}, {:?}", record.rows.last().unwrap().counts);
    assert!((found.re / lambda.re - 1.0).abs() < 2e-3, "{what}");
    assert!((found.im / lambda.im - 1.0).abs() < 5e-4, "{what}");
    assert!(rest < 2e-3, "{what}");
}

/// Changes with which the eigenvalue analysis has what the transient has.
const AS_STEPPED: &str = "cea.mass=\"lumped\" ; cea.geometric_stiffness=false";

/// Cross-method: on a coarse mesh the transient of a case starts from the mode of its eigenvalue analysis that grows most, and stays
/// on it. The springs of both are at the nodes.
#[track_caller]
fn grows_from_its_mode(case: &Case, limit_hz: f64) {
    let own = [case.contact.sliding.friction_coefficient];
    let (modes, _) = modes_with_waves_below(case, limit_hz, &own).unwrap();
    let study = TransientStudy::new(case, SimdLevel::detect()).unwrap();
    grows_from(study.body(), fastest(&modes));
}

/// A pad of six bricks on a disc that turns, half of its nodes open.
#[test]
fn a_pad_on_springs_on_a_disc_grows_from_its_mode() {
    let blocks = [
        brick("disc", [0.03, 0.0, 0.0], [0.04, TAU, 0.006], [2, 16, 1]),
        brick("pad", [0.045, -0.3, 0.006], [0.022, 0.6, 0.01], [2, 3, 1]),
    ];
    let file = [("body.msh", &file_of(&blocks, polar)[..])];
    let springs = "contacts.pad.normal_stiffness=1e11";
    grows_from_its_mode(&case_beside("pad-from-a-mode", &file, PAD, &[AS_STEPPED, springs]), 6e3);
}

/// Rigid contact, springs, and springs of which a row is open.
#[test]
fn a_block_on_a_rigid_plane_grows_from_its_mode() {
    let block = [brick("block", [0.0; 3], [0.04, 0.03, 0.02], [3, 2, 2])];
    let open = "contact.normal_stiffness=1e12 ; contact.friction_coefficient=0.8 ; \
                contact.interference=1e-7";
    let kinds = [
        (1, "contact.speed=1.0", 8e3),
        (1, "contact.normal_stiffness=1e12", 8e3),
        (1, open, 2e4),
        (2, "contact.normal_stiffness=1e12", 8e3),
    ];
    for (order, changes, limit_hz) in kinds {
        let file = file_of_order(&block, order, |point| point);
        let changes = [AS_STEPPED, "transient.duration=0.01", changes];
        let case = case_beside("block-from-a-mode", &[("body.msh", &file)], BLOCK, &changes);
        grows_from_its_mode(&case, limit_hz);
    }
}
