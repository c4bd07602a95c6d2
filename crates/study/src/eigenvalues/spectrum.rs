//! The spectrum of a case for those who study it: no files, no base fields, no shapes.

use super::model::{Model, Solver, wave_tangent};
use crate::*;
use frictionsim_physics::cea::cyclic;

/// What `[cea]` says of a case, or its defaults, for these friction coefficients and modes up to a frequency.
pub(crate) fn analysis(case: &Case, frictions: &[f64], limit_hz: f64) -> Cea {
    let modes = ModeLimit::MaxFrequency(limit_hz);
    let friction_coefficients = frictions.to_vec();
    match &case.cea {
        Some(cea) => Cea { friction_coefficients, modes, count_modes: false, ..cea.of_tables() },
        None => Cea {
            friction_coefficients,
            modes,
            method: CeaMethod::Auto,
            mass: MassKind::Consistent,
            geometric_stiffness: case.has_geometric_stiffness(),
            shapes_at: Vec::new(),
            own_friction: None,
            sensitivities: None,
            count_modes: false,
        },
    }
}

/// The modes of a case below `limit_hz` at its own friction coefficient.
pub fn modes_below(case: &Case, limit_hz: f64) -> Result<Vec<ComplexMode>, StudyError> {
    Ok(modes_with_waves_below(case, limit_hz, &[])?.0)
}

/// [`modes_below`] with the branches of a body solved harmonic by harmonic, and with the shapes of the modes where
/// `shapes_at` holds the case's own friction coefficient.
pub fn modes_with_waves_below(
    case: &Case,
    limit_hz: f64,
    shapes_at: &[f64],
) -> Result<(Vec<ComplexMode>, Option<WaveSweep>), StudyError> {
    let friction = case.contact.sliding.friction_coefficient;
    let cea = analysis(case, &[friction], limit_hz);
    let model = Model::new(case, &cea)?;
    let request =
        SweepRequest { shapes_at, ..SweepRequest::new(&cea.friction_coefficients, cea.modes) };
    let (found, waves) = model.spectrum_with_waves(case, (&request, &[]), &Unwatched)?;
    Ok((found.sweep.into_first_modes(), waves))
}

/// The modes of a case at its own friction coefficient, by frequency; no shapes. With all the body's symmetry.
pub fn modes_at_own_friction(
    case: &Case,
    options: &TangentOptions,
    limit: ModeLimit,
) -> Result<Vec<ComplexMode>, CeaError> {
    let frictions = [case.contact.sliding.friction_coefficient];
    let request = SweepRequest::new(&frictions, limit);
    let solver = if case.body.has_sectors() { Solver::Waves } else { Solver::WholeMesh };
    let model = Model::with_solver(case, solver, *options, &frictions)?;
    Ok(model.spectrum(case, &request)?.sweep.into_first_modes())
}

/// The onsets of a case.
#[derive(Default)]
pub struct OnsetSearch {
    /// The ranges of friction over which branches are unstable.
    pub intervals: Vec<UnstableInterval>,
    /// The harmonics that hold modes, where all were looked at.
    pub followed: Vec<usize>,
    /// Harmonic and branch of modes within the range of frequencies at some friction coefficient, each once, rising.
    pub within: Vec<(usize, usize)>,
}

impl OnsetSearch {
    fn of(sweep: FrictionSweep, followed: Vec<usize>) -> Self {
        let modes = sweep.points.iter().flat_map(|point| &point.modes);
        let name = |m: &ComplexMode| (m.nodal_diameters.unwrap_or(m.harmonic), m.branch);
        let within: BTreeSet<(usize, usize)> = modes.map(name).collect();
        Self { followed, within: within.into_iter().collect(), intervals: sweep.intervals }
    }
}

/// The ranges of friction over which branches of a case are unstable, from 0 to the largest of `frictions`.
///
/// With `harmonics` those alone are looked at, without a proof that none is missed.
///
/// # Errors
/// Those of the solver; a frequency limit below the first mode.
pub fn unstable_intervals(
    case: &Case,
    frictions: &[f64],
    harmonics: Option<&[usize]>,
) -> Result<OnsetSearch, StudyError> {
    let own = case.require_cea()?;
    let cea = Cea { modes: own.modes, ..analysis(case, frictions, f64::INFINITY) };
    let solver = Solver::of(case, cea.method)?;
    let mut frictions = frictions.to_vec();
    if solver == Solver::WholeMesh {
        // Harmonics are followed from no friction on; the branches of a whole mesh over the values that it is given.
        frictions.push(0.0);
        frictions.extend(&own.friction_coefficients);
        frictions.sort_by(f64::total_cmp);
        frictions.dedup();
    }
    let request = SweepRequest::new(&frictions, cea.modes);
    let options = tangent_options(case, cea.mass);
    let model = Model::with_solver(case, solver, options, &frictions)?;
    if let (Some(harmonics), Model::Waves(options)) = (harmonics, &model)
        && let Ok(Some(tangent)) = wave_tangent(case, options)
        && let Ok(Some(found)) = cyclic::onsets(tangent, &request, harmonics)
    {
        return Ok(OnsetSearch::of(found, Vec::new()));
    }
    let (found, waves) = model.spectrum_with_waves(case, (&request, &[]), &Unwatched)?;
    super::refuse_no_modes(case, &cea, &found.sweep)?;
    let waves = waves.filter(|_| case.body.dimension() == 2);
    let followed = waves.map(|waves| waves.coverage.followed);
    Ok(OnsetSearch::of(found.sweep, followed.unwrap_or_default()))
}
