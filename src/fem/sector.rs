//! Matrices of one sector of a body of equal sectors, in the plane and in space: stiffness, mass, geometric stiffness.
//!
//! Dofs are `d k + c`, component `c` (radial, tangential, axial) of sector node `k`; for their order see [`SectorMesh`].

use super::element::ElementGeometry;
use super::fold::{SectorMatrix, WaveDofs};
use super::solid::{FaceTerm, face_matrix, whole_element};
use super::{ElasticMaterial, MassKind, MaterialField, RayleighDamping};
use crate::mesh::{BoundaryCondition, Mesh, NodalSupport, SectorMesh, SolidFace, SolidSector};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;
use std::rc::Rc;

/// One sector of a body of equal sectors.
pub trait Sectored {
    /// Its elements, with the nodes of the sector and of the next one, in equal order.
    fn strip(&self) -> &Mesh;

    /// Sector node of a node of the strip, and its angle in halves of a sector.
    fn place(&self, node: usize) -> (usize, usize);

    /// The dofs that nothing holds.
    fn wave_dofs(&self) -> WaveDofs;

    /// Each supported boundary.
    fn supports(&self) -> Vec<SectorSupport>;

    /// The same with nothing that holds it.
    fn unheld(&self) -> Self;
}

/// A supported boundary of a sector.
#[derive(Clone, Debug)]
pub struct SectorSupport {
    /// Its name.
    pub name: String,
    /// Springs and dashpots: N/m and N s/m, in the plane Pa and Pa s.
    pub terms: [SectorMatrix; 2],
    /// Structural damping of the springs.
    pub loss_factor: f64,
}

impl Sectored for SectorMesh {
    fn strip(&self) -> &Mesh {
        &self.strip
    }

    fn place(&self, node: usize) -> (usize, usize) {
        (self.sector_node_of[node], self.half_steps[node])
    }

    fn wave_dofs(&self) -> WaveDofs {
        let free = 2 * self.free_node_count();
        let of_one_body = if self.specification.element.is_quadratic() { 9 } else { 3 };
        // Room for the contact of two bodies, in which a node of the shaft takes part in the motion of the pair.
        let pair = self.specification.shaft.map_or(0, |_| 2 * self.contact_count);
        let (dofs, sectors) = (2 * self.node_count(), self.sector_count());
        WaveDofs::new(dofs, |dof| dof >= free, of_one_body + pair, sectors)
    }

    fn supports(&self) -> Vec<SectorSupport> {
        let boundaries = &self.strip.boundaries;
        let of = |own: usize| {
            let BoundaryCondition::Support(support) = boundaries[own].condition else {
                return None;
            };
            // The sector with this support alone.
            let mut alone = self.strip.clone();
            for (other, boundary) in alone.boundaries.iter_mut().enumerate() {
                if other != own {
                    boundary.condition = BoundaryCondition::Free;
                }
            }
            let nodal = alone.nodal_supports();
            let sum = |part: fn(&NodalSupport) -> [[f64; 2]; 2]| {
                let own = nodal.iter().map(|support| {
                    let matrix = part(support);
                    let node = [(self.sector_node_of[support.node], 0)];
                    (node, DMatrix::from_fn(2, 2, |row, column| matrix[row][column]))
                });
                SectorMatrix::sum(2, own)
            };
            let terms = [sum(|support| support.stiffness), sum(|support| support.damping)];
            let name = boundaries[own].name.clone();
            Some(SectorSupport { name, terms, loss_factor: support.loss_factor })
        };
        (0..boundaries.len()).filter_map(of).collect()
    }

    fn unheld(&self) -> Self {
        let mut free = Self { clamped_count: 0, ..self.clone() };
        free.specification.outer = BoundaryCondition::Free;
        for boundary in &mut free.strip.boundaries {
            boundary.condition = BoundaryCondition::Free;
        }
        free
    }
}

impl Sectored for SolidSector {
    fn strip(&self) -> &Mesh {
        &self.strip
    }

