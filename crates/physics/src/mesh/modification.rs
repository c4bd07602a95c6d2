//! What changes a mesh after it is made: masses, springs and dashpots at nodes, damping of some elements.

use super::Mesh;
use frictionsim_formats::{FileElement, FileMesh};
use nalgebra::{Matrix3, Vector3};

/// A point mass, and a spring and a dashpot to the ground, at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// 0-based node.
    pub node: usize,
    /// Mass, kg; in the plane for each metre of thickness, as are the others.
    pub mass: f64,
    /// Stiffness over the global axes, N/m.
    pub stiffness: Matrix3<f64>,
    /// Damping over the global axes, N s/m.
    pub damping: Matrix3<f64>,
}

/// Damping `alpha M_e + beta K_e` that some elements have beside that of their material.
#[derive(Clone, Debug, PartialEq)]
pub struct DampedPatch {
    /// The elements.
    pub elements: Vec<u32>,
    /// `alpha`, 1/s.
    pub mass_coefficient: f64,
    /// `beta`, s.
    pub stiffness_coefficient: f64,
}

impl Mesh {
    /// A matrix over the global axes in the frame of a node.
    pub fn in_frame(&self, node: usize, matrix: &Matrix3<f64>) -> Matrix3<f64> {
        let frame = self.frame(node);
        frame.transpose() * matrix * frame
    }

    /// Mean of an element's corners, m.
    pub fn element_middle(&self, element: usize) -> [f64; 3] {
        let corners = self.element_kind(element).corner_count();
        self.middle(&self.element_nodes(element)[..corners]).into()
    }

    /// The elements whose middle lies within a distance of a point.
    pub fn elements_within(&self, center: [f64; 3], radius: f64) -> Vec<u32> {
        let center = Vector3::from(center);
        let is_near =
            |e: &usize| (Vector3::from(self.element_middle(*e)) - center).norm() <= radius;
        (0..self.element_count()).filter(is_near).map(|e| e as u32).collect()
    }

    /// Nodes, elements and boundaries as a file, which has no conditions and no symmetry.
    pub fn to_file(&self) -> FileMesh {
        let name = |region: usize| self.regions[region].as_str().into();
        let element = |e: usize| FileElement {
            label: e + 1,
            kind: self.element_kind(e),
            region: name(self.region(e)),
            entity: self.region(e) as i64,
            nodes: self.element_nodes(e).to_vec(),
        };
        let mut file = FileMesh {
            labels: (0..self.node_count()).map(|node| self.node_label(node)).collect(),
            points: self.nodes.clone(),
            dimension: self.dimension,
            elements: (0..self.element_count()).map(element).collect(),
            is_used: vec![true; self.node_count()],
            equations: self.equations.clone(),
            ..FileMesh::default()
        };
        for boundary in &self.boundaries {
            let (name, faces) = (boundary.name.clone(), boundary.faces.iter());
            if self.dimension == 2 {
                let edges =
                    faces.map(|own| (own.nodes[0], own.nodes[1], own.nodes.get(2).copied()));
                file.curves.insert(name, edges.collect());
            } else if boundary.is_covered() {
                let faces = faces.map(|own| (own.kind, own.nodes.clone()));
                file.surfaces.insert(name, faces.collect());
            } else {
                file.node_sets.insert(name, boundary.nodes.clone());
            }
        }
        file
    }
}
