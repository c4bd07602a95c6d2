//! Static equilibrium in full sliding.

use super::SectorSliding;
use crate::contact::{ContactInterface, SlidingContact};
use crate::fem::{DofMap, Triplets, clamped_dofs};
use crate::mesh::{AnnulusMesh, Mesh2d, SectorMesh};
use faer::Side;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};

/// A sliding equilibrium that does not exist or cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PrestressError {
    /// A contact node is pulled, not pressed.
    #[error(
        "contact opens in the base state: {count} of {total} contact nodes are not pressed, first \
         node {node} at {angle_degrees:.3} degrees with {pressure:.6e} Pa; full sliding needs \
         pressure everywhere: raise contact.interference"
    )]
    Separation {
        /// Nodes without pressure.
        count: usize,
        /// Contact nodes.
        total: usize,
        /// First open node, 1-based.
        node: usize,
        /// Its angle, degrees.
        angle_degrees: f64,
        /// Its pressure, Pa.
        pressure: f64,
    },
    /// The stiffness matrix is not positive definite.
    #[error("the stiffness matrix is not positive definite: check [material] and [mesh]")]
    Singular,
    /// Friction changes the contact pressure, so that the state is not affine in `mu`.
    #[error(
        "friction changes the contact pressure by a fraction of {relative:.1e}: this mesh has no \
         mirror symmetry, and its sliding state is not affine in the friction coefficient"
    )]
    PressureDependsOnFriction {
        /// Largest change of a nodal normal force for `mu = 1`, relative to the largest force.
        relative: f64,
    },
}

/// The state of steady sliding: cylinder expanded by `delta`, every contact node slipping.
///
/// The state obeys `u_n = delta`, `T_i = s mu N_i` on the contact edge, `u = 0` on the clamped edge and
/// `K u = f` elsewhere. On a mesh with mirror symmetry the normal forces do not depend on `mu`, so the
/// displacement is affine in it: `u(mu) = u_0 + mu u_1`. The contact is rigid here whatever stiffness the
/// eigenvalue analysis gives it: `delta` is the displacement of the body's edge.
///
/// Per metre of thickness; vectors over all dofs in nodal frames.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadySliding {
    /// Displacement without friction `u_0`, m.
    pub pressed_displacement: Vec<f64>,
    /// Displacement for each unit of friction coefficient `u_1`, m.
    pub sheared_displacement: Vec<f64>,
    /// Normal force on each contact node `N_i`, N/m, in the order of the interface.
    pub normal_forces: Vec<f64>,
    /// Sense of the friction force `s`, +1 or -1.
    pub sliding_direction: f64,
    /// The contact edge.
    pub interface: ContactInterface,
}

impl SteadySliding {
    /// Solves the equilibrium of `mesh` with stiffness `K` (all dofs, from
    /// [`crate::fem::assemble_stiffness`]).
    ///
    /// # Errors
    /// [`PrestressError::Separation`] where a node would open; see there for the rest.
    pub fn solve(
        mesh: &Mesh2d,
        stiffness: &Triplets,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        let interface = ContactInterface::of(mesh);
        let total = 2 * mesh.node_count();
        let contact_range = 0..interface.len();
        let normal_dofs: Vec<usize> = contact_range
            .clone()
            .map(|i| interface.normal_dof(i))
            .collect();
        let unknowns =
            DofMap::excluding(total, clamped_dofs(mesh).chain(normal_dofs.iter().copied()));
        let solver = CholeskySolver::new(stiffness, &unknowns)?;

        let mut pressed = vec![0.0; total];
        for &dof in &normal_dofs {
            pressed[dof] = contact.interference;
        }
        let prescribed = unknowns.restrict(&stiffness.multiply(total, &pressed));
        let response = solver.solve(prescribed.iter().map(|force| -force).collect());
        for (&dof, value) in unknowns.dofs.iter().zip(response) {
            pressed[dof] = value;
        }
        let reaction = stiffness.multiply(total, &pressed);
        let normal_forces: Vec<f64> = normal_dofs.iter().map(|&dof| reaction[dof]).collect();
        check_pressed(&interface, &normal_forces)?;

        let sliding_direction = contact.sliding_direction();
        let mut traction = vec![0.0; total];
        for (i, force) in contact_range.zip(&normal_forces) {
            traction[interface.tangential_dof(i)] = sliding_direction * force;
        }
        let sheared = unknowns.expand(&solver.solve(unknowns.restrict(&traction)));
        let change = stiffness.multiply(total, &sheared);
        check_affine(&normal_dofs, &change, &normal_forces)?;
        Ok(Self {
            pressed_displacement: pressed,
            sheared_displacement: sheared,
            normal_forces,
            sliding_direction,
            interface,
        })
    }

