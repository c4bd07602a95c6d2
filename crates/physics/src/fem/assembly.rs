//! Assembly of element matrices.

use super::element::{self, ElementGeometry};
use super::{ElasticMaterial, MaterialField, RayleighDamping, Triplets};
use crate::mesh::Mesh;
use nalgebra::DMatrix;

/// Consistent or lumped mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MassKind {
    /// `∫ rho N_I N_J dA`.
    Consistent,
    /// Diagonal.
    Lumped,
}

/// Global stiffness `K` over all dofs in nodal frames, N/m, in the plane for each metre of thickness.
///
/// Elements that are rotated copies of one another share one matrix to the last bit, so that a
/// rotationally symmetric mesh gives an exactly rotationally symmetric operator.
pub fn assemble_stiffness(mesh: &Mesh, material: &dyn MaterialField) -> Triplets {
    assemble_congruent(mesh, &|_| true, |e| element_stiffness(mesh, material, e))
}

/// Global mass `M` over all dofs, point masses included, kg for each metre of thickness.
pub fn assemble_mass(mesh: &Mesh, material: &dyn MaterialField, kind: MassKind) -> Triplets {
    let mut mass = mass_of(mesh, material, kind, &|_| true);
    mass.entries.extend(assemble_point_masses(mesh).entries);
    mass
}

/// Point masses over all dofs, kg, in the plane for each metre of thickness.
pub fn assemble_point_masses(mesh: &Mesh) -> Triplets {
    let masses = mesh.attachments.iter().filter(|own| own.mass != 0.0);
    diagonal(mesh, masses.map(|own| (own.node, own.mass)))
}

/// Consistent mass and stiffness of one element over its dofs, those of [`crate::mesh::Mesh::element_nodes`] in turn.
pub fn element_matrices(
    mesh: &Mesh,
    material: &dyn MaterialField,
    kind: MassKind,
    element: usize,
) -> [DMatrix<f64>; 2] {
    [element_mass(mesh, material, kind, element), element_stiffness(mesh, material, element)]
}

/// Stiffness of one element in nodal frames, N/m, in the plane for each metre of thickness.
pub fn element_stiffness(
    mesh: &Mesh,
    material: &dyn MaterialField,
    element: usize,
) -> DMatrix<f64> {
    ElementGeometry::new(mesh, element).stiffness(material.of(mesh.region(element)))
}

/// Mass of one element in nodal frames, kg, in the plane for each metre of thickness.
pub fn element_mass(
    mesh: &Mesh,
    material: &dyn MaterialField,
    kind: MassKind,
    element: usize,
) -> DMatrix<f64> {
    let geometry = ElementGeometry::new(mesh, element);
    let elastic = material.of(mesh.region(element));
    match kind {
        MassKind::Consistent => geometry.consistent_mass(elastic),
        MassKind::Lumped => {
            let masses = geometry.lumped_mass(elastic);
            let d = mesh.dimension;
            let size = d * masses.len();
            DMatrix::from_fn(size, size, |i, j| if i == j { masses[i / d] } else { 0.0 })
        }
    }
}

/// Stiffness of the elements of one region alone, over all dofs: N/m, in the plane for each metre of thickness.
pub fn region_stiffness(mesh: &Mesh, material: &dyn MaterialField, region: usize) -> Triplets {
    let is_own = |e: usize| mesh.region(e) == region;
    assemble_congruent(mesh, &is_own, |e| element_stiffness(mesh, material, e))
}

/// Those of all regions.
pub fn region_stiffnesses(mesh: &Mesh, material: &dyn MaterialField) -> Vec<Triplets> {
    let regions = 0..mesh.regions.len().max(1);
    regions.map(|region| region_stiffness(mesh, material, region)).collect()
}

/// Mass of the elements of one region alone, over all dofs: kg, in the plane for each metre of thickness.
pub fn region_mass(
    mesh: &Mesh,
    material: &dyn MaterialField,
    kind: MassKind,
    region: usize,
) -> Triplets {
    mass_of(mesh, material, kind, &|e| mesh.region(e) == region)
}

