//! Cost of a case, estimated without running it.
//!
//! Memory and time come from operation counts and typical rates of one modern core, to within a
//! factor of about two. The run itself measures the real ones.

mod estimate;
mod memory;
mod size;

use super::{Analysis, Body, Case};
use size::Size;

/// Points of a study whose cost is looked at.
const TRIED_POINTS: usize = 24;

/// Cost of a complex eigenvalue analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CeaCost {
    /// Friction coefficients solved at.
    pub friction_values: usize,
    /// Modes expected at each.
    pub modes: usize,
    /// Memory of the solver, bytes.
    pub memory_bytes: f64,
    /// Time on one thread, s.
    pub seconds: f64,
}

/// Cost of a transient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransientCost {
    /// Time step, s: given, or a bound from wave speed and element size.
    pub time_step: f64,
    /// Largest stable time step by that bound, s.
    pub stable_step: f64,
    /// Steps.
    pub steps: f64,
    /// Memory, bytes.
    pub memory_bytes: f64,
    /// Time on one thread, s.
    pub seconds: f64,
}

/// Cost of a search for limit cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CycleCost {
    /// Families: those of the harmonics named, or two.
    pub families: usize,
    /// Cycles of each family: that of the case, and those along its branch.
    pub cycles: usize,
    /// Memory of the solver, bytes.
    pub memory_bytes: f64,
    /// Time on one thread, s.
    pub seconds: f64,
}

/// Cost of a frequency response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrfCost {
    /// Frequencies.
    pub lines: usize,
    /// Memory of the solver, bytes.
    pub memory_bytes: f64,
    /// Time on one thread, s.
    pub seconds: f64,
}

/// Cost of many runs of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StudyCost {
    /// Runs.
    pub runs: usize,
    /// Memory of the largest run, bytes.
    pub memory_bytes: f64,
    /// Time of all on one thread, s.
    pub seconds: f64,
}

/// Size of a case and the cost of each of its analyses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Nodes.
    pub nodes: u128,
    /// Elements.
    pub elements: u128,
    /// Unknowns before the clamped edge is taken out.
    pub dofs: u128,
    /// Memory of mesh and matrices, bytes.
    pub mesh_memory_bytes: f64,
    /// Eigenvalue analysis.
    pub cea: Option<CeaCost>,
    /// Transient.
    pub transient: Option<TransientCost>,
    /// Search for limit cycles.
    pub cycle: Option<CycleCost>,
    /// Frequency response.
    pub frf: Option<FrfCost>,
    /// Time of a search for the boundary of two basins on one thread, s; 0 where none is asked for.
    pub basin_seconds: f64,
}

impl Cost {
    /// Memory of one analysis and its mesh, bytes.
    fn memory_of(&self, analysis: Analysis) -> f64 {
        self.mesh_memory_bytes
            + match analysis {
                Analysis::Cea => self.cea.map_or(0.0, |cost| cost.memory_bytes),
                Analysis::Transient => self.transient.map_or(0.0, |cost| cost.memory_bytes),
                Analysis::Cycle => self.cycle.map_or(0.0, |cost| cost.memory_bytes),
                // A few fields, less than the mesh.
                Analysis::Basin => 0.0,
            }
    }

    /// Time of one analysis on one thread, s.
    fn seconds_of(&self, analysis: Analysis) -> f64 {
        match analysis {
            Analysis::Cea => self.cea.map_or(0.0, |cost| cost.seconds),
            Analysis::Transient => self.transient.map_or(0.0, |cost| cost.seconds),
            Analysis::Cycle => self.cycle.map_or(0.0, |cost| cost.seconds),
            Analysis::Basin => self.basin_seconds,
        }
    }
}

impl Case {
    /// Estimates what the analyses of the case cost, each once.
    pub fn cost(&self) -> Cost {
        self.cost_of(&Size::of(self))
    }

    /// Estimates what the analyses would cost on a mesh of such a size.
    fn cost_of(&self, size: &Size) -> Cost {
        let transient = self.transient.as_ref();
        Cost {
            nodes: size.nodes,
            elements: size.elements,
            dofs: self.body.dimension() as u128 * size.nodes,
            // Coordinates, frame, connectivity and result vectors of a node and its element.
            mesh_memory_bytes: 160.0 * size.nodes as f64,
            cea: self.cea.as_ref().map(|cea| self.cea_cost(cea, size)),
            transient: transient.map(|transient| self.transient_cost(transient, size)),
            cycle: self.cycle.as_ref().map(|cycle| self.cycle_cost(cycle, size)),
            frf: self.frf.as_ref().map(|frf| self.frf_cost(frf, size)),
            // Some eight transients of 800 steps to a period, each at its longest.
            basin_seconds: self.basin.as_ref().map_or(0.0, |basin| {
                8.0 * 2e-9 * size.elements as f64 * 800.0 * basin.periods as f64
            }),
        }
    }

