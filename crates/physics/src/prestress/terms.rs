//! The matrices that small motions are the sum of, each with what it stands for: of a whole mesh or of one sector.
//!
//! ```text
//! M = sum_r M_r,   C = sum_r (alpha_r M_r + beta_r K_r) + beta_R (G + sum_c K_c) + D
//! K = sum_r K_r + sum_s K_s + sum_c K_c + G,   H = sum_r eta_r K_r + sum_s eta_s K_s + sum_c eta_c K_c
//! ```
//!
//! over regions `r`, supports `s` and contacts `c`, with their dashpots `D` and the stiffness `G` of the base state.

use super::{DampingModel, LossGain, TabledGain, TangentOptions};
use crate::contact::PressedState;
use crate::fem::{
    ElementGeometry, MaterialField, RayleighDamping, Triplets, assemble_around,
    assemble_attachments, assemble_patch_damping, assemble_point_masses, assemble_support,
    region_mass, region_stiffnesses,
};
use crate::linalg::c64;
use crate::mesh::Mesh;
use std::sync::Arc;

/// What a matrix belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A region, or after these a support or what else is no region.
    Body(usize),
    /// A contact.
    Contact(usize),
}

/// What a matrix does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Inertia of a region, or of point masses.
    Mass,
    /// Elasticity of a region, springs of a support, the normal law of a contact.
    Stiffness,
    /// Stress of the base state in a region; forces of a contact that turn with their nodes.
    Prestress,
    /// Stiffness of a rotation with the stress that it causes.
    Transport,
    /// Dashpots, those of friction included.
    Dashpots,
    /// Gyroscopic forces, whose matrix is skew.
    Gyroscopic,
    /// `p_0 / V` across the sliding, and `p_0 mu'(V) / mu` along it where friction falls with the speed: a mirror leaves it as it is.
    FrictionDashpots,
}

/// One matrix: what comes with a power of the friction coefficient.
#[derive(Clone, Debug)]
pub struct Term<M> {
    /// What it belongs to.
    pub part: Part,
    /// What it does.
    pub kind: Kind,
    /// The power of friction.
    pub power: usize,
    /// N/m, N s/m or kg; in the plane for each metre of thickness.
    pub matrix: M,
}

impl<M> Term<M> {
    /// Whether it does this for a part.
    pub fn is(&self, part: Part, kind: Kind) -> bool {
        (self.part, self.kind) == (part, kind)
    }

    /// The same with another matrix.
    pub fn with<N>(&self, matrix: N) -> Term<N> {
        let Self { part, kind, power, .. } = *self;
        Term { part, kind, power, matrix }
    }
}

/// One for the terms of a kind, zero for all others.
pub(super) fn of_kind<M>(kind: Kind) -> impl Fn(&Term<M>) -> f64 {
    move |term| f64::from(u8::from(term.kind == kind))
}

/// What the matrices of a part are multiplied by.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartLaw {
    /// Rayleigh coefficients.
    pub damping: RayleighDamping,
    /// Structural damping `eta`.
    pub loss_factor: f64,
    /// Modulus over frequency; the elastic stiffness has that of the lowest.
    pub table: Option<TabledGain>,
}

impl PartLaw {
    /// That of a region, whose damping is the common one unless it has its own.
    pub fn of(material: &dyn MaterialField, region: usize, common: RayleighDamping) -> Self {
        let table =
            |table| TabledGain { table: Arc::clone(table), reference_hz: table.range_hz()[0] };
        Self {
            damping: material.own_damping(region).unwrap_or(common), // Each region may damp by its own coefficients.
            loss_factor: material.of(region).loss_factor,
            table: material.table(region).map(table),
        }
    }

    /// What its stiffness is multiplied by at an eigenvalue: `1 + i eta`, or what the table says.
    pub fn ratio(&self, root: c64) -> c64 {
        let gain = LossGain(self.table.clone());
        match &self.table {
            Some(table) => table.reference() + gain.at(root), // The table's ratio at the mode's own frequency.
            None => 1.0 + self.loss_factor * gain.at(root),
        }
    }
}

