//! Derivatives of eigenvalues and critical friction of a body that is solved on its whole mesh, by the numbers of its case.

use super::StudyError;
use super::model::{Model, Solver};
use crate::case::{Case, Cea};
use crate::cea::sparse::{ModePair, mode_pairs};
use crate::cea::{CeaError, ComplexMode, FrictionSweep, UnstableInterval};
use crate::linalg::c64;
use crate::prestress::SlidingTangent;
use crate::results::cea::{OnsetRates, SensitivityReport, SensitivityRow};
use crate::study::tangent_options;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Step of a parameter for the differences of the matrices, relative to its value: entries are linear in most parameters, and
/// smooth in the others to `STEP^2`; their round-off, divided by it, stays small beside a mode's own stiffness.
const STEP: f64 = 1e-4;
/// Keys, by their last part, on which no base state depends.
const INERT: [&str; 6] = [
    "loss_factor",
    "density",
    "mass_coefficient",
    "stiffness_coefficient",
    "normal_damping",
    "tangential_damping",
];
/// Part of the modulus by which modes beyond the listed ones are looked for along.
const MARGIN: f64 = 1.02;

/// Sensitivities of a body.
pub struct BodySensitivities {
    /// What is reported.
    pub report: SensitivityReport,
    /// What is missing, and why.
    pub missing: Vec<String>,
}

