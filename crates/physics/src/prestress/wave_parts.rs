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

use super::WaveTangent;
use super::terms::{Kind, Part, PartForms, Term};
use super::wave_terms::WaveTerms;
use crate::fem::fold::{MirrorParity, SectorMatrix};
use crate::linalg::banded::CompactRows;
use crate::linalg::c64;

/// All parts of one harmonic.
pub struct HarmonicParts<'a> {
    terms: &'a WaveTerms,
    /// The terms of regions and supports, with the place of these.
    bodies: Vec<(usize, &'a Term<SectorMatrix>, CompactRows)>,
    /// Unknowns of each contact node, or ring of them, of one sector.
    contact: Vec<Vec<usize>>,
}

/// What friction multiplies a term by.
fn power(term: &Term<SectorMatrix>, friction: f64) -> c64 {
    match term.parity() {
        MirrorParity::Even => c64::new(1.0, 0.0),
        MirrorParity::Odd => c64::new(0.0, friction),
    }
}

impl HarmonicParts<'_> {
    /// Forms of each region, then of each support, at an eigenvalue of the wave `+n` and a friction coefficient; the geometric
    /// stiffness has a part in the damping alone.
    pub fn forms(&self, root: c64, friction: f64, x: &[c64]) -> Vec<PartForms> {
        let mut forms = vec![PartForms::default(); self.terms.bodies.len()];
        for (body, term, matrix) in &self.bodies {
            let form = power(term, friction) * matrix.form(x, x);
            self.terms.add_form(term, root, form, &mut forms[*body]);
        }
        forms
    }

    /// `M x` of all regions.
    pub fn momentum(&self, x: &[c64]) -> Vec<c64> {
        let mut sum = vec![c64::new(0.0, 0.0); x.len()];
        for (.., mass) in self.bodies.iter().filter(|(_, term, _)| term.kind == Kind::Mass) {
            mass.add_product(c64::new(1.0, 0.0), x, &mut sum);
        }
        sum
    }

    /// `Im(x_i^H f_i)` of the forces `f = (lambda^2 M + lambda C + K) x` of bodies and supports on each contact node: what the
    /// contact's forces on that node do. `root` is the eigenvalue of the wave `+n`.
    pub fn works_at_contact(&self, root: c64, friction: f64, x: &[c64]) -> Vec<f64> {
        let mut forces = vec![c64::new(0.0, 0.0); x.len()];
        for (_, term, matrix) in &self.bodies {
            let factor = self.terms.dynamic(term, root) * power(term, friction);
            matrix.add_product(factor, x, &mut forces);
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
        self.terms.others.iter().map(String::as_str)
    }

    /// All parts in the unknowns of harmonic `n`.
    pub fn parts(&self, n: usize) -> HarmonicParts<'_> {
        let bodies = self.terms.all.iter().filter_map(|term| {
            let Part::Body(body) = term.part else {
                return None;
            };
            let is_it = |own: &Term<_>| f64::from(u8::from(std::ptr::eq(own, term)));
            let matrix = self.restricted(self.sum(n, term.parity(), &is_it));
            Some((body, term, CompactRows::new(&matrix)))
        });
        let place = |dof: &usize| self.unknowns.unknown_of[*dof];
        let contact = self.contact.places.iter();
        HarmonicParts {
            terms: &self.terms,
            bodies: bodies.collect(),
            contact: contact.map(|dofs| dofs.iter().filter_map(place).collect()).collect(),
        }
    }
}
