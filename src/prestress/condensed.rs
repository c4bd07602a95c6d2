//! The body as its contact nodes feel it, and the contact state by complementarity.

use super::PrestressError;
use super::cholesky::CholeskySolver;
use crate::contact::{ContactInterface, SlidingContact};
use crate::fem::{DofMap, Triplets};
use crate::linalg::DenseLu;
use crate::linalg::Mat;
use crate::mesh::Mesh;
use std::collections::BTreeMap;

/// Contact dofs whose columns are condensed together.
const BLOCK: usize = 32;

/// Sets of pressed nodes that are tried at one friction coefficient before the state is called missing.
const MAX_SETS: usize = 200;

/// Stiffness condensed onto the contact nodes, `S = K_cc - K_ci K_ii^-1 K_ic`, and what pushes from outside.
///
/// With `u_c` the contact displacements and `g_i - delta` the gap that the pushed-in counterface leaves,
///
/// ```text
/// S u_c = f_c + sum_i N_i (n_i + s mu(V) t_i),   u_n,i >= delta - g_i,   N_i >= 0,   N_i (u_n,i - delta + g_i) = 0
/// ```
///
/// is a linear complementarity problem with a matrix that is not symmetric. Of two bodies the opposite nodes are
/// condensed too; a separation stands in place of the contact node's normal displacement, and `t_i` acts on both sides
/// (see [`ContactInterface::to_distances`]).
pub(super) struct CondensedContact<'a> {
    stiffness: Triplets,
    interface: &'a ContactInterface,
    interior: DofMap,
    solver: CholeskySolver,
    /// Condensed stiffness over `contact`.
    schur: Mat<f64>,
    /// Full dof of each condensed one.
    contact: DofMap,
    /// Load on all dofs, N/m.
    load: Vec<f64>,
    /// Condensed load.
    condensed_load: Vec<f64>,
    /// Condensed dof of each node's normal displacement.
    normals: Vec<usize>,
    /// Condensed dofs but for the normals, each with the nodes whose friction acts on it: the tangential ones in the order
    /// of the nodes, then those of the opposite body.
    sliding: Vec<(usize, Vec<(usize, f64)>)>,
    /// `delta - g_i`, m.
    pushed: Vec<f64>,
    /// `s mu(V) / mu`.
    drag: f64,
}

/// Displacements and normal forces of the contact nodes under one set of pressed nodes.
#[derive(Clone)]
pub(super) struct ContactState {
    /// Displacement of the condensed dofs, m.
    pub displacement: Vec<f64>,
    /// Normal force of each node, N/m.
    pub normal_forces: Vec<f64>,
}

impl<'a> CondensedContact<'a> {
    /// Condenses `stiffness` (all dofs, supports included) onto the nodes of `interface`.
    pub fn new(
        mesh: &Mesh,
        stiffness: &Triplets,
        interface: &'a ContactInterface,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        let total = 2 * mesh.node_count();
        let free = DofMap::clamped(mesh);
        let mut stiffness = stiffness.clone();
        interface.to_distances(&mut stiffness);
        let own = (0..interface.len())
            .flat_map(|i| [interface.normal_dof(i), interface.tangential_dof(i)]);
        let opposite = interface.opposite.iter().flatten().map(|share| share.dof);
        let mut is_contact = vec![false; total];
        own.chain(opposite)
            .filter(|&dof| free.unknown_of[dof].is_some())
            .for_each(|dof| is_contact[dof] = true);
        let contact_map = DofMap::excluding(total, (0..total).filter(|&dof| !is_contact[dof]));
        let is_outside = |dof: &usize| is_contact[*dof] || free.unknown_of[*dof].is_none();
        let interior = DofMap::excluding(total, (0..total).filter(is_outside));
        let place = |dof: usize| contact_map.unknown_of[dof];
        let normals = (0..interface.len()).filter_map(|i| place(interface.normal_dof(i)));
        let sliding = sliding_dofs(interface, &contact_map);
        let mut load = mesh.pressure_forces().unwrap_or_else(|| vec![0.0; total]);
        interface.to_distance_forces(&mut load);
        let mut condensed = Self {
            solver: CholeskySolver::new(&stiffness, &interior)?,
            stiffness,
            interface,
            normals: normals.collect(),
            sliding,
            schur: Mat::zeros(contact_map.len(), contact_map.len()),
            condensed_load: Vec::new(),
            pushed: interface
                .gaps
                .iter()
                .map(|gap| contact.interference - gap)
                .collect(),
            drag: interface.steady_friction(contact).drag,
            interior,
            contact: contact_map,
            load,
        };
        condensed.condense();
        Ok(condensed)
    }

