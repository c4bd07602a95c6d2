//! The small motions around steady sliding of a body of equal sectors, harmonic by harmonic, from the terms of one sector.

use super::elimination::Elimination;
use super::terms::{Kind, Part, Term, Terms, of_kind};
use super::{FrictionPolynomial, HarmonicTangent, TabledGain, TangentOptions};
use crate::contact::Row;
use crate::fem::fold::{MirrorParity, SectorMatrix, WaveDofs};
use crate::fem::{DofMap, MassKind, MaterialField, ModulusTable, RayleighDamping, Triplets};
use crate::linalg::banded::{BandedMatrix, CompactRows};
use crate::linalg::c64;
use crate::mesh::Strip;

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
    /// The matrices of one sector.
    pub terms: Terms<SectorMatrix>,
    /// The contact of one sector.
    pub contact: WaveContact,
    /// Dofs that nothing holds.
    pub dofs: WaveDofs,
    /// Those of them that move, the unknowns of a harmonic: all but the normals in rigid contact.
    pub unknowns: DofMap,
    /// Their places among the former.
    moving: Vec<usize>,
}

/// The contact of one sector, by its dofs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WaveContact {
    /// Component along the normal.
    pub normal: usize,
    /// Dofs of each contact node, or ring of them, the other body's behind its own.
    pub places: Vec<Vec<usize>>,
    /// Whether each of these is pressed.
    pub is_pressed: Vec<bool>,
    /// Pressed nodes.
    pub pressed_nodes: Vec<usize>,
    /// Rows of the distances of two bodies, unknowns in place of the normal dofs of the first.
    pub distances: Vec<Row>,
    /// In rigid contact: each normal dof, and the tangential ones whose equations it drives, with factors of `i mu`.
    pub rigid: Vec<(usize, Row)>,
}

/// The matrices of one sector before they are those of waves.
#[derive(Clone, Debug)]
pub struct SectorTangent {
    pub(super) strip: Strip,
    pub(super) terms: Terms<Triplets>,
    /// The contact of the sector.
    pub contact: WaveContact,
    pub(super) options: TangentOptions,
    pub(super) sliding_direction: f64,
}

impl SectorTangent {
    /// That of waves around the body.
    pub fn waves(self) -> WaveTangent {
        let Self { strip, terms, mut contact, options, sliding_direction } = self;
        // A node of the other body takes part in the motion of its pair, in the sectors beside as well.
        let mut dofs = strip.wave_dofs();
        dofs.half_bandwidth += 2 * contact.distances.len();
        let total = dofs.unknown_of.len();
        let mut basis = Elimination::holding(3 * total, []);
        for sector in 0..3 {
            for row in &contact.distances {
                let own = row.iter().map(|&(dof, along)| (dof + sector * total, along));
                basis.take(&own.collect());
            }
        }
        let place = |dof: usize| dofs.unknown_of[dof];
        let is_still = |dof: usize| contact.rigid.iter().any(|(normal, _)| *normal == dof);
        let moving = strip.free_dofs().filter(|&dof| !is_still(dof));
        let unknowns = DofMap::of(total, moving.collect());
        // Constraints by the places of free dofs.
        contact.rigid = contact
            .rigid
            .iter()
            .filter_map(|(normal, drags)| {
                let drags = drags.iter().filter_map(|&(dof, factor)| Some((place(dof)?, factor)));
                Some((place(*normal)?, drags.collect()))
            })
            .collect();
        WaveTangent {
            moving: unknowns.dofs.iter().filter_map(|&dof| place(dof)).collect(),
            options,
            unknowns,
            components: strip.mesh.dimension,
            halves: strip.halves.clone(),
            terms: terms.map(|_, own| strip.folded(&basis.congruent(&own))),
            dofs,
            contact,
            sliding_direction,
        }
    }
}

impl WaveTangent {
    /// A body without contact and prestress, held by its supports or all of it free, `C = alpha_R M + beta_R K` and the dashpots
    /// of its supports.
    pub fn of_free(
        strip: &Strip,
        material: &dyn MaterialField,
        mass: MassKind,
        damping: RayleighDamping,
        is_held: bool,
    ) -> Self {
        let (options, contact) = (TangentOptions::of_free(mass, damping), WaveContact::default());
        let terms = Terms::of_mesh((&strip.mesh, material), !is_held, &options);
        let strip = if is_held { strip.clone() } else { strip.unheld() };
        SectorTangent { strip, terms, contact, options, sliding_direction: 1.0 }.waves()
    }

