//! The matrices of small motions around steady sliding of an annulus, harmonic by harmonic.

use super::{DampingModel, PrestressError, SectorSliding, TangentOptions};
use crate::contact::SlidingContact;
use crate::fem::sector::{self, MirrorParity, SectorMatrix};
use crate::fem::{ElasticMaterial, RayleighDamping};
use crate::linalg::banded::BandedMatrix;
use crate::mesh::SectorMesh;

/// A matrix that depends on the friction coefficient, `P(mu) = sum_p P_p (i mu)^p` with real `P_p`.
pub type FrictionPolynomial = Vec<BandedMatrix>;

/// Mass, damping and stiffness of one circumferential harmonic.
///
/// Unknowns are `(u_r, -i u_theta)` of each sector node, outwards, without clamped dofs and for rigid
/// contact without the contact normals. All matrices share one shape. The wave of harmonic `-n` sees the
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
    /// Dashpots of friction that depends on the speed: `mu` times this is a further, real part of `C_n`, Pa s.
    pub friction_dashpots: Option<BandedMatrix>,
    /// Rayleigh coefficients.
    pub rayleigh: RayleighDamping,
    /// Number of leading unknowns that belong to the contact edge.
    pub contact_count: usize,
}

/// [`super::SlidingTangent`] of an annulus, from the matrices of one sector.
///
/// The same equations, whose discrete Fourier transform over the sectors is exact: all contact nodes are
/// alike in steady sliding. The size of the annulus in the circumferential direction costs nothing.
#[derive(Clone, Debug)]
pub struct SectorTangent {
    pub(super) sector: SectorMesh,
    pub(super) material: ElasticMaterial,
    pub(super) options: TangentOptions,
    pub(super) contact: SlidingContact,
    pub(super) base: SectorSliding,
    pub(super) terms: Terms,
}

/// What the matrices are made of; each term may also be a derivative.
#[derive(Clone, Debug)]
pub(super) struct Terms {
    pub(super) elastic: Option<SectorMatrix>,
    /// Springs and dashpots of the outer edge.
    pub(super) supports: Option<[SectorMatrix; 2]>,
    pub(super) mass: Option<SectorMatrix>,
    /// Stress of the pressed state and, for each unit of friction, of the sheared state.
    pub(super) stress: Option<[SectorMatrix; 2]>,
    /// `N / a` of each contact node, zero without geometric stiffness.
    pub(super) turning: Vec<f64>,
    /// `k_n w` of each contact node; `None` for rigid contact.
    pub(super) normal_stiffness: Option<Vec<f64>>,
    /// `N mu'(V) / mu` of each contact node; `None` where friction does not depend on the speed.
    pub(super) friction_dashpots: Option<Vec<f64>>,
}

