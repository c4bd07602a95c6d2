//! The name of a mode in tables of what is read from it.

use crate::keys::keys;
use frictionsim_output::{Column, parted};

keys! {
    /// A mode of one friction value, as its table numbers it.
    #[derive(Copy)]
    ModeName, NAMES {
        friction_coefficient: f64 = "friction coefficient";
        mode: usize = "number by frequency at that friction, from 1";
        frequency_hz: f64 = "frequency of the mode";
        harmonic: Option<usize> = "number of nodal diameters; none without symmetry";
        branch: usize = "rank within the harmonic, else among all, from 1";
        direction: Option<i8> = "1 travels with the rotor, -1 against it, 0 stands; none without symmetry";
    }
}

/// What is said of a mode beside others of its friction value: its frequency, and no direction.
pub(crate) const SHORT_NAMES: &[Column<ModeName>] = parted(NAMES, "branch").0;
/// The friction value, number and frequency.
pub(crate) const NUMBERS: &[Column<ModeName>] = parted(NAMES, "harmonic").0;

/// What the columns say that tell modes apart, in every table.
pub(crate) const HARMONIC: &str = "number of nodal diameters; none without symmetry";
/// The same of branches.
pub(crate) const BRANCH: &str = "rank within the harmonic, else among all, from 1";
/// The same of the direction of travel.
pub(crate) const DIRECTION: &str =
    "1 travels with the rotor, -1 against it, 0 stands; none without symmetry";

/// A mode in words: nodal diameters, rank among them and travel; without symmetry its number.
pub fn mode_name(harmonic: Option<usize>, branch: usize, direction: i8) -> String {
    match harmonic {
        Some(n) => format!("n = {n}, branch {branch}{}", travels(direction)),
        None => format!("mode {branch}"),
    }
}

/// How a wave travels, behind its name; nothing of one that stands.
pub(super) fn travels(direction: i8) -> &'static str {
    match direction {
        1.. => ", with the rotor",
        0 => "",
        ..0 => ", against the rotor",
    }
}

/// The same as an arrow.
pub(crate) fn arrow(direction: i8) -> &'static str {
    match direction {
        1.. => " ↺",
        0 => "",
        ..0 => " ↻",
    }
}
