//! The matrices of one harmonic part by part: regions, supports, and the nodes of the contact.
//!
//! What a mode's energies and its growth are sums of:
//!
//! ```text
//! M = sum_r M_r,   C = sum_r (alpha_r M_r + beta_r K_r) + sum_s C_s + contact,   K = sum_r (K_r + G_r(mu)) + sum_s K_s + contact
//! ```
//!
//! with `G_r(mu) = P_r + i mu S_r` the geometric stiffness, Hermitian, of which `beta_R` multiplies the whole where the damping
//! is that of the whole tangent. Everything is of one sector, in the unknowns of the harmonic.

use super::sector_terms::stress_stiffness;
use super::{DampingModel, SectorTangent, SolidTangent, TangentOptions, face_conditions};
use crate::fem::RayleighDamping;
use crate::fem::sector::{self, MirrorParity, SectorMatrix};
use crate::fem::solid::{self, SolidMatrix};
use crate::linalg::banded::{BandedMatrix, CompactRows};
use crate::linalg::c64;

/// One region in one harmonic.
struct RegionWave {
    mass: CompactRows,
    elastic: CompactRows,
    /// `P` and `S` of the geometric stiffness.
    stress: Option<[CompactRows; 2]>,
    damping: RayleighDamping,
}

/// All parts of one harmonic.
pub struct HarmonicParts {
    regions: Vec<RegionWave>,
    /// Springs and dashpots.
    supports: Vec<[CompactRows; 2]>,
    /// Unknowns of each contact node, or ring of them, of one sector.
    contact: Vec<Vec<usize>>,
    /// What `beta_R` multiplies of the geometric stiffness.
    stress_damping: f64,
}

/// Quadratic forms of a wave in a region or support: `x^H M x`, `x^H K x`, `x^H C x`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PartForms {
    /// Twice the kinetic energy over `|lambda|^2`; none of a support.
    pub mass: f64,
    /// Twice the strain energy.
    pub stiffness: f64,
    /// What the damping takes, over `|lambda|^2`.
    pub damping: f64,
}

impl HarmonicParts {
    /// Forms of each region at a friction coefficient; the geometric stiffness has a part in the damping alone.
    pub fn of_regions(&self, friction: f64, x: &[c64]) -> Vec<PartForms> {
        let of = |region: &RegionWave| {
            let [mass, stiffness] = [&region.mass, &region.elastic].map(|a| a.form(x, x).re);
            let stress = region.stress.as_ref().filter(|_| self.stress_damping != 0.0);
            let stress = stress.map_or(0.0, |[pressed, sheared]| {
                let turned = c64::new(0.0, friction) * sheared.form(x, x);
                (pressed.form(x, x) + turned).re
            });
            let RayleighDamping { mass_coefficient: alpha, stiffness_coefficient: beta } =
                region.damping;
            PartForms {
                mass,
                stiffness,
                damping: alpha * mass + beta * stiffness + self.stress_damping * stress,
            }
        };
        self.regions.iter().map(of).collect()
    }

    /// Forms of each support.
    pub fn of_supports(&self, x: &[c64]) -> Vec<PartForms> {
        let of = |[springs, dashpots]: &[CompactRows; 2]| PartForms {
            mass: 0.0,
            stiffness: springs.form(x, x).re,
            damping: dashpots.form(x, x).re,
        };
        self.supports.iter().map(of).collect()
    }

    /// Contact nodes, or rings of them, of one sector.
    pub fn contact_count(&self) -> usize {
        self.contact.len()
    }

    /// `M x` of all regions.
    pub fn momentum(&self, x: &[c64]) -> Vec<c64> {
        let mut sum = vec![c64::new(0.0, 0.0); x.len()];
        for region in &self.regions {
            region.mass.add_product(c64::new(1.0, 0.0), x, &mut sum);
        }
        sum
    }

    /// `Im(x_i^H f_i)` of the forces `f = (lambda^2 M + lambda C + K) x` of bodies and supports on each contact node: what the
    /// contact's forces on that node do. `root` is the eigenvalue of the wave `+n`.
    pub fn works_at_contact(&self, root: c64, friction: f64, x: &[c64]) -> Vec<f64> {
        let one = c64::new(1.0, 0.0);
        let mut forces = vec![c64::new(0.0, 0.0); x.len()];
        for region in &self.regions {
            let RayleighDamping { mass_coefficient: alpha, stiffness_coefficient: beta } =
                region.damping;
            let RegionWave { mass, elastic, .. } = region;
            mass.add_product(root * (root + alpha), x, &mut forces);
            elastic.add_product(one + root * beta, x, &mut forces);
            if let Some([pressed, sheared]) = &region.stress {
                let factor = one + root * self.stress_damping;
                pressed.add_product(factor, x, &mut forces);
                sheared.add_product(factor * c64::new(0.0, friction), x, &mut forces);
            }
        }
        for [springs, dashpots] in &self.supports {
            springs.add_product(one, x, &mut forces);
            dashpots.add_product(root, x, &mut forces);
        }
        let work = |unknowns: &Vec<usize>| -> f64 {
            let each = unknowns.iter().map(|&k| (x[k].conj() * forces[k]).im);
            each.sum()
        };
        self.contact.iter().map(work).collect()
    }
}

