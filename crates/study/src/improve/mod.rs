//! What silences the unstable modes of a case. Derivatives by every place of its bodies come first. The best of them
//! are looked at with all modes together, the best of those run again as cases of their own.
//!
//! ```no_run
//! use frictionsim::case::Case;
//! use frictionsim::study::improve::improve;
//!
//! let case = Case::parse("disc", &std::fs::read("cases/polycarbonate-disc.toml")?, &[])?;
//! for candidate in improve(&case)?.summary.candidates {
//!     println!("{} {}: {}", candidate.kind, candidate.place(), candidate.verdict);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod attached;
mod base;
mod confirm;
mod fields;
mod modal;
mod trial;

use super::mac::whole_mesh_note;
use crate::*;
pub(super) use base::refuse_bodies;
use base::{Base, target_modes};
use confirm::{keys_of, run_again, verdict};
use fields::{Derivatives, element_terms, matrices};
use frictionsim_physics::fem::lumped_masses;
use frictionsim_results::improve::{Candidate, ImproveSummary, Improvement, Sizes, State};
use modal::{Change, ModalModel};
use trial::{Places, Search, Target, Trial, added_mass, target_fields};

/// Removals that are looked at closely, for each one that is listed.
const SHORTLISTED: usize = 2;

/// Finds what silences the unstable modes of a case at its friction coefficient, as its `[improve]` asks.
///
/// # Errors
/// A body that is solved by its symmetry, nothing that grows; those of the solver.
pub fn improve(case: &Case) -> Result<Improvement, StudyError> {
    let cea = case.require_cea()?;
    let mut notes = whole_mesh_note(case);
    let case = &*case.on_whole_mesh()?;
    let base = Base::solve(case, cea)?;
    let sizes = sizes(&base);
    let targets = base.targets().into_iter();
    let derivatives: Vec<_> = targets.map(|mode| Derivatives::of(&base, mode)).collect();
    let search = Search {
        places: Places::of(&base, sizes.patch_radius_m)?,
        derivatives: &derivatives,
        base: &base,
        sizes,
    };
    let modal = ModalModel::new(&base).map_err(CeaError::from)?;

    // The best places of each kind, and what all modes make of them.
    let asked = &case.improve.modifications;
    let is_asked = |kind: &ModificationKind| asked.is_empty() || asked.contains(kind);
    let mut listed: Vec<(usize, Candidate)> = Vec::new();
    for kind in ModificationKind::all().filter(is_asked) {
        let predicted = predictions(&search, &modal, kind, &mut notes)?;
        if predicted.is_empty() {
            let is_offset = kind == ModificationKind::Offset && !search.places.has_hole;
            let why = ["no place of this size helps", "no hole has a rigid cylinder in it"];
            notes.push(format!("{}: {}", kind.word(), why[usize::from(is_offset)]));
        }
        listed.extend(predicted.into_iter().enumerate());
    }
    order::sort_by_number(&mut listed, |(_, own)| predicted_growth(own));

    // The best of each kind before the second best of any.
    let mut order: Vec<usize> = (0..listed.len()).collect();
    order.sort_by_key(|&i| (listed[i].0, i));
    order.truncate(case.improve.confirm);
    order.sort_unstable();
    let run = |&i: &usize| (i, run_again(&base, &listed[i].1.keys));
    let outcomes: Vec<_> = parallel::map(&order, run);
    let mut candidates: Vec<Candidate> = listed.into_iter().map(|(_, own)| own).collect();
    for (i, outcome) in outcomes {
        candidates[i].verdict = match &outcome {
            Ok(state) => verdict(&base.state, state),
            Err(reason) => format!("struck off: {reason}"),
        };
        candidates[i].confirmed = outcome.ok();
    }
    promote(&mut candidates);
    // Those that coincide have no vectors of their own.
    let multiple = base.listed.len() - base.modes.len();
    if multiple > 0 {
        notes.push(format!(
            "{multiple} of the modes coincide with another one and are left out of the predictions"
        ));
    }
    if let ModeLimit::MaxFrequency(limit_hz) = base.reach {
        notes.push(format!(
            "modes above {limit_hz:.0} Hz are not looked at, with a modification or without: raise cea.modes or \
             cea.max_frequency_hz to see what grows there"
        ));
    }
    let summary = ImproveSummary {
        dofs: base.tangent.unknowns.len(),
        friction_coefficient: base.friction,
        base: base.state,
        modes: target_modes(&base),
        sizes,
        extent: extent_of(case),
        candidates,
        notes,
    };
    Ok(Improvement { summary, mesh: Arc::clone(&base.mesh), fields: target_fields(&search) })
}

