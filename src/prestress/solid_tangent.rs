//! The matrices of small motions around steady sliding of a body of revolution, harmonic by harmonic.

use super::face_conditions::supports;
use super::solid_contact::{ContactTerms, contact_terms};
use super::{DampingModel, PrestressError, SolidHarmonic, SolidSliding, TangentOptions};
use crate::contact::SlidingContact;
use crate::fem::fold::{MirrorParity, SectorMatrix, WaveDofs};
use crate::fem::solid::{self, nodal_matrix};
use crate::fem::{ElasticMaterial, RayleighDamping};
use crate::linalg::banded::BandedMatrix;
use crate::mesh::SolidSector;

/// The tangent of a body of revolution in three dimensions.
///
/// ```text
/// M q'' + (alpha_R M + beta_R K + D + mu A) q' + K q = 0,   K = K_e + K_sigma + K_support + K_turning + contact
/// A = int p_0 / V d d^T dA,   V = |Omega| r
/// ```
///
/// `A` is Coulomb's law as a vector: the friction force opposes the relative velocity, which a motion across the sliding turns.
/// `d` is `e_z` on a cylinder and `e_r` on a face. The contact forces that turn with the node, `N e_theta / r` on a cylinder and
/// `-s mu N e_r / r` on both for each unit of `u_theta`, go with the geometric stiffness: a rigid rotation of everything costs
/// no force.
#[derive(Clone, Debug)]
pub struct SolidTangent {
    pub(super) sector: SolidSector,
    pub(super) material: ElasticMaterial,
    pub(super) options: TangentOptions,
    pub(super) base: SolidSliding,
    pub(super) terms: SolidTerms,
    supports: [SectorMatrix; 2],
    pub(super) dofs: WaveDofs,
}

/// What the matrices are made of.
#[derive(Clone, Debug, Default)]
pub(super) struct SolidTerms {
    pub elastic: SectorMatrix,
    pub mass: SectorMatrix,
    /// Even and odd parts of prestress and turning forces.
    pub stress: [SectorMatrix; 2],
    pub contact: ContactTerms,
}

impl SolidTangent {
    /// Finds the steady sliding state and linearises around it.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist, [`PrestressError::AtRest`] where the rotor does not turn.
    pub fn linearize(
        sector: &SolidSector,
        material: &ElasticMaterial,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        if contact.rotation_speed == 0.0 {
            return Err(PrestressError::AtRest);
        }
        let elastic = solid::stiffness(sector, material);
        let base = SolidSliding::solve_with(sector, &elastic, contact, options.contact.base_law())?;
        let stress = match options.geometric_stiffness {
            true => prestress(sector, material, &base),
            false => Default::default(),
        };
        let terms = SolidTerms {
            mass: solid::mass(sector, material, options.mass),
            contact: contact_terms(&base, sector, &options.contact),
            stress,
            elastic,
        };
        Ok(Self {
            dofs: solid::wave_dofs(sector),
            supports: supports(sector),
            sector: sector.clone(),
            material: *material,
            options: *options,
            terms,
            base,
        })
    }

    /// The sector it was built from.
    pub fn sector(&self) -> &SolidSector {
        &self.sector
    }

    /// The steady sliding state.
    pub fn base(&self) -> &SolidSliding {
        &self.base
    }

    /// Rayleigh coefficients.
    pub fn rayleigh(&self) -> RayleighDamping {
        self.options.damping
    }

    /// Unknown of each dof, `None` for those held.
    pub fn unknown_of(&self) -> &[Option<usize>] {
        &self.dofs.unknown_of
    }

    /// Whether harmonic `n` stands: `+n` and `-n` are one and the same.
    pub fn is_standing(&self, n: usize) -> bool {
        n == 0 || 2 * n == self.sector.sector_count()
    }

    /// `M` and `K` without friction, all unknowns.
    pub fn at_rest(&self, n: usize) -> [BandedMatrix; 2] {
        let terms = &self.terms;
        let stiffness =
            [&terms.elastic, &terms.stress[0], &terms.contact.penalty[0], &self.supports[0]];
        [
            self.dofs.fold(n, MirrorParity::Even, &[&terms.mass]),
            self.dofs.fold(n, MirrorParity::Even, &stiffness),
        ]
    }

