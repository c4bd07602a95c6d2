//! The matrices of small motions around steady sliding.

use super::projection::{ProjectedPolynomial, Projection};
use super::turning::turning_of;
use super::{DampingModel, SteadySliding, TangentOptions};
use crate::contact::{ContactStiffness, OppositeShare};
use crate::fem::{
    DofMap, MaterialField, RayleighDamping, Triplets, assemble_extra_damping,
    assemble_geometric_stiffness, assemble_mass, assemble_supports,
};
use crate::linalg::{MatrixPolynomial, SparsityPattern, c64};
use crate::mesh::Mesh;
use std::sync::Arc;

/// Mass, damping and stiffness of small motions around steady sliding, polynomials in `mu`.
///
/// With `q` the displacement from the base state, in nodal frames,
///
/// ```text
/// M q'' + C q' + (K_e + K_sigma) q = dF,
/// dF_n = dN - (T / a) q_t,   dF_t = s mu dN + (N / a) q_t - N mu' q_t'   at each pressed contact node:
/// ```
///
/// with `mu` that at the sliding speed `V` and `mu'` its slope there: where friction falls, the last term feeds the
/// motion. The contact forces `N` and `T = s mu N` of the base state turn with the node on the curved edge (a
/// rigid rotation of everything leaves the edge in balance), and friction follows the normal force. `1 / a` is the
/// curvature of the counterface, negative around the body and zero for a plane. Open nodes are free.
/// Penalty contact has `dN = -w (k_n q_n + c_n q_n')`, `w` the node's tributary length. Rigid contact has
/// `q_n = 0` and unknown `dN`, eliminated by adding `-s mu` times each normal row to its tangential row,
/// in `M`, `C` and `K` alike: the contact force balances inertia and damping too.
///
/// `K_sigma` is a polynomial in `mu` like the base state (affine on the annulus), so every matrix is one too, all
/// on one sparsity pattern. Supports add their springs and dashpots, which `beta_R` does not multiply. Source: Brunetti et al., section 4, which leaves the
/// linearisation to a commercial code; the follower terms and the projection are written out here.
#[derive(Clone, Debug)]
pub struct SlidingTangent {
    /// `M(mu)`, kg/m.
    pub mass: MatrixPolynomial,
    /// `C(mu)`, Pa s.
    pub damping: MatrixPolynomial,
    /// `K_t(mu)`, Pa.
    pub stiffness: MatrixPolynomial,
    /// Coefficients with which `C = alpha_R M + beta_R K_t` exactly; `None` where damping is not
    /// proportional.
    pub proportional: Option<RayleighDamping>,
    /// Which full dofs the unknowns are.
    pub unknowns: DofMap,
    /// Unknown of each contact node's tangential displacement, in the order of the interface.
    pub contact_tangential: Vec<usize>,
    /// Unknown of each contact node's normal displacement; empty for rigid contact.
    pub contact_normal: Vec<usize>,
    /// Unknowns of the opposite body that the contact touches, two for each contact node of an annulus; none on a rigid
    /// counterface.
    pub contact_opposite: Vec<usize>,
    /// Contact normals whose unknown is a distance, with what the opposite body adds to it.
    pub distances: Vec<(usize, Vec<OppositeShare>)>,
    /// Angle of each contact node, rad; empty for a body without rotational symmetry, whose modes have no
    /// circumferential harmonic.
    pub contact_angles: Vec<f64>,
    /// Sense of the friction force `s`.
    pub sliding_direction: f64,
}

impl SlidingTangent {
    /// Displacement of every dof from a vector over the unknowns.
    pub fn displacement(&self, unknowns: &[c64]) -> Vec<c64> {
        let mut full = self.unknowns.expand(unknowns);
        for (normal, shares) in &self.distances {
            for share in shares {
                let moved = full[share.dof] * share.normal;
                full[*normal] += moved;
            }
        }
        full
    }
}

