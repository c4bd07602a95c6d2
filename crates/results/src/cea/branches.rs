//! The modes of a sweep and its unstable intervals by branch.

use crate::sorted;
use frictionsim_physics::cea::{ComplexMode, FrictionSweep, UnstableInterval};
use std::collections::BTreeMap;

/// Harmonic, branch and direction: what identifies a mode over friction.
pub(super) type Branch = (usize, usize, i8);

pub(super) fn branch_of_mode(mode: &ComplexMode) -> Branch {
    (mode.harmonic, mode.branch, mode.direction)
}

pub(super) fn branch_of(interval: &UnstableInterval) -> Branch {
    (interval.harmonic, interval.branch, interval.direction)
}

/// Points of each branch over friction: (friction coefficient, mode).
pub(super) fn branches(sweep: &FrictionSweep) -> BTreeMap<Branch, Vec<(f64, &ComplexMode)>> {
    let mut out: BTreeMap<Branch, Vec<(f64, &ComplexMode)>> = BTreeMap::new();
    for point in &sweep.points {
        for mode in &point.modes {
            // Where a pair is degenerate its modes have no direction and stand at the start of both waves.
            let is_pair = mode.harmonic > 0 && mode.direction == 0;
            let directions = if is_pair { &[-1, 1][..] } else { &[mode.direction] };
            for direction in directions {
                let points = out.entry((mode.harmonic, mode.branch, *direction)).or_default();
                if points.last().is_none_or(|last| last.0 != point.friction_coefficient) {
                    points.push((point.friction_coefficient, mode));
                }
            }
        }
    }
    out
}

/// The points of a branch in pieces: it does not go on smoothly across a friction coefficient at which the contact set
/// changes, nor over a solved value at which it has no mode.
pub(super) fn pieces<'p, 'm>(
    points: &'p [(f64, &'m ComplexMode)],
    sweep: &FrictionSweep,
    changes: &[f64],
) -> Vec<&'p [(f64, &'m ComplexMode)]> {
    let goes_on = |a: &(f64, &ComplexMode), b: &(f64, &ComplexMode)| {
        let is_between = |mu: f64| a.0 < mu && mu < b.0;
        let mut solved = sweep.points.iter().map(|point| point.friction_coefficient);
        let is_change = |mu: &f64| a.0 <= *mu && *mu < b.0;
        !solved.any(is_between) && !changes.iter().any(is_change)
    };
    points.chunk_by(goes_on).collect()
}

/// Unstable intervals by branch, lowest frequency first, as the frequency axis has it.
pub(super) fn interval_rows(sweep: &FrictionSweep) -> Vec<(Branch, Vec<&UnstableInterval>)> {
    let mut rows: BTreeMap<Branch, Vec<&UnstableInterval>> = BTreeMap::new();
    for interval in &sweep.intervals {
        rows.entry(branch_of(interval)).or_default().push(interval);
    }
    sorted(rows, |own| own.1[0].frequency_hz)
}

#[cfg(test)]
mod tests {
    use super::*;
    use frictionsim_physics::cea::FrictionPoint;
    use frictionsim_physics::linalg::c64;

    #[test]
    fn a_branch_breaks_where_the_contact_set_changes_and_where_it_has_no_mode() {
        let mode = |branch: usize| ComplexMode {
            eigenvalue: c64::new(-1.0, 1e4),
            harmonic: 0,
            branch,
            direction: 0,
            residual: 0.0,
            uncertainty: 0.0,
            contact_share: 0.0,
            axial_share: None,
            mesh_error: None,
            shape: None,
            left: None,
            nodal_diameters: None,
            wave: None,
        };
        let point = |friction_coefficient: f64, own: &[usize]| FrictionPoint {
            friction_coefficient,
            modes: own.iter().map(|&branch| mode(branch)).collect(),
            above: Vec::new(),
        };
        let sweep = FrictionSweep {
            points: vec![
                point(0.1, &[0, 1]),
                point(0.2, &[0, 1]),
                point(0.3, &[0]),
                point(0.4, &[0, 1]),
            ],
            ..FrictionSweep::default()
        };
        let all = branches(&sweep);
        let lengths = |branch: usize, changes: &[f64]| -> Vec<usize> {
            let pieces = pieces(&all[&(0, branch, 0)], &sweep, changes);
            pieces.iter().map(|piece| piece.len()).collect()
        };
        assert_eq!(lengths(0, &[]), [4]);
        assert_eq!(lengths(0, &[0.25]), [2, 2]);
        assert_eq!(lengths(1, &[]), [2, 1]);
    }
}
