//! End state of a run, and the time from which it holds.

use super::StatusCounts;
use super::recorder::{Recorder, SampleRow};
use super::vibration::{
    TwoFrequencies, creeps, dies_out, last_fifth, main_vibration, quarters, rms, series,
    without_multiples,
};
use crate::linalg::c64;
use crate::signal::{harmonic_growth, round_off_floor, strongest_vibration};
use std::f64::consts::TAU;
use std::ops::Range;

/// Drift below which a run has settled.
const LARGEST_DRIFT: f64 = 0.01;

/// Periods of the main vibration in a block, over which amplitudes and statuses are averaged.
const PERIODS: f64 = 8.0;

/// Fewest blocks in the last fifth of a run that can be told to have settled.
const FEWEST_BLOCKS: usize = 4;

/// Margin of the duration that a run is said to need: its frequency may fall as it goes on.
const SPARE: f64 = 1.1;

/// Share of a run that its end is.
const END: f64 = 0.2;

/// Blocks in the last fifth of a run that does not vibrate.
const QUIET_BLOCKS: usize = 8;

/// Growth of a harmonic from the first to the last quarter of the last fifth that is no accident.
const GROWTH: f64 = 1.2;

/// Deviation of the logarithm of an amplitude from a line, root mean square, over its change, up to which it grows at one rate.
const STRAIGHT: f64 = 0.1;

/// What a run ends in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EndState {
    /// A periodic vibration of constant amplitude, frequency and status.
    LimitCycle,
    /// A stationary vibration of two frequencies without a common fundamental: it never repeats itself, and its envelope swings.
    TwoFrequency(TwoFrequencies),
    /// The cylinder slides, and nothing vibrates, or what does dies out and is small already.
    SteadySliding,
    /// The cylinder does not turn, and nothing vibrates.
    AtRest,
    /// Nothing touches the cylinder, and nothing vibrates.
    Separated,
    /// Something changes still, or the run is too short to tell.
    Unsettled,
}

impl EndState {
    /// Name in summaries.
    pub fn name(self) -> &'static str {
        self.words()[0]
    }

    /// In words, as the end of "the run ends ...".
    pub fn phrase(self) -> &'static str {
        self.words()[1]
    }

    fn words(self) -> [&'static str; 2] {
        match self {
            Self::LimitCycle => ["limit-cycle", "on a limit cycle"],
            Self::TwoFrequency(_) => {
                ["two-frequency", "in a vibration of two frequencies, which is no limit cycle"]
            }
            Self::SteadySliding => ["steady-sliding", "in steady sliding"],
            Self::AtRest => ["at-rest", "at rest"],
            Self::Separated => ["separated", "out of contact, at rest"],
            Self::Unsettled => ["unsettled", "before it has settled"],
        }
    }
}

/// Differences between the largest and the smallest value over the blocks of a stretch of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, crate::output::Described, serde::Serialize)]
pub struct Drift {
    /// Of the amplitude of any harmonic, relative to the largest.
    pub amplitude: f64,
    /// Of the main frequency, relative.
    pub frequency: f64,
    /// Of the fraction of nodes in any status.
    pub status: f64,
}

impl Drift {
    fn largest(&self) -> f64 {
        self.amplitude.max(self.frequency).max(self.status)
    }
}

/// Why a run has not settled.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Unsettled {
    /// Too few periods to compare.
    #[error("the run is too short to tell: set transient.duration to {duration:.3e} s or more")]
    TooShort {
        /// Duration of a run whose last fifth is long enough, s.
        duration: f64,
    },
    /// The cylinder still expands, or the perturbation is still to come, within the last fifth.
    #[error(
        "the run is still being set up in its last fifth, until {until:.3e} s: set transient.duration to {duration:.3e} s or more"
    )]
    Starting {
        /// When that ends, s.
        until: f64,
        /// Duration of a run whose last fifth comes later, s.
        duration: f64,
    },
    /// The last fifth is not stationary.
    #[error(
        "over the last fifth of the run the amplitude drifts by {:.1} %, the frequency by {:.1} %, the status by \
         {:.1} % of the nodes", 100.0 * .0.amplitude, 100.0 * .0.frequency, 100.0 * .0.status
    )]
    Drifting(Drift),
    /// A small vibration that will be large.
    #[error(
        "{} still grows, from {from:.1e} to {to:.1e} m over the last fifth of the run",
        what_vibrates(*.harmonic)
    )]
    Growing {
        /// Its circumferential harmonic; none on a body without symmetry.
        harmonic: Option<usize>,
        /// Its amplitude in the first quarter of that, m.
        from: f64,
        /// In the last quarter, m.
        to: f64,
    },
}

