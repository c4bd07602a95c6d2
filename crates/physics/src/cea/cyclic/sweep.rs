//! A sweep over the friction coefficient.

use super::completeness::verify;
use super::found::{Found, WaveSweep};
use super::modes::points;
use super::modes_below::{self, at_rest, modes_below};
use super::paths::{Range, follow_pairs};
use super::reduced;
use crate::cea::cyclic::*;
use crate::contact::SlidingContact;
use crate::fem::{MaterialField, ModulusTable};
use crate::mesh::{AnnulusSpecification, Strip};
use crate::prestress::TangentOptions;

/// Branches are followed from this much above the highest frequency wanted: friction may carry a mode down into the range.
const MARGIN: f64 = 1.2;

/// Eigenvalues of steady sliding of a plane annulus over a range of friction coefficients.
///
/// # Errors
/// [`CeaError`] where there is no sliding equilibrium, or a branch cannot be followed.
pub fn sweep(
    specification: &AnnulusSpecification,
    material: &dyn MaterialField,
    options: &TangentOptions,
    contact: &SlidingContact,
    request: &SweepRequest<'_>,
) -> Result<WaveSweep, CeaError> {
    let sector = Strip::of_annulus(specification)?;
    let tangent = WaveTangent::of_annulus(&sector, material, options, contact)?;
    wave_sweep(tangent, request, &[])
}

/// Eigenvalues of small motions over a range of friction coefficients, with the waves of one sector at those of `waves_at`.
///
/// Every branch is followed from `mu = 0` to the largest friction coefficient given. Without friction the modes are complete by
/// inertia counts; of a plane body of viscous damping it is proven, too, that friction brings no others.
///
/// # Errors
/// [`CeaError`] where a branch cannot be followed.
pub fn wave_sweep(
    mut tangent: WaveTangent,
    request: &SweepRequest<'_>,
    waves_at: &[f64],
) -> Result<WaveSweep, CeaError> {
    let wanted = Wanted::new(request, waves_at)?;
    // What depends on frequency by a table is no analytic function of the eigenvalue.
    let is_direct = is_direct(&tangent);
    let is_verified = is_direct || request.count_modes && tangent.tables().next().is_none();
    // Where modes stop to oscillate, others from above the margin are among the lowest.
    let (mut margin, mut found) = (MARGIN, follow(&mut tangent, &wanted, MARGIN, None)?);
    for _ in 0..MOST_ATTEMPTS {
        if found.0.is_short_of(request.limit) {
            margin *= MARGIN;
            found = follow(&mut tangent, &wanted, margin, None)?;
        }
    }
    let (found, counted) = found;
    let empty = match is_verified {
        true => verify(&tangent, &found.followed, found.limit, &wanted.grid)
            .map_err(|harmonic| CeaError::Unproven { harmonic, margin })?,
        false => [Vec::new(), counted],
    };
    Ok(found.sweep(tangent, &wanted.grid, empty, is_verified))
}

/// A sweep over some harmonics, without a proof that no mode is missed: for the many samples of a model for some of which a
/// whole one has said which harmonics hold modes. `None` of a body whose harmonics are reduced first.
///
/// # Errors
/// As [`wave_sweep`].
pub fn onsets(
    mut tangent: WaveTangent,
    request: &SweepRequest<'_>,
    harmonics: &[usize],
) -> Result<Option<FrictionSweep>, CeaError> {
    if !is_direct(&tangent) {
        return Ok(None);
    }
    let wanted = Wanted::new(request, &[])?;
    let (found, _) = follow(&mut tangent, &wanted, MARGIN, Some(harmonics))?;
    Ok(Some(found.sweep(tangent, &wanted.grid, [Vec::new(), Vec::new()], false).sweep))
}

/// Whether harmonics are followed as they stand: their bands are narrow, and the waves `+n` and `-n` are of one real problem.
fn is_direct(tangent: &WaveTangent) -> bool {
    tangent.components == 2 && !tangent.terms.is_lossy()
}

