//! The matrices of small motions around steady sliding of an annulus, harmonic by harmonic.

use super::sector::to_distances;
use super::sector_terms::{
    FrictionPolynomial, Terms, friction_dashpots, multiplied, stress_stiffness, sum, turning,
};
use super::{DampingModel, PrestressError, SectorSliding, TangentOptions};
use crate::contact::SlidingContact;
use crate::fem::fold::{MirrorParity, SectorMatrix, WaveDofs};
use crate::fem::sector;
use crate::fem::{ElasticMaterial, MaterialField, RayleighDamping, RegionMaterial};
use crate::linalg::banded::BandedMatrix;
use crate::mesh::SectorMesh;
use std::ops::Range;

/// Mass, damping and stiffness of one circumferential harmonic.
///
/// Unknowns are `(u_r, -i u_theta)` of each sector node, outwards, without clamped dofs and for rigid
/// contact without the contact normals; on a deformable shaft a contact normal of the annulus is the distance between the
/// two nodes of the pair. All matrices share one shape. The wave of harmonic `-n` sees the
/// complex conjugates.
#[derive(Clone, Debug)]
pub struct HarmonicTangent {
    /// Circumferential harmonic `n >= 0`.
    pub harmonic: usize,
    /// `M_n(mu)`, kg/m.
    pub mass: FrictionPolynomial,
    /// `K_n(mu)`, Pa.
    pub stiffness: FrictionPolynomial,
    /// `C_n(mu)`, Pa s, where damping is not proportional; otherwise `alpha_R M_n + beta_R K_n`.
    pub damping: Option<FrictionPolynomial>,
    /// Dashpots of friction along and across the sliding: `mu` times this is a further part of `C_n`, Pa s.
    pub friction_dashpots: Option<FrictionPolynomial>,
    /// Forms of the mass whose values over that of the mass itself are the shares of kinetic energy of the contact's nodes and of
    /// axial motion; where unknowns are no displacements.
    pub shares: Option<[BandedMatrix; 2]>,
    /// Rayleigh coefficients.
    pub rayleigh: RayleighDamping,
    /// Unknowns that belong to the contact edge, of both bodies.
    pub contact: Range<usize>,
}

/// [`super::SlidingTangent`] of an annulus, from the matrices of one sector.
///
/// The same equations, whose discrete Fourier transform over the sectors is exact: all contact nodes are
/// alike in steady sliding. The size of the annulus in the circumferential direction costs nothing.
#[derive(Clone, Debug)]
pub struct SectorTangent {
    pub(super) sector: SectorMesh,
    /// Of each region: the annulus, then the shaft.
    pub(super) materials: Vec<RegionMaterial>,
    pub(super) options: TangentOptions,
    pub(super) base: SectorSliding,
    pub(super) terms: Terms,
    dofs: WaveDofs,
}

impl SectorTangent {
    /// Finds the steady sliding state of one sector and linearises around it.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist.
    pub fn linearize(
        sector: &SectorMesh,
        material: &dyn MaterialField,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        let regions = 0..sector.strip.regions.len();
        let elastic = sector::stiffness(sector, material);
        let supports = sector::supports(sector);
        let supported = elastic.plus(&supports[0]);
        let law = options.contact.law;
        let base = SectorSliding::solve_with(sector, &supported, contact, law)?;
        let stress = options.geometric_stiffness.then(|| stress_stiffness(sector, material, &base));
        let lengths = sector.tributary_lengths();
        let penalty = options.contact.normal_stiffness;
        let terms = Terms {
            turning: turning(sector, options, &base),
            own_damping: sector::extra_damping(sector, material, options.mass, options.damping),
            stress,
            mass: sector::mass(sector, material, options.mass),
            elastic,
            supports,
            normal_stiffness: match &base.springs {
                Some(springs) => Some(springs.clone()),
                None => penalty.map(|k| lengths.iter().map(|w| k * w).collect()),
            },
            friction_dashpots: friction_dashpots(&base, base.friction.slope),
        };
        Ok(Self {
            sector: sector.clone(),
            dofs: sector::wave_dofs(sector),
            materials: regions
                .map(|region| RegionMaterial {
                    elastic: *material.of(region),
                    damping: material.own_damping(region),
                })
                .collect(),
            options: *options,
            base,
            terms,
        })
    }

