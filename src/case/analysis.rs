//! The sections that describe an analysis: cea, transient, output, cycle.

use super::keys;
use super::model::node_count;
use super::reader::{Bound, Section};
use crate::fem::MassKind;
use crate::mesh::AnnulusSpecification;

/// What can run on a case, and at each point of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Analysis {
    /// The complex eigenvalue analysis.
    Cea,
    /// The explicit transient.
    Transient,
}

/// Which modes are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ModeSelection {
    /// All below this frequency, Hz.
    BelowHz(f64),
    /// This many of the lowest.
    Lowest(usize),
}

/// Eigenvalue solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CeaMethod {
    /// Cyclic where mesh and base state have the symmetry, sparse elsewhere.
    Auto,
    /// One small problem for each circumferential harmonic.
    Cyclic,
    /// Shift-invert Krylov-Schur on the whole mesh.
    Sparse,
}

/// `[cea]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Cea {
    /// Friction coefficients of the sweep, rising.
    pub friction_coefficients: Vec<f64>,
    /// Which modes.
    pub modes: ModeSelection,
    /// Which solver.
    pub method: CeaMethod,
    /// Which mass matrix.
    pub mass: MassKind,
    /// Whether the prestress enters the tangent.
    pub geometric_stiffness: bool,
    /// Friction coefficients whose mode shapes are written, rising; they need not be among
    /// `friction_coefficients`.
    pub shapes_at: Vec<f64>,
    /// Stability map over a second parameter.
    pub map: Option<CeaMap>,
}

impl Cea {
    /// Friction coefficients to solve at: those of the tables and those of the shapes, rising.
    pub fn solved_friction_coefficients(&self) -> Vec<f64> {
        let mut all = [
            self.friction_coefficients.as_slice(),
            self.shapes_at.as_slice(),
        ]
        .concat();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }
}

/// `[cea.map]`: the critical friction over a second parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct CeaMap {
    /// Dotted case key.
    pub key: String,
    /// Its values.
    pub values: Vec<f64>,
}

/// Time step of the transient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// From the operator's largest frequency.
    Auto,
    /// Given, s.
    Seconds(f64),
}

/// State that a transient starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InitialState {
    /// Undeformed, the cylinder not yet expanded.
    Rest,
    /// The prestressed equilibrium of steady sliding.
    SteadySliding,
}

/// How the transient applies the stiffness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OperatorChoice {
    /// Cyclic where the mesh has the symmetry.
    Auto,
    /// The stencil of one sector.
    Cyclic,
    /// Sparse 2 x 2 block rows.
    Sparse,
}

/// `[transient.perturbation]`: initial velocity of the body, summed over harmonics.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Perturbation {
    /// Circumferential harmonics.
    pub harmonics: Vec<usize>,
    /// Amplitude of each, m/s.
    pub velocity: f64,
}

/// `[transient]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Transient {
    /// Simulated time, s.
    pub duration: f64,
    /// Time step.
    pub time_step: TimeStep,
    /// Ramp of the interference, s.
    pub expansion_time: f64,
    /// Initial state.
    pub initial: InitialState,
    /// Operator.
    pub operator: OperatorChoice,
    /// Initial perturbation.
    pub perturbation: Perturbation,
}

/// `[output]`: what a transient writes.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Node ids, counted from 1.
    pub probes: Vec<usize>,
    /// Time between samples, s.
    pub sample_interval: f64,
    /// Times of the field snapshots, s, rising.
    pub snapshots: Vec<f64>,
    /// Wall time between checkpoints, s.
    pub checkpoint_interval: f64,
}

/// `[cycle]`: limit cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// Circumferential harmonics; `None` takes those that are unstable.
    pub harmonics: Option<Vec<usize>>,
    /// Continuation over a parameter.
    pub continuation: Option<Continuation>,
}

/// `[cycle.continuation]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Continuation {
    /// Dotted case key.
    pub key: String,
    /// Its first value.
    pub from: f64,
    /// Its last value.
    pub to: f64,
}

pub(super) fn cea(
    root: &Section<'_>,
    annulus: &AnnulusSpecification,
    friction_coefficient: f64,
) -> Option<Cea> {
    let section = root.section("cea", false);
    if !section.is_given() {
        return None;
    }
    let friction_coefficients = rising(&section, "friction_coefficients", Bound::NotNegative)
        .unwrap_or_else(|| vec![friction_coefficient]);
    if friction_coefficients.is_empty() && section.is_empty_list("friction_coefficients") {
        section.reject(
            "friction_coefficients",
            "cea.friction_coefficients is empty".to_owned(),
            "at least one value".to_owned(),
            None,
        );
    }
    let cea = Cea {
        modes: mode_selection(&section, annulus),
        method: section.choice(
            "method",
            &[
                ("auto", CeaMethod::Auto),
                ("cyclic", CeaMethod::Cyclic),
                ("sparse", CeaMethod::Sparse),
            ],
        ),
        mass: section.choice(
            "mass",
            &[
                ("consistent", MassKind::Consistent),
                ("lumped", MassKind::Lumped),
            ],
        ),
        geometric_stiffness: section.flag_or("geometric_stiffness", true),
        shapes_at: rising(&section, "shapes_at", Bound::NotNegative)
            .unwrap_or_else(|| vec![friction_coefficient]),
        friction_coefficients,
        map: cea_map(&section),
    };
    section.close();
    Some(cea)
}

