//! Derivatives of eigenvalues and critical friction of any body by the numbers of its case.

use super::StudyError;
use super::model::{Model, Solver, Waves};
use crate::case::{Case, Cea};
use crate::cea::cyclic::{Beside, WavePair, wave_pairs, wave_responses};
use crate::cea::sparse::{ModePair, mode_pairs};
use crate::cea::{CeaError, ComplexMode, FrictionSweep, ModeBranch, UnstableInterval};
use crate::linalg::c64;
use crate::prestress::SlidingTangent;
use crate::results::cea::{OnsetRates, SensitivityReport, SensitivityRow};
use crate::study::tangent_options;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Step of a parameter for the differences of the matrices, relative to its value: entries are linear in most parameters, and
/// smooth in the others to `STEP^2`; their round-off, divided by it, stays small beside a mode's own stiffness.
const STEP: f64 = 1e-4;
/// How much longer the steps of waves are, whose quotients are of fourth order: their matrices are small.
const WIDER: f64 = 10.0;
/// Steps of the coefficients of damping from zero, in which matrices are linear: of the size that measured ones have.
const STEPS_FROM_ZERO: [(&str, f64); 2] =
    [("mass_coefficient", 1.0), ("stiffness_coefficient", 1e-8)];
/// Keys, by their last part, on which no base state depends.
const INERT: [&str; 6] = [
    "loss_factor",
    "density",
    "mass_coefficient",
    "stiffness_coefficient",
    "normal_damping",
    "tangential_damping",
];

/// Sensitivities of a body.
pub struct BodySensitivities {
    /// What is reported.
    pub report: SensitivityReport,
    /// What is missing, and why.
    pub missing: Vec<String>,
}

/// A mode, or the onset of one: what is differentiated.
#[derive(Clone, Copy)]
struct Target {
    friction: f64,
    eigenvalue: c64,
}

/// The eigenpairs of targets, `None` where no single vector belongs to one.
enum Pairs {
    /// Of a body solved on its whole mesh, with the model at the friction coefficients of `places`.
    Whole(Linearized, Vec<Place>),
    /// Of a body solved harmonic by harmonic, with the rings of its contact that are pressed.
    Waves(Vec<Option<WavePair>>, Vec<bool>),
}

/// Where derivatives on a whole mesh are taken: the case's own friction coefficient, or an onset.
struct Place {
    friction: f64,
    /// Eigenvalues that are looked for, rad/s.
    targets: Vec<c64>,
    /// Their modes, where they are single.
    pairs: Vec<Option<ModePair>>,
}

/// A model with the tangents of its base states, and the friction coefficients of the places.
struct Linearized {
    model: Model,
    tangents: Vec<SlidingTangent>,
    frictions: Vec<f64>,
}

/// Derivatives of the targets by one parameter; the reason of those that there are not.
type Rates = (Vec<Option<c64>>, Option<String>);

