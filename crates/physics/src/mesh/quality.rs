//! Checks of element shape and of supports that hold the body.

use super::error::BodyError;
use super::{BoundaryCondition, Mesh};
use crate::order::range;
use crate::output::Described;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use serde::Serialize;

/// Sizes and shapes of the elements of a mesh.
///
/// The Jacobian determinants are those at the nodes and quadrature points: their ratio is 1 for parallelograms and
/// straight triangles, not positive for elements that fold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Described, Serialize)]
pub struct MeshQuality {
    /// Shortest edge of any element, m.
    pub smallest_edge_m: f64,
    /// Longest edge, m.
    pub largest_edge_m: f64,
    /// Largest ratio of the edges of one element.
    pub largest_aspect_ratio: f64,
    /// Smallest Jacobian determinant of an element over its largest.
    pub worst_jacobian: f64,
    /// The element that has it.
    #[serde(skip)]
    pub worst_element: usize,
}

impl Mesh {
    /// Jacobian determinant of an element at a parent point, m2 or m3.
    fn jacobian(&self, element: usize, at: [f64; 3]) -> f64 {
        let points = self.element_nodes(element).iter().map(|&node| self.nodes[node as usize]);
        self.element_kind(element).jacobian(at, points).determinant()
    }

    /// Smallest over largest Jacobian determinant of an element.
    pub fn jacobian_ratio(&self, element: usize) -> f64 {
        let kind = self.element_kind(element);
        let quadrature = kind.quadrature().into_iter().map(|(place, _)| place);
        let places = kind.node_places().into_iter().chain(quadrature);
        let [low, high] = range(places.map(|place| self.jacobian(element, place)));
        let largest = high.max(-low);
        if largest > 0.0 { low / largest } else { 0.0 }
    }

    /// Volume of an element of a solid body, m3; area of a plane element, m2, whose quadratic edges are parabolas.
    pub fn element_measure(&self, element: usize) -> f64 {
        let points = self.element_kind(element).quadrature().into_iter();
        points.map(|(place, weight)| weight * self.jacobian(element, place)).sum()
    }

    /// Half the largest extent, m.
    pub fn size(&self) -> f64 {
        let extent = |axis: usize| {
            let [low, high] = range(self.nodes.iter().map(|point| point[axis]));
            high - low
        };
        0.5 * (0..3).map(extent).fold(0.0, f64::max)
    }

    /// Volume of each region of a solid body, m3; area in the plane, m2.
    pub fn region_measures(&self) -> Vec<f64> {
        let mut measures = vec![0.0; self.regions.len()];
        for element in 0..self.element_count() {
            measures[self.region(element)] += self.element_measure(element);
        }
        measures
    }

    /// Area of the body, m2.
    pub fn area(&self) -> f64 {
        (0..self.element_count()).map(|e| self.element_measure(e)).sum()
    }

    /// Quality of all elements.
    pub fn quality(&self) -> MeshQuality {
        let mut quality = MeshQuality {
            worst_jacobian: 1.0,
            worst_element: 0,
            largest_aspect_ratio: 1.0,
            smallest_edge_m: f64::INFINITY,
            largest_edge_m: 0.0,
        };
        for element in 0..self.element_count() {
            let ratio = self.jacobian_ratio(element);
            if ratio < quality.worst_jacobian {
                (quality.worst_jacobian, quality.worst_element) = (ratio, element);
            }
            let (kind, nodes) = (self.element_kind(element), self.element_nodes(element));
            let lengths = kind.edges().iter().map(|ends| {
                let [p, q] = ends.map(|local| self.nodes[nodes[local] as usize]);
                (p[0] - q[0]).hypot(p[1] - q[1]).hypot(p[2] - q[2])
            });
            let [low, high] = range(lengths);
            quality.smallest_edge_m = quality.smallest_edge_m.min(low);
            quality.largest_edge_m = quality.largest_edge_m.max(high);
            quality.largest_aspect_ratio = quality.largest_aspect_ratio.max(high / low);
        }
        quality
    }