/// A list of numbers in rising order; equal ones are an error.
fn rising(section: &Section<'_>, key: &'static str, bound: Bound) -> Option<Vec<f64>> {
    let mut values = section.numbers(key, bound)?;
    values.sort_by(f64::total_cmp);
    if let Some(pair) = values.windows(2).find(|pair| pair[0] == pair[1]) {
        section.reject(
            key,
            format!("{} has {} twice", section.name(key), pair[0]),
            "every value once".to_owned(),
            None,
        );
    }
    Some(values)
}

fn mode_selection(section: &Section<'_>, annulus: &AnnulusSpecification) -> ModeSelection {
    let limit = section.optional_number("max_frequency_hz", Bound::Positive);
    let modes = section.optional_count("modes", 1);
    let unknowns = 2 * node_count(annulus);
    if let Some(modes) = modes.filter(|modes| *modes as u128 > unknowns && unknowns > 0) {
        section.reject(
            "modes",
            format!("cea.modes = {modes} is more than the {unknowns} unknowns of the mesh"),
            format!("at most {unknowns}"),
            None,
        );
    }
    match (limit, modes) {
        (Some(limit), None) => ModeSelection::BelowHz(limit),
        (None, Some(modes)) => ModeSelection::Lowest(modes),
        // An override replaces what the file says in the other way.
        (Some(_), Some(modes))
            if section.is_overridden("modes") && !section.is_overridden("max_frequency_hz") =>
        {
            ModeSelection::Lowest(modes)
        }
        (Some(limit), Some(_))
            if section.is_overridden("max_frequency_hz") && !section.is_overridden("modes") =>
        {
            ModeSelection::BelowHz(limit)
        }
        (Some(limit), Some(_)) => {
            section.reject(
                "modes",
                "cea.modes and cea.max_frequency_hz exclude each other".to_owned(),
                "a second way to say which modes".to_owned(),
                Some("keep one of the two".to_owned()),
            );
            ModeSelection::BelowHz(limit)
        }
        (None, None) => {
            section.reject(
                "max_frequency_hz",
                "cea.max_frequency_hz (or cea.modes) is missing".to_owned(),
                "says not which modes to find".to_owned(),
                Some(
                    "add `max_frequency_hz = 17500.0` (all modes below it) \
                     or `modes = 28` (the lowest ones)"
                        .to_owned(),
                ),
            );
            ModeSelection::BelowHz(f64::NAN)
        }
    }
}

fn cea_map(cea: &Section<'_>) -> Option<CeaMap> {
    let section = cea.section("map", false);
    if !section.is_given() {
        return None;
    }
    let key = parameter(&section, "key");
    if section.has("key") && key == "contact.friction_coefficient" {
        section.reject(
            "key",
            "cea.map.key = \"contact.friction_coefficient\" is the map's first parameter already"
                .to_owned(),
            "another parameter".to_owned(),
            None,
        );
    }
    let values = rising(&section, "values", Bound::Finite).unwrap_or_default();
    if !section.has("values") || section.is_empty_list("values") {
        section.reject(
            "values",
            "cea.map.values is missing or empty".to_owned(),
            "at least one value".to_owned(),
            None,
        );
    }
    section.close();
    Some(CeaMap { key, values })
}

/// A key whose value names a numeric case key.
fn parameter(section: &Section<'_>, key: &'static str) -> String {
    let name = section.text(key);
    if section.is_some_text(key) && keys::find(&name).is_none_or(|known| !known.is_numeric()) {
        let numeric = keys::KEYS.iter().filter(|known| known.is_numeric());
        section.reject(
            key,
            format!(
                "{} = \"{name}\" is not a numeric case key",
                section.name(key)
            ),
            "must name a key whose value is a number".to_owned(),
            keys::nearest(&name, numeric.map(|known| known.name))
                .map(|near| format!("did you mean \"{near}\"?")),
        );
    }
    name
}

