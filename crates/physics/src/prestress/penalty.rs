//! Bodies on the springs of their contact points: sparse, for many thousands of points.

use super::joined_points::JoinedPoints;
use super::pressed_state::{ContactState, PressedBodies, Pressing, SHORT_RANGE, widened};
use super::{PrestressError, Result};
use crate::linalg::dense::{column, difference};
use crate::linalg::{LinearFamily, SparseLu};

/// Stiffness of an open point beside a pressed one in the matrix that is factorized: bodies may be held by contact alone.
const OPEN_SHARE: f64 = 1e-6;

/// Products after which another matrix is factorized, and the share of points that differ from it.
const MOST_PRODUCTS: usize = 30;
const MOST_CHANGED: f64 = 0.1;

/// Tangents of contact that stiffens that are tried, and the change of a force, over the largest, at which they have settled.
const MOST_TANGENTS: usize = 60;
const SETTLED: f64 = 1e-11;

/// Residual of the penetrations, over those without friction: as small as rounding lets it become, for polynomials over a short range of
/// friction magnify it by up to a million.
const TOLERANCE: f64 = 1e-16;

/// Points through which the polynomial of a state goes, in a short range between two changes of the pressed points and in a
/// longer one: about `2 (range / 6)^n` is left out, as the state has poles beyond friction 1.
const NODES: [usize; 2] = [6, 8];

/// Bodies whose contact points have springs `k_i`.
///
/// Pressed points push with `N_i = k_i (p_i - c_i)`, `c_i = n_i . u`, `p_i` the push, open ones not at all:
///
/// ```text
/// K u = f + sum_i N_i (n_i + mu drag_i t_i)
/// ```
///
/// With `P = K + sum r_i k_i n_i n_i^T`, symmetric and factorized once for a set of pressed points (`r_i` is one, and small at
/// open points), the separations alone are unknown, from those of no force on, `c_i = s_i p_i + y_i`:
///
/// ```text
/// y + n . P^-1 E y = n . P^-1 (f + sum_i r_i k_i s_i p_i n_i) - s p
/// E y = sum_i ((s_i - r_i) n_i + mu s_i drag_i t_i) k_i y_i,     s_i = 1 where pressed, else 0
/// ```
///
/// a system near the identity, as friction and the points that changed since are small beside `P`. Friction is in the matrix alone:
/// the systems of a set of pressed points share one space.
///
/// Contact that stiffens, `N_i = w_i p(p_i - c_i)`, is linear about the force found last, with the stiffness of its tangent
/// there and the push with which that passes through it: Newton's iteration on the approach as a function of the force, which
/// is concave, so that no step runs away.
pub(super) struct PenaltyContact<'a> {
    points: JoinedPoints<'a>,
    /// `k_i`, N/m, and `p_i`, m: of the tangent where contact stiffens.
    springs: Vec<f64>,
    pushed: Vec<f64>,
    /// `P`, the points pressed in it, and `r_i k_i` in it, N/m.
    solver: SparseLu,
    factorized: Vec<bool>,
    held: Vec<f64>,
    /// Whether the last solution took too long.
    is_slow: bool,
    /// Separations at the tangents of contact that stiffens found last.
    last: Vec<f64>,
    /// The systems of the springs as they are and of a set of pressed points.
    systems: Option<(Vec<bool>, LinearFamily)>,
}

impl<'a> PenaltyContact<'a> {
    /// Bodies on springs at all their points; `None` where a point is rigid.
    ///
    /// # Errors
    /// [`PrestressError::Singular`] where a body is held by nothing, not even by contact.
    pub fn new(pressing: &'a Pressing<'a>) -> Result<Option<Self>> {
        let springs: Option<Vec<f64>> = pressing.stiffnesses.iter().copied().collect();
        let Some(springs) = springs else {
            return Ok(None);
        };
        let points = JoinedPoints::new(pressing);
        Ok(Some(Self {
            last: Vec::new(),
            pushed: pressing.pushed.clone(),
            held: springs.clone(),
            solver: points.factorize(&springs)?,
            factorized: vec![true; springs.len()],
            points,
            springs,
            is_slow: false,
            systems: None,
        }))
    }

    /// Factorizes `P` of other pressed points where they differ too much from those in it, or the last solution took long.
    fn follow(&mut self, is_pressed: &[bool]) -> Result<()> {
        let changed = is_pressed.iter().zip(&self.factorized).filter(|(a, b)| a != b).count();
        let is_far = changed as f64 > MOST_CHANGED * is_pressed.len() as f64;
        let shares = is_pressed.iter().zip(&self.springs);
        let held: Vec<f64> = shares
            .map(|(&is_pressed, spring)| if is_pressed { *spring } else { OPEN_SHARE * spring })
            .collect();
        if is_far || self.is_slow && held != self.held {
            self.solver = self.points.factorize(&held)?;
            self.factorized = is_pressed.to_vec();
            self.held = held;
            self.systems = None;
        }
        Ok(())
    }

