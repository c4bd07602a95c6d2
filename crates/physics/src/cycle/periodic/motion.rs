//! What a periodic motion is like: powers, statuses, histories of the contact nodes, harmonics, fields.

use super::map::{PeriodMap, PeriodicState};
use super::search::Found;
use crate::contact::ContactStatus;
use crate::cycle::{CyclePowers, PhasePoint};
use crate::fem::operator::gather;
use crate::linalg::c64;
use crate::signal::forward_transform;
use crate::transient::StatusCounts;
use std::f64::consts::TAU;

/// Share of the motion that the harmonics in which it is told may leave, where nobody says how many.
pub const REMAINDER: f64 = 1e-3;

/// Largest differences of two motions that are one and the same where their periods have [`SAME_STEPS`] steps or more: of
/// frequency, amplitude and external power, relative, and of the fractions of contact nodes.
const SAME: [f64; 4] = [1e-3, 0.01, 5e-3, 0.01];
const SAME_STEPS: f64 = 100.0;

/// Reference of velocity levels, m/s.
pub const REFERENCE_VELOCITY: f64 = 5e-8;

/// How much of a motion is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MotionRequest {
    /// Instants of the contact over the period, at most one a step.
    pub instants: usize,
    /// Times at which the whole field is kept.
    pub frames: usize,
}

/// The whole body and its contact at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionFrame {
    /// Time, s.
    pub time: f64,
    /// Displacement (m) and velocity (m/s) over all dofs in nodal frames.
    pub fields: [Vec<f64>; 2],
    /// Each contact node, where the motion was stepped in time.
    pub contact: Option<Vec<PhasePoint>>,
}

/// One harmonic of the motion of the contact nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionHarmonic {
    /// Root mean square over the contact nodes of its amplitude along the normal and along the counterface, m.
    pub amplitude: [f64; 2],
    /// Root of the share in the mean square of the vibration that this and all lower harmonics leave.
    pub remainder: f64,
}

/// A periodic motion of a body and its contact. For each metre of thickness, of a body in three dimensions for the whole.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PeriodicMotion {
    /// `1 / T`, Hz.
    pub frequency_hz: f64,
    /// Steps of the period.
    pub steps: usize,
    /// `|P(x) - x|` over the amplitude.
    pub residual: f64,
    /// Periods that it took to find.
    pub periods: usize,
    /// Mean powers.
    pub powers: CyclePowers,
    /// Fractions of contact nodes that `[stick, slip, open]`, over the period.
    pub fractions: [f64; 3],
    /// The same of each contact node.
    pub shares: Vec<[f64; 3]>,
    /// Contact node, among those of the edge that touch at some time, that moves most along the counterface; time starts where it
    /// is farthest ahead.
    pub node: usize,
    /// Speed of the counterface at this node, m/s.
    pub counterface_speed: f64,
    /// Friction coefficient at this node; none where it falls with the slip speed.
    pub friction_coefficient: Option<f64>,
    /// Half the range of its displacement along the counterface, m.
    pub amplitude: f64,
    /// Root mean square of the velocity over the period and the mass of the body, m/s.
    pub velocity: f64,
    /// Each contact node at times over the period.
    pub instants: Vec<Vec<PhasePoint>>,
    /// Harmonics 1, 2, ... of the motion of the contact nodes.
    pub harmonics: Vec<MotionHarmonic>,
    /// The whole body, evenly spaced in time from zero on.
    pub frames: Vec<MotionFrame>,
}

impl PeriodicMotion {
    /// `2 pi f` times the amplitude: the velocity of a kick along the counterface that reaches it, m/s.
    pub fn kick_velocity(&self) -> f64 {
        TAU * self.frequency_hz * self.amplitude
    }

    /// Steps once more through a period that was found, from where the contact node that moves most is farthest ahead.
    pub fn of(map: &mut PeriodMap<'_>, found: &Found, request: MotionRequest) -> Self {
        let (mut motion, first) = Self::brief(map, found);
        map.place(&found.state);
        (0..first).for_each(|_| map.run.advance());
        let from = PeriodicState { motion: map.motion(), ..found.state };
        motion.record(map, &from, request);
        motion
    }

