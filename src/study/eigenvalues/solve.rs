//! Solution of the eigenvalue analysis of a case, and the notes on its results.

use super::model::{Model, Solver, mode_limit};
use super::reading::{read, shapes_needed};
use super::sensitivity::body_sensitivities;
use super::sliding::SteadyState;
use super::solid::SolidBody;
use super::{Progress, SlidingModel, Solution, StudyError};
use crate::case::{Body, Case, Cea, CeaMethod};
use crate::cea::cyclic::{Coverage, Overdamped, Sensitivity};
use crate::cea::{CeaError, FrictionSweep, SweepRequest, Unwatched};
use crate::contact::NormalLaw;
use crate::fem::RegionMaterial;
use crate::results::cea::SensitivityReport;
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
    solve_with(case, cea, model, (false, &Unwatched))
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
    let with_reading = with_rates;
    let with_rates = with_rates
        && cea.sensitivities != Some(false)
        && frictions.iter().any(|&mu| mu >= friction);
    let waves_at: &[f64] = if with_reading { &frictions } else { &[] };
    let shapes_at = |of: &Model| {
        let modes = case.cost().cea.map_or(0, |cost| cost.modes) as f64;
        let needed = with_reading.then(|| shapes_needed(case, of, &frictions, modes));
        [cea.shapes_at.as_slice(), &needed.unwrap_or_default()].concat()
    };
    let solve = |of: &Model| {
        let request = SweepRequest {
            friction_coefficients: &frictions,
            limit: mode_limit(cea),
            shapes_at: &shapes_at(of),
        };
        of.spectrum_with_waves(case, (&request, waves_at), with_rates, progress)
    };
    let solved = solve(&model.model);
    let (mut found, method, instead) = match solved {
        Ok(found) => (found, model.model.method(), None),
        Err(error) => {
            let whole = whole_mesh_instead(case, cea, model, &error)?;
            let whole = whole.ok_or_else(|| at_table(case, &error))?;
            let found = solve(&whole)?;
            (found, whole.method(), Some(instead_note(&error)))
        }
    };
    let is_asked = with_rates && cea.sensitivities == Some(true);
    let (of_body, rate_note) = match is_asked && method == "sparse" {
        true => body_rates(case, cea, &found.sweep),
        false => (None, None),
    };

    let mut notes: Vec<String> = found
        .coverage
        .iter()
        .map(|c| coverage_note(&model.model, c))
        .collect();
    notes.extend(instead);
    notes.extend(found.notes);
    notes.extend(overdamped_note(case, model, &found.overdamped));
    notes.extend(model.solid().and_then(SolidBody::note));
    notes.extend(table_notes(case));
    if found.without_sensitivities > 0 {
        notes.push(format!(
            "sensitivities.csv leaves {} of the branches out, which could not be found again at friction {friction}",
            found.without_sensitivities
        ));
    }
    notes.extend(rate_note);
    notes.extend(uncertainty_note(case, &found.sweep));
    notes.extend(damping_note(case, &found.sweep));
    notes.extend(vanished_note(&found.sweep));
    notes.extend(friction_note(case, model));
    let reading = match with_reading {
        true => read(case, model, found.tangent.as_ref(), &found.sweep),
        false => None,
    };
    // Shapes and waves that only the reading needed.
    for point in &mut found.sweep.points {
        point.modes.iter_mut().for_each(|mode| mode.wave = None);
        if !cea.shapes_at.contains(&point.friction_coefficient) {
            point.modes.iter_mut().for_each(|mode| mode.shape = None);
        }
    }
    let sensitivities = found.sensitivities;
    Ok(Solution {
        reading,
        dofs: found.dofs,
        method,
        sensitivities: match of_body {
            Some(of_body) => Some(of_body),
            None => sensitivities.map(|branches| sensitivity_report(case, branches)),
        },
        notes,
        sweep: found.sweep,
    })
}

