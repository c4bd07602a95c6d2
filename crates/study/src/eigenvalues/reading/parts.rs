//! The bodies of a whole mesh as sums over regions and supports.

use super::shapes::Shapes;
use crate::eigenvalues::contact::CONTACT;
use crate::eigenvalues::whole::WholeMesh;
use frictionsim_case::Case;
use frictionsim_physics::fem::{
    ModulusTable, Triplets, assemble_attachments, assemble_geometric_stiffness,
    assemble_patch_damping, assemble_point_masses, assemble_region, assemble_support,
};
use frictionsim_physics::linalg::{Mat, MatRef, MatrixPolynomial, c64};
use frictionsim_physics::mesh::{Boundary, Mesh};
use frictionsim_physics::prestress::PressedState;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Mass and stiffness on one pattern.
pub(super) struct Pair(MatrixPolynomial);

impl Pair {
    fn new(count: usize, [mass, stiffness]: [Triplets; 2]) -> Self {
        Self(MatrixPolynomial::from_triplets(count, &[mass.entries, stiffness.entries]))
    }

    /// `M x`.
    fn mass_image(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        self.0.pattern().multiply(&self.0.coefficients()[0], x)
    }

    /// `M x` and `K x`.
    pub fn multiply(&self, x: MatRef<'_, f64>) -> [Mat<f64>; 2] {
        let [mass, stiffness] = self.0.coefficients() else {
            unreachable!("a pair has two coefficients")
        };
        self.0.pattern().multiply_each([mass, stiffness], x)
    }
}

/// A region of a body.
pub(super) struct Region {
    pub name: String,
    pub pair: Pair,
    pub alpha: f64,
    pub beta: f64,
    eta: f64,
    table: Option<Arc<ModulusTable>>,
}

impl Region {
    /// What its stiffness is multiplied by at the frequency of an eigenvalue: `1 + i eta`, or what a table says.
    pub fn ratio(&self, lambda: c64) -> c64 {
        match &self.table {
            Some(table) => table.ratio(lambda.im / TAU),
            None => c64::new(1.0, self.eta),
        }
    }
}

/// The bodies of a whole mesh as sums.
pub(super) struct Parts<'a> {
    pub case: &'a Case,
    pub whole: &'a WholeMesh,
    /// Each region with its name and its coefficients `alpha`, `beta`, `eta`, and the table that its stiffness follows.
    pub regions: Vec<Region>,
    /// Dashpots and springs of each support with its `eta`, and last of the modifications.
    pub supports: Vec<(String, Pair, f64)>,
    /// Point masses.
    pub attached: Option<Pair>,
    /// Gyroscopic matrix and transport stiffness of the regions that turn with the inertia of their rotation.
    pub rotation: Option<Pair>,
    /// Each contact with the dofs of its surfaces.
    pub contacts: Vec<(String, Vec<usize>)>,
    /// Geometric stiffness by base state and region, a polynomial in friction.
    geometric: RefCell<BTreeMap<(usize, usize), MatrixPolynomial>>,
}

impl<'a> Parts<'a> {
    pub fn new(case: &'a Case, whole: &'a WholeMesh) -> Self {
        let (mesh, options, assembly) = (&*whole.mesh, &whole.options, whole.assembly(case));
        let pairs = assembly.contacts().iter().map(|(own, _)| {
            let surfaces = std::iter::once(own.surface).chain(own.counter.surface());
            (own.name.clone(), surfaces.collect())
        });
        let contacts = contact_dofs(mesh, &pairs.collect::<Vec<_>>());
        let materials = case.materials();
        let count = mesh.dof_count();
        let regions = mesh.regions.iter().enumerate().map(|(region, name)| {
            let own = assemble_region(mesh, materials, options.mass, region);
            let damping = materials.own_damping(region).unwrap_or(options.damping);
            Region {
                name: name.clone(),
                pair: Pair::new(count, own),
                alpha: damping.mass_coefficient,
                beta: damping.stiffness_coefficient,
                eta: materials.of(region).loss_factor,
                table: materials.table(region).cloned(),
            }
        });
        let regions = regions.collect();
        let masses = assemble_point_masses(mesh);
        let has_masses = !masses.entries.is_empty();
        let mut supports = supports(mesh);
        if !(mesh.attachments.is_empty() && mesh.patches.is_empty()) {
            let patches = assemble_patch_damping(mesh, materials, options.mass);
            supports.push(modifications(mesh, patches));
        }
        let rotation = assembly.rotation_terms().cloned();
        let rotation =
            rotation.map(|[transport, gyroscopic]| Pair::new(count, [gyroscopic, transport]));
        Self {
            case,
            whole,
            regions,
            supports,
            attached: has_masses.then(|| Pair::new(count, [masses, Triplets::default()])),
            rotation,
            contacts: match contacts.is_empty() {
                true => vec![(CONTACT.to_owned(), Vec::new())],
                false => contacts,
            },
            geometric: RefCell::default(),
        }
    }