    /// Estimates what the analyses cost on a mesh `factor` times as fine.
    fn refined_cost(&self, factor: f64) -> Cost {
        match &self.body {
            // Its elements are split for a run, not for an estimate.
            Body::Imported(_) | Body::Assembly(_) => self.cost_of(&Size::of(self).refined(factor)),
            Body::Annulus(_) | Body::Revolution(_) => {
                let refined = self.refined(factor);
                refined.map_or_else(|_| self.cost(), |case| case.cost())
            }
        }
    }

    /// Estimates what the parameter study costs, from evenly spaced points of it.
    pub fn sweep_cost(&self) -> Option<StudyCost> {
        let sweep = self.sweep.as_ref()?;
        let runs = sweep.point_count();
        let last = runs.saturating_sub(1);
        let tried = runs.min(TRIED_POINTS);
        let points = (0..tried).map(|i| i * last / tried.max(2).saturating_sub(1));
        // A point that is no valid case fails at once and costs nothing.
        let costs = points.map(|point| {
            let raw = self.raw.sweep_point(&sweep.overrides(point)).ok()?;
            let case = Case::read(raw).ok()?;
            let cost = case.cost();
            let analyses = case.studied(&sweep.analyses);
            let seconds: f64 = analyses.iter().map(|of| cost.seconds_of(*of)).sum();
            let bytes = analyses.iter().map(|of| cost.memory_of(*of));
            Some((bytes.fold(0.0, f64::max), seconds))
        });
        let costs: Vec<(f64, f64)> = costs.map(Option::unwrap_or_default).collect();
        Some(StudyCost {
            runs,
            memory_bytes: costs.iter().fold(0.0, |a: f64, cost| a.max(cost.0)),
            seconds: costs.iter().map(|cost| cost.1).sum::<f64>() * runs as f64
                / tried.max(1) as f64,
        })
    }

    /// Estimates what the samples of `[uncertainty]` cost: the onsets of each, and what the indices take.
    pub fn uncertainty_cost(&self) -> Option<StudyCost> {
        let (uncertainty, cost) = (self.uncertainty.as_ref()?, self.cost());
        let for_indices = uncertainty.index_samples * (uncertainty.parameters.len() + 1);
        let runs = uncertainty.samples + for_indices;
        Some(StudyCost {
            runs,
            memory_bytes: cost.memory_of(Analysis::Cea),
            seconds: runs as f64 * cost.seconds_of(Analysis::Cea),
        })
    }

    /// Estimates what the convergence study costs: every mesh and every time step.
    pub fn convergence_cost(&self) -> Option<StudyCost> {
        let study = self.convergence.as_ref()?;
        let meshes = study.factors.iter().map(|factor| {
            let cost = self.refined_cost(*factor);
            (cost, study.analyses.clone(), 1.0)
        });
        let steps = study.time_step_factors.iter();
        let steps = steps.map(|factor| (self.cost(), vec![Analysis::Transient], 1.0 / factor));
        let mut total = StudyCost { runs: 0, memory_bytes: 0.0, seconds: 0.0 };
        for (cost, analyses, times) in meshes.chain(steps) {
            for analysis in analyses {
                total.runs += 1;
                // The levels run side by side.
                total.memory_bytes += cost.memory_of(analysis);
                total.seconds += times * cost.seconds_of(analysis);
            }
        }
        Some(total)
    }

    /// The analyses that a study of these runs: those named, else all that the case has.
    fn studied(&self, named: &[Analysis]) -> Vec<Analysis> {
        let has = [
            (Analysis::Transient, self.transient.is_some()),
            (Analysis::Cea, self.cea.is_some()),
            (Analysis::Cycle, self.cycle.is_some()),
            (Analysis::Basin, self.basin.is_some()),
        ];
        let here = has.into_iter().filter(|pair| pair.1).map(|pair| pair.0);
        here.filter(|analysis| named.is_empty() || named.contains(analysis)).collect()
    }
}
