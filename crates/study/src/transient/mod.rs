//! The explicit transient of a case: its body, where it starts, the time loop, and what its record says.
//!
//! ```
//! use frictionsim::case::Case;
//! use frictionsim::fem::operator::SimdLevel;
//! use frictionsim::study::transient::TransientStudy;
//!
//! # let mesh = ["mesh.circumferential_elements=24", "mesh.radial_elements=4"];
//! # let coarse = [&mesh[..], &["output.snapshots=[]", "output.probes=[1]"]].concat();
//! # let shorter = ["transient.duration=2e-4", "transient.expansion_time=1e-4"];
//! # let overrides: Vec<String> = coarse.iter().chain(&shorter).map(|text| text.to_string()).collect();
//! # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
//! let bytes = std::fs::read("cases/polycarbonate-610rpm.toml")?;
//! let case = Case::parse("disc", &bytes, &overrides)?;
//! let solved = TransientStudy::new(&case, SimdLevel::detect())?.solve()?;
//! println!("{:?}", solved.analysis.settling.state);
//! assert!(solved.analysis.largest_residual < 1e-10);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod notes;
mod stepped;

use crate::cycle::limit_cycle;
use crate::tangent::{MODES_IN_TIME, options_in_time};
use crate::*;
use frictionsim_case::Transient;
use frictionsim_physics::transient::{
    Breakdown, CentralDifference, InitialState, Recorder, RecorderSettings, StepPlan,
    TransientAnalysis, TransientError, TransientSettings,
};
use frictionsim_physics::{fem::operator::StiffnessOperator, linalg::interruption};
use frictionsim_results::transient::{LinearStage, RecordedRun, SolvedTransient};
use frictionsim_results::{Head, charts::ModeLine};
pub use stepped::SteppedMesh;

/// A case made ready for the time loop.
pub struct TransientStudy<'a> {
    /// The case.
    pub case: &'a Case,
    /// Its mesh.
    pub stepped: SteppedMesh<'a>,
    /// Choices of the run.
    pub transient: &'a Transient,
    simd: SimdLevel,
}

impl<'a> TransientStudy<'a> {
    /// The body and the settings of a case.
    ///
    /// # Errors
    /// [`StudyError::Case`] for a case without `[transient]`; a mesh that cannot be built.
    pub fn new(case: &'a Case, simd: SimdLevel) -> Result<Self, StudyError> {
        let transient = case.require_transient()?;
        Ok(Self { case, stepped: SteppedMesh::of(case)?, transient, simd })
    }

