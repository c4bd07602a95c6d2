//! Bodies as their contact points feel them, and the contact state by complementarity.

use super::PrestressError;
use super::cholesky::CholeskySolver;
use super::elimination::Elimination;
use super::friction_polynomial::{evaluate, interpolated};
use crate::contact::{Point, Row};
use crate::fem::{DofMap, Triplets};
use crate::linalg::{DenseLu, Mat};

/// Contact points whose responses are computed together.
const BLOCK: usize = 32;

/// Sets of pressed points that are tried at one friction coefficient before the state is called missing.
const MAX_SETS: usize = 200;

/// Degree in the friction coefficient of the polynomial that stands for a state which is not affine in it.
const DEGREE: usize = 6;

/// Width to which a friction coefficient is located at which contact points open or close.
const CHANGE_WIDTH: f64 = 1e-9;

/// What presses bodies together.
#[derive(Clone, Debug)]
pub struct Pressing<'a> {
    /// Stiffness over all dofs, supports included.
    pub stiffness: &'a Triplets,
    /// Load on all dofs, N (N/m in the plane).
    pub load: Vec<f64>,
    /// Held dofs and ties.
    pub elimination: Elimination,
    /// The contact points.
    pub points: &'a [Point],
    /// How far the counterface is pushed in at each, `delta_i - g_i`, m.
    pub pushed: Vec<f64>,
    /// Stiffness of the contact of each, N/m; `None` is rigid contact.
    pub stiffnesses: Vec<Option<f64>>,
}

/// Bodies condensed onto their contact points.
///
/// Pressed points obey `c_i = p_i - N_i / k_i` with the separation `c_i = n_i . u` and the push `p_i = delta_i - g_i`
/// (`1 / k_i = 0` where the contact is rigid), open ones `N_i = 0`:
///
/// ```text
/// K u = f + sum_i N_i (n_i + mu drag_i t_i),   c_i >= p_i - N_i / k_i,   N_i >= 0,   N_i (c_i - p_i + N_i / k_i) = 0
/// ```
///
/// is a linear complementarity problem with a matrix that is not symmetric. Bodies may be held by the contact alone, so
/// springs `kappa_i` at the points stand in `K* = K + sum kappa_i n_i n_i^T`, and their forces are given back exactly:
///
/// ```text
/// c = c_0 + A (N + kappa c) + mu B N,   A_ij = n_i . K*^-1 n_j,   B_ij = n_i . K*^-1 t_j drag_j,   c_0 = n . K*^-1 f
/// ```
///
/// One solution for each point serves both: `B` has the rows of `t` and the columns of `K*^-1 n`, since `K*` is symmetric.
pub struct CondensedContact<'a> {
    pressing: &'a Pressing<'a>,
    unknowns: DofMap,
    solver: CholeskySolver,
    /// Rows `n` and `drag t` over the unknowns.
    normals: Vec<Row>,
    drags: Vec<Row>,
    /// `A` and `B`.
    normal_response: Mat<f64>,
    drag_response: Mat<f64>,
    /// `c_0`.
    unpressed: Vec<f64>,
    /// `kappa_i`.
    springs: Vec<f64>,
}

/// Separations and normal forces of the points under one set of pressed points.
#[derive(Clone)]
struct ContactState {
    separations: Vec<f64>,
    normal_forces: Vec<f64>,
}

/// The bodies under one set of pressed points, as polynomials in the friction coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct PressedState {
    /// Displacement `u(mu)` of all dofs by power of `mu`, m.
    pub displacements: Vec<Vec<f64>>,
    /// Normal force on each contact point `N_i(mu)` by power of `mu`, N (N/m in the plane).
    pub normal_forces: Vec<Vec<f64>>,
    /// Whether each contact point is pressed; the others are open.
    pub is_pressed: Vec<bool>,
}

impl PressedState {
    /// Displacement over all dofs at a friction coefficient, m.
    pub fn displacement(&self, friction_coefficient: f64) -> Vec<f64> {
        evaluate(&self.displacements, friction_coefficient)
    }

    /// Normal force on each contact point, N; none of a state that is free of stress.
    pub fn normal_forces(&self, friction_coefficient: f64) -> Vec<f64> {
        evaluate(&self.normal_forces, friction_coefficient)
    }
}

