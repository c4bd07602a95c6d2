//! Limit cycles of a case: found directly, followed over a parameter, with their stability.
//! `cargo run --example studies` runs one.

mod families;
mod periodic;
mod two_waves;

pub use families::disc_model;
pub use periodic::PeriodicStudy;
pub(crate) use periodic::{Steady, longest_step};

use crate::*;
use families::{Sought, critical_value, next_onset, solvers};
use frictionsim_case::Cycle;
use frictionsim_physics::cycle::{
    CycleSolver, LimitCycle, MODES, MeshStepping, Onset, OperatingPoint, StabilityChange,
    SteppedCycle, Verdict, differing,
};
use frictionsim_physics::{cycle::periodic::MotionFrame, fem::lumped_masses};
use frictionsim_results::cycle::{
    Absence, CycleResult, CycleSummary, FoundWave, OnsetSummary, Origin, SoughtCycle,
    TwoWaveSummary, WaveOfCycle, known,
};
use frictionsim_results::summary::CriticalValue;

/// What a case asks for: cycles of which harmonics, where, and followed over what.
pub struct CycleStudy<'a> {
    case: &'a Case,
    /// What the case says of its cycles.
    pub choices: &'a Cycle,
    annulus: AnnulusMesh,
    simd: SimdLevel,
    continuation: Option<(Parameter, Vec<f64>)>,
    /// Every onset below the case's friction coefficient; where there is none, those of the harmonics sought.
    onsets: Vec<Onset>,
    /// Where along the parameter of `continuation` sliding loses its stability, where it is stable at the case's own.
    critical: Option<CriticalValue>,
    /// A solver for each family sought, or why it has none.
    pub solvers: Vec<Sought>,
}

impl<'a> CycleStudy<'a> {
    /// What a case asks for.
    ///
    /// # Errors
    /// A bad case; steady sliding that is stable against every harmonic, where the case names none.
    pub fn new(case: &'a Case, simd: SimdLevel) -> Result<Self, StudyError> {
        let choices = case.require_cycle()?;
        if let Some([what, label, remedy]) = case.body.without_waves(&case.contact) {
            return Err(StudyError::Case(refusal!(case, "cycle",
                "a limit cycle of a CycleStudy {what}"; "{label}"; "use a PeriodicStudy, or {remedy}")));
        }
        let model = disc_model(case)?;
        let friction = case.contact.sliding.friction_coefficient;
        let mut onsets = model.onsets(friction, asked_modes(case, MODES))?;
        let continuation = choices.continuation.as_ref().map(|own| (own.parameter, own.values()));
        let mut critical = None;
        let solvers = solvers(case, choices, &onsets)?;
        if onsets.is_empty() {
            critical = continuation.as_ref().and_then(|(parameter, values)| {
                Some(CriticalValue::of(*parameter, critical_value(case, *parameter, values)?))
            });
            onsets = solvers.iter().flatten().map(|s| s.onset).collect();
            onsets.extend(next_onset(case, friction));
            order::sort_by_number(&mut onsets, |a| a.friction_coefficient);
        }
        Ok(Self {
            case,
            choices,
            annulus: AnnulusMesh::generate(&model.specification)?,
            simd,
            continuation,
            critical,
            solvers,
            onsets,
        })
    }

    /// The cycles, with the whole field at so many times over one period; `done` hears of every family.
    pub fn run(&self, frames: usize, done: &(dyn Fn() + Sync)) -> Vec<CycleResult> {
        parallel::map(&self.solvers, |solver| {
            let start = Instant::now();
            let (family, phases, outcome) = match solver {
                Ok(own) => (own.family, own.phases, self.solve(own, frames)),
                // A family that cannot be sought at all.
                Err((family, error)) => {
                    let is_stable = matches!(error, CycleError::NoOnset(_));
                    (*family, 0, Err(Absence { reason: error.to_string(), is_stable }))
                }
            };
            done();
            CycleResult {
                name: WaveOfCycle::new(family, phases, &self.onsets_of(family.harmonic)),
                outcome,
                wall_s: start.elapsed().as_secs_f64(),
            }
        })
    }