    /// The motion without histories, fields and shares of single nodes, and the step at which the contact node that moves most is
    /// farthest ahead.
    pub fn brief(map: &mut PeriodMap<'_>, found: &Found) -> (Self, usize) {
        let (samples, touches) = contact_displacements(map, &found.state);
        let (node, amplitude) = widest(&samples, &touches);
        let ahead = samples.iter().map(|sample| sample[node][1]).enumerate();
        let first = ahead.max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |most| most.0);
        let motion = Self {
            frequency_hz: 1.0 / found.state.period,
            steps: map.steps(),
            residual: found.residual,
            periods: found.periods,
            powers: found.image.powers,
            fractions: found.image.counts.fractions(),
            node,
            counterface_speed: map.run.contact().counterface_speed(node),
            friction_coefficient: map.run.contact().friction_coefficient(node),
            amplitude,
            velocity: found.image.amplitude / map.mass().sqrt(), // sqrt(<v^T M v> / m).
            harmonics: harmonics(&samples),
            ..Self::default()
        };
        (motion, first)
    }

    /// The contact and the fields over the period that begins with `from`.
    fn record(&mut self, map: &mut PeriodMap<'_>, from: &PeriodicState, request: MotionRequest) {
        map.place(from);
        let (steps, nodes) = (map.steps(), map.run.interface().len());
        let mut counts = vec![StatusCounts::default(); nodes];
        for step in 0..steps {
            let time = step as f64 * from.period / steps as f64;
            let at = [TAU * time * self.frequency_hz, time];
            let before = contact_motion(map);
            let fields = is_one_of(step, steps, request.frames).then(|| {
                let (fields, operator) = (map.run.fields(), map.run.operator());
                [&fields.displacement, &fields.velocity].map(|field| gather(operator, field))
            });
            map.run.advance();
            for (count, status) in counts.iter_mut().zip(&map.run.contact().status) {
                *count += *status;
            }
            if let Some([displacement, earlier]) = fields {
                let later = gather(map.run.operator(), &map.run.fields().velocity);
                let velocity = earlier.iter().zip(&later).map(|(a, b)| 0.5 * (a + b)).collect(); // v_n = (v_{n-1/2} + v_{n+1/2}) / 2.
                self.frames.push(MotionFrame {
                    time,
                    fields: [displacement, velocity],
                    contact: Some(instant(map, at, &before)),
                });
            }
            if is_one_of(step, steps, request.instants) {
                self.instants.push(instant(map, at, &before));
            }
        }
        self.shares = counts.iter().map(StatusCounts::fractions).collect();
    }

    /// How many harmonics leave no more than `remainder` of the vibration.
    pub fn harmonics_within(&self, remainder: f64) -> usize {
        let found = self.harmonics.iter().position(|own| own.remainder <= remainder);
        found.map_or(self.harmonics.len(), |place| place + 1)
    }

    /// Whether another motion is this one, each in steps of its own: frequency, statuses, powers and amplitude agree but for what
    /// the time step makes of them.
    pub fn is(&self, other: &Self) -> bool {
        let coarse = (SAME_STEPS / self.steps.min(other.steps) as f64).max(1.0); // Bounds widen in proportion to a longer step.
        let near = |a: f64, b: f64, share: f64| (a - b).abs() <= coarse * share * b.abs();
        let mut fractions = self.fractions.iter().zip(other.fractions);
        let [frequency, amplitude, power, status] = SAME;
        near(self.frequency_hz, other.frequency_hz, frequency)
            && near(self.amplitude, other.amplitude, amplitude)
            && near(self.powers.contact.external, other.powers.contact.external, power)
            && fractions.all(|(a, b)| (a - b).abs() < coarse * status)
    }
}

/// Level of a velocity (m/s) over [`REFERENCE_VELOCITY`], dB. The reference is that of airborne sound: a square metre that moves
/// with it like a piston much larger than the wave in air radiates 1e-12 W.
pub fn velocity_level(velocity: f64) -> f64 {
    20.0 * (velocity / REFERENCE_VELOCITY).log10()
}

/// Whether a step is one of so many that are evenly spaced over a period, from the first on.
fn is_one_of(step: usize, steps: usize, count: usize) -> bool {
    let count = count.min(steps);
    let place = (step * count).div_ceil(steps);
    count > 0 && place * steps / count == step // step = floor(place steps / count).
}

/// Displacement and velocity of the contact nodes that the time loop is in.
fn contact_motion(map: &PeriodMap<'_>) -> [Vec<[f64; 2]>; 2] {
    let (law, fields) = (map.run.contact(), map.run.fields());
    let nodes = 0..map.run.interface().len();
    [&fields.displacement, &fields.velocity]
        .map(|field| nodes.clone().map(|i| law.relative(i, field)).collect())
}