/// States over a range of friction coefficients.
#[derive(Clone, Debug, Default)]
pub struct PressedRange {
    /// One state for each set of pressed points, in order of the friction coefficient.
    pub states: Vec<PressedState>,
    /// Which state each friction coefficient has.
    pub state_of: Vec<usize>,
    /// Friction coefficients at which one state gives way to the next.
    pub changes: Vec<f64>,
}

impl<'a> CondensedContact<'a> {
    /// Condenses the bodies onto their points.
    ///
    /// # Errors
    /// [`PrestressError::Singular`] where a body is held by nothing, not even by contact.
    pub fn new(pressing: &'a Pressing<'a>) -> Result<Self, PrestressError> {
        let elimination = &pressing.elimination;
        let unknowns = elimination.unknowns();
        let over_unknowns = |row: &Row| -> Row {
            let all = elimination.transposed(row).into_iter();
            all.filter_map(|(dof, a)| Some((unknowns.unknown_of[dof]?, a)))
                .collect()
        };
        let points = pressing.points.iter();
        let normals: Vec<Row> = points.clone().map(|p| over_unknowns(&p.normal)).collect();
        let drags = points.map(|point| {
            let slip = over_unknowns(&point.slip).into_iter();
            slip.map(|(dof, a)| (dof, point.friction.drag * a))
                .collect()
        });
        let drags: Vec<Row> = drags.collect();

        // K* over the unknowns.
        let mut regular = elimination.congruent(pressing.stiffness);
        let springs = spring_stiffnesses(pressing.points, &regular);
        for (row, spring) in normals.iter().zip(&springs) {
            for &(i, along) in row {
                for &(j, across) in row {
                    let [i, j] = [unknowns.dofs[i], unknowns.dofs[j]];
                    regular.push(i, j, along * spring * across);
                }
            }
        }
        let solver = CholeskySolver::new(&regular, &unknowns)?;
        let count = normals.len();
        let mut condensed = Self {
            pressing,
            solver,
            normal_response: Mat::zeros(count, count),
            drag_response: Mat::zeros(count, count),
            unpressed: Vec::new(),
            normals,
            drags,
            springs,
            unknowns,
        };
        condensed.respond();
        Ok(condensed)
    }

    /// `A`, `B` and `c_0`, a block of unit forces at a time.
    fn respond(&mut self) {
        let count = self.normals.len();
        for first in (0..count).step_by(BLOCK) {
            let width = BLOCK.min(count - first);
            let mut block = Mat::<f64>::zeros(self.unknowns.len(), width);
            for j in 0..width {
                for &(dof, along) in &self.normals[first + j] {
                    block[(dof, j)] += along;
                }
            }
            self.solver.solve_block(block.as_mut());
            let response = |row: &Row, j: usize| -> f64 {
                row.iter().map(|&(dof, a)| a * block[(dof, j)]).sum()
            };
            for j in 0..width {
                for i in 0..count {
                    self.normal_response[(i, first + j)] = response(&self.normals[i], j);
                    // K* is symmetric: the response of n_j to t_i is that of t_i to n_j.
                    self.drag_response[(first + j, i)] = response(&self.drags[i], j);
                }
            }
        }
        let load = self
            .pressing
            .elimination
            .transposed_forces(&self.pressing.load);
        let resting = self.solver.solve(self.unknowns.restrict(&load));
        self.unpressed = self.normals.iter().map(|row| form(row, &resting)).collect();
    }

    /// `1 / k_i`, m/N.
    fn compliance(&self, i: usize) -> f64 {
        self.pressing.stiffnesses[i].map_or(0.0, f64::recip)
    }

