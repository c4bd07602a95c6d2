//! The modes of a sweep and its unstable intervals by branch, and how tables name a mode.

use super::{CeaReport, direction_name};
use crate::common::*;
use frictionsim_physics::cea::FrictionSweep;

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

/// Nodal diameters, of a mode that has them, and frequency.
pub(super) fn kilohertz(mode: &ModeName) -> String {
    let frequency = format!("{} kHz", fixed(1e-3 * mode.frequency_hz, 3));
    match mode.harmonic {
        Some(harmonic) => format!("n = {harmonic}, {frequency}"),
        None => frequency,
    }
}

/// How a wave travels, behind its name; nothing of one that stands.
pub(super) fn travels(direction: i8) -> &'static str {
    [", against the rotor", "", ", with the rotor"][(direction.signum() + 1) as usize]
}

/// The same as an arrow.
pub(crate) fn arrow(direction: i8) -> &'static str {
    [" ↻", "", " ↺"][(direction.signum() + 1) as usize]
}

/// Harmonic, branch and direction: what identifies a mode over friction.
pub type Branch = (usize, usize, i8);

/// The branch of a mode.
pub fn branch_of_mode(mode: &ComplexMode) -> Branch {
    (mode.harmonic, mode.branch, mode.direction)
}

/// The branch that an interval is of.
pub fn branch_of(interval: &UnstableInterval) -> Branch {
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
    let rows = grouped(sweep.intervals.iter().map(|own| (branch_of(own), own)));
    sorted(BTreeMap::from_iter(rows), |own| own.1[0].frequency_hz)
}

/// Largest distance of two frequencies that couple, relative to their mean.
const NEAR: f64 = 0.05;
/// Share of what a wave gains that the other of its pair loses where friction couples them; with less both are fed.
const LOST: f64 = 0.5;

/// A sentence for each branch that turns unstable whose partner is known, at the first friction value at which it is
/// unstable: its real part has risen since the lowest friction, while that of the partner fell.
///
/// On a body of revolution the partner is the other wave of the pair, and loses most of what the branch gains: friction
/// that falls with speed feeds both. On any other body it is the mode nearest in frequency, within 5 %.
pub(super) fn sentences(report: &CeaReport<'_>) -> Vec<String> {
    let intervals = &report.solution.sweep.intervals;
    let first = |branch: Branch| intervals.iter().find(|own| branch_of(own) == branch);
    let branches = distinct(intervals.iter().map(branch_of)).into_iter();
    branches.filter_map(|branch| sentence(report, first(branch)?)).collect()
}

fn sentence(report: &CeaReport<'_>, interval: &UnstableInterval) -> Option<String> {
    let branch @ (harmonic, rank, direction) = branch_of(interval);
    let all = branches(&report.solution.sweep);
    let is_here = |mode: &&ComplexMode| interval.is_of(mode);
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
    let gained = rises(own).filter(|rise| *rise > 0.0)?;
    let is_pair = report.has_harmonics;
    let is_near = |mode: &&ComplexMode| match is_pair {
        true => direction != 0 && branch_of_mode(mode) == (harmonic, rank, -direction),
        false => mode.branch != own.branch && distance(mode) < NEAR,
    };
    let least = if is_pair { LOST * gained } else { 0.0 };
    let falling = point.modes.iter().filter(is_near);
    let falling = falling.filter(|mode| rises(mode).is_some_and(|rise| -rise > least));
    let partner = falling.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    if is_pair {
        let [own, other] = [direction, -direction].map(direction_name);
        return Some(format!(
            "n = {harmonic}, branch {rank}: friction couples the two waves of the pair; the one {own} the rotor gains \
             what the one {other} it loses."
        ));
    }
    let [one, other] = [branch, branch_of_mode(partner)].map(|own| report.branch_name(own));
    let (friction, hz) = (point.friction_coefficient, fixed(partner.frequency_hz(), 1));
    Some(format!(
        "{one}: at friction {friction} it lies beside {other} ({hz} Hz), which loses what it gains: these two couple."
    ))
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
            pieces(&all[&(0, branch, 0)], &sweep, changes).iter().map(|piece| piece.len()).collect()
        };
        assert_eq!(lengths(0, &[]), [4]);
        assert_eq!(lengths(0, &[0.25]), [2, 2]);
        assert_eq!(lengths(1, &[]), [2, 1]);
    }
}
