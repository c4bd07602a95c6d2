//! `[frf]`: a frequency response of the model.

use super::model::node_count;
use super::reader::{Bound, Section};
use crate::fem::MassKind;
use crate::frf::{FrfBoundary, Terminal};
use crate::mesh::AnnulusSpecification;
use crate::signal::ResponseQuantity;

/// How a frequency response is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrfMethod {
    /// The fastest that needs no tolerance: cyclic.
    Auto,
    /// Every circumferential harmonic at each frequency.
    Cyclic,
    /// A sparse solution of the whole mesh at each frequency.
    Direct,
    /// Rational Krylov reduction with its error stated.
    Reduced,
}

/// `[frf]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Frf {
    /// How the body is held.
    pub boundary: FrfBoundary,
    /// Where and in which direction the force acts.
    pub force: Terminal,
    /// Where and in which direction the motion is observed.
    pub response: Terminal,
    /// Frequencies, Hz, in the order given.
    pub frequencies_hz: Vec<f64>,
    /// What is observed.
    pub quantity: ResponseQuantity,
    /// How it is computed.
    pub method: FrfMethod,
    /// Which mass matrix.
    pub mass: MassKind,
    /// Standard deviation of the noise on each part, relative to the magnitude.
    pub noise: f64,
    /// Seed of the noise.
    pub noise_seed: usize,
}

pub(super) fn read(root: &Section<'_>, annulus: &AnnulusSpecification) -> Option<Frf> {
    let section = root.section("frf", false);
    if !section.is_given() {
        return None;
    }
    let directions = [("radial", false), ("tangential", true)];
    let force_node = section.count("force_node", 1);
    let response_node = section.optional_count("response_node", 1);
    let nodes = node_count(annulus);
    for (key, node) in [
        ("force_node", force_node),
        ("response_node", response_node.unwrap_or(force_node)),
    ] {
        if section.has(key) && node as u128 > nodes && nodes > 0 {
            section.reject(
                key,
                format!("frf.{key} = {node} does not exist: the mesh has nodes 1 to {nodes}"),
                format!("must be at most {nodes}"),
                Some(
                    "node ids count radially outwards first: 1 + j (radial_elements + 1) + i"
                        .to_owned(),
                ),
            );
        }
    }
    let mut frequencies_hz = section
        .numbers("frequencies_hz", Bound::Positive)
        .unwrap_or_default();
    if frequencies_hz.is_empty() {
        section.reject(
            "frequencies_hz",
            "frf.frequencies_hz is missing or empty".to_owned(),
            "at least one frequency".to_owned(),
            None,
        );
    }
    frequencies_hz.sort_by(f64::total_cmp);
    frequencies_hz.dedup();
    let frf = Frf {
        boundary: section.choice(
            "boundary",
            &[
                ("free", FrfBoundary::Free),
                ("clamped", FrfBoundary::Clamped),
                ("sliding", FrfBoundary::Sliding),
            ],
        ),
        force: Terminal {
            node: force_node.saturating_sub(1),
            is_tangential: section.choice("force_direction", &directions),
        },
        response: Terminal {
            node: response_node.unwrap_or(force_node).saturating_sub(1),
            is_tangential: section.choice("response_direction", &directions),
        },
        frequencies_hz,
        quantity: section.choice(
            "quantity",
            &[
                ("accelerance", ResponseQuantity::Accelerance),
                ("mobility", ResponseQuantity::Mobility),
                ("receptance", ResponseQuantity::Receptance),
            ],
        ),
        method: section.choice(
            "method",
            &[
                ("auto", FrfMethod::Auto),
                ("cyclic", FrfMethod::Cyclic),
                ("direct", FrfMethod::Direct),
                ("reduced", FrfMethod::Reduced),
            ],
        ),
        mass: section.choice(
            "mass",
            &[
                ("consistent", MassKind::Consistent),
                ("lumped", MassKind::Lumped),
            ],
        ),
        noise: section.number_or("noise", Bound::NotNegative, 0.0),
        noise_seed: section.optional_count("noise_seed", 0).unwrap_or(1),
    };
    section.close();
    Some(frf)
}
