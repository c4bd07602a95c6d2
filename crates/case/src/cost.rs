//! Cost of a case, estimated without running it.
//!
//! Memory comes from the sizes of matrices and records, to within a factor of about two. Time is a
//! count of operations at one rate: its order of magnitude.

mod estimate;

use super::{Analysis, CaseErrors, sweep::evenly};
use crate::*;
use estimate::Size;
use serde::{Serialize, Serializer};

/// Points of a study whose cost is looked at.
const TRIED_POINTS: usize = 24;

/// Complex multiplications and additions that one core does in a second, about.
const RATE: f64 = 1e9;

/// Memory and time of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RunCost {
    /// Memory, bytes.
    #[serde(serialize_with = "whole")]
    pub memory_bytes: f64,
    /// Multiplications and additions: the time on one thread, to its order of magnitude.
    #[serde(rename = "time", serialize_with = "in_words")]
    pub operations: f64,
}

impl RunCost {
    /// Time on one thread, s, to its order of magnitude.
    pub fn seconds(&self) -> f64 {
        self.operations / RATE
    }

    /// That of two runs, one after the other.
    fn and(self, next: Self) -> Self {
        Self {
            memory_bytes: self.memory_bytes.max(next.memory_bytes),
            operations: self.operations + next.operations,
        }
    }

    /// The same in words.
    pub fn time(&self) -> &'static str {
        match self.seconds() {
            s if s < 60.0 => "seconds",
            s if s < 3600.0 => "minutes",
            _ => "hours",
        }
    }
}

/// A count, without a point.
fn whole<S: Serializer>(count: &f64, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_u64(*count as u64)
}

fn in_words<S: Serializer>(operations: &f64, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(RunCost { operations: *operations, ..RunCost::default() }.time())
}

/// Cost of a complex eigenvalue analysis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CeaCost {
    /// Friction coefficients solved at.
    pub friction_values: usize,
    /// Modes expected at each.
    #[serde(rename = "estimated_modes")]
    pub modes: usize,
    /// Memory and time.
    #[serde(flatten)]
    pub run: RunCost,
}

/// Cost of a transient.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TransientCost {
    /// Time step, s: given, or a bound from wave speed and element size.
    #[serde(rename = "time_step_s")]
    pub time_step: f64,
    /// Largest stable time step by that bound, s.
    #[serde(skip)]
    pub stable_step: f64,
    /// Steps.
    pub steps: u64,
    /// Memory and time.
    #[serde(flatten)]
    pub run: RunCost,
}

/// Cost of a search for limit cycles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CycleCost {
    /// Families: those of the harmonics named, or two.
    pub families: usize,
    /// Cycles of each family: that of the case, and those along its branch.
    pub cycles: usize,
    /// Memory and time.
    #[serde(flatten)]
    pub run: RunCost,
}

/// Cost of a frequency response.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FrfCost {
    /// Frequencies.
    pub lines: usize,
    /// Memory and time.
    #[serde(flatten)]
    pub run: RunCost,
}

/// Cost of many runs of a case: memory of what runs at once, time of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct StudyCost {
    /// Runs.
    pub runs: usize,
    /// Memory and time.
    #[serde(flatten)]
    pub run: RunCost,
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
    /// Search for the boundary of two basins.
    pub basin: Option<RunCost>,
}