    /// The sector it was built from.
    pub fn sector(&self) -> &SectorMesh {
        &self.sector
    }

    /// The steady sliding state.
    pub fn base(&self) -> &SectorSliding {
        &self.base
    }

    /// Number of unknowns of one harmonic.
    pub fn dimension(&self) -> usize {
        self.unknowns().len()
    }

    /// Sector dof of each unknown, ascending.
    pub fn unknowns(&self) -> Vec<usize> {
        let is_rigid = self.terms.normal_stiffness.is_none();
        let contact = self.sector.contact_nodes();
        let is_held =
            |dof: usize| is_rigid && dof.is_multiple_of(2) && contact.contains(&(dof / 2));
        (0..self.dofs.count).filter(|&dof| !is_held(dof)).collect()
    }

    /// Unknowns that belong to contact nodes, those of the shaft included.
    pub(super) fn contact_unknowns(&self) -> Range<usize> {
        let contact = self.sector.contact_nodes();
        let first = self.sector.opposite(contact.start).unwrap_or(contact.start);
        let unknowns = self.unknowns();
        let place = |node: usize| unknowns.partition_point(|&dof| dof < 2 * node);
        place(first)..place(contact.end)
    }

    /// Unknown of each contact node's tangential displacement.
    pub fn tangential_unknowns(&self) -> Vec<usize> {
        let unknowns = self.unknowns();
        let dofs = self.sector.contact_nodes().map(|node| 2 * node + 1);
        dofs.filter_map(|dof| unknowns.iter().position(|&u| u == dof)).collect()
    }

    /// A material of one region, with the damping that the region has of its own, and nothing elsewhere.
    pub(super) fn of_region(&self, own: usize, elastic: ElasticMaterial) -> Vec<RegionMaterial> {
        let nothing = ElasticMaterial { density: 0.0, ..elastic.without_stiffness() };
        let regions = self.materials.iter().enumerate();
        let regions = regions.map(|(region, material)| RegionMaterial {
            elastic: if region == own { elastic } else { nothing },
            damping: material.damping,
        });
        regions.collect()
    }

    /// Rayleigh coefficients.
    pub fn rayleigh(&self) -> RayleighDamping {
        self.options.damping
    }

    /// The largest harmonic, `N_theta / 2`.
    pub fn largest_harmonic(&self) -> usize {
        self.sector.sector_count() / 2
    }

    /// Whether harmonic `n` stands: `+n` and `-n` are one and the same.
    pub fn is_standing(&self, n: usize) -> bool {
        n == 0 || 2 * n == self.sector.sector_count()
    }

    /// Matrices of harmonic `n`.
    pub fn harmonic(&self, n: usize) -> HarmonicTangent {
        HarmonicTangent {
            harmonic: n,
            contact: self.contact_unknowns(),
            shares: None,
            mass: self.mass(n),
            stiffness: self.stiffness(n),
            damping: (!self.is_proportional()).then(|| self.damping(n)),
            friction_dashpots: self.friction_dashpots().map(|c| vec![c]),
            rayleigh: self.options.damping,
        }
    }

    /// `M_n` and `K_n` without friction, real and symmetric.
    pub fn harmonic_at_rest(&self, n: usize) -> [BandedMatrix; 2] {
        let mass = self.wave(&[&self.terms.mass], n);
        let mut stiffness = self.stiffness_at_rest(n);
        let [springs, _] = &self.terms.supports;
        stiffness.add_scaled(1.0, &self.wave(&[springs], n));
        if self.terms.normal_stiffness.is_some() {
            return [mass, stiffness];
        }
        let unknowns = self.unknowns();
        [mass, stiffness].map(|matrix| matrix.restricted_to(&unknowns))
    }

