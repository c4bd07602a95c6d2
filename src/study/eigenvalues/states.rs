//! Friction sweep of a whole mesh whose contact nodes open or close within the range.

mod joining;

use super::Progress;
use crate::case::{Case, Cea, CeaMethod};
use crate::cea::sparse;
use crate::cea::{CeaError, FrictionSweep, PartWatch, SweepRequest};
use crate::fem::assemble_stiffness;
use crate::mesh::{CyclicSymmetry, Mesh};
use crate::prestress::{
    CyclicTangent, PressedRange, SlidingRange, SlidingTangent, SteadySliding, TangentOptions,
};
use joining::{Part, Undecided, joined, jumps, label, undecided};
use std::sync::Arc;

/// A whole mesh and its steady sliding.
pub struct WholeMesh {
    /// The mesh.
    pub mesh: Arc<Mesh>,
    /// Steady sliding at the friction coefficients that are solved, and last at the case's own.
    pub range: SlidingRange,
    /// How the tangent is taken.
    pub options: TangentOptions,
    /// The symmetry that the eigenvalue analysis uses.
    pub symmetry: Option<CyclicSymmetry>,
}

impl WholeMesh {
    /// Solves the steady sliding of a case at some friction coefficients and at its own.
    ///
    /// # Errors
    /// A mesh that cannot be built; no state of steady sliding.
    pub fn solve(
        case: &Case,
        options: TangentOptions,
        frictions: &[f64],
    ) -> Result<Self, CeaError> {
        let sliding = &case.contact.sliding;
        let mesh = case.mesh()?;
        let stiffness = assemble_stiffness(&mesh, case.materials());
        let frictions = [frictions, &[sliding.friction_coefficient]].concat();
        let range =
            SlidingRange::solve(&mesh, &stiffness, sliding, options.contact.law, &frictions)?;
        Ok(Self { symmetry: used_symmetry(case, &mesh), mesh, range, options })
    }

    /// The state at the case's own friction coefficient.
    pub fn base(&self) -> &SteadySliding {
        let own = self.range.state_of.last();
        &self.range.states[*own.expect("the case's own friction coefficient comes last")]
    }

    /// The tangent of one state over the whole mesh.
    pub fn tangent(&self, case: &Case, state: &SteadySliding) -> SlidingTangent {
        let (materials, options) = (case.materials(), &self.options);
        let stiffness = assemble_stiffness(&self.mesh, materials);
        SlidingTangent::linearize(&self.mesh, materials, &stiffness, state, options)
    }

    /// Solves the sparse eigenproblems at the friction coefficients that it was made for: each base state has a tangent
    /// and a sweep of its own, which the friction coefficients where one state gives way to the next end and begin.
    pub(super) fn sweep(
        &self,
        case: &Case,
        request: &SweepRequest<'_>,
        progress: &Progress<'_>,
    ) -> Result<StatesSweep, CeaError> {
        let states = States {
            range: &self.range,
            solve: &|frictions| Ok(Self::solve(case, self.options, frictions)?.range),
            pressed: |state| &state.is_pressed,
            tangent: &|state| Ok(self.tangent(case, state)),
            symmetry: self.symmetry.map(|own| (own, self.mesh.node_count())),
        };
        states.sweep(request, progress)
    }
}

/// The symmetry of a mesh that the eigenvalue analysis of a case uses: none where the whole mesh is asked for.
pub(super) fn used_symmetry(case: &Case, mesh: &Mesh) -> Option<CyclicSymmetry> {
    let is_whole = |cea: &Cea| cea.method == CeaMethod::Sparse;
    mesh.symmetry.filter(|_| !case.cea.as_ref().is_some_and(is_whole))
}

/// Solves base states at friction coefficients.
type Solve<'a, S> = dyn Fn(&[f64]) -> Result<PressedRange<S>, CeaError> + 'a;

/// Base states over the friction coefficients of a sweep.
pub(super) struct States<'a, S> {
    /// Those at the friction coefficients of the sweep, which come first.
    pub range: &'a PressedRange<S>,
    /// Solves those at some friction coefficients, which come first.
    pub solve: &'a Solve<'a, S>,
    /// The contact points that are pressed in one.
    pub pressed: fn(&S) -> &[bool],
    /// The tangent of one.
    pub tangent: &'a dyn Fn(&S) -> Result<SlidingTangent, CeaError>,
    /// Symmetry of the mesh, and the number of its nodes.
    pub symmetry: Option<(CyclicSymmetry, usize)>,
}