/// Sensitivities of a body solved on its whole mesh; why there are none, or what is missing of them.
fn body_rates(
    case: &Case,
    cea: &Cea,
    sweep: &FrictionSweep,
) -> (Option<SensitivityReport>, Option<String>) {
    let friction = case.contact.sliding.friction_coefficient;
    let mut points = sweep.points.iter();
    if !points.any(|p| p.friction_coefficient == friction && !p.modes.is_empty()) {
        let note = format!(
            "no sensitivities: there are no modes at contact.friction_coefficient = {friction}; name it in \
             cea.friction_coefficients"
        );
        return (None, Some(note));
    }
    match body_sensitivities(case, cea, sweep) {
        Ok(found) => {
            let missing = found.missing.iter().take(MISSING_SHOWN).cloned();
            let mut missing: Vec<String> = missing.collect();
            if found.missing.len() > MISSING_SHOWN {
                missing.push("...".to_owned());
            }
            let note = format!("sensitivities.csv has gaps: {}", missing.join("; "));
            let has_gaps = !found.missing.is_empty();
            (Some(found.report), has_gaps.then_some(note))
        }
        // The spectrum is there all the same.
        Err(error) => {
            let why = error.messages().join("; ");
            (None, Some(format!("no sensitivities: {why}")))
        }
    }
}

/// Gaps of the sensitivities that a note lists.
const MISSING_SHOWN: usize = 4;

/// An error about a table of moduli at the key that names it; any other as it is.
fn at_table(case: &Case, error: &CeaError) -> StudyError {
    let help = "extend the table, or lower cea.max_frequency_hz or cea.modes";
    match error {
        CeaError::BeyondTable { key, .. } => {
            let label = "does not cover the modes".to_owned();
            let help = Some(help.to_owned());
            case.error_at(key, error.to_string(), label, help).into()
        }
        other => other.clone().into(),
    }
}

/// What the tables of moduli give to which part of the analysis.
fn table_notes(case: &Case) -> Vec<String> {
    let regions = 0..case.body.region_count();
    let tables = regions.filter_map(|region| case.materials().table(region));
    let notes = tables.map(|table| {
        let [low, high] = table.range_hz();
        format!(
            "{} = \"{}\": each mode is solved at its own frequency (Im / 2 pi), {low} to {high} Hz; the base state, and what \
             damping.stiffness_coefficient multiplies, have the modulus of the lowest one, {:e} Pa",
            table.key(),
            table.file(),
            table.static_modulus()
        )
    });
    notes.collect()
}

fn instead_note(error: &CeaError) -> String {
    let why = match error {
        CeaError::LostHarmonic { harmonic, friction } => {
            format!(
                "a branch of harmonic {harmonic} could not be followed up to friction {friction}"
            )
        }
        CeaError::Unproven { harmonic, .. } => {
            format!("harmonic {harmonic} may hold further modes")
        }
        other => other.to_string(),
    };
    format!("{why}: the whole mesh was solved instead, as with cea.method = \"sparse\"")
}

