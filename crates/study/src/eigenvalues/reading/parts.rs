//! The matrices of a whole mesh as sums over regions and supports.

use super::shapes::Shapes;
use crate::eigenvalues::contact::CONTACT;
use crate::*;
use frictionsim_physics::linalg::MatrixPolynomial;
use frictionsim_physics::prestress::{Kind, Part, Term, Terms};
use std::sync::Mutex;

/// A matrix with what it stands for.
pub(super) type PartTerm = Term<MatrixPolynomial>;

/// The bodies of a whole mesh as sums.
pub(super) struct Parts<'a> {
    pub case: &'a Case,
    pub whole: &'a WholeMesh,
    /// Regions, supports, modifications and the inertia of rotation, over all dofs.
    pub terms: Terms<MatrixPolynomial>,
    /// Each contact with the dofs of its surfaces.
    pub contacts: Vec<(String, Vec<usize>)>,
    /// Geometric stiffness of the regions by base state.
    stress: Mutex<BTreeMap<usize, Arc<[PartTerm]>>>,
}

impl<'a> Parts<'a> {
    pub fn new(case: &'a Case, whole: &'a WholeMesh) -> Self {
        let (mesh, assembly) = (&*whole.mesh, whole.assembly(case));
        let pairs = assembly.contacts().iter().map(|(own, _)| {
            let surfaces = std::iter::once(own.surface).chain(own.counter.surface());
            (own.name.clone(), surfaces.collect())
        });
        let contacts = contact_dofs(mesh, &pairs.collect::<Vec<_>>());
        Self {
            case,
            whole,
            terms: assembly.terms(&whole.options).map(|_, own| over(mesh, vec![own])),
            contacts: match contacts.is_empty() {
                true => vec![(CONTACT.to_owned(), Vec::new())],
                false => contacts,
            },
            stress: Mutex::default(),
        }
    }

    /// `A phi` of a term for each shape.
    pub fn image(&self, term: &PartTerm, shapes: &Shapes<'_>) -> Mat<f64> {
        let values = term.matrix.evaluate(shapes.friction);
        term.matrix.pattern().multiply(&values, shapes.columns.as_ref())
    }

    /// Geometric stiffness of the regions at a friction coefficient; none where no stress of the base state acts on
    /// small motions beside that of the rotation.
    pub fn stress(&self, friction: f64) -> Arc<[PartTerm]> {
        let WholeMesh { mesh, options, range, .. } = self.whole;
        let cea = self.case.cea.as_ref().filter(|_| options.geometric_stiffness);
        let solved = cea.map(|cea| cea.solved_friction_coefficients()).unwrap_or_default();
        let Some(place) = solved.iter().position(|&mu| mu == friction) else {
            return Arc::default();
        };
        // Linear in the displacement: assembled once for each state.
        let number = range.state_of[place];
        let mut known = self.stress.lock().expect("a panic ends the reading first");
        let own = known.entry(number).or_insert_with(|| {
            let state = &range.states[number];
            let regions = self.whole.assembly(self.case).stress(state).unwrap_or_default();
            let terms = regions.into_iter().enumerate().map(|(region, powers)| Term {
                part: Part::Body(region),
                kind: Kind::Prestress,
                power: 0,
                matrix: over(mesh, powers).frozen_below(state.frozen_below),
            });
            terms.collect()
        });
        Arc::clone(own)
    }
}

/// A polynomial in friction over all dofs.
fn over(mesh: &Mesh, powers: Vec<Triplets>) -> MatrixPolynomial {
    let powers: Vec<_> = powers.into_iter().map(|own| own.entries).collect();
    MatrixPolynomial::from_triplets(mesh.dof_count(), &powers)
}

/// The dofs on both surfaces of each contact; a node that several contacts touch is of the one whose finer surface is
/// nearest.
fn contact_dofs(mesh: &Mesh, contacts: &[(String, Vec<usize>)]) -> Vec<(String, Vec<usize>)> {
    let nodes = |boundary: usize| mesh.boundaries[boundary].nodes.iter().map(|&n| n as usize);
    let distance = |node: usize, contact: usize| {
        let at = mesh.nodes[node];
        let away = |other: usize| -> f64 {
            let place = mesh.nodes[other];
            (0..3).map(|k| (at[k] - place[k]).powi(2)).sum()
        };
        nodes(contacts[contact].1[0]).map(away).fold(f64::INFINITY, f64::min)
    };
    let mut touched: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for (contact, (_, surfaces)) in contacts.iter().enumerate() {
        for node in surfaces.iter().flat_map(|&surface| nodes(surface)) {
            touched.entry(node).or_default().insert(contact);
        }
    }
    let mut dofs = vec![Vec::new(); contacts.len()];
    for (node, all) in touched {
        let by_distance = |a: &usize, b: &usize| distance(node, *a).total_cmp(&distance(node, *b));
        if let Some(owner) = all.into_iter().min_by(by_distance) {
            let d = mesh.dimension;
            dofs[owner].extend((0..d).map(|k| d * node + k));
        }
    }
    contacts.iter().map(|(name, _)| name.clone()).zip(dofs).collect()
}