/// Whether a run has settled: over its last fifth amplitude, frequency and status drift by less than 1 %, and nothing grows beside them.
///
/// Compared are the means of blocks of eight periods, or of whole beats where there are two frequencies; of what dies out eight periods
/// are looked at, or 32 before a run stops. A modulation that is longer than a fifth of the run is not seen, and neither is growth from
/// below round-off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settling {
    /// What the run ends in.
    pub state: EndState,
    /// Start of the longest stretch up to the end over which nothing drifts by more, s.
    pub from: Option<f64>,
    /// Drift over the last fifth, where there is enough of it.
    pub drift: Option<Drift>,
    /// Why it has not settled.
    pub reason: Option<Unsettled>,
}

/// Means over one block.
struct Block {
    /// Index of its first sample.
    start: usize,
    /// Fractions of contact nodes; mean twist, m; root mean square of each followed harmonic about its mean, m.
    means: Vec<f64>,
    /// The main vibration, demodulated by its frequency.
    demodulated: c64,
}

/// Places of the means of a block.
const STATUS: Range<usize> = 0..3;
const TWIST: usize = 3;
const HARMONICS: usize = 4;

impl Settling {
    /// Whether amplitude, frequency and status stay what they are.
    pub fn is_settled(&self) -> bool {
        self.state != EndState::Unsettled
    }

    /// Reads a record.
    pub fn of(record: &Recorder) -> Self {
        let fifth = last_fifth(record);
        let short = too_short(record, &fifth);
        let main = main_vibration(record, fifth.clone())
            .filter(|_| short.is_some() || !dies_out(record, &fifth, LARGEST_DRIFT));
        let short = short.filter(|_| main.is_none());
        let judged = short.map_or_else(|| Self::judge(record, &fifth, main), Err);
        judged.unwrap_or_else(|reason| {
            let drift = if let Unsettled::Drifting(drift) = reason { Some(drift) } else { None };
            Self { state: EndState::Unsettled, from: None, drift, reason: Some(reason) }
        })
    }

    fn judge(
        record: &Recorder,
        fifth: &Range<usize>,
        main: Option<(usize, f64)>,
    ) -> Result<Self, Unsettled> {
        // Length of a block, samples.
        let interval = record.sample_interval;
        let periods = main.map(|(_, frequency)| (PERIODS / (frequency.abs() * interval)).ceil());
        let quiet = (fifth.len() / QUIET_BLOCKS, QUIET_BLOCKS);
        let (length, wanted) = periods.map_or(quiet, |samples| (samples as usize, FEWEST_BLOCKS));
        let length = length.max(QUIET_BLOCKS);
        let until = record.start_up_time;
        if fifth.len() < length.saturating_mul(wanted) {
            let needed = wanted as f64 * length as f64 * interval;
            let duration = rounded_up((SPARE * needed / END).max(until / (1.0 - END)));
            return Err(Unsettled::TooShort { duration });
        }
        if record.rows[fifth.start].time < until {
            let duration = rounded_up(until / (1.0 - END));
            return Err(Unsettled::Starting { until, duration });
        }

        // Two frequencies that beat make every mean swing but those over whole beats.
        let two = main.and_then(|main| TwoFrequencies::of(record, fifth, main));
        let (drift, from) = match (stationary(record, fifth, main, length), two) {
            (Err(drifting), Some(two)) => {
                let beat = 1.0 / (two.beat_hz() * interval);
                let beats = (length as f64 / beat).ceil();
                let whole = (beats * beat).round() as usize;
                match whole.saturating_mul(wanted) <= fifth.len() {
                    true => stationary(record, fifth, main, whole)?,
                    false => return Err(drifting),
                }
            }
            (found, _) => found?,
        };
        growing(record, fifth, main).map_or(Ok(()), Err)?;
        let rows = &record.rows[fifth.clone()];
        let state = two.map_or_else(|| state(record, rows, main), EndState::TwoFrequency);
        let (from, drift) = (Some(record.rows[from].time), Some(drift));
        Ok(Self { state, from, drift, reason: None })
    }
}