    /// The state in which exactly the points of `is_pressed` touch, whatever sign their forces have.
    fn state_of(&self, friction_coefficient: f64, is_pressed: &[bool]) -> ContactState {
        let (count, pushed) = (is_pressed.len(), &self.pressing.pushed);
        // Unknown: the normal force of a pressed point, the separation of an open one; columns scaled to be alike.
        let scale: Vec<f64> = (0..count).map(|i| self.normal_response[(i, i)]).collect();
        let (springs, a, b) = (&self.springs, &self.normal_response, &self.drag_response);
        let matrix = Mat::from_fn(count, count, |i, j| {
            let own = f64::from(u8::from(i == j));
            if is_pressed[j] {
                let yields = self.compliance(j);
                let pushes = a[(i, j)] * (1.0 - springs[j] * yields);
                (-own * yields - pushes - friction_coefficient * b[(i, j)]) / scale[j]
            } else {
                own - a[(i, j)] * springs[j]
            }
        });
        let mut solution = Mat::from_fn(count, 1, |i, _| {
            let pressed = (0..count).filter(|&j| is_pressed[j]);
            let given: f64 = pressed.map(|j| a[(i, j)] * springs[j] * pushed[j]).sum();
            let own = if is_pressed[i] { pushed[i] } else { 0.0 };
            self.unpressed[i] + given - own
        });
        DenseLu::factorize(matrix).solve_in_place(solution.as_mut());
        let mut state = ContactState {
            separations: vec![0.0; count],
            normal_forces: vec![0.0; count],
        };
        for i in 0..count {
            if is_pressed[i] {
                let force = solution[(i, 0)] / scale[i];
                state.normal_forces[i] = force;
                state.separations[i] = pushed[i] - self.compliance(i) * force;
            } else {
                state.separations[i] = solution[(i, 0)];
            }
        }
        state
    }

    /// The pressed points at one friction coefficient, by the primal-dual active set (a semismooth Newton iteration on
    /// the complementarity) from `start`; where that runs in circles, one point at a time.
    fn pressed_points(
        &self,
        friction_coefficient: f64,
        start: &[bool],
    ) -> Result<Vec<bool>, PrestressError> {
        let mut set = start.to_vec();
        let mut seen: Vec<Vec<bool>> = Vec::new();
        for _ in 0..MAX_SETS {
            let state = self.state_of(friction_coefficient, &set);
            let wrong = self.violations(&state, &set);
            if state.separations.iter().any(|c| !c.is_finite()) {
                break;
            }
            let Some(worst) = wrong.iter().max_by(|a, b| a.1.total_cmp(&b.1)) else {
                return Ok(set);
            };
            let is_circling = seen.contains(&set);
            seen.push(set.clone());
            if is_circling {
                set[worst.0] = !set[worst.0];
            } else {
                wrong.iter().for_each(|&(i, _)| set[i] = !set[i]);
            }
        }
        Err(PrestressError::NoState {
            friction_coefficient,
        })
    }

    /// Pressed points that are pulled and open points that penetrate, each with how much: a force, or the force of
    /// the point's own stiffness over the penetration.
    fn violations(&self, state: &ContactState, is_pressed: &[bool]) -> Vec<(usize, f64)> {
        let sizes = state.normal_forces.iter().map(|force| force.abs());
        let largest = sizes.fold(0.0_f64, f64::max);
        let excess = |i: usize| {
            if is_pressed[i] {
                -state.normal_forces[i]
            } else {
                let penetration = self.pressing.pushed[i] - state.separations[i];
                penetration / self.normal_response[(i, i)]
            }
        };
        // Round-off must not flip a point that just touches.
        let bound = 1e-12 * largest;
        (0..is_pressed.len())
            .map(|i| (i, excess(i)))
            .filter(|&(_, excess)| excess > bound)
            .collect()
    }

    /// Displacement of every dof from the state of the contact points.
    fn whole_displacement(&self, friction_coefficient: f64, state: &ContactState) -> Vec<f64> {
        let elimination = &self.pressing.elimination;
        let load = elimination.transposed_forces(&self.pressing.load);
        let mut right = self.unknowns.restrict(&load);
        for (i, &force) in state.normal_forces.iter().enumerate() {
            let pressed = force + self.springs[i] * state.separations[i];
            for &(dof, along) in &self.normals[i] {
                right[dof] += pressed * along;
            }
            for &(dof, along) in &self.drags[i] {
                right[dof] += friction_coefficient * force * along;
            }
        }
        elimination.displacement(&self.unknowns.expand(&self.solver.solve(right)))
    }