    /// `M x` of all regions and point masses.
    pub fn mass_image(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        let regions = self.regions.iter().map(|region| &region.pair);
        let mut sum = Mat::zeros(x.nrows(), x.ncols());
        for pair in regions.chain(&self.attached) {
            sum += pair.mass_image(x);
        }
        sum
    }

    /// `K_sigma phi` of a region for each shape; `None` where no stress of the base state acts on small motions.
    pub fn geometric_image(&self, shapes: &Shapes<'_>, region: usize) -> Option<Mat<f64>> {
        let WholeMesh { mesh, options, .. } = self.whole;
        let base = self.base_state(shapes.friction);
        let (place, state) = base.filter(|_| options.geometric_stiffness)?;
        // Linear in the displacement: assembled once for each state and power of the friction beyond its origin.
        let mut known = self.geometric.borrow_mut();
        let geometric = known.entry((place, region)).or_insert_with(|| {
            let materials = self.case.materials();
            let terms = state.displacements.iter().map(|displacement| {
                assemble_geometric_stiffness(mesh, materials, displacement, Some(region)).entries
            });
            let terms: Vec<_> = terms.collect();
            MatrixPolynomial::from_triplets(mesh.dof_count(), &terms)
        });
        let values = geometric.evaluate((shapes.friction - state.frozen_below).max(0.0));
        Some(geometric.pattern().multiply(&values, shapes.columns.as_ref()))
    }

    /// Number of the base state at a friction coefficient, and the state as far as its stress is not in the terms of
    /// the rotation.
    fn base_state(&self, friction: f64) -> Option<(usize, PressedState)> {
        let solved = self.case.cea.as_ref()?.solved_friction_coefficients();
        let place = solved.iter().position(|&mu| mu == friction)?;
        let range = &self.whole.range;
        let number = range.state_of[place];
        let state = self.whole.assembly(self.case).stressing(&range.states[number])?;
        Some((number, state))
    }
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
    let mut touched: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (contact, (_, surfaces)) in contacts.iter().enumerate() {
        for node in surfaces.iter().flat_map(|&surface| nodes(surface)) {
            let known = touched.entry(node).or_default();
            if !known.contains(&contact) {
                known.push(contact);
            }
        }
    }
    let mut dofs = vec![Vec::new(); contacts.len()];
    for (node, all) in touched {
        let nearest = all.iter().copied();
        let nearest = nearest.min_by(|a, b| distance(node, *a).total_cmp(&distance(node, *b)));
        let owner = nearest.unwrap_or(all[0]);
        let d = mesh.dimension;
        dofs[owner].extend((0..d).map(|k| d * node + k));
    }
    let names = contacts.iter().map(|(name, _)| name.clone());
    names.zip(dofs).collect()
}

/// Dashpots and springs of the modifications, with the damping of their patches.
fn modifications(mesh: &Mesh, patches: Triplets) -> (String, Pair, f64) {
    let [springs, mut dashpots] = assemble_attachments(mesh);
    dashpots.entries.extend(patches.entries);
    let pair = Pair::new(mesh.dof_count(), [dashpots, springs]);
    ("modifications".to_owned(), pair, 0.0)
}

/// Dashpots and springs of each supported boundary, with its loss factor.
fn supports(mesh: &Mesh) -> Vec<(String, Pair, f64)> {
    let of = |boundary: &Boundary| {
        let ([springs, dashpots], loss_factor) = assemble_support(mesh, boundary)?;
        let pair = Pair::new(mesh.dof_count(), [dashpots, springs]);
        Some((boundary.name.clone(), pair, loss_factor))
    };
    mesh.boundaries.iter().filter_map(of).collect()
}
