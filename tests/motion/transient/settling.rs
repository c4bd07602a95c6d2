//! When a run has settled, and what is kept of it.

use super::*;

fn run(rpm: f64, settings: &TransientSettings, wanted: &RecorderSettings) -> (Recorder, RunEnd) {
    let annulus = disc(45, 9);
    let mut run = started(model(&annulus, rpm), OperatorChoice::Auto, settings);
    let mut record = Recorder::new(&run, wanted).unwrap();
    let end = run.run(&mut record).unwrap();
    (record, end)
}

/// At friction 0.2 and 1000 rpm a wave of two nodal diameters grows on the cycle of one.
#[test]
fn a_vibration_of_two_frequencies_is_no_limit_cycle() {
    let annulus = disc(60, 12);
    let mut model = model(&annulus, 1000.0);
    model.contact.friction_coefficient = 0.2;
    let (record, _) = recorded(model, OperatorChoice::Auto, &kicked(0.05, &[1, 2], 0.3));
    for analysis in
        [TransientAnalysis::of(&record, &[1, 2]), TransientAnalysis::without_symmetry(&record)]
    {
        // Every harmonic keeps its amplitude: only the frequencies tell.
        assert!(analysis.settling.is_settled());
        let EndState::TwoFrequency(found) = analysis.settling.state else {
            panic!("{:?}", analysis.settling);
        };
        // The wave of one nodal diameter at 10.4 kHz, that of two at 9.5 kHz and a third of it.
        let [first, second] = found.frequencies_hz;
        near(first, 10_395.0, 0.01);
        near(second, 9500.0, 0.01);
        assert!((1.4..3.0).contains(&found.envelope_ratio), "{found:?}: (1 + 1/3) / (1 - 1/3) = 2");
    }
}

#[test]
fn a_run_that_is_too_short_says_the_duration_that_is_enough() {
    let reason = |duration: f64| {
        let (record, _) = run(610.0, &kicked(duration, &[2], 0.5), &RecorderSettings::default());
        TransientAnalysis::of(&record, &[2]).settling.reason
    };
    let Some(Unsettled::TooShort { duration }) = reason(0.004) else { panic!("long enough") };
    // Five times four blocks of eight periods near 10 kHz, and a tenth more.
    assert!((0.016..0.02).contains(&duration), "{duration}");
    let then = reason(duration);
    assert!(!matches!(then, Some(Unsettled::TooShort { .. })), "{then:?}");
}

#[test]
fn a_growing_vibration_is_no_limit_cycle_and_a_saturated_one_is() {
    let (record, _) = run(610.0, &kicked(0.006, &[2], 1e-3), &RecorderSettings::default());
    let growing = TransientAnalysis::of(&record, &[2]).settling;
    assert_eq!(growing.state, EndState::Unsettled, "{growing:?}");
    assert!(growing.from.is_none() && growing.reason.is_some());
    let (record, _) = run(610.0, &kicked(0.05, &[2], 0.5), &RecorderSettings::default());
    let analysis = TransientAnalysis::of(&record, &[2]);
    let settled = &analysis.settling;
    assert_eq!(settled.state, EndState::LimitCycle, "{settled:?}");
    let drift = settled.drift.unwrap();
    assert!(drift.amplitude.max(drift.frequency).max(drift.status) < 0.01);
    // The stretch that it has settled for begins after the linear stage and before the last fifth.
    let from = settled.from.unwrap();
    assert!(from > analysis.first_nonlinearity.unwrap() && from < 0.04);
    // What vibrates beside it, a fiftieth as large: nothing where it stays, no cycle where it grows by a third in the last fifth.
    let main = analysis.last_fifth.main_amplitude.unwrap();
    for (rate, state) in [(0.0, EndState::LimitCycle), (30.0, EndState::Unsettled)] {
        let mut record = record.clone();
        for row in &mut record.rows {
            let size = 0.02 * main * (rate * (row.time - 0.05)).exp();
            row.harmonics[2][0] += size * (TAU * 13e3 * row.time).cos();
        }
        assert_eq!(TransientAnalysis::of(&record, &[2]).settling.state, state);
    }
}

#[test]
fn a_run_that_stops_where_it_has_settled_is_the_beginning_of_the_longer_one() {
    let settings = kicked(0.05, &[2], 0.5);
    let (whole, _) = run(610.0, &settings, &RecorderSettings::default());
    let wanted = RecorderSettings { stop_when_settled: true, ..Default::default() };
    let (stopped, end) = run(610.0, &settings, &wanted);
    assert!(end == RunEnd::Stopped && stopped.has_stopped);
    let count = stopped.rows.len();
    assert!(count > 1000 && count < whole.rows.len());
    assert_eq!(stopped.rows, whole.rows[..count]);
    assert_eq!(TransientAnalysis::of(&stopped, &[]).settling.state, EndState::LimitCycle);
}

