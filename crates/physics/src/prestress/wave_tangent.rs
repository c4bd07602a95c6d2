//! The small motions around steady sliding of a body of equal sectors, harmonic by harmonic, from the terms of one sector.

use super::terms::{Kind, Part, Term, Terms, of_kind};
use super::{FrictionPolynomial, HarmonicTangent, RigidFriction, TabledGain, TangentOptions};
use crate::contact::Row;
use crate::fem::ModulusTable;
use crate::fem::fold::{SectorMatrix, WaveDofs};
use crate::linalg::banded::BandedMatrix;
use crate::linalg::c64;
use std::collections::BTreeSet;

/// [`super::SlidingTangent`] of a body of equal sectors that are their own mirror images, from the matrices of one of them.
///
/// ```text
/// M q'' + (alpha_R M + beta_R K + D + mu A) q' + K q = 0,   K = K_e + K_sigma + K_support + K_turning + contact
/// A = int p_0 / V d d^T dA,   V = |Omega| r
/// ```
///
/// The same equations, whose discrete Fourier transform over the sectors is exact: all sectors are alike in steady sliding, and
/// the size of the body in the circumferential direction costs nothing. In three dimensions `A` is Coulomb's law as a vector: the
/// friction force opposes the relative velocity, which a motion across the sliding turns; `d` is `e_z` on a cylinder and `e_r` on
/// a face. Where friction falls with the speed `A` acts along the sliding too. The contact forces that turn with the node go with
/// the geometric stiffness: a rigid rotation of everything costs no force.
///
/// In rigid contact a pressed node has the force `N` along `n + s mu t`, which does no work on virtual motions
///
/// ```text
/// v_t t - s mu v_t n:   (row of t) - s mu (row of n) = 0,   rows of lambda^2 M + lambda (C + mu A) + K
/// ```
///
/// Whatever loads the normal equation takes part, for `N` balances it. So do the dashpots `mu A`: on bricks of 20 nodes the
/// traction of one point acts on nodes at other angles, whose normals it has a part along, and that part comes back times
/// `s mu`: a term of `mu^2`. (Nodes that carry the traction lumped, those of 8-node bricks and of the plane, have none.)
#[derive(Clone, Debug)]
pub struct WaveTangent {
    /// Components of a displacement: 2 in the plane, 3 in space.
    pub components: usize,
    /// Angle of each node of a sector, in halves of a sector.
    pub halves: Vec<usize>,
    /// Sense of the friction force, +1 or -1.
    pub sliding_direction: f64,
    /// Choices of the linearisation.
    pub options: TangentOptions,
    /// The matrices of one sector, by power of the friction coefficient.
    pub terms: Terms<Vec<SectorMatrix>>,
    /// The contact of one sector.
    pub contact: WaveContact,
    /// Dofs that move, the unknowns of a harmonic: all that nothing holds but the normals in rigid contact.
    pub dofs: WaveDofs,
}

/// The contact of one sector, by its dofs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WaveContact {
    /// Dofs of each contact node, or ring of them, the other body's behind its own.
    pub places: Vec<Vec<usize>>,
    /// Whether each of these is pressed.
    pub is_pressed: Vec<bool>,
    /// Dofs of pressed nodes, along the sliding, in space across it, and along the normal.
    pub pressed: Vec<usize>,
    /// Rows of the distances of two bodies, unknowns in place of the normal dofs of the first.
    pub distances: Vec<Row>,
    /// Friction of rigid contact.
    pub rigid: Vec<RigidFriction>,
}

impl WaveTangent {
    /// The largest harmonic, half the number of sectors.
    pub fn largest_harmonic(&self) -> usize {
        self.dofs.sectors / 2
    }

    /// Whether harmonic `n` stands: `+n` and `-n` are one and the same.
    pub fn is_standing(&self, n: usize) -> bool {
        n == 0 || 2 * n == self.dofs.sectors // The shift from sector to sector is real: 1 or -1.
    }

