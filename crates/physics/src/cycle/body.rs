//! The body as the harmonics of a rotating wave see it: a 2 x 2 receptance at the contact edge.

use super::CycleError;
use crate::fem::{
    ElasticMaterial, MassKind, RayleighDamping, Triplets, assemble_mass, assemble_stiffness,
    assemble_supports,
};
use crate::linalg::banded::BandedMatrix;
use crate::linalg::c64;
use crate::mesh::{AnnulusSpecification, BoundaryCondition, ElementKind, Strip};
use nalgebra::Matrix2;

/// Receptance of the contact edge: `(u_r, u_theta) = R (f_r, f_theta)`, m for each N/m.
pub type Receptance = Matrix2<c64>;

/// A rotationally symmetric disc as its limit cycles see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscModel {
    /// The annulus and its mesh.
    pub specification: AnnulusSpecification,
    /// Its material.
    pub material: ElasticMaterial,
    /// Rayleigh coefficients.
    pub damping: RayleighDamping,
}

/// Real 2 x 2 blocks of one circumferential harmonic of the stiffness, outwards from the contact edge.
struct HarmonicStiffness {
    diagonal: Vec<Receptance>,
    /// Coupling of node `i` to node `i + 1`.
    outward: Vec<Receptance>,
}

/// Coefficients of the dynamic stiffness `D = c K + m M` of one temporal harmonic.
///
/// With the velocity symbol `i s` (so that `v = i s u`): `c = 1 + i s beta_R`, `m = -s^2 + i s alpha_R`. For a
/// growing motion `i s` is any complex number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DynamicCoefficients {
    /// Multiplies the dashpots of a support: the rate `lambda`, 1/s.
    pub damping: c64,
    /// Multiplies the springs of a support: 1, or 0 in a derivative.
    pub support: f64,
    /// `c`.
    pub stiffness: c64,
    /// `m`, 1/s2.
    pub mass: c64,
}

impl DynamicCoefficients {
    /// Coefficients for `v = rate u`, `a = rate^2 u`.
    pub fn new(rate: c64, damping: &RayleighDamping) -> Self {
        Self {
            damping: rate,
            support: 1.0,
            stiffness: 1.0 + rate * damping.stiffness_coefficient,
            mass: rate * (rate + damping.mass_coefficient),
        }
    }

    /// Their derivative along a change of the rate and of the damping.
    pub fn derivative(
        rate: c64,
        damping: &RayleighDamping,
        rate_change: c64,
        damping_change: &RayleighDamping,
    ) -> Self {
        Self {
            damping: rate_change,
            support: 0.0,
            stiffness: rate_change * damping.stiffness_coefficient
                + rate * damping_change.stiffness_coefficient, // dc = beta dlambda + lambda dbeta.
            mass: rate_change * (2.0 * rate + damping.mass_coefficient)
                + rate * damping_change.mass_coefficient, // dm = (2 lambda + alpha) dlambda + lambda dalpha.
        }
    }
}

/// The annulus, free at its contact edge, for the harmonics `0, n, 2 n, ...` of a wave.
///
/// The circumferential discretization of the mesh is kept: harmonic `k n` is that of the mesh, aliased above half
/// the number of sectors just as the nodes of the mesh see it. The mass is lumped.
pub struct WaveBody {
    harmonics: Vec<HarmonicStiffness>,
    masses: Vec<f64>,
    /// Springs and dashpots of the outer nodes along `(e_r, e_theta)`; they have no such where they are clamped.
    support: Option<[Receptance; 2]>,
    /// Circumferential harmonic `n` of the wave in the phase `n theta + omega t`: negative for a wave with the rotor.
    pub harmonic: isize,
    /// Number of sectors, each with one contact node.
    pub sector_count: usize,
    /// Nodes on a ray, those that are held with them.
    pub rays: usize,
    /// Radius of the contact edge `a`, m.
    pub radius: f64,
    /// Edge length of one contact node, m.
    pub tributary_length: f64,
    /// Radial frequency of a contact node between fixed neighbours, `sqrt(k / m)`, rad/s.
    pub node_frequency: f64,
}

