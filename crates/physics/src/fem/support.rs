//! Supports and pressures on the boundaries of bodies.

use super::Triplets;
use crate::mesh::{Boundary, BoundaryCondition, BoundaryFace, ElasticSupport, FacePoint, Mesh};
use nalgebra::{Matrix2, Matrix3, Vector3};
use std::collections::BTreeMap;

/// Visits the quadrature points of faces with the dofs of the nodes, each with the global direction in which it moves.
fn at_points(
    mesh: &Mesh,
    faces: &[BoundaryFace],
    mut visit: impl FnMut(&FacePoint, &[(usize, Matrix3<f64>)]),
) {
    for face in faces {
        let nodes = face.nodes.iter().map(|&node| node as usize);
        let nodes: Vec<(usize, Matrix3<f64>)> =
            nodes.map(|node| (node, mesh.frame(node))).collect();
        mesh.quadrature(face).for_each(|point| visit(&point, &nodes));
    }
}

/// Springs and dashpots of the supports over all dofs, N/m and N s/m, in the plane for each metre of thickness; empty where
/// nothing is supported.
pub fn assemble_supports(mesh: &Mesh) -> [Triplets; 2] {
    let mut both = assemble_attachments(mesh);
    let supported = mesh.boundaries.iter().filter_map(|own| Some((own, own.support()?)));
    supported.for_each(|own| add_support(mesh, own, &mut both));
    both
}

/// [`assemble_supports`] of one boundary, and the loss factor of its springs; `None` where it has none.
pub fn assemble_support(mesh: &Mesh, boundary: &Boundary) -> Option<([Triplets; 2], f64)> {
    let (support, mut both) = (boundary.support()?, <[Triplets; 2]>::default());
    add_support(mesh, (boundary, support), &mut both);
    Some((both, support.loss_factor))
}

/// [`assemble_supports`] on the faces of each element that has some: what a body loses with the element.
pub fn element_supports(mesh: &Mesh) -> BTreeMap<u32, [Triplets; 2]> {
    let mut all = BTreeMap::<u32, [Triplets; 2]>::new();
    for boundary in &mesh.boundaries {
        let Some(support) = boundary.support() else { continue };
        let mut faces: BTreeMap<u32, Vec<BoundaryFace>> = BTreeMap::new();
        for face in &boundary.faces {
            faces.entry(face.element).or_default().push(face.clone());
        }
        for (element, faces) in faces {
            let mut lengths: BTreeMap<usize, f64> = BTreeMap::new();
            at_points(mesh, &faces, |point, nodes| {
                for ((node, _), value) in nodes.iter().zip(&point.values) {
                    *lengths.entry(*node).or_default() += value * Vector3::from(point.area).norm();
                }
            });
            let angle = |node: &u32| boundary.nodes.iter().position(|own| own == node);
            let angle = |node: &u32| boundary.normal_angles.get(angle(node)?).copied();
            let nodes: Vec<u32> = lengths.keys().map(|&node| node as u32).collect();
            let part = Boundary {
                normal_angles: nodes.iter().filter_map(angle).collect(),
                tributary_lengths: lengths.into_values().collect(),
                nodes,
                faces,
                ..Boundary::default()
            };
            add_support(mesh, (&part, support), all.entry(element).or_default());
        }
    }
    all
}

