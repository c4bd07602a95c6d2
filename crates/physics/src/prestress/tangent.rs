//! The matrices of small motions around steady sliding.

use super::elimination::{Elimination, ProjectedPolynomial, RigidFriction};
use super::tabled::{TabledGain, TabledStiffness};
use super::{DampingModel, PrestressError, TangentOptions};
use crate::contact::{ContactStiffness, Point, PressedState, Row, Turning, linearized, turned};
use crate::fem::{
    DofMap, MaterialField, ModulusTable, RayleighDamping, Triplets, assemble_extra_damping,
    assemble_geometric_stiffness, assemble_losses, assemble_mass, assemble_tabled,
};
use crate::linalg::{FrictionWeights, MatrixPolynomial, SparsityPattern, c64};
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
    /// Structural damping `H(mu)`, Pa, whose force is `i H q` at positive frequencies; `None` without.
    pub structural: Option<MatrixPolynomial>,
    /// Parts whose stiffness depends on frequency, at their reference; empty without.
    pub tabled: Vec<TabledStiffness>,
    /// Coefficients with which `C = alpha_R M + beta_R K_t` exactly; `None` where damping is not
    /// proportional.
    pub proportional: Option<RayleighDamping>,
    /// Whether `C(0)` has a skew part: bodies that turn.
    pub is_gyroscopic: bool,
    /// Which full dofs the unknowns are.
    pub unknowns: DofMap,
    /// Unknowns that the contact touches, in the order of the interface; no normal ones of rigid contact.
    pub contact: ContactDofs,
    /// Dofs that are combinations of the unknowns (as full dofs): a contact normal whose unknown is the separation there, a
    /// dof of a tied surface.
    pub distances: Vec<(usize, Row)>,
    /// Friction of rigid contact, point by point.
    pub friction: Vec<RigidFriction>,
}

impl SlidingTangent {
    /// Whether damping is not viscous alone.
    pub fn is_lossy(&self) -> bool {
        self.structural.is_some() || !self.tabled.is_empty()
    }

    /// Displacement of every dof from a vector over the unknowns.
    pub fn displacement(&self, unknowns: &[c64]) -> Vec<c64> {
        let free = self.unknowns.expand(unknowns);
        let mut full = free.clone();
        for (dof, row) in &self.distances {
            full[*dof] = row.iter().map(|&(other, share)| free[other] * share).sum();
        }
        full
    }

    /// The vector `v` over all dofs with `v^T A u = w^T P x` for a matrix `A` of the bodies over all dofs, `P` what it is over
    /// the unknowns at friction `mu`, `x` a vector over these and `u` its displacement: that of `w` less, at each point of rigid
    /// contact, what the normal force does along its slip,
    ///
    /// ```text
    /// v = T w - mu sum_i (slip_i . T w) lift_i
    /// ```
    pub fn left_displacement(&self, unknowns: &[c64], mu: f64) -> Vec<c64> {
        let own = self.displacement(unknowns);
        let mut full = own.clone();
        for point in &self.friction {
            let slip: c64 = point.slip.iter().map(|&(dof, a)| own[dof] * a).sum();
            for &(dof, value) in &point.lift {
                full[dof] -= slip * (mu * value);
            }
        }
        full
    }
}

/// The matrices of the bodies of one model without contact, over all dofs.
#[derive(Clone, Debug)]
pub struct BodyTerms {
    /// Mass.
    pub mass: Triplets,
    /// Elastic stiffness.
    pub elastic: Triplets,
    /// Geometric stiffness of the base state by power of `mu`, with which contact forces turn; `None` without both.
    pub geometric: Option<Vec<Triplets>>,
    /// Springs and dashpots of supports.
    pub supports: [Triplets; 2],
    /// What regions with damping of their own add.
    pub extra_damping: Option<Triplets>,
    /// Structural damping of materials and supports.
    pub structural: Option<Triplets>,
    /// Stiffness, within `elastic`, of parts whose modulus depends on frequency.
    pub tabled: Vec<(Arc<ModulusTable>, Triplets)>,
    /// Stiffness and gyroscopic matrix of regions that turn, which `alpha_R` and `beta_R` do not multiply.
    pub rotation: Option<[Triplets; 2]>,
}

impl BodyTerms {
    /// Those of bodies that neither carry stress nor turn.
    pub fn of(
        (mesh, material): (&Mesh, &dyn MaterialField),
        elastic: Triplets,
        supports: [Triplets; 2],
        options: &TangentOptions,
    ) -> Self {
        Self {
            mass: assemble_mass(mesh, material, options.mass),
            elastic,
            geometric: None,
            supports,
            extra_damping: assemble_extra_damping(mesh, material, options.mass, options.damping),
            structural: assemble_losses(mesh, material),
            tabled: assemble_tabled(mesh, material),
            rotation: None,
        }
    }
}