impl WaveBody {
    /// The body of a mesh for a wave of `harmonic` nodal diameters: entry `k` sees circumferential harmonic `k` of the list given.
    ///
    /// # Errors
    /// [`CycleError::Asked`] for elements other than Quad4; [`CycleError::Mesh`].
    pub fn new(
        specification: &AnnulusSpecification,
        material: &ElasticMaterial,
        circumferential_harmonics: impl IntoIterator<Item = isize>,
        harmonic: isize,
    ) -> Result<Self, CycleError> {
        if specification.element != ElementKind::Quad4 {
            let problem =
                "limit cycles need mesh.element = \"quad4\": a contact edge with equal nodes";
            return Err(CycleError::Asked(problem.to_owned()));
        }
        let strip = Strip::of_annulus(specification)?;
        let stiffness = strip.folded(&assemble_stiffness(&strip.mesh, material));
        let dofs = strip.wave_dofs();
        let mass = assemble_mass(&strip.mesh, material, MassKind::Lumped);
        let mass = dofs.fold(0, 0, &strip.folded(&mass)); // A lumped mass couples no sectors: that of n = 0 serves every n.
        let block = |matrix: Triplets| {
            let mut block = Receptance::zeros();
            matrix.entries.iter().for_each(|&(i, j, value)| block[(i % 2, j % 2)].re = value);
            block
        };
        let support = match specification.outer {
            BoundaryCondition::Support(_) => Some(assemble_supports(&strip.mesh).map(block)),
            _ => None,
        };
        // Neighbours turn the node's own stiffness by `cos(2 pi n / N)`: opposite at n = 0 and N / 2.
        let own = [0, strip.count / 2].map(|n| dofs.fold(n, 0, &stiffness).get(0, 0));
        let node_frequency = (0.5 * (own[0] + own[1]) / mass.get(0, 0)).sqrt();
        let of = |n: isize| dofs.fold(n.rem_euclid(strip.count as isize) as usize, 0, &stiffness);
        let all = circumferential_harmonics.into_iter().map(|n| HarmonicStiffness::new(&of(n)));
        Ok(Self {
            harmonics: all.collect(),
            masses: (0..dofs.count / 2).map(|i| mass.get(2 * i, 2 * i)).collect(),
            support,
            harmonic,
            sector_count: strip.count,
            rays: specification.radial_elements + 1,
            radius: specification.inner_radius,
            tributary_length: strip.mesh.contact_edge().tributary_lengths[0],
            node_frequency,
        })
    }

    /// Dynamic stiffness of the support of node `i`, where it has one.
    fn support_at(&self, i: usize) -> Option<impl Fn(DynamicCoefficients) -> Receptance> {
        let [springs, dashpots] = self.support.filter(|_| i + 1 == self.masses.len())?;
        Some(move |at: DynamicCoefficients| {
            springs * c64::new(at.support, 0.0) + dashpots * at.damping // K_s + lambda C_s.
        })
    }

    /// Number of temporal harmonics held, zero included.
    pub fn harmonic_count(&self) -> usize {
        self.harmonics.len()
    }

    /// Receptance of harmonic `k` and its derivatives along changes of the coefficients.
    pub fn receptance<const N: usize>(
        &self,
        k: usize,
        at: DynamicCoefficients,
        changes: [DynamicCoefficients; N],
    ) -> (Receptance, [Receptance; N]) {
        let (inverses, rates) = self.condensed(k, at, changes);
        (polar(&inverses[0]), rates.map(|rate| polar(&rate)))
    }