pub(super) fn transient(root: &Section<'_>, annulus: &AnnulusSpecification) -> Option<Transient> {
    let section = root.section("transient", false);
    if !section.is_given() {
        return None;
    }
    let duration = section.number("duration", Bound::Positive);
    let time_step = match section.number_or_word("time_step", Bound::Positive, "auto") {
        Some(step) => TimeStep::Seconds(step),
        None => TimeStep::Auto,
    };
    if let TimeStep::Seconds(step) = time_step
        && step > duration
    {
        section.reject(
            "time_step",
            format!("transient.time_step = {step} s is above transient.duration = {duration} s"),
            format!("at most {duration}"),
            None,
        );
    }
    let transient = Transient {
        duration,
        time_step,
        expansion_time: section.number_or("expansion_time", Bound::NotNegative, 5e-4),
        initial: section.choice(
            "initial",
            &[
                ("rest", InitialState::Rest),
                ("steady-sliding", InitialState::SteadySliding),
            ],
        ),
        operator: section.choice(
            "operator",
            &[
                ("auto", OperatorChoice::Auto),
                ("cyclic", OperatorChoice::Cyclic),
                ("sparse", OperatorChoice::Sparse),
            ],
        ),
        perturbation: perturbation(&section, annulus),
    };
    section.close();
    Some(transient)
}

fn perturbation(transient: &Section<'_>, annulus: &AnnulusSpecification) -> Perturbation {
    let section = transient.section("perturbation", false);
    let harmonics = harmonics(&section, 0, annulus).unwrap_or_default();
    let velocity = section.number_or("velocity", Bound::NotNegative, 1e-3);
    section.close();
    Perturbation {
        harmonics,
        velocity,
    }
}

/// A list of harmonics that the mesh can hold.
fn harmonics(
    section: &Section<'_>,
    least: usize,
    annulus: &AnnulusSpecification,
) -> Option<Vec<usize>> {
    let values = section.counts("harmonics", least)?;
    let highest = annulus.circumferential_elements / 2;
    for (value, at) in &values {
        if *value > highest && annulus.circumferential_elements > 0 {
            section.reject_there(
                at,
                format!(
                    "harmonic {value} in {} is above the mesh's highest, {highest}",
                    section.name("harmonics")
                ),
                format!(
                    "at most half of {} elements",
                    annulus.circumferential_elements
                ),
                "lower the harmonic or raise mesh.circumferential_elements",
            );
        }
    }
    Some(values.into_iter().map(|(value, _)| value).collect())
}

pub(super) fn output(
    root: &Section<'_>,
    annulus: &AnnulusSpecification,
    transient: Option<&Transient>,
    warnings: &mut Vec<String>,
) -> Output {
    let section = root.section("output", false);
    let probes = section.counts("probes", 1).unwrap_or_default();
    let nodes = node_count(annulus);
    for (probe, at) in &probes {
        if *probe as u128 > nodes && nodes > 0 {
            section.reject_there(
                at,
                format!("probe {probe} does not exist: the mesh has nodes 1 to {nodes}"),
                format!("must be at most {nodes}"),
                "node ids count radially outwards first: 1 + j (radial_elements + 1) + i",
            );
        }
    }
    let sample_interval = section.number_or("sample_interval", Bound::Positive, 2e-6);
    let snapshots = rising(&section, "snapshots", Bound::NotNegative).unwrap_or_default();
    if let Some(transient) = transient {
        if let TimeStep::Seconds(step) = transient.time_step
            && sample_interval < step
        {
            section.reject(
                "sample_interval",
                format!(
                    "output.sample_interval = {sample_interval} s is below \
                     transient.time_step = {step} s"
                ),
                format!("at least {step}"),
                None,
            );
        }
        for time in snapshots.iter().filter(|time| **time > transient.duration) {
            warnings.push(format!(
                "output.snapshots: {time} s lies after the end of the run \
                 (transient.duration = {} s) and is left out",
                transient.duration
            ));
        }
    }
    let output = Output {
        probes: probes.into_iter().map(|(probe, _)| probe).collect(),
        sample_interval,
        snapshots,
        checkpoint_interval: section.number_or("checkpoint_interval", Bound::Positive, 600.0),
    };
    section.close();
    output
}

pub(super) fn cycle(root: &Section<'_>, annulus: &AnnulusSpecification) -> Option<Cycle> {
    let section = root.section("cycle", false);
    let harmonics = harmonics(&section, 1, annulus);
    let inner = section.section("continuation", false);
    let continuation = inner.is_given().then(|| Continuation {
        key: parameter(&inner, "key"),
        from: inner.number("from", Bound::Finite),
        to: inner.number("to", Bound::Finite),
    });
    if let Some(Continuation { from, to, .. }) = &continuation
        && from == to
    {
        inner.reject(
            "to",
            format!("cycle.continuation.to = {to} equals from"),
            "must differ from `from`".to_owned(),
            None,
        );
    }
    inner.close();
    let is_given = section.is_given();
    section.close();
    is_given.then_some(Cycle {
        harmonics,
        continuation,
    })
}