    /// The body with its contact.
    pub fn body(&self) -> TransientModel<'_> {
        self.stepped.body(self.case)
    }

    /// What applies the stiffness.
    ///
    /// # Errors
    /// [`StudyError::Case`] at `transient.operator` for one that cannot represent the mesh.
    pub fn operator(&self) -> Result<Box<dyn StiffnessOperator>, StudyError> {
        self.told(self.body().operator(self.transient.operator, self.simd))
    }

    /// Time step and samples of the run.
    ///
    /// # Errors
    /// [`StudyError::Case`] for times that do not fit together.
    pub fn plan(&self, operator: &dyn StiffnessOperator) -> Result<StepPlan, StudyError> {
        self.told(self.body().plan(operator, &self.transient.settings))
    }

    /// The run in its initial state.
    ///
    /// # Errors
    /// [`StudyError::Case`] for settings that do not fit the mesh; a base state or a limit cycle that does not exist.
    pub fn start<'b>(
        &'b self,
        operator: &'b dyn StiffnessOperator,
    ) -> Result<CentralDifference<'b>, StudyError> {
        let started = match self.transient.settings.initial {
            InitialState::LimitCycle { harmonic, onset } => {
                let family = Family { harmonic, onset };
                let time_step = self.plan(operator)?.time_step;
                let (solver, cycle) = limit_cycle(self.case, family)?;
                let [u, v] = solver.starting_fields(&cycle, time_step);
                CentralDifference::start_from(
                    self.body(),
                    operator,
                    &self.transient.settings,
                    &u,
                    v,
                )
            }
            _ => CentralDifference::start(self.body(), operator, &self.transient.settings),
        };
        self.told(started)
    }

    /// Reads a record.
    pub fn analyse(&self, record: &Recorder) -> TransientAnalysis {
        let perturbation = &self.transient.settings.perturbation;
        let analysis = match (self.case.body.has_sectors(), perturbation.noise) {
            (false, _) => TransientAnalysis::without_symmetry(record),
            (true, 0.0) => TransientAnalysis::of(record, &perturbation.harmonics()),
            // Noise seeds every harmonic.
            (true, _) => TransientAnalysis::of(record, &record.significant_harmonics()),
        };
        match self.transient.settings.initial {
            // On a limit cycle nothing grows at first.
            InitialState::LimitCycle { .. } => {
                TransientAnalysis { growth: Vec::new(), first_nonlinearity: None, ..analysis }
            }
            InitialState::Rest | InitialState::SteadySliding => analysis,
        }
    }

    /// Runs to the end, or to where it settles if the case says so, and keeps the samples alone.
    ///
    /// # Errors
    /// As [`Self::start`]; a run that becomes unstable.
    pub fn solve(&self) -> Result<SolvedTransient, StudyError> {
        let operator = self.operator()?;
        let mut run = self.start(operator.as_ref())?;
        let settings = RecorderSettings {
            stop_when_settled: self.case.output.recorder.stop_when_settled,
            ..RecorderSettings::default()
        };
        let mut record = self.told(Recorder::new(&run, &settings))?;
        let clock = Instant::now();
        // On a thread of the pool: a step hands parts of itself to the others.
        self.told(rayon::scope(|_| run.run(&mut record)))?;
        interruption::check();
        let stepping_s = clock.elapsed().as_secs_f64();
        Ok(SolvedTransient {
            analysis: self.analyse(&record),
            record,
            plan: *run.plan(),
            operator: operator.name(),
            steps: run.steps_done(),
            steps_timed: run.steps_done(),
            stepping_s,
            is_finished: true,
        })
    }

    /// Sets the run up to its first step: finds out whether it can start, and gives its time step. A limit cycle that
    /// it would start on is not looked for, nor the steady sliding of any body but a plane annulus, which takes longer
    /// than a check is worth.
    pub fn preflight(&self) -> Result<StepPlan, StudyError> {
        let operator = self.operator()?;
        let initial = match (self.case.body.annulus(), self.transient.settings.initial) {
            (None, _) => InitialState::Rest,
            (Some(_), InitialState::LimitCycle { .. }) => return self.plan(operator.as_ref()),
            (Some(_), own) => own,
        };
        let settings = TransientSettings { initial, ..self.transient.settings.clone() };
        let started = CentralDifference::start(self.body(), operator.as_ref(), &settings);
        let fresh = self.told(started)?;
        self.told(Recorder::new(&fresh, &self.case.output.recorder))?;
        Ok(*fresh.plan())
    }

    /// What there is to report of a run that took so long altogether, s.
    pub fn report<'b>(&'b self, solved: &'b SolvedTransient, wall_s: f64) -> RecordedRun<'b> {
        let case = self.case;
        let places = case.output.placed_probes.iter();
        RecordedRun {
            head: Head::of(&case.title, wall_s),
            solved,
            body: self.stepped.shown(),
            interface: self.body().interface(),
            material: case.materials_in_time(),
            has_harmonics: case.body.has_sectors(),
            thickness: case.depth(),
            extent: extent_of(case),
            peripheral_speed: self.shown_speed(),
            stage: LinearStage::default(),
            friction_coefficient: case.contact.sliding.friction_coefficient,
            settings: &self.transient.settings,
            places: places.map(|place| (place.node, [place.asked[0], place.asked[1]])).collect(),
            notes: self.notes(&solved.record, &solved.analysis, solved.plan.time_step),
        }
    }

    /// An outcome of the time loop, its error at its key of the case where it has one.
    ///
    /// # Errors
    /// [`StudyError::Case`] for what the case asks for in vain; what fails in the loop.
    pub fn told<T>(&self, outcome: Result<T, TransientError>) -> Result<T, StudyError> {
        outcome.map_err(|error| study_error(self.case, error))
    }

    /// Speed of the counterface where figures show the contact, m/s: of several rings of nodes at the middle
    /// one, of an assembly the mean over its contacts.
    pub fn shown_speed(&self) -> f64 {
        let speed = self.case.contact.sliding.rotation_speed;
        match &self.stepped.sector {
            Some(sector) => speed * sector.rings[sector.rings.len() / 2].radius,
            None => match &self.stepped.assembly {
                Some(assembly) => {
                    let surfaces = assembly.contacts().iter();
                    let points = surfaces.flat_map(|(_, surface)| &surface.points);
                    let [speed, area] = points.fold([0.0; 2], |[speed, area], point| {
                        [speed + point.weight * point.speed, area + point.weight]
                    });
                    speed / area.max(f64::MIN_POSITIVE)
                }
                None => self.body().interface().surface_speed(speed),
            },
        }
    }
}

