//! Which modes couple where steady sliding loses its stability, as far as the sweep tells.

use super::branches::{Branch, branch_of, branch_of_mode, branches};
use super::{CeaReport, direction_name};
use crate::distinct;
use frictionsim_output::fixed;
use frictionsim_physics::cea::{ComplexMode, FrictionPoint, UnstableInterval};

/// Largest distance of two frequencies that couple, relative to their mean.
const NEAR: f64 = 0.05;

/// A sentence for each branch that turns unstable whose partner is known.
///
/// On a body of revolution the two waves of a pair couple, the one with and the one against the rotor. On any other
/// body the partner is the mode nearest in frequency, within 5 %, at the first friction value at which the branch is
/// unstable, whose real part has fallen since the lowest friction while that of the branch rose.
pub(super) fn sentences(report: &CeaReport<'_>) -> Vec<String> {
    let intervals = &report.solution.sweep.intervals;
    let sentence = |branch: Branch| match report.has_harmonics {
        true => of_pair(branch),
        false => of_modes(report, intervals.iter().find(|own| branch_of(own) == branch)?),
    };
    distinct(intervals.iter().map(branch_of)).into_iter().filter_map(sentence).collect()
}

fn of_pair((harmonic, branch, direction): Branch) -> Option<String> {
    let (own, other) = (direction_name(direction), direction_name(-direction));
    (harmonic > 0 && direction != 0).then(|| {
        format!(
            "n = {harmonic}, branch {branch}: friction couples the two waves of the pair; the one \
            {own} the rotor gains what the \
             one {other} it loses."
        )
    })
}

fn of_modes(report: &CeaReport<'_>, interval: &UnstableInterval) -> Option<String> {
    let branch = branch_of(interval);
    let all = branches(&report.solution.sweep);
    let is_here = |mode: &&ComplexMode| mode.branch == interval.branch;
    let is_behind = |point: &&FrictionPoint| {
        point.friction_coefficient >= interval.critical_friction
            && point.modes.iter().any(|mode| is_here(&mode) && mode.is_unstable())
    };
    let point = report.solution.sweep.points.iter().find(is_behind)?;
    let own = point.modes.iter().find(is_here)?;
    let start = |mode: &ComplexMode| {
        let points = all.get(&branch_of_mode(mode))?;
        Some(points.first()?.1.real_hz())
    };
    let rises = |mode: &ComplexMode| Some(mode.real_hz() - start(mode)?);
    let distance = |mode: &ComplexMode| (mode.frequency_hz() / own.frequency_hz() - 1.0).abs();
    let others = point.modes.iter().filter(|mode| mode.branch != own.branch);
    let near = others.filter(|mode| distance(mode) < NEAR);
    let falling = near.filter(|mode| rises(mode).is_some_and(|rise| rise < 0.0));
    let partner = falling.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    rises(own).filter(|rise| *rise > 0.0)?;
    let name = |mode: &ComplexMode| {
        let frequency = fixed(mode.frequency_hz(), 1);
        format!("{} ({frequency} Hz)", report.branch_name(branch_of_mode(mode)))
    };
    Some(format!(
        "{}: at friction {} it lies beside {}, which loses what it gains: these two couple.",
        report.branch_name(branch),
        point.friction_coefficient,
        name(partner)
    ))
}