    /// Refuses elements that fold where they are integrated or have a node twice; `label` gives the number in the file. One whose corner
    /// alone folds is only badly shaped, see [`Self::quality`].
    pub(super) fn check_elements(&self, label: impl Fn(usize) -> usize) -> Result<(), BodyError> {
        let is_folded = |&element: &usize| {
            let (kind, nodes) = (self.element_kind(element), self.element_nodes(element));
            let mut places = kind.quadrature().into_iter().chain(kind.stiffness_quadrature());
            places.any(|(place, _)| !(self.jacobian(element, place) > 0.0))
                || kind.edges().iter().any(|&[i, j]| nodes[i] == nodes[j])
        };
        let Some(element) = (0..self.element_count()).find(is_folded) else { return Ok(()) };
        let nodes = self.element_nodes(element).iter();
        let nodes: Vec<_> = nodes.map(|&n| self.labels[n as usize].to_string()).collect();
        let [what, again] = if self.dimension == 3 { ["volume"; 2] } else { ["area", "surface"] };
        Err(BodyError::Body(format!(
            "element {} (nodes {}) is inverted or has no {what}: its Jacobian is not positive everywhere; mesh the \
             {again} again, finer where it curves",
            label(element),
            nodes.join(", ")
        )))
    }

    /// Refuses a plane body, or a part of it that is not connected to the rest, that can move as a rigid whole.
    ///
    /// Boundaries and springs at nodes hold it. Sliding friction holds nothing: contact counts along its normal only.
    ///
    /// # Errors
    /// [`BodyError::Body`] names the part.
    pub fn check_held(&self) -> Result<(), BodyError> {
        let part = self.bodies();
        let parts = part.iter().max().map_or(0, |&last| last + 1);
        let size = self.nodes.iter().fold(0.0_f64, |m, p| m.max(p[0].abs()).max(p[1].abs()));
        let mut held = vec![Matrix3::<f64>::zeros(); parts];
        for (b, boundary) in self.boundaries.iter().enumerate() {
            let (along, across) = match boundary.condition {
                _ if b == self.contact => (true, false),
                BoundaryCondition::Clamped => (true, true),
                BoundaryCondition::Support(support) => {
                    (support.normal_stiffness > 0.0, support.tangential_stiffness > 0.0)
                }
                BoundaryCondition::Guide => (true, false),
                // Held along x, along y.
                BoundaryCondition::Fixed([x, y, _]) => (x, y),
                BoundaryCondition::Pressure(_) | BoundaryCondition::Free => (false, false),
            };
            for (&node, &normal) in boundary.nodes.iter().zip(&boundary.normal_angles) {
                let mut hold = |angle: f64| {
                    let (sin, cos) = angle.sin_cos();
                    let [x, y] = self.plane_node(node as usize);
                    let row = Vector3::new(cos, sin, (x * sin - y * cos) / size);
                    held[part[node as usize]] += row * row.transpose();
                };
                let normal = match boundary.condition {
                    _ if b == self.contact => self.frame_angles()[node as usize],
                    BoundaryCondition::Fixed(_) => 0.0,
                    _ => normal,
                };
                if along {
                    hold(normal);
                }
                if across {
                    hold(normal + std::f64::consts::FRAC_PI_2);
                }
            }
        }
        for attachment in &self.attachments {
            let largest = attachment.stiffness.amax();
            if largest > 0.0 {
                let [x, y] = self.plane_node(attachment.node).map(|at| at / size);
                let moves = Matrix3::new(1.0, 0.0, -y, 0.0, 1.0, x, 0.0, 0.0, 0.0);
                let stiffness = attachment.stiffness / largest;
                held[part[attachment.node]] += moves.transpose() * stiffness * moves;
            }
        }
        for (k, held) in held.into_iter().enumerate() {
            let eigen = SymmetricEigen::new(held);
            let (low, high) = (eigen.eigenvalues.min(), eigen.eigenvalues.max());
            if !(low > 1e-9 * high && high > 0.0) {
                return Err(self.not_held(&part, k));
            }
        }
        Ok(())
    }

    /// What to do about the part `k` that nothing holds, of the `part` of each node.
    fn not_held(&self, part: &[usize], k: usize) -> BodyError {
        let is_one = part.iter().all(|&p| p == k);
        let node = part.iter().position(|&p| p == k).expect("every part has a node");
        let [x, y] = self.plane_node(node);
        let mut names: Vec<&str> = self.boundaries.iter().map(|b| b.name.as_str()).collect();
        names.remove(self.contact);
        let unmerged = match self.unmerged_nodes() {
            Some(found) if !is_one => {
                format!("; {found}: merge the parts (Coherence Mesh; in Gmsh) if they are one body")
            }
            _ => String::new(),
        };
        BodyError::Body(format!(
            "nothing holds {} (with node {} at {x:.4e}, {y:.4e} m): it can move as a rigid body, for sliding friction holds nothing. \
             Give one of its boundaries ({}) condition = \"clamped\" under [boundaries.NAME], or springs under \
             [modifications.NAME]{unmerged}",
            if is_one { "the body" } else { "a part of the body that touches no other" },
            self.node_label(node),
            names.join(", ")
        ))
    }
}