    fn place(&self, node: usize) -> (usize, usize) {
        let (sector, node) = (node / self.node_count(), node % self.node_count());
        (node, 2 * sector + self.nodes[node].half_step)
    }

    fn wave_dofs(&self) -> WaveDofs {
        let half_bandwidth = 3 * self.node_bandwidth() + 2;
        let (dofs, sectors) = (3 * self.node_count(), self.sector_count());
        WaveDofs::new(dofs, |dof| self.is_held(dof), half_bandwidth, sectors)
    }

    fn supports(&self) -> Vec<SectorSupport> {
        supported_faces(self)
    }

    fn unheld(&self) -> Self {
        let mut free = self.clone();
        free.specification.conditions = [BoundaryCondition::Free; 4];
        free
    }
}

/// Regions of a sector, with a material each.
pub fn region_count<S: Sectored>(sector: &S) -> usize {
    sector.strip().regions.len().max(1)
}

/// Sector nodes of an element with their angles in halves of a sector.
fn places<S: Sectored>(sector: &S, element: usize) -> Vec<(usize, usize)> {
    let nodes = sector.strip().element_nodes(element).iter();
    nodes.map(|&node| sector.place(node as usize)).collect()
}

/// Springs and dashpots of all supports of a sector together.
pub fn supports<S: Sectored>(sector: &S) -> [SectorMatrix; 2] {
    let all = sector.supports();
    [0, 1].map(|part| {
        let own = all.iter().map(|own| &own.terms[part]);
        own.fold(SectorMatrix::default(), |sum, own| sum.plus(own))
    })
}

/// Sums the element matrices `compute(e, material)` (nodal frames) of the elements of a region, or of all.
fn assemble<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    region: Option<usize>,
    compute: impl Fn(&ElementGeometry, &ElasticMaterial) -> DMatrix<f64>,
) -> SectorMatrix {
    let mut known: BTreeMap<usize, Rc<DMatrix<f64>>> = BTreeMap::new();
    let strip = sector.strip();
    let mut matrix_of = |e: usize| {
        let own = strip.congruent_to[e] as usize;
        let geometry = || ElementGeometry::new(strip, own);
        let new = || Rc::new(compute(&geometry(), material.of(strip.region(own))));
        Rc::clone(known.entry(own).or_insert_with(new))
    };
    let is_own = |e: &usize| region.is_none_or(|region| strip.region(*e) == region);
    let elements = (0..strip.element_count()).filter(is_own);
    SectorMatrix::sum(strip.dimension, elements.map(|e| (places(sector, e), matrix_of(e))))
}

/// Elastic stiffness `K_e` of one sector without its supports, or of one of its regions: N/m, in the plane Pa.
pub fn stiffness_of<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    region: Option<usize>,
) -> SectorMatrix {
    assemble(sector, material, region, |geometry, own| geometry.stiffness(own).stiffness)
}

/// [`stiffness_of`] all regions.
pub fn stiffness<S: Sectored>(sector: &S, material: &dyn MaterialField) -> SectorMatrix {
    stiffness_of(sector, material, None)
}

/// Mass of one sector or of one of its regions, consistent or lumped: kg, in the plane kg/m.
pub fn mass_of<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    kind: MassKind,
    region: Option<usize>,
) -> SectorMatrix {
    assemble(sector, material, region, |geometry, own| match kind {
        MassKind::Consistent => geometry.consistent_mass(own),
        MassKind::Lumped => {
            let masses = geometry.lumped_mass(own).into_iter();
            let each = masses.flat_map(|mass| [mass; 3].into_iter().take(geometry.dimension()));
            DMatrix::from_diagonal(&DVector::from_vec(each.collect()))
        }
    })
}

/// [`mass_of`] all regions.
pub fn mass<S: Sectored>(sector: &S, material: &dyn MaterialField, kind: MassKind) -> SectorMatrix {
    mass_of(sector, material, kind, None)
}