    /// `S_i^-1` of every node, the condensation from the clamped edge inwards, `S_i = D_i - U_i S_{i+1}^-1 U_i^T`, `R = S_0^-1`, with
    /// the derivatives of `R`.
    fn condensed<const N: usize>(
        &self,
        k: usize,
        at: DynamicCoefficients,
        changes: [DynamicCoefficients; N],
    ) -> (Vec<Receptance>, [Receptance; N]) {
        let blocks = &self.harmonics[k];
        let mut inverses = vec![Receptance::zeros(); self.masses.len()];
        let mut rates = [Receptance::zeros(); N];
        for i in (0..self.masses.len()).rev() {
            let mass = Receptance::identity() * c64::new(self.masses[i], 0.0);
            let diagonal = blocks.diagonal[i];
            let mut matrix = diagonal * at.stiffness + mass * at.mass; // K_ii (1 + beta i w) + m (alpha i w - w^2), and its derivatives.
            let mut slopes = changes.map(|change| diagonal * change.stiffness + mass * change.mass);
            if let Some(support) = self.support_at(i) {
                matrix += support(at);
                let pairs = slopes.iter_mut().zip(changes);
                pairs.for_each(|(slope, change)| *slope += support(change));
            }
            if let Some(outward) = blocks.outward.get(i) {
                // From the outer edge inwards: S_i = D_i - B_i S_i+1^-1 B_i^T.
                let across = outward * inverses[i + 1] * outward.transpose();
                matrix -= across * (at.stiffness * at.stiffness); // A lumped mass couples no nodes: off the diagonal D is c B.
                for (slope, (change, rate)) in slopes.iter_mut().zip(changes.iter().zip(&rates)) {
                    *slope -= across * (2.0 * at.stiffness * change.stiffness)
                        + outward * rate * outward.transpose() * (at.stiffness * at.stiffness); // d(c^2 B S^-1 B^T), rate = d(S^-1).
                }
            }
            let inverse = inverted(&matrix);
            rates = slopes.map(|slope| -(inverse * slope * inverse)); // d(S^-1) = - S^-1 dS S^-1.
            inverses[i] = inverse;
        }
        (inverses, rates)
    }

    /// Displacement `(u_r, u_theta)` of every free node outwards for a displacement of the contact edge.
    pub fn profile(&self, k: usize, at: DynamicCoefficients, edge: [c64; 2]) -> Vec<[c64; 2]> {
        let blocks = &self.harmonics[k];
        let (inverses, []) = self.condensed(k, at, []);
        // Real basis: u_theta = i w.
        let mut current = nalgebra::Vector2::new(edge[0], -c64::I * edge[1]);
        let mut profile = vec![edge];
        for i in 1..inverses.len() {
            let inward = blocks.outward[i - 1].transpose();
            current = -(inverses[i] * inward * current) * at.stiffness; // u_i = - S_i^-1 B_i-1^T u_i-1.
            profile.push([current[0], c64::I * current[1]]);
        }
        profile
    }

    /// `u^H (alpha_R M + beta_R K) u` of one sector for the displacement of its nodes at harmonic `k`.
    pub fn damping_form(&self, k: usize, damping: &RayleighDamping, profile: &[[c64; 2]]) -> f64 {
        let blocks = &self.harmonics[k];
        let real: Vec<_> =
            profile.iter().map(|u| nalgebra::Vector2::new(u[0], -c64::I * u[1])).collect();
        let mut sum = 0.0;
        for (i, u) in real.iter().enumerate() {
            let force = blocks.diagonal[i] * u;
            sum += damping.stiffness_coefficient * u.dotc(&force).re; // u_i^H beta K_ii u_i.
            sum += damping.mass_coefficient * self.masses[i] * u.norm_squared();
            if let Some([_, dashpots]) = self.support.filter(|_| i + 1 == real.len()) {
                sum += u.dotc(&(dashpots * u)).re;
            }
            if let (Some(outward), Some(next)) = (blocks.outward.get(i), real.get(i + 1)) {
                let force = outward * next; // Both blocks off the diagonal.
                sum += 2.0 * damping.stiffness_coefficient * u.dotc(&force).re;
            }
        }
        sum
    }
}

impl HarmonicStiffness {
    fn new(matrix: &BandedMatrix) -> Self {
        let count = matrix.dimension() / 2;
        let block = |i: usize, j: usize| {
            Matrix2::from_fn(|row, column| matrix.get(2 * i + row, 2 * j + column).into())
        };
        Self {
            diagonal: (0..count).map(|i| block(i, i)).collect(),
            outward: (1..count).map(|i| block(i - 1, i)).collect(),
        }
    }
}

fn inverted(m: &Receptance) -> Receptance {
    let reciprocal = (m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)]).inv();
    Matrix2::new(m[(1, 1)], -m[(0, 1)], -m[(1, 0)], m[(0, 0)]) * reciprocal // adj(m) / det(m).
}

/// From the basis `(u_r, -i u_theta)` to `(u_r, u_theta)`.
fn polar(m: &Receptance) -> Receptance {
    Matrix2::new(m[(0, 0)], -c64::I * m[(0, 1)], c64::I * m[(1, 0)], m[(1, 1)]) // T m T^-1 with T = diag(1, i).
}
