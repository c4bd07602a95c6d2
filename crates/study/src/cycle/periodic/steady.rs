//! Steady sliding at one operating point.

use crate::eigenvalues::{Model, Solver};
use crate::tangent::{MODES_IN_TIME, options_in_time};
use crate::transient::SteppedMesh;
use crate::*;
use frictionsim_physics::{cea::sparse, cycle::periodic::GrowingMode};

/// Largest friction coefficient at which a loss of stability is looked for where no range of a parameter is given.
const LARGEST_FRICTION: f64 = 2.0;
/// Ratio of one friction coefficient looked at to the one before.
const RISE: f64 = 1.25;

/// Steady sliding and its modes, with the lumped mass and without the geometric stiffness, as the transient has them.
pub struct Steady {
    /// Its displacement, m.
    pub base: Vec<f64>,
    /// All modes looked at, by frequency.
    pub modes: Vec<ComplexMode>,
    /// Frequency of one that grows above them, Hz.
    pub above_hz: Option<f64>,
}

impl Steady {
    /// That of a case.
    pub fn of(case: &Case, stepped: &SteppedMesh<'_>) -> Result<Self, StudyError> {
        let own = [case.contact.sliding.friction_coefficient];
        let (base, found) = if let Some(assembly) = &stepped.assembly {
            let request = SweepRequest {
                shapes_at: &own,
                ..SweepRequest::new(&own, asked_modes(case, MODES_IN_TIME))
            };
            // Their contact points are at nodes, as the transient has them.
            let range = assembly.range(&own, &Default::default())?;
            let state = &range.states[range.state_of[0]];
            let tangent = assembly.tangent(state, &options_in_time(case))?;
            (state.displacement(own[0]), sparse::sweep(&tangent, &request, &Unwatched)?)
        } else {
            let (model, sweep) = sweep_in_time(case, &own, &own)?;
            let base = match &model {
                Model::Whole(whole) => whole.state().displacement(own[0]),
                _ => stepped.body(case).sliding_displacement()?,
            };
            (base, sweep)
        };
        let above_hz = found.beyond().map(|(_, mode)| mode.frequency_hz());
        Ok(Self { base, above_hz, modes: found.into_first_modes() })
    }

    /// That of a case with a parameter at another value, SI.
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
        let other = case.with_keys(&[change])?;
        Self::of(&other, &SteppedMesh::of(&other)?)
    }

    /// The lowest critical friction coefficient above the case's own, at which sliding is stable; none up to 2, nor of
    /// solid bodies, where each value has a contact of its own.
    pub fn critical_friction(case: &Case, stepped: &SteppedMesh<'_>) -> Option<f64> {
        let friction = case.contact.sliding.friction_coefficient;
        if stepped.assembly.is_some() || friction <= 0.0 {
            return None;
        }
        // Upwards, a few values at a time: beyond some friction there may be no state of steady sliding.
        let mut low = friction;
        while low < LARGEST_FRICTION {
            let frictions = [low, RISE * low, RISE * RISE * low];
            let (_, sweep) = sweep_in_time(case, &frictions, &[]).ok()?;
            let critical = sweep.intervals.iter().map(|own| own.critical_friction);
            if let Some(found) = critical.min_by(f64::total_cmp) {
                return Some(found);
            }
            low = frictions[2];
        }
        None
    }

    /// Places of the modes that grow, fastest first.
    pub fn growing(&self) -> Vec<usize> {
        let modes = &self.modes;
        let growing = (0..modes.len()).filter(|&i| modes[i].is_unstable());
        sorted(growing, |&i| -modes[i].growth_rate())
    }

    /// Place of the mode that grows fastest or decays slowest.
    pub fn least_stable(&self) -> Option<usize> {
        let growth = |i: usize| self.modes[i].growth_rate();
        (0..self.modes.len()).max_by(|&a, &b| growth(a).total_cmp(&growth(b)))
    }

    /// The mode of a place, from which a motion may grow.
    pub fn mode(&self, place: usize) -> GrowingMode<'_> {
        let mode = &self.modes[place];
        let shape = mode.shape.as_deref().unwrap_or_default();
        GrowingMode { eigenvalue: mode.eigenvalue, shape, base: &self.base }
    }

    /// Its growth rate, 1/s.
    pub fn growth_rate(&self) -> f64 {
        self.least_stable().map_or(f64::NEG_INFINITY, |place| self.modes[place].growth_rate())
    }
}

/// The modes of a case over friction as the transient has them, with their shapes at some of the values.
fn sweep_in_time(
    case: &Case,
    frictions: &[f64],
    shapes_at: &[f64],
) -> Result<(Model, FrictionSweep), StudyError> {
    let solver = case.body.revolution().map_or(Solver::WholeMesh, |_| Solver::Waves);
    let request = SweepRequest {
        shapes_at,
        ..SweepRequest::new(frictions, asked_modes(case, MODES_IN_TIME))
    };
    let model = Model::with_solver(case, solver, options_in_time(case), frictions)?;
    let found = model.spectrum(case, &request)?;
    Ok((model, found.sweep))
}