    /// Root mean square over the mass that moves of a velocity field: of a rotating wave it is the same at every time.
    fn velocity(&self, field: &[f64]) -> f64 {
        let mesh = &self.annulus.mesh;
        let masses = lumped_masses(mesh, self.case.materials());
        let held: BTreeSet<usize> = mesh.held_dofs().collect();
        let moving = (0..field.len()).filter(|dof| !held.contains(dof));
        let [energy, mass] = moving.fold([0.0; 2], |[energy, mass], dof| {
            let own = masses[dof / 2];
            [energy + own * field[dof].powi(2), mass + 0.5 * own]
        });
        (energy / mass).sqrt()
    }

    /// The body as results show it.
    pub fn shown(&self) -> ShownBody<'_> {
        ShownBody { mesh: &self.annulus.mesh, sector: None }
    }

    /// Everything that there is to report of the results.
    pub fn report(
        &self,
        results: Vec<CycleResult>,
        two_waves: Vec<TwoWaveSummary>,
    ) -> CycleSummary {
        let (thickness, radius) = (self.case.thickness, self.annulus.specification.inner_radius);
        let cycles = results.into_iter().map(|own| own.sought(thickness, radius)).collect();
        let origin = Origin::Waves { lowest_onset: self.onsets.first().map(OnsetSummary::from) };
        let own = (self.case.contact.sliding.friction_coefficient, extent_of(self.case));
        CycleSummary::new(origin, self.critical.clone(), own, cycles, two_waves)
    }

    fn onsets_of(&self, harmonic: usize) -> Vec<Onset> {
        self.onsets.iter().filter(|o| o.harmonic == harmonic).copied().collect()
    }

    /// Why a family whose onset is known has no cycle.
    fn absence(&self, solver: &CycleSolver, error: &CycleError) -> Absence {
        let friction = self.case.contact.sliding.friction_coefficient;
        let onset = solver.onset.friction_coefficient;
        let is_stable = friction < onset;
        let stable = format!("{friction} < {onset:.4}: steady sliding is stable against this wave");
        Absence { reason: if is_stable { stable } else { error.to_string() }, is_stable }
    }

    /// The cycle of a family with everything asked for: branch, stability, confirmation, fields.
    fn solve(&self, solver: &CycleSolver, frame_count: usize) -> Result<FoundWave, Absence> {
        let found = solver.find(&operating_point(self.case));
        let cycle = found.map_err(|error| self.absence(solver, &error))?;
        let continuation = self.continuation.as_ref();
        let field = |time| solver.field(&cycle, time);
        let mut found = FoundWave {
            branch: continuation.map(|(key, values)| solver.follow(&cycle, *key, values)),
            frames: frames(field, 1.0 / cycle.frequency_hz(), frame_count),
            velocity: self.velocity(&field(0.0)[1]),
            cycle,
            confirmation: None,
            stability: None,
            branch_stability: Vec::new(),
            stability_changes: Vec::new(),
        };
        // What the mesh's own time stepping makes of it.
        match solver.stepping(self.simd) {
            Ok(stepping) => self.step(&stepping, &mut found),
            Err(error) => found.confirmation = Some(Err(error.to_string())),
        }
        Ok(found)
    }

    /// Stability of a cycle and of its branch, and what a transient says of it.
    fn step(&self, stepping: &MeshStepping<'_>, found: &mut FoundWave) {
        let (choice, periods) = (self.choices.stability, self.choices.confirmation_periods);
        if choice != StabilityChoice::None {
            let settled = stepping.settle(&found.cycle, None).map_err(|error| error.to_string());
            // The powers and fractions of the cycle become those of the transient.
            found.stability = Some(settled.map(|settled| {
                found.cycle = settled.cycle;
                settled.stability
            }));
        }
        let known = known(&found.stability);
        found.confirmation = (periods > 0)
            .then(|| stepping.confirm(&found.cycle, known, periods).map_err(|e| e.to_string()));
        if let (Some(branch), StabilityChoice::Branch) = (&found.branch, choice) {
            let settled = along(stepping, &branch.cycles);
            found.stability_changes = changes(stepping, branch.parameter, &settled);
            let stability = settled.into_iter().map(|own| Some(own.map(|own| own.stability)));
            found.branch_stability = stability.collect();
        }
    }
}