/// Quadratic forms of a motion in a region or support: `x^H M x`, `x^H K x`, `x^H C x`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PartForms {
    /// Twice the kinetic energy over `|lambda|^2`; none of a support.
    pub mass: f64,
    /// Twice the strain energy.
    pub stiffness: f64,
    /// What the damping takes, over `|lambda|^2`; a loss factor takes like a dashpot `eta k / omega`.
    pub damping: f64,
}

/// What the matrices are made of.
#[derive(Clone, Debug)]
pub struct Terms<M> {
    /// One of each part, kind and power, none of them empty.
    pub all: Vec<Term<M>>,
    /// Regions, then supports and what else is no region.
    pub bodies: Vec<PartLaw>,
    /// Names of the latter.
    pub others: Vec<String>,
    /// Of each contact.
    pub contacts: Vec<PartLaw>,
    /// Its stiffness coefficient multiplies contact and prestress in the damping.
    tangent_damping: RayleighDamping,
}

impl<M> Terms<M> {
    /// None yet.
    pub fn new(options: &TangentOptions) -> Self {
        let tangent_damping =
            RayleighDamping { mass_coefficient: 0.0, ..options.damping_of_tangent() }; // alpha_R is of masses alone.
        let (all, bodies, others, contacts) = Default::default();
        Self { all, bodies, others, contacts, tangent_damping }
    }

    /// The factors of regions.
    pub fn regions(&self) -> &[PartLaw] {
        &self.bodies[..self.bodies.len() - self.others.len()]
    }

    /// The factors of all parts.
    pub fn laws(&self) -> impl Iterator<Item = &PartLaw> {
        self.bodies.iter().chain(&self.contacts)
    }

    /// The factors of a part.
    pub fn law(&self, part: Part) -> &PartLaw {
        match part {
            Part::Body(body) => &self.bodies[body],
            Part::Contact(contact) => &self.contacts[contact],
        }
    }

    /// The factors of a term in `K`, tables at their reference, in `C` and in the structural damping.
    pub fn factors<N>(&self, term: &Term<N>) -> [f64; 3] {
        let PartLaw { damping, loss_factor, table } = self.law(term.part);
        let reference = table.as_ref().map_or(1.0, TabledGain::reference);
        match term.kind {
            Kind::Mass => [0.0, damping.mass_coefficient, 0.0],
            Kind::Stiffness => [reference, damping.stiffness_coefficient, *loss_factor],
            Kind::Prestress => [1.0, self.tangent_damping.stiffness_coefficient, 0.0], // Stress damps with the tangent, if at all.
            Kind::Transport => [1.0, 0.0, 0.0],
            Kind::Dashpots | Kind::Gyroscopic | Kind::FrictionDashpots => [0.0, 1.0, 0.0],
        }
    }

    /// What a term is multiplied by in `lambda^2 M + lambda C + K` with losses and tables.
    pub fn dynamic<N>(&self, term: &Term<N>, root: c64) -> c64 {
        let own = match term.kind {
            Kind::Mass => root * root,
            Kind::Stiffness => self.law(term.part).ratio(root),
            Kind::Prestress | Kind::Transport => c64::ONE,
            Kind::Dashpots | Kind::Gyroscopic | Kind::FrictionDashpots => c64::ZERO, // These are in C alone.
        };
        own + root * self.factors(term)[1] // What it has in C comes with lambda.
    }

    /// Adds `x^H A x` of a term's matrix to the forms of its part. Stress has a part in the damping alone. Gyroscopic forces, of which
    /// `x^H G x = i g`, take no power of a motion that neither grows nor decays; of one that does `sigma g / omega`.
    pub fn add_form<N>(&self, term: &Term<N>, root: c64, form: c64, sum: &mut PartForms) {
        if term.kind == Kind::Gyroscopic {
            // x^H G x = i g: of the power of lambda G only sigma g is left, over omega.
            sum.damping += root.re * form.im / root.im;
            return;
        }
        sum.damping += self.factors(term)[1] * form.re;
        match term.kind {
            Kind::Mass => sum.mass += form.re,
            Kind::Stiffness => {
                let ratio = self.law(term.part).ratio(root); // K (1 + i eta) takes like a dashpot eta k / omega.
                sum.stiffness += ratio.re * form.re;
                sum.damping += ratio.im / root.im * form.re;
            }
            _ => {}
        }
    }