/// Drift over the last fifth, compared in blocks of `length` samples, and the sample from which on there is no more of it.
fn stationary(
    record: &Recorder,
    fifth: &Range<usize>,
    main: Option<(usize, f64)>,
    length: usize,
) -> Result<(Drift, usize), Unsettled> {
    // Backwards from the end, until something has drifted too far.
    let interval = record.sample_interval * length as f64;
    let mut extremes = Extremes { means: Vec::new(), frequency: NOTHING, later: None };
    let mut from = fifth.end;
    let mut drift = Drift::default();
    let mut end = fifth.end;
    while end >= length {
        let block = Block::of(record, end - length..end, main);
        if record.rows[block.start].time < record.start_up_time {
            break;
        }
        extremes.add(&block, interval);
        let reached = extremes.drift(record, main);
        let is_inside = block.start >= fifth.start;
        if is_inside {
            drift = reached;
        }
        if reached.largest() < LARGEST_DRIFT {
            from = block.start;
        } else if !is_inside {
            break;
        }
        end = block.start;
    }
    let is_still = drift.largest() < LARGEST_DRIFT;
    is_still.then_some((drift, from)).ok_or(Unsettled::Drifting(drift))
}

/// A vibration of a harmonic, or of a body without symmetry, whose modes are no harmonics.
fn what_vibrates(harmonic: Option<usize>) -> String {
    harmonic.map_or_else(|| "a vibration".to_owned(), |n| format!("harmonic {n}"))
}

/// A time to four digits, and not less.
fn rounded_up(time: f64) -> f64 {
    let unit = 10.0_f64.powf(time.log10().floor() - 3.0);
    (time / unit).ceil() * unit
}

/// What a run that has settled ends in.
fn state(record: &Recorder, rows: &[SampleRow], main: Option<(usize, f64)>) -> EndState {
    let mut counts = StatusCounts::default();
    rows.iter().for_each(|row| counts += row.counts);
    match main {
        Some(_) => EndState::LimitCycle,
        None if counts.stick + counts.slip == 0 => EndState::Separated,
        None if record.surface_speed == 0.0 => EndState::AtRest,
        None => EndState::SteadySliding,
    }
}

/// Whether too few periods of what vibrates most, above round-off, lie in the last fifth to tell that it dies out, and that nothing grows
/// below it: parts of a period are larger and smaller by its phase alone. What creeps to its end has no period.
fn too_short(record: &Recorder, fifth: &Range<usize>) -> Option<Unsettled> {
    let followed = record.followed_harmonics().filter_map(|n| series(record, fifth.clone(), n));
    let own = followed.max_by(|a, b| rms(a).total_cmp(&rms(b)))?;
    // A run that may stop waits for what grows slowly. A frequency that cannot be read has too few samples.
    let blocks = if record.stop_when_settled { FEWEST_BLOCKS } else { 1 };
    let seconds = fifth.len() as f64 * record.sample_interval;
    let needed = strongest_vibration(&own, 1.0 / record.sample_interval)
        .map_or(2.0 * seconds, |own| blocks as f64 * PERIODS / own.0.abs());
    let floor = round_off_floor(record.largest_motion(fifth.clone()));
    let is_short = seconds < needed && rms(&own) > floor && !creeps(&own);
    is_short.then(|| Unsettled::TooShort { duration: rounded_up(SPARE * needed / END) })
}