/// Coefficients of one matrix over all dofs, by power of `mu`.
type FullPolynomial = Vec<Triplets>;

impl SlidingTangent {
    /// Linearises around `base`, whose stiffness `K_e` over all dofs is `elastic`.
    pub fn linearize(
        mesh: &Mesh,
        material: &dyn MaterialField,
        elastic: &Triplets,
        base: &SteadySliding,
        options: &TangentOptions,
    ) -> Self {
        let projection = Projection::new(mesh, base, options.contact.normal_stiffness.is_some());
        let to_distances = |mut matrix: Triplets| {
            base.interface.to_distances(&mut matrix);
            matrix
        };
        let mass = vec![to_distances(assemble_mass(mesh, material, options.mass))];

        // What beta_R multiplies: body, prestress, contact.
        let mut stiffness = vec![elastic.clone(), Triplets::default()];
        if options.geometric_stiffness {
            add_prestress(&mut stiffness, mesh, material, base);
        }
        stiffness = stiffness.into_iter().map(to_distances).collect();
        let contact = options.contact;
        if let Some(normal_stiffness) = contact.normal_stiffness {
            add_normal_law(&mut stiffness, base, normal_stiffness);
        }
        let mass = projection.apply(&mass);
        let damped = match options.damping_model {
            DampingModel::WholeTangent => projection.apply(&stiffness),
            DampingModel::BodyOnly => projection.apply(&[to_distances(elastic.clone())]),
        };

        // What it does not: supports, dashpots, regions with damping of their own.
        let [springs, support_dashpots] = assemble_supports(mesh);
        let has_supports = !springs.entries.is_empty() || !support_dashpots.entries.is_empty();
        stiffness[0].entries.extend(to_distances(springs).entries);
        let mut dashpots = contact_dashpots(base, &contact);
        dashpots[0]
            .entries
            .extend(to_distances(support_dashpots).entries);
        let rayleigh = options.damping;
        if let Some(own) = assemble_extra_damping(mesh, material, options.mass, rayleigh) {
            dashpots[0].entries.extend(to_distances(own).entries);
        }
        let has_dashpots = dashpots.iter().any(|terms| !terms.entries.is_empty());
        let stiffness = projection.apply(&stiffness);

        // One pattern for all; C = alpha_R M + beta_R K (2) and the rest.
        let dashpots = projection.apply(&dashpots);
        let pattern = shared_pattern(projection.unknowns.len(), [&mass, &stiffness, &dashpots]);
        let on_pattern =
            |terms: &ProjectedPolynomial| MatrixPolynomial::on_pattern(&pattern, terms);
        let (mass, stiffness) = (on_pattern(&mass), on_pattern(&stiffness));
        let mut damping = MatrixPolynomial::combination(
            rayleigh.mass_coefficient,
            &mass,
            rayleigh.stiffness_coefficient,
            &on_pattern(&damped),
        );
        if has_dashpots {
            damping = MatrixPolynomial::combination(1.0, &damping, 1.0, &on_pattern(&dashpots));
        }
        let is_whole = options.damping_model == DampingModel::WholeTangent && !has_supports;
        let contact_angles = if mesh.is_cyclic {
            base.interface.angles.clone()
        } else {
            Vec::new()
        };
        Self {
            mass,
            damping,
            stiffness,
            proportional: (is_whole && !has_dashpots).then_some(rayleigh),
            contact_tangential: projection.tangential_unknowns(),
            contact_normal: projection.normal_unknowns(),
            contact_opposite: projection.opposite_unknowns(),
            distances: (0..base.interface.opposite.len())
                .map(|i| {
                    let shares = base.interface.opposite_of(i).to_vec();
                    (base.interface.normal_dof(i), shares)
                })
                .collect(),
            contact_angles,
            sliding_direction: base.sliding_direction,
            unknowns: projection.unknowns,
        }
    }
}

