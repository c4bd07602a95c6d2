//! What a sweep found: points, unstable intervals, shapes.

use super::{SETTLED, SparseSweep};
use crate::cea::sparse::branches::{BranchLabel, TrackedBranch};
use crate::cea::sparse::onset::{FoundInterval, OnsetFinder, State};
use crate::cea::{CeaError, ComplexMode, FrictionPoint, FrictionSweep, SweepRequest};
use crate::cea::{EndedMode, UnconvergedMode};
use crate::linalg::c64;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Rounds of corrections of the modes at crossings.
const MOST_CORRECTIONS: usize = 8;

impl SparseSweep<'_> {
    /// The result, with shapes and critical friction coefficients.
    ///
    /// # Errors
    /// As [`crate::cea::sparse::sweep`].
    pub fn finish(
        &mut self,
        request: &SweepRequest<'_>,
        branches: &[TrackedBranch],
    ) -> Result<FrictionSweep, CeaError> {
        let frictions = request.friction_coefficients.iter();
        let points = frictions
            .map(|&mu| {
                let k = self.grid.partition_point(|&g| g < mu);
                self.friction_point(k, request.shapes_at.contains(&mu), branches)
            })
            .collect();
        let mut found = self.intervals(branches)?;
        let critical = |own: &FoundInterval| own.interval.critical_friction;
        found.sort_by(|a, b| critical(a).total_cmp(&critical(b)));
        let vectors = |own: &FoundInterval| {
            let State { mu, mode } = own.onset().filter(|_| !request.shapes_at.is_empty())?;
            let solver = self.point_solver();
            let found =
                solver.vectors(self.builder.model_and_factors(), *mu, std::slice::from_ref(mode));
            found.into_iter().next()
        };
        let crossings = found.iter().map(vectors).collect();
        Ok(FrictionSweep {
            points,
            intervals: found.into_iter().map(|own| own.interval).collect(),
            crossings,
            ended: self.ended(branches),
            unconverged: self.unconverged(),
            rigid_motions: self.builder.rigid,
            counts: Vec::new(),
        })
    }

    /// The modes that no iteration made converge.
    fn unconverged(&self) -> Vec<UnconvergedMode> {
        let each = self.unconverged.iter().map(|&(friction_coefficient, frequency)| {
            UnconvergedMode { friction_coefficient, frequency_hz: frequency / TAU }
        });
        each.collect()
    }

    /// The modes whose branches end.
    fn ended(&self, branches: &[TrackedBranch]) -> Vec<EndedMode> {
        let ended = branches.iter().filter_map(|branch| {
            let end = branch.end?;
            let point = &self.points[end.after];
            let last = branch.modes[end.after]?;
            let next = &self.points[end.after + 1];
            Some(EndedMode {
                frequency_hz: point.modes[last].eigenvalue.im / TAU,
                friction_coefficient: point.friction_coefficient,
                lost_before: (!end.is_damped).then_some(next.friction_coefficient),
            })
        });
        let mut ended: Vec<EndedMode> = ended.collect();
        ended.sort_by(|a, b| a.friction_coefficient.total_cmp(&b.friction_coefficient));
        ended
    }

    /// Unstable intervals of all branches. The basis holds the modes of a few friction coefficients only, or of all that were asked for:
    /// the modes at crossings are corrected until these settle, one by one, and by the full problem where one misses its residual.
    fn intervals(&mut self, branches: &[TrackedBranch]) -> Result<Vec<FoundInterval>, CeaError> {
        let mut settled: Vec<f64> = Vec::new();
        let mut known: Vec<Vec<FoundInterval>> = Vec::new();
        for round in 0.. {
            let found = self.find_intervals(branches, &known)?;
            let all = || found.iter().flatten();
            let crossings = || all().flat_map(FoundInterval::crossings);
            let places: Vec<f64> = crossings().map(|state| state.mu).collect();
            let mut pairs = places.iter().zip(&settled);
            let has_settled = places.len() == settled.len()
                && pairs.all(|(new, old)| (new - old).abs() <= SETTLED);
            let missed: Vec<&State> = all().filter_map(FoundInterval::missed).collect();
            let is_spent = round == MOST_CORRECTIONS;
            let mut has_grown = false;
            if self.builder.is_sampling() && !has_settled && !is_spent {
                for State { mu, mode } in crossings() {
                    has_grown |= self.builder.refine_mode(*mu, mode);
                }
            }
            if !has_grown && (missed.is_empty() || is_spent) {
                let open = missed.iter().map(|state| (state.mu, state.mode.eigenvalue.im));
                self.unconverged.extend(open);
                return Ok(found.into_iter().flatten().collect());
            }
            for State { mu, mode } in missed.iter().filter(|_| !has_grown) {
                self.builder.shift(*mu, std::slice::from_ref(mode))?;
            }
            // What a basis that missed a crossing says about the other branches is worth no more: all are looked at again.
            known = if missed.is_empty() { found } else { Vec::new() };
            settled = places;
        }
        unreachable!("rounds end")
    }

    /// The intervals of each branch in the basis as it is; in a basis that grew, crossings are near where they were.
    fn find_intervals(
        &self,
        branches: &[TrackedBranch],
        known: &[Vec<FoundInterval>],
    ) -> Result<Vec<Vec<FoundInterval>>, CeaError> {
        let solver = self.point_solver();
        let of_branch = |i: usize| {
            let mut finder = OnsetFinder {
                solver: &solver,
                model: &self.builder.model,
                points: &self.points,
                lowest: self.lowest,
            };
            let again = known.get(i).and_then(|own| finder.again(&branches[i], own));
            match again {
                Some(intervals) => Ok(intervals),
                None => finder.intervals(&branches[i]),
            }
        };
        let found: Result<Vec<_>, _> = (0..branches.len()).into_par_iter().map(of_branch).collect();
        Ok(found?)
    }

    fn friction_point(
        &self,
        k: usize,
        with_shapes: bool,
        branches: &[TrackedBranch],
    ) -> FrictionPoint {
        let point = &self.points[k];
        let wanted = &point.modes[..point.wanted];
        let (solver, mu) = (self.point_solver(), point.friction_coefficient);
        let vectors = match with_shapes {
            true => solver.vectors(self.builder.model_and_factors(), mu, wanted),
            false => Vec::new(),
        };
        let mut vectors = vectors.into_iter();
        let modes = wanted.iter().zip(&point.checks).enumerate().map(|(i, (mode, check))| {
            let branch = branches.iter().find(|b| b.modes[k] == Some(i));
            let label = branch.map_or_else(
                || BranchLabel { harmonic: self.edge.harmonic(&check.edge, check.peak), branch: 1 },
                |b| b.label,
            );
            // Without friction any combination of a degenerate pair is a mode: it has no direction.
            let direction = match point.friction_coefficient {
                0.0 => 0,
                _ => self.edge.direction(&check.edge, label.harmonic),
            };
            // A body that turns without damping neither grows nor decays but by round-off.
            let is_round_off = self.tangent.is_gyroscopic
                && mode.eigenvalue.re.abs() <= check.uncertainty * mode.eigenvalue.norm();
            let own = vectors.next();
            let (shape, left) = own.map(|own| (own.right, own.left)).unzip();
            ComplexMode {
                eigenvalue: match is_round_off {
                    true => c64::new(0.0, mode.eigenvalue.im),
                    false => mode.eigenvalue,
                },
                harmonic: label.harmonic,
                branch: label.branch,
                direction,
                nodal_diameters: None,
                residual: check.residual,
                uncertainty: check.uncertainty,
                contact_share: check.contact_share,
                axial_share: None,
                shape,
                left,
                wave: None,
            }
        });
        FrictionPoint { friction_coefficient: point.friction_coefficient, modes: modes.collect() }
    }
}
