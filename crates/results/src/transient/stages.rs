//! The stages of a run.

use super::SolvedTransient;
use crate::charts::Stage;
use frictionsim_chart::extremes;
use frictionsim_physics::transient::{EndState, SampleRow};

/// Part of a run below which a stage is none, as the instant before the first node of pressed pads sticks.
const SHORTEST: f64 = 2e-3;

/// The stages of a run as figure 8 of the paper letters them: A vibrations of the start die out, B exponential growth,
/// C stick and separation set in, D limit cycle.
///
/// B begins where the strongest harmonic other than zero overtakes the vibration of harmonic zero (half its range over
/// 0.5 ms), D where it stays within 2 % of its last value for good. A run that ends before a stage has the letters up
/// to it; one without growth has none.
pub(super) fn stages(run: &SolvedTransient) -> Vec<Stage> {
    let (rows, analysis) = (&run.record.rows, &run.analysis);
    let size = |row: &SampleRow, n: usize| row.harmonics[n][0].hypot(row.harmonics[n][1]);
    let Some(last) = rows.last() else {
        return Vec::new();
    };
    let strongest =
        (1..last.harmonics.len()).max_by(|&a, &b| size(last, a).total_cmp(&size(last, b)));
    let Some(main) = strongest else {
        return Vec::new();
    };
    let linear_end = analysis.first_nonlinearity.unwrap_or(last.time);
    let window = rows.partition_point(|row| row.time < rows[0].time + 5e-4).max(2);
    let linear = rows.partition_point(|row| row.time < linear_end);
    // The last half millisecond of the linear stage in which harmonic zero still moves more than the wave.
    let overtaken = (0..linear / window).rfind(|&block| {
        let block = &rows[block * window..(block + 1) * window];
        let (low, high) = extremes(block.iter().map(|row| row.harmonics[0][0]));
        let wave = block.iter().map(|row| size(row, main)).sum::<f64>() / window as f64;
        wave < 0.5 * (high - low)
    });
    let after = |index: Option<usize>| {
        index.and_then(|i| rows.get(i + 1)).map_or(rows[0].time, |row| row.time)
    };
    let growth = after(overtaken.map(|block| (block + 1) * window - 1));
    let is_far = |row| (size(row, main) - size(last, main)).abs() > 0.02 * size(last, main);
    let settled = rows.iter().rposition(is_far);
    let (nonlinear, cycle) = match analysis.first_nonlinearity {
        Some(time) if analysis.settling.state == EndState::LimitCycle => {
            (time, after(settled).max(time))
        }
        Some(time) => (time, last.time),
        None => (last.time, last.time),
    };
    if growth >= last.time {
        return Vec::new();
    }
    let spans = [
        ("A: vibrations of the start die out", rows[0].time, growth),
        ("B: exponential growth", growth, nonlinear),
        ("C: stick and separation set in", nonlinear, cycle),
        ("D: limit cycle", cycle, last.time),
    ];
    let shortest = SHORTEST * (last.time - rows[0].time);
    let present = spans.into_iter().filter(|(_, start, end)| end - start > shortest);
    present.map(|(meaning, start, _)| Stage { meaning, start }).collect()
}