    /// The largest harmonic, half the number of sectors.
    pub fn largest_harmonic(&self) -> usize {
        self.dofs.sectors / 2
    }

    /// Whether harmonic `n` stands: `+n` and `-n` are one and the same.
    pub fn is_standing(&self, n: usize) -> bool {
        n == 0 || 2 * n == self.dofs.sectors
    }

    /// Dofs of a sector at which a force can act and a displacement be observed: a distance between two bodies is no such place.
    pub fn places(&self) -> WaveDofs {
        let mut dofs = self.dofs.clone();
        dofs.unknown_of.clone_from(&self.unknowns.unknown_of);
        dofs.count = self.unknowns.len();
        self.contact.distances.iter().for_each(|row| dofs.unknown_of[row[0].0] = None);
        dofs
    }

    /// Displacement of each dof of a sector from the unknowns of a wave.
    pub fn displacement(&self, x: &[c64]) -> Vec<c64> {
        let mut all = vec![c64::ZERO; self.unknowns.unknown_of.len()];
        self.unknowns.dofs.iter().zip(x).for_each(|(&dof, value)| all[dof] = *value);
        for row in &self.contact.distances {
            let apart: c64 = row[1..].iter().map(|&(dof, along)| all[dof] * along).sum();
            all[row[0].0] -= apart;
        }
        all
    }

    /// Unknowns of motion across the sliding at contact nodes, ascending; none in the plane.
    pub fn sideways_unknowns(&self) -> Vec<usize> {
        let side = self.tangential_components().nth(1);
        let dofs = self.contact.places.iter().flatten().copied();
        self.ascending(dofs.filter(|dof| Some(dof % self.components) == side))
    }

    /// Unknown of the tangential displacement of each contact node.
    pub fn tangential_unknowns(&self) -> Vec<usize> {
        let dofs = self.contact.places.iter().map(|dofs| dofs[1]);
        dofs.filter_map(|dof| self.unknowns.unknown_of[dof]).collect()
    }

    /// Unknowns along and across the sliding and along the normal of pressed nodes.
    pub fn pressed_unknowns(&self) -> Vec<usize> {
        let own = self.contact.pressed_nodes.iter().flat_map(|node| {
            let components = self.tangential_components().chain([self.contact.normal]);
            components.map(move |c| self.components * node + c)
        });
        own.filter_map(|dof| self.unknowns.unknown_of[dof]).collect()
    }

    /// Unknowns of motion along the axis; none in the plane.
    pub fn axial_unknowns(&self) -> Vec<usize> {
        self.ascending((0..self.unknowns.unknown_of.len()).filter(|dof| dof % self.components == 2))
    }

    /// Unknowns of each contact node, or ring of them, of one sector.
    pub fn contact_unknowns(&self) -> Vec<Vec<usize>> {
        let place = |dof: &usize| self.unknowns.unknown_of[*dof];
        let contact = self.contact.places.iter();
        contact.map(|dofs| dofs.iter().filter_map(place).collect()).collect()
    }

    /// The terms of regions and supports in the unknowns of harmonic `n`; those of power one come with `i mu`.
    pub fn body_terms(&self, n: usize) -> Vec<Term<CompactRows>> {
        let bodies = self.terms.all.iter().filter(|own| matches!(own.part, Part::Body(_)));
        let folded = bodies.map(|term| {
            let is_it = |own: &Term<_>| f64::from(u8::from(std::ptr::eq(own, term)));
            let matrix = self.restricted(self.sum(n, term.parity(), &is_it));
            term.with(CompactRows::new(&matrix))
        });
        folded.collect()
    }

    /// Along the sliding, and in space across it.
    fn tangential_components(&self) -> impl Iterator<Item = usize> + use<> {
        [1].into_iter().chain((self.components == 3).then_some(2 - self.contact.normal))
    }

    fn ascending(&self, dofs: impl Iterator<Item = usize>) -> Vec<usize> {
        let mut unknowns: Vec<usize> =
            dofs.filter_map(|dof| self.unknowns.unknown_of[dof]).collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        unknowns
    }

    /// Whether `C = alpha_R M + beta_R K_t` exactly.
    pub fn is_proportional(&self) -> bool {
        self.terms.is_proportional(&self.options)
    }

