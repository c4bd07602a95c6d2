//! A body in motion: what a page with scripts animates.

use super::colour::Colour;
use super::packed::{Levels, lists, whole};
use serde::{Deserialize, Serialize};

/// A body and what it shows: motions, or its parts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// 2 for a plane body, 3 for a solid one that the reader turns.
    pub dimension: usize,
    /// Places of the nodes at rest, m; the third coordinate of a plane body is zero.
    #[serde(with = "Levels::<65_534>")]
    pub positions: Vec<[f64; 3]>,
    /// Nodes around each element of a plane body, around each face of the surface of a solid one.
    #[serde(with = "lists")]
    pub cells: Vec<Vec<u32>>,
    /// Nodes of the contact edge, in order.
    pub edge: Vec<u32>,
    /// Edges of a solid body that are drawn, by their ends.
    #[serde(with = "whole")]
    pub lines: Vec<[u32; 2]>,
    /// What there is to choose from.
    pub states: Vec<MotionState>,
}

/// One motion, or one way to tell parts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionState {
    /// Its name in plain text.
    pub name: String,
    /// Frequency, Hz; zero for what is at rest.
    pub frequency_hz: f64,
    /// What moves.
    pub kind: MotionKind,
}

/// How a body moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum MotionKind {
    /// `Re((real + i imaginary) exp(i omega t))` of every node, along x, y and z, to any scale.
    Harmonic {
        /// Real part.
        #[serde(with = "Levels::<254>")]
        real: Vec<[f64; 3]>,
        /// Imaginary part.
        #[serde(with = "Levels::<254>")]
        imaginary: Vec<[f64; 3]>,
    },
    /// A wave that turns about the origin without changing its shape.
    Turning {
        /// Displacement at time zero of every node, along x, y and z, m.
        #[serde(with = "Levels::<65_534>")]
        displacement: Vec<[f64; 3]>,
        /// Turn in a period, rad, counter-clockwise.
        turn: f64,
        /// Contact status along the edge at time zero: 0 open, 1 stick, 2 slip.
        status: Vec<u8>,
    },
    /// No motion: cells in the colours of their parts.
    Parts {
        /// The part of each cell.
        part_of: Vec<u32>,
        /// Colour and name of each part; "" for one that is not there.
        parts: Vec<(Colour, String)>,
    },
}
