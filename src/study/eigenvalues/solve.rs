//! Which eigenvalue solver runs, and what it has to say.

use super::model::{method_of, mode_limit};
use super::solid::{SolidBody, solid_model};
use super::states::solve_sparse;
use super::{Progress, SlidingModel, Solution, StudyError};
use crate::case::{Case, Cea, CeaMap, CeaMethod};
use crate::cea::cyclic::{self, Coverage, CyclicModel, Sensitivity, SolidModel, SolidSweep};
use crate::cea::{FrictionSweep, SweepRequest};
use crate::fem::RegionMaterial;
use crate::results::cea::{MapReport, SensitivityReport};
use crate::study::tangent_options;
use std::f64::consts::TAU;

/// Solves the case's eigenproblems with its method; `progress` hears of every friction value solved.
///
/// # Errors
/// Those of the solver.
pub fn solve(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    progress: &Progress<'_>,
) -> Result<Solution, StudyError> {
    solve_with(case, cea, model, (true, progress))
}

/// [`solve`] without the sensitivities.
///
/// # Errors
/// Those of the solver.
pub fn solve_modes(case: &Case, cea: &Cea, model: &SlidingModel) -> Result<Solution, StudyError> {
    solve_with(case, cea, model, (false, &|_| {}))
}

fn solve_with(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    (with_rates, progress): (bool, &Progress<'_>),
) -> Result<Solution, StudyError> {
    // Branches are known up to the largest friction coefficient of the sweep.
    let friction = case.contact.sliding.friction_coefficient;
    let frictions = cea.solved_friction_coefficients();
    let with_rates = with_rates && frictions.iter().any(|&mu| mu >= friction);
    let mut solution = match method_of(case, cea) {
        _ if case.solid.is_some() => solve_solid(case, cea, model, with_rates)?,
        CeaMethod::Sparse => solve_sparse(case, cea, model, progress)?,
        CeaMethod::Auto | CeaMethod::Cyclic => solve_cyclic(case, cea, model, with_rates)?,
    };
    solution
        .notes
        .extend(uncertainty_note(case, &solution.sweep));
    solution.notes.extend(damping_note(case, &solution.sweep));
    solution.notes.extend(friction_note(case, model));
    Ok(solution)
}

/// Relative uncertainty of an eigenvalue from which on the digits that are printed are in doubt.
const DOUBTFUL: f64 = 1e-8;

/// What an ill-conditioned model does to its eigenvalues.
fn uncertainty_note(case: &Case, sweep: &FrictionSweep) -> Option<String> {
    let modes = sweep.points.iter().flat_map(|point| &point.modes);
    let worst = modes.map(|mode| mode.uncertainty).fold(0.0, f64::max);
    if worst < DOUBTFUL {
        return None;
    }
    let penalty = case
        .contact
        .stiffness
        .normal_stiffness
        .map_or_else(String::new, |stiffness| {
            let size = stiffness * case.annulus.inner_radius / case.material.young_modulus;
            format!(
                "contact.normal_stiffness times geometry.inner_radius is {size:.1e} times \
             material.young_modulus (from 1e6 on leave it out: rigid contact); "
            )
        });
    Some(format!(
        "rounding of the matrices alone leaves eigenvalues uncertain by up to {worst:.0e} (relative): {penalty}\
         material.poisson_ratio is {}, contact.friction_coefficient {}, and where branches meet no digit is safe",
        case.material.poisson_ratio, case.contact.sliding.friction_coefficient,
    ))
}

/// What damping near the critical one hides.
fn damping_note(case: &Case, sweep: &FrictionSweep) -> Option<String> {
    let modes = || sweep.points.iter().flat_map(|point| &point.modes);
    let largest = modes()
        .map(|mode| mode.damping_factor())
        .fold(0.0, f64::max);
    let size = modes()
        .map(|mode| mode.eigenvalue.norm())
        .fold(0.0, f64::max);
    let at_limit = case
        .damping
        .rayleigh
        .damping_factor(size.max(f64::MIN_POSITIVE));
    if largest.max(at_limit) <= 0.5 {
        return None;
    }
    let (factor, cause) = match case.solid {
        Some(_) if at_limit <= 0.5 => (
            largest,
            "the dashpot of friction across the sliding, mu p / V, causes it, and grows as the sliding slows down",
        ),
        _ => (
            largest.max(at_limit),
            "damping.mass_coefficient and damping.stiffness_coefficient set it",
        ),
    };
    Some(format!(
        "a mode is damped by a factor of {factor:.2}: motions beyond critical damping (1) do not oscillate and are \
         not listed; {cause}"
    ))
}

/// The motions that friction across the sliding keeps from oscillating, and those that it damps.
fn overdamped_note(case: &Case, model: &SlidingModel, found: &SolidSweep) -> Option<String> {
    let most = found.overdamped.iter().max_by_key(|own| own.count);
    let (most, solid) = (most.filter(|own| own.count > 0)?, model.solid.as_ref()?);
    let [slowest, fastest] = most.decay;
    let friction = most.friction_coefficient;
    Some(format!(
        "at friction {friction} {} motions (each wave of a pair counted) decay without oscillating, at {slowest:.3e} to \
         {fastest:.3e} 1/s, and are not listed: the dashpot of friction across the sliding, mu p / V = {:.3e} Pa s/m at the mean \
         pressure and radius, overdamps them; it grows as contact.rotation_speed_rpm = {} falls, and holds that motion in the limit",
        most.count,
        solid.dashpot_across(friction),
        case.contact.sliding.rotation_speed * 60.0 / TAU,
    ))
}

/// What a friction law does at the speed of sliding.
fn friction_note(case: &Case, model: &SlidingModel) -> Option<String> {
    case.contact.sliding.decay?;
    let friction = case.contact.sliding.friction_coefficient;
    let (law, pressure) = match &model.solid {
        Some(solid) => solid.mean_friction(),
        None => {
            let pressures = model.base().pressures(friction);
            let mean = pressures.iter().sum::<f64>() / pressures.len().max(1) as f64;
            (model.base().friction, mean)
        }
    };
    Some(format!(
        "friction falls with speed: friction coefficients are those of high speed; in steady sliding friction is {:.4} \
         times as large, and at contact.friction_coefficient = {friction} its fall is a dashpot of {:.3e} Pa s/m on the \
         tangential motion of the edge (mean pressure {pressure:.3e} Pa)",
        law.drag.abs(),
        friction * pressure * law.slope,
    ))
}

fn solve_cyclic(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    with_rates: bool,
) -> Result<Solution, StudyError> {
    let friction_coefficients = cea.solved_friction_coefficients();
    let request = SweepRequest {
        friction_coefficients: &friction_coefficients,
        limit: mode_limit(cea),
        shapes_at: &cea.shapes_at,
    };
    let found = cyclic::sweep(
        &case.annulus,
        case.materials(),
        &model.options,
        &case.contact.sliding,
        &request,
    )?;
    let friction = case.contact.sliding.friction_coefficient;
    let sensitivities = match with_rates {
        true => Some(cyclic::sensitivities(&found, friction)?),
        false => None,
    };
    Ok(Solution {
        dofs: found.tangent.dimension() * found.tangent.sector().sector_count(),
        method: "cyclic",
        sensitivities: sensitivities.map(|branches| sensitivity_report(case, branches)),
        notes: vec![coverage_note(&found.coverage)],
        sweep: found.sweep,
    })
}

/// Sensitivities with the values that the case gives its parameters.
fn sensitivity_report(case: &Case, branches: Vec<Sensitivity>) -> SensitivityReport {
    let law = case.contact.sliding.decay;
    let shaft = case.annulus_materials.shaft;
    let of_shaft = shaft.map_or([0.0; 3], |RegionMaterial { elastic, .. }| {
        [
            elastic.young_modulus,
            elastic.poisson_ratio,
            elastic.density,
        ]
    });
    let own = shaft.and_then(|shaft| shaft.damping).unwrap_or_default();
    SensitivityReport {
        branches,
        values: [
            case.contact.stiffness.normal_stiffness.unwrap_or(0.0),
            case.damping.rayleigh.mass_coefficient,
            case.damping.rayleigh.stiffness_coefficient,
            case.material.young_modulus,
            case.material.poisson_ratio,
            case.material.density,
            law.map_or(1.0, |law| law.static_ratio),
            law.map_or(0.0, |law| law.decay_speed),
            of_shaft[0],
            of_shaft[1],
            of_shaft[2],
            own.mass_coefficient,
            own.stiffness_coefficient,
        ],
    }
}

fn solve_solid(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    with_rates: bool,
) -> Result<Solution, StudyError> {
    let friction_coefficients = cea.solved_friction_coefficients();
    let request = SweepRequest {
        friction_coefficients: &friction_coefficients,
        limit: mode_limit(cea),
        shapes_at: &cea.shapes_at,
    };
    let found = cyclic::solid_sweep(&solid_model(case, cea)?, &request)?;
    let coverage = &found.coverage;
    let mut notes = vec![format!(
        "harmonics {} hold modes at rest (by inertia counts, up to {} of {}) and were followed from {:.0} Hz downwards",
        ranges(&coverage.followed),
        coverage
            .counted_empty
            .last()
            .unwrap_or(&coverage.largest_harmonic),
        coverage.largest_harmonic,
        coverage.margin_hz,
    )];
    notes.push(format!(
        "each harmonic is solved in a small space (residuals are those there), which leaves out up to {:.1e} of an eigenvalue, \
         estimated at friction {}",
        found.reduction_error,
        friction_coefficients.iter().fold(0.0_f64, |m, &mu| m.max(mu)),
    ));
    notes.extend(overdamped_note(case, model, &found));
    notes.extend(model.solid.as_ref().and_then(SolidBody::note));
    let friction = case.contact.sliding.friction_coefficient;
    let sensitivities = match with_rates {
        true => Some(cyclic::solid_sensitivities(&found, friction)?),
        false => None,
    };
    if let Some(own) = &sensitivities {
        let there = found.branches.iter();
        let there = there.filter(|branch| branch.interpolate(friction).is_some());
        let left = there.count() - own.len();
        if left > 0 {
            notes.push(format!(
                "sensitivities.csv leaves {left} of the branches out, which could not be found again at friction {friction}"
            ));
        }
    }
    Ok(Solution {
        dofs: found.dofs,
        method: "cyclic",
        sensitivities: sensitivities.map(|branches| sensitivity_report(case, branches)),
        notes,
        sweep: found.sweep,
    })
}

/// The stability map that a case asks for: every value makes a case of its own, validated like any other.
///
/// # Errors
/// A value that makes no valid case.
pub fn map(case: &Case, cea: &Cea, map: &CeaMap) -> Result<MapReport, StudyError> {
    let largest_friction = cea
        .friction_coefficients
        .iter()
        .fold(0.0_f64, |m, &mu| m.max(mu));
    let report = |points| MapReport {
        key: map.key.clone(),
        largest_friction,
        points,
    };
    let point = |value: f64| -> Result<Case, StudyError> {
        let point = case
            .raw
            .with_overrides(&[format!("{}={value:?}", map.key)])?;
        Ok(Case::from_raw(point)?)
    };
    if case.solid.is_some() {
        let models: Result<Vec<(f64, SolidModel)>, StudyError> = map
            .values
            .iter()
            .map(|&value| Ok((value, solid_model(&point(value)?, cea)?)))
            .collect();
        let points = cyclic::solid_stability_map(&models?, mode_limit(cea), largest_friction);
        return Ok(report(points));
    }
    let models: Result<Vec<(f64, CyclicModel)>, StudyError> = map
        .values
        .iter()
        .map(|&value| {
            let point = point(value)?;
            let model = CyclicModel {
                specification: point.annulus,
                material: point.annulus_materials,
                options: tangent_options(&point, point.require_cea()?.mass),
                contact: point.contact.sliding,
            };
            Ok((value, model))
        })
        .collect();
    Ok(report(cyclic::stability_map(
        &models?,
        mode_limit(cea),
        largest_friction,
    )))
}

/// Which harmonics were solved, and why no other can hold a mode of the range.
fn coverage_note(coverage: &Coverage) -> String {
    let mut note = format!(
        "harmonics 0 to {}: {} hold modes and were followed from {:.0} Hz downwards",
        coverage.largest_harmonic,
        ranges(&coverage.followed),
        coverage.margin_hz,
    );
    for (harmonics, why) in [
        (&coverage.proven_empty, "are proven to hold none"),
        (
            &coverage.counted_empty,
            "hold none by count at quarters of the friction range",
        ),
    ] {
        if !harmonics.is_empty() {
            note += &format!("; {} {why}", ranges(harmonics));
        }
    }
    note + &format!(" below {:.0} Hz", coverage.limit_hz)
}

/// Rising numbers with neighbours drawn together: `0-4, 7`.
fn ranges(numbers: &[usize]) -> String {
    let mut groups: Vec<(usize, usize)> = Vec::new();
    for &number in numbers {
        match groups.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => groups.push((number, number)),
        }
    }
    let texts = groups.iter().map(|&(first, last)| {
        if first == last {
            first.to_string()
        } else {
            format!("{first}-{last}")
        }
    });
    texts.collect::<Vec<_>>().join(", ")
}
