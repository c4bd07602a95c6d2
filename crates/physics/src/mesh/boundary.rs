//! Named boundaries of a body, and what holds them.

use super::{Counterface, ElementKind, Mesh};
use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;

/// Distributed springs and dashpots along a boundary, for each unit of its area.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElasticSupport {
    /// `k_n`, Pa/m.
    pub normal_stiffness: f64,
    /// `k_t`, Pa/m.
    pub tangential_stiffness: f64,
    /// Along the z axis, on the inner and outer face of a body of revolution, Pa/m: what is tangential acts around the axis
    /// alone. `None` where it acts along all tangents.
    pub axial_stiffness: Option<f64>,
    /// `c_n`, Pa s/m.
    pub normal_damping: f64,
    /// `c_t`, Pa s/m.
    pub tangential_damping: f64,
    /// Structural damping `eta` of its springs, whose stiffness is `k (1 + i eta)` at positive frequencies.
    pub loss_factor: f64,
}

/// What holds a boundary.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum BoundaryCondition {
    /// No motion.
    Clamped,
    /// Springs and dashpots.
    Support(ElasticSupport),
    /// No motion along the normal, free tangentially.
    Guide,
    /// No motion along some of the global axes `(x, y, z)`.
    Fixed([bool; 3]),
    /// A dead pressure that pushes onto the body, Pa.
    Pressure(f64),
    /// Nothing.
    #[default]
    Free,
}

impl BoundaryCondition {
    /// Whether springs or a clamp keep a body from turning with the friction on it.
    pub fn holds_turning(&self) -> bool {
        match self {
            Self::Clamped => true,
            Self::Support(support) => support.tangential_stiffness > 0.0,
            _ => false,
        }
    }
}

/// A face of an element on the surface of a solid body, or an edge on the rim of a plane one.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundaryFace {
    /// Its kind.
    pub kind: ElementKind,
    /// The element that it belongs to.
    pub element: u32,
    /// 0-based nodes in the order of [`ElementKind`], the normal pointing out of the body.
    pub nodes: Vec<u32>,
}

impl BoundaryFace {
    /// Its corners, ends of an edge.
    pub fn corners(&self) -> &[u32] {
        &self.nodes[..self.kind.corner_count()]
    }
}

/// A named part of the surface of a body: a curve of edges in the plane, faces of a solid.
///
/// On the annulus `inner` and `outer`, in order of rising angle; corner and mid-side nodes alike.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Boundary {
    /// Its name.
    pub name: String,
    /// 0-based node indices, of a curve in order along it, of a surface ascending.
    pub nodes: Vec<u32>,
    /// Its faces, or edges in the plane.
    pub faces: Vec<BoundaryFace>,
    /// Tributary length of each node of a plane curve, m. Where the node's frame is that of the contact or of a guide,
    /// `∫ N_i |n . e_i| ds` with `n` the boundary's normal and `e_i` the node's first axis: the force that unit
    /// pressure exerts along that axis. `∫ N_i ds` elsewhere.
    pub tributary_lengths: Vec<f64>,
    /// Direction of the outward normal at each node of a plane curve, an angle from +x, rad; the normals of a surface are
    /// those of its faces.
    pub normal_angles: Vec<f64>,
    /// Whether the curve closes on itself.
    pub is_closed: bool,
    /// What holds it.
    pub condition: BoundaryCondition,
}

impl Boundary {
    /// What supports it, if springs and dashpots do.
    pub fn support(&self) -> Option<&ElasticSupport> {
        if let BoundaryCondition::Support(own) = &self.condition { Some(own) } else { None }
    }

    /// Whether each of its nodes is a node of one of its faces: a set of nodes need not be a surface.
    pub fn is_covered(&self) -> bool {
        let faces = self.faces.iter();
        let nodes: BTreeSet<u32> = faces.flat_map(|face| face.nodes.iter().copied()).collect();
        !nodes.is_empty() && self.nodes.iter().all(|node| nodes.contains(node))
    }

    /// A named surface of some faces, free.
    pub(super) fn of_faces(name: &str, faces: Vec<BoundaryFace>) -> Self {
        let nodes: BTreeSet<u32> = faces.iter().flat_map(|f| f.nodes.iter().copied()).collect();
        let (name, nodes) = (name.to_owned(), nodes.into_iter().collect());
        Self { name, nodes, faces, ..Self::default() }
    }

    /// Puts the nodes of the contact edge in the order in which their places along the counterface rise; a closed edge
    /// begins at the smallest angle from 0 on.
    pub(super) fn order_along(&mut self, mesh: &Mesh) {
        let place = |node: u32| mesh.counterface.place(mesh.plane_node(node as usize));
        let turned = |angle: f64| angle.rem_euclid(std::f64::consts::TAU);
        if let (Counterface::Cylinder { .. }, [first, second, ..]) =
            (mesh.counterface, &self.nodes[..])
        {
            let step = turned(place(*second) - place(*first));
            if step > std::f64::consts::PI {
                self.nodes.reverse();
                self.tributary_lengths.reverse();
                self.normal_angles.reverse();
            }
        }
        if self.is_closed {
            let angles = self.nodes.iter().map(|&node| turned(place(node)));
            let first = angles.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i);
            self.nodes.rotate_left(first);
            self.tributary_lengths.rotate_left(first);
            self.normal_angles.rotate_left(first);
        }
    }
}

impl Mesh {
    /// Dofs that boundary conditions hold at zero.
    ///
    /// A guide holds the axis of the node's frame along its normal; both where neither axis is. A fixed direction of the plane
    /// is held as a guide across it.
    pub fn held_dofs(&self) -> std::vec::IntoIter<usize> {
        if self.dimension == 3 {
            return self.held_solid_dofs().into_iter();
        }
        let mut held = Vec::new();
        for boundary in &self.boundaries {
            for (&node, &normal) in boundary.nodes.iter().zip(&boundary.normal_angles) {
                let node = node as usize;
                let guide = |normal: f64| {
                    let (sin, cos) = (normal - self.frame_angles()[node]).sin_cos();
                    [sin.abs() < 0.99, cos.abs() < 0.99]
                };
                let [first, second] = match boundary.condition {
                    BoundaryCondition::Clamped => [true; 2],
                    BoundaryCondition::Guide => guide(normal),
                    BoundaryCondition::Fixed([x, y, _]) => {
                        let [along, across] = [guide(0.0), guide(FRAC_PI_2)];
                        [0, 1].map(|axis| x && along[axis] || y && across[axis])
                    }
                    _ => [false; 2],
                };
                held.extend(first.then_some(2 * node));
                held.extend(second.then_some(2 * node + 1));
            }
        }
        held.into_iter()
    }
}