/// The branches of all harmonics, or of those given, up to a `margin` above the highest frequency wanted; and the harmonics that are
/// counted empty at rest.
fn follow(
    tangent: &mut WaveTangent,
    asked: &Wanted<'_>,
    margin: f64,
    harmonics: Option<&[usize]>,
) -> Result<(Found, Vec<usize>), CeaError> {
    let (limit, is_direct) = (asked.request.limit, is_direct(tangent));
    let is_tabled = tangent.tables().next().is_some();
    let bound = match is_tabled {
        true => {
            let stiffest = tangent.referred_to(ModulusTable::stiffest_hz);
            let bound = modes_below::bound(&stiffest, limit)?;
            // As many modes lie below a frequency as with the moduli of that frequency, as long as these rise less than its square.
            let highest = bound.sqrt() * MARGIN / TAU;
            *tangent = tangent.referred_to(|_| highest);
            bound
        }
        false => modes_below::bound(tangent, limit)?,
    };

    let span = if is_direct { 1.0 } else { reduced::SPAN }; // Modes at rest, and what of them is wanted.
    let kappa = bound * (margin * span).powi(2); // kappa goes with the square of the frequency.
    let (mut found, counted) = match (harmonics, limit) {
        (Some(own), ModeLimit::MaxFrequency(_)) => {
            let found: Result<Vec<_>, CeaError> =
                crate::parallel::map(own, |&n| at_rest(tangent, n, kappa));
            (found?.into_iter().flatten().collect(), Vec::new())
        }
        _ => modes_below(tangent, kappa)?,
    };
    let wanted =
        if is_tabled { bound } else { modes_below::wanted(tangent, &found, limit, bound)? };
    let margin = wanted * margin * margin;
    found.retain(|found| found.modes.iter().any(|mode| mode.0 < margin));

    let range = Range { grid: &asked.grid, kept: &asked.kept(), wanted, margin }; // Each harmonic by itself.
    let followed: Result<Vec<HarmonicPaths>, CeaError> =
        crate::parallel::map(found, |mut found| {
            if !is_direct {
                return reduced::follow(tangent, found, &range);
            }
            found.modes.retain(|(kappa, _)| *kappa < margin);
            let problem = HarmonicProblem::new(tangent.harmonic(found.harmonic), true);
            follow_pairs(problem, &found.modes, &range)
        });
    let followed = followed?;
    let points = points(tangent, &followed, asked);
    check_tables(tangent, &points)?;
    let highest = points.iter().filter_map(|point| point.modes.last());
    let limit = match limit {
        ModeLimit::Lowest(_) if is_direct => {
            highest.fold(0.0_f64, |top, mode| top.max(mode.eigenvalue.im))
        }
        _ => wanted.sqrt(), // kappa = omega^2.
    };
    Ok((Found { followed, points, limit, margin: margin.sqrt() }, counted))
}

/// Refuses modes whose stiffness follows from a table that does not reach them.
fn check_tables(tangent: &WaveTangent, points: &[FrictionPoint]) -> Result<(), CeaError> {
    for (point, mode) in points.iter().flat_map(|p| p.modes.iter().map(move |mode| (p, mode))) {
        let frequency_hz = mode.frequency_hz();
        if let Some(own) = tangent.tables().find(|own| !own.table.covers(frequency_hz)) {
            let mu = point.friction_coefficient;
            return Err(CeaError::beyond_table(&own.table, mu, frequency_hz));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::ContactStiffness;
    use crate::fem::{ElasticMaterial, MassKind, RayleighDamping};
    use crate::mesh::{BoundaryCondition, ElementKind};
    use crate::prestress::DampingModel;

    /// With structural damping, and with dashpots alone, branches of either direction.
    #[test]
    fn a_branch_that_is_left_out_is_missed() {
        let specification = AnnulusSpecification {
            inner_radius: 0.0205,
            outer_radius: 0.0905,
            circumferential_elements: 16,
            radial_elements: 4,
            radial_grading: 1.0,
            element: ElementKind::Quad4,
            outer: BoundaryCondition::Clamped,
            shaft: None,
        };
        let contact = SlidingContact {
            friction_coefficient: 0.3,
            decay: None,
            interference: 25e-6,
            rotation_speed: 63.9,
        };
        let grid = [0.0, 0.3];
        let request = SweepRequest::new(&grid, ModeLimit::MaxFrequency(12e3));
        let wanted = Wanted::new(&request, &[]).unwrap();
        for [loss_factor, tangential_damping] in [[0.05, 0.0], [0.0, 2e3]] {
            let material = ElasticMaterial {
                young_modulus: 2.5e9,
                poisson_ratio: 0.38,
                density: 1228.0,
                loss_factor,
                ..ElasticMaterial::PLAIN
            };
            let options = TangentOptions {
                mass: MassKind::Consistent,
                geometric_stiffness: true,
                damping: RayleighDamping { mass_coefficient: 40.0, stiffness_coefficient: 4.5e-7 },
                damping_model: DampingModel::WholeTangent,
                contact: ContactStiffness { tangential_damping, ..ContactStiffness::default() },
            };
            let sector = Strip::of_annulus(&specification).unwrap();
            let tangent = WaveTangent::of_annulus(&sector, &material, &options, &contact);
            let mut tangent = tangent.unwrap();
            let (found, _) = follow(&mut tangent, &wanted, MARGIN, None).unwrap();
            let (mut followed, limit) = (found.followed, found.limit);
            let missed =
                |followed: &[HarmonicPaths]| verify(&tangent, followed, limit, &grid).err();
            assert_eq!(missed(&followed), None);
            let mut directions = [0; 2];
            for h in 0..followed.len() {
                for p in 0..followed[h].paths.len() {
                    let path = followed[h].paths.remove(p);
                    let end = path.points.last().unwrap().theta;
                    let is_within = end.im.abs() < limit;
                    let harmonic = followed[h].problem.tangent.harmonic;
                    assert_eq!(missed(&followed), is_within.then_some(harmonic), "{end}");
                    directions[usize::from(end.im < 0.0)] += usize::from(is_within);
                    followed[h].paths.insert(p, path);
                }
            }
            assert!(directions.iter().all(|count| *count >= 3), "{directions:?}");
        }
    }
}