/// What a sweep over base states found.
pub(super) struct StatesSweep {
    pub sweep: FrictionSweep,
    /// Unknowns of the whole mesh.
    pub dofs: usize,
    /// What keeps a mesh of equal sectors from being solved by waves around it.
    pub asymmetry: Option<String>,
    /// Whether waves around it were solved.
    pub is_by_diameters: bool,
    /// What there is to say of contact points that open or close.
    pub notes: Vec<String>,
}

/// What the parts of a sweep have in common.
#[derive(Default)]
struct Common {
    dofs: usize,
    asymmetry: Option<String>,
    /// Sweeps of earlier rounds, by the pressed points of their state and their friction coefficients.
    solved: Vec<(Vec<bool>, Vec<f64>, FrictionSweep)>,
}

/// Share of the largest contact force from which on it is said that base states leave that out.
const COARSE: f64 = 1e-7;
/// Rounds in which base states are solved where stability changes between two of them.
const MOST_ROUNDS: usize = 30;

impl<S> States<'_, S> {
    /// A sweep of each state with its tangent, which the friction coefficients where one gives way to the next end and
    /// begin.
    ///
    /// Between two friction coefficients asked for contact points may open or close one after the other. Where the
    /// stability of a branch changes there, the states between are solved too, by bisection, until one of them has the
    /// critical friction, or two meet there.
    pub(super) fn sweep(
        &self,
        request: &SweepRequest<'_>,
        progress: &Progress<'_>,
    ) -> Result<StatesSweep, CeaError> {
        let mut frictions = request.friction_coefficients.to_vec();
        // The base states of this round and of the last one.
        let (mut refined, mut earlier): (Option<PressedRange<S>>, Option<PressedRange<S>>) =
            (None, None);
        let mut common = Common::default();
        let (mut known, mut unsolved) = (frictions.len(), false);
        for round in 0.. {
            let range = refined.as_ref().unwrap_or(self.range);
            let place = (round, frictions.as_slice());
            let mut parts = match self.parts((range, place), request, progress, &mut common) {
                Ok(parts) => parts,
                // What is known without the states between is kept, and the rest said.
                Err(_) if frictions.len() > known => {
                    frictions.truncate(known);
                    (refined, unsolved) = (earlier.take(), true);
                    continue;
                }
                Err(error) => return Err(error),
            };
            label(&mut parts);
            let open: Vec<f64> = undecided(&parts).map(|own| place_in(&own, round)).collect();
            if open.is_empty() || round >= MOST_ROUNDS || unsolved {
                let notes = contact_notes(self.range, &parts);
                return Ok(StatesSweep {
                    is_by_diameters: self.symmetry.is_some() && common.asymmetry.is_none(),
                    sweep: joined(parts, request.friction_coefficients),
                    dofs: common.dofs,
                    asymmetry: common.asymmetry,
                    notes,
                });
            }
            let more = [frictions.as_slice(), &open].concat();
            match (self.solve)(&more) {
                Ok(range) => {
                    earlier = refined.replace(range);
                    known = frictions.len();
                    frictions = more;
                }
                // There may be no state between.
                Err(_) => unsolved = true,
            }
        }
        unreachable!("rounds end")
    }

    /// The sweeps of the states at `frictions`, by rising friction.
    fn parts(
        &self,
        (range, (round, frictions)): (&PressedRange<S>, (usize, &[f64])),
        request: &SweepRequest<'_>,
        progress: &Progress<'_>,
        common: &mut Common,
    ) -> Result<Vec<Part>, CeaError> {
        let mut parts = Vec::new();
        for (k, state) in range.states.iter().enumerate() {
            let own = frictions.iter().zip(&range.state_of);
            let mut values: Vec<f64> = own.filter(|(_, s)| **s == k).map(|(mu, _)| *mu).collect();
            if values.is_empty() {
                continue;
            }
            // Branches are followed up to the change on either side.
            let before = k.checked_sub(1);
            values.extend(before.map(|before| range.changes[before]));
            values.extend(range.changes.get(k));
            values.sort_by(f64::total_cmp);
            values.dedup();
            let begin = before.map_or(values[0], |before| range.unknown_between(before).end);
            let pressed = (self.pressed)(state);
            let known = common.solved.iter();
            let mut known = known.filter(|(set, at, _)| set == pressed && are_same(at, &values));
            let known = known.next().map(|(_, _, sweep)| sweep.clone());
            let sweep = match known {
                Some(sweep) => sweep,
                None => {
                    let name = match round {
                        0 => format!("state-{k}-"),
                        round => format!("round-{round}-state-{k}-"),
                    };
                    let is_continued = k > 0;
                    let own =
                        SweepRequest { friction_coefficients: &values, is_continued, ..*request };
                    let sweep = self.part(state, &own, (progress, name), common)?;
                    let key = (pressed.to_vec(), values, sweep.clone());
                    common.solved.push(key);
                    sweep
                }
            };
            parts.push(Part { begin, sweep });
        }
        Ok(parts)
    }

    /// The sweep of one state.
    fn part(
        &self,
        state: &S,
        request: &SweepRequest<'_>,
        (progress, name): (&Progress<'_>, String),
        common: &mut Common,
    ) -> Result<FrictionSweep, CeaError> {
        let tangent = (self.tangent)(state)?;
        common.dofs = common.dofs.max(tangent.unknowns.len());
        let watch = PartWatch { whole: progress, prefix: name, is_heard: true };
        let waves = self
            .symmetry
            .as_ref()
            .map(|(symmetry, node_count)| CyclicTangent::new(&tangent, symmetry, *node_count));
        match waves {
            Some(Ok(waves)) => sparse::sweep_by_diameters(&tangent, &waves, request, &watch),
            Some(Err(why)) => {
                common.asymmetry.get_or_insert(why);
                sparse::sweep(&tangent, request, &watch)
            }
            None => sparse::sweep(&tangent, request, &watch),
        }
    }
}

