//! What a case costs, estimated without running it.
//!
//! Memory and time come from operation counts and typical rates of one modern core, to within a
//! factor of about two; the run itself measures the real ones.

use super::model::node_count;
use super::{
    Analysis, Case, CaseErrors, Cea, CeaMethod, Convergence, Cycle, Frf, FrfMethod, ModeSelection,
    StabilityChoice, TimeStep, Transient,
};
use crate::mesh::ElementKind;
use crate::transient::stable_step_limit;
use std::f64::consts::TAU;

/// Phases of a limit cycle where the mesh decides.
const LIKELY_PHASES: usize = 169;

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
}

impl Cost {
    /// Memory of one analysis and its mesh, bytes.
    fn memory_of(&self, analysis: Analysis) -> f64 {
        self.mesh_memory_bytes
            + match analysis {
                Analysis::Cea => self.cea.map_or(0.0, |cost| cost.memory_bytes),
                Analysis::Transient => self.transient.map_or(0.0, |cost| cost.memory_bytes),
                Analysis::Cycle => self.cycle.map_or(0.0, |cost| cost.memory_bytes),
            }
    }

    /// Time of one analysis on one thread, s.
    fn seconds_of(&self, analysis: Analysis) -> f64 {
        match analysis {
            Analysis::Cea => self.cea.map_or(0.0, |cost| cost.seconds),
            Analysis::Transient => self.transient.map_or(0.0, |cost| cost.seconds),
            Analysis::Cycle => self.cycle.map_or(0.0, |cost| cost.seconds),
        }
    }
}

impl Case {
    /// Estimates what the analyses of the case cost, each once.
    pub fn cost(&self) -> Cost {
        let annulus = &self.annulus;
        let nodes = node_count(annulus);
        let elements = annulus.circumferential_elements as u128 * annulus.radial_elements as u128;
        Cost {
            nodes,
            elements,
            dofs: 2 * nodes,
            // Coordinates, frame, connectivity and result vectors of a node and its element.
            mesh_memory_bytes: 160.0 * nodes as f64,
            cea: self.cea.as_ref().map(|cea| self.cea_cost(cea, nodes)),
            transient: self
                .transient
                .as_ref()
                .map(|transient| self.transient_cost(transient, nodes, elements)),
            cycle: self.cycle.as_ref().map(|cycle| self.cycle_cost(cycle)),
            frf: self.frf.as_ref().map(|frf| self.frf_cost(frf, nodes)),
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

    /// Estimates what the convergence study costs: every mesh and every time step.
    pub fn convergence_cost(&self) -> Option<StudyCost> {
        let study = self.convergence.as_ref()?;
        let meshes = study.factors.iter().map(|factor| {
            let annulus = Convergence::refined(&self.annulus, *factor);
            let cost = Case {
                annulus,
                ..self.clone()
            }
            .cost();
            (cost, study.analyses.clone(), 1.0)
        });
        let steps = study.time_step_factors.iter();
        let steps = steps.map(|factor| (self.cost(), vec![Analysis::Transient], 1.0 / factor));
        let mut total = StudyCost {
            runs: 0,
            memory_bytes: 0.0,
            seconds: 0.0,
        };
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
        ];
        let here = has.into_iter().filter(|pair| pair.1).map(|pair| pair.0);
        here.filter(|analysis| named.is_empty() || named.contains(analysis))
            .collect()
    }

    /// Memory that a command needs, bytes, and the key that asks for most of it.
    pub fn memory(&self, command: &str) -> (f64, &'static str) {
        let cost = self.cost();
        let mesh = self.larger_count();
        let own = match command {
            "cea" => cost.cea.map(|cea| (cea.memory_bytes, mesh)),
            "transient" => cost
                .transient
                .map(|run| (run.memory_bytes, self.record_key())),
            "cycle" => cost.cycle.map(|cycle| {
                let phases = self.cycle.as_ref().and_then(|cycle| cycle.phases);
                let key = phases.map_or("mesh.circumferential_elements", |_| "cycle.phases");
                (cycle.memory_bytes, key)
            }),
            "frf" => cost.frf.map(|frf| (frf.memory_bytes, mesh)),
            "sweep" => self
                .sweep_cost()
                .map(|sweep| (sweep.memory_bytes - cost.mesh_memory_bytes, mesh)),
            "convergence" => self
                .convergence_cost()
                .map(|study| (study.memory_bytes, "convergence.factors")),
            _ => None,
        };
        let (bytes, key) = own.unwrap_or((0.0, mesh));
        let blamed = if bytes > cost.mesh_memory_bytes {
            key
        } else {
            mesh
        };
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
            "transient.duration" => "lower it, or raise output.sample_interval",
            "output.snapshots" | "cycle.phases" => "lower it",
            "convergence.factors" => "lower the factors, or start from a coarser mesh",
            _ => "lower mesh.circumferential_elements or mesh.radial_elements",
        };
        self.error_at(
            key,
            format!(
                "{command} needs about {:.1} GiB of memory, {:.1} GiB are available: most of it for \
                 {key}{given}",
                gibibytes(needed),
                gibibytes(available)
            ),
            "too much for this machine".to_owned(),
            Some(remedy.to_owned()),
        )
    }

