//! Seeds: the velocity that is added to the body's.

use super::*;

fn record(annulus: &AnnulusMesh, settings: &TransientSettings) -> Recorder {
    recorded(model(annulus, 610.0), OperatorChoice::Auto, settings).0
}

/// Tangential velocity of the contact edge, harmonic by harmonic.
#[test]
fn each_harmonic_has_its_own_velocity_and_its_crest_at_its_phase() {
    let annulus = disc(60, 6);
    let waves = [(1, 0.01, 0.3), (3, 0.07, -1.1), (20, 0.002, 0.0)];
    let wave = |(harmonic, velocity, phase)| StandingWave { harmonic, velocity, phase };
    let perturbation = Perturbation { waves: waves.map(wave).to_vec(), ..Perturbation::default() };
    let field = model(&annulus, 610.0).perturbed(&perturbation).unwrap();
    let nodes = &annulus.mesh.contact_edge().nodes;
    for (harmonic, velocity, phase) in waves {
        let project = |offset: f64| {
            let nodes = nodes.iter().map(|&node| node as usize);
            let terms = nodes.map(|node| {
                let angle = harmonic as f64 * annulus.mesh.frame_angles()[node] - offset;
                field[2 * node + 1] * angle.cos()
            });
            terms.sum::<f64>() * 2.0 / 60.0
        };
        assert!((project(phase) - velocity).abs() < 1e-15);
        assert!(project(phase + TAU / 4.0).abs() < 1e-15);
    }
    assert!(field.iter().step_by(2).all(|&radial| radial == 0.0));
}

#[test]
fn noise_has_its_standard_deviation_in_both_directions_and_spares_the_clamped_edge() {
    let annulus = disc(90, 30);
    let noise = |noise_seed: u64| {
        let perturbation = Perturbation { noise: 2e-3, noise_seed, ..Perturbation::default() };
        model(&annulus, 610.0).perturbed(&perturbation).unwrap()
    };
    let field = noise(1);
    let clamped = |n: usize| annulus.mesh.boundary("outer").unwrap().nodes.contains(&(n as u32));
    for component in 0..2 {
        let free = (0..annulus.mesh.node_count()).filter(|&node| !clamped(node));
        let values: Vec<f64> = free.map(|node| field[2 * node + component]).collect();
        let count = values.len() as f64;
        let (mean, deviation) = moments(&values);
        // Five standard deviations of the mean and of the variance of 2700 normal numbers.
        assert!(mean.abs() < 5.0 * 2e-3 / count.sqrt());
        assert!((deviation.powi(2) / 4e-6 - 1.0).abs() < 5.0 * (2.0 / count).sqrt());
    }
    assert!((0..annulus.mesh.node_count()).all(|n| !clamped(n) || field[2 * n] == 0.0));
    assert_eq!(field, noise(1));
    assert_ne!(field, noise(2));
}

/// A kick of a body that slides steadily equals the same velocity at the start of a run that slides steadily.
#[test]
fn a_kick_starts_what_the_same_velocity_starts_at_time_zero_and_its_energy_is_accounted_for() {
    let annulus = disc(45, 9);
    let mut early = kicked(3e-3, &[2], 1e-2);
    early.initial = InitialState::SteadySliding;
    let mut late = early.clone();
    late.duration = 4e-3;
    late.perturbation.time = 1e-3;
    let (early, late) = (record(&annulus, &early), record(&annulus, &late));
    assert!((late.rows[250].time - 1e-3).abs() < 1e-12);
    let largest = |record: &Recorder| {
        let amplitudes = record.rows.iter().map(|row| row.harmonics[2]);
        amplitudes.fold(0.0, |m: f64, [re, im]| m.max(re.hypot(im)))
    };
    let size = largest(&early);
    assert!(size > 1e-8);
    for (a, b) in early.rows.iter().zip(&late.rows[250..]) {
        let [a, b] = [a.harmonics[2], b.harmonics[2]];
        // The kicked body has slid on the way, which leaves round-off of the prestress, 1e-15 of 1e-5 m.
        assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-7 * size);
    }
    assert!(late.rows.iter().all(|row| row.balance_residual < 1e-11));
}

#[test]
fn a_run_stopped_before_its_kick_goes_on_to_the_same_bits() {
    let annulus = disc(30, 6);
    let model = model(&annulus, 610.0);
    let operator = model.operator(OperatorChoice::Auto, SimdLevel::detect()).unwrap();
    let mut settings = settings(2e-3, &[1]);
    settings.perturbation.time = 1e-3;
    settings.perturbation.noise = 1e-3;
    let mut states = Vec::new();
    let mut run = CentralDifference::start(model, operator.as_ref(), &settings).unwrap();
    watch(&mut run, |sample| {
        if [249, 250, 251].contains(&sample.index) {
            states.push(sample.state());
        }
    });
    assert_eq!(states.len(), 3);
    for state in &states {
        let mut again =
            CentralDifference::resume(model, operator.as_ref(), &settings, state).unwrap();
        watch(&mut again, |_| {});
        assert_eq!(again.state(), run.state());
    }
}

#[test]
fn a_harmonic_far_above_the_others_is_followed_where_it_is_seeded() {
    let annulus = disc(90, 6);
    let record = record(&annulus, &settings(1e-3, &[2, 31]));
    assert!(record.followed_harmonics().eq((0..=24).chain([31])));
    assert!(record.significant_harmonics().contains(&31));
    let last = record.rows.len() - 1;
    let [re, im] = record.amplitude(last, 31).unwrap();
    assert!(re.hypot(im) > 0.0);
    assert_eq!(record.amplitude(last, 30), None);
}
