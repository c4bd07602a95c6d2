//! The modes that a transient has in its linear stage.

use super::modes_at_own_friction;
use super::tangent::{MODES_IN_TIME, options_in_time};
use crate::*;
use frictionsim_results::{charts::ModeLine, transient::LinearStage};

/// Nodes of an imported mesh beyond which its modes would take longer than a figure is worth.
const MOST_NODES: usize = 30_000;

/// Unstable modes of steady sliding at the case's own friction coefficient, as the time loop has it.
///
/// # Errors
/// A mesh of too many nodes; those of steady sliding, which would open, say, and of the solver.
pub fn linear_stage(case: &Case) -> Result<LinearStage, StudyError> {
    let imported = case.body.imported();
    if imported.is_some_and(|imported| imported.mesh.node_count() > MOST_NODES) {
        return Err(StudyError::Failed(format!("more than {MOST_NODES} nodes")));
    }
    let mut options = options_in_time(case);
    if case.contact.stiffness.normal_stiffness.is_none() {
        // On a rigid contact they are one and the same.
        options.damping_model = DampingModel::WholeTangent;
    }
    let modes = modes_at_own_friction(case, &options, asked_modes(case, MODES_IN_TIME))?;
    let unstable = || modes.iter().enumerate().filter(|(_, m)| m.is_unstable());
    let mut growth_rates: BTreeMap<usize, f64> = BTreeMap::new();
    // A body without symmetry has no harmonics that its waves belong to.
    for (_, mode) in unstable().filter(|_| case.body.has_sectors()) {
        let largest = growth_rates.entry(mode.harmonic).or_insert(f64::NEG_INFINITY);
        *largest = largest.max(mode.growth_rate());
    }
    Ok(LinearStage {
        references: unstable()
            .map(|(index, mode)| ModeLine {
                frequency_hz: mode.frequency_hz(),
                label: match case.body.has_sectors() {
                    true => format!("mode {}, *n* = {}", index + 1, mode.harmonic),
                    false => format!("mode {}", index + 1),
                },
            })
            .collect(),
        growth_rates: growth_rates.into_iter().collect(),
        mode_rates: unstable().map(|(_, mode)| (mode.frequency_hz(), mode.growth_rate())).collect(),
    })
}