/// Adds springs and dashpots of a boundary: of a solid `∫ N_I N_J F_I^T (k_n n n^T + k_t (1 - n n^T)) F_J dA`, in the plane node by
/// node with its tributary lengths as weights, `w_i (k_n n n^T + k_t t t^T)`.
///
/// Where a face has a stiffness `k_z` of its own along the axis, that is `k_n n n^T + k_t (1 - n n^T - e_z e_z^T) + k_z e_z e_z^T`.
fn add_support(
    mesh: &Mesh,
    (boundary, support): (&Boundary, &ElasticSupport),
    both: &mut [Triplets; 2],
) {
    let laws = [
        [support.normal_stiffness, support.tangential_stiffness],
        [support.normal_damping, support.tangential_damping],
    ];
    if mesh.dimension == 2 {
        let nodes = boundary.nodes.iter().zip(&boundary.tributary_lengths);
        for ((&node, &length), &normal) in nodes.zip(&boundary.normal_angles) {
            let node = node as usize;
            // A multiple of a quarter turn leaves the matrix exactly diagonal.
            let turn = normal - mesh.frame_angles()[node];
            let is_straight = turn.sin().abs() < 1e-12;
            let (sin, cos) = if is_straight { (0.0, 1.0) } else { turn.sin_cos() };
            // k_n n n^T + k_t t t^T in the frame of the node, which is turned against the normal.
            for (triplets, [along, across]) in both.iter_mut().zip(laws) {
                let coupling = length * (along - across) * sin * cos;
                let first = length * (along * cos * cos + across * sin * sin);
                let second = length * (along * sin * sin + across * cos * cos);
                let block = Matrix2::new(first, coupling, coupling, second);
                triplets.push_block([2 * node; 2], &block);
            }
        }
        return;
    }
    // Along the axis there is no dashpot.
    let axial = support.axial_stiffness.map_or(laws.map(|[_, own]| own), |axial| [axial, 0.0]);
    at_points(mesh, &boundary.faces, |point, nodes| {
        let vector = Vector3::from(point.area);
        let area = vector.norm();
        let across = vector * vector.transpose() / (area * area);
        for ((triplets, [normal, tangential]), axial) in both.iter_mut().zip(laws).zip(axial) {
            if [normal, tangential, axial] == [0.0; 3] {
                continue;
            }
            // k_n n n^T + k_t (1 - n n^T), and along the axis what that has in place of k_t.
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

/// [`assemble_supports`] of what is attached to single nodes.
pub fn assemble_attachments(mesh: &Mesh) -> [Triplets; 2] {
    let (d, mut both) = (mesh.dimension, <[Triplets; 2]>::default());
    for attachment in &mesh.attachments {
        let laws = [&attachment.stiffness, &attachment.damping];
        for (triplets, law) in both.iter_mut().zip(laws) {
            let block = mesh.in_frame(attachment.node, law);
            for (i, j) in (0..d * d).map(|k| (k / d, k % d)).filter(|at| block[*at] != 0.0) {
                triplets.push(d * attachment.node + i, d * attachment.node + j, block[(i, j)]);
            }
        }
    }
    both
}

/// Forces of the dead boundary pressures over all dofs in nodal frames, `- ∫ N_I p F_I^T n dA`, N, in the plane for each metre of
/// thickness; `None` where there is none.
pub fn assemble_pressures(mesh: &Mesh) -> Option<Vec<f64>> {
    let mut forces: Option<Vec<f64>> = None;
    for boundary in &mesh.boundaries {
        let BoundaryCondition::Pressure(pressure) = boundary.condition else { continue };
        let forces = forces.get_or_insert_with(|| vec![0.0; mesh.dof_count()]);
        if mesh.dimension == 2 {
            let nodes = boundary.nodes.iter().zip(&boundary.tributary_lengths);
            for ((&node, &length), &normal) in nodes.zip(&boundary.normal_angles) {
                let node = node as usize;
                let (sin, cos) = (normal - mesh.frame_angles()[node]).sin_cos();
                forces[2 * node] -= pressure * length * cos;
                forces[2 * node + 1] -= pressure * length * sin;
            }
            continue;
        }
        at_points(mesh, &boundary.faces, |point, nodes| {
            for (&(node, frame), value) in nodes.iter().zip(&point.values) {
                let force = frame.transpose() * Vector3::from(point.area) * (-pressure * value);
                (0..3).for_each(|axis| forces[3 * node + axis] += force[axis]);
            }
        });
    }
    forces
}