/// Geometric stiffness of the base state's stress, and the contact forces that turn with the edge.
fn add_prestress(
    stiffness: &mut FullPolynomial,
    mesh: &Mesh,
    material: &dyn MaterialField,
    base: &SteadySliding,
) {
    let degree = base.displacements.len().max(base.normal_forces.len() + 1);
    stiffness.resize_with(degree.max(stiffness.len()), Triplets::default);
    for (terms, displacement) in stiffness.iter_mut().zip(&base.displacements) {
        let stress = assemble_geometric_stiffness(mesh, material, displacement);
        terms.entries.extend(stress.entries);
    }
    for (power, forces) in base.normal_forces.iter().enumerate() {
        for (i, force) in forces.iter().enumerate() {
            let [pressed, sheared] = turning_of(&base.interface, i);
            for (row, column, value) in pressed {
                stiffness[power].push(row, column, force * value);
            }
            for (row, column, value) in sheared {
                let friction = base.friction.drag * force * value;
                stiffness[power + 1].push(row, column, friction);
            }
        }
    }
}

/// `dN = -w coefficient q_n` at pressed nodes and the friction that follows it, moved to the left-hand side.
fn add_normal_law(terms: &mut FullPolynomial, base: &SteadySliding, coefficient: f64) {
    for (i, length) in pressed_lengths(base) {
        let interface = &base.interface;
        let normal = interface.normal_dof(i);
        let value = coefficient * length;
        terms[0].push(normal, normal, value);
        for (dof, along) in interface.slip(i) {
            terms[1].push(dof, normal, base.friction.drag * along * value);
        }
    }
}

/// Pressed contact nodes with their tributary lengths, m.
fn pressed_lengths(base: &SteadySliding) -> impl Iterator<Item = (usize, f64)> + '_ {
    let lengths = base.interface.tributary_lengths.iter().copied();
    lengths.enumerate().filter(|&(i, _)| base.is_pressed[i])
}

/// Normal and tangential dashpots of the contact, and that of friction which depends on the speed; empty where it has
/// none.
fn contact_dashpots(base: &SteadySliding, contact: &ContactStiffness) -> FullPolynomial {
    let mut terms = vec![Triplets::default(), Triplets::default()];
    if contact.normal_damping != 0.0 {
        add_normal_law(&mut terms, base, contact.normal_damping);
    }
    if contact.tangential_damping != 0.0 {
        for (i, length) in pressed_lengths(base) {
            let value = contact.tangential_damping * length;
            for (row, along) in base.interface.slip(i) {
                for (column, across) in base.interface.slip(i) {
                    terms[0].push(row, column, along * value * across);
                }
            }
        }
    }
    if base.friction.slope != 0.0 {
        terms.resize_with(
            terms.len().max(base.normal_forces.len() + 1),
            Triplets::default,
        );
        for (power, forces) in base.normal_forces.iter().enumerate() {
            for (i, _) in pressed_lengths(base) {
                let value = base.friction.slope * forces[i];
                for (row, along) in base.interface.slip(i) {
                    for (column, across) in base.interface.slip(i) {
                        terms[power + 1].push(row, column, along * value * across);
                    }
                }
            }
        }
    }
    terms
}