    /// Columns of `S`, a block of unit displacements at a time, and the load that the interior passes on.
    fn condense(&mut self) {
        let (inside, edge) = (&self.interior, &self.contact);
        let coupling: Vec<(usize, usize, f64)> = self
            .stiffness
            .entries
            .iter()
            .filter_map(|&(row, column, value)| {
                Some((inside.unknown_of[row]?, edge.unknown_of[column]?, value))
            })
            .collect();
        let mut schur = Mat::<f64>::zeros(edge.len(), edge.len());
        for &(row, column, value) in &self.stiffness.entries {
            if let (Some(row), Some(column)) = (edge.unknown_of[row], edge.unknown_of[column]) {
                schur[(row, column)] += value;
            }
        }
        for first in (0..edge.len()).step_by(BLOCK) {
            let width = BLOCK.min(edge.len() - first);
            let mut block = Mat::<f64>::zeros(inside.len(), width);
            for &(row, column, value) in &coupling {
                if (first..first + width).contains(&column) {
                    block[(row, column - first)] += value;
                }
            }
            self.solver.solve_block(block.as_mut());
            // K is symmetric: the rows of K_ci are the columns of K_ic.
            for &(row, column, value) in &coupling {
                for j in 0..width {
                    schur[(column, first + j)] -= value * block[(row, j)];
                }
            }
        }
        let inner = self.solver.solve(inside.restrict(&self.load));
        let mut load = edge.restrict(&self.load);
        for &(row, column, value) in &coupling {
            load[column] -= value * inner[row];
        }
        self.schur = schur;
        self.condensed_load = load;
    }

    /// The state in which exactly the nodes of `is_pressed` touch, whatever sign their forces have.
    pub fn state_of(&self, friction_coefficient: f64, is_pressed: &[bool]) -> ContactState {
        let follow = self.drag * friction_coefficient;
        // Unknown: every tangential displacement, and the normal ones of open nodes.
        let mut unknowns: Vec<(usize, &[(usize, f64)])> = Vec::new();
        let mut displacement = vec![0.0; self.contact.len()];
        for (i, &normal) in self.normals.iter().enumerate() {
            if is_pressed[i] {
                displacement[normal] = self.pushed[i];
            } else {
                unknowns.push((normal, &[]));
            }
        }
        let sliding = self.sliding.iter();
        unknowns.extend(sliding.map(|(dof, nodes)| (*dof, nodes.as_slice())));
        // Friction takes `s mu` times the normal row from the tangential row of a pressed node.
        let along = |nodes: &[(usize, f64)], of: &dyn Fn(usize) -> f64| -> f64 {
            let pressed = nodes.iter().filter(|(i, _)| is_pressed[*i]);
            pressed
                .map(|&(i, along)| follow * along * of(self.normals[i]))
                .sum()
        };
        let row = |(row, nodes): (usize, &[(usize, f64)]), column: usize| {
            self.schur[(row, column)] - along(nodes, &|normal| self.schur[(normal, column)])
        };
        let count = unknowns.len();
        let matrix = Mat::from_fn(count, count, |i, j| row(unknowns[i], unknowns[j].0));
        let prescribed = self.forces(&displacement);
        let mut solution = Mat::from_fn(count, 1, |i, _| {
            let (at, nodes) = unknowns[i];
            -(prescribed[at] - along(nodes, &|normal| prescribed[normal]))
        });
        DenseLu::factorize(matrix).solve_in_place(solution.as_mut());
        for (i, &(at, _)) in unknowns.iter().enumerate() {
            displacement[at] = solution[(i, 0)];
        }
        let forces = self.forces(&displacement);
        let pairs = self.normals.iter().zip(is_pressed);
        let normal_forces = pairs.map(|(&normal, &is)| if is { forces[normal] } else { 0.0 });
        ContactState {
            normal_forces: normal_forces.collect(),
            displacement,
        }
    }

