//! The state of bodies under one set of pressed points as polynomials in the friction coefficient.

use super::Result;
use super::contact_system::ContactSystem;
use super::pressed_range::RESOLVED;
use super::pressed_state::ContactState;
use crate::contact::PressedState;

/// Smallest range of friction coefficients of a polynomial: without friction the state needs none, but its tangent is followed from there.
pub(super) const LEAST_RANGE: f64 = 0.05;

/// What follows the last two terms of a series that falls by a factor of three or more from one to the next, beside the larger of them.
const FOLLOWING: f64 = 0.2;

/// Points that are enough over a short range, and the share that they may leave out: every power is a matrix more.
const SHORT_RANGE: f64 = 0.1;
const FEW_NODES: [usize; 2] = [3, 5];
const EXACT: f64 = 1e-11;

/// Points through which the polynomial of a state goes, in a short range between two changes of the pressed points and in a
/// longer one: about `2 (range / 6)^n` is left out, as the state has poles beyond friction 1; from friction 0 on of rigid contact.
const NODES: [usize; 3] = [6, 8, 7];

/// Points through which it goes over the range of the set where the usual ones leave out more.
const MORE_NODES: [usize; 6] = [3, 5, 8, 12, 18, 24];

/// The values of its polynomials.
impl PressedState {
    /// `mu - a`, and 0 below `a`.
    fn beyond(&self, friction_coefficient: f64) -> f64 {
        (friction_coefficient - self.frozen_below).max(0.0)
    }

    /// Displacement over all dofs at a friction coefficient, m.
    pub fn displacement(&self, friction_coefficient: f64) -> Vec<f64> {
        evaluate(&self.displacements, self.beyond(friction_coefficient))
    }

    /// Normal force on each contact point, N; none of a state that is free of stress.
    pub fn normal_forces(&self, friction_coefficient: f64) -> Vec<f64> {
        evaluate(&self.normal_forces, self.beyond(friction_coefficient))
    }

    /// Stiffness of each contact point, N/m; none where no contact stiffens.
    pub fn springs(&self, friction_coefficient: f64) -> Vec<f64> {
        evaluate(&self.stiffnesses, self.beyond(friction_coefficient))
    }
}

/// Finds the friction coefficients between which the set of pressed points holds.
pub(super) type OwnRange<'a> = dyn Fn(&mut ContactSystem<'_>) -> Result<[f64; 2]> + 'a;

/// The state of one set of pressed points as a polynomial in the friction coefficient.
///
/// Where the usual points leave out too much, as near a friction coefficient at which sliding jams, other numbers of points over the
/// range in which the set is the one that holds, as `own_range` finds it, are tried: the polynomial is taken that leaves out least, the
/// friction coefficients `asked` for included. With it comes the share of the largest force that it leaves out.
pub(super) fn polynomial_state(
    bodies: &mut ContactSystem<'_>,
    is_pressed: &[bool],
    (range, own_range): ([f64; 2], &OwnRange<'_>),
    asked: &[f64],
) -> Result<EstimatedState> {
    let (usual, count) = usual_points(bodies, range);
    // The usual points may be continued to friction 0, others may not, and what stiffens neither.
    let begin = |interval: [f64; 2]| range[0].max(interval[0]);
    let own = |interval: [f64; 2]| match interval[0] <= 0.0 {
        true => [0.0, begin(interval)],
        false => [begin(interval); 2],
    };
    // Over a short range a few points hold the state to the last digits.
    if range[1] - range[0] <= SHORT_RANGE {
        let [lower, upper] = widened(range);
        let interval = [lower.max(0.0), upper];
        for count in FEW_NODES {
            let points = (interval, count);
            let found = EstimatedState::through(bodies, is_pressed, points, own(interval))?;
            if found.left_out <= EXACT {
                return Ok(found);
            }
        }
    }
    // The usual points, and where they leave out too much others, held to exact states.
    let origins = [0.0, begin(usual)];
    let mut best = EstimatedState::through(bodies, is_pressed, (usual, count), origins)?;
    if best.left_out > RESOLVED {
        let exact = asked.iter().map(|&friction| bodies.state_of(friction, is_pressed));
        let exact = exact.collect::<Result<Vec<ContactState>>>()?;
        best.compare(asked, &exact);
        // Beyond the range in which the set holds there may be no state.
        let within = own_range(bodies).unwrap_or(range);
        for count in MORE_NODES {
            let points = (within, count);
            let other = EstimatedState::through(bodies, is_pressed, points, own(within));
            if let Ok(mut other) = other {
                other.compare(asked, &exact);
                best = if other.left_out < best.left_out { other } else { best };
            }
            if best.left_out <= RESOLVED {
                break;
            }
        }
    }
    Ok(best)
}

/// The state of one set of pressed points in an interval of friction coefficients.
pub(super) struct EstimatedState {
    pub state: PressedState,
    /// Share of the largest force that its polynomials leave out, estimated.
    pub left_out: f64,
}

impl EstimatedState {
    /// That through the states at Chebyshev points of an interval, from the first of two origins, or the second where contact stiffens.
    fn through(
        bodies: &mut ContactSystem<'_>,
        is_pressed: &[bool],
        (interval, count): ([f64; 2], usize),
        origins: [f64; 2],
    ) -> Result<Self> {
        let nodes = chebyshev_points(count, interval);
        let [mut displacements, mut normal_forces, mut stiffnesses] = [const { Vec::new() }; 3];
        // Exact states, whose values are one column of each polynomial.
        for &friction in &nodes {
            let state = bodies.state_of(friction, is_pressed)?;
            displacements.push(bodies.whole_displacement(friction, &state));
            normal_forces.push(state.normal_forces);
            stiffnesses.extend(state.stiffnesses);
        }
        let left_out = FOLLOWING * last_terms(&normal_forces); // What follows the last terms is smaller than they are.
        let origin = origins[usize::from(!stiffnesses.is_empty())];
        let beyond: Vec<f64> = nodes.iter().map(|mu| mu - origin).collect(); // mu - a.
        // The origin may be either end of the interval.
        let reach = interval.iter().map(|mu| (mu - origin).abs()).fold(0.0, f64::max);
        let through = |values: Vec<Vec<f64>>| match values.is_empty() {
            true => values,
            false => interpolated(&beyond, values, reach),
        };
        let state = PressedState {
            displacements: through(displacements),
            normal_forces: through(normal_forces),
            stiffnesses: through(stiffnesses),
            is_pressed: is_pressed.to_vec(),
            frozen_below: origin,
        };
        Ok(Self { state, left_out })
    }

    /// Takes note of what its forces are wrong by at friction coefficients with known states.
    fn compare(&mut self, frictions: &[f64], exact: &[ContactState]) {
        for (friction, state) in frictions.iter().zip(exact) {
            let beyond = friction - self.state.frozen_below;
            let forces = evaluate(&self.state.normal_forces, beyond);
            let largest = largest(std::slice::from_ref(&state.normal_forces));
            for (own, exact) in forces.iter().zip(&state.normal_forces) {
                self.left_out = self.left_out.max((own - exact).abs() / largest);
            }
        }
    }
}

fn largest(values: &[Vec<f64>]) -> f64 {
    values.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()))
}

