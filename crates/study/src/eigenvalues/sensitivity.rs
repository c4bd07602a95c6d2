//! Derivatives of eigenvalues and critical friction of any body by the numbers of its case.

pub(super) mod rates;

use self::rates::{Linearized, Rates, rates_of, step_of};
use crate::*;
use frictionsim_physics::cea::ModeBranch;
use frictionsim_physics::cea::cyclic::{WavePair, wave_pairs};
use frictionsim_physics::cea::sparse::{ModePair, mode_pairs};
use frictionsim_results::cea::{OnsetRates, SensitivityReport, SensitivityRow};

/// Relative distance to which targets are eigenvalues: at an onset where growth jumps across zero there is none.
const FOUND: f64 = 1e-6;

/// A mode, or the onset of one: what is differentiated.
#[derive(Clone, Copy)]
struct Target {
    friction: f64,
    eigenvalue: c64,
}

/// The eigenpairs of targets, `None` where no single vector belongs to one.
enum Pairs {
    /// Of a body solved on its whole mesh, with the model at the friction coefficients of `places`.
    Whole(Box<Linearized>, Vec<Place>),
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

/// Derivatives of the listed eigenvalues at the case's own friction coefficient, and of the first critical friction
/// coefficient of their branches, by every number that the case gives its model.
///
/// ```text
/// d lambda / d p = - w^T (lambda^2 dM/dp + lambda dC/dp + dK/dp) x / w^T (2 lambda M + C) x
/// d mu_c / d p   = - Re(d lambda / d p) / Re(d lambda / d mu)
/// ```
///
/// with right and left vectors of the full problem, or of one harmonic of a body that has `waves`, and differences of
/// the assembled matrices, for which the case is read, its base state solved and its tangent taken with the parameter a
/// little larger and smaller: pressure, prestress and dashpots of friction follow. Where contact points open or close
/// within that step, or where modes coincide, there is no derivative: what is missing, and why, comes beside them.
///
/// Source: H. M. Adelman, R. T. Haftka, Sensitivity analysis of discrete structural systems, AIAA Journal 24 (1986),
/// section on the semi-analytical method.
pub fn body_sensitivities(
    case: &Case,
    cea: &Cea,
    sweep: &FrictionSweep,
    waves: Option<&WaveSweep>,
) -> Result<(SensitivityReport, Vec<String>), StudyError> {
    let friction = case.contact.sliding.friction_coefficient;

    // The targets: the modes at the own friction coefficient, then the onsets of those that have one.
    let modes = match waves {
        Some(waves) => waves_at(&waves.branches, sweep, friction),
        None => modes_at(sweep, friction, case.body.has_sectors()),
    };
    let own = modes.iter().map(|m| (Target { friction, eigenvalue: m.eigenvalue }, m.of));
    let onsets = modes.iter().filter_map(|mode| Some((mode.onset?, mode.of)));
    let (targets, branches): (Vec<Target>, Vec<_>) = own.chain(onsets).unzip();
    let pairs = match waves {
        Some(waves) => {
            let all = branches.into_iter().flatten().zip(&targets);
            let wanted: Vec<_> = all.map(|(branch, target)| (branch, target.friction)).collect();
            let pressed = waves.tangent.contact.is_pressed.clone();
            Pairs::Waves(wave_pairs(&waves.tangent, &wanted), pressed)
        }
        None => whole_pairs(case, cea, (modes.len(), &targets))?,
    };
    let found = pairs.each();

    // One parameter after the other, coefficients of damping of zero among them.
    let mut parameters = case.model_numbers();
    parameters.retain(|(key, value)| *value != 0.0 || step_of(key, 0.0) > 0.0);
    let rates: Vec<Rates> =
        parallel::map(&parameters, |(key, value)| rates_of(case, cea, &pairs, (key, *value)));
    let lost = targets.iter().zip(&found).filter(|(_, pair)| pair.is_none());
    let lost = lost.map(|(Target { friction, eigenvalue }, _)| {
        let hz = eigenvalue.im / TAU;
        format!("the mode at {hz:.1} Hz and friction {friction} coincides with another, jumps, or was not found again")
    });
    let mut missing: Vec<String> = lost.collect();
    missing.extend(rates.iter().filter_map(|(_, reason)| reason.clone()));
    let columns: Vec<_> = rates.into_iter().map(|(columns, _)| columns).collect();

    // Rows of the modes, with the onset of each branch.
    let mut of_onsets = modes.len()..;
    let rows = modes.iter().enumerate().filter_map(|(j, mode)| {
        let onset = mode.onset.and_then(|onset| Some((onset, of_onsets.next()?)));
        let (eigenvalue, by_friction) = found[j]?;
        let onset = onset.and_then(|(onset, at)| {
            let (_, rate) = found[at]?;
            let by = |column: &Vec<Option<c64>>| Some(-column[at]?.re / rate.re);
            Some(OnsetRates {
                critical_friction: onset.friction,
                derivatives: std::iter::once(None).chain(columns.iter().map(by)).collect(),
            })
        });
        let by_keys = columns.iter().map(|column| column[j]);
        Some(SensitivityRow {
            friction_coefficient: friction,
            harmonic: mode.diameters,
            branch: mode.branch,
            direction: case.body.has_sectors().then_some(mode.direction),
            eigenvalue,
            derivatives: std::iter::once(Some(by_friction)).chain(by_keys).collect(),
            onset,
        })
    });
    let rows = rows.collect();
    let own = ("friction_coefficient".to_owned(), friction);
    // Two losses, of body and contact, keep their sections.
    let is_twice = |key: &str| {
        parameters.iter().filter(|(other, _)| short_name(other) == short_name(key)).count() > 1
    };
    let others = parameters.iter().map(|(key, value)| {
        let name = if is_twice(key) { key } else { short_name(key) };
        (name.to_owned(), *value)
    });
    let parameters = std::iter::once(own).chain(others).collect();
    Ok((SensitivityReport { parameters, rows }, missing))
}

/// A mode at the case's own friction coefficient.
struct Listed<'a> {
    /// See [`frictionsim_physics::cea::ComplexMode::diameters`].
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
    let first = intervals.next().filter(|first| first.is_located())?;
    Some(Target {
        friction: first.critical_friction,
        eigenvalue: c64::new(0.0, TAU * first.frequency_hz),
    })
}

/// The branches of waves that have a mode in the list at a friction coefficient.
fn waves_at<'a>(
    branches: &'a [ModeBranch],
    sweep: &FrictionSweep,
    friction: f64,
) -> Vec<Listed<'a>> {
    let modes = sweep.modes_at(friction);
    let listed = branches.iter().filter(|own| modes.iter().any(|mode| own.has(mode)));
    let there = listed.filter_map(|branch| Some((branch, branch.interpolate(friction)?)));
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
    let listed = sweep.modes_at(friction).iter().map(|mode: &ComplexMode| {
        let own = |interval: &&UnstableInterval| interval.is_of(mode);
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
        let is_found = |p: &ModePair| base.shift(k, p).norm() <= FOUND * p.eigenvalue.norm();
        let pairs = mode_pairs(base.tangent(k), place.friction, &place.targets).into_iter();
        place.pairs = pairs.map(|pair| pair.filter(is_found)).collect();
    }
    Ok(Pairs::Whole(Box::new(base), places))
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

/// Keys of the sections that every case has, without the section.
fn short_name(key: &str) -> &str {
    let sections = ["material.", "damping.", "contact."];
    sections.iter().find_map(|section| key.strip_prefix(section)).unwrap_or(key)
}