/// Derivatives of the listed eigenvalues at the case's own friction coefficient, and of the first critical friction coefficient
/// of their branches, by every number that the case gives its model.
///
/// ```text
/// d lambda / d p = - w^T (lambda^2 dM/dp + lambda dC/dp + dK/dp) x / w^T (2 lambda M + C) x
/// d mu_c / d p   = - Re(d lambda / d p) / Re(d lambda / d mu)
/// ```
///
/// with right and left vectors of the full problem, or of one harmonic of a body that has `waves`, and differences of the
/// assembled matrices, for which the case is read, its base state solved and its tangent taken with the parameter a little
/// larger and smaller: pressure, prestress and dashpots of friction follow. Where contact points open or close within that step,
/// or where modes coincide, there is no derivative.
///
/// Source: H. M. Adelman, R. T. Haftka, Sensitivity analysis of discrete structural systems, AIAA Journal 24 (1986), section on
/// the semi-analytical method.
///
/// # Errors
/// Those of the base state.
pub fn body_sensitivities(
    case: &Case,
    cea: &Cea,
    sweep: &FrictionSweep,
    waves: Option<&Waves>,
) -> Result<BodySensitivities, StudyError> {
    let friction = case.contact.sliding.friction_coefficient;

    // The targets: the modes at the own friction coefficient, then the onsets of those that have one.
    let modes = match waves {
        Some(waves) => waves_at(&waves.branches, friction),
        None => modes_at(sweep, friction, case.has_sectors()),
    };
    let own = modes.iter().map(|mode| Target { friction, eigenvalue: mode.eigenvalue });
    let onsets = modes.iter().filter_map(|mode| mode.onset);
    let targets: Vec<Target> = own.chain(onsets).collect();
    let pairs = match waves {
        Some(waves) => {
            let own = modes.iter().filter_map(|mode| mode.of);
            let with_onset = modes.iter().filter(|mode| mode.onset.is_some());
            let all = own.chain(with_onset.filter_map(|mode| mode.of)).zip(&targets);
            let wanted: Vec<_> = all.map(|(branch, target)| (branch, target.friction)).collect();
            let pressed = waves.tangent.pressed().to_vec();
            Pairs::Waves(wave_pairs(&waves.tangent, &wanted), pressed)
        }
        None => whole_pairs(case, cea, (modes.len(), &targets))?,
    };
    let found = pairs.each();

    // One parameter after the other.
    let parameters = parameters(case);
    let rates: Vec<Rates> = parameters
        .par_iter()
        .map(|(key, value)| rates_of(case, cea, &pairs, (key, *value)))
        .collect();
    let lost = targets.iter().zip(&found).filter(|(_, pair)| pair.is_none());
    let mut missing: Vec<String> = lost.map(|(target, _)| lost_note(target)).collect();
    missing.extend(rates.iter().filter_map(|(_, reason)| reason.clone()));
    let columns: Vec<_> = rates.into_iter().map(|(columns, _)| columns).collect();

    // Rows of the modes, with the onset of each branch.
    let mut next_onset = modes.len();
    let mut rows = Vec::new();
    for (j, mode) in modes.iter().enumerate() {
        let at = next_onset;
        next_onset += usize::from(mode.onset.is_some());
        let Some((eigenvalue, by_friction)) = found[j] else {
            continue;
        };
        let onset = mode.onset.and_then(|onset| {
            let by = |column: &Vec<Option<c64>>| Some(-column[at]?.re / found[at]?.1.re);
            found[at].map(|_| OnsetRates {
                critical_friction: onset.friction,
                derivatives: std::iter::once(None).chain(columns.iter().map(by)).collect(),
            })
        });
        let by_keys = columns.iter().map(|column| column[j]);
        rows.push(SensitivityRow {
            friction_coefficient: friction,
            harmonic: mode.diameters,
            branch: mode.branch,
            direction: case.has_sectors().then_some(mode.direction),
            eigenvalue,
            derivatives: std::iter::once(Some(by_friction)).chain(by_keys).collect(),
            onset,
        });
    }
    let names = parameters.iter().map(|(key, _)| short_name(key));
    Ok(BodySensitivities {
        report: SensitivityReport {
            parameters: std::iter::once("friction_coefficient".to_owned()).chain(names).collect(),
            values: std::iter::once(f64::NAN)
                .chain(parameters.iter().map(|(_, value)| *value))
                .collect(),
            rows,
        },
        missing,
    })
}

/// The parameters of a case with their values; coefficients of damping of zero among them.
fn parameters(case: &Case) -> Vec<(String, f64)> {
    let mut all = case.model_numbers();
    all.retain(|(key, value)| *value != 0.0 || step_of(key, 0.0) > 0.0);
    all
}

/// Step of a parameter from a value.
fn step_of(key: &str, value: f64) -> f64 {
    let last = key.rsplit('.').next().unwrap_or(key);
    match value {
        0.0 => {
            let own = STEPS_FROM_ZERO.iter().find(|(name, _)| *name == last);
            own.map_or(0.0, |(_, step)| *step)
        }
        // Moduli run away where a body becomes incompressible.
        _ if last == "poisson_ratio" => STEP * value.abs().min((0.5 - value).abs().max(0.01)),
        _ => STEP * value.abs(),
    }
}

/// A mode at the case's own friction coefficient.
struct Listed<'a> {
    /// See [`crate::cea::ComplexMode::diameters`].
    diameters: Option<usize>,
    branch: usize,
    direction: i8,
    eigenvalue: c64,
    onset: Option<Target>,
    /// The branch of a wave.
    of: Option<&'a ModeBranch>,
}