    /// What `K` has beside it, `sum` adding up all terms with their factors: structural damping `sum eta K` of regions, supports
    /// and the normal law of contacts, which friction follows; then each region with a table. Of a difference of tangents too,
    /// whose matrices may be zero: all terms of a quotient have the same parts.
    pub(super) fn losses<P>(
        &self,
        sum: impl Fn(&dyn Fn(&Term<M>) -> f64) -> P,
    ) -> Vec<(LossGain, P)> {
        // i eta K of all parts is one matrix; each table has a factor of its own.
        let has_losses = self.laws().any(|law| law.loss_factor != 0.0);
        let structural = has_losses.then(|| (LossGain(None), sum(&|term| self.factors(term)[2])));
        let tabled = self.bodies.iter().enumerate().filter_map(|(body, law)| {
            let table = LossGain(Some(law.table.clone()?));
            let own = |term: &Term<M>| term.is(Part::Body(body), Kind::Stiffness); // Stress does not follow the modulus.
            Some((table, sum(&|term| f64::from(u8::from(own(term))))))
        });
        structural.into_iter().chain(tabled).collect()
    }

    /// Whether some stiffness has losses, or depends on frequency.
    pub fn is_lossy(&self) -> bool {
        self.laws().any(|law| law.loss_factor != 0.0 || law.table.is_some())
    }

    /// Whether `C = alpha_R M + beta_R K_t` exactly.
    pub fn is_proportional(&self, options: &TangentOptions) -> bool {
        let is_common = |law: &PartLaw| law.damping == options.damping;
        let is_further = |term: &Term<M>| match term.kind {
            Kind::Mass | Kind::Prestress => false,
            Kind::Stiffness => {
                matches!(term.part, Part::Body(own) if own >= self.regions().len())
            }
            _ => true,
        };
        options.damping_model == DampingModel::WholeTangent
            && !self.is_lossy()
            && self.regions().iter().all(is_common)
            && !self.all.iter().any(is_further) // Supports, dashpots and what turns leave no common factor.
    }

    /// The same with other matrices, made of the power and the matrix of each term.
    pub fn map<N>(self, of: impl Fn(usize, M) -> N) -> Terms<N> {
        let Self { all, bodies, others, contacts, tangent_damping } = self;
        let all = all.into_iter().map(|Term { part, kind, power, matrix }| {
            let matrix = of(power, matrix);
            Term { part, kind, power, matrix }
        });
        Terms { all: all.collect(), bodies, others, contacts, tangent_damping }
    }
}

impl<M: Default + PartialEq> Terms<M> {
    /// Adds what acts with each power of friction; a matrix without entries is the default one.
    pub fn add(&mut self, part: Part, kind: Kind, powers: impl IntoIterator<Item = M>) {
        let powers = powers.into_iter().enumerate();
        let terms = powers.map(|(power, matrix)| Term { part, kind, power, matrix });
        self.all.extend(terms.filter(|term| term.matrix != M::default()));
    }

    /// Adds the next body. Regions have no name here, and come before all others.
    pub fn add_body<const N: usize>(
        &mut self,
        name: Option<String>,
        law: PartLaw,
        own: [(Kind, M); N],
    ) {
        let part = Part::Body(self.bodies.len());
        own.into_iter().for_each(|(kind, matrix)| self.add(part, kind, [matrix]));
        self.bodies.push(law);
        self.others.extend(name);
    }

    /// The next contact; what acts along its normal is damped with the whole tangent.
    pub fn add_contact(&mut self, loss_factor: f64) -> Part {
        let damping = self.tangent_damping;
        self.contacts.push(PartLaw { damping, loss_factor, table: None });
        Part::Contact(self.contacts.len() - 1)
    }
}