    /// Whether `C = alpha_R M + beta_R K_t` exactly.
    pub fn is_proportional(&self) -> bool {
        let contact = self.options.contact;
        let has_dashpots = contact.normal_damping != 0.0 || contact.tangential_damping != 0.0;
        let is_whole = self.options.damping_model == DampingModel::WholeTangent;
        let [springs, dashpots] = &self.terms.supports;
        let own = [springs, dashpots, &self.terms.own_damping];
        let has_own = own.iter().any(|matrix| !matrix.is_empty());
        let is_steady = self.terms.friction_dashpots.is_none();
        is_whole && is_steady && !has_dashpots && !has_own
    }

    /// Harmonic `n` of a sum of even terms over displacements, with distances across the contact.
    fn wave(&self, terms: &[&SectorMatrix], n: usize) -> BandedMatrix {
        self.folded(terms, MirrorParity::Even, n)
    }

    /// The same of terms of any parity.
    pub(super) fn folded(
        &self,
        terms: &[&SectorMatrix],
        parity: MirrorParity,
        n: usize,
    ) -> BandedMatrix {
        let mut wave = self.dofs.fold(n, parity, terms);
        to_distances(&mut wave, &self.sector);
        wave
    }

    fn mass(&self, n: usize) -> FrictionPolynomial {
        self.project(vec![self.wave(&[&self.terms.mass], n)])
    }

    /// `K_e + K_sigma`, supports, the contact forces that turn with the edge, and the normal law.
    fn stiffness(&self, n: usize) -> FrictionPolynomial {
        let mut full = self.damped_stiffness(n);
        let [springs, _] = &self.terms.supports;
        full[0].add_scaled(1.0, &self.wave(&[springs], n));
        self.project(full)
    }

    /// The stiffness that `beta_R` multiplies: all but the supports; over all free dofs.
    fn damped_stiffness(&self, n: usize) -> FrictionPolynomial {
        let mut full = vec![self.stiffness_at_rest(n), self.dofs.zeros()];
        if let Some([_, sheared]) = &self.terms.stress {
            // Odd parity: the harmonic is i times this, which is what a coefficient of i mu wants.
            full[1].add_scaled(1.0, &self.folded(&[sheared], MirrorParity::Odd, n));
        }
        let mut turning = self.dofs.zeros();
        self.turning_friction(n, &mut turning);
        to_distances(&mut turning, &self.sector);
        full[1].add_scaled(1.0, &turning);
        if let Some(normal_stiffness) = &self.terms.normal_stiffness {
            self.add_friction(&mut full[1], normal_stiffness);
        }
        full
    }

    /// Body, prestress and contact without friction and supports.
    fn stiffness_at_rest(&self, n: usize) -> BandedMatrix {
        let mut stiffness = self.wave(&[&self.terms.elastic], n);
        if let Some([pressed, _]) = &self.terms.stress {
            stiffness.add_scaled(1.0, &self.wave(&[pressed], n));
        }
        let mut turning = self.dofs.zeros();
        self.turning_pressure(n, &mut turning);
        to_distances(&mut turning, &self.sector);
        stiffness.add_scaled(1.0, &turning);
        let values = self.terms.normal_stiffness.iter().flatten();
        for (node, value) in self.sector.contact_nodes().zip(values) {
            stiffness.add(2 * node, 2 * node, *value);
        }
        stiffness
    }

