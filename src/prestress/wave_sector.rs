//! What the waves of a sector need beside its elements: its nodes, springs, dashpots and pressures on its boundaries.

use crate::fem::MaterialField;
use crate::fem::fold::SectorMatrix;
use crate::fem::sector::{Sectored, stiffness};
use crate::fem::solid::{FaceTerm, face_load, face_matrix, whole_element};
use crate::mesh::{BoundaryCondition, NodalSupport, SectorMesh, SolidFace, SolidSector};
use nalgebra::DMatrix;

/// A sector with its nodes and supports.
pub trait WaveSector: Sectored {
    /// Sector node of each node of a sector, in the order of the mesh, and its angle in halves of a sector.
    fn nodes(&self) -> Vec<(usize, usize)>;

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

impl WaveSector for SectorMesh {
    fn nodes(&self) -> Vec<(usize, usize)> {
        let own = self.sector_node_of[..self.node_count()].iter();
        own.map(|&node| (node, self.half_step(node))).collect()
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
        self.clone().with_free_outer_edge()
    }
}

impl WaveSector for SolidSector {
    fn nodes(&self) -> Vec<(usize, usize)> {
        self.nodes.iter().map(|node| node.half_step).enumerate().collect()
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

/// Springs and dashpots of all supports of a sector together.
pub fn supports<S: WaveSector>(sector: &S) -> [SectorMatrix; 2] {
    let all = sector.supports();
    [0, 1].map(|part| {
        let own = all.iter().map(|own| &own.terms[part]);
        own.fold(SectorMatrix::default(), |sum, own| sum.plus(own))
    })
}

/// Stiffness of one sector with the springs of its supports.
pub fn supported_stiffness<S: WaveSector>(
    sector: &S,
    material: &dyn MaterialField,
) -> SectorMatrix {
    let [springs, _] = supports(sector);
    stiffness(sector, material).plus(&springs)
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

/// Forces of the pressures on the faces, the same in every sector, N.
pub fn pressure_load(sector: &SolidSector) -> Vec<f64> {
    let mut load = vec![0.0; 3 * sector.node_count()];
    for (face, condition) in SolidFace::ALL.into_iter().zip(&sector.specification.conditions) {
        if let BoundaryCondition::Pressure(pressure) = condition {
            let unit = face_load(sector, &sector.face_elements(face), face.normal_component());
            let factor = pressure * face.inward_sign();
            load.iter_mut().zip(unit).for_each(|(sum, value)| *sum += factor * value);
        }
    }
    load
}