    /// All matrices of harmonic `n`.
    pub fn harmonic(&self, n: usize) -> SolidHarmonic {
        let terms = &self.terms;
        let [springs, dashpots] = &self.supports;
        let mass = self.dofs.fold(n, MirrorParity::Even, &[&terms.mass]);
        let mut stiffness = self.stiffness(n);
        let rayleigh = self.options.damping;
        let mut damping = self.damped(&stiffness, n);
        for matrix in &mut damping {
            matrix.scale(rayleigh.stiffness_coefficient);
        }
        damping[0].add_scaled(rayleigh.mass_coefficient, &mass);
        let [even, odd] = &terms.contact.dashpots;
        damping[0].add_scaled(1.0, &self.dofs.fold(n, MirrorParity::Even, &[even]));
        damping[1].add_scaled(1.0, &self.dofs.fold(n, MirrorParity::Odd, &[odd]));
        self.dofs.add(&mut stiffness[0], n, MirrorParity::Even, &[springs]);
        self.dofs.add(&mut damping[0], n, MirrorParity::Even, &[dashpots]);
        let across = &terms.contact.friction_dashpots;
        SolidHarmonic {
            mass,
            stiffness,
            damping,
            across: self.dofs.fold(n, MirrorParity::Even, &[across]),
            rigid: self.rigid(),
        }
    }

    /// Body, prestress and contact, by power of `i mu`.
    fn stiffness(&self, n: usize) -> [BandedMatrix; 2] {
        let terms = &self.terms;
        let [pressed, sheared] = &terms.stress;
        let [normal, friction] = &terms.contact.penalty;
        [
            self.dofs.fold(n, MirrorParity::Even, &[&terms.elastic, pressed, normal]),
            self.dofs.fold(n, MirrorParity::Odd, &[sheared, friction]),
        ]
    }

    /// The part of the stiffness that `beta_R` multiplies.
    fn damped(&self, stiffness: &[BandedMatrix; 2], n: usize) -> [BandedMatrix; 2] {
        match self.options.damping_model {
            DampingModel::WholeTangent => stiffness.clone(),
            DampingModel::BodyOnly => [
                self.dofs.fold(n, MirrorParity::Even, &[&self.terms.elastic]),
                self.dofs.fold(n, MirrorParity::Odd, &[]),
            ],
        }
    }

    /// See [`SolidHarmonic::rigid`].
    pub fn rigid(&self) -> Vec<(usize, Option<usize>, f64)> {
        let face = self.sector.specification.contact.face();
        let nodes = self.rigid_nodes().filter_map(|node| {
            let normal = self.dofs.unknown_of[3 * node + face.normal_component()]?;
            let drag = self.base.friction(self.sector.nodes[node].radius).1.drag;
            Some((normal, self.dofs.unknown_of[3 * node + 1], face.inward_sign() * drag))
        });
        nodes.collect()
    }

    /// Nodes in rigid contact; none on springs. Those of a ring are free to move along the normal, else they would not belong to it.
    fn rigid_nodes(&self) -> impl Iterator<Item = usize> {
        let is_rigid = self.options.contact.normal_stiffness.is_none();
        let nodes = self.base.normal_forces.iter().map(|(node, _)| *node);
        nodes.filter(move |_| is_rigid)
    }
}

/// Geometric stiffness of the pressed and of the sheared state with the contact forces that turn with their nodes.
fn prestress(
    sector: &SolidSector,
    material: &ElasticMaterial,
    base: &SolidSliding,
) -> [SectorMatrix; 2] {
    let [pressed, sheared] = [&base.pressed_displacement, &base.sheared_displacement]
        .map(|displacement| solid::geometric_stiffness(sector, material, displacement));
    let forces = base.normal_forces.iter().map(|&(node, force)| {
        let radius = sector.nodes[node].radius;
        let turning = force / radius;
        (node, [turning, base.friction(radius).1.drag * turning])
    });
    let [turning, dragging] = turning_forces(sector, forces);
    [pressed.plus(&turning), sheared.plus(&dragging)]
}

/// What forces of the contact do that turn with their nodes, from `(node, [N / r, s N mu(V) / (mu r)])`.
fn turning_forces(
    sector: &SolidSector,
    forces: impl Iterator<Item = (usize, [f64; 2])>,
) -> [SectorMatrix; 2] {
    let is_cylinder = sector.specification.contact.face().normal_component() == 0;
    let (mut turning, mut dragging) = (Vec::new(), Vec::new());
    for (node, [force, drag]) in forces {
        if is_cylinder {
            turning.push((node, 1, 1, -force));
        }
        dragging.push((node, 0, 1, drag));
    }
    [nodal_matrix(&turning), nodal_matrix(&dragging)]
}