/// Mass of some elements without point masses.
fn mass_of(
    mesh: &Mesh,
    material: &dyn MaterialField,
    kind: MassKind,
    keep: &dyn Fn(usize) -> bool,
) -> Triplets {
    match kind {
        MassKind::Consistent => {
            assemble_congruent(mesh, keep, |e| element_mass(mesh, material, kind, e))
        }
        MassKind::Lumped => diagonal(mesh, masses_of(mesh, material, keep).into_iter().enumerate()),
    }
}

/// Masses of nodes along all axes.
fn diagonal(mesh: &Mesh, masses: impl Iterator<Item = (usize, f64)>) -> Triplets {
    let (d, mut triplets) = (mesh.dimension, Triplets::default());
    for (node, mass) in masses {
        (d * node..d * (node + 1)).for_each(|dof| triplets.push(dof, dof, mass));
    }
    triplets
}

/// Lumped mass of each node, point masses included, kg for each metre of thickness.
pub fn lumped_masses(mesh: &Mesh, material: &dyn MaterialField) -> Vec<f64> {
    let mut masses = masses_of(mesh, material, &|_| true);
    for attachment in &mesh.attachments {
        masses[attachment.node] += attachment.mass;
    }
    masses
}

fn masses_of(mesh: &Mesh, material: &dyn MaterialField, keep: &dyn Fn(usize) -> bool) -> Vec<f64> {
    let mut masses = vec![0.0; mesh.node_count()];
    let mut cache: Vec<Option<Vec<f64>>> = vec![None; mesh.element_count()];
    for e in (0..mesh.element_count()).filter(|&e| keep(e)) {
        let shared = cache[mesh.congruent_to[e] as usize].get_or_insert_with(|| {
            ElementGeometry::new(mesh, e).lumped_mass(material.of(mesh.region(e)))
        });
        for (&node, mass) in mesh.element_nodes(e).iter().zip(shared.iter()) {
            masses[node as usize] += mass;
        }
    }
    masses
}

/// Global geometric stiffness of the stress that `base` (all dofs, nodal frames, m) causes, of all elements or those of one
/// region, N/m for each metre of thickness.
pub fn assemble_geometric_stiffness(
    mesh: &Mesh,
    material: &dyn MaterialField,
    base: &[f64],
    region: Option<usize>,
) -> Triplets {
    sum_around((mesh, material), base, region, ElementGeometry::geometric_stiffness)
}

/// What the displacements `base` (all dofs, nodal frames, m) add to the elastic stiffness of the elements, N/m: beside
/// [`assemble_geometric_stiffness`] the other term of the first order in the strain of `base`.
pub fn assemble_displacement_stiffness(
    mesh: &Mesh,
    material: &dyn MaterialField,
    base: &[f64],
) -> Triplets {
    sum_around((mesh, material), base, None, ElementGeometry::displacement_stiffness)
}

/// Sums matrices of elements that follow from the displacements of their nodes.
fn sum_around(
    (mesh, material): (&Mesh, &dyn MaterialField),
    base: &[f64],
    region: Option<usize>,
    of: impl Fn(&ElementGeometry, &ElasticMaterial, &[f64]) -> DMatrix<f64>,
) -> Triplets {
    let is_own = |e: usize| region.is_none_or(|region| mesh.region(e) == region);
    let mut sum = ElementSum::new(mesh, &is_own);
    for e in (0..mesh.element_count()).filter(|&e| is_own(e)) {
        let values = element::nodal_values(mesh, e, base);
        sum.add(e, &of(&ElementGeometry::new(mesh, e), material.of(mesh.region(e)), &values));
    }
    sum.finish()
}