/// Settings that stand in `[output]`; the others stand in `[transient]`.
const OUTPUT: [&str; 3] = ["probes", "sample_interval", "snapshots"];

/// An error of the case at its key where there is one, else of the run.
fn study_error(case: &Case, error: TransientError) -> StudyError {
    let (key, message, label) = match &error {
        TransientError::Setting { setting, fitting, .. } => {
            let is_output = OUTPUT.contains(setting);
            let section = if is_output { "output" } else { "transient" };
            (format!("{section}.{setting}"), format!("{section}.{error}"), fitting.clone())
        }
        TransientError::Operator(_) => {
            let label = "not on this mesh".to_owned();
            ("transient.operator".to_owned(), error.to_string(), label)
        }
        TransientError::Unstable { cause, .. } => {
            return StudyError::Failed(format!("{error}: {}", remedy(*cause)));
        }
        _ => return StudyError::Transient(error),
    };
    StudyError::Case(case.error_at(&key, message, label, None))
}

/// Which keys to change after a breakdown.
fn remedy(cause: Breakdown) -> &'static str {
    match cause {
        Breakdown::Overflow => {
            "check contact.rotation_speed_rpm, contact.interference and transient.perturbation, \
             or lower transient.time_step"
        }
        Breakdown::StepTooLong => "lower transient.time_step",
        Breakdown::RoundOff => {
            "lower transient.time_step, or check contact.interference and contact.rotation_speed_rpm"
        }
    }
}

/// Nodes of an imported mesh beyond which its modes would take longer than a figure is worth.
const MOST_NODES: usize = 30_000;

/// Unstable modes of steady sliding at the case's own friction coefficient, as the time loop has it.
///
/// # Errors
/// A mesh of too many nodes; those of steady sliding, which would open, say, and of the solver.
pub fn linear_stage(case: &Case) -> Result<LinearStage, StudyError> {
    let imported = case.body.imported();
    if imported.is_some_and(|imported| imported.mesh.node_count() > MOST_NODES) {
        return Err(StudyError::Failed(format!("more than {MOST_NODES} nodes")));
    }
    let mut options = options_in_time(case);
    if case.contact.stiffness.normal_stiffness.is_none() {
        // On a rigid contact they are one and the same.
        options.damping_model = DampingModel::WholeTangent;
    }
    let modes = modes_at_own_friction(case, &options, asked_modes(case, MODES_IN_TIME))?;
    let unstable = || modes.iter().enumerate().filter(|(_, m)| m.is_unstable());
    let mut growth_rates: BTreeMap<usize, f64> = BTreeMap::new();
    // A body without symmetry has no harmonics that its waves belong to.
    for (_, mode) in unstable().filter(|_| case.body.has_sectors()) {
        let largest = growth_rates.entry(mode.harmonic).or_insert(f64::NEG_INFINITY);
        *largest = largest.max(mode.growth_rate());
    }
    Ok(LinearStage {
        references: unstable()
            .map(|(index, mode)| ModeLine {
                frequency_hz: mode.frequency_hz(),
                label: match case.body.has_sectors() {
                    true => format!("mode {}, *n* = {}", index + 1, mode.harmonic),
                    false => format!("mode {}", index + 1),
                },
            })
            .collect(),
        growth_rates: growth_rates.into_iter().collect(),
        mode_rates: unstable().map(|(_, mode)| (mode.frequency_hz(), mode.growth_rate())).collect(),
    })
}
