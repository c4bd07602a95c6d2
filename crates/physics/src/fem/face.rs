//! Supports and pressures on the faces of solid bodies.

use super::Triplets;
use crate::mesh::{BoundaryCondition, BoundaryFace, FacePoint, Mesh};
use nalgebra::{Matrix3, Vector3};

/// Visits the quadrature points of faces with the dofs of the nodes, each with the global direction in which it moves.
fn at_points(
    mesh: &Mesh,
    faces: &[BoundaryFace],
    mut visit: impl FnMut(&FacePoint, &[(usize, Matrix3<f64>)]),
) {
    for face in faces {
        let points = mesh.face_points(face);
        let nodes = face.nodes.iter().map(|&node| node as usize);
        let nodes: Vec<(usize, Matrix3<f64>)> =
            nodes.map(|node| (node, mesh.frame(node))).collect();
        for point in face.kind.quadrature() {
            visit(&face.kind.at(&points, point), &nodes);
        }
    }
}

/// Springs and dashpots of the supports, `∫ N_I N_J F_I^T (k_n n n^T + k_t (1 - n n^T)) F_J dA`; where a face has a stiffness `k_z` of
/// its own along the axis, that is `k_n n n^T + k_t (1 - n n^T - e_z e_z^T) + k_z e_z e_z^T`.
pub(super) fn supports(mesh: &Mesh) -> [Triplets; 2] {
    let mut both = [Triplets::default(), Triplets::default()];
    for boundary in &mesh.boundaries {
        let BoundaryCondition::Support(support) = boundary.condition else {
            continue;
        };
        let [spring, dashpot] = [support.tangential_stiffness, support.tangential_damping];
        // Along the axis there is no dashpot.
        let [axial, axial_damping] =
            support.axial_stiffness.map_or([spring, dashpot], |axial| [axial, 0.0]);
        let laws = [
            [support.normal_stiffness, spring, axial],
            [support.normal_damping, dashpot, axial_damping],
        ];
        at_points(mesh, &boundary.faces, |point, nodes| {
            let vector = Vector3::from(point.area);
            let area = vector.norm();
            let across = vector * vector.transpose() / (area * area);
            for (triplets, law) in both.iter_mut().zip(laws) {
                if law == [0.0; 3] {
                    continue;
                }
                let [normal, tangential, axial] = law;
                let mut law = across * (normal - tangential) + Matrix3::identity() * tangential;
                law[(2, 2)] += axial - tangential;
                for (&(row, row_frame), p) in nodes.iter().zip(&point.values) {
                    for (&(column, column_frame), q) in nodes.iter().zip(&point.values) {
                        let block = row_frame.transpose() * law * column_frame * (area * p * q);
                        triplets.push_block([3 * row, 3 * column], &block);
                    }
                }
            }
        });
    }
    // Springs and dashpots at single nodes.
    for attachment in &mesh.attachments {
        let laws = [&attachment.stiffness, &attachment.damping];
        for (triplets, law) in both.iter_mut().zip(laws) {
            let block = mesh.in_frame(attachment.node, law);
            triplets.push_block([3 * attachment.node; 2], &block);
        }
    }
    both
}

/// Forces of the dead pressures, `- ∫ N_I p F_I^T n dA`; `None` where there is none.
pub(super) fn pressures(mesh: &Mesh) -> Option<Vec<f64>> {
    let mut forces: Option<Vec<f64>> = None;
    for boundary in &mesh.boundaries {
        let BoundaryCondition::Pressure(pressure) = boundary.condition else {
            continue;
        };
        let forces = forces.get_or_insert_with(|| vec![0.0; mesh.dof_count()]);
        at_points(mesh, &boundary.faces, |point, nodes| {
            for (&(node, frame), value) in nodes.iter().zip(&point.values) {
                let force = frame.transpose() * Vector3::from(point.area) * (-pressure * value);
                (0..3).for_each(|axis| forces[3 * node + axis] += force[axis]);
            }
        });
    }
    forces
}