    /// Dofs of a sector at which a force can act and a displacement be observed: a distance between two bodies is no such place.
    pub fn places(&self) -> WaveDofs {
        let mut dofs = self.dofs.clone();
        self.contact.distances.iter().for_each(|row| dofs.unknown_of[row[0].0] = None); // A distance stands there.
        dofs
    }

    /// Displacement of each dof of a sector from the unknowns of a wave.
    pub fn displacement(&self, x: &[c64]) -> Vec<c64> {
        let unknowns = self.dofs.unknown_of.iter();
        let mut all: Vec<c64> = unknowns.map(|own| own.map_or(c64::ZERO, |k| x[k])).collect();
        for row in &self.contact.distances {
            // A distance d = u_1 - u_2 stands in place of u_1: u_1 = d + u_2.
            let apart: c64 = row[1..].iter().map(|&(dof, along)| all[dof] * along).sum();
            all[row[0].0] -= apart;
        }
        all
    }

    /// Unknowns of motion across the sliding at contact nodes, ascending; none in the plane.
    pub fn sideways_unknowns(&self) -> Vec<usize> {
        let across = self.contact.pressed.get(1).filter(|_| self.components == 3);
        let component = across.map(|dof| dof % 3);
        let dofs = self.contact.places.iter().flatten();
        self.ascending(dofs.copied().filter(|dof| Some(dof % self.components) == component))
    }

    /// Unknown of the tangential displacement of each contact node.
    pub fn tangential_unknowns(&self) -> Vec<usize> {
        self.unknowns(self.contact.places.iter().map(|dofs| dofs[1]))
    }

    /// Unknowns along and across the sliding and along the normal of pressed nodes.
    pub fn pressed_unknowns(&self) -> Vec<usize> {
        self.unknowns(self.contact.pressed.iter().copied())
    }

    /// Unknowns of each contact node, or ring of them, of one sector.
    pub fn contact_unknowns(&self) -> Vec<Vec<usize>> {
        let contact = self.contact.places.iter();
        contact.map(|dofs| self.unknowns(dofs.iter().copied())).collect()
    }

    /// The terms of regions and supports in the unknowns of harmonic `n`; those of power one come with `i mu`.
    pub fn body_terms(&self, n: usize) -> Vec<Term<BandedMatrix>> {
        let bodies = self.terms.all.iter().filter(|own| matches!(own.part, Part::Body(_)));
        let folded = bodies.map(|term| {
            // Of all copies, each turned by 2 pi n / N.
            term.with(self.dofs.fold(n, term.power, &term.matrix[term.power]))
        });
        folded.collect()
    }

    fn unknowns(&self, dofs: impl Iterator<Item = usize>) -> Vec<usize> {
        dofs.filter_map(|dof| self.dofs.unknown_of[dof]).collect()
    }

    fn ascending(&self, dofs: impl Iterator<Item = usize>) -> Vec<usize> {
        let unknowns: BTreeSet<usize> = self.unknowns(dofs).into_iter().collect();
        unknowns.into_iter().collect()
    }

    /// Moduli over frequency of regions.
    pub fn tables(&self) -> impl Iterator<Item = &TabledGain> {
        self.terms.bodies.iter().filter_map(|region| region.table.as_ref())
    }

    /// The same with the real stiffness of tables at other frequencies, Hz.
    pub fn referred_to(&self, frequency_hz: impl Fn(&ModulusTable) -> f64) -> Self {
        let mut other = self.clone();
        let tables = other.terms.bodies.iter_mut().filter_map(|region| region.table.as_mut());
        tables.for_each(|own| own.reference_hz = frequency_hz(&own.table));
        other
    }