/// The whole mesh of a plane annulus, where `auto` chose its harmonics and a branch of them could not be followed.
///
/// # Errors
/// No state of steady sliding.
fn whole_mesh_instead(
    case: &Case,
    cea: &Cea,
    model: &SlidingModel,
    error: &CeaError,
) -> Result<Option<Model>, CeaError> {
    let is_lost = matches!(
        error,
        CeaError::LostHarmonic { .. } | CeaError::Unproven { .. }
    );
    match &model.model {
        Model::Sectors(_, options) if is_lost && cea.method == CeaMethod::Auto => {
            let frictions = cea.solved_friction_coefficients();
            Model::with_solver(case, Solver::WholeMesh, *options, &frictions).map(Some)
        }
        _ => Ok(None),
    }
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
            let size = stiffness * case.body.contact_length() / case.material.young_modulus;
            let length = match &case.body {
                Body::Imported(_) | Body::Assembly(_) => "the size of the contact",
                Body::Annulus(_) | Body::Revolution(_) => "geometry.inner_radius",
            };
            format!(
                "contact.normal_stiffness times {length} is {size:.1e} times \
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
    let (factor, cause) = match case.body {
        Body::Revolution(_) if at_limit <= 0.5 => (
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

/// The modes of a whole mesh that friction across slow sliding damps beyond the critical.
fn vanished_note(sweep: &FrictionSweep) -> Option<String> {
    let all = sweep.vanished.iter().map(|mode| {
        let (frequency, friction) = (mode.frequency_hz, mode.friction_coefficient);
        format!("{frequency:.0} Hz from friction {friction} on")
    });
    let all: Vec<String> = all.collect();
    let (shown, rest) = all.split_at(all.len().min(MISSING_SHOWN));
    let more = if rest.is_empty() { "" } else { ", ..." };
    (!all.is_empty()).then(|| {
        format!(
            "{} modes near critical damping are not followed beyond it ({}{more}): friction across the sliding is a dashpot of mu p / V, which \
             grows as the sliding slows down, and holds that motion in the limit",
            all.len(),
            shown.join(", "),
        )
    })
}

/// The motions that friction across the sliding keeps from oscillating, and those that it damps.
fn overdamped_note(case: &Case, model: &SlidingModel, overdamped: &[Overdamped]) -> Option<String> {
    let most = overdamped.iter().max_by_key(|own| own.count);
    let (most, solid) = (most.filter(|own| own.count > 0)?, model.solid()?);
    let [slowest, fastest] = most.decay;
    let friction = most.friction_coefficient;
    Some(format!(
        "at friction {friction} {} motions (each wave of a pair counted) decay without oscillating, at {slowest:.3e} to \
         {fastest:.3e} 1/s, and are not listed: the dashpot of friction across the sliding, mu p / V = {:.3e} Pa s/m at the mean \
         pressure and radius, overdamps them; it grows as contact.rotation_speed_rpm = {} falls, and holds that motion in the limit",
        most.count,
        solid.dashpot_across(friction),
        case.number("contact.rotation_speed_rpm")
            .unwrap_or(case.contact.sliding.rotation_speed * 60.0 / TAU),
    ))
}

/// What a friction law does at the speed of sliding.
fn friction_note(case: &Case, model: &SlidingModel) -> Option<String> {
    case.contact.sliding.decay?;
    let friction = case.contact.sliding.friction_coefficient;
    let (law, pressure) = match &model.state {
        SteadyState::Solid(solid) => solid.mean_friction(),
        // Each contact has its own.
        SteadyState::Assembly(_) => return None,
        SteadyState::Plane(base) => {
            let pressures = base.pressures(friction);
            let mean = pressures.iter().sum::<f64>() / pressures.len().max(1) as f64;
            (base.friction, mean)
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

/// Sensitivities with the values that the case gives its parameters.
fn sensitivity_report(case: &Case, branches: Vec<Sensitivity>) -> SensitivityReport {
    let law = case.contact.sliding.decay;
    let annulus = case.body.annulus();
    let shaft = annulus.and_then(|annulus| annulus.materials.shaft);
    let of_shaft = shaft.map_or([0.0; 3], |RegionMaterial { elastic, .. }| {
        [
            elastic.young_modulus,
            elastic.poisson_ratio,
            elastic.density,
        ]
    });
    let own = shaft.and_then(|shaft| shaft.damping).unwrap_or_default();
    let of_law = match case.contact.stiffness.law {
        Some(NormalLaw::Cubic {
            cubic_stiffness, ..
        }) => [cubic_stiffness, 0.0, 0.0],
        Some(NormalLaw::Exponential {
            reference_pressure,
            height,
        }) => [0.0, reference_pressure, height],
        None => [0.0; 3],
    };
    SensitivityReport::of_harmonics(
        &branches,
        [
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
            of_law[0],
            of_law[1],
            of_law[2],
        ],
    )
}

/// Which harmonics were solved, and why no other can hold a mode of the range.
fn coverage_note(model: &Model, coverage: &Coverage) -> String {
    match model {
        Model::SolidSectors(_) => format!(
            "harmonics {} hold modes at rest (by inertia counts, up to {} of {}) and were followed from {:.0} Hz downwards",
            ranges(&coverage.followed),
            coverage
                .counted_empty
                .last()
                .unwrap_or(&coverage.largest_harmonic),
            coverage.largest_harmonic,
            coverage.margin_hz,
        ),
        Model::Sectors(..) | Model::Whole(_) | Model::Assembly(_) => proof_note(coverage),
    }
}

fn proof_note(coverage: &Coverage) -> String {
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