    /// States at every one of `friction_coefficients`: rising values, each starting from the set of the last.
    ///
    /// # Errors
    /// [`PrestressError::NoState`] at the first friction coefficient without one; [`PrestressError::GapEverywhere`].
    pub fn range(&self, friction_coefficients: &[f64]) -> Result<PressedRange, PrestressError> {
        let mut order: Vec<usize> = (0..friction_coefficients.len()).collect();
        order.sort_by(|&a, &b| friction_coefficients[a].total_cmp(&friction_coefficients[b]));
        let mut sets: Vec<(Vec<bool>, f64)> = Vec::new();
        let mut state_of = vec![0; friction_coefficients.len()];
        let mut changes = Vec::new();
        let mut start = vec![true; self.normals.len()];
        for (rank, &i) in order.iter().enumerate() {
            let friction = friction_coefficients[i];
            let set = self.pressed_points(friction, &start)?;
            if !set.contains(&true) {
                return Err(self.gap_everywhere());
            }
            if sets.last().is_none_or(|(last, _)| *last != set) {
                if rank > 0 {
                    let before = friction_coefficients[order[rank - 1]];
                    changes.push(self.change_between(&start, before, friction)?);
                }
                sets.push((set.clone(), friction));
            }
            if let Some(last) = sets.last_mut() {
                last.1 = friction;
            }
            state_of[i] = sets.len() - 1;
            start = set;
        }
        let states = sets.into_iter().enumerate().map(|(k, (set, last))| {
            let upper = changes.get(k).copied().unwrap_or(last);
            self.polynomial_state(set, upper)
        });
        Ok(PressedRange {
            states: states.collect(),
            state_of,
            changes,
        })
    }

    fn gap_everywhere(&self) -> PrestressError {
        let distances = self.pressing.pushed.iter().map(|pushed| -pushed);
        let gaps = self.pressing.points.iter().zip(&self.pressing.pushed);
        PrestressError::GapEverywhere {
            total: self.normals.len(),
            distance: distances.fold(f64::INFINITY, f64::min).max(0.0),
            interference: gaps
                .map(|(point, pushed)| pushed + point.gap)
                .fold(0.0, f64::max),
        }
    }

    /// The friction coefficient up to which the set at `low` holds, by bisection.
    fn change_between(
        &self,
        set: &[bool],
        mut low: f64,
        mut high: f64,
    ) -> Result<f64, PrestressError> {
        while high - low > CHANGE_WIDTH {
            let middle = 0.5 * (low + high);
            if self.pressed_points(middle, set)? == set {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(0.5 * (low + high))
    }

    /// The state of one set of pressed points as a polynomial through Chebyshev points of `[0, upper]`.
    fn polynomial_state(&self, is_pressed: Vec<bool>, upper: f64) -> PressedState {
        // Without friction the state needs no polynomial, but its tangent is followed from there.
        let upper = upper.max(0.05);
        let nodes: Vec<f64> = (0..=DEGREE)
            .map(|k| {
                let turn = std::f64::consts::PI * (k as f64 + 0.5) / (DEGREE + 1) as f64;
                0.5 * upper * (1.0 - turn.cos())
            })
            .collect();
        let solved = nodes.iter().map(|&mu| {
            let state = self.state_of(mu, &is_pressed);
            (self.whole_displacement(mu, &state), state.normal_forces)
        });
        let (displacements, normal_forces): (Vec<_>, Vec<_>) = solved.unzip();
        PressedState {
            displacements: interpolated(&nodes, displacements, upper),
            normal_forces: interpolated(&nodes, normal_forces, upper),
            is_pressed,
        }
    }
}

fn form(row: &Row, x: &[f64]) -> f64 {
    row.iter().map(|&(dof, a)| a * x[dof]).sum()
}

/// Springs at the points, in proportion to their weights, that together are about as stiff as a node of the bodies.
fn spring_stiffnesses(points: &[Point], stiffness: &Triplets) -> Vec<f64> {
    let diagonal = stiffness.entries.iter().filter(|entry| entry.0 == entry.1);
    let (sum, count) = diagonal.fold((0.0, 0_usize), |(sum, count), entry| {
        (sum + entry.2.abs(), count + 1)
    });
    let whole: f64 = points.iter().map(|point| point.weight).sum();
    let total = sum / count.max(1) as f64;
    let share = |point: &Point| total * point.weight / whole;
    points.iter().map(share).collect()
}
