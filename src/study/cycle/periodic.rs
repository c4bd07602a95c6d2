//! Limit cycles of bodies without symmetry: one for each mode that grows from steady sliding.

use super::super::eigenvalues::{Model, Solver, asked_modes};
use super::super::{StudyError, extent_of, tangent_options, transient};
use super::families::continuation;
use super::operating_point;
use crate::case::{Body, Case, Cycle, OnsetChoice, StabilityChoice, TimeStep};
use crate::cea::{CeaError, ComplexMode, SweepRequest, Unwatched};
use crate::cycle::Parameter;
use crate::cycle::periodic::{
    BranchRequest, FloquetMultipliers, GrowingMode, MotionConfirmation, MotionRequest, PeriodMap,
    PeriodicBranch, PeriodicError, PeriodicMotion, PeriodicState, balanced_start, find,
};
use crate::fem::MassKind;
use crate::fem::operator::{SimdLevel, StiffnessOperator};
use crate::mesh::{AnnulusMesh, Mesh};
use crate::results::periodic::{FoundCycle, PeriodicReport, PeriodicResult, SoughtMode};
use crate::transient::{OperatorChoice, TransientBody, TransientError, TransientModel};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;

/// Modes of lowest frequency that are looked at where the case has no `[cea]`.
const MODES: usize = 30;

/// Instants of the contact over a period where the case names no number.
const INSTANTS: usize = 180;

/// Share of the motion that the harmonics told may leave, where the case names no number of them.
const REMAINDER: f64 = 1e-3;

/// What a case asks for: the limit cycles of which modes.
pub struct PeriodicStudy<'a> {
    case: &'a Case,
    /// What the case says of its cycles.
    pub choices: &'a Cycle,
    mesh: Arc<Mesh>,
    annulus: Option<AnnulusMesh>,
    simd: SimdLevel,
    /// Displacement of steady sliding, m.
    base: Vec<f64>,
    /// All modes looked at, by frequency.
    modes: Vec<ComplexMode>,
    /// Those whose cycles are sought, by falling growth: places among all.
    sought: Vec<usize>,
    continuation: Option<(Parameter, Vec<f64>)>,
}

impl<'a> PeriodicStudy<'a> {
    /// Steady sliding and its modes, with the lumped mass and without the geometric stiffness, as the transient has them.
    ///
    /// # Errors
    /// A bad case; a body without a state of steady sliding; those of the eigenvalue solver.
    pub fn new(case: &'a Case, simd: SimdLevel) -> Result<Self, StudyError> {
        let choices = case.require_cycle()?;
        let friction = case.contact.sliding.friction_coefficient;
        let mut options = tangent_options(case, MassKind::Lumped);
        options.geometric_stiffness = false;
        let model = Model::with_solver(case, Solver::WholeMesh, options, &[friction])?;
        let request = SweepRequest {
            friction_coefficients: &[friction],
            limit: asked_modes(case, MODES),
            shapes_at: &[friction],
        };
        let found = model.spectrum(case, &request, false, &Unwatched)?;
        let point = found.sweep.points.into_iter().next();
        let modes = point.map_or_else(Vec::new, |point| point.modes);
        let Model::Whole(whole) = &model else {
            return Err(CeaError::NoFriction.into());
        };
        let growing = (0..modes.len()).filter(|&i| modes[i].is_unstable());
        let mut sought: Vec<usize> = growing.collect();
        sought.sort_by(|&a, &b| modes[b].growth_rate().total_cmp(&modes[a].growth_rate()));
        if choices.onsets == OnsetChoice::Lowest {
            sought.truncate(1);
        }
        let annulus = match &case.body {
            Body::Annulus(annulus) => Some(AnnulusMesh::generate(&annulus.specification)?),
            _ => None,
        };
        Ok(Self {
            case,
            choices,
            mesh: case.mesh()?,
            annulus,
            simd,
            base: whole.base().displacement(friction),
            modes,
            sought,
            continuation: continuation(case, choices)?,
        })
    }

    /// How many cycles are sought.
    pub fn sought_count(&self) -> usize {
        self.sought.len()
    }

