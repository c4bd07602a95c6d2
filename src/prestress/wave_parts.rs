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
use super::{DampingModel, SectorTangent, SolidTangent, WaveTangent, face_conditions};
use crate::fem::fold::{MirrorParity, SectorMatrix};
use crate::fem::{RayleighDamping, sector, solid};
use crate::linalg::banded::CompactRows;
use crate::linalg::c64;
use crate::mesh::{SectorMesh, SolidSector};

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

/// The parts of a body that is solved harmonic by harmonic.
pub struct WaveParts<'a> {
    tangent: &'a WaveTangent,
    /// Mass, stiffness and geometric stiffness of each region, without contact forces that turn with their nodes, and its damping.
    regions: Vec<Region>,
    /// Name, springs and dashpots of each supported boundary.
    supports: Vec<(String, [SectorMatrix; 2])>,
    /// Dofs of each contact node, or ring of them, of one sector.
    contact: Vec<Vec<usize>>,
    /// What `beta_R` multiplies of the geometric stiffness.
    stress_damping: f64,
}

impl<'a> WaveParts<'a> {
    /// Takes the matrices of one sector apart.
    pub fn new(tangent: &'a WaveTangent) -> Self {
        let named = |(name, own): (&str, [SectorMatrix; 2])| (name.to_owned(), own);
        let options = match tangent {
            WaveTangent::Plane(tangent) => &tangent.options,
            WaveTangent::Solid(tangent) => &tangent.options,
        };
        let (regions, supports, contact) = match tangent {
            WaveTangent::Plane(tangent) => (
                regions_of_annulus(tangent),
                sector::each_support(&tangent.sector).into_iter().map(named).collect(),
                dofs_on_edge(&tangent.sector),
            ),
            WaveTangent::Solid(tangent) => (
                vec![region_of_revolution(tangent)],
                face_conditions::each_support(&tangent.sector).into_iter().map(named).collect(),
                dofs_on_face(&tangent.sector),
            ),
        };
        Self {
            tangent,
            regions,
            supports,
            contact,
            stress_damping: match options.damping_model {
                DampingModel::WholeTangent => options.damping.stiffness_coefficient,
                DampingModel::BodyOnly => 0.0,
            },
        }
    }

    /// Names of the supported boundaries.
    pub fn support_names(&self) -> impl Iterator<Item = &str> {
        self.supports.iter().map(|(name, _)| name.as_str())
    }

    /// All parts in the unknowns of harmonic `n`, on a body of revolution the normals of nodes in rigid contact among them.
    pub fn harmonic(&self, n: usize) -> HarmonicParts {
        let unknowns = match self.tangent {
            WaveTangent::Plane(tangent) => tangent.unknowns(),
            WaveTangent::Solid(_) => Vec::new(),
        };
        let wave = |matrix: &SectorMatrix, parity| match self.tangent {
            WaveTangent::Plane(tangent) => {
                let wave = tangent.folded(&[matrix], parity, n);
                CompactRows::new(&wave.restricted_to(&unknowns))
            }
            WaveTangent::Solid(tangent) => {
                CompactRows::new(&tangent.dofs.fold(n, parity, &[matrix]))
            }
        };
        let even = |matrix: &SectorMatrix| wave(matrix, MirrorParity::Even);
        let regions = self.regions.iter().map(|(matrices, stress, damping)| {
            let [mass, elastic] = matrices.each_ref().map(even);
            let stress = stress.as_ref();
            RegionWave {
                mass,
                elastic,
                stress: stress
                    .map(|[pressed, sheared]| [even(pressed), wave(sheared, MirrorParity::Odd)]),
                damping: *damping,
            }
        });
        let place = |dof: &usize| match self.tangent {
            WaveTangent::Plane(_) => unknowns.binary_search(dof).ok(),
            WaveTangent::Solid(tangent) => tangent.unknown_of()[*dof],
        };
        let contact = self.contact.iter();
        HarmonicParts {
            regions: regions.collect(),
            supports: self.supports.iter().map(|(_, own)| own.each_ref().map(even)).collect(),
            contact: contact.map(|dofs| dofs.iter().filter_map(place).collect()).collect(),
            stress_damping: self.stress_damping,
        }
    }
}

/// Matrices of a region, its geometric stiffness where it acts, and its damping.
type Region = ([SectorMatrix; 2], Option<[SectorMatrix; 2]>, RayleighDamping);

/// The annulus, and its shaft.
fn regions_of_annulus(tangent: &SectorTangent) -> Vec<Region> {
    let (sector, options) = (&tangent.sector, &tangent.options);
    let all = tangent.materials.iter().enumerate();
    let regions = all.map(|(region, material)| {
        let own = tangent.of_region(region, material.elastic);
        let matrices = [sector::mass(sector, &own, options.mass), sector::stiffness(sector, &own)];
        let acts = options.geometric_stiffness;
        let stress = acts.then(|| stress_stiffness(sector, &own, &tangent.base));
        (matrices, stress, material.damping.unwrap_or(options.damping))
    });
    regions.collect()
}

fn region_of_revolution(tangent: &SolidTangent) -> Region {
    let matrices = [tangent.terms.mass.clone(), tangent.terms.elastic.clone()];
    let stress = tangent.options.geometric_stiffness.then(|| {
        [&tangent.base.pressed_displacement, &tangent.base.sheared_displacement]
            .map(|u| solid::geometric_stiffness(&tangent.sector, &tangent.material, u))
    });
    (matrices, stress, tangent.options.damping)
}

/// Dofs of each contact node of an annulus, with those of the shaft's node there.
fn dofs_on_edge(sector: &SectorMesh) -> Vec<Vec<usize>> {
    let contact = sector.contact_nodes().map(|node| {
        let both = std::iter::once(node).chain(sector.opposite(node));
        both.flat_map(|node| [2 * node, 2 * node + 1]).collect()
    });
    contact.collect()
}

/// Dofs of each ring of contact nodes.
fn dofs_on_face(sector: &SolidSector) -> Vec<Vec<usize>> {
    let rings = sector.rings.iter();
    rings.map(|ring| ring.nodes.iter().flat_map(|&k| 3 * k..3 * k + 3).collect()).collect()
}