    /// Whether the stiffness has losses, or depends on frequency.
    pub fn is_lossy(&self) -> bool {
        self.terms.is_lossy()
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
        HarmonicTangent {
            harmonic: n,
            is_standing: self.is_standing(n),
            mass: of_kind(Kind::Mass),
            stiffness: self.polynomial(n, |term| self.terms.factors(term)[0]),
            damping: (!self.is_proportional()).then(|| self.polynomial(n, damping)),
            friction_dashpots: has_dashpots.then(|| of_kind(Kind::FrictionDashpots)),
            losses: self.terms.losses(|factor| self.polynomial(n, factor)),
            shares: None,
            rayleigh: self.options.damping,
            contact: self.ascending(self.contact.places.iter().flatten().copied()),
        }
    }

    /// `M_n` and `K_n` without friction, real and symmetric.
    pub fn at_rest(&self, n: usize) -> [BandedMatrix; 2] {
        self.all_at_rest(n).map(|matrix| self.restricted(matrix))
    }

    /// The columns of `M_n` and `K_n` without friction that belong to the normals in rigid contact, over the unknowns.
    pub fn normal_columns(&self, n: usize) -> [Vec<Vec<f64>>; 2] {
        self.all_at_rest(n).map(|matrix| {
            let column = |(normal, _): &(usize, _)| {
                self.moving.iter().map(|&k| matrix.get(k, *normal)).collect()
            };
            self.contact.rigid.iter().map(column).collect()
        })
    }

    /// `M_n` and `K_n` without friction, the normals in rigid contact included.
    fn all_at_rest(&self, n: usize) -> [BandedMatrix; 2] {
        let sum =
            |factor: &dyn Fn(&Term<SectorMatrix>) -> f64| self.sum(n, MirrorParity::Even, factor);
        [sum(&of_kind(Kind::Mass)), sum(&|term| self.terms.factors(term)[0])]
    }

    /// Harmonic `n` of the terms of a parity, each times its factor.
    fn sum(
        &self,
        n: usize,
        parity: MirrorParity,
        factor: &dyn Fn(&Term<SectorMatrix>) -> f64,
    ) -> BandedMatrix {
        let mut sum = self.dofs.zeros();
        for own in self.terms.all.iter().filter(|own| own.parity() == parity) {
            let factor = factor(own);
            if factor != 0.0 {
                self.dofs.add(&mut sum, n, parity, (factor, &own.matrix));
            }
        }
        sum
    }

    /// Over the unknowns alone.
    fn restricted(&self, matrix: BandedMatrix) -> BandedMatrix {
        if self.contact.rigid.is_empty() { matrix } else { matrix.restricted_to(&self.moving) }
    }

    /// Harmonic `n` of the terms, each times its factor, over the unknowns; the odd part, `i` times this, is the coefficient of `i mu`.
    fn polynomial(
        &self,
        n: usize,
        factor: impl Fn(&Term<SectorMatrix>) -> f64,
    ) -> FrictionPolynomial {
        let mut odd = self.terms.all.iter().filter(|own| own.parity() == MirrorParity::Odd);
        let is_odd = odd.any(|own| factor(own) != 0.0);
        let parities =
            [MirrorParity::Even, MirrorParity::Odd].into_iter().take(1 + usize::from(is_odd));
        self.project(parities.map(|parity| self.sum(n, parity, &factor)).collect())
    }

    /// Onto the unknowns; for rigid contact each normal row is added to its tangential rows with the
    /// factor `-s mu`, which is `s (i mu)` once the tangential row is multiplied by `-i`.
    fn project(&self, mut full: Vec<BandedMatrix>) -> FrictionPolynomial {
        trim(&mut full);
        if !self.contact.rigid.is_empty() {
            full.push(self.dofs.zeros());
        }
        for power in (1..full.len()).rev() {
            let (lower, upper) = full.split_at_mut(power);
            for (normal, drags) in &self.contact.rigid {
                for column in lower[power - 1].columns(*normal) {
                    let value = lower[power - 1].get(*normal, column);
                    if value != 0.0 {
                        for (tangential, factor) in drags {
                            upper[0].add(*tangential, column, factor * value);
                        }
                    }
                }
            }
        }
        let mut full: Vec<_> = full.into_iter().map(|matrix| self.restricted(matrix)).collect();
        trim(&mut full);
        full
    }
}

impl Term<SectorMatrix> {
    /// What a mirror does to it.
    fn parity(&self) -> MirrorParity {
        match (self.power, self.kind) {
            (0, _) | (_, Kind::FrictionDashpots) => MirrorParity::Even,
            _ => MirrorParity::Odd,
        }
    }
}

/// Drops powers of friction that vanish from behind the others.
fn trim(powers: &mut Vec<BandedMatrix>) {
    while powers.len() > 1 && powers.last().is_some_and(BandedMatrix::is_zero) {
        powers.pop();
    }
}