/// What damping coefficients of their own, of regions and of patches, add to `alpha_R M + beta_R K_e` of the whole body, Pa s,
/// over all dofs; the first sum by itself.
///
/// ```text
/// sum_e (alpha_e - alpha_R) M_e,   sum_e (beta_e - beta_R) K_e  +  sum_patch (alpha_p M_e + beta_p K_e)
/// ```
pub fn assemble_extra_damping(
    mesh: &Mesh,
    material: &dyn MaterialField,
    kind: MassKind,
    common: RayleighDamping,
) -> [Triplets; 2] {
    let mut parts = [Triplets::default(), assemble_patch_damping(mesh, material, kind)];
    let own: Vec<_> = (0..mesh.regions.len()).map(|region| material.own_damping(region)).collect();
    for e in 0..mesh.element_count() {
        // Nothing of a mesh without regions.
        if let Some(Some(damping)) = own.get(mesh.region(e)) {
            let [mass, stiffness] = element_matrices(mesh, material, kind, e);
            let alpha = damping.mass_coefficient - common.mass_coefficient;
            let beta = damping.stiffness_coefficient - common.stiffness_coefficient;
            let own = [mass * alpha, stiffness * beta];
            parts.iter_mut().zip(&own).for_each(|(part, own)| scatter(part, mesh, e, own));
        }
    }
    parts
}

/// Damping of the patches alone over all dofs.
pub fn assemble_patch_damping(
    mesh: &Mesh,
    material: &dyn MaterialField,
    kind: MassKind,
) -> Triplets {
    let mut triplets = Triplets::default();
    for patch in &mesh.patches {
        let (alpha, beta) = (patch.mass_coefficient, patch.stiffness_coefficient);
        for &e in &patch.elements {
            let [mass, stiffness] = element_matrices(mesh, material, kind, e as usize);
            scatter(&mut triplets, mesh, e as usize, &(mass * alpha + stiffness * beta));
        }
    }
    triplets
}

/// Sums the element matrices of those that are kept, each kind of them computed once.
fn assemble_congruent(
    mesh: &Mesh,
    keep: &dyn Fn(usize) -> bool,
    compute: impl Fn(usize) -> DMatrix<f64>,
) -> Triplets {
    let mut sum = ElementSum::new(mesh, keep);
    // Only what several elements share is kept.
    let mut copies = vec![0_u32; mesh.element_count()];
    mesh.congruent_to.iter().for_each(|&first| copies[first as usize] += 1);
    let mut cache: Vec<Option<DMatrix<f64>>> = vec![None; mesh.element_count()];
    for e in (0..mesh.element_count()).filter(|&e| keep(e)) {
        let first = mesh.congruent_to[e] as usize;
        match copies[first] {
            1 => sum.add(e, &compute(e)),
            _ => sum.add(e, cache[first].get_or_insert_with(|| compute(e))),
        }
    }
    sum.finish()
}

/// Entries of solid bodies that are kept before those of one place are summed: an element shares each of its nodes with many.
const MANY_ENTRIES: usize = 1 << 22;

/// Element matrices on their way into a global one.
struct ElementSum<'a> {
    mesh: &'a Mesh,
    triplets: Triplets,
    /// Entries at which those of one place are summed.
    limit: usize,
}

impl<'a> ElementSum<'a> {
    fn new(mesh: &'a Mesh, keep: &dyn Fn(usize) -> bool) -> Self {
        let mut triplets = Triplets::default();
        let is_solid = mesh.dimension == 3;
        let sizes = (0..mesh.element_count())
            .filter(|&e| keep(e))
            .map(|e| (mesh.dimension * mesh.element_kinds[e].node_count()).pow(2));
        let size: usize = sizes.sum();
        let limit = if is_solid { MANY_ENTRIES } else { usize::MAX };
        triplets.entries.reserve_exact(size.min(limit));
        Self { mesh, triplets, limit }
    }

    fn add(&mut self, element: usize, matrix: &DMatrix<f64>) {
        scatter(&mut self.triplets, self.mesh, element, matrix);
        if self.triplets.entries.len() > self.limit {
            self.triplets.merge();
            self.limit = MANY_ENTRIES + 2 * self.triplets.entries.len();
        }
    }

    fn finish(mut self) -> Triplets {
        if self.mesh.dimension == 3 {
            self.triplets.merge();
        }
        self.triplets
    }
}

fn scatter(triplets: &mut Triplets, mesh: &Mesh, element: usize, matrix: &DMatrix<f64>) {
    let dofs: Vec<usize> = mesh.element_dofs(element).collect();
    for (j, &column) in dofs.iter().enumerate() {
        for (i, &row) in dofs.iter().enumerate() {
            triplets.push(row, column, matrix[(i, j)]);
        }
    }
}