/// The largest of the last two coefficients of the Chebyshev series through `values` at Chebyshev points,
/// `c_n = 2 / N sum_k f(x_k) cos(n theta_k)`, beside the largest value.
fn last_terms(values: &[Vec<f64>]) -> f64 {
    let count = values.len();
    let coefficient = |n: usize, component: usize| -> f64 {
        let term = |k: usize| {
            let angle = std::f64::consts::PI * (k as f64 + 0.5) / count as f64;
            values[k][component] * (n as f64 * angle).cos()
        };
        2.0 / count as f64 * (0..count).map(term).sum::<f64>()
    };
    let components = 0..values[0].len();
    let last = components.flat_map(|i| [count - 1, count - 2].map(|n| coefficient(n, i).abs()));
    let largest = largest(values);
    if largest > 0.0 { last.fold(0.0_f64, f64::max) / largest } else { 0.0 }
}

/// Friction coefficients through which the polynomial of a state that holds in a range goes, where they are enough: their interval
/// and number.
fn usual_points(bodies: &ContactSystem<'_>, [lower, upper]: [f64; 2]) -> ([f64; 2], usize) {
    if bodies.pressing().laws.contains(&None) {
        return ([0.0, upper.max(LEAST_RANGE)], NODES[2]);
    }
    (widened([lower, upper]), NODES[usize::from(upper - lower > SHORT_RANGE)])
}

/// A range of friction coefficients, made as wide as a polynomial needs.
fn widened([lower, upper]: [f64; 2]) -> [f64; 2] {
    let wider = 0.5 * (LEAST_RANGE - (upper - lower)).max(0.0);
    [lower - wider, upper + wider]
}

/// `count` Chebyshev points of a range.
fn chebyshev_points(count: usize, [lower, upper]: [f64; 2]) -> Vec<f64> {
    let point = |k: usize| {
        let turn = std::f64::consts::PI * (k as f64 + 0.5) / count as f64;
        lower + 0.5 * (upper - lower) * (1.0 - turn.cos()) // -cos(theta) rises from -1 to 1.
    };
    (0..count).map(point).collect()
}