/// Sizes of the modifications that the case gives, or that follow, to four digits, from its bodies and the fastest of
/// its targets.
fn sizes(base: &Base<'_>) -> Sizes {
    let asked = &base.case.improve;
    let worst = base.state.frequency_hz.map_or(1.0, |own| TAU * own);
    let masses = lumped_masses(&base.mesh, base.case.materials());
    let own = |asked: Option<f64>, usual: f64| asked.unwrap_or(rounded(usual, 4));
    let mass = own(asked.mass, 0.01 * base.case.depth() * masses.iter().sum::<f64>());
    let size = base.case.body.size();
    Sizes {
        mass_kg: mass,
        stiffness_n_per_m: own(asked.stiffness, worst * worst * mass),
        damping_n_s_per_m: own(asked.damping, 0.1 * worst * mass),
        patch_radius_m: own(asked.patch_radius, 0.05 * size),
        patch_damping_s: own(asked.patch_damping, 0.1 / worst),
        offset_m: own(asked.offset, 0.1 * size),
    }
}

/// The candidates of one kind, the best first.
fn predictions(
    search: &Search<'_>,
    modal: &ModalModel<'_>,
    kind: ModificationKind,
    notes: &mut Vec<String>,
) -> Result<Vec<Candidate>, StudyError> {
    let count = search.base.case.improve.candidates;
    let mut trials = search.best(kind);
    if kind == ModificationKind::Removal {
        trials = shortlist(search, modal, trials, SHORTLISTED * count)?;
    }
    let changes: Vec<Result<(Change, Trial), String>> =
        parallel::map(trials, |trial| Ok((change(search, modal, &trial)?, trial)));
    let failed = changes.iter().filter_map(|own| own.as_ref().err());
    notes.extend(failed.map(|reason| format!("{}: {reason}", kind.word())));
    let changes: Vec<(Change, Trial)> = changes.into_iter().flatten().collect();

    // By the growth of all modes together.
    let outlooks: Result<Vec<State>, _> = parallel::map(&changes, |(own, _)| modal.outlook(own));
    let outlooks = outlooks.map_err(CeaError::from)?;
    let growth = |i: usize| outlooks[i].growth_rate_per_s.unwrap_or(f64::NEG_INFINITY);
    let mut order = sorted(0..changes.len(), |&i| growth(i));
    let before = search.base.state.growth_rate_per_s.unwrap_or(f64::INFINITY);
    order.retain(|&i| growth(i) < before);
    order.truncate(count);
    Ok(order.into_iter().map(|i| candidate(search, &changes[i].1, outlooks[i])).collect())
}

/// What a trial changes in the space of the modes.
fn change(search: &Search<'_>, modal: &ModalModel<'_>, trial: &Trial) -> Result<Change, String> {
    let (base, sizes) = (search.base, &search.sizes);
    let d = base.mesh.dimension;
    match (&trial.target, trial.kind) {
        (Target::Node(node, direction), kind) => {
            let dofs: Vec<usize> = (0..d).map(|axis| d * node + axis).collect();
            let amount = search.attached(kind).1 / base.case.depth();
            let of = |law: Matrix3<f64>| {
                let own = base.mesh.in_frame(*node, &law);
                DMatrix::from_fn(d, d, |i, j| amount * own[(i, j)])
            };
            let (matrix, [coriolis, centrifugal]) =
                (of(confirm::law(*direction)), base.turning.map(of));
            let none = || DMatrix::<f64>::zeros(d, d);
            let alpha = base.options.damping.mass_coefficient;
            let matrices = match kind {
                ModificationKind::Mass => [matrix.clone(), matrix * alpha + coriolis, centrifugal],
                ModificationKind::Spring => [none(), none(), matrix],
                _ => [none(), matrix, none()],
            };
            Ok(modal.attached(&dofs, matrices.each_ref()))
        }
        (Target::Patch(_, elements), kind) => {
            let (dofs, matrices) = patch_matrices(base, elements, kind, sizes.patch_damping_s);
            if kind != ModificationKind::Removal {
                return Ok(modal.yielding(&dofs, matrices.each_ref()));
            }
            let is_shared = shared(search, elements, &dofs);
            let removed = modal.removed((&dofs, &is_shared), matrices.each_ref());
            removed.ok_or_else(|| "nothing is left beside what is taken away".to_owned())
        }
        (Target::Hole(_), _) => {
            let tangent = confirm::tangent_of(base, &keys_of(search, trial))?;
            modal.to(&tangent).ok_or_else(|| "the unknowns change with it".to_owned())
        }
    }
}

