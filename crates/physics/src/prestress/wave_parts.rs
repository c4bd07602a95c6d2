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

use super::wave_terms::RegionTerms;
use super::{DampingModel, WaveTangent};
use crate::fem::RayleighDamping;
use crate::fem::fold::{MirrorParity, SectorMatrix};
use crate::fem::sector::SectorSupport;
use crate::linalg::banded::CompactRows;
use crate::linalg::c64;

/// One region in one harmonic.
struct RegionWave<'a> {
    terms: &'a RegionTerms,
    mass: CompactRows,
    elastic: CompactRows,
    /// `P` and `S` of the geometric stiffness.
    stress: Option<[CompactRows; 2]>,
    damping: RayleighDamping,
}

/// All parts of one harmonic.
pub struct HarmonicParts<'a> {
    regions: Vec<RegionWave<'a>>,
    /// Springs and dashpots, and the loss factor of the springs.
    supports: Vec<([CompactRows; 2], f64)>,
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
    /// What the damping takes, over `|lambda|^2`; a loss factor takes like a dashpot `eta k / omega`.
    pub damping: f64,
}

impl HarmonicParts<'_> {
    /// Forms of each region at an eigenvalue of the wave `+n` and a friction coefficient; the geometric stiffness has a part in the
    /// damping alone.
    pub fn of_regions(&self, root: c64, friction: f64, x: &[c64]) -> Vec<PartForms> {
        let of = |region: &RegionWave<'_>| {
            let [mass, stiffness] = [&region.mass, &region.elastic].map(|a| a.form(x, x).re);
            let ratio = region.terms.ratio(root);
            let stress = region.stress.as_ref().filter(|_| self.stress_damping != 0.0);
            let stress = stress.map_or(0.0, |[pressed, sheared]| {
                let turned = c64::new(0.0, friction) * sheared.form(x, x);
                (pressed.form(x, x) + turned).re
            });
            let RayleighDamping { mass_coefficient: alpha, stiffness_coefficient: beta } =
                region.damping;
            PartForms {
                mass,
                stiffness: ratio.re * stiffness,
                damping: alpha * mass
                    + (beta + ratio.im / root.im) * stiffness
                    + self.stress_damping * stress,
            }
        };
        self.regions.iter().map(of).collect()
    }

    /// Forms of each support.
    pub fn of_supports(&self, root: c64, x: &[c64]) -> Vec<PartForms> {
        let of = |([springs, dashpots], eta): &([CompactRows; 2], f64)| {
            let stiffness = springs.form(x, x).re;
            let damping = dashpots.form(x, x).re + eta * stiffness / root.im.abs();
            PartForms { mass: 0.0, stiffness, damping }
        };
        self.supports.iter().map(of).collect()
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
            let RegionWave { mass, elastic, terms, .. } = region;
            mass.add_product(root * (root + alpha), x, &mut forces);
            elastic.add_product(terms.ratio(root) + root * beta, x, &mut forces);
            if let Some([pressed, sheared]) = &region.stress {
                let factor = one + root * self.stress_damping;
                pressed.add_product(factor, x, &mut forces);
                sheared.add_product(factor * c64::new(0.0, friction), x, &mut forces);
            }
        }
        for ([springs, dashpots], eta) in &self.supports {
            springs.add_product(c64::new(1.0, eta * root.im.signum()), x, &mut forces);
            dashpots.add_product(root, x, &mut forces);
        }
        let work = |unknowns: &Vec<usize>| -> f64 {
            unknowns.iter().map(|&k| (x[k].conj() * forces[k]).im).sum()
        };
        self.contact.iter().map(work).collect()
    }
}

impl WaveTangent {
    /// Names of the supported boundaries.
    pub fn support_names(&self) -> impl Iterator<Item = &str> {
        self.terms.supports.iter().map(|own| own.name.as_str())
    }

    /// All parts in the unknowns of harmonic `n`.
    pub fn parts(&self, n: usize) -> HarmonicParts<'_> {
        let wave = |matrix: &SectorMatrix, parity| {
            CompactRows::new(&self.restricted(self.wave(n, parity, &[matrix])))
        };
        let even = |matrix: &SectorMatrix| wave(matrix, MirrorParity::Even);
        let regions = self.terms.regions.iter().map(|terms| {
            let RegionTerms { mass, elastic, stress: [pressed, sheared], damping, .. } = terms;
            let acts = !pressed.is_empty() || !sheared.is_empty();
            RegionWave {
                terms,
                mass: even(mass),
                elastic: even(elastic),
                stress: acts.then(|| [even(pressed), wave(sheared, MirrorParity::Odd)]),
                damping: damping.unwrap_or(self.options.damping),
            }
        });
        let place = |dof: &usize| self.unknowns().unknown_of[*dof];
        let contact = self.contact.places.iter();
        let support = |own: &SectorSupport| (own.terms.each_ref().map(even), own.loss_factor);
        HarmonicParts {
            regions: regions.collect(),
            supports: self.terms.supports.iter().map(support).collect(),
            contact: contact.map(|dofs| dofs.iter().filter_map(place).collect()).collect(),
            stress_damping: match self.options.damping_model {
                DampingModel::WholeTangent => self.options.damping.stiffness_coefficient,
                DampingModel::BodyOnly => 0.0,
            },
        }
    }
}
