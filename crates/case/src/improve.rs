//! `[improve]`: which modes are to be silenced, and by what.

use super::ModificationKind;
use crate::*;

/// `[improve]`; what is `None` follows from the body and its modes.
#[derive(Clone, Debug, PartialEq)]
pub struct Improve {
    /// What is tried, each once; empty for all.
    pub modifications: Vec<ModificationKind>,
    /// The modes between these frequencies are to be silenced, Hz.
    pub frequencies_hz: [f64; 2],
    /// Mass that may be added at a node, kg.
    pub mass: Option<f64>,
    /// Stiffness of a spring, N/m.
    pub stiffness: Option<f64>,
    /// Damping of a dashpot, N s/m.
    pub damping: Option<f64>,
    /// Radius of what is damped or taken away, m.
    pub patch_radius: Option<f64>,
    /// Stiffness coefficient of the damping that is added there, s.
    pub patch_damping: Option<f64>,
    /// Farthest way of the contact curve, m.
    pub offset: Option<f64>,
    /// Regions and boundaries that nothing may touch.
    pub forbidden: Vec<String>,
    /// How many candidates of each kind are listed.
    pub candidates: usize,
    /// How many of all are run again.
    pub confirm: usize,
}

pub(super) fn improve(section: &Section<'_>) -> Improve {
    let ends = ["min_frequency_hz", "max_frequency_hz"].map(|key| section.optional_number(key));
    let frequencies_hz = [ends[0].unwrap_or(0.0), ends[1].unwrap_or(f64::INFINITY)];
    refuse_if!(frequencies_hz[0] >= frequencies_hz[1]; section, "min_frequency_hz",
        "improve.min_frequency_hz = {} is not below improve.max_frequency_hz = {}",
        frequencies_hz[0], frequencies_hz[1]; "no mode lies between them");
    Improve {
        modifications: section.choices("modifications"),
        frequencies_hz,
        mass: section.optional_number("mass"),
        stiffness: section.optional_number("stiffness"),
        damping: section.optional_number("damping"),
        patch_radius: section.optional_number("patch_radius"),
        patch_damping: section.optional_number("patch_damping"),
        offset: section.optional_number("offset"),
        forbidden: section.texts("forbidden"),
        candidates: section.count("candidates"),
        confirm: section.count("confirm"),
    }
}
