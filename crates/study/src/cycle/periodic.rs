//! Limit cycles of bodies without symmetry: one for each mode that grows from steady sliding.

mod faces;
mod steady;

use super::super::transient::SteppedMesh;
use super::families::{candidates, critical};
use crate::*;
use frictionsim_case::{Cycle, OnsetChoice, TimeStep};
use frictionsim_physics::cycle::periodic::{
    BranchRequest, Found, MotionRequest, PeriodMap, PeriodicBranch, PeriodicMotion, Point,
    REMAINDER, Sound, find_from, shortest,
};
use frictionsim_physics::cycle::{Confirmation, FloquetMultipliers};
use frictionsim_physics::fem::operator::StiffnessOperator;
use frictionsim_physics::transient::{OperatorChoice, TransientError};
use frictionsim_results::cycle::{
    CycleSummary, FoundCycle, ModeOfCycle, ModeSummary, MotionBody, Origin, PeriodicResult,
};
use frictionsim_results::summary::CriticalValue;

pub(crate) use steady::Steady;

use faces::faces_in_air;

/// Instants of the contact over a period where the case names no number.
const INSTANTS: usize = 180;

/// What a case asks for: the limit cycles of which modes.
pub struct PeriodicStudy<'a> {
    case: &'a Case,
    /// What the case says of its cycles.
    pub choices: &'a Cycle,
    stepped: SteppedMesh<'a>,
    simd: SimdLevel,
    /// The mode that grows fastest or decays slowest at the case's own operating point.
    least_stable: Option<ModeSummary>,
    /// Parameter and value at which the search starts, where no mode grows at the case's own.
    start: Option<(Parameter, f64)>,
    /// Where sliding loses its stability, where it is stable at the case's own operating point.
    critical: Option<CriticalValue>,
    /// Steady sliding where the search starts.
    steady: Steady,
    /// The modes whose cycles are sought, by falling growth: places among all.
    pub sought: Vec<usize>,
    continuation: Option<(Parameter, Vec<f64>)>,
}

impl<'a> PeriodicStudy<'a> {
    /// Steady sliding and its modes, with the lumped mass and without the geometric stiffness, as in the transient.
    ///
    /// Where none of them grows at the case's own operating point, and a range of a parameter is to be gone through,
    /// the search starts in the range where one does, at its ends first: the cycles that are born there may live on
    /// beside stable sliding.
    ///
    /// # Errors
    /// A bad case; a body without a state of steady sliding; those of the eigenvalue solver.
    pub fn new(case: &'a Case, simd: SimdLevel) -> Result<Self, StudyError> {
        let choices = case.require_cycle()?;
        let stepped = SteppedMesh::of(case)?;
        let continuation = choices.continuation.as_ref().map(|own| (own.parameter, own.values()));
        let mut steady = Steady::of(case, &stepped)?;
        let own = steady.least_stable().map(|place| sought(&steady, place));
        let (mut start, mut critical) = (None, None);
        match (steady.growing().is_empty(), &continuation) {
            (true, Some((parameter, values))) => {
                let here = parameter.of(&operating_point(case));
                let of = (case, &stepped);
                // Both ends of the range before what lies between.
                for value in candidates(values, here) {
                    let other = Steady::at(of, *parameter, value)?;
                    if !other.growing().is_empty() {
                        let onset = onset(of, *parameter, [here, value]);
                        critical = onset.map(|value| CriticalValue::of(*parameter, value));
                        (start, steady) = (Some((*parameter, value)), other);
                        break;
                    }
                }
            }
            (true, None) => {
                let friction = Steady::critical_friction(case, &stepped);
                critical =
                    friction.map(|value| CriticalValue::of(Parameter::FrictionCoefficient, value));
            }
            (false, _) => {}
        }
        let mut places = steady.growing();
        if choices.onsets == OnsetChoice::Lowest {
            places.truncate(1);
        }
        Ok(Self {
            case,
            choices,
            simd,
            least_stable: own,
            start,
            critical,
            steady,
            sought: places,
            continuation,
            stepped,
        })
    }

