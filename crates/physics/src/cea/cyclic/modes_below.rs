//! The harmonics with modes at rest in a range of frequency, complete by inertia counts.

use crate::cea::cyclic::*;
use crate::prestress::PrestressError;

/// Harmonics without a mode in a row after which only some of the higher ones are counted: short waves around are stiff.
const EMPTY: usize = 3;

/// Harmonics solved side by side.
const BATCH: usize = 4;

/// Modes of one harmonic without friction.
pub(super) struct AtRest {
    pub harmonic: usize,
    pub pencil: Pencil,
    pub modes: Modes,
}

fn pencil(tangent: &WaveTangent, n: usize) -> Result<Pencil, CeaError> {
    let [mass, stiffness] = tangent.at_rest(n);
    Pencil::new(mass, stiffness).ok_or(CeaError::Prestress(PrestressError::Singular))
}

/// A bound of `kappa` at rest of the modes wanted, from above.
pub(super) fn bound(tangent: &WaveTangent, limit: ModeLimit) -> Result<f64, CeaError> {
    let asked = match limit {
        ModeLimit::MaxFrequency(value) => return Ok((TAU * value).powi(2)),
        ModeLimit::Lowest(asked) => asked,
    };
    let largest = tangent.largest_harmonic();
    let mut few = largest.min(BATCH - 1);
    loop {
        // Each harmonic has two waves of each mode: so many of each are enough to begin with.
        let count = asked.div_ceil(2 * few.max(1)) + 1;
        let found: Result<Vec<Vec<f64>>, CeaError> = crate::parallel::map(0..=few, |n| {
            Ok(of_all_waves(tangent, n, &pencil(tangent, n)?.lowest(count)))
        });
        match just_above(asked, found?.concat()) {
            Err(_) if few < largest => few = (2 * few).min(largest), // Of few unknowns many harmonics are needed.
            found => return found,
        }
    }
}

/// `kappa` at rest up to which the modes wanted lie.
pub(super) fn wanted(
    tangent: &WaveTangent,
    found: &[AtRest],
    limit: ModeLimit,
    bound: f64,
) -> Result<f64, CeaError> {
    let ModeLimit::Lowest(asked) = limit else { return Ok(bound) };
    let all = found.iter().flat_map(|found| of_all_waves(tangent, found.harmonic, &found.modes));
    just_above(asked, all.collect())
}

/// `kappa` of the modes of harmonic `n`, of each wave once.
fn of_all_waves(tangent: &WaveTangent, n: usize, modes: &Modes) -> Vec<f64> {
    let waves = if tangent.is_standing(n) { 1 } else { 2 };
    modes.iter().flat_map(|mode| vec![mode.0; waves]).collect()
}

/// A little more than the lowest `kappa` but `asked - 1`.
fn just_above(asked: usize, mut kappas: Vec<f64>) -> Result<f64, CeaError> {
    kappas.sort_by(f64::total_cmp);
    let total = kappas.len();
    let highest = kappas.get(asked - 1).map(|kappa| kappa * (1.0 + RESIDUAL_BOUND)); // So that this one lies below it, too.
    highest.ok_or_else(|| CeaError::too_many_modes(asked, total))
}

/// The modes below `kappa` of harmonic `n` at rest; `None` where it has none.
pub(super) fn at_rest(
    tangent: &WaveTangent,
    n: usize,
    kappa: f64,
) -> Result<Option<AtRest>, CeaError> {
    let pencil = pencil(tangent, n)?;
    let counted = pencil.count_below(kappa);
    if counted == 0 {
        return Ok(None);
    }
    let modes = pencil.lowest(counted);
    let found = modes.iter().filter(|mode| mode.0 < kappa).count(); // Counted by inertia, found by iteration: two ways.
    match found == counted {
        true => Ok(Some(AtRest { harmonic: n, pencil, modes })),
        false => Err(CeaError::Harmonic(format!(
            "harmonic {n} has {counted} modes below the limit by inertia but {found} were found; \
             use cea.method = \"sparse\""
        ))),
    }
}

/// The harmonics that have modes below `kappa` at rest with these modes, and those counted empty.
pub(super) fn modes_below(
    tangent: &WaveTangent,
    kappa: f64,
) -> Result<(Vec<AtRest>, Vec<usize>), CeaError> {
    let largest = tangent.largest_harmonic();
    let (mut all, mut empty) = (Vec::new(), Vec::new());
    let (mut n, mut in_a_row, mut step) = (0, 0, 1);
    while n <= largest {
        let last = if step == 1 { (n + BATCH - 1).min(largest) } else { n }; // Several harmonics side by side.
        let found: Result<Vec<Option<AtRest>>, CeaError> =
            crate::parallel::map(n..=last, |n| at_rest(tangent, n, kappa));
        for (n, found) in (n..=last).zip(found?) {
            // After some empty ones in a row only samples of the rest.
            in_a_row = if found.is_some() { 0 } else { in_a_row + 1 };
            if found.is_none() {
                empty.push(n);
            }
            all.extend(found);
        }
        step = if in_a_row >= EMPTY { 1 + last / 2 } else { 1 };
        n = if last < largest { (last + step).min(largest) } else { last + 1 };
    }
    Ok((all, empty))
}