/// At 610 rpm waves grow out of noise: a fifth of the first periods, in which the others die out, is no steady sliding.
#[test]
fn a_run_from_noise_goes_on_until_what_grows_in_it_is_seen() {
    let wanted = RecorderSettings { stop_when_settled: true, ..Default::default() };
    for noise in [1e-3, 1e-6] {
        let noise = Perturbation { noise, ..Perturbation::default() };
        let settings = transient_settings([0.012, 4e-6, 0.0], InitialState::SteadySliding, noise);
        let (record, end) = run(610.0, &settings, &wanted);
        assert_eq!(end, RunEnd::Finished, "{} samples", record.rows.len());
        let analysis = TransientAnalysis::of(&record, &[]);
        assert_eq!(analysis.settling.state, EndState::Unsettled);
    }
}

#[test]
fn steady_sliding_rest_and_separation_are_ends_of_their_own() {
    let state = |rpm: f64| {
        let (record, _) = run(rpm, &settings(0.07, &[]), &RecorderSettings::default());
        let analysis = TransientAnalysis::of(&record, &[]);
        assert_eq!(analysis.last_fifth.main_frequency_hz, None);
        analysis.settling.state
    };
    // What the expansion excites is symmetric, 5.9 kHz, and decays at 325 1/s: 1e-7 of it is left after 50 ms.
    assert_eq!(state(610.0), EndState::SteadySliding);
    assert_eq!(state(0.0), EndState::AtRest);
    // One that is too short to tell.
    let (record, _) = run(610.0, &settings(2e-4, &[2]), &RecorderSettings::default());
    let short = TransientAnalysis::of(&record, &[2]);
    let reason = short.settling.reason.unwrap();
    assert!(matches!(reason, Unsettled::TooShort { .. } | Unsettled::Starting { .. }));
    assert!(short.growth[0].stage.is_err());
}

#[test]
fn a_snapshot_has_the_contact_of_its_own_step() {
    let (snapshots, contact_interval) = (vec![0.0101], Some(1e-4));
    let wanted = RecorderSettings { snapshots, contact_interval, ..Default::default() };
    let (record, _) = run(610.0, &kicked(0.0102, &[2], 0.5), &wanted);
    let snapshot = &record.snapshots[0];
    assert_eq!(record.frames.len(), 103);
    assert!((record.frames[1].time - 1e-4).abs() < 1e-12);
    let annulus = disc(45, 9);
    let mut stuck = 0;
    for (i, &node) in annulus.mesh.contact_edge().nodes.iter().enumerate() {
        let node = node as usize;
        match snapshot.contact.status[i] {
            // A node in contact is where the cylinder holds it, 25 um out, up to the step that brings it there.
            0 => assert!(snapshot.contact.pressure[i] == 0.0 && snapshot.gap[i] > -1e-9),
            // A node that has stuck for a step has the speed of the cylinder before and after.
            1 if (snapshot.velocity[2 * node + 1] / record.surface_speed - 1.0).abs() < 1e-9 => {
                stuck += 1
            }
            _ => assert!(snapshot.contact.pressure[i] > 0.0),
        }
    }
    assert!(stuck > 3, "{stuck}");
}

/// `contact.npz` of a longer run keeps what that of a run of its length would: a run can be extended.
#[test]
fn frames_of_a_run_are_those_of_a_longer_one_up_to_its_end() {
    let long = TransientSettings { sample_interval: 2e-6, ..settings(0.05, &[]) };
    let (record, _) = run(610.0, &long, &RecorderSettings::default());
    assert_eq!((record.rows.len(), record.frame_stride), (25_001, 4));
    let times = record.frames.iter().map(|frame| frame.time);
    assert!(times.eq(record.rows.iter().step_by(4).map(|row| row.time)));
}

#[test]
fn the_acceleration_of_a_probe_is_the_change_of_its_velocity_over_the_interval() {
    let wanted =
        RecorderSettings { probes: vec![1, 17], raw_acceleration: true, ..Default::default() };
    let (record, _) = run(610.0, &kicked(0.01, &[2], 0.5), &wanted);
    for pair in record.probe_rows.iter().flat_map(|rows| rows.windows(2)) {
        let change = [2, 3].map(|c| (pair[1][c] - pair[0][c]) / 4e-6);
        assert_eq!(pair[1][4..6], change);
    }
    // A contact node lands within one step: by chance that step is sampled, and its acceleration is many times the mean.
    let peak = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |m: f64, v| m.max(v.abs()));
    let mean = peak(&mut record.probe_rows[0].iter().map(|row| row[4]));
    let step = peak(&mut record.raw_accelerations.as_ref().unwrap()[0].iter().map(|a| a[0]));
    assert!(step > 1.5 * mean, "{step} {mean}");
}