    fn body(&self) -> TransientModel<'_> {
        self.stepped.body(self.case)
    }

    /// The body with another value of a parameter, SI.
    fn body_at(&self, parameter: Parameter, value: f64) -> TransientModel<'_> {
        let mut point = operating_point(self.case);
        parameter.set(&mut point, value);
        self.stepped.body_at(self.case, &point)
    }

    /// The period map of a body for motions near a mode.
    fn map<'b>(
        &self,
        body: TransientModel<'b>,
        operator: &'b dyn StiffnessOperator,
        mode: &ComplexMode,
    ) -> Result<PeriodMap<'b>, TransientError> {
        PeriodMap::new(body, operator, mode.eigenvalue.im, longest_step(self.case))
    }

    /// The branch through a cycle over the parameter of the case.
    fn branch<'b>(
        &'b self,
        operator: &'b dyn StiffnessOperator,
        mode: &ComplexMode,
        found: &Found,
        watch: &dyn SweepWatch,
    ) -> Option<Result<PeriodicBranch, TransientError>> {
        let (parameter, values) = self.continuation.as_ref()?;
        let map = || self.map(self.body(), operator, mode);
        let tune = |map: &mut PeriodMap<'b>, value: f64| {
            let body = self.body_at(*parameter, value);
            if parameter.is_of_contact() {
                return map.retune(body.contact);
            }
            let mut next = self.map(body, operator, mode)?;
            next.follow(map);
            *map = next;
            Ok(())
        };
        let own = parameter.of(&operating_point(self.case));
        let request = BranchRequest {
            parameter: *parameter,
            values,
            kept: own,
            with_stability: self.choices.stability == StabilityChoice::Branch,
            map: &map,
            watch,
            tune: &tune,
        };
        let start = self.start.map_or(own, |start| start.1);
        Some(request.follow(start, found).map(|mut branch| {
            // Where steady sliding loses its stability, between where it has lost it and the farthest cycles.
            let ends = branch.beyond(start).into_iter().flatten();
            let of = (self.case, &self.stepped);
            branch.onsets =
                ends.filter_map(|stable| onset(of, *parameter, [stable, start])).collect();
            branch
        }))
    }

    /// The cycles, with the whole field at so many times over a period; `watch` keeps what is done for a search that
    /// goes on after an interruption, `done` hears of every result.
    ///
    /// # Errors
    /// A mesh that the time loop cannot take.
    pub fn run(
        &self,
        frames: usize,
        watch: &dyn SweepWatch,
        done: &(dyn Fn(&PeriodicResult) + Sync),
    ) -> Result<Vec<PeriodicResult>, StudyError> {
        let operator = self.body().operator(OperatorChoice::Auto, self.simd)?;
        let solve = |&place: &usize| {
            let start = Instant::now();
            let outcome = self.solve(operator.as_ref(), place, frames, watch);
            let result = PeriodicResult {
                name: ModeOfCycle {
                    mode: sought(&self.steady, place),
                    same_as: None,
                    sought_from: self.named_start().map(|(_, value)| value),
                },
                outcome: outcome.map_err(|error| error.to_string()),
                wall_s: start.elapsed().as_secs_f64(),
            };
            done(&result);
            result
        };
        let mut results: Vec<PeriodicResult> = parallel::map(&self.sought, solve);
        name_repeated(&mut results);
        Ok(results)
    }

    /// The parameter and its value, in units of its key, at which the search starts where that is not the case's own.
    fn named_start(&self) -> Option<(&'static str, f64)> {
        self.start.map(|(parameter, value)| (parameter.key(), parameter.in_key_units(value)))
    }

    /// The cycle of one mode, its stability, and what a transient says of it.
    fn solve(
        &self,
        operator: &dyn StiffnessOperator,
        place: usize,
        frames: usize,
        watch: &dyn SweepWatch,
    ) -> Result<FoundCycle, CycleError> {
        let mode = &self.steady.modes[place];
        // Where sliding is stable at the case's own value of the parameter, another one starts the search.
        let start = self.start;
        let body = start.map_or_else(|| self.body(), |(key, value)| self.body_at(key, value));
        let mut map = self.map(body, operator, mode)?;
        // From the growing mode to the motion that repeats itself, and along the parameter.
        let prefix = format!("mode{}-", place + 1);
        let watch: &dyn SweepWatch = &PartWatch { whole: watch, prefix, is_heard: false };
        let known = watch.recalled("cycle").and_then(|kept| Found::recalled(&mut map, kept));
        let mut found = match known {
            Some(found) => found,
            None => find_from(&mut map, &self.steady.mode(place))?,
        };
        watch.keep_value("cycle", &found);
        let mut branch = self.branch(operator, mode, &found, watch).transpose()?;
        if self.start.is_some() {
            (map, found) = self.here(operator, mode, branch.as_mut())?;
        }
        let request = MotionRequest {
            instants: self.choices.phases.unwrap_or(INSTANTS),
            frames: frames.max(1),
        };
        let motion = PeriodicMotion::of(&mut map, &found, request);
        // What small perturbations do, by multipliers and by a transient.
        let stability = (self.choices.stability != StabilityChoice::None).then(|| {
            FloquetMultipliers::of(&mut map, &found.state).map_err(|error| error.to_string())
        });
        let known = stability.as_ref().and_then(|found| found.as_ref().ok());
        let leading = known.and_then(FloquetMultipliers::leading).copied();
        let periods = self.choices.confirmation_periods;
        let confirmation = (periods > 0)
            .then(|| Confirmation::beside(&mut map, &found, leading.as_ref(), periods));
        let faces = faces_in_air(self.case, &self.stepped);
        let sound = (!faces.is_empty()).then(|| Sound::of(&mut map, &found.state, &faces));
        let count = self.choices.harmonic_count;
        Ok(FoundCycle {
            sound,
            harmonic_count: count
                .unwrap_or_else(|| motion.harmonics_within(REMAINDER))
                .min(motion.harmonics.len()),
            motion,
            stability,
            confirmation,
            branch,
        })
    }

    /// The largest cycle of a branch at the case's own operating point, where the search has started at another.
    fn here<'b>(
        &'b self,
        operator: &'b dyn StiffnessOperator,
        mode: &ComplexMode,
        branch: Option<&mut PeriodicBranch>,
    ) -> Result<(PeriodMap<'b>, Found), CycleError> {
        let branch = branch.ok_or(CycleError::Died(0))?;
        let kept = std::mem::take(&mut branch.kept);
        let amplitude = |own: &Point| own.found.image.amplitude;
        let largest = kept.into_iter().max_by(|a, b| amplitude(a).total_cmp(&amplitude(b)));
        let Some(Point { found, .. }) = largest else {
            let parameter = branch.parameter;
            let value = |value: f64| parameter.in_key_units(value);
            let [least, most] = branch.range().unwrap_or([f64::NAN; 2]).map(value);
            return Err(CycleError::NotFound(format!(
                "steady sliding is stable at {} = {} and has no limit cycle beside it. Those of this mode live from \
                 {least:.4} to {most:.4} within the range of cycle.continuation",
                parameter.key(),
                value(parameter.of(&operating_point(self.case)))
            )));
        };
        let mut map = self.map(self.body(), operator, mode)?;
        map.step_in(found.steps);
        let found = shortest(&mut map, found);
        Ok((map, found))
    }

    /// Everything that there is to report of the results.
    pub fn report(&self, results: Vec<PeriodicResult>) -> CycleSummary {
        let interface = self.body().interface();
        let (shown, thickness) = (self.shown(), self.case.depth());
        let body = MotionBody { shown, interface: &interface, thickness };
        let cycles = results.into_iter().map(|own| own.sought(&body)).collect();
        let origin = Origin::Modes {
            modes: self.steady.modes.len(),
            highest_hz: self.steady.modes.last().map_or(0.0, ComplexMode::frequency_hz),
            least_stable: self.least_stable,
            start: self.named_start(),
            interface,
        };
        let own = (self.case.contact.sliding.friction_coefficient, extent_of(self.case));
        CycleSummary::new(origin, self.critical.clone(), own, cycles, Vec::new())
    }

    /// The body as results show it.
    pub fn shown(&self) -> ShownBody<'_> {
        self.stepped.shown()
    }
}

