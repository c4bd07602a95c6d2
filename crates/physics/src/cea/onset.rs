//! Critical friction coefficients: roots of `Re lambda(mu) = 0` on a branch.

use super::branch::{BranchPoint, Cubic};
use crate::cea::*;

/// Solves for one branch between friction coefficients at which it is known.
pub(super) trait BranchSolver {
    /// The branch at one friction coefficient, with whatever the solver needs to find it nearby.
    type State: Clone;
    /// Why it could not be solved for.
    type Error;

    /// Newton steps of the friction coefficient shorter than this are the last of the search: their square is round-off.
    const TOLERANCE: f64;

    /// Eigenvalue and slope.
    fn point(&self, state: &Self::State) -> BranchPoint;

    /// Growth relative to `|lambda|` that is round-off where the mode is neutral.
    fn round_off(&self, state: &Self::State) -> f64;

    /// The branch at `guess.friction_coefficient` between two states, where it is expected near
    /// `guess.eigenvalue`; `None` where it is not found.
    fn between(
        &mut self,
        from: &Self::State,
        to: &Self::State,
        guess: BranchPoint,
    ) -> Result<Option<Self::State>, Self::Error>;
}

/// A range of friction coefficients over which a branch grows.
#[derive(Clone)]
pub(super) struct Instability<S> {
    pub onset: S,
    pub restabilized: Option<S>,
    /// Whether it grows from the first state on.
    pub from_start: bool,
    /// Friction coefficient after which it jumped to `onset`.
    pub lost_after: Option<f64>,
    /// Whether growth crosses zero at its ends: a neutral branch begins to grow where it meets another one.
    pub crosses: bool,
}

impl<S> Instability<S> {
    /// The interval of the branch with this name.
    pub fn interval(
        &self,
        (harmonic, branch, direction): (usize, usize, i8),
        point: impl Fn(&S) -> BranchPoint,
    ) -> UnstableInterval {
        let place = |state: &S| {
            let point = point(state);
            (point.friction_coefficient, point.eigenvalue.im / TAU)
        };
        let (critical_friction, frequency_hz) = place(&self.onset);
        UnstableInterval {
            harmonic,
            branch,
            direction,
            critical_friction,
            frequency_hz,
            restabilized: self.restabilized.as_ref().map(place),
            unstable_from_start: self.from_start,
            lost_after: self.lost_after,
            ..UnstableInterval::default()
        }
    }
}

/// Growing intervals of a branch with these `states` (rising friction coefficient), from sign changes of
/// `Re(lambda)` between them and the turning points of the cubics through them.
pub(super) fn instabilities<B: BranchSolver>(
    solver: &mut B,
    states: &[B::State],
) -> Result<Vec<Instability<B::State>>, B::Error> {
    let mut search = Search { solver };
    let mut found: Vec<Instability<B::State>> = Vec::new();
    let Some(first) = states.first() else { return Ok(found) };
    let mut was_growing = search.is_growing(first) || search.grows_from_zero(first); // An interval that is open from the first state on.
    if was_growing {
        let onset = first.clone();
        found.push(Instability {
            onset,
            restabilized: None,
            from_start: true,
            lost_after: None,
            crosses: true,
        });
    }
    for pair in states.windows(2) {
        let mut start = pair[0].clone();
        for end in search.with_turning_points(&pair[0], &pair[1])? {
            if search.is_growing(&end) != was_growing {
                // A change of sign is the beginning of an interval or the end of the open one.
                let is_neutral = search.is_neutral(&start, &end);
                let root = search.root(&start, &end, is_neutral)?;
                let before = search.solver.point(&start).friction_coefficient;
                match found.last_mut().filter(|_| was_growing) {
                    Some(open) => {
                        open.restabilized = root;
                        open.crosses &= !is_neutral;
                    }
                    None => found.push(Instability {
                        lost_after: root.is_none().then_some(before),
                        onset: root.unwrap_or_else(|| end.clone()), // After a jump the first state beyond it.
                        restabilized: None,
                        from_start: false,
                        crosses: !is_neutral,
                    }),
                }
                was_growing = !was_growing; // What comes next is looked at from there.
            }
            start = end;
        }
    }
    Ok(found)
}

struct Search<'a, B: BranchSolver> {
    solver: &'a mut B,
}