/// The limit cycle of `family` at the case's own operating point, and its solver.
///
/// # Errors
/// No such cycle, or elements that a cycle cannot be sought on.
pub fn limit_cycle(case: &Case, family: Family) -> Result<(CycleSolver, LimitCycle), StudyError> {
    let phases = case.cycle.as_ref().and_then(|cycle| cycle.phases);
    let model = disc_model(case)?;
    let onset = model.onset_of(family, asked_modes(case, MODES))?;
    let solver = CycleSolver::born_at(&model, family, &onset, phases)?;
    let cycle = solver.find(&operating_point(case))?;
    Ok((solver, cycle))
}

/// That there is no cycle is an answer where steady sliding is stable, else a failure.
pub fn refuse_nothing(found: &CycleSummary) -> Result<(), StudyError> {
    let cycles = &found.cycles;
    if found.steady_sliding_stable || cycles.iter().any(|own| own.cycle.is_some()) {
        return Ok(());
    }
    let reason = |own: &SoughtCycle| {
        let reason = own.error.as_ref().or(own.absent.as_ref())?;
        Some(format!("{}: {reason}", own.name))
    };
    let reasons: Vec<String> = cycles.iter().filter_map(reason).collect();
    Err(StudyError::Failed(format!("no limit cycle found: {}", reasons.join("; "))))
}

/// Where a case stands among the limit cycles of its disc.
pub fn operating_point(case: &Case) -> OperatingPoint {
    OperatingPoint { contact: case.contact.sliding, damping: case.damping.rayleigh }
}

/// The whole field, given for a time, at `count` times over one period (s).
fn frames(field: impl Fn(f64) -> [Vec<f64>; 2], period: f64, count: usize) -> Vec<MotionFrame> {
    let times = (0..count).map(|i| period * i as f64 / count as f64);
    times.map(|time| MotionFrame { time, fields: field(time), contact: None }).collect()
}

/// Cycles whose exponents are found one after the other, each from its neighbour's; the groups run in parallel.
const GROUP: usize = 8;

/// Stability of every cycle of a branch, settled in the transient. Where a wave only scales from one cycle to the next,
/// its stability is the same. The cycles stay what they are: their powers are those of the wave, whose balance is
/// exact, while the few periods of a transient that settles still lose or gain some energy.
fn along(stepping: &MeshStepping<'_>, cycles: &[LimitCycle]) -> Vec<Result<SteppedCycle, String>> {
    let is_scaled = |a: &LimitCycle, b: &LimitCycle| {
        let drift = a.state.frequency() / b.state.frequency() - 1.0;
        a.state.contact == b.state.contact && drift.abs() < 1e-9
    };
    let settled: Vec<Vec<Result<SteppedCycle, String>>> =
        parallel::map(cycles.chunks(GROUP), |group| {
            let mut before: Option<(&LimitCycle, SteppedCycle)> = None;
            let settle = |cycle| {
                let found = match &before {
                    Some((own, settled)) if is_scaled(own, cycle) => Ok(settled.scaled_to(cycle)),
                    _ => {
                        let neighbour = before.as_ref().map(|(_, settled)| settled);
                        stepping.settle(cycle, neighbour).map_err(|error| error.to_string())
                    }
                };
                if let Ok(settled) = &found {
                    before = Some((cycle, settled.clone()));
                }
                found
            };
            group.iter().map(settle).collect()
        });
    settled.into_iter().flatten().collect()
}

/// Where neighbours along a branch differ in stability for sure.
fn changes(
    stepping: &MeshStepping<'_>,
    parameter: Parameter,
    settled: &[Result<SteppedCycle, String>],
) -> Vec<StabilityChange> {
    let known = settled.iter().flatten();
    let pairs = differing(known.map(|own| (own.stability.verdict().is_stable(), own)));
    let found: Vec<_> = parallel::map(pairs, |[first, second]| {
        let is_first = first.stability.verdict() == Verdict::Stable;
        let (stable, unstable) = if is_first { (first, second) } else { (second, first) };
        stepping.stability_change(parameter, stable, unstable).ok()
    });
    found.into_iter().flatten().collect()
}