/// Damping that regions have in place of the `common` one,
/// `sum_r (alpha_r - alpha) M_r + (beta_r - beta) K_r`: N s/m, in the plane Pa s.
pub fn extra_damping<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    kind: MassKind,
    common: RayleighDamping,
) -> SectorMatrix {
    let regions = 0..region_count(sector);
    let own = regions.filter_map(|r| Some((r, material.own_damping(r)?)).filter(|o| o.1 != common));
    let terms = own.flat_map(|(region, own)| {
        let alpha = own.mass_coefficient - common.mass_coefficient;
        let beta = own.stiffness_coefficient - common.stiffness_coefficient;
        let mass = mass_of(sector, material, kind, Some(region));
        let stiffness = stiffness_of(sector, material, Some(region));
        [mass.scaled(alpha), stiffness.scaled(beta)]
    });
    terms.fold(SectorMatrix::default(), |sum, own| sum.plus(&own))
}

/// Geometric stiffness `∫ (grad N_I . sigma . grad N_J) I dV` of a region for the stress that a displacement, the same in every
/// sector, causes, the amplitudes of the incompatible modes that come with it included: N/m, in the plane Pa.
///
/// `displacement` holds the components of each sector node, m. One without tangential components gives a matrix of even parity, a purely tangential one of odd parity.
pub fn geometric_stiffness<S: Sectored>(
    sector: &S,
    material: &dyn MaterialField,
    region: usize,
    displacement: &[f64],
) -> SectorMatrix {
    let mut known: BTreeMap<u32, Option<DMatrix<f64>>> = BTreeMap::new();
    let (own, strip) = (material.of(region), sector.strip());
    let elements = (0..strip.element_count()).filter(|e| strip.region(*e) == region);
    let matrices = elements.map(|e| {
        let (nodes, geometry) = (places(sector, e), ElementGeometry::new(strip, e));
        let dofs = nodes.iter().flat_map(|(node, _)| (0..strip.dimension).map(move |c| (node, c)));
        let values = dofs.map(|(node, c)| displacement[strip.dimension * node + c]);
        let values = DVector::from_iterator(strip.dimension * nodes.len(), values);
        let alike = strip.congruent_to[e];
        let recovered = || ElementGeometry::new(strip, alike as usize).recovered(own);
        let recovered = known.entry(alike).or_insert_with(recovered);
        let internal = recovered.as_ref().map(|recovered| recovered * &values);
        (nodes, geometry.geometric_stiffness(own, values.as_slice(), internal.as_ref()))
    });
    SectorMatrix::sum(strip.dimension, matrices)
}

/// Each supported face.
fn supported_faces(sector: &SolidSector) -> Vec<SectorSupport> {
    let mut all = Vec::new();
    for (face, condition) in SolidFace::ALL.into_iter().zip(&sector.specification.conditions) {
        let BoundaryCondition::Support(support) = condition else {
            continue;
        };
        let elements = sector.face_elements(face);
        let (normal, across) = (face.normal_component(), face.across_component());
        // Across, a face is tangential like around; a cylinder has its own word for it.
        let is_cylinder = normal == 0;
        let axial =
            if is_cylinder { support.axial_stiffness } else { support.tangential_stiffness };
        let axial_damping = if is_cylinder { 0.0 } else { support.tangential_damping };
        let values = [
            [
                (normal, support.normal_stiffness),
                (1, support.tangential_stiffness),
                (across, axial),
            ],
            [
                (normal, support.normal_damping),
                (1, support.tangential_damping),
                (across, axial_damping),
            ],
        ];
        let mut terms = [SectorMatrix::default(), SectorMatrix::default()];
        for (sum, values) in terms.iter_mut().zip(values) {
            for (component, value) in values.into_iter().filter(|(_, value)| *value != 0.0) {
                let term = FaceTerm {
                    row: component,
                    column: component,
                    weight: &|_, _, _| value,
                    span: &whole_element,
                    is_nodal: false,
                };
                *sum = sum.plus(&face_matrix(sector, &elements, &term));
            }
        }
        let name = face.name().to_owned();
        all.push(SectorSupport { name, terms, loss_factor: support.loss_factor });
    }
    all
}
