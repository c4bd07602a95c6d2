//! Friction sweep of a whole mesh whose contact nodes open or close within the range.

use super::Progress;
use crate::case::{Case, Cea, CeaMethod};
use crate::cea::sparse;
use crate::cea::{
    CeaError, FrictionPoint, FrictionSweep, ModeCount, ModeVectors, PartWatch, SweepRequest,
    UnstableInterval,
};
use crate::fem::assemble_stiffness;
use crate::mesh::{CyclicSymmetry, Mesh};
use crate::prestress::{
    CyclicTangent, SlidingRange, SlidingTangent, SteadySliding, TangentOptions,
};
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
            SlidingRange::solve_with(&mesh, &stiffness, sliding, options.contact.law, &frictions)?;
        Ok(Self {
            symmetry: used_symmetry(case, &mesh),
            mesh,
            range,
            options,
        })
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

    /// Solves the sparse eigenproblems at the friction coefficients that it was made for: each base state has a tangent and a
    /// sweep of its own, which the friction coefficients where one state gives way to the next end and begin.
    ///
    /// # Errors
    /// Those of the solver.
    pub(super) fn sweep(
        &self,
        case: &Case,
        request: &SweepRequest<'_>,
        progress: &Progress<'_>,
    ) -> Result<StatesSweep, CeaError> {
        let range = &self.range;
        let tangent = |k: usize| Ok(self.tangent(case, &range.states[k]));
        let states = States {
            count: range.states.len(),
            state_of: &range.state_of,
            changes: &range.changes,
            tangent: &tangent,
            symmetry: self.symmetry.map(|own| (own, self.mesh.node_count())),
        };
        states.sweep(request, progress)
    }

    /// Where contact nodes open or close.
    pub fn changes_note(&self) -> Option<String> {
        let changes = &self.range.changes;
        let list: Vec<String> = changes.iter().map(|mu| format!("{mu:.6}")).collect();
        (!list.is_empty()).then(|| {
            format!(
                "contact nodes open or close at friction coefficients {}: the tangent changes there, and branches are matched \
                 across by their eigenvalues",
                list.join(", ")
            )
        })
    }
}

/// The symmetry of a mesh that the eigenvalue analysis of a case uses: none where the whole mesh is asked for.
pub(super) fn used_symmetry(case: &Case, mesh: &Mesh) -> Option<CyclicSymmetry> {
    let is_whole = |cea: &Cea| cea.method == CeaMethod::Sparse;
    mesh.symmetry
        .filter(|_| !case.cea.as_ref().is_some_and(is_whole))
}

/// Base states over the friction coefficients of a sweep.
pub(super) struct States<'a> {
    /// How many there are.
    pub count: usize,
    /// Which one each friction coefficient has.
    pub state_of: &'a [usize],
    /// Friction coefficients at which one gives way to the next.
    pub changes: &'a [f64],
    /// The tangent of each.
    pub tangent: &'a dyn Fn(usize) -> Result<SlidingTangent, CeaError>,
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
}

impl States<'_> {
    /// A sweep of each state with its tangent, which the friction coefficients where one gives way to the next end and begin.
    ///
    /// # Errors
    /// Those of the solver.
    pub(super) fn sweep(
        &self,
        request: &SweepRequest<'_>,
        progress: &Progress<'_>,
    ) -> Result<StatesSweep, CeaError> {
        let frictions = request.friction_coefficients;
        let (mut parts, mut dofs, mut asymmetry) = (Vec::new(), 0, None);
        for k in 0..self.count {
            let own = frictions.iter().zip(self.state_of);
            let mut values: Vec<f64> = own.filter(|(_, s)| **s == k).map(|(mu, _)| *mu).collect();
            if values.is_empty() {
                continue;
            }
            // Branches are followed up to the change on either side.
            values.extend(k.checked_sub(1).and_then(|before| self.changes.get(before)));
            values.extend(self.changes.get(k));
            values.sort_by(f64::total_cmp);
            values.dedup();
            let tangent = (self.tangent)(k)?;
            dofs = dofs.max(tangent.unknowns.len());
            let part = SweepRequest {
                friction_coefficients: &values,
                ..*request
            };
            let watch = PartWatch {
                whole: progress,
                prefix: format!("state-{k}-"),
                is_heard: true,
            };
            let waves = self
                .symmetry
                .as_ref()
                .map(|(symmetry, node_count)| CyclicTangent::new(&tangent, symmetry, *node_count));
            parts.push(match waves {
                Some(Ok(waves)) => sparse::sweep_by_diameters(&tangent, &waves, &part, &watch)?,
                Some(Err(why)) => {
                    asymmetry.get_or_insert(why);
                    sparse::sweep(&tangent, &part, &watch)?
                }
                None => sparse::sweep(&tangent, &part, &watch)?,
            });
        }
        Ok(StatesSweep {
            is_by_diameters: self.symmetry.is_some() && asymmetry.is_none(),
            sweep: joined(parts, frictions),
            dofs,
            asymmetry,
        })
    }
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
    let ended = parts.iter().flat_map(|part| part.ended.iter().copied());
    let ended = ended.collect();
    let counts = parts.iter().flat_map(|part| part.counts.clone());
    let mut counts: Vec<ModeCount> = counts
        .filter(|count| frictions.contains(&count.friction_coefficient))
        .collect();
    counts.dedup_by(|b, a| a.friction_coefficient == b.friction_coefficient);
    let mut found: Vec<(UnstableInterval, Option<ModeVectors>)> = Vec::new();
    let pairs = parts
        .into_iter()
        .flat_map(|part| part.intervals.into_iter().zip(part.crossings));
    for (interval, crossing) in pairs {
        // A branch that is unstable on both sides of a change goes on.
        let same = found.iter_mut().find(|(known, _)| {
            known.branch == interval.branch
                && known.harmonic == interval.harmonic
                && known.restabilized.is_none()
        });
        match same {
            Some((known, _)) if interval.unstable_from_start => {
                known.restabilized = interval.restabilized
            }
            _ => found.push((interval, crossing)),
        }
    }
    FrictionSweep {
        counts,
        ..FrictionSweep::joined(points, found, ended)
    }
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
            if old.nodal_diameters == new.nodal_diameters {
                pairs.push(((old.eigenvalue - new.eigenvalue).norm(), i, j));
            }
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
