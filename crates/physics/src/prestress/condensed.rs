//! Bodies condensed onto their contact points: a dense system, as rigid contact needs it.

use super::Result;
use super::joined_points::JoinedPoints;
use super::pressed_state::{ContactState, LEAST_RANGE, PressedBodies, Pressing};
use crate::contact::{Point, Row};
use crate::fem::Triplets;
use crate::linalg::{DenseLu, Mat, SparseLu};

/// Points through which the polynomial of a state goes.
const NODES: usize = 7;

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
pub(super) struct CondensedContact<'a> {
    points: JoinedPoints<'a>,
    solver: SparseLu,
    /// `A` and `B`.
    normal_response: Mat<f64>,
    drag_response: Mat<f64>,
    /// `c_0`.
    unpressed: Vec<f64>,
    /// `kappa_i`.
    springs: Vec<f64>,
}

impl<'a> CondensedContact<'a> {
    /// Condenses the bodies onto their points.
    ///
    /// # Errors
    /// [`super::PrestressError::Singular`] where a body is held by nothing, not even by contact.
    pub fn new(pressing: &'a Pressing<'a>) -> Result<Self> {
        let points = JoinedPoints::new(pressing);
        let springs = spring_stiffnesses(pressing.points, &points.stiffness);
        let count = springs.len();
        let mut condensed = Self {
            solver: points.factorize(&springs)?,
            points,
            normal_response: Mat::zeros(count, count),
            drag_response: Mat::zeros(count, count),
            unpressed: Vec::new(),
            springs,
        };
        condensed.respond();
        Ok(condensed)
    }

    /// `A`, `B` and `c_0`.
    fn respond(&mut self) {
        let JoinedPoints { normals, drags, touched, .. } = &self.points;
        let columns = self.points.columns(&self.solver, normals); // K*^-1 n_j.
        let place = |unknown: usize| touched.unknown_of[unknown].expect("rows touch it");
        let response = |row: &Row, j: usize| -> f64 {
            row.iter().map(|&(unknown, a)| a * columns[(place(unknown), j)]).sum()
        };
        for j in 0..normals.len() {
            for i in 0..normals.len() {
                self.normal_response[(i, j)] = response(&normals[i], j);
                self.drag_response[(j, i)] = response(&drags[i], j); // K* is symmetric: n_j to t_i is t_i to n_j.
            }
        }
        self.unpressed = self.points.separations(&self.solver.solve(self.points.load())); // c_0 = n . K*^-1 f.
    }

    /// `1 / k_i`, m/N.
    fn compliance(&self, i: usize) -> f64 {
        self.points.pressing.stiffnesses[i].map_or(0.0, f64::recip)
    }
}

impl PressedBodies for CondensedContact<'_> {
    fn pressing(&self) -> &Pressing<'_> {
        self.points.pressing
    }

    fn stiffness_at(&self, point: usize) -> f64 {
        self.normal_response[(point, point)].recip() // 1 / A_ii.
    }

    fn usual_points(&self, [_, upper]: [f64; 2]) -> ([f64; 2], usize) {
        ([0.0, upper.max(LEAST_RANGE)], NODES)
    }

    fn state_of(&mut self, friction_coefficient: f64, is_pressed: &[bool]) -> Result<ContactState> {
        let (count, pushed) = (is_pressed.len(), &self.points.pressing.pushed);
        // Unknown: the normal force of a pressed point, the separation of an open one; columns scaled to be alike.
        let scale: Vec<f64> = (0..count).map(|i| self.normal_response[(i, i)]).collect();
        let (springs, a, b) = (&self.springs, &self.normal_response, &self.drag_response);
        // c - A (N + kappa c) - mu B N = c_0 with c_j = p_j - N_j / k_j where j is pressed, N_j = 0 where it is open.
        let matrix = Mat::from_fn(count, count, |i, j| {
            let own = f64::from(u8::from(i == j));
            if is_pressed[j] {
                let yields = self.compliance(j);
                let pushes = a[(i, j)] * (1.0 - springs[j] * yields); // A_ij (1 - kappa_j / k_j).
                (-own * yields - pushes - friction_coefficient * b[(i, j)]) / scale[j]
            } else {
                own - a[(i, j)] * springs[j]
            }
        });
        let mut solution = Mat::from_fn(count, 1, |i, _| {
            // c_0 + A kappa p - p: what the pushes of pressed points give.
            let pressed = (0..count).filter(|&j| is_pressed[j]);
            let given: f64 = pressed.map(|j| a[(i, j)] * springs[j] * pushed[j]).sum();
            let own = if is_pressed[i] { pushed[i] } else { 0.0 };
            self.unpressed[i] + given - own
        });
        DenseLu::factorize(matrix).solve_in_place(solution.as_mut());
        let mut state = ContactState {
            separations: vec![0.0; count],
            normal_forces: vec![0.0; count],
            stiffnesses: None,
        };
        for i in 0..count {
            if is_pressed[i] {
                let force = solution[(i, 0)] / scale[i];
                state.normal_forces[i] = force;
                state.separations[i] = pushed[i] - self.compliance(i) * force; // c = p - N / k.
            } else {
                state.separations[i] = solution[(i, 0)];
            }
        }
        Ok(state)
    }

    fn whole_displacement(&self, friction_coefficient: f64, state: &ContactState) -> Vec<f64> {
        self.points.displacement((&self.solver, &self.springs), friction_coefficient, state)
    }
}

/// Springs at the points, in proportion to their weights, that together are about as stiff as a node of the bodies.
fn spring_stiffnesses(points: &[Point], stiffness: &Triplets) -> Vec<f64> {
    let diagonal = stiffness.entries.iter().filter(|entry| entry.0 == entry.1);
    let (sum, count) =
        diagonal.fold((0.0, 0_usize), |(sum, count), entry| (sum + entry.2.abs(), count + 1));
    let whole: f64 = points.iter().map(|point| point.weight).sum();
    let total = sum / count.max(1) as f64; // Mean of |K_ii|.
    points.iter().map(|point: &Point| total * point.weight / whole).collect()
}