/// What `beta_R` multiplies of the geometric stiffness.
fn stress_damping(options: &TangentOptions) -> f64 {
    match options.damping_model {
        DampingModel::WholeTangent => options.damping.stiffness_coefficient,
        DampingModel::BodyOnly => 0.0,
    }
}

/// The parts of an annulus on a cylinder, and of its shaft.
pub struct SectorParts<'a> {
    tangent: &'a SectorTangent,
    /// Mass, stiffness and geometric stiffness of each region, with its damping.
    regions: Vec<([SectorMatrix; 2], Option<[SectorMatrix; 2]>, RayleighDamping)>,
    /// Name, springs and dashpots of each supported edge.
    supports: Vec<(String, [SectorMatrix; 2])>,
}

impl<'a> SectorParts<'a> {
    /// Takes the matrices of one sector apart.
    pub fn new(tangent: &'a SectorTangent) -> Self {
        let (sector, options) = (&tangent.sector, &tangent.options);
        let all = tangent.materials.iter().enumerate();
        let regions = all.map(|(region, material)| {
            let own = tangent.of_region(region, material.elastic);
            let matrices =
                [sector::mass(sector, &own, options.mass), sector::stiffness(sector, &own)];
            let stress = tangent.terms.stress.as_ref();
            let stress = stress.map(|_| stress_stiffness(sector, &own, &tangent.base));
            let damping = material.damping.unwrap_or(options.damping);
            (matrices, stress, damping)
        });
        Self { tangent, regions: regions.collect(), supports: sector::each_support(sector) }
    }

    /// Names of the supported edges.
    pub fn support_names(&self) -> impl Iterator<Item = &str> {
        self.supports.iter().map(|(name, _)| name.as_str())
    }

    /// All parts in the unknowns of harmonic `n`.
    pub fn harmonic(&self, n: usize) -> HarmonicParts {
        let unknowns = self.tangent.unknowns();
        let wave = |matrix: &SectorMatrix| {
            CompactRows::new(&self.tangent.wave(matrix, n).restricted_to(&unknowns))
        };
        let regions = self.regions.iter().map(|(matrices, stress, damping)| {
            let [mass, elastic] = matrices.each_ref().map(wave);
            RegionWave {
                mass,
                elastic,
                stress: stress.as_ref().map(|own| own.each_ref().map(wave)),
                damping: *damping,
            }
        });
        let place = |dof: usize| unknowns.binary_search(&dof).ok();
        let sector = &self.tangent.sector;
        let contact = sector.contact_nodes().map(|node| {
            let both = std::iter::once(node).chain(sector.opposite(node));
            both.flat_map(|node| [2 * node, 2 * node + 1]).filter_map(place).collect()
        });
        HarmonicParts {
            regions: regions.collect(),
            supports: self.supports.iter().map(|(_, own)| own.each_ref().map(wave)).collect(),
            contact: contact.collect(),
            stress_damping: stress_damping(&self.tangent.options),
        }
    }
}

/// The parts of a body of revolution.
pub struct SolidParts<'a> {
    tangent: &'a SolidTangent,
    /// Without the forces of the contact that turn with their nodes.
    stress: Option<[SolidMatrix; 2]>,
    /// Name, springs and dashpots of each supported face.
    supports: Vec<(&'static str, [SolidMatrix; 2])>,
}

impl<'a> SolidParts<'a> {
    /// Takes the matrices of one sector apart.
    pub fn new(tangent: &'a SolidTangent) -> Self {
        let (sector, base) = (&tangent.sector, &tangent.base);
        let stiffness = |displacement: &[f64]| {
            solid::geometric_stiffness(sector, &tangent.material, displacement)
        };
        let acts = tangent.options.geometric_stiffness;
        Self {
            stress: acts.then(|| {
                [&base.pressed_displacement, &base.sheared_displacement].map(|u| stiffness(u))
            }),
            supports: face_conditions::each_support(sector),
            tangent,
        }
    }

    /// Names of the supported faces.
    pub fn support_names(&self) -> impl Iterator<Item = &str> {
        self.supports.iter().map(|(name, _)| *name)
    }

    /// All parts in the unknowns of harmonic `n`, the normals of nodes in rigid contact among them.
    pub fn harmonic(&self, n: usize) -> HarmonicParts {
        let tangent = self.tangent;
        let wave = |parity, matrix: &SolidMatrix| -> CompactRows {
            let sum: BandedMatrix = tangent.sum(n, parity, &[matrix]);
            CompactRows::new(&sum)
        };
        let even = |matrix: &SolidMatrix| wave(MirrorParity::Even, matrix);
        let region = RegionWave {
            mass: even(&tangent.terms.mass),
            elastic: even(&tangent.terms.elastic),
            stress: self
                .stress
                .as_ref()
                .map(|[pressed, sheared]| [even(pressed), wave(MirrorParity::Odd, sheared)]),
            damping: tangent.options.damping,
        };
        let supports = self.supports.iter();
        let contact = tangent.sector.rings.iter().map(|ring| {
            let dofs = ring.nodes.iter().flat_map(|&node| [0, 1, 2].map(|c| 3 * node + c));
            dofs.filter_map(|dof| tangent.unknown_of()[dof]).collect()
        });
        HarmonicParts {
            regions: vec![region],
            supports: supports.map(|(_, own)| own.each_ref().map(even)).collect(),
            contact: contact.collect(),
            stress_damping: stress_damping(&tangent.options),
        }
    }
}