    /// Separations and normal forces on the springs as they are.
    fn linear_state(
        &mut self,
        friction_coefficient: f64,
        is_pressed: &[bool],
    ) -> (Vec<f64>, Vec<f64>) {
        let known = self.systems.take().filter(|(set, _)| set == is_pressed);
        let Self { points, springs, held, solver, .. } = &*self;
        let pressed = |values: &[f64]| -> Vec<f64> {
            let both = values.iter().zip(is_pressed);
            both.map(|(value, is_pressed)| if *is_pressed { *value } else { 0.0 }).collect()
        };
        let (own, origin) = (pressed(springs), pressed(&self.pushed)); // s k and s p.
        let along = |own: &dyn Fn(usize) -> [f64; 2]| (0..springs.len()).map(own).collect();
        // What the loads and the pushes alone do.
        let (_, mut systems) = known.unwrap_or_else(|| {
            let pushes = along(&|i| [held[i] * origin[i], 0.0]); // n . P^-1 (f + sum_i r_i k_i s_i p_i n_i) - s p.
            let response = points.respond(solver, &points.load(), &[pushes]);
            let separations = points.separations(column(response.as_ref(), 0));
            (Vec::new(), LinearFamily::new(difference(&separations, &origin)))
        });

        // With what `P` has not.
        let none = vec![0.0; points.unknowns.len()];
        let apply = |y: &[f64]| {
            // ((s - r) n + mu s drag t) k y, the part with mu by itself.
            let parts =
                [along(&|i| [(own[i] - held[i]) * y[i], 0.0]), along(&|i| [0.0, own[i] * y[i]])];
            let response = points.respond(solver, &none, &parts);
            let [fixed, moving] = [0, 1].map(|j| points.separations(column(response.as_ref(), j)));
            [y.iter().zip(fixed).map(|(y, r)| y + r).collect(), moving]
        };
        let start = difference(&self.last, &origin);
        let (found, products) = systems.solve(friction_coefficient, &start, apply, TOLERANCE);
        // N = s k (p - c) = - s k y, and c = s p + y; 0 - 0 has no sign.
        let forces = own.iter().zip(&found).map(|(spring, y)| 0.0 - spring * y).collect();
        self.is_slow = products > MOST_PRODUCTS;
        let separations = origin.iter().zip(&found).map(|(p, y)| p + y).collect();
        self.systems = Some((is_pressed.to_vec(), systems));
        (separations, forces)
    }

    /// Springs and pushes of the tangents at some forces; whether any contact stiffens.
    fn follow_laws(&mut self, normal_forces: &[f64]) -> bool {
        let (pressing, mut stiffens) = (self.points.pressing, false);
        for (i, (law, point)) in pressing.laws.iter().zip(pressing.points).enumerate() {
            if let Some(law) = law {
                stiffens = true;
                let force = normal_forces[i].max(0.0);
                // The tangent N = k (p' - c) at the approach g of the force, p' = p - g + N / k.
                let approach = law.approach(force / point.weight);
                self.springs[i] = point.weight * law.stiffness(approach);
                self.pushed[i] = pressing.pushed[i] - approach + force / self.springs[i];
            }
        }
        self.systems.take_if(|_| stiffens); // Other springs are another family.
        stiffens
    }
}

impl PressedBodies for PenaltyContact<'_> {
    fn pressing(&self) -> &Pressing<'_> {
        self.points.pressing
    }

    fn stiffness_at(&self, point: usize) -> f64 {
        self.springs[point]
    }

    fn usual_points(&self, [lower, upper]: [f64; 2]) -> ([f64; 2], usize) {
        (widened([lower, upper]), NODES[usize::from(upper - lower > SHORT_RANGE)])
    }

    fn state_of(&mut self, friction_coefficient: f64, is_pressed: &[bool]) -> Result<ContactState> {
        let mut before: Option<Vec<f64>> = None;
        for _ in 0..MOST_TANGENTS {
            self.follow(is_pressed)?;
            let (separations, normal_forces) = self.linear_state(friction_coefficient, is_pressed);
            let is_linear = !self.follow_laws(&normal_forces);
            let largest = normal_forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            // Newton's method: settled where the forces are those of the tangents' own places.
            let is_settled = before.as_ref().is_some_and(|before| {
                let moved = before.iter().zip(&normal_forces).map(|(a, b)| (a - b).abs());
                moved.fold(0.0, f64::max) <= SETTLED * largest
            });
            if is_linear || is_settled {
                return Ok(ContactState {
                    separations,
                    normal_forces,
                    stiffnesses: (!is_linear).then(|| self.springs.clone()),
                });
            }
            (before, self.last) = (Some(normal_forces), separations);
        }
        Err(PrestressError::NoState { friction_coefficient })
    }

    fn whole_displacement(&self, friction_coefficient: f64, state: &ContactState) -> Vec<f64> {
        self.points.displacement((&self.solver, &self.held), friction_coefficient, state)
    }
}
