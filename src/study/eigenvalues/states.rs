//! A sweep over friction coefficients between which contact nodes open or close.

use super::model::mode_limit;
use super::{Progress, SlidingModel, Solution, StudyError};
use crate::case::{Case, Cea};
use crate::cea::sparse;
use crate::cea::{FrictionPoint, FrictionSweep, SweepRequest, UnstableInterval};

/// Solves the sparse eigenproblems: each base state has a tangent and a sweep of its own, which the friction
/// coefficients where one state gives way to the next end and begin.
///
/// # Errors
/// Those of the solver.
pub fn solve_sparse(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    progress: &Progress<'_>,
) -> Result<Solution, StudyError> {
    let frictions = cea.solved_friction_coefficients();
    let range = &model.range;
    let (mut parts, mut dofs) = (Vec::new(), 0);
    for (k, state) in range.states.iter().enumerate() {
        let own = frictions.iter().zip(&range.state_of);
        let mut values: Vec<f64> = own.filter(|(_, s)| **s == k).map(|(mu, _)| *mu).collect();
        if values.is_empty() {
            continue;
        }
        // Branches are followed up to the change on either side.
        values.extend(
            k.checked_sub(1)
                .and_then(|before| range.changes.get(before)),
        );
        values.extend(range.changes.get(k));
        values.sort_by(f64::total_cmp);
        values.dedup();
        let tangent = model.tangent(case, state);
        dofs = dofs.max(tangent.unknowns.len());
        let request = SweepRequest {
            friction_coefficients: &values,
            limit: mode_limit(cea),
            shapes_at: &cea.shapes_at,
        };
        let found = sparse::sweep(&tangent, &request, progress)?;
        parts.push(found);
    }
    let notes = changes_note(&range.changes).into_iter().collect();
    Ok(Solution {
        dofs,
        method: "sparse",
        sensitivities: None,
        notes,
        sweep: joined(parts, &frictions),
    })
}

fn changes_note(changes: &[f64]) -> Option<String> {
    let list: Vec<String> = changes.iter().map(|mu| format!("{mu:.6}")).collect();
    (!list.is_empty()).then(|| {
        format!(
            "contact nodes open or close at friction coefficients {}: the tangent changes there, and branches are matched \
             across by their eigenvalues",
            list.join(", ")
        )
    })
}

/// One sweep of the parts: each is labelled like the one before by the nearest eigenvalues where they meet.
fn joined(mut parts: Vec<FrictionSweep>, frictions: &[f64]) -> FrictionSweep {
    for k in 1..parts.len() {
        let (before, after) = parts.split_at_mut(k);
        relabel(&before[k - 1], &mut after[0]);
    }
    let all: Vec<&FrictionPoint> = parts.iter().flat_map(|part| &part.points).collect();
    let points = frictions.iter().filter_map(|mu| {
        all.iter()
            .find(|point| point.friction_coefficient == *mu)
            .map(|point| (*point).clone())
    });
    let points = points.collect();
    let mut intervals: Vec<UnstableInterval> = Vec::new();
    for interval in parts.into_iter().flat_map(|part| part.intervals) {
        // A branch that is unstable on both sides of a change goes on.
        let same = intervals.iter_mut().find(|known| {
            known.branch == interval.branch
                && known.harmonic == interval.harmonic
                && known.restabilized.is_none()
        });
        match same {
            Some(known) if interval.unstable_from_start => {
                known.restabilized = interval.restabilized
            }
            _ => intervals.push(interval),
        }
    }
    intervals.sort_by(|a, b| a.critical_friction.total_cmp(&b.critical_friction));
    FrictionSweep { points, intervals }
}

/// Gives the branches of `after` the numbers that their nearest eigenvalues have in `before` where both meet.
fn relabel(before: &FrictionSweep, after: &mut FrictionSweep) {
    let last = before
        .points
        .iter()
        .max_by(|a, b| a.friction_coefficient.total_cmp(&b.friction_coefficient));
    let first = after
        .points
        .iter()
        .min_by(|a, b| a.friction_coefficient.total_cmp(&b.friction_coefficient));
    let (Some(last), Some(first)) = (last, first) else {
        return;
    };
    // Nearest pairs first, each mode once.
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, old) in last.modes.iter().enumerate() {
        for (j, new) in first.modes.iter().enumerate() {
            pairs.push(((old.eigenvalue - new.eigenvalue).norm(), i, j));
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut is_old_taken = vec![false; last.modes.len()];
    let mut number_of: Vec<Option<usize>> = vec![None; first.modes.len()];
    for (_, i, j) in pairs {
        if !is_old_taken[i] && number_of[j].is_none() {
            is_old_taken[i] = true;
            number_of[j] = Some(last.modes[i].branch);
        }
    }
    let known = before
        .points
        .iter()
        .flat_map(|point| &point.modes)
        .map(|mode| mode.branch);
    let mut next = known.max().map_or(0, |branch| branch + 1);
    let mut new_number = std::collections::BTreeMap::new();
    for (mode, number) in first.modes.iter().zip(number_of) {
        new_number.insert(
            mode.branch,
            number.unwrap_or_else(|| {
                next += 1;
                next - 1
            }),
        );
    }
    let renumber = |branch: &mut usize| {
        *branch = *new_number.entry(*branch).or_insert_with(|| {
            next += 1;
            next - 1
        });
    };
    let modes = after.points.iter_mut().flat_map(|point| &mut point.modes);
    let branches = modes.map(|mode| &mut mode.branch);
    branches
        .chain(after.intervals.iter_mut().map(|i| &mut i.branch))
        .for_each(renumber);
}
