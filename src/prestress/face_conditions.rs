//! Springs, dashpots and pressures on the faces of a body of revolution.

use crate::fem::fold::SectorMatrix;
use crate::fem::solid::{FaceTerm, face_load, face_matrix, whole_element};
use crate::mesh::{BoundaryCondition, SolidFace, SolidSector};

/// Springs and dashpots of every support, N/m and N s/m.
pub fn supports(sector: &SolidSector) -> [SectorMatrix; 2] {
    let none = [SectorMatrix::default(), SectorMatrix::default()];
    each_support(sector)
        .iter()
        .fold(none, |[springs, dashpots], (_, own)| [springs.plus(&own[0]), dashpots.plus(&own[1])])
}

/// Name, springs and dashpots of each supported face.
pub(super) fn each_support(sector: &SolidSector) -> Vec<(&'static str, [SectorMatrix; 2])> {
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
        let mut own = [SectorMatrix::default(), SectorMatrix::default()];
        for (sum, terms) in own.iter_mut().zip(values) {
            for (component, value) in terms.into_iter().filter(|(_, value)| *value != 0.0) {
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
        all.push((face.name(), own));
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
