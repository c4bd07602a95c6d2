//! Derivatives of eigenpairs by one parameter: difference quotients of the matrices.

use super::{Pairs, Place};
use crate::eigenvalues::model::wave_tangent;
use crate::*;
use frictionsim_physics::cea::cyclic::{Beside, WavePair, wave_responses};
use frictionsim_physics::cea::sparse::ModePair;
use frictionsim_physics::prestress::MotionMatrices;

/// Step of a parameter for the differences of the matrices, relative to its value: entries are linear in most
/// parameters, and smooth in the others to `STEP^2`; their round-off, divided by it, stays small beside a mode's own
/// stiffness.
const STEP: f64 = 1e-4;
/// How much longer the steps of waves are, whose quotients are of fourth order: their matrices are small.
const WIDER: f64 = 10.0;
/// Steps of the coefficients of damping from zero, in which matrices are linear: of the size that measured ones have.
const STEPS_FROM_ZERO: [(&str, f64); 2] =
    [("mass_coefficient", 1.0), ("stiffness_coefficient", 1e-8)];
/// Keys, by their last part, on which no base state depends, and in which matrices are linear.
const INERT: [&str; 6] = [
    "loss_factor",
    "density",
    "mass_coefficient",
    "stiffness_coefficient",
    "normal_damping",
    "tangential_damping",
];

/// A model with the tangents of its base states, and the friction coefficients of the places.
pub(super) struct Linearized {
    model: WholeMesh,
    tangents: Vec<SlidingTangent>,
    frictions: Vec<f64>,
}

/// Derivatives of the targets by one parameter; the reason of those that there are not.
pub(super) type Rates = (Vec<Option<c64>>, Option<String>);

/// Step of a parameter from a value.
pub(super) fn step_of(key: &str, value: f64) -> f64 {
    let last = key.rsplit('.').next().unwrap_or(key);
    match value {
        0.0 => {
            STEPS_FROM_ZERO.iter().find(|(name, _)| *name == last).map_or(0.0, |(_, step)| *step)
        }
        // Moduli run away where a body becomes incompressible.
        _ if last == "poisson_ratio" => STEP * value.abs().min((0.5 - value).abs().max(0.01)),
        _ => STEP * value.abs(),
    }
}

impl Linearized {
    /// The model of a case at friction coefficients; with the base states of `like` where the two have the same.
    pub(super) fn of(
        case: &Case,
        cea: &Cea,
        frictions: &[f64],
        like: Option<&WholeMesh>,
    ) -> Result<Self, CeaError> {
        let options = tangent_options(case, cea.mass);
        let known = like.and_then(|like| like.with_its_states(case, options));
        let model = known.map_or_else(|| WholeMesh::solve(case, options, frictions), Ok)?;
        let states = model.range.states.iter();
        let tangents: Result<_, CeaError> = states.map(|own| model.tangent(case, own)).collect();
        Ok(Self { tangents: tangents?, model, frictions: frictions.to_vec() })
    }

    /// The tangent at a place.
    pub(super) fn tangent(&self, place: usize) -> &SlidingTangent {
        &self.tangents[self.model.range.state_of[place]]
    }

    /// How far the eigenvalue of a pair is from one there, to first order: the response to all that the matrices have.
    pub(super) fn shift(&self, place: usize, pair: &ModePair) -> c64 {
        let values = self.values(place, pair.eigenvalue.im / TAU);
        pair.response(self.tangent(place).stiffness.pattern(), &values)
    }

    /// Which contact points are pressed there.
    fn pressed(&self, place: usize) -> &[bool] {
        &self.model.range.states[self.model.range.state_of[place]].is_pressed
    }

    /// Nonzero values of the matrices there, at a frequency in Hz where stiffness depends on that.
    fn values(&self, place: usize, frequency_hz: f64) -> MotionMatrices<Vec<f64>> {
        let tangent = self.tangent(place).at_frequency(frequency_hz);
        MotionMatrices::of(&tangent, |matrix| matrix.evaluate(self.frictions[place]))
    }
}

/// The terms of a difference quotient with their weights: on either side of a value, or on one side where the other is
/// refused, both to the square of the step.
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

