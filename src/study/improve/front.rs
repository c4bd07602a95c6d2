//! The Pareto front of mass against critical friction: how little mass, added or taken away, gets how far.

use super::base::state;
use super::confirm::{run_again, verdict};
use super::modal::ModalModel;
use super::places::Places;
use super::trial::Search;
use super::{Predicted, candidate, predictions};
use crate::case::ModificationKind;
use crate::results::improve::{Candidate, FrontPoint, State};
use crate::study::StudyError;
use rayon::prelude::*;

/// Most runs for each size.
const RUNS: usize = 3;
/// What is said of a candidate before it runs.
const UNTRIED: &str = "not run again";

/// The best places of masses and removals of `improve.front` sizes up to those of the case, by rising mass; those that no lighter
/// one beats are run again, and hold where none that is confirmed does.
///
/// A prediction with more unstable modes beside the window than the case has is left out: nothing new may squeal.
///
/// # Errors
/// Those of the solver.
pub(super) fn front(
    search: &Search<'_>,
    modal: &ModalModel<'_>,
) -> Result<Vec<FrontPoint>, StudyError> {
    let (base, asked) = (search.base, &search.base.case.improve);
    if asked.front == 0 {
        return Ok(Vec::new());
    }
    // What each size comes to at its best places.
    let kinds = [ModificationKind::Mass, ModificationKind::Removal];
    let is_asked = |kind: &ModificationKind| {
        asked.modifications.is_empty() || asked.modifications.contains(kind)
    };
    let kinds: Vec<ModificationKind> = kinds.into_iter().filter(is_asked).collect();
    let mut tried: Vec<Candidate> = Vec::new();
    for step in 1..=asked.front {
        let share = step as f64 / asked.front as f64;
        let own = sized(search, share)?;
        for &kind in &kinds {
            let found = predictions(&own, modal, kind, &mut Vec::new())?;
            let quiet = |own: &&Predicted| own.state.unstable_beside <= base.outlook.beside;
            let rows = found.iter().filter(quiet);
            tried.extend(rows.map(|row| candidate(&own, 0, row, None)));
        }
    }
    let weight = |own: &Candidate| own.added_mass_kg.abs();
    tried.sort_by(|a, b| weight(a).total_cmp(&weight(b)));

    // Those on the front as cases of their own; where one does not hold, the next ones, until all on it do.
    let before = state(base.outlook, base.onset);
    let holds = |own: &Candidate| !own.verdict.starts_with("struck off");
    let mut left = RUNS * asked.front;
    loop {
        let best = |own: &Candidate| own.confirmed.or(Some(own.predicted)).filter(|_| holds(own));
        let mut open = undominated(&tried, &before, best);
        open.retain(|&at| tried[at].verdict == UNTRIED);
        open.truncate(left);
        if open.is_empty() {
            break;
        }
        left -= open.len();
        let again: Vec<(usize, Result<State, String>)> =
            open.par_iter().map(|&at| (at, run_again(base, &tried[at].keys))).collect();
        for (at, outcome) in again {
            tried[at].verdict = match &outcome {
                Ok(found) => verdict(&before, found),
                Err(reason) => format!("struck off: {reason}"),
            };
            tried[at].confirmed = outcome.ok();
        }
    }
    let confirmed = undominated(&tried, &before, |own| own.confirmed.filter(|_| holds(own)));
    let points = tried.into_iter().enumerate();
    Ok(points
        .map(|(at, own)| FrontPoint {
            on_front: confirmed.contains(&at),
            candidate: Candidate { rank: at + 1, ..own },
        })
        .collect())
}

/// The search with masses and patches of a share of the mass allowed.
fn sized<'a>(search: &Search<'a>, share: f64) -> Result<Search<'a>, StudyError> {
    let mut budget = search.budget;
    budget.mass *= share;
    budget.patch_radius *= share.powf(1.0 / search.base.mesh.dimension as f64);
    Ok(Search { places: Places::of(search.base, budget.patch_radius)?, budget, ..*search })
}

/// Places of the candidates, by rising mass, that get farther than every lighter one and than the case as it is; nothing is
/// farther than no growth at all.
fn undominated(
    sorted: &[Candidate],
    base: &State,
    of: impl Fn(&Candidate) -> Option<State>,
) -> Vec<usize> {
    let onset = |state: &State| state.critical_friction.unwrap_or(f64::INFINITY);
    let (mut best, mut kept) = (onset(base), Vec::new());
    for (at, own) in sorted.iter().enumerate() {
        let reached = of(own).map(|state| onset(&state));
        if let Some(reached) = reached.filter(|reached| *reached > best) {
            best = reached;
            // Of equal masses the last, and best, one stays.
            let same = |&last: &usize| sorted[last].added_mass_kg.abs() == own.added_mass_kg.abs();
            kept.retain(|last| !same(last));
            kept.push(at);
        }
    }
    kept
}