impl SectorTangent {
    /// Finds the steady sliding state of one sector and linearises around it.
    ///
    /// # Errors
    /// [`PrestressError`] where that state does not exist.
    pub fn linearize(
        sector: &SectorMesh,
        material: &ElasticMaterial,
        options: &TangentOptions,
        contact: &SlidingContact,
    ) -> Result<Self, PrestressError> {
        let elastic = sector::stiffness(sector, material);
        let supports = sector::supports(sector);
        let supported = sector::supported_stiffness(sector, material);
        let base = SectorSliding::solve(sector, &supported, contact)?;
        let stress = options
            .geometric_stiffness
            .then(|| stress_stiffness(sector, material, &base));
        let lengths = sector.tributary_lengths();
        let penalty = options.contact.normal_stiffness;
        let terms = Terms {
            turning: turning(sector, options, &base),
            stress,
            mass: Some(sector::mass(sector, material, options.mass)),
            elastic: Some(elastic),
            supports,
            normal_stiffness: penalty.map(|k| lengths.iter().map(|w| k * w).collect()),
            friction_dashpots: friction_dashpots(&base, base.friction.slope),
        };
        Ok(Self {
            sector: sector.clone(),
            material: *material,
            options: *options,
            contact: *contact,
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
        let total = 2 * self.sector.free_node_count();
        let is_rigid = self.terms.normal_stiffness.is_none();
        let is_held =
            |dof: usize| is_rigid && dof.is_multiple_of(2) && dof / 2 < self.sector.contact_count;
        (0..total).filter(|&dof| !is_held(dof)).collect()
    }

    /// Number of leading unknowns that belong to contact nodes, which come first in a sector.
    pub(super) fn contact_unknowns(&self) -> usize {
        let components = if self.terms.normal_stiffness.is_none() {
            1
        } else {
            2
        };
        components * self.sector.contact_count
    }

    /// Unknown of each contact node's tangential displacement.
    pub fn tangential_unknowns(&self) -> Vec<usize> {
        let unknowns = self.unknowns();
        let dofs = (0..self.sector.contact_count).map(|node| 2 * node + 1);
        dofs.filter_map(|dof| unknowns.iter().position(|&u| u == dof))
            .collect()
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
        let rayleigh = self.options.damping;
        HarmonicTangent {
            harmonic: n,
            contact_count: self.contact_unknowns(),
            mass: self.mass(&self.terms, n),
            stiffness: self.stiffness(&self.terms, n),
            damping: (!self.is_proportional())
                .then(|| self.damping(&self.terms, rayleigh, true, n)),
            friction_dashpots: self.friction_dashpots(&self.terms),
            rayleigh,
        }
    }

    /// `M_n` and `K_n` without friction, real and symmetric.
    pub fn harmonic_at_rest(&self, n: usize) -> [BandedMatrix; 2] {
        let mass = self.harmonic_of(&self.terms.mass, n);
        let mut stiffness = self.harmonic_of(&self.terms.elastic, n);
        if let Some([springs, _]) = &self.terms.supports {
            stiffness.add_scaled(1.0, &springs.harmonic(n));
        }
        self.add_at_rest(&self.terms, n, &mut stiffness);
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
        let is_steady = self.terms.friction_dashpots.is_none();
        is_whole && is_steady && !has_dashpots && self.terms.supports.is_none()
    }

    fn zero(&self) -> BandedMatrix {
        let half_bandwidth = sector::half_bandwidth(&self.sector);
        BandedMatrix::zeros(2 * self.sector.free_node_count(), half_bandwidth)
    }

    fn harmonic_of(&self, matrix: &Option<SectorMatrix>, n: usize) -> BandedMatrix {
        matrix
            .as_ref()
            .map_or_else(|| self.zero(), |m| m.harmonic(n))
    }

    pub(super) fn mass(&self, terms: &Terms, n: usize) -> FrictionPolynomial {
        self.project(vec![self.harmonic_of(&terms.mass, n)])
    }

    /// `K_e + K_sigma`, supports, the contact forces that turn with the edge, and the normal law.
    pub(super) fn stiffness(&self, terms: &Terms, n: usize) -> FrictionPolynomial {
        let mut full = self.damped_stiffness(terms, n);
        if let Some([springs, _]) = &terms.supports {
            full[0].add_scaled(1.0, &springs.harmonic(n));
        }
        self.project(full)
    }

    /// The stiffness that `beta_R` multiplies: all but the supports; over all free dofs.
    fn damped_stiffness(&self, terms: &Terms, n: usize) -> FrictionPolynomial {
        let mut full = vec![self.harmonic_of(&terms.elastic, n), self.zero()];
        self.add_at_rest(terms, n, &mut full[0]);
        if let Some([_, sheared]) = &terms.stress {
            // Odd parity: the harmonic is i times this, which is what a coefficient of i mu wants.
            full[1].add_scaled(1.0, &sheared.harmonic(n));
        }
        for (node, force) in terms.turning.iter().enumerate() {
            full[1].add(2 * node, 2 * node + 1, self.base.friction.drag * force);
        }
        if let Some(normal_stiffness) = &terms.normal_stiffness {
            self.add_friction(&mut full[1], normal_stiffness);
        }
        full
    }

    /// What prestress and contact add to the elastic stiffness without friction.
    fn add_at_rest(&self, terms: &Terms, n: usize, stiffness: &mut BandedMatrix) {
        if let Some([pressed, _]) = &terms.stress {
            stiffness.add_scaled(1.0, &pressed.harmonic(n));
        }
        for (node, force) in terms.turning.iter().enumerate() {
            stiffness.add(2 * node + 1, 2 * node + 1, -force);
        }
        for (node, value) in terms.normal_stiffness.iter().flatten().enumerate() {
            stiffness.add(2 * node, 2 * node, *value);
        }
    }

    /// `alpha_R M + beta_R K` with the options' damping model; dashpots if `with_dashpots`.
    pub(super) fn damping(
        &self,
        terms: &Terms,
        rayleigh: RayleighDamping,
        with_dashpots: bool,
        n: usize,
    ) -> FrictionPolynomial {
        let stiffness = match self.options.damping_model {
            DampingModel::WholeTangent => self.project(self.damped_stiffness(terms, n)),
            DampingModel::BodyOnly => self.project(vec![self.harmonic_of(&terms.elastic, n)]),
        };
        let mass = multiplied(self.mass(terms, n), rayleigh.mass_coefficient);
        let stiffness = multiplied(stiffness, rayleigh.stiffness_coefficient);
        let damping = sum(mass, stiffness);
        if !with_dashpots {
            return damping;
        }
        let contact = self.options.contact;
        let lengths = self.sector.tributary_lengths();
        let mut dashpots = vec![self.zero(), self.zero()];
        if let Some([_, supports]) = &terms.supports {
            dashpots[0].add_scaled(1.0, &supports.harmonic(n));
        }
        let normal: Vec<f64> = lengths.iter().map(|w| contact.normal_damping * w).collect();
        self.add_friction(&mut dashpots[1], &normal);
        for (node, length) in lengths.iter().enumerate() {
            let (radial, tangential) = (2 * node, 2 * node + 1);
            dashpots[0].add(radial, radial, normal[node]);
            dashpots[0].add(tangential, tangential, contact.tangential_damping * length);
        }
        sum(damping, self.project(dashpots))
    }

    /// On the tangential rows alone, whose scaling by `-i` cancels that of the unknown.
    pub(super) fn friction_dashpots(&self, terms: &Terms) -> Option<BandedMatrix> {
        let mut dashpots = self.zero();
        for (node, value) in terms.friction_dashpots.as_ref()?.iter().enumerate() {
            dashpots.add(2 * node + 1, 2 * node + 1, *value);
        }
        if self.terms.normal_stiffness.is_some() {
            return Some(dashpots);
        }
        Some(dashpots.restricted_to(&self.unknowns()))
    }

    /// Friction that follows `dN = -value q_n`, on the left-hand side; a tangential row times `-i` turns
    /// `s mu value` into `-s value (i mu)`.
    fn add_friction(&self, coefficient: &mut BandedMatrix, values: &[f64]) {
        for (node, value) in values.iter().enumerate() {
            coefficient.add(2 * node + 1, 2 * node, -self.base.friction.drag * value);
        }
    }

    /// Onto the unknowns; for rigid contact each normal row is added to its tangential row with the
    /// factor `-s mu`, which is `s (i mu)` once the tangential row is multiplied by `-i`.
    fn project(&self, mut full: Vec<BandedMatrix>) -> FrictionPolynomial {
        if self.terms.normal_stiffness.is_none() {
            full.push(self.zero());
            for power in (1..full.len()).rev() {
                let (lower, upper) = full.split_at_mut(power);
                for node in 0..self.sector.contact_count {
                    let (normal, tangential) = (2 * node, 2 * node + 1);
                    for column in lower[power - 1].columns(normal) {
                        let value = lower[power - 1].get(normal, column);
                        if value != 0.0 {
                            let value = self.base.friction.drag * value;
                            upper[0].add(tangential, column, value);
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

/// `N` of each contact node times `slope`; `None` without one.
pub(super) fn friction_dashpots(base: &SectorSliding, slope: f64) -> Option<Vec<f64>> {
    let forces = base.normal_forces.iter().map(|force| slope * force);
    (slope != 0.0).then(|| forces.collect())
}

/// Geometric stiffness of the pressed and of the sheared state.
pub(super) fn stress_stiffness(
    sector: &SectorMesh,
    material: &ElasticMaterial,
    base: &SectorSliding,
) -> [SectorMatrix; 2] {
    let of = |displacement: &[f64], parity| {
        sector::geometric_stiffness(sector, material, displacement, parity)
    };
    [
        of(&base.pressed_displacement, MirrorParity::Even),
        of(&base.sheared_displacement, MirrorParity::Odd),
    ]
}

/// `N / a` of each contact node, zero where the prestress does not act back.
pub(super) fn turning(
    sector: &SectorMesh,
    options: &TangentOptions,
    base: &SectorSliding,
) -> Vec<f64> {
    let radius = sector.specification.inner_radius;
    let factor = if options.geometric_stiffness {
        1.0
    } else {
        0.0
    };
    base.normal_forces
        .iter()
        .map(|force| factor * force / radius)
        .collect()
}

fn multiplied(mut polynomial: FrictionPolynomial, factor: f64) -> FrictionPolynomial {
    for coefficient in &mut polynomial {
        coefficient.scale(factor);
    }
    polynomial
}

pub(super) fn sum(mut a: FrictionPolynomial, b: FrictionPolynomial) -> FrictionPolynomial {
    for (power, term) in b.into_iter().enumerate() {
        match a.get_mut(power) {
            Some(total) => total.add_scaled(1.0, &term),
            None => a.push(term),
        }
    }
    a
}