/// One pattern that holds all of the given matrices.
fn shared_pattern(dimension: usize, matrices: [&ProjectedPolynomial; 3]) -> Arc<SparsityPattern> {
    let entries = matrices.into_iter().flatten().flatten();
    let positions = entries.map(|&(row, column, _)| (row, column));
    Arc::new(SparsityPattern::from_positions(dimension, positions))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::SlidingContact;
    use crate::fem::{ElasticMaterial, MassKind, PlaneFormulation, assemble_stiffness};
    use crate::mesh::{AnnulusMesh, AnnulusSpecification, BoundaryCondition, ElementKind};

    fn turning(rotation_speed: f64) -> SlidingContact {
        SlidingContact {
            decay: None,
            friction_coefficient: 0.3,
            interference: 25e-6,
            rotation_speed,
        }
    }

    fn disc(element: ElementKind) -> (Mesh, ElasticMaterial) {
        let mesh = AnnulusMesh::generate(&AnnulusSpecification {
            inner_radius: 0.0205,
            outer_radius: 0.0905,
            circumferential_elements: 24,
            radial_elements: 6,
            radial_grading: 1.2,
            element,
            outer: BoundaryCondition::Clamped,
            shaft: None,
        });
        let material = ElasticMaterial {
            young_modulus: 2.5e9,
            poisson_ratio: 0.3805,
            density: 1228.0,
            formulation: PlaneFormulation::PlaneStrain,
        };
        (mesh.unwrap().mesh, material)
    }

    /// Independent check (objectivity): a rigid rotation of everything costs no elastic force, and the
    /// turned stress balances the turned contact forces, for the pressed and for the sheared state.
    #[test]
    fn rigid_rotation_leaves_the_prestressed_edge_in_balance() {
        for element in [ElementKind::Quad4, ElementKind::Quad8] {
            let (mesh, material) = disc(element);
            let elastic = assemble_stiffness(&mesh, &material);
            let base = SteadySliding::solve(&mesh, &elastic, &turning(-60.0)).unwrap();
            let mut prestress = vec![Triplets::default(); 2];
            add_prestress(&mut prestress, &mesh, &material, &base);
            let total = 2 * mesh.node_count();
            let rotation: Vec<f64> = (0..mesh.node_count())
                .flat_map(|node| [0.0, mesh.nodes[node][0].hypot(mesh.nodes[node][1])])
                .collect();
            let free = DofMap::clamped(&mesh);
            for terms in &prestress {
                let force = terms.multiply(total, &rotation);
                let scale = terms
                    .entries
                    .iter()
                    .fold(0.0_f64, |m, &(_, _, value)| m.max(value.abs()));
                for dof in &free.dofs {
                    // Each row sums a dozen terms of size `scale * radius`.
                    assert!(
                        force[*dof].abs() < 1e-11 * scale * 0.0905,
                        "{element:?} {dof}"
                    );
                }
            }
            let elastic_force = elastic.multiply(total, &rotation);
            assert!(elastic_force.iter().all(|f| f.abs() < 1e-6), "{element:?}");
        }
    }

    #[test]
    fn every_matrix_is_symmetric_without_friction() {
        let (mesh, material) = disc(ElementKind::Quad4);
        let elastic = assemble_stiffness(&mesh, &material);
        let base = SteadySliding::solve(&mesh, &elastic, &turning(60.0)).unwrap();
        for normal_stiffness in [None, Some(7.4e12)] {
            let tangent = SlidingTangent::linearize(
                &mesh,
                &material,
                &elastic,
                &base,
                &TangentOptions {
                    mass: MassKind::Consistent,
                    geometric_stiffness: true,
                    damping: RayleighDamping {
                        mass_coefficient: 40.0,
                        stiffness_coefficient: 4.5e-7,
                    },
                    damping_model: DampingModel::WholeTangent,
                    contact: ContactStiffness {
                        normal_stiffness,
                        normal_damping: 0.0,
                        tangential_damping: 3.0,
                        ..ContactStiffness::default()
                    },
                },
            );
            for polynomial in [&tangent.mass, &tangent.damping, &tangent.stiffness] {
                let values = polynomial.evaluate(0.0);
                let pattern = polynomial.pattern();
                let scale = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                for column in 0..pattern.dimension() {
                    let range =
                        pattern.column_pointers()[column]..pattern.column_pointers()[column + 1];
                    for place in range {
                        let row = pattern.row_indices()[place];
                        let mirrored = pattern.position(column, row).map_or(0.0, |p| values[p]);
                        assert!((values[place] - mirrored).abs() <= 1e-12 * scale);
                    }
                }
            }
        }
    }
}