impl Cost {
    /// Memory of one analysis and its mesh, and its time.
    fn run_of(&self, analysis: Analysis) -> RunCost {
        let own = match analysis {
            Analysis::Cea => self.cea.map(|cost| cost.run),
            Analysis::Transient => self.transient.map(|cost| cost.run),
            Analysis::Cycle => self.cycle.map(|cost| cost.run),
            Analysis::Basin => self.basin,
        };
        let own = own.unwrap_or_default();
        RunCost { memory_bytes: self.mesh_memory_bytes + own.memory_bytes, ..own }
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
            dofs: size.unknowns as u128,
            // Coordinates, frame, connectivity and result vectors of a node and its element.
            mesh_memory_bytes: 160.0 * size.nodes as f64,
            cea: self.cea.as_ref().map(|cea| self.cea_cost(cea, size)),
            transient: transient.map(|transient| self.transient_cost(transient, size)),
            cycle: self.cycle.as_ref().map(|cycle| self.cycle_cost(cycle, size)),
            frf: self.frf.as_ref().map(|frf| self.frf_cost(frf, size)),
            basin: self.basin.as_ref().map(|basin| self.basin_cost(basin, size)),
        }
    }

    /// Estimates what the analyses cost on a mesh `factor` times as fine.
    fn refined_cost(&self, factor: f64) -> Cost {
        if self.body.has_sectors() {
            return self.refined(factor).map_or_else(|_| self.cost(), |case| case.cost());
        }
        // The elements of a mesh file are split for a run, not for an estimate.
        self.cost_of(&Size::of(self).refined(factor, self.body.dimension()))
    }

    /// Estimates what the parameter study costs, from evenly spaced points of it.
    pub fn sweep_cost(&self) -> Option<StudyCost> {
        let sweep = self.sweep.as_ref()?;
        let runs = sweep.point_count();
        let tried = runs.min(TRIED_POINTS);
        // A point that is no valid case fails at once and costs nothing.
        let costs = evenly(runs, tried).map(|point| {
            let raw = self.raw.sweep_point(&sweep.overrides(point)).ok()?;
            let case = Case::read(raw).ok()?;
            let cost = case.cost();
            // The analyses named, else all that the case has.
            let named = &sweep.analyses;
            let is_run = |of: &Analysis| case.has(*of) && (named.is_empty() || named.contains(of));
            let runs = Analysis::all().filter(is_run).map(|of| cost.run_of(of));
            Some(runs.fold(RunCost::default(), RunCost::and))
        });
        let all = costs.flatten().fold(RunCost::default(), RunCost::and);
        let operations = all.operations * runs as f64 / tried.max(1) as f64;
        Some(StudyCost { runs, run: RunCost { operations, ..all } })
    }

    /// Estimates what the samples of `[uncertainty]` cost: the onsets of each, and what the indices take.
    pub fn uncertainty_cost(&self) -> Option<StudyCost> {
        let (uncertainty, each) = (self.uncertainty.as_ref()?, self.cost().run_of(Analysis::Cea));
        let for_indices = uncertainty.index_samples * (uncertainty.parameters.len() + 1);
        let runs = uncertainty.samples + for_indices;
        let run = RunCost { operations: runs as f64 * each.operations, ..each };
        Some(StudyCost { runs, run })
    }

    /// Estimates what the convergence study costs: every mesh and every time step.
    pub fn convergence_cost(&self) -> Option<StudyCost> {
        let study = self.convergence.as_ref()?;
        let meshes = study.factors.iter();
        let meshes = meshes.map(|factor| (self.refined_cost(*factor), study.analyses.clone(), 1.0));
        let steps = study.time_step_factors.iter();
        let steps = steps.map(|factor| (self.cost(), vec![Analysis::Transient], 1.0 / factor));
        let mut total = StudyCost::default();
        for (cost, analyses, times) in meshes.chain(steps) {
            for analysis in analyses {
                let run = cost.run_of(analysis);
                total.runs += 1;
                // The levels run side by side.
                total.run.memory_bytes += run.memory_bytes;
                total.run.operations += times * run.operations;
            }
        }
        Some(total)
    }

    /// Memory that a command needs, bytes, and the key that asks for most of it.
    pub fn memory(&self, command: &str) -> (f64, &'static str) {
        let (cost, mesh) = (self.cost(), self.larger_count());
        let has_phases = self.cycle.as_ref().is_some_and(|cycle| cycle.phases.is_some());
        let of_phases = has_phases && self.has_rotating_waves();
        let (run, key) = match command {
            "cea" | "improve" | "mac" => (cost.cea.map(|own| own.run), mesh),
            "transient" => (cost.transient.map(|own| own.run), self.record_key()),
            "cycle" if of_phases => (cost.cycle.map(|own| own.run), "cycle.phases"),
            "cycle" => (cost.cycle.map(|own| own.run), mesh),
            "frf" => (cost.frf.map(|own| own.run), mesh),
            "sweep" => (self.sweep_cost().map(|own| own.run), mesh),
            "convergence" => (self.convergence_cost().map(|own| own.run), "convergence.factors"),
            _ => (None, mesh),
        };
        let bytes = run.map_or(0.0, |run| run.memory_bytes);
        // Those of a sweep hold their meshes.
        let bytes = bytes - if command == "sweep" { cost.mesh_memory_bytes } else { 0.0 };
        let blamed = if bytes > cost.mesh_memory_bytes { key } else { mesh };
        (cost.mesh_memory_bytes + bytes.max(0.0), blamed)
    }

    /// The error of a command that needs more memory than there is.
    pub fn memory_error(&self, command: &str, needed: f64, available: f64) -> CaseErrors {
        let key = self.memory(command).1;
        let gibibytes = |bytes: f64| bytes / f64::from(1 << 30);
        let value = self.raw.find(key).map(|item| item.value.shortened());
        let given = value.map_or_else(String::new, |value| format!(" = {value}"));
        let remedy = match key {
            "output.sample_interval" => "raise it, or lower transient.duration",
            "output.contact_interval" => "raise it, or lower transient.duration",
            "transient.duration" => "lower it, or raise output.sample_interval",
            "output.snapshots" | "cycle.phases" => "lower it",
            "convergence.factors" => "lower the factors, or start from a coarser mesh",
            "mesh.file" => "mesh the body more coarsely",
            _ => "lower mesh.circumferential_elements or mesh.radial_elements",
        };
        refusal!(self, key,
            "{command} needs about {:.1} GiB of memory, {:.1} GiB are available: most of it for \
             {key}{given}", gibibytes(needed), gibibytes(available); "too much for this machine";
            "{remedy}")
    }

    /// What the size of the mesh comes from: the element count that is further from a usual one, or the file.
    fn larger_count(&self) -> &'static str {
        match self.body.grid() {
            None => "mesh.file",
            Some(own) if own.radial_elements > own.circumferential_elements => {
                "mesh.radial_elements"
            }
            Some(_) => "mesh.circumferential_elements",
        }
    }

    /// What makes the record of a transient large: its length, its samples, its snapshots, or the body.
    fn record_key(&self) -> &'static str {
        let [samples, frames, snapshots] = self.record_bytes();
        let body = 320.0 * self.body.node_count() as f64;
        let (output, most) = (&self.output, samples.max(frames).max(snapshots).max(body));
        match output.recorder.contact_interval {
            _ if most == body => self.larger_count(),
            _ if most == snapshots => "output.snapshots",
            Some(_) if most == frames => "output.contact_interval",
            _ if output.sample_interval < 2e-6 => "output.sample_interval", // A usual one.
            _ => "transient.duration",
        }
    }
}