    /// `S u_c - f_c`.
    fn forces(&self, displacement: &[f64]) -> Vec<f64> {
        let mut forces: Vec<f64> = self.condensed_load.iter().map(|f| -f).collect();
        for (column, &u) in displacement.iter().enumerate() {
            if u != 0.0 {
                for (row, force) in forces.iter_mut().enumerate() {
                    *force += self.schur[(row, column)] * u;
                }
            }
        }
        forces
    }

    /// The pressed nodes at one friction coefficient, by the primal-dual active set (a semismooth Newton iteration on
    /// the complementarity) from `start`; where that runs in circles, one node at a time.
    pub fn pressed_nodes(
        &self,
        friction_coefficient: f64,
        start: &[bool],
    ) -> Result<Vec<bool>, PrestressError> {
        let mut set = start.to_vec();
        let mut seen: Vec<Vec<bool>> = Vec::new();
        for _ in 0..MAX_SETS {
            let state = self.state_of(friction_coefficient, &set);
            let wrong = self.violations(&state, &set);
            if state.displacement.iter().any(|u| !u.is_finite()) {
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

    /// Pressed nodes that are pulled and open nodes that penetrate, each with how much: a force, or the force of
    /// the node's own stiffness over the penetration.
    fn violations(&self, state: &ContactState, is_pressed: &[bool]) -> Vec<(usize, f64)> {
        let largest = state
            .normal_forces
            .iter()
            .fold(0.0_f64, |m, f| m.max(f.abs()));
        let excess = |i: usize| {
            let normal = self.normals[i];
            if is_pressed[i] {
                -state.normal_forces[i]
            } else {
                (self.pushed[i] - state.displacement[normal]) * self.schur[(normal, normal)]
            }
        };
        // Round-off must not flip a node that just touches.
        let bound = 1e-12 * largest;
        (0..is_pressed.len())
            .map(|i| (i, excess(i)))
            .filter(|&(_, excess)| excess > bound)
            .collect()
    }

    /// Displacement of every dof from that of the contact nodes.
    pub fn whole_displacement(&self, contact: &[f64]) -> Vec<f64> {
        let mut displacement = self.contact.expand(contact);
        let force = self.stiffness.multiply(displacement.len(), &displacement);
        let right: Vec<f64> = self
            .interior
            .dofs
            .iter()
            .map(|&dof| self.load[dof] - force[dof])
            .collect();
        for (&dof, value) in self.interior.dofs.iter().zip(self.solver.solve(right)) {
            displacement[dof] = value;
        }
        self.interface.to_displacements(&mut displacement);
        displacement
    }

    /// Number of contact nodes.
    pub fn len(&self) -> usize {
        self.normals.len()
    }

    /// `delta - g_i` of each node, m.
    pub fn pushed(&self) -> &[f64] {
        &self.pushed
    }
}

/// Condensed dofs that friction acts on or that slide along, each with the contact nodes whose friction acts on it.
fn sliding_dofs(interface: &ContactInterface, contact: &DofMap) -> Vec<(usize, Vec<(usize, f64)>)> {
    let mut place_of: BTreeMap<usize, usize> = BTreeMap::new();
    let mut sliding: Vec<(usize, Vec<(usize, f64)>)> = Vec::new();
    let nodes = 0..interface.len();
    let own = nodes.clone().map(|i| interface.tangential_dof(i));
    let opposite = interface.opposite.iter().flatten().map(|share| share.dof);
    for dof in own.chain(opposite) {
        if let Some(condensed) = contact.unknown_of[dof] {
            place_of.entry(dof).or_insert_with(|| {
                sliding.push((condensed, Vec::new()));
                sliding.len() - 1
            });
        }
    }
    for i in nodes {
        for (dof, along) in interface.slip(i) {
            if let Some(&place) = place_of.get(&dof) {
                sliding[place].1.push((i, along));
            }
        }
    }
    sliding
}