/// Derivatives of those eigenpairs of waves that there are, at the friction coefficient of a case by a parameter from
/// its `value` on; `moved` is the case with it elsewhere. Matrices that are linear in it have one quotient.
pub(crate) fn rates_of_waves(
    (case, cea): (&Case, &Cea),
    (pairs, pressed): (&[Option<WavePair>], &[bool]),
    (step, is_linear): (f64, bool),
    moved: &dyn Fn(f64) -> Result<Case, String>,
) -> Result<Vec<Option<c64>>, String> {
    let friction = case.contact.sliding.friction_coefficient;
    let beside = |offset: f64| {
        let moved = moved(offset)?;
        let tangent = wave_tangent(&moved, &tangent_options(&moved, cea.mass));
        let tangent = tangent.map_err(|error| error.to_string())?;
        let tangent = tangent.ok_or_else(|| "the body loses its symmetry with it".to_owned())?;
        if tangent.contact.is_pressed != pressed {
            return Err("contact rings open or close near it".to_owned());
        }
        let friction_shift = moved.contact.sliding.friction_coefficient - friction;
        Ok(Beside { weight: 0.0, tangent, friction_shift })
    };
    // Richardson's extrapolation: what is left is of fourth order, so that the step may stay far above round-off.
    let shares = if is_linear { &[(1.0, 1.0)][..] } else { &[(1.0, 4.0 / 3.0), (2.0, -1.0 / 3.0)] };
    let mut terms = Vec::new();
    for &(steps, share) in shares {
        let sides = quotient(steps * WIDER * step, beside)?.into_iter();
        terms.extend(sides.map(|(weight, own)| Beside { weight: share * weight, ..own }));
    }
    let there: Vec<&WavePair> = pairs.iter().flatten().collect();
    let found = wave_responses(&there, &terms);
    let mut found = found.ok_or_else(|| "the unknowns change with it".to_owned())?.into_iter();
    Ok(pairs.iter().map(|pair| pair.as_ref().and_then(|_| found.next())).collect())
}

/// Derivatives by one key.
pub(super) fn rates_of(case: &Case, cea: &Cea, pairs: &Pairs, (key, value): (&str, f64)) -> Rates {
    let moved = |offset: f64| -> Result<Case, String> {
        let set = [format!("{key}={:?}", value + offset)];
        case.with_keys(&set).map_err(|errors| errors.line())
    };
    let step = step_of(key, value);
    let is_inert = INERT.contains(&key.rsplit('.').next().unwrap_or(key));
    let found = match pairs {
        Pairs::Waves(all, pressed) => {
            rates_of_waves((case, cea), (all, pressed), (step, is_inert), &moved).map(|r| (r, None))
        }
        Pairs::Whole(base, places) => {
            let like = is_inert.then_some(&base.model);
            let beside = |offset: f64| {
                let moved = moved(offset)?;
                // The first place is the case's own operating point, which a friction coefficient of a pair moves.
                let mut frictions = base.frictions.clone();
                frictions[0] = moved.contact.sliding.friction_coefficient;
                Linearized::of(&moved, cea, &frictions, like).map_err(|error| error.to_string())
            };
            quotient(step, beside).map(|terms| whole_rates(base, places, &terms))
        }
    };
    let none = |reason| (vec![None; pairs.each().len()], Some(reason));
    let (rates, reason) = found.unwrap_or_else(none);
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
pub(crate) fn is_like(one: &SlidingTangent, other: &SlidingTangent) -> bool {
    let [a, b] = [one, other].map(|tangent| tangent.stiffness.pattern());
    one.unknowns.dofs == other.unknowns.dofs
        && a.column_pointers() == b.column_pointers()
        && a.row_indices() == b.row_indices()
}

/// Derivatives of the modes of a place from models beside the case's own.
fn responses(place: &Place, k: usize, terms: &[(f64, Linearized)]) -> Vec<Option<c64>> {
    let changes_at = |target: c64| {
        let frequency_hz = target.im / TAU;
        // Weights sum up to zero: what all have alike leaves no round-off.
        let first = terms[0].1.values(k, frequency_hz);
        let mut changes = first.map(|values| vec![0.0; values.len()]);
        for (weight, side) in &terms[1..] {
            let values = side.values(k, frequency_hz);
            let sides = values.each().zip(first.each());
            for (change, (values, first)) in changes.each_mut().zip(sides) {
                let differences = values.iter().zip(first).map(|(value, first)| value - first);
                change.iter_mut().zip(differences).for_each(|(sum, own)| *sum += weight * own);
            }
        }
        changes
    };
    let tangent = terms[0].1.tangent(k);
    let pattern = tangent.stiffness.pattern();
    let response = |pair: &Option<ModePair>, changes: &MotionMatrices<_>| {
        Some(pair.as_ref()?.response(pattern, changes))
    };
    let modes = place.targets.iter().zip(&place.pairs);
    if !tangent.is_tabled() {
        let changes = changes_at(c64::new(0.0, 0.0));
        return modes.map(|(_, pair)| response(pair, &changes)).collect();
    }
    // Where stiffness depends on frequency the matrices are others for each mode.
    modes.map(|(target, pair)| response(pair, &changes_at(*target))).collect()
}