    fn body(&self) -> TransientBody<'_> {
        transient::body(self.case, &self.mesh, self.annulus.as_ref(), None)
    }

    /// The body with another value of a parameter, SI.
    fn body_at(&self, parameter: Parameter, value: f64) -> TransientBody<'_> {
        let mut point = operating_point(self.case);
        parameter.set(&mut point, value);
        match self.body() {
            TransientBody::Plane(model) => TransientBody::Plane(TransientModel {
                contact: point.contact,
                damping: point.damping,
                ..model
            }),
            solid => solid,
        }
    }

    /// The period map of a body for motions near a mode.
    fn map<'b>(
        &self,
        body: TransientBody<'b>,
        operator: &'b dyn StiffnessOperator,
        mode: &ComplexMode,
    ) -> Result<PeriodMap<'b>, TransientError> {
        let step = self.case.transient.as_ref().map(|run| run.time_step);
        let longest = match step {
            Some(TimeStep::Seconds(step)) => Some(step),
            Some(TimeStep::Auto) | None => None,
        };
        PeriodMap::new(body, operator, mode.eigenvalue.im, longest)
    }

    /// The branch through a cycle over the parameter of the case.
    fn branch(
        &self,
        operator: &dyn StiffnessOperator,
        mode: &ComplexMode,
        state: &PeriodicState,
    ) -> Option<Result<PeriodicBranch, TransientError>> {
        let (parameter, values) = self.continuation.as_ref()?;
        let map = |value: f64| self.map(self.body_at(*parameter, value), operator, mode);
        let request = BranchRequest {
            parameter: *parameter,
            values,
            with_stability: self.choices.stability == StabilityChoice::Branch,
            map: &map,
        };
        let own = parameter.of(&operating_point(self.case));
        Some(request.follow(own, state))
    }

    /// The cycles, with the whole field at so many times over a period; `done` hears of every result.
    ///
    /// # Errors
    /// A mesh that the time loop cannot take.
    pub fn run(
        &self,
        frames: usize,
        done: &(dyn Fn(&PeriodicResult) + Sync),
    ) -> Result<Vec<PeriodicResult>, StudyError> {
        let operator = self.body().operator(OperatorChoice::Auto, self.simd);
        let operator = operator.map_err(StudyError::Transient)?;
        let solve = |&place: &usize| {
            let start = Instant::now();
            let outcome = self.solve(operator.as_ref(), place, frames);
            let result = PeriodicResult {
                mode: self.mode(place),
                outcome: outcome.map_err(|error| error.to_string()),
                same_as: None,
                wall_s: start.elapsed().as_secs_f64(),
            };
            done(&result);
            result
        };
        let mut results: Vec<PeriodicResult> = self.sought.par_iter().map(solve).collect();
        name_repeated(&mut results);
        Ok(results)
    }

    fn mode(&self, place: usize) -> SoughtMode {
        let mode = &self.modes[place];
        SoughtMode {
            number: place + 1,
            frequency_hz: mode.frequency_hz(),
            growth_rate: mode.growth_rate(),
        }
    }

    /// The cycle of one mode, its stability, and what a transient says of it.
    fn solve(
        &self,
        operator: &dyn StiffnessOperator,
        place: usize,
        frames: usize,
    ) -> Result<FoundCycle, PeriodicError> {
        let case = self.case;
        let mode = &self.modes[place];
        let mut map = self.map(self.body(), operator, mode)?;
        let speed = map
            .interface()
            .surface_speed(case.contact.sliding.rotation_speed);
        let growing = GrowingMode {
            eigenvalue: mode.eigenvalue,
            shape: mode.shape.as_deref().unwrap_or_default(),
            base: &self.base,
        };
        // From the growing mode to the motion that repeats itself.
        let start = balanced_start(&mut map, &growing, speed);
        let found = find(&mut map, start)?;
        let request = MotionRequest {
            instants: self.choices.phases.unwrap_or(INSTANTS),
            frames: frames.max(1),
        };
        let motion = PeriodicMotion::of(&mut map, &found, request);
        // What small perturbations do, by multipliers and by a transient, and the cycles beside it.
        let stability = (self.choices.stability != StabilityChoice::None).then(|| {
            let multipliers = FloquetMultipliers::of(&mut map, &found.state);
            multipliers.map_err(|error| error.to_string())
        });
        let known = stability.as_ref().and_then(|found| found.as_ref().ok());
        let leading = known.and_then(FloquetMultipliers::leading).copied();
        let periods = self.choices.confirmation_periods;
        let confirmation = (periods > 0)
            .then(|| MotionConfirmation::run(&mut map, &found.state, leading.as_ref(), periods));
        let branch = self.branch(operator, mode, &found.state).transpose()?;
        let count = self.choices.harmonic_count;
        Ok(FoundCycle {
            harmonic_count: count
                .unwrap_or_else(|| motion.harmonics_within(REMAINDER))
                .min(motion.harmonics.len()),
            motion,
            stability,
            confirmation,
            branch,
        })
    }

    /// Everything that there is to report of the results.
    pub fn report(&self, results: Vec<PeriodicResult>, wall_s: f64) -> PeriodicReport<'_> {
        let least = (0..self.modes.len()).max_by(|&a, &b| {
            let growth = |i: usize| self.modes[i].growth_rate();
            growth(a).total_cmp(&growth(b))
        });
        PeriodicReport {
            title: &self.case.title,
            mesh: &self.mesh,
            thickness: self.case.thickness,
            extent: extent_of(self.case),
            friction_coefficient: self.case.contact.sliding.friction_coefficient,
            modes: self.modes.len(),
            highest_hz: self.modes.last().map_or(0.0, ComplexMode::frequency_hz),
            least_stable: least.map(|place| self.mode(place)),
            results,
            wall_s,
        }
    }

    /// That there is no cycle is an answer where steady sliding is stable, else a failure.
    ///
    /// # Errors
    /// [`StudyError::NoCycle`].
    pub fn refuse_nothing(report: &PeriodicReport<'_>) -> Result<(), StudyError> {
        if report.is_stable() || report.results.iter().any(|result| result.outcome.is_ok()) {
            return Ok(());
        }
        let reasons = report.results.iter().filter_map(|result| {
            let reason = result.outcome.as_ref().err()?;
            Some(format!("{}: {reason}", result.mode))
        });
        Err(StudyError::NoCycle(reasons.collect::<Vec<_>>().join("; ")))
    }
}

/// Names the cycle that another mode has led to before.
fn name_repeated(results: &mut [PeriodicResult]) {
    for later in 1..results.len() {
        let (known, rest) = results.split_at_mut(later);
        let Ok(own) = &rest[0].outcome else {
            continue;
        };
        let same = known.iter().find(|result| {
            let other = result.outcome.as_ref();
            result.same_as.is_none() && other.is_ok_and(|other| other.motion.is(&own.motion))
        });
        rest[0].same_as = same.map(|result| result.mode.number);
    }
}