/// Where a branch turns unstable within the range first, of its intervals.
fn onset_of<'a>(mut intervals: impl Iterator<Item = &'a UnstableInterval>) -> Option<Target> {
    let first = intervals.next().filter(|first| !first.unstable_from_start)?;
    Some(Target {
        friction: first.critical_friction,
        eigenvalue: c64::new(0.0, TAU * first.frequency_hz),
    })
}

/// The branches of waves that oscillate at a friction coefficient.
fn waves_at(branches: &[ModeBranch], friction: f64) -> Vec<Listed<'_>> {
    let of = |branch: &'_ ModeBranch| branch.interpolate(friction);
    let there = branches.iter().filter_map(|branch| Some((branch, of(branch)?)));
    let listed = there.map(|(branch, eigenvalue)| Listed {
        diameters: Some(branch.harmonic),
        branch: branch.branch,
        direction: branch.direction,
        eigenvalue,
        onset: onset_of(branch.intervals.iter()),
        of: Some(branch),
    });
    listed.collect()
}

/// The modes of a sweep over a whole mesh at a friction coefficient.
fn modes_at(sweep: &FrictionSweep, friction: f64, has_harmonics: bool) -> Vec<Listed<'_>> {
    let points = sweep.points.iter().filter(|point| point.friction_coefficient == friction);
    let listed = points.flat_map(|point| &point.modes).map(|mode: &ComplexMode| {
        let own = |interval: &&UnstableInterval| {
            (interval.harmonic, interval.branch) == (mode.harmonic, mode.branch)
        };
        Listed {
            diameters: mode.diameters(has_harmonics),
            branch: mode.branch,
            direction: mode.direction,
            eigenvalue: mode.eigenvalue,
            onset: onset_of(sweep.intervals.iter().filter(own)),
            of: None,
        }
    });
    listed.collect()
}

/// The eigenpairs of targets on a whole mesh, of which the first `own` are at one friction coefficient.
fn whole_pairs(
    case: &Case,
    cea: &Cea,
    (own, targets): (usize, &[Target]),
) -> Result<Pairs, StudyError> {
    let (modes, onsets) = targets.split_at(own);
    let groups = std::iter::once(modes).chain(onsets.chunks(1)).filter(|group| !group.is_empty());
    let mut places: Vec<Place> = groups
        .map(|group| Place {
            friction: group[0].friction,
            targets: group.iter().map(|target| target.eigenvalue).collect(),
            pairs: Vec::new(),
        })
        .collect();
    let frictions: Vec<f64> = places.iter().map(|place| place.friction).collect();
    let base = Linearized::of(case, cea, &frictions, None)?;
    for (k, place) in places.iter_mut().enumerate() {
        place.pairs = mode_pairs(base.tangent(k), place.friction, &place.targets);
    }
    Ok(Pairs::Whole(base, places))
}

impl Pairs {
    /// Eigenvalue and derivative by the friction coefficient of each target.
    fn each(&self) -> Vec<Option<(c64, c64)>> {
        match self {
            Self::Whole(_, places) => {
                let pairs = places.iter().flat_map(|place| &place.pairs);
                pairs.map(|p| p.as_ref().map(|p| (p.eigenvalue, p.derivative))).collect()
            }
            Self::Waves(pairs, _) => {
                pairs.iter().map(|p| p.as_ref().map(|p| (p.eigenvalue, p.derivative))).collect()
            }
        }
    }
}

impl Linearized {
    /// The model of a case at friction coefficients; with the base states of `like` where the two have the same.
    fn of(
        case: &Case,
        cea: &Cea,
        frictions: &[f64],
        like: Option<&Model>,
    ) -> Result<Self, CeaError> {
        let options = tangent_options(case, cea.mass);
        let known = like.and_then(|like| like.with_its_states(case, options));
        let model = match known {
            Some(model) => model,
            None => {
                let solver = match case.body.assembly() {
                    Some(_) => Solver::Assembly,
                    None => Solver::WholeMesh,
                };
                Model::with_solver(case, solver, options, frictions)?
            }
        };
        let states = 0..model.state_count();
        let tangents: Result<_, CeaError> = states.map(|k| model.tangent(case, k)).collect();
        Ok(Self { tangents: tangents?, model, frictions: frictions.to_vec() })
    }

    /// The tangent at a place.
    fn tangent(&self, place: usize) -> &SlidingTangent {
        &self.tangents[self.model.state_of()[place]]
    }