/// A harmonic above round-off that grows from quarter to quarter, or in which something grows at one rate beside the main vibration, which
/// repeats itself.
fn growing(
    record: &Recorder,
    fifth: &Range<usize>,
    main: Option<(usize, f64)>,
) -> Option<Unsettled> {
    let motion = record.largest_motion(fifth.clone());
    let alone = record.followed_harmonics().find_map(|harmonic| {
        let sizes = quarters(record, fifth, harmonic);
        let is_rising = sizes.windows(2).all(|pair| pair[1] > pair[0]);
        let [from, .., to] = sizes;
        let grows = is_rising && to > GROWTH * from && to > round_off_floor(motion);
        grows.then_some(Unsettled::Growing { harmonic: Some(harmonic), from, to })
    });
    alone.or_else(|| {
        let (wave, frequency) = main?;
        // A wave of several periods around the edge is the same after as many of its own.
        let own = frequency * record.sample_interval;
        let turns = (wave > 1).then(|| own / wave as f64).into_iter().chain([own]);
        record.followed_harmonics().find_map(|harmonic| {
            let rest = series(record, fifth.clone(), harmonic)?;
            let rest = turns.clone().fold(rest, without_multiples);
            let stage = harmonic_growth(&rest, 1.0 / record.sample_interval, motion).ok()?;
            let growth = stage.rate_per_s.value * fifth.len() as f64 * record.sample_interval;
            let [from, to] = [-0.5, 0.5].map(|half| rms(&rest) * (half * growth).exp());
            let grows = growth > GROWTH.ln() && stage.deviation < STRAIGHT * growth;
            grows.then_some(Unsettled::Growing { harmonic: Some(harmonic), from, to })
        })
    })
}

impl Block {
    fn of(record: &Recorder, range: Range<usize>, main: Option<(usize, f64)>) -> Self {
        let rows = &record.rows[range.clone()];
        let mut counts = StatusCounts::default();
        rows.iter().for_each(|row| counts += row.counts);
        let of = |n: usize| series(record, range.clone(), n).unwrap_or_default();
        let demodulated = main.map_or(c64::default(), |(harmonic, frequency)| {
            let turn = TAU * frequency * record.sample_interval;
            let values = of(harmonic).into_iter().zip(range.clone());
            values
                .map(|(value, k)| {
                    let x = (k - range.start) as f64 + 0.5;
                    let hann = (0.5 * TAU * x / range.len() as f64).sin().powi(2);
                    value * c64::from_polar(hann, -turn * k as f64)
                })
                .sum()
        });
        let twist = rows.iter().map(|row| row.harmonics[0][0]).sum::<f64>() / rows.len() as f64;
        let sizes = record.followed_harmonics().map(|n| rms(&of(n)));
        Self {
            start: range.start,
            means: counts.fractions().into_iter().chain([twist]).chain(sizes).collect(),
            demodulated,
        }
    }
}

/// Largest and smallest values over the blocks so far.
struct Extremes {
    means: Vec<[f64; 2]>,
    /// Distance of the main frequency from that of the demodulation, Hz.
    frequency: [f64; 2],
    /// The main vibration of the block added last.
    later: Option<c64>,
}

impl Extremes {
    /// Adds the block before those so far, `interval` earlier (s).
    fn add(&mut self, block: &Block, interval: f64) {
        self.means.resize(block.means.len(), NOTHING);
        self.means.iter_mut().zip(&block.means).for_each(|(range, value)| widen(range, *value));
        if let Some(later) = self.later.replace(block.demodulated) {
            widen(&mut self.frequency, (later / block.demodulated).arg() / (TAU * interval));
        }
    }

    /// The drift over all of them.
    fn drift(&self, record: &Recorder, main: Option<(usize, f64)>) -> Drift {
        let widest = |ranges: &[[f64; 2]]| ranges.iter().map(width).fold(0.0, f64::max);
        let (twist, harmonics) = (&self.means[TWIST], &self.means[HARMONICS..]);
        let status = widest(&self.means[STATUS]);
        let Some((_, frequency)) = main else {
            // Nothing vibrates at the end: what rings down before is held against the deformation.
            let scale = twist[1].abs().max(1e-3 * record.interference.abs());
            let amplitude = width(twist).max(widest(harmonics)) / scale.max(f64::MIN_POSITIVE);
            return Drift { amplitude, frequency: 0.0, status };
        };
        let largest = harmonics.iter().map(|range| range[1]);
        Drift {
            amplitude: widest(harmonics) / largest.fold(f64::MIN_POSITIVE, f64::max),
            frequency: width(&self.frequency) / frequency.abs(),
            status,
        }
    }
}

/// The range of no values.
const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

fn widen(range: &mut [f64; 2], value: f64) {
    *range = [range[0].min(value), range[1].max(value)];
}

fn width(range: &[f64; 2]) -> f64 {
    (range[1] - range[0]).max(0.0)
}