    /// The state of a whole annulus from that of its sector: the same in the polar frames of each.
    pub fn from_sector(annulus: &AnnulusMesh, sector: &SectorMesh, state: &SectorSliding) -> Self {
        let per_sector = annulus.sector_node_count();
        let repeat = |free: &[f64]| {
            let mut values = vec![0.0; 2 * annulus.mesh.node_count()];
            for (sector_node, pair) in free.chunks_exact(2).enumerate() {
                let position = sector.numbering[sector_node];
                for start in (0..annulus.sector_count()).map(|j| j * per_sector) {
                    values[2 * (start + position)..][..2].copy_from_slice(pair);
                }
            }
            values
        };
        let interface = ContactInterface::of(&annulus.mesh);
        Self {
            pressed_displacement: repeat(&state.pressed_displacement),
            sheared_displacement: repeat(&state.sheared_displacement),
            normal_forces: (0..interface.len())
                .map(|i| state.normal_forces[i % sector.contact_count])
                .collect(),
            sliding_direction: state.sliding_direction,
            interface,
        }
    }

    /// Displacement over all dofs at friction coefficient `friction_coefficient`, m.
    pub fn displacement(&self, friction_coefficient: f64) -> Vec<f64> {
        let pairs = self
            .pressed_displacement
            .iter()
            .zip(&self.sheared_displacement);
        pairs
            .map(|(u0, u1)| u0 + friction_coefficient * u1)
            .collect()
    }

    /// Contact pressure at each contact node `p_i = N_i / w_i`, Pa.
    pub fn pressures(&self) -> Vec<f64> {
        let pairs = self
            .normal_forces
            .iter()
            .zip(&self.interface.tributary_lengths);
        pairs.map(|(force, length)| force / length).collect()
    }

    /// Torque of the cylinder on the body for each metre of thickness, `s mu a sum N_i`, N.
    pub fn torque(&self, friction_coefficient: f64) -> f64 {
        let normal: f64 = self.normal_forces.iter().sum();
        self.sliding_direction * friction_coefficient * self.interface.radius * normal
    }
}

fn check_pressed(interface: &ContactInterface, forces: &[f64]) -> Result<(), PrestressError> {
    let is_pressed = |force: f64| force > 0.0;
    let open: Vec<usize> = (0..forces.len())
        .filter(|&i| !is_pressed(forces[i]))
        .collect();
    match open.first() {
        None => Ok(()),
        Some(&i) => Err(PrestressError::Separation {
            count: open.len(),
            total: forces.len(),
            node: interface.nodes[i] as usize + 1,
            angle_degrees: interface.angles[i].to_degrees(),
            pressure: forces[i] / interface.tributary_lengths[i],
        }),
    }
}

/// Round-off of the solution leaves about 1e-12; a mesh without mirror symmetry far more than 1e-8.
fn check_affine(
    normal_dofs: &[usize],
    change: &[f64],
    normal_forces: &[f64],
) -> Result<(), PrestressError> {
    let largest = normal_forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    let worst = normal_dofs
        .iter()
        .fold(0.0_f64, |m, &dof| m.max(change[dof].abs()));
    let relative = worst / largest;
    if relative > 1e-8 {
        return Err(PrestressError::PressureDependsOnFriction { relative });
    }
    Ok(())
}

/// Sparse Cholesky factorization of the stiffness over some unknowns.
struct CholeskySolver {
    factor: faer::sparse::linalg::solvers::Llt<usize, f64>,
}

impl CholeskySolver {
    fn new(stiffness: &Triplets, unknowns: &DofMap) -> Result<Self, PrestressError> {
        let place = |dof: usize| unknowns.unknown_of[dof];
        let triplets: Vec<_> = stiffness
            .entries
            .iter()
            .filter_map(|&(row, column, value)| {
                Some(Triplet::new(place(row)?, place(column)?, value))
            })
            .collect();
        let matrix = SparseColMat::try_new_from_triplets(unknowns.len(), unknowns.len(), &triplets)
            .map_err(|_| PrestressError::Singular)?;
        let factor = matrix
            .sp_cholesky(Side::Lower)
            .map_err(|_| PrestressError::Singular)?;
        Ok(Self { factor })
    }

    fn solve(&self, mut right_side: Vec<f64>) -> Vec<f64> {
        let count = right_side.len();
        let column = faer::MatMut::from_column_major_slice_mut(&mut right_side, count, 1);
        self.factor.solve_in_place(column);
        right_side
    }
}
