//! The matrices of one harmonic of a body of equal sectors, region by region and support by support.
//!
//! Everything is of one sector, in the unknowns of the harmonic. A term that comes with friction is `i mu` times its
//! matrix, Hermitian as a whole.

use frictionsim_physics::linalg::banded::CompactRows;
use frictionsim_physics::linalg::c64;
use frictionsim_physics::prestress::{Kind, Part, PartForms, Term, WaveTangent};

/// All parts of one harmonic.
pub(super) struct Harmonic<'a> {
    tangent: &'a WaveTangent,
    bodies: Vec<Term<CompactRows>>,
    /// Unknowns of each contact node, or ring of them.
    contact: Vec<Vec<usize>>,
}

/// What friction multiplies a term by.
fn power(term: &Term<CompactRows>, friction: f64) -> c64 {
    if term.power == 0 { c64::ONE } else { c64::new(0.0, friction) }
}

impl<'a> Harmonic<'a> {
    /// That of number `n`.
    pub fn new(tangent: &'a WaveTangent, n: usize) -> Self {
        let contact = tangent.contact_unknowns();
        Self { tangent, bodies: tangent.body_terms(n), contact }
    }

    /// Forms of each region, then of each support, at an eigenvalue of the wave `+n` and a friction coefficient.
    pub fn forms(&self, root: c64, friction: f64, x: &[c64]) -> Vec<PartForms> {
        let mut forms = vec![PartForms::default(); self.tangent.terms.bodies.len()];
        for term in &self.bodies {
            if let Part::Body(body) = term.part {
                let form = power(term, friction) * term.matrix.form(x, x);
                self.tangent.terms.add_form(term, root, form, &mut forms[body]);
            }
        }
        forms
    }

    /// `M x` of all regions.
    pub fn momentum(&self, x: &[c64]) -> Vec<c64> {
        let mut sum = vec![c64::ZERO; x.len()];
        for term in self.bodies.iter().filter(|term| term.kind == Kind::Mass) {
            term.matrix.add_product(c64::ONE, x, &mut sum);
        }
        sum
    }

    /// `Im(x_i^H f_i)` of the forces `f = (lambda^2 M + lambda C + K) x` of bodies and supports on each contact node:
    /// what the contact's forces on that node do. `root` is the eigenvalue of the wave `+n`.
    pub fn works_at_contact(&self, root: c64, friction: f64, x: &[c64]) -> Vec<f64> {
        let mut forces = vec![c64::ZERO; x.len()];
        for term in &self.bodies {
            let factor = self.tangent.terms.dynamic(term, root) * power(term, friction);
            term.matrix.add_product(factor, x, &mut forces);
        }
        let work = |unknowns: &Vec<usize>| -> f64 {
            unknowns.iter().map(|&k| (x[k].conj() * forces[k]).im).sum()
        };
        self.contact.iter().map(work).collect()
    }
}
