//! Families of limit cycles, told apart by the loss of stability at which they are born.

use std::fmt;

/// Largest friction coefficient at which the onset of a wave that is asked for by name is looked for.
pub const LARGEST_FRICTION: f64 = 2.0;

/// The limit cycles of one circumferential harmonic that are born at one of its onsets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Family {
    /// Circumferential harmonic `n`, nodal diameters.
    pub harmonic: usize,
    /// Onset of that harmonic, from 1, by rising critical friction.
    pub onset: usize,
}

impl Family {
    /// The family that is born at the lowest critical friction of a harmonic.
    pub fn lowest(harmonic: usize) -> Self {
        Self { harmonic, onset: 1 }
    }

    /// Part of a file name: `n2`, or `n1-onset2`.
    pub fn tag(&self) -> String {
        match self.onset {
            1 => format!("n{}", self.harmonic),
            onset => format!("n{}-onset{onset}", self.harmonic),
        }
    }
}

/// `n = 2`, or `n = 1, onset 2`.
impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.onset {
            1 => write!(f, "n = {}", self.harmonic),
            onset => write!(f, "n = {}, onset {onset}", self.harmonic),
        }
    }
}
