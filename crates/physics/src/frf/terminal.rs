//! Excitation and response degrees of freedom, and the support during the test.

use crate::mesh::Mesh;
use nalgebra::Vector3;

/// How the body is held while it is excited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrfBoundary {
    /// No boundary held, as on the strings of a hammer test.
    Free,
    /// Held as the case says, by default at its outer edge; free where the contact would be.
    Clamped,
    /// Held as the case says and in sliding contact.
    Sliding,
}

/// Direction of a force or of an observed motion, in the frame of the node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Along the radius; along `x` where the body has no axis.
    Radial,
    /// Around the axis, counter-clockwise; along `y` where the body has none.
    Tangential,
    /// Along the axis; plane bodies do not move there. Along `z` where the body has no axis.
    Axial,
    /// Along `x` of the mesh.
    X,
    /// Along `y` of the mesh.
    Y,
    /// Along `z` of the mesh; plane bodies do not move there.
    Z,
}

/// An axis that directions are about: a point of it, m, and its unit vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// A point of it, m.
    pub center: [f64; 3],
    /// Unit vector along it.
    pub direction: [f64; 3],
}

impl Direction {
    /// Its number among those of the mesh, 1 to 3; 0 of one that turns with the node.
    pub fn number(self) -> u32 {
        match self {
            Self::X => 1,
            Self::Y => 2,
            Self::Z => 3,
            Self::Radial | Self::Tangential | Self::Axial => 0,
        }
    }

    /// Its name in case files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Radial => "radial",
            Self::Tangential => "tangential",
            Self::Axial => "axial",
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }

    /// Component of a displacement `(u_r, u_theta, u_z)`; none along the axes of the mesh.
    pub fn component(self) -> Option<usize> {
        match self {
            Self::Radial => Some(0),
            Self::Tangential => Some(1),
            Self::Axial => Some(2),
            Self::X | Self::Y | Self::Z => None,
        }
    }

    /// Unit vector at a node, in the node's frame: of a plane body that frame is the one of radius and tangent, of solid bodies
    /// the three directions are about `axis`, or along `x`, `y`, `z` without one. `None` on the axis itself, where radius and
    /// tangent have no direction.
    pub(super) fn at(self, mesh: &Mesh, node: usize, axis: Option<Axis>) -> Option<Vector3<f64>> {
        let across = match self {
            Self::X => Vector3::x(),
            Self::Y => Vector3::y(),
            Self::Z => Vector3::z(),
            Self::Radial | Self::Tangential | Self::Axial if mesh.dimension == 2 => {
                return self.component().map(|k| Vector3::ith(k, 1.0));
            }
            Self::Radial | Self::Tangential | Self::Axial => match axis {
                None => Vector3::ith(self.component()?, 1.0),
                Some(axis) => {
                    let along = Vector3::from(axis.direction);
                    let arm = Vector3::from(mesh.nodes[node]) - Vector3::from(axis.center);
                    let radius = arm - along * arm.dot(&along);
                    let radial = radius.try_normalize(1e-9 * arm.norm());
                    match self {
                        Self::Axial => along,
                        Self::Tangential => along.cross(&radial?),
                        _ => radial?,
                    }
                }
            },
        };
        Some(mesh.frame(node).transpose() * across)
    }
}

/// A degree of freedom at which the body is excited or observed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Terminal {
    /// Node, counted from 0.
    pub node: usize,
    /// Direction at that node.
    pub direction: Direction,
}
