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
    sum_elements((mesh, &|_| true), |e| element_stiffness(mesh, material, e))
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
        MassKind::Consistent => geometry.rotate_scalar(geometry.scalar_mass(elastic)),
        MassKind::Lumped => {
            let (masses, d) = (geometry.lumped_mass(elastic), mesh.dimension);
            let size = d * masses.len();
            DMatrix::from_fn(size, size, |i, j| if i == j { masses[i / d] } else { 0.0 })
        }
    }
}

/// Stiffness of the elements of one region alone, over all dofs: N/m, in the plane for each metre of thickness.
pub fn region_stiffness(mesh: &Mesh, material: &dyn MaterialField, region: usize) -> Triplets {
    sum_elements((mesh, &|e| mesh.region(e) == region), |e| element_stiffness(mesh, material, e))
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
            sum_elements((mesh, keep), |e| element_mass(mesh, material, kind, e))
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
    mesh.attachments.iter().for_each(|attachment| masses[attachment.node] += attachment.mass);
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

/// Sums of element matrices, of all elements or those of one region, that follow from each of the displacements `bases` (all dofs, nodal
/// frames, m): `of` is [`ElementGeometry::geometric_stiffnesses`] or [`ElementGeometry::displacement_stiffnesses`].
pub fn assemble_around(
    (mesh, material): (&Mesh, &dyn MaterialField),
    bases: &[Vec<f64>],
    region: Option<usize>,
    of: impl Fn(&ElementGeometry, &ElasticMaterial, &[Vec<f64>]) -> Vec<DMatrix<f64>> + Sync,
) -> Vec<Triplets> {
    let is_own = |e: usize| region.is_none_or(|region| mesh.region(e) == region);
    sums_of_elements((mesh, &is_own), false, bases.len(), |e| {
        let values = bases.iter().map(|base| element::nodal_values(mesh, e, base));
        let values: Vec<Vec<f64>> = values.collect();
        of(&ElementGeometry::new(mesh, e), material.of(mesh.region(e)), &values)
    })
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

/// Entries of solid bodies that are kept before those of one place are summed: an element shares each of its nodes with many.
const MANY_ENTRIES: usize = 1 << 22;
/// Element matrices that are computed side by side.
const ELEMENTS_AT_A_TIME: usize = 4096;

/// Sums the matrices of the elements that are kept; that of the first of several congruent ones serves all.
fn sum_elements(
    kept: (&Mesh, &dyn Fn(usize) -> bool),
    compute: impl Fn(usize) -> DMatrix<f64> + Sync,
) -> Triplets {
    sums_of_elements(kept, true, 1, |e| vec![compute(e)]).swap_remove(0)
}

/// The same of `count` matrices of each element, which congruent ones share where it `shares`.
fn sums_of_elements(
    (mesh, keep): (&Mesh, &dyn Fn(usize) -> bool),
    shares: bool,
    count: usize,
    compute: impl Fn(usize) -> Vec<DMatrix<f64>> + Sync,
) -> Vec<Triplets> {
    let kept: Vec<usize> = (0..mesh.element_count()).filter(|&e| keep(e)).collect();
    let kind = |e: usize| if shares { mesh.congruent_to[e] as usize } else { e };
    // Only what several elements share is held.
    let mut first: Vec<Option<usize>> = vec![None; mesh.element_count()];
    let mut shared: Vec<usize> = Vec::new();
    for &e in &kept {
        match first[kind(e)] {
            Some(own) => shared.push(own),
            None => first[kind(e)] = Some(e),
        }
    }
    shared.sort_unstable();
    shared.dedup();
    let mut held: Vec<Option<Vec<DMatrix<f64>>>> = vec![None; mesh.element_count()];
    let matrices: Vec<Vec<DMatrix<f64>>> = crate::parallel::map(&shared, |&e| compute(e));
    shared.iter().zip(matrices).for_each(|(&e, own)| held[kind(e)] = Some(own));

    let is_solid = mesh.dimension == 3;
    let sizes = kept.iter().map(|&e| (mesh.dimension * mesh.element_kinds[e].node_count()).pow(2));
    let (size, mut limit): (usize, _) =
        (sizes.sum(), if is_solid { MANY_ENTRIES } else { usize::MAX });
    let mut sums = vec![Triplets::default(); count];
    sums.iter_mut().for_each(|sum| sum.entries.reserve_exact(size.min(limit)));
    for elements in kept.chunks(ELEMENTS_AT_A_TIME) {
        let own = |&e: &usize| held[kind(e)].is_none().then(|| compute(e));
        let own: Vec<Option<Vec<DMatrix<f64>>>> = crate::parallel::map(elements, own);
        for (&e, own) in elements.iter().zip(&own) {
            let matrices = own.iter().chain(&held[kind(e)]).flatten();
            sums.iter_mut().zip(matrices).for_each(|(sum, own)| scatter(sum, mesh, e, own));
            if sums.first().is_some_and(|sum| sum.entries.len() > limit) {
                sums.iter_mut().for_each(Triplets::merge);
                limit = MANY_ENTRIES + 2 * sums[0].entries.len();
            }
        }
    }
    // Plane matrices that elements share add up in the order of elements alone, on alike places alike.
    if is_solid || !shares {
        sums.iter_mut().for_each(Triplets::merge);
    }
    sums
}

fn scatter(triplets: &mut Triplets, mesh: &Mesh, element: usize, matrix: &DMatrix<f64>) {
    let dofs: Vec<usize> = mesh.element_dofs(element).collect();
    for (j, &column) in dofs.iter().enumerate() {
        dofs.iter().enumerate().for_each(|(i, &row)| triplets.push(row, column, matrix[(i, j)]));
    }
}