impl Terms<Vec<Triplets>> {
    /// Difference quotients of all matrices ([`Triplets::quotient`]) of sides, itself one of them; `false` where factors differ, or
    /// a side lacks a term.
    pub(super) fn set_quotient(&mut self, sides: &[(f64, &Self)]) -> bool {
        let name = |own: &Term<Vec<_>>| (own.part, own.kind, own.power, own.matrix.len());
        let is_alike = |own: &Self| {
            (own.bodies == self.bodies && own.contacts == self.contacts)
                && own.tangent_damping == self.tangent_damping
                && own.all.iter().map(name).eq(self.all.iter().map(name))
        };
        if !sides.iter().all(|(_, own)| is_alike(own)) {
            return false;
        }
        for (k, term) in self.all.iter_mut().enumerate() {
            for (power, matrix) in term.matrix.iter_mut().enumerate() {
                let own = sides.iter().map(|(weight, own)| (*weight, &own.all[k].matrix[power]));
                *matrix = Triplets::quotient(&own.collect::<Vec<_>>());
            }
        }
        self.all.retain(|term| term.matrix.iter().any(|own| !own.entries.is_empty())); // What the key leaves as it is.
        true
    }
}

impl Terms<Triplets> {
    /// Adds the stress of a base state in each region.
    pub(super) fn add_stress(&mut self, bodies: (&Mesh, &dyn MaterialField), state: &PressedState) {
        for region in 0..self.regions().len() {
            let powers = geometric_stiffness(bodies, state, region);
            self.add(Part::Body(region), Kind::Prestress, powers);
        }
    }

    /// Those of a mesh over all its dofs without stress and rotation.
    pub fn of_mesh(
        (mesh, material): (&Mesh, &dyn MaterialField),
        is_free: bool,
        options: &TangentOptions,
    ) -> Self {
        Self::of_elastic((mesh, material), region_stiffnesses(mesh, material), is_free, options)
    }

    /// [`Self::of_mesh`] with the stiffness of each region: regions, supports unless all of it is free, and modifications.
    pub(super) fn of_elastic(
        (mesh, material): (&Mesh, &dyn MaterialField),
        elastic: Vec<Triplets>,
        is_free: bool,
        options: &TangentOptions,
    ) -> Self {
        let mut own = Self::new(options);
        for (region, stiffness) in elastic.into_iter().enumerate() {
            let mass = (Kind::Mass, region_mass(mesh, material, options.mass, region));
            let law = PartLaw::of(material, region, options.damping);
            own.add_body(None, law, [mass, (Kind::Stiffness, stiffness)]);
        }
        for boundary in mesh.boundaries.iter().filter(|_| !is_free) {
            if let Some(([springs, dashpots], loss_factor)) = assemble_support(mesh, boundary) {
                let law = PartLaw { loss_factor, ..PartLaw::default() };
                let terms = [(Kind::Stiffness, springs), (Kind::Dashpots, dashpots)];
                own.add_body(Some(boundary.name.clone()), law, terms);
            }
        }
        if mesh.attachments.is_empty() && mesh.patches.is_empty() {
            return own;
        }
        // Point masses are damped like the whole body.
        let RayleighDamping { mass_coefficient, .. } = options.damping;
        let damping = RayleighDamping { mass_coefficient, ..RayleighDamping::default() };
        let law = PartLaw { damping, ..PartLaw::default() };
        let attached = if is_free { Default::default() } else { assemble_attachments(mesh) };
        let [springs, mut dashpots] = attached;
        dashpots.entries.extend(assemble_patch_damping(mesh, material, options.mass).entries);
        // Point masses, springs and dashpots, and the damping of patches, are one body more.
        let masses = (Kind::Mass, assemble_point_masses(mesh));
        let springs = (Kind::Stiffness, springs);
        let terms = [masses, springs, (Kind::Dashpots, dashpots)];
        own.add_body(Some("modifications".into()), law, terms);
        own
    }
}

/// Geometric stiffness of the stress of a state in a region by power of `mu - a`, N/m, in the terms of one that is frozen below `a`.
pub(super) fn geometric_stiffness(
    bodies: (&Mesh, &dyn MaterialField),
    state: &PressedState,
    region: usize,
) -> Vec<Triplets> {
    let of = ElementGeometry::geometric_stiffnesses;
    let mut powers = assemble_around(bodies, &state.displacements, Some(region), of);
    if state.frozen_below > 0.0 && powers.len() > 1 {
        powers.insert(1, Triplets::default()); // The places of a frozen tangent are those of 1, min(mu, a), mu - a, ...
    }
    powers
}