    /// Which contact points are pressed there.
    fn pressed(&self, place: usize) -> &[bool] {
        self.model.pressed(self.model.state_of()[place])
    }

    /// Nonzero values of `K`, `C`, `M` and the structural damping `H` there, empty without, at a frequency in Hz where stiffness
    /// depends on that.
    fn values(&self, place: usize, frequency_hz: f64) -> [Vec<f64>; 4] {
        let (tangent, mu) = (self.tangent(place), self.frictions[place]);
        let tangent = tangent.at_frequency(frequency_hz);
        let structural = tangent.structural.as_ref();
        [
            tangent.stiffness.evaluate(mu),
            tangent.damping.evaluate(mu),
            tangent.mass.evaluate(mu),
            structural.map_or_else(Vec::new, |p| p.evaluate(mu)),
        ]
    }
}

/// The terms of a difference quotient with their weights: on either side of a value, or on one side where the other is refused,
/// both to the square of the step.
///
/// # Errors
/// Why there is no value on either side.
fn quotient<T>(
    step: f64,
    beside: impl Fn(f64) -> Result<T, String>,
) -> Result<Vec<(f64, T)>, String> {
    let (side, near) = match (beside(step), beside(-step)) {
        (Ok(above), Ok(below)) => return Ok(vec![(0.5 / step, above), (-0.5 / step, below)]),
        (Ok(above), Err(_)) => (step, above),
        (Err(_), Ok(below)) => (-step, below),
        (Err(reason), Err(_)) => return Err(reason),
    };
    let (own, far) = (beside(0.0)?, beside(2.0 * side)?);
    Ok(vec![(2.0 / side, near), (-0.5 / side, far), (-1.5 / side, own)])
}

/// Derivatives of eigenpairs of waves at the friction coefficient of a case by a parameter from its `value` on; `moved` is the
/// case with it elsewhere.
///
/// # Errors
/// Why there are none.
pub(in crate::study) fn rates_of_waves(
    (case, cea): (&Case, &Cea),
    (pairs, pressed): (&[&WavePair], &[bool]),
    step: f64,
    moved: &dyn Fn(f64) -> Result<Case, String>,
) -> Result<Vec<c64>, String> {
    let friction = case.contact.sliding.friction_coefficient;
    let beside = |offset: f64| {
        let moved = moved(offset)?;
        let options = tangent_options(&moved, cea.mass);
        let model = Model::with_solver(&moved, Solver::by_symmetry(&moved), options, &[]);
        let tangent = model.and_then(|model| model.wave_tangent(&moved));
        let tangent = tangent.map_err(|error| error.to_string())?;
        let tangent = tangent.ok_or_else(|| "the body loses its symmetry with it".to_owned())?;
        if tangent.pressed() != pressed {
            return Err("contact rings open or close near it".to_owned());
        }
        let friction_shift = moved.contact.sliding.friction_coefficient - friction;
        Ok(Beside { weight: 0.0, tangent, friction_shift })
    };
    // Richardson's extrapolation: what is left is of fourth order, so that the step may stay far above round-off.
    let step = WIDER * step;
    let [near, far] = [quotient(step, beside)?, quotient(2.0 * step, beside)?];
    let [near, far] = [(near, 4.0 / 3.0), (far, -1.0 / 3.0)].map(|(terms, share)| {
        terms.into_iter().map(move |(weight, own)| Beside { weight: share * weight, ..own })
    });
    let terms: Vec<Beside> = near.chain(far).collect();
    wave_responses(pairs, &terms).ok_or_else(|| "the unknowns change with it".to_owned())
}