/// The step that the case gives its transient, s.
pub(crate) fn longest_step(case: &Case) -> Option<f64> {
    match case.transient.as_ref()?.settings.time_step {
        TimeStep::Seconds(step) => Some(step),
        TimeStep::Auto => None,
    }
}

/// A mode as it is told of.
fn sought(steady: &Steady, place: usize) -> ModeSummary {
    let mode = &steady.modes[place];
    ModeSummary {
        mode: place + 1,
        mode_frequency_hz: mode.frequency_hz(),
        growth_rate_per_s: mode.growth_rate(),
    }
}

/// The value of a parameter, SI, between one where sliding is stable and one where a mode grows: neither there.
fn onset(of: (&Case, &SteppedMesh<'_>), parameter: Parameter, ends: [f64; 2]) -> Option<f64> {
    let growth = |value: f64| Some(Steady::at(of, parameter, value).ok()?.growth_rate());
    critical(growth, ends)
}

/// Names the cycle that another mode has led to before.
fn name_repeated(results: &mut [PeriodicResult]) {
    for later in 1..results.len() {
        let (known, rest) = results.split_at_mut(later);
        let Ok(own) = &rest[0].outcome else { continue };
        let same = known.iter().find(|result| {
            let other = result.outcome.as_ref();
            result.name.same_as.is_none() && other.is_ok_and(|other| other.motion.is(&own.motion))
        });
        rest[0].name.same_as = same.map(|result| result.name.mode.mode);
    }
}