/// The contact nodes at the step that has just been done, at its phase and time, from the motion before it.
fn instant(
    map: &PeriodMap<'_>,
    [phase, time]: [f64; 2],
    [displacement, earlier]: &[Vec<[f64; 2]>; 2],
) -> Vec<PhasePoint> {
    let law = map.run.contact();
    let [_, later] = contact_motion(map);
    let lengths = map.run.interface().tributary_lengths.iter().enumerate();
    let point = |(i, length): (usize, &f64)| PhasePoint {
        phase,
        time,
        status: law.status[i],
        pressure: law.normal_force[i] / length,
        shear: law.tangential_force[i] / length,
        displacement: displacement[i],
        velocity: [0, 1].map(|c| 0.5 * (earlier[i][c] + later[i][c])),
    };
    lengths.map(point).collect()
}

/// Displacements of the contact nodes at every step of a period, and which of them touch at some time.
fn contact_displacements(
    map: &mut PeriodMap<'_>,
    state: &PeriodicState,
) -> (Vec<Vec<[f64; 2]>>, Vec<bool>) {
    map.place(state);
    let mut touches = vec![false; map.run.interface().len()];
    let steps = 0..map.steps();
    let sample = |_| {
        let [displacement, _] = contact_motion(map);
        map.run.advance();
        let status = map.run.contact().status.iter();
        for (touches, status) in touches.iter_mut().zip(status) {
            *touches |= *status != ContactStatus::Open;
        }
        displacement
    };
    let samples = steps.map(sample).collect();
    (samples, touches)
}

/// The node among those that touch that moves most along the counterface, and half the range of its displacement.
fn widest(samples: &[Vec<[f64; 2]>], touches: &[bool]) -> (usize, f64) {
    let range = |node: usize| {
        let [low, high] = crate::order::range(samples.iter().map(|sample| sample[node][1]));
        0.5 * (high - low)
    };
    let nodes = (0..touches.len()).filter(|&node| touches[node]);
    let ranges = nodes.map(|node| (node, range(node)));
    ranges.fold((0, 0.0), |best, own| if own.1 > best.1 { own } else { best })
}

/// Harmonics 1, 2, ... of displacements over one period: `samples[step][node]`, evenly spaced.
fn harmonics(samples: &[Vec<[f64; 2]>]) -> Vec<MotionHarmonic> {
    let (steps, nodes) = (samples.len(), samples.first().map_or(0, Vec::len));
    let highest = steps.saturating_sub(1) / 2; // Below half the steps: none is its own alias.
    let mut squares = vec![[0.0; 2]; highest + 1];
    let transform = forward_transform(steps);
    for node in 0..nodes {
        for component in 0..2 {
            let values = samples.iter().map(|sample| sample[node][component]);
            let mut values: Vec<c64> = values.map(|u| c64::new(u, 0.0)).collect();
            transform.process(&mut values);
            for (square, value) in squares.iter_mut().zip(&values) {
                square[component] += value.norm_sqr();
            }
        }
    }
    // Both signs of the frequency.
    let scale = 2.0 / steps.max(1) as f64;
    let amplitude = |square: f64| scale * (square / nodes.max(1) as f64).sqrt();
    let total: f64 = squares.iter().skip(1).flatten().sum(); // Parseval: sums of squares are mean squares but for a factor.
    let mut rest: f64 = total;
    let of = |square: &[f64; 2]| {
        rest -= square[0] + square[1];
        MotionHarmonic {
            amplitude: square.map(amplitude),
            remainder: (rest.max(0.0) / total.max(f64::MIN_POSITIVE)).sqrt(),
        }
    };
    squares.iter().skip(1).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harmonics_of_a_sum_of_two_are_those_and_what_the_first_leaves() {
        let sample = |k: usize| {
            let phase = TAU * k as f64 / 64.0;
            vec![[3.0 * phase.cos(), 1.0 + 4.0 * (2.0 * phase).sin()]; 3]
        };
        let samples: Vec<Vec<[f64; 2]>> = (0..64).map(sample).collect();
        let found = harmonics(&samples);
        assert!((found[0].amplitude[0] - 3.0).abs() < 1e-12);
        assert!((found[1].amplitude[1] - 4.0).abs() < 1e-12);
        assert!((found[0].remainder - 0.8).abs() < 1e-12);
        assert!(found[1].remainder < 1e-7);
    }
}
