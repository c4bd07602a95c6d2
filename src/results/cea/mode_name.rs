//! The name of a mode in tables of what is read from it.

use crate::output::columns;

/// A mode of one friction value, as its table numbers it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeName {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Number by frequency, from 1.
    pub mode: usize,
    /// `Im(lambda) / 2 pi`, Hz.
    pub frequency_hz: f64,
    /// Circumferential harmonic; none without symmetry.
    pub harmonic: Option<usize>,
    /// Branch, from 1.
    pub branch: usize,
    /// +1 travels with the rotor, -1 against it, 0 stands; none without symmetry.
    pub direction: Option<i8>,
}

/// What the columns say that tell modes apart, in every table.
pub(in crate::results) const HARMONIC: &str = "number of nodal diameters; none without symmetry";
/// The same of branches.
pub(in crate::results) const BRANCH: &str = "rank within the harmonic, else among all, from 1";
/// The same of the direction of travel.
pub(in crate::results) const DIRECTION: &str =
    "1 travels with the rotor, -1 against it, 0 stands; none without symmetry";

/// How a wave travels, behind its name; nothing of one that stands.
pub(crate) fn travels(direction: i8) -> &'static str {
    match direction {
        1.. => ", with the rotor",
        0 => "",
        ..0 => ", against the rotor",
    }
}

/// The same as an arrow.
pub(in crate::results) fn arrow(direction: i8) -> &'static str {
    match direction {
        1.. => " ↺",
        0 => "",
        ..0 => " ↻",
    }
}

columns! {
    /// A mode in tables of what is read from it.
    pub(in crate::results) NAMES: mode as ModeName;
    friction_coefficient: "friction coefficient" = mode.friction_coefficient;
    mode: "number by frequency at that friction, from 1" = mode.mode;
    frequency_hz: "frequency of the mode" = mode.frequency_hz;
    harmonic: HARMONIC = mode.harmonic;
}

columns! {
    /// Its branch.
    pub(in crate::results) BRANCHES: mode as ModeName;
    branch: BRANCH = mode.branch;
    direction: DIRECTION = mode.direction;
}