/// The surfaces of one contact and their state.
#[derive(Clone, Copy, Debug)]
pub struct ContactPart<'a> {
    /// Its points.
    pub points: &'a [Point],
    /// How they turn; not read where nothing turns with the geometric stiffness.
    pub turnings: &'a [Turning],
    /// Which are pressed, with what forces.
    pub state: &'a PressedState,
    /// Place of its first point among those of the state.
    pub first: usize,
    /// Penalty or rigid, and dashpots.
    pub stiffness: ContactStiffness,
    /// Whether each point has a dof of its own, in place of which its separation is an unknown: rigid contact needs it.
    pub has_own_dofs: bool,
}

/// Dofs, or unknowns, that the contact touches, for the harmonic of a mode and its share there.
#[derive(Clone, Debug, Default)]
pub struct ContactDofs {
    /// Along the sliding.
    pub tangential: Vec<usize>,
    /// Along the normals.
    pub normal: Vec<usize>,
    /// Of the opposite body, two for each contact node of an annulus; none on a rigid counterface.
    pub opposite: Vec<usize>,
    /// Angle of each contact node, rad; empty for a body without rotational symmetry, whose modes have no
    /// circumferential harmonic.
    pub angles: Vec<f64>,
    /// Sense of the friction force `s`.
    pub sliding_direction: f64,
}

