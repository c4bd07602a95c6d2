//! A body in motion: what a page with scripts animates.

/// A mesh and the ways in which it moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Places of the nodes at rest, m.
    pub positions: Vec<[f64; 2]>,
    /// Nodes around each element.
    pub cells: Vec<Vec<u32>>,
    /// Nodes of the contact edge, in order.
    pub edge: Vec<u32>,
    /// The motions to choose from.
    pub states: Vec<MotionState>,
}

/// One motion.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionState {
    /// Its name in plain text.
    pub name: String,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// What moves.
    pub kind: MotionKind,
}

/// How a body moves.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionKind {
    /// `Re((real + i imaginary) exp(i omega t))` of every node, along x and y, to any scale.
    Harmonic {
        /// Real part.
        real: Vec<[f64; 2]>,
        /// Imaginary part.
        imaginary: Vec<[f64; 2]>,
    },
    /// A wave that turns about the origin without changing its shape.
    Turning {
        /// Displacement at time zero of every node, along x and y, m.
        displacement: Vec<[f64; 2]>,
        /// Turn in a period, rad, counter-clockwise.
        turn: f64,
        /// Contact status along the edge at time zero: 0 open, 1 stick, 2 slip.
        status: Vec<u8>,
    },
}
