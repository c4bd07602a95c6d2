//! Limit cycles that a case asks for, the parameter over which they are followed, and where along it steady sliding
//! loses its stability.

use crate::*;
use frictionsim_case::{Cycle, OnsetChoice};
use frictionsim_physics::cycle::{CycleSolver, DiscModel, LARGEST_FRICTION, MODES, Onset};
use frictionsim_physics::linalg::Bracket;

/// The solver of a family, or why it has none.
pub type Sought = Result<CycleSolver, (Family, CycleError)>;

/// The first onset above a friction coefficient, for the sentence that steady sliding is stable there.
pub fn next_onset(case: &Case, friction: f64) -> Option<Onset> {
    let model = disc_model(case).ok()?;
    let mut highest = 2.0 * friction;
    while highest <= 2.0 {
        let found = model.onsets(highest, asked_modes(case, MODES)).ok()?;
        if let Some(first) = found.into_iter().next() {
            return Some(first);
        }
        highest *= 2.0;
    }
    None
}

/// The value of a parameter, SI, towards its range at which the lowest onset comes down to the case's friction
/// coefficient; none of speed and interference: sliding at constant friction knows neither.
pub fn critical_value(case: &Case, parameter: Parameter, values: &[f64]) -> Option<f64> {
    let mut point = operating_point(case);
    let (model, here) = (disc_model(case).ok()?, parameter.of(&point));
    let friction = point.contact.friction_coefficient;
    if parameter == Parameter::FrictionCoefficient {
        return Some(next_onset(case, friction)?.friction_coefficient);
    }
    if parameter.is_of_contact() {
        return None;
    }
    let mut growth = |value: f64| {
        parameter.set(&mut point, value);
        let damping = point.damping;
        let other = DiscModel { damping, ..model };
        let onsets = other.onsets(LARGEST_FRICTION, asked_modes(case, MODES)).ok()?;
        let lowest = onsets.first().map(|onset| onset.friction_coefficient);
        Some(friction - lowest.unwrap_or(LARGEST_FRICTION))
    };
    let growing = candidates(values, here);
    let growing = growing.into_iter().find(|&value| growth(value).is_some_and(|own| own > 0.0))?;
    critical(growth, [here, growing])
}

/// The disc of a case as its limit cycles see it.
///
/// # Errors
/// A body that is no plane annulus.
pub fn disc_model(case: &Case) -> Result<DiscModel, CaseErrors> {
    let annulus = case.require_annulus()?;
    Ok(DiscModel {
        specification: *annulus,
        material: case.body.materials[0].elastic,
        damping: case.damping.rayleigh,
    })
}

/// One solver for each family asked for; where no harmonic is named, for every wave that is unstable at the case's
/// friction. One that is named is sought even where steady sliding is stable: its cycles may outlive their birth.
pub fn solvers(case: &Case, cycle: &Cycle, onsets: &[Onset]) -> Result<Vec<Sought>, StudyError> {
    let (model, limit) = (disc_model(case)?, asked_modes(case, MODES));
    let harmonics: BTreeSet<usize> = match &cycle.harmonics {
        Some(harmonics) => harmonics.iter().copied().collect(),
        None => onsets.iter().map(|onset| onset.harmonic).collect(),
    };
    let mut solvers = Vec::new();
    for harmonic in harmonics {
        let own = onsets.iter().filter(|onset| onset.harmonic == harmonic);
        let mut own: Vec<Onset> = own.copied().collect();
        if own.is_empty() {
            match model.onset_of(Family::lowest(harmonic), limit) {
                Ok(onset) => own.push(onset),
                Err(error) => {
                    solvers.push(Err((Family::lowest(harmonic), error)));
                    continue;
                }
            }
        }
        if cycle.onsets == OnsetChoice::Lowest {
            own.truncate(1);
        }
        for (rank, onset) in own.iter().enumerate() {
            let family = Family { harmonic, onset: rank + 1 };
            match CycleSolver::born_at(&model, family, onset, cycle.phases) {
                Ok(solver) => solvers.push(Ok(solver)),
                Err(error @ CycleError::Undamped(_)) => solvers.push(Err((family, error))),
                Err(error) => return Err(error.into()),
            }
        }
    }
    Ok(solvers)
}

/// Share of the interval that an onset is known to.
const NEAR: f64 = 1e-7;
/// Values of a range, evenly over it, at which growth is looked for.
const LOOKED_AT: usize = 9;

/// Values of a range at which sliding may be unstable, in the order in which they are looked at: both ends, the one
/// nearer to `here` first, then some between, likewise.
pub(super) fn candidates(values: &[f64], here: f64) -> Vec<f64> {
    let last = values.len() - 1;
    let by_distance = |places: &mut dyn Iterator<Item = usize>| {
        let mut own = sorted(places.map(|place| values[place]), |own| (own - here).abs());
        own.dedup();
        own
    };
    let inner = last.saturating_sub(1).min(LOOKED_AT - 2);
    let ends = by_distance(&mut [0, last].into_iter());
    let between = (1..=inner).map(|i| i * last / (inner + 1));
    let between = by_distance(&mut between.filter(|&place| place > 0 && place < last));
    [ends, between].concat()
}

/// The value of a parameter, SI, between one at which steady sliding is stable and one at which it is not: where its
/// largest `growth` rate vanishes, by false position; none where it is not stable at the first.
pub(super) fn critical(
    mut growth: impl FnMut(f64) -> Option<f64>,
    [stable, growing]: [f64; 2],
) -> Option<f64> {
    let [decay, rise] = [growth(stable)?, growth(growing)?];
    if decay > 0.0 || rise <= 0.0 {
        return None;
    }
    let mut bracket = Bracket::new([(stable, decay), (growing, rise)]);
    while bracket.width() > NEAR * (growing - stable).abs() {
        bracket.narrow(|value| growth(value).ok_or(())).ok()?;
    }
    Some(bracket.middle())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_value_at_which_growth_vanishes_is_found_from_either_side() {
        let growth = |value: f64| Some(value.powi(3) - 8.0);
        for ends in [[0.5, 7.0], [-3.0, 2.5]] {
            let found = critical(growth, ends).unwrap();
            assert!((found - 2.0).abs() < 1e-6, "{found}");
        }
        assert_eq!(critical(growth, [3.0, 4.0]), None);
        // Two modes that meet beside one that decays slowly: flat, a kink, and steep.
        let growth = |mu: f64| Some((7e3 * (mu - 0.16).max(0.0).sqrt() - 600.0).max(-55.0));
        let (found, exact) =
            (critical(growth, [0.02, 0.5]).unwrap(), 0.16 + (6.0_f64 / 70.0).powi(2));
        assert!((found - exact).abs() < 1e-7, "{found} {exact}");
    }

    #[test]
    fn both_ends_are_looked_at_before_what_lies_between() {
        let values: Vec<f64> = (0..=20).map(f64::from).collect();
        let found = candidates(&values, 17.0);
        assert_eq!(found[..3], [20.0, 0.0, 17.0]);
        assert_eq!(found.len(), LOOKED_AT);
        assert_eq!(candidates(&[2.0], 1.0), [2.0]);
    }
}