/// The removals of some that the listed modes alone, which see no more than the mass and stiffness lost, rank first.
fn shortlist(
    search: &Search<'_>,
    modal: &ModalModel<'_>,
    trials: Vec<Trial>,
    count: usize,
) -> Result<Vec<Trial>, StudyError> {
    let growth = |trial: Trial| -> Result<(f64, Trial), frictionsim_physics::linalg::LinalgError> {
        let Target::Patch(_, elements) = &trial.target else { return Ok((f64::INFINITY, trial)) };
        let (dofs, own) = patch_matrices(search.base, elements, trial.kind, 0.0);
        let [m, c, k] = own.map(|matrix| -matrix);
        let outlook = modal.outlook(&modal.local(&dofs, [&m, &c, &k]))?;
        Ok((outlook.growth_rate_per_s.unwrap_or(f64::NEG_INFINITY), trial))
    };
    let ranked: Result<Vec<(f64, Trial)>, _> = parallel::map(trials, growth);
    let ranked = sorted(ranked.map_err(CeaError::from)?, |own| own.0).into_iter();
    Ok(ranked.take(count).map(|(_, trial)| trial).collect())
}

/// Which dofs of a patch belong to elements beside it too.
fn shared(search: &Search<'_>, elements: &[u32], dofs: &[usize]) -> Vec<bool> {
    let mesh = &search.base.mesh;
    let mut inside: BTreeMap<u32, u32> = BTreeMap::new();
    let all = elements.iter().flat_map(|&element| mesh.element_nodes(element as usize));
    all.for_each(|&node| *inside.entry(node).or_default() += 1);
    let nodes = dofs.iter().map(|dof| dof / mesh.dimension);
    nodes.map(|node| inside.get(&(node as u32)) < Some(&search.places.uses[node])).collect()
}

/// The dofs of a patch, rising, and its mass, damping and stiffness, or what damping it changes of them.
fn patch_matrices(
    base: &Base<'_>,
    elements: &[u32],
    kind: ModificationKind,
    beta: f64,
) -> (Vec<usize>, [DMatrix<f64>; 3]) {
    let all = elements.iter().map(|&e| base.mesh.element_dofs(e as usize).collect());
    let all: Vec<Vec<usize>> = all.collect();
    let own = Vec::from_iter(all.iter().flatten().copied().collect::<BTreeSet<usize>>());
    let mut sums = [0, 1, 2].map(|_| DMatrix::<f64>::zeros(own.len(), own.len()));
    for (&element, dofs) in elements.iter().zip(&all) {
        let terms = match kind {
            ModificationKind::Removal => element_terms(base, element as usize),
            _ => {
                let [mass, elastic] = matrices(base, element as usize);
                [mass * 0.0, &elastic * beta, elastic * 0.0]
            }
        };
        let places: Vec<usize> = dofs.iter().map(|dof| own.partition_point(|o| o < dof)).collect();
        for (sum, term) in sums.iter_mut().zip(terms) {
            for (j, &column) in places.iter().enumerate() {
                for (i, &row) in places.iter().enumerate() {
                    sum[(row, column)] += term[(i, j)];
                }
            }
        }
    }
    (own, sums)
}

/// A trial with what all modes together make of it, before it is run again.
fn candidate(search: &Search<'_>, trial: &Trial, predicted: State) -> Candidate {
    let (node, direction) = match &trial.target {
        Target::Node(node, direction) => (Some(search.base.mesh.node_label(*node)), *direction),
        _ => (None, None),
    };
    Candidate {
        rank: 0,
        kind: trial.kind.word().to_owned(),
        node,
        position_m: search.place(trial),
        direction,
        added_mass_kg: added_mass(search, trial),
        first_order_growth_rate_per_s: trial.first_order,
        predicted,
        confirmed: None,
        verdict: "not run again".to_owned(),
        keys: keys_of(search, trial),
    }
}

/// The growth rate that all modes together predict, 1/s.
fn predicted_growth(own: &Candidate) -> f64 {
    own.predicted.growth_rate_per_s.unwrap_or(f64::NEG_INFINITY)
}

/// Puts what was struck off behind what was not, and ranks all: by the critical friction of the runs, else by growth.
fn promote(candidates: &mut [Candidate]) {
    let class = |own: &Candidate| match own.verdict.as_str() {
        "silenced" => 0,
        "confirmed" => 1,
        "not run again" => 2,
        _ => 3,
    };
    let merit = |own: &Candidate| match own.confirmed {
        Some(state) => -state.critical_friction.unwrap_or(f64::INFINITY),
        None => predicted_growth(own),
    };
    candidates.sort_by(|a, b| class(a).cmp(&class(b)).then(merit(a).total_cmp(&merit(b))));
    for (place, own) in candidates.iter_mut().enumerate() {
        own.rank = place + 1;
    }
}