impl SlidingTangent {
    /// The matrices of `body` and its contacts over what `basis` (held dofs, ties) and rigid contact leave.
    ///
    /// # Errors
    /// [`PrestressError::Overconstrained`] where a rigid contact has no free dof to hold.
    pub fn assemble(
        body: &BodyTerms,
        contacts: &[ContactPart<'_>],
        mut basis: Elimination,
        dofs: ContactDofs,
        options: &TangentOptions,
    ) -> Result<Self, PrestressError> {
        // Separations as unknowns; those of rigid contact vanish, and their forces follow the slip.
        let friction = hold_rigid(contacts, &mut basis)?;
        let unknowns = basis.unknowns();
        let frozen = contacts.iter().map(|part| part.state.frozen_below).fold(0.0, f64::max);
        let projected = |terms: &[Triplets]| -> ProjectedPolynomial {
            basis.project(terms, &unknowns, (&friction, FrictionWeights::frozen_below(frozen)))
        };

        // The terms; what beta_R does not multiply are supports, rotation, regions with damping of their own.
        let [stiffness, dashpots, losses] = tangent_terms(body, contacts);
        let mass = projected(std::slice::from_ref(&body.mass));
        let (stiffness, damped) = with_springs(&stiffness, body, options, &projected);
        let has_supports = body.supports.iter().any(|own| !own.entries.is_empty());
        let has_dashpots = dashpots.iter().any(|terms| !terms.entries.is_empty());

        // One pattern for all; C = alpha_R M + beta_R K (2) and the rest.
        let dashpots = projected(&dashpots);
        let entries = [&mass, &stiffness, &dashpots].into_iter().flatten().flatten();
        let positions = entries.map(|&(row, column, _)| (row, column));
        let pattern = Arc::new(SparsityPattern::from_positions(unknowns.len(), positions));
        let on_pattern = |terms: &ProjectedPolynomial| {
            MatrixPolynomial::on_pattern(&pattern, terms).frozen_below(frozen)
        };
        let (mass, stiffness) = (on_pattern(&mass), on_pattern(&stiffness));
        let damped = damped.map(|own| on_pattern(&own));
        let damped = [&mass, damped.as_ref().unwrap_or(&stiffness)];
        let dashpots = has_dashpots.then(|| on_pattern(&dashpots));
        let damping = damping_matrix(options.damping, damped, dashpots);
        // Its entries are those of the stiffness.
        let structural = (!losses.is_empty()).then(|| on_pattern(&projected(&losses)));
        let tabled = body.tabled.iter().map(|(table, stiffness)| TabledStiffness {
            gain: TabledGain { table: Arc::clone(table), reference_hz: 0.0 },
            stiffness: on_pattern(&projected(std::slice::from_ref(stiffness))),
        });
        let is_viscous = structural.is_none() && body.tabled.is_empty();
        let is_whole = options.damping_model == DampingModel::WholeTangent && !has_supports;
        let is_proportional = is_whole && !has_dashpots && is_viscous;
        Ok(Self {
            mass,
            damping,
            stiffness,
            proportional: is_proportional.then_some(options.damping),
            structural,
            tabled: tabled.collect(),
            is_gyroscopic: body.rotation.is_some(),
            contact: ContactDofs {
                tangential: unknowns.among(&dofs.tangential),
                normal: unknowns.among(&dofs.normal),
                opposite: unknowns.among(&dofs.opposite),
                ..dofs
            },
            distances: basis.combinations().map(|(dof, row)| (dof, row.clone())).collect(),
            friction,
            unknowns,
        })
    }
}

/// `C = alpha_R M + beta_R K` of mass and stiffness, and the dashpots.
fn damping_matrix(
    rayleigh: RayleighDamping,
    [mass, stiffness]: [&MatrixPolynomial; 2],
    dashpots: Option<MatrixPolynomial>,
) -> MatrixPolynomial {
    let (alpha, beta) = (rayleigh.mass_coefficient, rayleigh.stiffness_coefficient);
    let own = MatrixPolynomial::combination(alpha, mass, beta, stiffness);
    match dashpots {
        Some(dashpots) => MatrixPolynomial::combination(1.0, &own, 1.0, &dashpots),
        None => own,
    }
}

/// The stiffness over the unknowns, with the springs of supports and of the rotation, and what `beta_R` multiplies where that is not all
/// of it: body, prestress and contact, or the body alone.
fn with_springs(
    stiffness: &[Triplets],
    body: &BodyTerms,
    options: &TangentOptions,
    projected: &dyn Fn(&[Triplets]) -> ProjectedPolynomial,
) -> (ProjectedPolynomial, Option<ProjectedPolynomial>) {
    let mut stiffness = projected(stiffness);
    let is_unsupported = body.supports[0].entries.is_empty() && body.rotation.is_none();
    let damped = match options.damping_model {
        DampingModel::WholeTangent if is_unsupported => None,
        DampingModel::WholeTangent => Some(stiffness.clone()),
        DampingModel::BodyOnly => Some(projected(std::slice::from_ref(&body.elastic))),
    };
    for [springs, _] in std::iter::once(&body.supports).chain(&body.rotation) {
        let held = projected(std::slice::from_ref(springs));
        stiffness.resize(stiffness.len().max(held.len()), Vec::new());
        stiffness.iter_mut().zip(held).for_each(|(sum, entries)| sum.extend(entries));
    }
    (stiffness, damped)
}

/// Takes separations for unknowns and drops those of rigid contact; the friction of its forces.
fn hold_rigid(
    contacts: &[ContactPart<'_>],
    basis: &mut Elimination,
) -> Result<Vec<RigidFriction>, PrestressError> {
    let mut friction = Vec::new();
    for part in contacts.iter().filter(|part| part.has_own_dofs) {
        let is_rigid = part.stiffness.normal_stiffness.is_none();
        let own = &part.state.is_pressed[part.first..];
        for (point, &is_pressed) in part.points.iter().zip(own) {
            let pivot = basis.require(&point.normal, "contact")?;
            if is_rigid && is_pressed {
                basis.drop_unknown(pivot);
                let drag = point.friction.drag;
                let slip = point.slip.iter().map(|&(dof, along)| (dof, drag * along)).collect();
                friction.push(RigidFriction { lift: point.lift.clone(), slip });
            }
        }
    }
    Ok(friction)
}

/// Stiffness, dashpots and structural damping of body and contacts by power of friction, over all dofs.
fn tangent_terms(body: &BodyTerms, contacts: &[ContactPart<'_>]) -> [Vec<Triplets>; 3] {
    let mut stiffness = vec![body.elastic.clone()];
    let mut dashpots = vec![Triplets::default()];
    let mut losses: Vec<Triplets> = body.structural.iter().cloned().collect();
    add_powers(&mut stiffness, body.geometric.as_deref().unwrap_or_default());
    for part in contacts {
        let state = (part.state, part.first);
        let terms = linearized(part.points, state, &part.stiffness);
        add_powers(&mut stiffness, &terms.stiffness);
        add_powers(&mut dashpots, &terms.dashpots);
        add_powers(&mut losses, &terms.structural);
        if body.geometric.is_some() {
            add_powers(&mut stiffness, &turned(part.points, part.turnings, state));
        }
    }
    stiffness.iter_mut().chain(&mut dashpots).for_each(Triplets::merge);
    for [_, own] in std::iter::once(&body.supports).chain(&body.rotation) {
        add_powers(&mut dashpots, std::slice::from_ref(own));
    }
    add_powers(&mut dashpots, body.extra_damping.as_slice());
    [stiffness, dashpots, losses]
}

/// Adds the coefficients of one polynomial to those of another.
fn add_powers(sum: &mut Vec<Triplets>, terms: &[Triplets]) {
    if sum.len() < terms.len() {
        sum.resize_with(terms.len(), Triplets::default);
    }
    for (sum, terms) in sum.iter_mut().zip(terms) {
        sum.entries.extend_from_slice(&terms.entries);
    }
}

/// Geometric stiffness of the stress of a state by power of `mu - a`, N/m, in the terms of one that is frozen below `a`.
pub(super) fn geometric_stiffness(
    (mesh, material): (&Mesh, &dyn MaterialField),
    state: &PressedState,
) -> Vec<Triplets> {
    let powers = state.displacements.iter();
    let powers = powers.map(|own| assemble_geometric_stiffness(mesh, material, own, None));
    let mut powers: Vec<Triplets> = powers.collect();
    if state.frozen_below > 0.0 && powers.len() > 1 {
        powers.insert(1, Triplets::default());
    }
    powers
}

#[cfg(test)]
mod tests;
