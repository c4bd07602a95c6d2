//! Steady sliding at one operating point, and where along a parameter it loses its stability.

use super::super::operating_point;
use crate::case::{Body, Case};
use crate::cea::{CeaError, ComplexMode, SweepRequest, Unwatched, sparse};
use crate::cycle::Parameter;
use crate::fem::MassKind;
use crate::prestress::{Assembly, TangentOptions};
use crate::study::eigenvalues::{Model, Solver, asked_modes};
use crate::study::transient::SteppedMesh;
use crate::study::{StudyError, tangent_options};

/// Modes of lowest frequency that are looked at where the case has no `[cea]`.
const MODES: usize = 30;
/// Spectra spent on an onset.
const SPECTRA: usize = 14;
/// Share of the interval that an onset is known to.
const NEAR: f64 = 1e-5;

/// Steady sliding and its modes, with the lumped mass and without the geometric stiffness, as the transient has them.
pub struct Steady {
    /// Its displacement, m.
    pub base: Vec<f64>,
    /// All modes looked at, by frequency.
    pub modes: Vec<ComplexMode>,
}

impl Steady {
    /// That of a case.
    ///
    /// # Errors
    /// A body without a state of steady sliding; those of the eigenvalue solver.
    pub fn of(case: &Case, stepped: &SteppedMesh<'_>) -> Result<Self, StudyError> {
        let friction = case.contact.sliding.friction_coefficient;
        let mut options = tangent_options(case, MassKind::Lumped);
        options.geometric_stiffness = false;
        let request = SweepRequest {
            friction_coefficients: &[friction],
            limit: asked_modes(case, MODES),
            shapes_at: &[friction],
        };
        if let Some(assembly) = &stepped.assembly {
            return Self::of_assembly(assembly, &options, &request);
        }
        let solver = match &case.body {
            Body::Revolution(_) => Solver::by_symmetry(case),
            _ => Solver::WholeMesh,
        };
        let model = Model::with_solver(case, solver, options, &[friction])?;
        let found = model.spectrum(case, &request, false, &Unwatched)?;
        let point = found.sweep.points.into_iter().next();
        let modes = point.map_or_else(Vec::new, |point| point.modes);
        let base = match &model {
            Model::Whole(whole) => whole.base().displacement(friction),
            _ => {
                let body = stepped.body(case);
                body.sliding_displacement().map_err(StudyError::Transient)?
            }
        };
        Ok(Self { base, modes })
    }

    /// That of solid bodies, with their contact points at nodes as the transient has them.
    fn of_assembly(
        assembly: &Assembly<'_>,
        options: &TangentOptions,
        request: &SweepRequest<'_>,
    ) -> Result<Self, StudyError> {
        let frictions = request.friction_coefficients;
        let range = assembly.range(frictions).map_err(CeaError::from)?;
        let state = &range.states[range.state_of[0]];
        let tangent = assembly.tangent(state, options).map_err(CeaError::from)?;
        let found = sparse::sweep(&tangent, request, &Unwatched)?;
        let point = found.points.into_iter().next();
        Ok(Self {
            base: state.displacement(frictions[0]),
            modes: point.map_or_else(Vec::new, |point| point.modes),
        })
    }

    /// That of a case with a parameter at another value, SI.
    ///
    /// # Errors
    /// As [`Self::of`]; a value that the case cannot have.
    pub fn at(
        (case, stepped): (&Case, &SteppedMesh<'_>),
        parameter: Parameter,
        value: f64,
    ) -> Result<Self, StudyError> {
        if stepped.assembly.is_some() {
            // The bodies are the same: no key of the case is that of all contacts.
            let (mut point, mut other) = (operating_point(case), case.clone());
            parameter.set(&mut point, value);
            other.contact.sliding = point.contact;
            other.damping.rayleigh = point.damping;
            return Self::of(&other, stepped);
        }
        let value = parameter.in_key_units(value);
        let change = format!("{}={value:?}", parameter.key());
        let mut raw = case.raw.with_overrides(&[change])?;
        for study in ["sweep", "fit", "uncertainty"] {
            raw.root.remove(study);
        }
        let other = Case::from_raw(raw)?;
        Self::of(&other, &SteppedMesh::of(&other)?)
    }

    /// Places of the modes that grow, fastest first.
    pub fn growing(&self) -> Vec<usize> {
        let modes = &self.modes;
        let growing = (0..modes.len()).filter(|&i| modes[i].is_unstable());
        let mut growing: Vec<usize> = growing.collect();
        growing.sort_by(|&a, &b| modes[b].growth_rate().total_cmp(&modes[a].growth_rate()));
        growing
    }

    /// Place of the mode that grows fastest or decays slowest.
    pub fn least_stable(&self) -> Option<usize> {
        let growth = |i: usize| self.modes[i].growth_rate();
        (0..self.modes.len()).max_by(|&a, &b| growth(a).total_cmp(&growth(b)))
    }

    /// Its growth rate, 1/s.
    pub fn growth_rate(&self) -> f64 {
        let least = self.least_stable();
        least.map_or(f64::NEG_INFINITY, |place| self.modes[place].growth_rate())
    }
}

/// The value of a parameter between one at which steady sliding is stable and one at which it is not: where its fastest mode
/// neither grows nor decays, by false position; none where it is not stable at the first.
pub fn onset(
    of: (&Case, &SteppedMesh<'_>),
    parameter: Parameter,
    stable: f64,
    growing: f64,
) -> Option<f64> {
    let growth = |value: f64| {
        let steady = Steady::at(of, parameter, value).ok()?;
        Some(steady.growth_rate())
    };
    let (mut low, mut high) = ((stable, growth(stable)?), (growing, growth(growing)?));
    if low.1 > 0.0 || high.1 <= 0.0 {
        return None;
    }
    let width = (growing - stable).abs();
    let (mut kept, mut value) = ([0_u32; 2], stable);
    for _ in 0..SPECTRA {
        // Illinois: the end that stays gives way.
        let [a, b] = [
            low.1 * 0.5_f64.powi(kept[0].saturating_sub(1) as i32),
            high.1 * 0.5_f64.powi(kept[1].saturating_sub(1) as i32),
        ];
        let next = low.0 + (high.0 - low.0) * (a / (a - b)).clamp(0.02, 0.98);
        let rate = growth(next)?;
        let has_moved = (next - value).abs();
        value = next;
        if rate <= 0.0 {
            (low, kept) = ((next, rate), [0, kept[1] + 1]);
        } else {
            (high, kept) = ((next, rate), [kept[0] + 1, 0]);
        }
        if (high.0 - low.0).abs() < NEAR * width || has_moved < 0.1 * NEAR * width {
            break;
        }
    }
    Some(value)
}