    /// (2), `alpha_R M + beta_R K`, with the options' damping model, and dashpots.
    fn damping(&self, n: usize) -> FrictionPolynomial {
        let (terms, rayleigh) = (&self.terms, self.options.damping);
        let stiffness = match self.options.damping_model {
            DampingModel::WholeTangent => self.project(self.damped_stiffness(n)),
            DampingModel::BodyOnly => self.project(vec![self.wave(&[&self.terms.elastic], n)]),
        };
        let mass = multiplied(self.mass(n), rayleigh.mass_coefficient);
        let stiffness = multiplied(stiffness, rayleigh.stiffness_coefficient);
        let damping = sum(mass, stiffness);
        let contact = self.options.contact;
        let lengths = self.sector.tributary_lengths();
        let [_, supports] = &terms.supports;
        let mut dashpots = vec![self.wave(&[supports, &terms.own_damping], n), self.dofs.zeros()];
        let normal: Vec<f64> = lengths.iter().map(|w| contact.normal_damping * w).collect();
        self.add_friction(&mut dashpots[1], &normal);
        for (i, node) in self.sector.contact_nodes().enumerate() {
            dashpots[0].add(2 * node, 2 * node, normal[i]);
            let value = contact.tangential_damping * lengths[i];
            for (row, along) in self.slip(node) {
                for (column, across) in self.slip(node) {
                    dashpots[0].add(row, column, along * value * across);
                }
            }
        }
        sum(damping, self.project(dashpots))
    }

    /// On the tangential rows alone, whose scaling by `-i` cancels that of the unknown.
    fn friction_dashpots(&self) -> Option<BandedMatrix> {
        let mut dashpots = self.dofs.zeros();
        let values = self.terms.friction_dashpots.as_ref()?;
        for (node, value) in self.sector.contact_nodes().zip(values) {
            for (row, along) in self.slip(node) {
                for (column, across) in self.slip(node) {
                    dashpots.add(row, column, along * value * across);
                }
            }
        }
        if self.terms.normal_stiffness.is_some() {
            return Some(dashpots);
        }
        Some(dashpots.restricted_to(&self.unknowns()))
    }

    /// Friction that follows `dN = -value q_n`, on the left-hand side; a tangential row times `-i` turns
    /// `s mu value` into `-s value (i mu)`.
    fn add_friction(&self, coefficient: &mut BandedMatrix, values: &[f64]) {
        for (node, value) in self.sector.contact_nodes().zip(values) {
            for (row, along) in self.slip(node) {
                coefficient.add(row, 2 * node, -self.base.friction.drag * along * value);
            }
        }
    }

    /// Slip at a contact node as `(dof, coefficient)`.
    fn slip(&self, node: usize) -> impl Iterator<Item = (usize, f64)> {
        let opposite = self.sector.opposite(node);
        std::iter::once((2 * node + 1, 1.0)).chain(opposite.map(|node| (2 * node + 1, -1.0)))
    }

    /// Onto the unknowns; for rigid contact each normal row is added to its tangential row with the
    /// factor `-s mu`, which is `s (i mu)` once the tangential row is multiplied by `-i`.
    fn project(&self, mut full: Vec<BandedMatrix>) -> FrictionPolynomial {
        if self.terms.normal_stiffness.is_none() {
            full.push(self.dofs.zeros());
            for power in (1..full.len()).rev() {
                let (lower, upper) = full.split_at_mut(power);
                for node in self.sector.contact_nodes() {
                    for column in lower[power - 1].columns(2 * node) {
                        let value = lower[power - 1].get(2 * node, column);
                        if value != 0.0 {
                            let value = self.base.friction.drag * value;
                            for (row, along) in self.slip(node) {
                                upper[0].add(row, column, along * value);
                            }
                        }
                    }
                }
            }
            let unknowns = self.unknowns();
            full = full.iter().map(|m| m.restricted_to(&unknowns)).collect();
        }
        let is_zero = |m: &BandedMatrix| m.values().iter().all(|v| *v == 0.0);
        while full.len() > 1 && is_zero(&full[full.len() - 1]) {
            full.pop();
        }
        full
    }
}
