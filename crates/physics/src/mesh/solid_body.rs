//! Solid bodies of a mesh file: regions, named surfaces, and what holds them.

use super::body::known_instead;
use super::coincidence::refuse_doubled_elements;
use super::error::{BodyError, BodyPart, refuse_far};
use super::faces::{FaceKey, face_key};
use super::plane_body::{file_elements, used_nodes};
use super::{Boundary, BoundaryCondition, BoundaryFace, Mesh, NodalFrames};
use frictionsim_formats::{FileMesh, SurfaceFace};
use nalgebra::{Matrix3, Vector3};
use std::collections::{BTreeMap, BTreeSet};

/// Sine of the angle between two normals up to which they hold the same direction: surfaces that meet smoothly.
const SAME_DIRECTION: f64 = 0.14;

impl Mesh {
    /// The solid bodies of a mesh file: physical volumes are regions, physical surfaces boundaries, both in alphabetical order.
    ///
    /// Boundaries without a condition are free. Surfaces inside a body, between two of its regions, bound nothing and are left
    /// out. Nodal frames are the global axes, but where a guide holds a direction that is none of them. `scale` multiplies the
    /// coordinates of the file.
    ///
    /// # Errors
    /// [`BodyError::Body`] says what is wrong with the mesh or with the names used, and what to do.
    pub fn from_solids(
        file: &FileMesh,
        scale: f64,
        conditions: &[(String, BoundaryCondition)],
    ) -> Result<Self, BodyError> {
        refuse_far(file, scale)?;
        let index_of = used_nodes(file)?;
        let mut mesh = solid_elements(file, scale, &index_of)?;
        let outer = mesh.outer_faces_by_key();
        // Each named surface with its faces on the outside; those that have some inside are no boundaries.
        for (name, faces) in &file.surfaces {
            let found: Option<BTreeMap<FaceKey, BoundaryFace>> = faces
                .iter()
                .map(|(kind, nodes)| {
                    let corners = nodes[..kind.corner_count()].iter();
                    let corners: Option<Vec<u32>> =
                        corners.map(|&node| index_of[node as usize]).collect();
                    let key = face_key(corners?);
                    outer.get(&key).map(|face| (key, face.clone()))
                })
                .collect();
            if let Some(found) = found {
                mesh.boundaries.push(Boundary::of_faces(name, found.into_values().collect()));
            }
        }
        mesh.add_node_sets(file, &index_of, &outer);
        for (name, condition) in conditions {
            let part = BodyPart::Boundary(name.clone());
            let refuse = |message| part.refused(message);
            let Some(boundary) = mesh.boundaries.iter_mut().find(|own| own.name == *name) else {
                return Err(refuse(no_surface(&file.surfaces, name)));
            };
            let needs_faces = !matches!(
                condition,
                BoundaryCondition::Clamped | BoundaryCondition::Fixed(_) | BoundaryCondition::Free
            );
            if needs_faces && !boundary.is_covered() {
                return Err(refuse(format!(
                    "boundaries.{name} is a set of nodes that are not all nodes of some faces: it \
                     can be \"clamped\" or \"fixed\". Name a surface of faces for anything else"
                )));
            }
            boundary.condition = *condition;
        }
        let place = |&(node, axis, factor): &(u32, usize, f64)| {
            index_of[node as usize].map(|node| (node, axis, factor))
        };
        let equations = file.equations.iter().map(|own| own.iter().filter_map(place).collect());
        mesh.equations = equations.collect();
        mesh.turn_frames_to_guides();
        mesh.take_symmetry(file.symmetry, scale);
        Ok(mesh)
    }

    /// Adds sets of nodes that are no surfaces, in alphabetical order among the boundaries; their faces are those whose nodes all
    /// belong to them.
    fn add_node_sets(
        &mut self,
        file: &FileMesh,
        index_of: &[Option<u32>],
        outer: &BTreeMap<FaceKey, BoundaryFace>,
    ) {
        for (name, nodes) in &file.node_sets {
            let nodes: BTreeSet<u32> = nodes.iter().filter_map(|&n| index_of[n as usize]).collect();
            if nodes.is_empty() || self.boundary(name).is_some() {
                continue;
            }
            let own = outer.values().filter(|face| face.nodes.iter().all(|n| nodes.contains(n)));
            let surface = Boundary::of_faces(name, own.cloned().collect());
            self.boundaries.push(Boundary { nodes: nodes.into_iter().collect(), ..surface });
        }
        self.boundaries.sort_by(|a, b| a.name.cmp(&b.name));
    }