impl<B: BranchSolver> Search<'_, B> {
    /// Growth rate that round-off may be of, rad/s.
    fn round_off(&self, state: &B::State) -> f64 {
        self.solver.round_off(state) * self.solver.point(state).eigenvalue.norm()
    }

    /// Growth rate beyond round-off, 1/s.
    fn growth(&self, state: &B::State) -> f64 {
        self.solver.point(state).eigenvalue.re - self.round_off(state)
    }

    fn is_growing(&self, state: &B::State) -> bool {
        self.growth(state) > 0.0
    }

    /// Whether a branch without any damping starts to grow with the first friction.
    fn grows_from_zero(&self, state: &B::State) -> bool {
        let (point, growth) = (self.solver.point(state), self.growth(state));
        let is_neutral = growth <= 0.0 && growth > -1e2 * self.round_off(state); // Zero but for some rounding errors.
        is_neutral && point.rate.re > RESIDUAL_BOUND * point.eigenvalue.norm()
    }

    fn solve(
        &mut self,
        from: &B::State,
        to: &B::State,
        cubic: &Cubic,
        start: f64,
        friction: f64,
    ) -> Result<Option<B::State>, B::Error> {
        let guess = BranchPoint {
            friction_coefficient: friction,
            eigenvalue: cubic.value((friction - start) / cubic.width),
            ..self.solver.point(from)
        };
        self.solver.between(from, to, guess)
    }

    /// The states of `(start, end]` between which `Re(lambda)` is monotonic: extrema of the cubic that come
    /// near zero are solved for, then `end`.
    fn with_turning_points(
        &mut self,
        start: &B::State,
        end: &B::State,
    ) -> Result<Vec<B::State>, B::Error> {
        let (first, last) = (self.solver.point(start), self.solver.point(end));
        let cubic = Cubic::between(&first, &last);
        let (a, b) = (first.eigenvalue.re, last.eigenvalue.re);
        let doubt = NEAR * last.eigenvalue.norm() + 0.1 * (b - a).abs(); // What the cubic may be wrong by, generously.
        let mut states = Vec::new();
        for t in cubic.turning_points() {
            let value = cubic.real_part(t);
            let changes_sign = value.signum() != a.signum() || value.signum() != b.signum();
            // What turns by round-off alone, as a branch that stays neutral does, comes no nearer to zero than the ends.
            let turn = (value - a).abs().min((value - b).abs());
            let is_turn = turn > self.round_off(end);
            if is_turn && (value.abs() < doubt || changes_sign) {
                let origin = first.friction_coefficient;
                let friction = origin + t * cubic.width;
                states.extend(self.solve(start, end, &cubic, origin, friction)?);
            }
        }
        states.push(end.clone());
        Ok(states)
    }

    /// Whether a branch that grows at one of two states is neutral at the other.
    fn is_neutral(&self, start: &B::State, end: &B::State) -> bool {
        let calm = if self.is_growing(start) { end } else { start };
        self.solver.point(calm).eigenvalue.re > -self.round_off(calm)
    }

    /// Root of `Re(lambda)` between states of opposite sign: Newton steps on the branch, kept inside the bracket, from the root of the
    /// cubic; nothing where it jumps across zero. A branch that is neutral on one side begins to grow where that exceeds round-off.
    fn root(
        &mut self,
        start: &B::State,
        end: &B::State,
        is_neutral: bool,
    ) -> Result<Option<B::State>, B::Error> {
        let falls = self.is_growing(start);
        let height = |search: &Self, state: &B::State| match is_neutral {
            true => search.growth(state),
            false => search.solver.point(state).eigenvalue.re,
        };
        let (first, last) = (self.solver.point(start), self.solver.point(end));
        let cubic = Cubic::between(&first, &last);
        let (mut low, mut high) = (start.clone(), end.clone());
        let (mut bottom, mut top) = (first.friction_coefficient, last.friction_coefficient);
        let mut friction = bottom + cubic.root() * cubic.width;
        let is_first = first.eigenvalue.re.abs() < last.eigenvalue.re.abs();
        let (mut best, mut is_there) = (if is_first { start.clone() } else { end.clone() }, false);
        for _ in 0..60 {
            let origin = first.friction_coefficient;
            let Some(state) = self.solve(&low, &high, &cubic, origin, friction)? else { break };
            let point = self.solver.point(&state);
            // The bracket closes from the side that the new state is on.
            let growth = height(self, &state);
            if (growth > 0.0) == falls {
                (low, bottom) = (state.clone(), friction);
            } else {
                (high, top) = (state.clone(), friction);
            }
            best = state;
            if is_there {
                break;
            }
            // Where two neutral branches meet the square of the growth rate is even in friction, not the rate itself.
            let power = if is_neutral && growth > 0.0 { 2.0 } else { 1.0 };
            let newton = friction - growth / (power * point.rate.re);
            let is_inside = newton > bottom && newton < top;
            let next = if is_inside { newton } else { 0.5 * (bottom + top) };
            is_there = (next - friction).abs() <= B::TOLERANCE * (1.0 + friction);
            friction = next;
        }
        let point = self.solver.point(&best);
        let steep = 10.0 * B::TOLERANCE * (1.0 + point.friction_coefficient) * point.rate.re.abs(); // Growth over ten of the last steps.
        // Growth beyond that is a jump, unless it is as steep: another branch was taken for this one.
        let has_root =
            height(self, &best).abs() <= steep.max(SAME_EIGENVALUE * point.eigenvalue.norm());
        Ok(has_root.then_some(best))
    }
}
