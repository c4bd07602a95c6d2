//! Where a transient leads whose motion does not repeat itself at first: to one frequency or to two.

use super::map::{PeriodMap, PeriodicState};
use crate::cycle::CycleError;
use crate::cycle::field::slips;
use crate::linalg::{c64, interruption};
use crate::signal::{RotatingLine, centred, rotating_lines};
use crate::transient::{WEAKEST_LINE, rms, strongest_two};

/// Periods before the motion is looked at, and those over which it is.
const PERIODS: [usize; 2] = [300, 200];
/// Samples of a period.
const SAMPLES: usize = 16;

/// The end of a transient of 500 periods from a state, with the period of its vibration; none where it has come to no vibration.
///
/// # Errors
/// A transient of two frequencies.
pub fn transient_from(
    map: &mut PeriodMap<'_>,
    start: &PeriodicState,
) -> Result<Option<PeriodicState>, CycleError> {
    let (samples, rate) = sampled(map, start);
    let motion = map.motion();
    let lines = strongest_node(&samples).and_then(|series| frequencies(&series, rate));
    match lines {
        Some((first, Some(second))) => Err(CycleError::NotFound(format!(
            "the motion does not repeat itself: a transient from this mode vibrates at two \
             frequencies, {first:.2} and {second:.2} Hz, without a common period. `transient` \
             follows it (end_state two-frequency). From another operating point \
             cycle.continuation tells where a cycle gives way to it"
        ))),
        Some((first, None)) => Ok(Some(PeriodicState { motion, period: first.recip() })),
        None => Ok(None),
    }
}

/// The frequencies, Hz, of the strongest vibration of a contact node along the counterface and of the strongest one that is
/// neither a multiple of it nor of its half or third, if there is one.
fn frequencies(series: &[c64], rate: f64) -> Option<(f64, Option<f64>)> {
    let lines = rotating_lines(series, rate, WEAKEST_LINE * rms(series)).into_iter();
    let lines: Vec<(usize, RotatingLine)> =
        lines.filter(|line| line.frequency_hz > 0.0).map(|line| (0, line)).collect(); // A real series has each line at both signs.
    let (first, second) = strongest_two(&lines, 0, rate / series.len() as f64)?; // rate / N: what the record resolves.
    Some((first.frequency_hz, second.map(|line| line.frequency_hz)))
}

/// Displacements of the contact nodes along the counterface, m, sample by sample, and the samples of a second.
fn sampled(map: &mut PeriodMap<'_>, start: &PeriodicState) -> (Vec<Vec<f64>>, f64) {
    map.place(start);
    let (steps, every) = (map.steps(), (map.steps() / SAMPLES).max(1));
    let [settling, kept] = PERIODS;
    for _ in 0..settling {
        interruption::check();
        (0..steps).for_each(|_| map.run.advance());
    }
    let sample = |step: usize| {
        if step.is_multiple_of(SAMPLES) {
            interruption::check();
        }
        let sample = slips(&map.run);
        (0..every).for_each(|_| map.run.advance());
        sample
    };
    let samples = (0..kept * steps / every).map(sample).collect();
    (samples, steps as f64 / (start.period * every as f64))
}

/// The history of the node that moves most, about its mean.
fn strongest_node(samples: &[Vec<f64>]) -> Option<Vec<c64>> {
    let about_mean = |node: usize| {
        let own = samples.iter().map(|sample| c64::new(sample[node], 0.0));
        centred(&own.collect::<Vec<c64>>()) // A deflection at rest is no vibration.
    };
    let nodes = 0..samples.first()?.len();
    let strongest = nodes.map(about_mean).max_by(|a, b| rms(a).total_cmp(&rms(b)));
    strongest.filter(|series| series.iter().all(|u| u.re.is_finite()))
}
