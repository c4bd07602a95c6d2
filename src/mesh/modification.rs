//! What changes a mesh after it is made: masses, springs and dashpots at nodes, damping of some elements; and what changes a
//! mesh file before it becomes a body: elements taken away, a curve moved.

use super::Mesh;
use super::gmsh::{CurveEdge, FileElement, GmshFile};
use nalgebra::Matrix3;
use std::collections::{BTreeMap, BTreeSet};

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
        let nodes = self.element_nodes(element)[..corners].iter();
        middle(nodes.map(|&node| self.nodes[node as usize]))
    }

    /// The elements whose middle lies within a distance of a point.
    pub fn elements_within(&self, center: [f64; 3], radius: f64) -> Vec<u32> {
        let is_near = |e: &usize| distance(self.element_middle(*e), center) <= radius;
        let near = (0..self.element_count()).filter(is_near);
        near.map(|e| e as u32).collect()
    }
}

impl GmshFile {
    /// A generated plane mesh as a file, its nodes numbered from 1.
    pub fn of_mesh(mesh: &Mesh) -> Self {
        let name = |region: usize| mesh.regions[region].as_str().into();
        let element = |e: usize| FileElement {
            label: e + 1,
            kind: mesh.element_kind(e),
            region: name(mesh.region(e)),
            entity: mesh.region(e) as i64,
            nodes: mesh.element_nodes(e).to_vec(),
        };
        let curves = mesh.boundaries.iter().map(|boundary| {
            let edges = boundary.faces.iter().map(|face| {
                let nodes = &face.nodes;
                (nodes[0], nodes[1], nodes.get(2).copied())
            });
            (boundary.name.clone(), edges.collect())
        });
        Self {
            labels: (1..=mesh.node_count()).collect(),
            points: mesh.nodes.clone(),
            dimension: mesh.dimension,
            elements: (0..mesh.element_count()).map(element).collect(),
            curves: curves.collect(),
            is_used: vec![true; mesh.node_count()],
            ..Self::default()
        }
    }

    /// Mean of an element's corners, in the unit of the file.
    pub fn element_middle(&self, element: &FileElement) -> [f64; 3] {
        let corners = element.nodes[..element.kind.corner_count()].iter();
        middle(corners.map(|&node| self.points[node as usize]))
    }

    /// The file without some elements, and without the edges and faces of its curves and surfaces that bounded these alone.
    pub fn without(&self, is_removed: impl Fn(&FileElement) -> bool) -> Self {
        let kept = self.elements.iter().filter(|element| !is_removed(element));
        let elements: Vec<FileElement> = kept.cloned().collect();
        let mut elements_of: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (e, element) in elements.iter().enumerate() {
            for &node in &element.nodes {
                elements_of.entry(node).or_default().push(e);
            }
        }
        let has_element = |nodes: &[u32]| {
            let around = elements_of.get(&nodes[0]).into_iter().flatten();
            let mut around = around.map(|&e| &elements[e].nodes);
            around.any(|own| nodes.iter().all(|node| own.contains(node)))
        };
        let curves = self.curves.iter().map(|(name, edges)| {
            let edges = edges.iter().filter(|edge| has_element(&[edge.0, edge.1]));
            (name.clone(), edges.copied().collect::<Vec<CurveEdge>>())
        });
        let surfaces = self.surfaces.iter().map(|(name, faces)| {
            let faces = faces.iter().filter(|(_, nodes)| has_element(nodes));
            (name.clone(), faces.cloned().collect::<Vec<_>>())
        });
        let node_sets = self.node_sets.iter().map(|(name, nodes)| {
            let nodes = nodes.iter().filter(|&node| elements_of.contains_key(node));
            (name.clone(), nodes.copied().collect::<Vec<u32>>())
        });
        Self {
            curves: curves.filter(|(_, edges)| !edges.is_empty()).collect(),
            surfaces: surfaces.filter(|(_, faces)| !faces.is_empty()).collect(),
            node_sets: node_sets.filter(|(_, nodes)| !nodes.is_empty()).collect(),
            elements,
            symmetry: None,
            ..self.clone()
        }
    }

    /// The plane file with one of its curves moved by a vector, in the unit of the file: nodes between it and the other curves
    /// follow in the ratio of their distances from both. `None` where it has no such curve or no other one.
    pub fn with_curve_moved(&self, name: &str, [dx, dy]: [f64; 2]) -> Option<Self> {
        let nodes_of = |edges: &[CurveEdge]| -> BTreeSet<u32> {
            let ends = edges.iter().flat_map(|edge| [Some(edge.0), Some(edge.1), edge.2]);
            ends.flatten().collect()
        };
        let moved = nodes_of(self.curves.get(name)?);
        let others = self.curves.iter().filter(|(other, _)| *other != name);
        let held: BTreeSet<u32> = others.flat_map(|(_, edges)| nodes_of(edges)).collect();
        if held.is_empty() {
            return None;
        }
        let nearest = |point: [f64; 3], nodes: &BTreeSet<u32>| {
            let away = nodes.iter();
            let away = away.map(|&node| distance(point, self.points[node as usize]));
            away.fold(f64::INFINITY, f64::min)
        };
        let place = |&point: &[f64; 3]| {
            let [from, to] = [&moved, &held].map(|nodes| nearest(point, nodes));
            let share = to / (from + to);
            [point[0] + share * dx, point[1] + share * dy, point[2]]
        };
        Some(Self {
            points: self.points.iter().map(place).collect(),
            symmetry: None,
            ..self.clone()
        })
    }
}

/// Mean of some points.
fn middle(points: impl ExactSizeIterator<Item = [f64; 3]>) -> [f64; 3] {
    let count = points.len() as f64;
    let sum = points.fold([0.0; 3], |sum, p| [0, 1, 2].map(|k| sum[k] + p[k]));
    sum.map(|x| x / count)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}
