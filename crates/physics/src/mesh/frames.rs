//! Local frames of the nodes, in which displacements and forces are written.

use nalgebra::Matrix3;

/// Local frame of each node.
#[derive(Clone, Debug, PartialEq)]
pub enum NodalFrames {
    /// Of a plane body, or one of revolution: angle by which `(e_1, e_2)` is turned about z, rad.
    Plane(Vec<f64>),
    /// Of a solid body: unit vectors `e_1, e_2, e_3` as columns.
    Solid(Vec<Matrix3<f64>>),
}

/// Of no nodes.
impl Default for NodalFrames {
    fn default() -> Self {
        Self::Plane(Vec::new())
    }
}

impl NodalFrames {
    /// Global axes at every node.
    pub fn global(dimension: usize, count: usize) -> Self {
        match dimension {
            3 => Self::Solid(vec![Matrix3::identity(); count]),
            _ => Self::Plane(vec![0.0; count]),
        }
    }

    /// Unit vectors of a node's frame as columns.
    pub fn frame(&self, node: usize) -> Matrix3<f64> {
        match self {
            Self::Plane(angles) => {
                let (sin, cos) = angles[node].sin_cos();
                Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
            }
            Self::Solid(frames) => frames[node],
        }
    }
}