/// Difference of friction coefficients at which contact points open or close that is round-off.
const SAME_CHANGE: f64 = 1e-8;

/// Whether two lists are of the same friction coefficients.
fn are_same(one: &[f64], other: &[f64]) -> bool {
    let mut pairs = one.iter().zip(other);
    one.len() == other.len() && pairs.all(|(a, b)| (a - b).abs() <= SAME_CHANGE)
}

/// Where in a gap the next state is solved: where a branch may change its stability, every other time in the middle.
fn place_in(Undecided { gap, guess }: &Undecided, round: usize) -> f64 {
    let width = gap.end - gap.start;
    let is_inside = |mu: &f64| (mu - gap.start).min(gap.end - mu) > 0.01 * width;
    let guess = guess.filter(|mu| round.is_multiple_of(2) && is_inside(mu));
    guess.unwrap_or(0.5 * (gap.start + gap.end))
}

/// What there is to say of contact points that open or close within a sweep.
fn contact_notes<S>(range: &PressedRange<S>, parts: &[Part]) -> Vec<String> {
    let places = (0..range.changes.len()).map(|k| {
        let unknown = range.unknown_between(k);
        match unknown.is_empty() {
            true => format!("{:.6}", unknown.start),
            false => format!("{:.6} to {:.6} (several)", unknown.start, unknown.end),
        }
    });
    let places: Vec<String> = places.collect();
    let opening = (!places.is_empty()).then(|| {
        format!(
            "contact points open or close at friction coefficients {}: the tangent changes \
             there, and branches are matched across by their eigenvalues",
            places.join(", ")
        )
    });
    let jumps: Vec<String> = jumps(parts).map(|mu| format!("{mu:.6}")).collect();
    let jump = (!jumps.is_empty()).then(|| {
        format!(
            "at friction {} the growth of a mode jumps across zero as contact points open or close",
            jumps.join(", ")
        )
    });
    let undecided: Vec<String> = undecided(parts)
        .map(|own| format!("{:.6} and {:.6}", own.gap.start, own.gap.end))
        .collect();
    let unknown = (!undecided.is_empty()).then(|| {
        format!(
            "a mode changes its stability between friction {}, where contact points open or close \
             and the states between could not be solved. Its critical friction is only known to \
             lie there",
            undecided.join(", between ")
        )
    });
    let coarse = (range.left_out > COARSE).then(|| {
        format!(
            "contact forces between the friction values are known to a share of {:.0e} of the \
             largest only, as they grow steeply with friction. Eigenvalues may be wrong by about \
             as much. Ask for values closer together, or for one alone",
            range.left_out
        )
    });
    let all = opening.into_iter().chain(jump).chain(unknown);
    all.chain(coarse).collect()
}