/// Coefficients by power of the polynomial through `values` at `points` (Newton's divided differences), without
/// trailing ones that are round-off within the `reach` of zero.
fn interpolated(points: &[f64], mut values: Vec<Vec<f64>>, reach: f64) -> Vec<Vec<f64>> {
    let count = points.len();
    let size = |values: &Vec<f64>| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let scale = values.iter().map(size).fold(0.0_f64, f64::max);
    // f[k-order..k] = (f[k] - f[k-1]) / (mu_k - mu_k-order), in place from the last on.
    for order in 1..count {
        for k in (order..count).rev() {
            let (before, after) = values.split_at_mut(k);
            let span = points[k] - points[k - order];
            for (value, previous) in after[0].iter_mut().zip(&before[k - 1]) {
                *value = (*value - previous) / span;
            }
        }
    }
    // Horner's scheme from Newton's form to powers.
    let mut powers: Vec<Vec<f64>> = vec![values[count - 1].clone()];
    for k in (0..count - 1).rev() {
        powers.insert(0, vec![0.0; values[k].len()]);
        for power in 0..powers.len() {
            for at in 0..values[k].len() {
                let above = powers.get(power + 1).map_or(0.0, |p| p[at]);
                powers[power][at] -= points[k] * above; // p <- p (mu - mu_k).
            }
        }
        for (sum, value) in powers[0].iter_mut().zip(&values[k]) {
            *sum += value;
        }
    }
    // A power whose whole reach is round-off of the largest value goes.
    let counts = |power: usize| size(&powers[power]) * reach.powi(power as i32) > 1e-11 * scale;
    let last = (1..powers.len()).rev().find(|&power| counts(power)).unwrap_or(0);
    powers.truncate(last + 1);
    powers
}

/// `sum_p c_p mu^p`.
fn evaluate(coefficients: &[Vec<f64>], friction_coefficient: f64) -> Vec<f64> {
    let mut powers = coefficients.iter().rev();
    let mut values = powers.next().cloned().unwrap_or_default();
    for coefficient in powers {
        for (value, constant) in values.iter_mut().zip(coefficient) {
            *value = constant + friction_coefficient * *value;
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::super::elimination::Elimination;
    use super::super::pressed_state::Pressing;
    use super::*;
    use crate::contact::{Point, SteadyFriction};
    use crate::fem::Triplets;

    /// Solves for a point whose force `1 / (jam - mu)` grows without bound at a friction coefficient: friction pulls a body of two
    /// dofs, `K = [k 1; 1 jam]`, along the second of them and so into the counterface.
    fn jamming(jam: f64, range: [f64; 2], asked: &[f64]) -> EstimatedState {
        const STIFFNESS: f64 = 10.0;
        let entries = vec![(0, 0, STIFFNESS), (0, 1, 1.0), (1, 0, 1.0), (1, 1, jam)];
        let friction = SteadyFriction { drag: 1.0, ..SteadyFriction::default() };
        let [normal, slip] = [0, 1].map(|dof| vec![(dof, 1.0)]);
        let points = [Point { normal, slip, friction, ..Point::default() }];
        let pressing = Pressing {
            stiffness: &Triplets { entries },
            load: vec![0.0; 2],
            elimination: Elimination::holding(2, []),
            points: &points,
            together: Vec::new(),
            contacts: Vec::new(),
            pushed: vec![1.0 / (STIFFNESS * jam - 1.0)],
            laws: vec![None],
        };
        let own = |_: &mut ContactSystem<'_>| Ok([0.3, 0.6]);
        let mut bodies = ContactSystem::new(&pressing).unwrap();
        polynomial_state(&mut bodies, &[true], (range, &own), asked).unwrap()
    }

    /// Closed form: far from jamming few points are enough, from friction 0 on; nearer to it those of the range of the state serve.
    #[test]
    fn forces_are_those_of_the_friction_asked_for_near_jamming_too() {
        let (range, asked) = ([0.3, 0.6], [0.3, 0.45, 0.6]);
        let cases = [(19.0, 0.0, 1e-7), (1.8, 0.3, 1e-7), (0.75, 0.3, 1e-6)];
        for (jam, frozen_below, bound) in cases {
            let EstimatedState { state, left_out } = jamming(jam, range, &asked);
            assert!(left_out < bound, "{jam} {left_out:e}");
            assert_eq!(state.frozen_below, frozen_below, "{jam}");
            for friction in asked {
                let exact = 1.0 / (jam - friction);
                let error = (state.normal_forces(friction)[0] / exact - 1.0).abs();
                assert!(error < bound, "{jam} {friction} {error:e}");
            }
        }
    }

    /// Closed form: of one friction coefficient alone, at the end of the range of its state, the force has its slope too.
    #[test]
    fn forces_of_one_friction_coefficient_follow_it() {
        let (jam, asked) = (0.75, 0.6);
        let EstimatedState { state, .. } = jamming(jam, [asked; 2], &[asked]);
        let [force, next] = [asked, asked + 1e-6].map(|friction| state.normal_forces(friction)[0]);
        let slope = (next - force) / 1e-6;
        assert!((slope * (jam - asked).powi(2) - 1.0).abs() < 1e-3, "{slope}");
    }
}
