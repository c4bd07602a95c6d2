//! Motions of two frequencies beside the cycles that lose their stability to another wave.

use super::{CycleStudy, frames};
use frictionsim_physics::cea::{PartWatch, SweepWatch};
use frictionsim_physics::cycle::{CycleError, CycleSolver, LimitCycle, Verdict};
use frictionsim_results::cycle::{CycleResult, TwoWaveSummary, known};

impl CycleStudy<'_> {
    /// For each family the motion in which its wave and the one that grows on it live together: from the cycle at the
    /// case's own operating point where it is unstable, else from the first unstable one of its branch. `watch` keeps
    /// what is done for a search that goes on after an interruption.
    pub fn two_waves(
        &self,
        results: &[CycleResult],
        watch: &dyn SweepWatch,
    ) -> Vec<TwoWaveSummary> {
        if !self.choices.two_frequencies {
            return Vec::new();
        }
        let solvers = self.solvers.iter().zip(results);
        let solvers = solvers.filter_map(|(solver, result)| Some((solver.as_ref().ok()?, result)));
        let mut found: Vec<TwoWaveSummary> = Vec::new();
        for (solver, result) in solvers {
            let Some((cycle, second)) = loses_to_another(result) else { continue };
            let harmonics = [result.name.harmonic, second];
            let is_same = |own: &&TwoWaveSummary| {
                own.error.is_none() && own.harmonics == [harmonics[1], harmonics[0]]
            };
            if found.iter().find(is_same).is_none() {
                let [first, second] = harmonics;
                let watch = PartWatch {
                    whole: watch,
                    prefix: format!("two-waves-n{first}-n{second}-"),
                    is_heard: false,
                };
                found.push(self.beside(solver, cycle, harmonics, &watch));
            }
        }
        found
    }

    fn beside(
        &self,
        solver: &CycleSolver,
        cycle: &LimitCycle,
        harmonics: [usize; 2],
        watch: &dyn SweepWatch,
    ) -> TwoWaveSummary {
        let onset = self.onsets_of(harmonics[1]).into_iter().next();
        let direction = onset.map_or(-1, |onset| isize::from(onset.direction));
        let second = -direction * harmonics[1] as isize;
        let search = || {
            let found = solver.stepping(self.simd)?.two_waves(cycle, second, None, watch)?;
            let (waves, motion) = (&found.waves, &found.motion);
            let branch = self.continuation.as_ref();
            let branch =
                branch.map(|(parameter, values)| waves.follow(motion, *parameter, values, watch));
            // Over one period of the first wave; the second has moved on by then.
            let period = 1.0 / motion.frequencies_hz()[0];
            let frames = frames(|time| waves.field(motion, time), period, self.choices.frames);
            let thickness = self.case.thickness;
            let own = TwoWaveSummary::of(harmonics, &found, branch.as_ref(), thickness);
            Ok(TwoWaveSummary { frames, ..own })
        };
        search().unwrap_or_else(|error: CycleError| {
            TwoWaveSummary::failed(harmonics, error.to_string())
        })
    }
}

/// The cycle of a family that loses its stability to a wave of another harmonic, at the case's own operating point or
/// first along the branch, and that harmonic.
fn loses_to_another(result: &CycleResult) -> Option<(&LimitCycle, usize)> {
    let found = result.outcome.as_ref().ok()?;
    let along = found.branch.iter().flat_map(|branch| &branch.cycles).zip(&found.branch_stability);
    [(&found.cycle, &found.stability)].into_iter().chain(along).find_map(|(cycle, finding)| {
        let leading = known(finding)?.leading()?;
        let other = leading.mode?.harmonic;
        let is_other = other != result.name.harmonic && other > 0;
        (leading.verdict() == Verdict::Unstable && is_other).then_some((cycle, other))
    })
}
