//! Static equilibrium in steady sliding.

use super::PrestressError;
use super::SectorSliding;
use super::cholesky::CholeskySolver;
use super::condensed::CondensedContact;
use super::friction_polynomial::{evaluate, interpolated};
use crate::contact::{ContactInterface, SlidingContact, SteadyFriction};
use crate::fem::{DofMap, Triplets, assemble_supports};
use crate::mesh::{AnnulusMesh, Mesh, SectorMesh};

/// Degree in the friction coefficient of the polynomial that stands for a state which is not affine in it.
const DEGREE: usize = 6;

/// Width to which a friction coefficient is located at which contact nodes open or close.
const CHANGE_WIDTH: f64 = 1e-9;

/// The state of steady sliding: counterface pushed in by `delta`, every pressed contact node slipping.
///
/// The state obeys `u_n = delta - g_i`, `T_i = s mu(V) N_i` at pressed contact nodes, `N_i = T_i = 0` at open ones, the
/// boundary conditions and `K u = f` elsewhere. Under one set of pressed nodes it is a smooth function of `mu`, kept
/// as a polynomial. On the annulus all nodes are pressed and `u(mu) = u_0 + mu u_1` exactly, since the normal forces
/// do not depend on `mu`. The contact is rigid here whatever stiffness the eigenvalue analysis gives it.
///
/// Per metre of thickness; vectors over all dofs in nodal frames.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadySliding {
    /// Displacement `u(mu)` by power of `mu`, m.
    pub displacements: Vec<Vec<f64>>,
    /// Normal force on each contact node `N_i(mu)` by power of `mu`, N/m, in the order of the interface.
    pub normal_forces: Vec<Vec<f64>>,
    /// Whether each contact node is pressed; the others are open.
    pub is_pressed: Vec<bool>,
    /// Sense of the friction force `s`, +1 or -1.
    pub sliding_direction: f64,
    /// Friction at the sliding speed for each unit of friction coefficient and normal force.
    pub friction: SteadyFriction,
    /// The contact edge.
    pub interface: ContactInterface,
}

/// States of steady sliding over a range of friction coefficients.
#[derive(Clone, Debug, Default)]
pub struct SlidingRange {
    /// One state for each set of pressed nodes, in order of the friction coefficient.
    pub states: Vec<SteadySliding>,
    /// Which state each friction coefficient has.
    pub state_of: Vec<usize>,
    /// Friction coefficients at which one state gives way to the next.
    pub changes: Vec<f64>,
}

impl SteadySliding {
    /// Solves the equilibrium of `mesh` at the friction coefficient of `contact`; `stiffness` is that of the body (all
    /// dofs, from [`crate::fem::assemble_stiffness`]), to which supports are added.
    ///
    /// # Errors
    /// [`PrestressError::Separation`] where a node of an annulus would open; see there for the rest.
    pub fn solve(
        mesh: &Mesh,
        stiffness: &Triplets,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        let range = SlidingRange::solve(mesh, stiffness, contact, &[contact.friction_coefficient])?;
        Ok(range
            .states
            .into_iter()
            .next_back()
            .expect("one state for each set"))
    }