    /// Orthonormal directions in which boundary conditions hold each node of a solid body.
    pub(super) fn held_directions(&self) -> BTreeMap<u32, Vec<Vector3<f64>>> {
        let mut held: BTreeMap<u32, Vec<Vector3<f64>>> = BTreeMap::new();
        let mut hold = |node: u32, direction: Vector3<f64>| {
            let basis = held.entry(node).or_default();
            let along = |sum, b: &Vector3<f64>| sum + b * b.dot(&direction);
            let rest = direction - basis.iter().fold(Vector3::zeros(), along);
            if rest.norm() > SAME_DIRECTION {
                basis.push(rest.normalize());
            }
        };
        for boundary in &self.boundaries {
            let axes = match boundary.condition {
                BoundaryCondition::Clamped => [true; 3],
                BoundaryCondition::Fixed(axes) => axes,
                BoundaryCondition::Guide => {
                    for (node, normal) in self.nodal_normals(&boundary.faces) {
                        hold(node, Vector3::from(normal));
                    }
                    continue;
                }
                BoundaryCondition::Support(_)
                | BoundaryCondition::Pressure(_)
                | BoundaryCondition::Free => continue,
            };
            for &node in &boundary.nodes {
                for axis in (0..3).filter(|&axis| axes[axis]) {
                    hold(node, Vector3::ith(axis, 1.0));
                }
            }
        }
        held
    }

    /// Turns the frames of nodes that are held in some, not all, directions such that these are axes.
    pub(super) fn turn_frames_to_guides(&mut self) {
        let mut frames = vec![Matrix3::identity(); self.node_count()];
        for (node, held) in self.held_directions() {
            let is_axis = |d: &Vector3<f64>| d.amax() > 1.0 - 1e-12;
            if held.len() == 3 || held.iter().all(is_axis) {
                continue;
            }
            let mut axes = held;
            // The global axis that is farthest from those there are begins the next one.
            while axes.len() < 3 {
                let rest = |axis: usize| {
                    let e = Vector3::<f64>::ith(axis, 1.0);
                    e - axes.iter().fold(Vector3::zeros(), |sum, b| sum + b * b[axis])
                };
                let rests = [rest(0), rest(1), rest(2)];
                let lengths = rests.map(|rest| rest.norm());
                let best = (0..3).max_by(|&a, &b| lengths[a].total_cmp(&lengths[b]));
                axes.push(rests[best.expect("there are three axes")].normalize());
            }
            frames[node as usize] = Matrix3::from_columns(&axes);
        }
        self.frames = NodalFrames::Solid(frames);
    }

    /// Dofs of a solid body that boundary conditions hold at zero: axes of nodal frames along held directions.
    pub(super) fn held_solid_dofs(&self) -> Vec<usize> {
        let mut dofs = Vec::new();
        for (node, held) in self.held_directions() {
            let frame = self.frame(node as usize);
            for axis in 0..3 {
                let column = frame.column(axis).into_owned();
                let share: f64 = held.iter().map(|b| b.dot(&column).powi(2)).sum();
                if share > 0.99 {
                    dofs.push(3 * node as usize + axis);
                }
            }
        }
        dofs
    }
}

/// Nodes, elements and regions of the solid elements of a file.
pub(super) fn solid_elements(
    file: &FileMesh,
    scale: f64,
    index_of: &[Option<u32>],
) -> Result<Mesh, BodyError> {
    refuse_doubled_elements(file)?;
    let mesh = file_elements(file, (3, scale), index_of, |_, _| {})?;
    mesh.check_elements(|e| file.elements[e].label)?;
    Ok(mesh)
}

fn no_surface(surfaces: &BTreeMap<String, Vec<SurfaceFace>>, name: &str) -> String {
    if surfaces.contains_key(name) {
        return format!(
            "physical surface \"{name}\" does not lie on the outside of the bodies: some of its faces are faces of two elements, \
             or of none"
        );
    }
    let instead = known_instead(surfaces.keys(), name, ["surface", "Surface"]);
    format!("no physical surface is called \"{name}\"; {instead}")
}