    /// Matrices of harmonic `n`.
    pub fn harmonic(&self, n: usize) -> HarmonicTangent {
        let of_kind = |kind: Kind| self.polynomial(n, of_kind(kind));
        // Dashpots of friction stand by themselves.
        let damping = |term: &Term<_>| match term.kind {
            Kind::FrictionDashpots => 0.0,
            _ => self.terms.factors(term)[1],
        };
        let mut kinds = self.terms.all.iter().map(|term| term.kind);
        let has_dashpots = kinds.any(|kind| kind == Kind::FrictionDashpots);
        let is_proportional = self.terms.is_proportional(&self.options);
        // Rows of the mass.
        let (mass, all) = (of_kind(Kind::Mass), 0..self.dofs.unknown_of.len());
        let share = |unknowns: Vec<usize>| {
            let mut own = self.dofs.zeros();
            for row in unknowns {
                let columns = mass[0].columns(row);
                columns.for_each(|column| own.add(row, column, mass[0].get(row, column)));
            }
            own
        };
        let contact = self.ascending(self.contact.places.iter().flatten().copied());
        let axial = self.ascending(all.filter(|dof| dof % self.components == 2));
        HarmonicTangent {
            harmonic: n,
            is_standing: self.is_standing(n),
            shares: [contact, axial].map(share),
            mass,
            stiffness: self.polynomial(n, |term| self.terms.factors(term)[0]),
            damping: (!is_proportional).then(|| self.polynomial(n, damping)), // Else alpha M + beta K says it.
            friction_dashpots: has_dashpots.then(|| of_kind(Kind::FrictionDashpots)),
            losses: self.terms.losses(|factor| self.polynomial(n, factor)),
            rayleigh: self.options.damping,
        }
    }

    /// `M_n` and `K_n` without friction, real and symmetric.
    pub fn at_rest(&self, n: usize) -> [BandedMatrix; 2] {
        self.of_power(n, 0)
    }

    /// The rows of `M_n` and `K_n` without friction that belong to the normals in rigid contact, each times a factor.
    pub fn normal_rows(&self, n: usize) -> [Vec<Vec<f64>>; 2] {
        let unknown = |own: &(usize, f64)| self.dofs.unknown_of[own.0];
        let slips = self.contact.rigid.iter().filter_map(|own| own.slip.iter().find_map(unknown));
        self.of_power(n, 1).map(|matrix| {
            let row = |slip: usize| (0..self.dofs.count).map(|k| matrix.get(slip, k)).collect(); // In it stands -s times the normal row.
            slips.clone().map(row).collect()
        })
    }

    /// What comes with a power of friction of the mass and the stiffness that there are without it.
    fn of_power(&self, n: usize, power: usize) -> [BandedMatrix; 2] {
        let is_first = |term: &Term<_>| f64::from(u8::from(term.power == 0));
        let mass = |term: &Term<_>| is_first(term) * of_kind(Kind::Mass)(term);
        let stiffness = |term: &Term<_>| is_first(term) * self.terms.factors(term)[0];
        [self.coefficient((n, power), &mass), self.coefficient((n, power), &stiffness)]
    }

    /// Harmonic `n` of the terms, each times its factor.
    fn polynomial(
        &self,
        n: usize,
        factor: impl Fn(&Term<Vec<SectorMatrix>>) -> f64,
    ) -> FrictionPolynomial {
        let own = self.terms.all.iter().filter(|own| factor(own) != 0.0);
        let count = own.map(|own| own.matrix.len()).max().unwrap_or(0).max(1);
        let sums = (0..count).map(|power| self.coefficient((n, power), &factor));
        let mut sums: FrictionPolynomial = sums.collect();
        while sums.len() > 1 && sums.last().is_some_and(BandedMatrix::is_zero) {
            sums.pop();
        }
        sums
    }

    /// The coefficient of a power of `i mu` of [`Self::polynomial`]. The dashpots of friction have one power less here.
    fn coefficient(
        &self,
        (n, power): (usize, usize),
        factor: &dyn Fn(&Term<Vec<SectorMatrix>>) -> f64,
    ) -> BandedMatrix {
        let mut sum = self.dofs.zeros();
        for own in &self.terms.all {
            let at = power + usize::from(own.kind == Kind::FrictionDashpots);
            let (factor, matrix) = (factor(own), own.matrix.get(at));
            if let Some(matrix) = matrix.filter(|_| factor != 0.0) {
                self.dofs.add(&mut sum, (n, power), (factor, matrix));
            }
        }
        sum
    }
}
