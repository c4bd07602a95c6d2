//! Excitation and response degrees of freedom, and the support during the test.

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
    /// Along the axis; plane bodies do not move there.
    Axial,
}

impl Direction {
    /// Its name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Radial => "radial",
            Self::Tangential => "tangential",
            Self::Axial => "axial",
        }
    }

    /// Component of a displacement `(u_r, u_theta, u_z)`.
    pub fn component(self) -> usize {
        self as usize
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
