//! `[improve]`: which modes are to be silenced, and by what.

use super::{ModificationKind, reader::declared};
use crate::*;

declared! {
    /// `[improve]`; what is `None` follows from the body and its modes.
    Improve {
        modifications: Vec<ModificationKind> = choices, "What is tried, each once; empty for all.";
        mass: Option<f64> = optional_number, "Mass that may be added at a node, kg.";
        stiffness: Option<f64> = optional_number, "Stiffness of a spring, N/m.";
        damping: Option<f64> = optional_number, "Damping of a dashpot, N s/m.";
        patch_radius: Option<f64> = optional_number, "Radius of what is damped or taken away, m.";
        patch_damping: Option<f64> = optional_number, "Stiffness coefficient of the damping that is added there, s.";
        offset: Option<f64> = optional_number, "Farthest way of the contact curve, m.";
        forbidden: Vec<String> = texts, "Regions and boundaries that nothing may touch.";
        candidates: usize = count, "How many candidates of each kind are listed.";
        confirm: usize = count, "How many of all are run again.";
    } with {
        frequencies_hz: [f64; 2], "The modes between these frequencies are to be silenced, Hz.";
    }
}

pub(super) fn improve(section: &Section<'_>) -> Improve {
    let ends = ["min_frequency_hz", "max_frequency_hz"].map(|key| section.optional_number(key));
    let frequencies_hz = [ends[0].unwrap_or(0.0), ends[1].unwrap_or(f64::INFINITY)];
    refuse_if!(frequencies_hz[0] >= frequencies_hz[1]; section, "min_frequency_hz",
        "improve.min_frequency_hz = {} is not below improve.max_frequency_hz = {}",
        frequencies_hz[0], frequencies_hz[1]; "no mode lies between them");
    Improve::declared(section, frequencies_hz)
}