    /// The element count that is further from a usual one.
    fn larger_count(&self) -> &'static str {
        let annulus = &self.annulus;
        if annulus.radial_elements > annulus.circumferential_elements {
            "mesh.radial_elements"
        } else {
            "mesh.circumferential_elements"
        }
    }

    /// What makes the record of a transient large: its length, its samples, or its snapshots.
    fn record_key(&self) -> &'static str {
        // Usual ones: 0.05 s and 2 us.
        let length = self.transient.as_ref().map_or(0.0, |run| run.duration) / 0.05;
        let density = 2e-6 / self.output.sample_interval;
        let samples = 17.0 * self.samples() * self.contact_nodes();
        let snapshots = self.snapshot_bytes();
        let body = 320.0 * node_count(&self.annulus) as f64;
        if snapshots > samples.max(body) {
            "output.snapshots"
        } else if length.max(density) < 10.0 {
            self.larger_count()
        } else if density > length {
            "output.sample_interval"
        } else {
            "transient.duration"
        }
    }

    fn samples(&self) -> f64 {
        let duration = self.transient.as_ref().map_or(0.0, |run| run.duration);
        duration / self.output.sample_interval
    }

    fn contact_nodes(&self) -> f64 {
        let per_element = if self.annulus.element == ElementKind::Quad4 {
            1
        } else {
            2
        };
        (per_element * self.annulus.circumferential_elements) as f64
    }

    /// Displacements and velocities of all nodes at each snapshot.
    fn snapshot_bytes(&self) -> f64 {
        32.0 * node_count(&self.annulus) as f64 * self.output.snapshots.len() as f64
    }

    fn cea_cost(&self, cea: &Cea, nodes: u128) -> CeaCost {
        let dofs = 2.0 * nodes as f64;
        let friction_values = cea.solved_friction_coefficients().len();
        let modes = match cea.modes {
            ModeSelection::Lowest(modes) => modes,
            ModeSelection::BelowHz(limit) => self.modes_below(limit),
        };
        let maps = 1.0 + cea.map.as_ref().map_or(0.0, |map| map.values.len() as f64);
        let (memory_bytes, seconds) = if cea.method == CeaMethod::Sparse {
            let fill = sparse_fill(dofs);
            let basis = 8.0 * dofs * (2.0 * modes as f64 + 40.0);
            let solve = 2e-9 * fill * (3.0 * modes as f64 + 20.0);
            (
                12.0 * fill + 24.0 * 18.0 * dofs + basis,
                solve * friction_values as f64,
            )
        } else {
            let radial = dofs / self.annulus.circumferential_elements as f64;
            (
                100.0 * radial * radial.min(200.0),
                1e-6 * radial * modes as f64 * friction_values as f64,
            )
        };
        CeaCost {
            friction_values,
            modes,
            memory_bytes,
            seconds: seconds * maps,
        }
    }

    fn cycle_cost(&self, cycle: &Cycle) -> CycleCost {
        let phases = cycle.phases.unwrap_or(LIKELY_PHASES) as f64;
        let families = cycle.harmonics.as_ref().map_or(2, Vec::len);
        let followed = cycle.continuation.as_ref().map_or(0, |range| range.count);
        let stable = match cycle.stability {
            StabilityChoice::None => 0,
            StabilityChoice::Point => 1,
            StabilityChoice::Branch => 1 + followed,
        };
        // Measured with 169 phases: 0.25 s from birth, 6 ms to a neighbour, 0.4 s for the exponents; dense factorizations.
        let factorization = (phases / 169.0).powi(3);
        let steps = cycle.confirmation_periods as f64 * 800.0;
        let elements =
            self.annulus.circumferential_elements as f64 * self.annulus.radial_elements as f64;
        let each = factorization * (0.25 + 0.006 * followed as f64 + 0.4 * stable as f64);
        CycleCost {
            families,
            cycles: 1 + followed,
            // A few dense matrices of two unknowns for each phase, and of four for the perturbations.
            memory_bytes: families as f64 * 8.0 * 40.0 * phases * phases,
            seconds: families as f64 * (each + 2e-9 * elements * steps),
        }
    }

    fn frf_cost(&self, frf: &Frf, nodes: u128) -> FrfCost {
        let dofs = 2.0 * nodes as f64;
        let lines = frf.frequencies_hz.len();
        let (bytes, each) = match frf.method {
            // One block band of a sector for each harmonic.
            FrfMethod::Auto | FrfMethod::Cyclic => (
                100.0 * dofs / self.annulus.circumferential_elements.max(1) as f64,
                2e-8 * dofs,
            ),
            // Measured: a complex factorization takes 4 ns for each entry and its rows.
            FrfMethod::Direct => (24.0 * sparse_fill(dofs), 3.5e-8 * sparse_fill(dofs)),
            FrfMethod::Reduced => (24.0 * sparse_fill(dofs), 1e-5),
        };
        FrfCost {
            lines,
            memory_bytes: bytes + 64.0 * lines as f64,
            seconds: each * lines as f64,
        }
    }

    /// Weyl's estimate of the number of modes of the plane body below a frequency:
    /// `A omega^2 / 4 pi (1 / c_p^2 + 1 / c_s^2)`.
    fn modes_below(&self, limit_hz: f64) -> usize {
        let annulus = &self.annulus;
        let area = TAU / 2.0 * (annulus.outer_radius.powi(2) - annulus.inner_radius.powi(2));
        let [lambda, shear] = self.material.lame_constants();
        let density = self.material.density;
        let slowness = density / (lambda + 2.0 * shear) + density / shear;
        let count = area * (TAU * limit_hz).powi(2) / (2.0 * TAU) * slowness;
        (count as usize).clamp(1, 2 * usize::try_from(node_count(annulus)).unwrap_or(1))
    }

    /// Highest frequency that the mesh can hold, rad/s, from the pressure-wave speed and the
    /// smallest element: `omega = 2 c_p sqrt(1 / h_r^2 + 1 / h_theta^2)`.
    fn highest_frequency(&self) -> f64 {
        let annulus = &self.annulus;
        let [lambda, shear] = self.material.lame_constants();
        let speed = ((lambda + 2.0 * shear) / self.material.density).sqrt();
        let count = annulus.radial_elements as f64;
        let width = annulus.outer_radius - annulus.inner_radius;
        let log = annulus.radial_grading.ln();
        let first = if log == 0.0 {
            width / count
        } else {
            width * log.exp_m1() / (count * log).exp_m1()
        };
        let last = first * ((count - 1.0) * log).exp();
        let around = |radius: f64| TAU * radius / annulus.circumferential_elements as f64;
        let inner = (1.0 / first).hypot(1.0 / around(annulus.inner_radius + 0.5 * first));
        let outer = (1.0 / last).hypot(1.0 / around(annulus.outer_radius - 0.5 * last));
        2.0 * speed * inner.max(outer)
    }

    fn transient_cost(&self, transient: &Transient, nodes: u128, elements: u128) -> TransientCost {
        let stable_step = stable_step_limit(self.highest_frequency(), &self.damping.rayleigh);
        let time_step = match transient.time_step {
            TimeStep::Seconds(step) => step,
            TimeStep::Auto => stable_step,
        };
        let steps = (transient.duration / time_step).ceil();
        TransientCost {
            time_step,
            stable_step,
            steps,
            // Ten nodal vectors, and the status and two stresses of each contact node over time.
            memory_bytes: 160.0 * nodes as f64
                + 17.0 * self.samples() * self.contact_nodes()
                + 56.0 * self.samples() * self.output.probes.len() as f64
                + self.snapshot_bytes(),
            seconds: 2e-9 * elements as f64 * steps,
        }
    }
}

/// Entries of the factor of a plane mesh under a minimum-degree ordering, measured: about
/// `9 n log2 n` of 12 bytes.
fn sparse_fill(dofs: f64) -> f64 {
    9.0 * dofs * dofs.max(2.0).log2()
}