/// Derivatives by one key.
fn rates_of(case: &Case, cea: &Cea, pairs: &Pairs, (key, value): (&str, f64)) -> Rates {
    let moved = |offset: f64| -> Result<Case, String> {
        let set = [format!("{key}={:?}", value + offset)];
        let said = |messages: Vec<String>| messages.join("; ");
        let raw = case.raw.with_overrides(&set);
        let raw = raw.map_err(|errors| said(errors.messages()))?;
        Case::read(raw).map_err(|errors| said(errors.messages()))
    };
    let step = step_of(key, value);
    let (rates, reason) = match pairs {
        Pairs::Waves(all, pressed) => {
            let there: Vec<&WavePair> = all.iter().flatten().collect();
            match rates_of_waves((case, cea), (&there, pressed), step, &moved) {
                Ok(found) => {
                    let mut found = found.into_iter();
                    (
                        all.iter().map(|pair| pair.as_ref().and_then(|_| found.next())).collect(),
                        None,
                    )
                }
                Err(reason) => (vec![None; all.len()], Some(reason)),
            }
        }
        Pairs::Whole(base, places) => {
            let last = key.rsplit('.').next().unwrap_or(key);
            let like = INERT.contains(&last).then_some(&base.model);
            let beside = |offset: f64| {
                let moved = moved(offset)?;
                // The first place is the case's own operating point, which a friction coefficient of a pair moves.
                let mut frictions = base.frictions.clone();
                frictions[0] = moved.contact.sliding.friction_coefficient;
                let own = Linearized::of(&moved, cea, &frictions, like);
                own.map_err(|error| error.to_string())
            };
            match quotient(step, beside) {
                Ok(terms) => whole_rates(base, places, &terms),
                Err(reason) => {
                    let count = places.iter().map(|place| place.targets.len()).sum();
                    (vec![None; count], Some(reason))
                }
            }
        }
    };
    (rates, reason.map(|reason| format!("{key}: {reason}")))
}

/// Derivatives of the modes of all places on a whole mesh.
fn whole_rates(base: &Linearized, places: &[Place], terms: &[(f64, Linearized)]) -> Rates {
    let mut reason = None;
    let columns = places.iter().enumerate().map(|(k, place)| {
        if terms.iter().any(|(_, side)| side.pressed(k) != base.pressed(k)) {
            let mu = base.frictions[k];
            reason = Some(format!(
                "contact points open or close at friction {mu} within a step of {STEP:e} of it"
            ));
            return vec![None; place.targets.len()];
        }
        if !terms.iter().all(|(_, side)| is_like(side.tangent(k), base.tangent(k))) {
            reason = Some("the unknowns change with it".to_owned());
            return vec![None; place.targets.len()];
        }
        responses(place, k, terms)
    });
    let columns: Vec<Vec<Option<c64>>> = columns.collect();
    (columns.concat(), reason)
}

/// Whether two tangents have the same unknowns and nonzeros.
fn is_like(one: &SlidingTangent, other: &SlidingTangent) -> bool {
    let [a, b] = [one, other].map(|tangent| tangent.stiffness.pattern());
    one.unknowns.dofs == other.unknowns.dofs
        && a.column_pointers() == b.column_pointers()
        && a.row_indices() == b.row_indices()
}

/// Derivatives of the modes of a place from models beside the case's own.
fn responses(place: &Place, k: usize, terms: &[(f64, Linearized)]) -> Vec<Option<c64>> {
    let changes_at = |target: c64| {
        let frequency_hz = target.im / TAU;
        let mut changes: [Vec<f64>; 4] = Default::default();
        for (weight, side) in terms {
            for (change, values) in changes.iter_mut().zip(side.values(k, frequency_hz)) {
                change.resize(values.len(), 0.0);
                change.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
            }
        }
        changes
    };
    let tangent = terms[0].1.tangent(k);
    let pattern = tangent.stiffness.pattern();
    let response = |pair: &Option<ModePair>, changes: &[Vec<f64>; 4]| {
        let [stiffness, damping, mass, structural] = changes.each_ref().map(Vec::as_slice);
        let pair = pair.as_ref()?;
        Some(pair.lossy_response(pattern, [stiffness, damping, mass], structural))
    };
    let modes = place.targets.iter().zip(&place.pairs);
    if tangent.tabled.is_empty() {
        let changes = changes_at(c64::new(0.0, 0.0));
        return modes.map(|(_, pair)| response(pair, &changes)).collect();
    }
    // Where stiffness depends on frequency the matrices are others for each mode.
    modes.map(|(target, pair)| response(pair, &changes_at(*target))).collect()
}

/// Why a target has no derivatives.
fn lost_note(target: &Target) -> String {
    format!(
        "the mode at {:.1} Hz and friction {} coincides with another one, or was not found again",
        target.eigenvalue.im / TAU,
        target.friction
    )
}

/// Keys of the sections that every case has, without the section.
fn short_name(key: &str) -> String {
    let sections = ["material.", "damping.", "contact."];
    let short = sections.iter().find_map(|section| key.strip_prefix(section));
    short.unwrap_or(key).to_owned()
}
