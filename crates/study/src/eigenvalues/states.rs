//! Friction sweep of a whole mesh whose contact nodes open or close within the range.

mod joining;

use super::{Solution, whole::notes};
use crate::*;
use frictionsim_physics::cea::sparse::{self, CyclicTangent, FrictionlessModes};
use frictionsim_physics::prestress::{PressedRange, PressedState};
use joining::{Part, Undecided, joined, jumps, label, undecided};

/// What the parts of a sweep have in common.
struct Common<'a> {
    case: &'a Case,
    request: &'a SweepRequest<'a>,
    progress: &'a dyn SweepWatch,
    /// Unknowns of the whole mesh.
    dofs: usize,
    /// What keeps a mesh of equal sectors from being solved by waves around it.
    asymmetry: Option<String>,
    /// Modes without friction of the first state that goes on from another one: they serve for those of all after it.
    rest: Option<FrictionlessModes>,
    /// Sweeps so far, by the pressed points of their state and their friction coefficients.
    solved: Vec<(Vec<bool>, Vec<f64>, FrictionSweep)>,
}

/// Share of the largest contact force from which on it is said that base states leave that out.
const COARSE: f64 = 1e-7;
/// Share of a gap that the next state leaves on either side at least.
const LEAST_SHARE: f64 = 1e-3;
/// Places at which contact opens that a note lists one by one.
const MOST_PLACES: usize = 4;
/// Rounds in which base states are solved where stability changes between two of them.
const MOST_ROUNDS: usize = 30;

impl WholeMesh {
    /// Solves the sparse eigenproblems at the friction coefficients that the model was made for: a sweep of each state
    /// with its tangent, which the friction coefficients where one gives way to the next end and begin.
    ///
    /// Between two friction coefficients asked for contact points may open or close one after the other. Where a branch
    /// changes its stability there, states between are solved until one has the critical friction, or two meet there.
    pub(crate) fn sweep(
        &self,
        case: &Case,
        request: &SweepRequest<'_>,
        progress: &dyn SweepWatch,
    ) -> Result<Solution, CeaError> {
        // The base states of each round beyond those of the model, and their friction coefficients.
        let (mut finer, mut unsolved): (Vec<(PressedRange, Vec<f64>)>, bool) = (Vec::new(), false);
        let (dofs, asymmetry, solved) = (0, None, Vec::new());
        let mut common = Common { case, request, progress, dofs, asymmetry, rest: None, solved };
        for round in 0.. {
            let first = (&self.range, request.friction_coefficients);
            let (range, frictions) = finer.last().map_or(first, |(range, at)| (range, &at[..]));
            let mut parts = match self.parts(range, (round, frictions), &mut common) {
                Ok(parts) => parts,
                // What is known without the states between is kept, and the rest said.
                Err(_) if finer.pop().is_some() => {
                    unsolved = true;
                    continue;
                }
                Err(error) => return Err(error),
            };
            label(&mut parts);
            let open: Vec<f64> = undecided(&parts).map(|own| place_in(&own, round)).collect();
            if open.is_empty() || round >= MOST_ROUNDS || unsolved {
                let is_by_waves = self.symmetry.is_some() && common.asymmetry.is_none();
                let mut all = case.body.assembly().map_or_else(Vec::new, notes);
                all.extend(common.asymmetry.map(|why| {
                    format!(
                        "the whole mesh was solved, not waves around it one number of nodal \
                         diameters after the other: {why}"
                    )
                }));
                all.extend(contact_notes(&self.range, &parts));
                return Ok(Solution {
                    sweep: joined(parts, request.friction_coefficients),
                    dofs: common.dofs,
                    notes: all,
                    method: if is_by_waves { "cyclic" } else { "sparse" },
                    ..Solution::default()
                });
            }
            let more = [frictions, &open].concat();
            match self.states_at(case, (range, &more)) {
                Ok(range) => finer.push((range, more)),
                // There may be no state between.
                Err(_) => unsolved = true,
            }
        }
        unreachable!("rounds end")
    }

