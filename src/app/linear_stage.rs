//! The modes that a transient has in its linear stage, for its figures.

use crate::case::{Case, ModeSelection};
use crate::cea::{CeaError, ComplexMode, ModeLimit};
use crate::fem::MassKind;
use crate::prestress::{DampingModel, TangentOptions};
use crate::results::charts::ModeLine;
use crate::study::modes_at_own_friction;

/// Modes looked at where the case has no `[cea]`.
const MODES: usize = 30;

/// Nodes of an imported mesh beyond which its modes would take longer than a figure is worth.
const MOST_NODES: usize = 30_000;

/// Unstable modes of steady sliding as the time loop has it: the same mesh and contact, lumped mass, small
/// displacements.
pub struct LinearStage {
    /// Frequencies, numbered among all modes by frequency.
    pub references: Vec<ModeLine>,
    /// Largest growth rate of each unstable harmonic, 1/s, harmonics rising.
    pub growth_rates: Vec<(usize, f64)>,
}

impl LinearStage {
    /// Solves at the case's own friction coefficient; where that fails (steady sliding would open, say)
    /// there are no modes, and the log says why.
    pub fn of(case: &Case) -> Self {
        if case
            .body
            .as_ref()
            .is_some_and(|body| body.mesh.node_count() > MOST_NODES)
        {
            tracing::warn!(
                "figures without modes of the eigenvalue analysis: more than {MOST_NODES} nodes"
            );
            return Self {
                references: Vec::new(),
                growth_rates: Vec::new(),
            };
        }
        let modes = modes(case).unwrap_or_else(|error| {
            tracing::warn!("figures without modes of the eigenvalue analysis: {error}");
            Vec::new()
        });
        let unstable = || modes.iter().enumerate().filter(|(_, m)| m.is_unstable());
        let mut growth_rates: Vec<(usize, f64)> = Vec::new();
        // A body without symmetry has no harmonics that its waves belong to.
        for (_, mode) in unstable().filter(|_| case.is_annulus()) {
            let rate = mode.growth_rate();
            match growth_rates.iter_mut().find(|(n, _)| *n == mode.harmonic) {
                Some((_, known)) => *known = known.max(rate),
                None => growth_rates.push((mode.harmonic, rate)),
            }
        }
        growth_rates.sort_by_key(|&(harmonic, _)| harmonic);
        Self {
            references: unstable()
                .map(|(index, mode)| ModeLine {
                    frequency_hz: mode.frequency_hz(),
                    label: match case.is_annulus() {
                        true => format!("mode {}, *n* = {}", index + 1, mode.harmonic),
                        false => format!("mode {}", index + 1),
                    },
                })
                .collect(),
            growth_rates,
        }
    }
}

fn modes(case: &Case) -> Result<Vec<ComplexMode>, CeaError> {
    let contact = case.contact.stiffness;
    // On a rigid contact they are one and the same.
    let is_rigid = contact.normal_stiffness.is_none();
    let damping_model = match is_rigid || case.damping.include_contact {
        true => DampingModel::WholeTangent,
        false => DampingModel::BodyOnly,
    };
    let options = TangentOptions {
        mass: MassKind::Lumped,
        geometric_stiffness: false,
        damping: case.damping.rayleigh,
        damping_model,
        contact,
    };
    let limit = match case.cea.as_ref().map(|cea| cea.modes) {
        Some(ModeSelection::BelowHz(limit)) => ModeLimit::MaxFrequency(limit),
        Some(ModeSelection::Lowest(count)) => ModeLimit::Lowest(count),
        None => ModeLimit::Lowest(MODES),
    };
    modes_at_own_friction(case, &options, limit)
}