    /// Full sliding on the annulus, whose normal forces do not depend on friction.
    fn solve_annulus(
        mesh: &Mesh,
        stiffness: &Triplets,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        let interface = ContactInterface::of(mesh);
        let mut stiffness = stiffness.clone();
        interface.to_distances(&mut stiffness);
        let stiffness = &stiffness;
        let total = 2 * mesh.node_count();
        let contact_range = 0..interface.len();
        let normal_dofs: Vec<usize> = contact_range
            .clone()
            .map(|i| interface.normal_dof(i))
            .collect();
        let unknowns =
            DofMap::excluding(total, mesh.held_dofs().chain(normal_dofs.iter().copied()));
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

        let friction = interface.steady_friction(contact);
        let mut traction = vec![0.0; total];
        for (i, force) in contact_range.zip(&normal_forces) {
            for (dof, along) in interface.slip(i) {
                traction[dof] += friction.drag * along * force;
            }
        }
        let mut sheared = unknowns.expand(&solver.solve(unknowns.restrict(&traction)));
        interface.to_displacements(&mut pressed);
        interface.to_displacements(&mut sheared);
        Ok(Self {
            displacements: vec![pressed, sheared],
            is_pressed: vec![true; normal_forces.len()],
            normal_forces: vec![normal_forces],
            sliding_direction: interface.sliding_direction(contact.rotation_speed),
            friction,
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
        let normal_forces: Vec<f64> = (0..interface.len())
            .map(|i| state.normal_forces[i % sector.contact_count])
            .collect();
        Self {
            displacements: vec![
                repeat(&state.pressed_displacement),
                repeat(&state.sheared_displacement),
            ],
            is_pressed: vec![true; normal_forces.len()],
            normal_forces: vec![normal_forces],
            sliding_direction: state.sliding_direction,
            friction: state.friction,
            interface,
        }
    }

    /// Displacement over all dofs at friction coefficient `friction_coefficient`, m.
    pub fn displacement(&self, friction_coefficient: f64) -> Vec<f64> {
        evaluate(&self.displacements, friction_coefficient)
    }

    /// Normal force on each contact node, N/m.
    pub fn normal_forces(&self, friction_coefficient: f64) -> Vec<f64> {
        evaluate(&self.normal_forces, friction_coefficient)
    }

    /// Contact pressure at each contact node `p_i = N_i / w_i`, Pa.
    pub fn pressures(&self, friction_coefficient: f64) -> Vec<f64> {
        let forces = self.normal_forces(friction_coefficient);
        let pairs = forces.iter().zip(&self.interface.tributary_lengths);
        pairs.map(|(force, length)| force / length).collect()
    }

    /// What friction asks of the counterface's drive for each metre of thickness: the torque `s mu(V) a sum N_i` of a
    /// cylinder, N; the force of a plane, N/m.
    pub fn torque(&self, friction_coefficient: f64) -> f64 {
        let normal: f64 = self.normal_forces(friction_coefficient).iter().sum();
        let lever = self.interface.counterface.lever();
        self.friction.drag * friction_coefficient * lever * normal
    }
}

impl SlidingRange {
    /// States at every one of `friction_coefficients`.
    ///
    /// # Errors
    /// As [`SteadySliding::solve`]; the first friction coefficient without a state.
    pub fn solve(
        mesh: &Mesh,
        stiffness: &Triplets,
        contact: &SlidingContact,
        friction_coefficients: &[f64],
    ) -> Result<Self, PrestressError> {
        let mut supported = stiffness.clone();
        let [springs, _] = assemble_supports(mesh);
        supported.entries.extend(springs.entries);
        if mesh.is_cyclic {
            return Ok(Self {
                states: vec![SteadySliding::solve_annulus(mesh, &supported, contact)?],
                state_of: vec![0; friction_coefficients.len()],
                changes: Vec::new(),
            });
        }
        let interface = ContactInterface::of(mesh);
        let body = CondensedContact::new(mesh, &supported, &interface, contact)?;
        Self::of_body(&body, &interface, contact, friction_coefficients)
    }

    fn of_body(
        body: &CondensedContact<'_>,
        interface: &ContactInterface,
        contact: &SlidingContact,
        friction_coefficients: &[f64],
    ) -> Result<Self, PrestressError> {
        // Rising values, each starting from the set of the last.
        let mut order: Vec<usize> = (0..friction_coefficients.len()).collect();
        order.sort_by(|&a, &b| friction_coefficients[a].total_cmp(&friction_coefficients[b]));
        let mut sets: Vec<(Vec<bool>, f64)> = Vec::new();
        let mut state_of = vec![0; friction_coefficients.len()];
        let mut changes = Vec::new();
        let mut start = vec![true; body.len()];
        for (rank, &i) in order.iter().enumerate() {
            let friction = friction_coefficients[i];
            let set = body.pressed_nodes(friction, &start)?;
            if !set.contains(&true) {
                let distances = body.pushed().iter().map(|pushed| -pushed);
                return Err(PrestressError::GapEverywhere {
                    total: body.len(),
                    distance: distances.fold(f64::INFINITY, f64::min).max(0.0),
                    interference: contact.interference,
                });
            }
            if sets.last().is_none_or(|(last, _)| *last != set) {
                if rank > 0 {
                    let before = friction_coefficients[order[rank - 1]];
                    changes.push(change_between(body, &start, before, friction)?);
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
            polynomial_state(body, interface, contact, set, upper)
        });
        Ok(Self {
            states: states.collect(),
            state_of,
            changes,
        })
    }
}

/// The friction coefficient up to which the set at `low` holds, by bisection.
fn change_between(
    body: &CondensedContact<'_>,
    set: &[bool],
    mut low: f64,
    mut high: f64,
) -> Result<f64, PrestressError> {
    while high - low > CHANGE_WIDTH {
        let middle = 0.5 * (low + high);
        if body.pressed_nodes(middle, set)? == set {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(0.5 * (low + high))
}

/// The state of one set of pressed nodes as a polynomial through Chebyshev points of `[0, upper]`.
fn polynomial_state(
    body: &CondensedContact<'_>,
    interface: &ContactInterface,
    contact: &SlidingContact,
    is_pressed: Vec<bool>,
    upper: f64,
) -> SteadySliding {
    // Without friction the state needs no polynomial, but its tangent is followed from there.
    let upper = upper.max(0.05);
    let points: Vec<f64> = (0..=DEGREE)
        .map(|k| {
            let turn = std::f64::consts::PI * (k as f64 + 0.5) / (DEGREE + 1) as f64;
            0.5 * upper * (1.0 - turn.cos())
        })
        .collect();
    let solved = points.iter().map(|&mu| {
        let state = body.state_of(mu, &is_pressed);
        (
            body.whole_displacement(&state.displacement),
            state.normal_forces,
        )
    });
    let (displacements, normal_forces): (Vec<_>, Vec<_>) = solved.unzip();
    SteadySliding {
        displacements: interpolated(&points, displacements, upper),
        normal_forces: interpolated(&points, normal_forces, upper),
        is_pressed,
        sliding_direction: interface.sliding_direction(contact.rotation_speed),
        friction: interface.steady_friction(contact),
        interface: interface.clone(),
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