    /// The sweeps of the states at `frictions`, by rising friction.
    fn parts(
        &self,
        range: &PressedRange,
        (round, frictions): (usize, &[f64]),
        common: &mut Common<'_>,
    ) -> Result<Vec<Part>, CeaError> {
        let mut parts = Vec::new();
        for (k, state) in range.states.iter().enumerate() {
            let own = frictions.iter().zip(&range.state_of);
            let mut values: Vec<f64> = own.filter(|(_, s)| **s == k).map(|(mu, _)| *mu).collect();
            values.sort_by(f64::total_cmp);
            let Some(&first) = values.first() else { continue };
            let unknown = k.checked_sub(1).map_or(first..first, |k| range.unknown_between(k));
            let asked = common.request.friction_coefficients;
            let is_new = !asked.iter().any(|mu| values.contains(mu));
            let end = range.changes.get(k);
            // One between them is solved where it begins and ends to hold.
            values.retain(|_| !is_new || end.is_none());
            if is_new || unknown.is_empty() {
                values.insert(0, unknown.end);
            }
            values.extend(end);
            let known = common.solved.iter().find(|(set, at, _)| {
                let is_early = is_new || at[0] <= unknown.start + SAME_CHANGE;
                let has = |mu: &f64| place_of(at, *mu).is_some();
                *set == state.is_pressed && is_early && values.iter().all(has)
            });
            let sweep = match known {
                Some((_, at, sweep)) => {
                    sweep.since(place_of(at, unknown.start).unwrap_or(unknown.start))
                }
                None => {
                    // Branches of the others are followed from where the state before ends.
                    values.splice(0..0, (!is_new).then_some(unknown.start));
                    values.dedup();
                    let mut followed = values.clone();
                    followed.retain(|mu| !asked.contains(mu));
                    let own = SweepRequest {
                        friction_coefficients: &values,
                        followed_at: &followed,
                        is_continued: k > 0,
                        ..*common.request
                    };
                    let name = format!("round-{round}-state-{k}-");
                    let sweep = self.part(state, &own, name, common)?;
                    common.solved.push((state.is_pressed.clone(), values, sweep.clone()));
                    sweep
                }
            };
            parts.push(Part { begin: unknown.end, sweep });
        }
        Ok(parts)
    }

    /// The sweep of one state.
    fn part(
        &self,
        state: &PressedState,
        request: &SweepRequest<'_>,
        prefix: String,
        common: &mut Common<'_>,
    ) -> Result<FrictionSweep, CeaError> {
        let tangent = self.tangent(common.case, state)?;
        common.dofs = common.dofs.max(tangent.unknowns.len());
        let watch = PartWatch { whole: common.progress, prefix, is_heard: true };
        if let Some(symmetry) = &self.symmetry {
            let highest = request.friction_coefficients.iter().fold(0.0, |m: f64, mu| m.max(*mu));
            match CyclicTangent::new(&tangent, symmetry, (self.mesh.node_count(), highest)) {
                Ok(waves) => return sparse::sweep_by_diameters(&tangent, &waves, request, &watch),
                Err(why) => common.asymmetry = common.asymmetry.take().or(Some(why)),
            }
        }
        if request.is_continued && common.rest.is_none() {
            common.rest = Some(FrictionlessModes::compute(&tangent, request.limit)?);
        }
        let rest = common.rest.as_ref().filter(|_| request.is_continued);
        sparse::sweep_sharing(&tangent, request, rest, &watch)
    }
}

/// Difference of friction coefficients at which contact points open or close that is round-off.
const SAME_CHANGE: f64 = 1e-8;

/// A friction coefficient among those of a sweep, as that has it.
fn place_of(solved: &[f64], friction: f64) -> Option<f64> {
    solved.iter().copied().find(|own| (own - friction).abs() <= SAME_CHANGE)
}

/// Where in a gap the next state is solved: where a branch may change its stability, every fourth time in the middle.
fn place_in(Undecided { gap, guess }: &Undecided, round: usize) -> f64 {
    let least = LEAST_SHARE * (gap.end - gap.start);
    let guess = guess.filter(|_| round % 4 != 3);
    guess.unwrap_or(0.5 * (gap.start + gap.end)).clamp(gap.start + least, gap.end - least)
}

/// What there is to say of contact points that open or close within a sweep.
fn contact_notes(range: &PressedRange, parts: &[Part]) -> Vec<String> {
    let place = |k: usize| {
        let unknown = range.unknown_between(k);
        match unknown.is_empty() {
            true => format!("{:.6}", unknown.start),
            false => format!("{:.6} to {:.6} (several)", unknown.start, unknown.end),
        }
    };
    let mut places: Vec<String> = (0..range.changes.len()).map(place).collect();
    if let ([first, .., last], true) = (&range.changes[..], places.len() > MOST_PLACES) {
        places = vec![format!("{first:.6} to {last:.6} ({} times or more)", places.len())];
    }
    let listed = |all: Vec<String>, by: &str| (!all.is_empty()).then(|| all.join(by));
    let opening = listed(places, ", ").map(|places| {
        format!(
            "contact points open or close at friction coefficients {places}: the stiffness jumps \
             there, and branches are continued by the nearest eigenvalue"
        )
    });
    let jump = listed(jumps(parts).map(|mu| format!("{mu:.6}")).collect(), ", ").map(|places| {
        format!(
            "at friction {places} the growth of a mode jumps across zero as contact points open or close"
        )
    });
    let gaps = undecided(parts).map(|own| format!("{} and {}", own.gap.start, own.gap.end));
    let unknown = listed(gaps.collect(), ", between ").map(|gaps| {
        format!(
            "between friction {gaps} contact points open or close, and no state could be solved. A mode changes its \
             stability there; its critical friction is known no more closely"
        )
    });
    let coarse = (range.left_out > COARSE).then(|| {
        format!(
            "contact forces between the friction values are known to a share of {:.0e} of the largest only, as they \
             grow steeply with friction. Eigenvalues may be wrong by about as much. Ask for values closer together or, \
             near a value at which sliding jams, for lower ones",
            range.left_out
        )
    });
    opening.into_iter().chain(jump).chain(unknown).chain(coarse).collect()
}