/// Where derivatives are taken: the case's own friction coefficient, or an onset.
struct Place {
    /// The friction coefficient of an onset.
    onset: Option<f64>,
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

/// `[place][mode]` derivatives by one parameter; the reason of those that there are not.
type Rates = (Vec<Option<Vec<Option<c64>>>>, Option<String>);

/// Derivatives of the listed eigenvalues at the case's own friction coefficient, and of the first critical friction coefficient
/// of their branches, by every number that the case gives its model.
///
/// ```text
/// d lambda / d p = - w^T (lambda^2 dM/dp + lambda dC/dp + dK/dp) x / w^T (2 lambda M + C) x
/// d mu_c / d p   = - Re(d lambda / d p) / Re(d lambda / d mu)
/// ```
///
/// with right and left vectors of the full problem and central differences of the assembled matrices, for which the case is
/// read, its base state solved and its tangent taken with the parameter a little larger and smaller: pressure, prestress and
/// dashpots of friction follow. Where contact points open or close within that step, or where modes coincide, there is no
/// derivative.
///
/// Source: H. M. Adelman, R. T. Haftka, Sensitivity analysis of discrete structural systems, AIAA Journal 24 (1986), section on
/// the semi-analytical method.
///
/// # Errors
/// Those of the base state and of the Krylov iterations.
pub fn body_sensitivities(
    case: &Case,
    cea: &Cea,
    sweep: &FrictionSweep,
) -> Result<BodySensitivities, StudyError> {
    let friction = case.contact.sliding.friction_coefficient;
    let point = sweep.points.iter();
    let own = point.filter(|point| point.friction_coefficient == friction);
    let modes: Vec<&ComplexMode> = own.flat_map(|point| &point.modes).collect();
    let onsets = first_onsets(sweep, &modes);

    // The places, with the modes there.
    let mut places = vec![Place::new(None, modes.iter().map(|mode| mode.eigenvalue))];
    for onset in onsets.iter().flatten() {
        let eigenvalue = c64::new(0.0, TAU * onset.frequency_hz);
        places.push(Place::new(Some(onset.critical_friction), [eigenvalue].into_iter()));
    }
    let base = Linearized::of(case, cea, &places, None)?;
    for k in 0..places.len() {
        let count = count_up_to(sweep, &places[k].targets);
        let (tangent, mu) = (base.tangent(k), base.frictions[k]);
        places[k].pairs = mode_pairs(tangent, mu, &places[k].targets, count)?;
    }

    // One parameter after the other.
    let parameters = case.model_numbers();
    let rates: Vec<Rates> = parameters
        .par_iter()
        .map(|(key, value)| rates_of(case, cea, (&base, &places), (key, *value)))
        .collect();
    let mut missing = multiple_modes(&places, friction);
    missing.extend(rates.iter().filter_map(|(_, reason)| reason.clone()));
    let columns: Vec<_> = rates.into_iter().map(|(columns, _)| columns).collect();

    // Rows of the modes, with the onset of each branch.
    let mut next_onset = 1;
    let mut rows = Vec::new();
    for (j, (mode, onset)) in modes.iter().zip(&onsets).enumerate() {
        let at = next_onset;
        next_onset += usize::from(onset.is_some());
        let Some(pair) = &places[0].pairs[j] else {
            continue;
        };
        let by_keys = columns.iter().map(|column| column[0].as_ref()?[j]);
        let onset = onset.and_then(|_| onset_rates(&places[at], &columns, at));
        rows.push(SensitivityRow {
            friction_coefficient: friction,
            harmonic: mode.diameters(case.has_sectors()),
            branch: mode.branch,
            direction: case.has_sectors().then_some(mode.direction),
            eigenvalue: mode.eigenvalue,
            derivatives: std::iter::once(Some(pair.derivative)).chain(by_keys).collect(),
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
            has_onsets: true,
        },
        missing,
    })
}

impl Place {
    fn new(onset: Option<f64>, targets: impl Iterator<Item = c64>) -> Self {
        Self { onset, targets: targets.collect(), pairs: Vec::new() }
    }
}

impl Linearized {
    /// The model of a case at the places; with the base states of `like` where the two have the same.
    fn of(
        case: &Case,
        cea: &Cea,
        places: &[Place],
        like: Option<&Model>,
    ) -> Result<Self, CeaError> {
        let own = case.contact.sliding.friction_coefficient;
        let frictions: Vec<f64> = places.iter().map(|p| p.onset.unwrap_or(own)).collect();
        let options = tangent_options(case, cea.mass);
        let known = like.and_then(|like| like.with_its_states(case, options));
        let model = match known {
            Some(model) => model,
            None => {
                let solver = match case.body.assembly() {
                    Some(_) => Solver::Assembly,
                    None => Solver::WholeMesh,
                };
                Model::with_solver(case, solver, options, &frictions)?
            }
        };
        let states = 0..model.state_count();
        let tangents: Result<_, CeaError> = states.map(|k| model.tangent(case, k)).collect();
        Ok(Self { tangents: tangents?, model, frictions })
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

/// The first onset within the range of the branch of each mode.
fn first_onsets<'a>(
    sweep: &'a FrictionSweep,
    modes: &[&ComplexMode],
) -> Vec<Option<&'a UnstableInterval>> {
    let onset = |mode: &&ComplexMode| {
        let mut own = sweep.intervals.iter().filter(|interval| {
            (interval.harmonic, interval.branch) == (mode.harmonic, mode.branch)
        });
        own.next().filter(|first| !first.unstable_from_start)
    };
    modes.iter().map(onset).collect()
}

/// How many modes there may be up to the highest of some eigenvalues, at any friction coefficient of a sweep.
fn count_up_to(sweep: &FrictionSweep, targets: &[c64]) -> usize {
    let highest = targets.iter().map(|t| t.norm()).fold(0.0, f64::max);
    let points = sweep.points.iter().map(|point| {
        let modes = point.modes.iter();
        modes.filter(|mode| mode.eigenvalue.norm() <= MARGIN * highest).count()
    });
    points.max().unwrap_or(0).max(targets.len()) + 2
}

/// Derivatives by one key.
fn rates_of(
    case: &Case,
    cea: &Cea,
    (base, places): (&Linearized, &[Place]),
    (key, value): (&str, f64),
) -> Rates {
    let none = || vec![None; places.len()];
    let step = STEP * value;
    let last = key.rsplit('.').next().unwrap_or(key);
    let like = INERT.contains(&last).then_some(&base.model);
    let beside = |sign: f64| -> Result<Linearized, String> {
        let set = [format!("{key}={:?}", value + sign * step)];
        let said = |messages: Vec<String>| messages.join("; ");
        let raw = case.raw.with_overrides(&set);
        let raw = raw.map_err(|errors| said(errors.messages()))?;
        let moved = Case::from_raw(raw).map_err(|errors| said(errors.messages()))?;
        Linearized::of(&moved, cea, places, like).map_err(|error| error.to_string())
    };
    let sides = beside(1.0).and_then(|above| Ok([above, beside(-1.0)?]));
    let [above, below] = match sides {
        Ok(sides) => sides,
        Err(reason) => return (none(), Some(format!("{key}: {reason}"))),
    };
    let mut reason = None;
    let columns = (0..places.len()).map(|k| {
        let both = [&above, &below];
        if both.iter().any(|side| side.pressed(k) != base.pressed(k)) {
            let mu = base.frictions[k];
            reason = Some(format!(
                "{key}: contact points open or close at friction {mu} within a step of {STEP:e} of it"
            ));
            return None;
        }
        let alike = |side: &&Linearized| is_like(side.tangent(k), base.tangent(k));
        if !both.iter().all(alike) {
            reason = Some(format!("{key}: the unknowns change with it"));
            return None;
        }
        Some(responses(&places[k], k, both, step))
    });
    let columns = columns.collect();
    (columns, reason)
}

/// Whether two tangents have the same unknowns and nonzeros.
fn is_like(one: &SlidingTangent, other: &SlidingTangent) -> bool {
    let [a, b] = [one, other].map(|tangent| tangent.stiffness.pattern());
    one.unknowns.dofs == other.unknowns.dofs
        && a.column_pointers() == b.column_pointers()
        && a.row_indices() == b.row_indices()
}

/// Derivatives of the modes of a place from the models on either side.
fn responses(
    place: &Place,
    k: usize,
    [above, below]: [&Linearized; 2],
    step: f64,
) -> Vec<Option<c64>> {
    let changes_at = |target: c64| {
        let frequency_hz = target.im / TAU;
        let mut changes = above.values(k, frequency_hz);
        for (change, value) in changes.iter_mut().zip(below.values(k, frequency_hz)) {
            let pairs = change.iter_mut().zip(value);
            pairs.for_each(|(change, value)| *change = (*change - value) / (2.0 * step));
        }
        changes
    };
    let pattern = above.tangent(k).stiffness.pattern();
    let response = |pair: &Option<ModePair>, changes: &[Vec<f64>; 4]| {
        let [stiffness, damping, mass, structural] = changes.each_ref().map(Vec::as_slice);
        let pair = pair.as_ref()?;
        Some(pair.lossy_response(pattern, [stiffness, damping, mass], structural))
    };
    let modes = place.targets.iter().zip(&place.pairs);
    if above.tangent(k).tabled.is_empty() {
        let changes = changes_at(c64::new(0.0, 0.0));
        return modes.map(|(_, pair)| response(pair, &changes)).collect();
    }
    // Where stiffness depends on frequency the matrices are others for each mode.
    modes.map(|(target, pair)| response(pair, &changes_at(*target))).collect()
}

/// `d mu_c / d p` of the mode of a place by every parameter.
fn onset_rates(
    place: &Place,
    columns: &[Vec<Option<Vec<Option<c64>>>>],
    at: usize,
) -> Option<OnsetRates> {
    let pair = place.pairs[0].as_ref()?;
    let rate = |column: &Vec<Option<Vec<Option<c64>>>>| {
        let response = column[at].as_ref()?[0]?;
        Some(-response.re / pair.derivative.re)
    };
    Some(OnsetRates {
        critical_friction: pair.friction_coefficient,
        derivatives: std::iter::once(None).chain(columns.iter().map(rate)).collect(),
    })
}

/// Modes that have no single vector.
fn multiple_modes(places: &[Place], friction: f64) -> Vec<String> {
    let found = places.iter().flat_map(|place| {
        let mu = place.onset.unwrap_or(friction);
        let modes = place.targets.iter().zip(&place.pairs);
        let lost = modes.filter(|(_, pair)| pair.is_none());
        lost.map(move |(target, _)| {
            format!(
                "the mode at {:.1} Hz and friction {mu} coincides with another one, or was not found again",
                target.im / TAU
            )
        })
    });
    found.collect()
}

/// Keys of the sections that every case has, without the section.
fn short_name(key: &str) -> String {
    let sections = ["material.", "damping.", "contact."];
    let short = sections.iter().find_map(|section| key.strip_prefix(section));
    short.unwrap_or(key).to_owned()
}
