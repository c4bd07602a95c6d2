//! What a case costs, estimated without running it.

use super::model::node_count;
use super::{Case, Cea, CeaMethod, Cycle, ModeSelection, StabilityChoice, TimeStep, Transient};
use crate::mesh::ElementKind;
use std::f64::consts::TAU;

/// Phases of a limit cycle where the mesh decides.
const LIKELY_PHASES: usize = 169;

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

/// Size of a case and the cost of each of its analyses, to within a factor of about two.
///
/// Memory and time come from operation counts and typical rates of one modern core; the run itself
/// measures the real ones.
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
    /// Points of the parameter study.
    pub sweep_points: Option<usize>,
}

impl Case {
    /// Estimates what the case costs.
    pub fn cost(&self) -> Cost {
        let annulus = &self.annulus;
        let nodes = node_count(annulus);
        let elements = annulus.circumferential_elements as u128 * annulus.radial_elements as u128;
        // Coordinates, frame, connectivity and result vectors of a node and its element.
        let mesh_memory_bytes = 160.0 * nodes as f64;
        Cost {
            nodes,
            elements,
            dofs: 2 * nodes,
            mesh_memory_bytes,
            cea: self.cea.as_ref().map(|cea| self.cea_cost(cea, nodes)),
            transient: self
                .transient
                .as_ref()
                .map(|transient| self.transient_cost(transient, nodes, elements)),
            cycle: self.cycle.as_ref().map(|cycle| self.cycle_cost(cycle)),
            sweep_points: self.sweep.as_ref().map(super::Sweep::point_count),
        }
    }

    fn cea_cost(&self, cea: &Cea, nodes: u128) -> CeaCost {
        let dofs = 2.0 * nodes as f64;
        let friction_values = cea.solved_friction_coefficients().len();
        let modes = match cea.modes {
            ModeSelection::Lowest(modes) => modes,
            ModeSelection::BelowHz(limit) => self.modes_below(limit),
        };
        let (memory_bytes, seconds) = if cea.method == CeaMethod::Sparse {
            // Fill of a plane mesh under a minimum-degree ordering, measured: about 9 n log2 n
            // entries of 12 bytes, next to the matrices and the basis vectors.
            let fill = 9.0 * dofs * dofs.max(2.0).log2();
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
            seconds,
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
            (self.annulus.circumferential_elements * self.annulus.radial_elements) as f64;
        let each = factorization * (0.25 + 0.006 * followed as f64 + 0.4 * stable as f64);
        CycleCost {
            families,
            cycles: 1 + followed,
            // A few dense matrices of two unknowns for each phase, and of four for the perturbations.
            memory_bytes: families as f64 * 8.0 * 40.0 * phases * phases,
            seconds: families as f64 * (each + 2e-9 * elements * steps),
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
        let time_step = match transient.time_step {
            TimeStep::Seconds(step) => step,
            TimeStep::Auto => {
                let omega = self.highest_frequency();
                let zeta = self.damping.rayleigh.damping_factor(omega);
                2.0 / omega * ((1.0 + zeta * zeta).sqrt() - zeta)
            }
        };
        let steps = (transient.duration / time_step).ceil();
        let output = &self.output;
        let samples = transient.duration / output.sample_interval;
        let frames = match output.contact_interval {
            Some(interval) => transient.duration / interval,
            None => samples.min(10_000.0),
        };
        let contact_nodes = match self.annulus.element {
            ElementKind::Quad4 => self.annulus.circumferential_elements,
            ElementKind::Quad8 => 2 * self.annulus.circumferential_elements,
        } as f64;
        TransientCost {
            time_step,
            steps,
            // Ten nodal vectors, two for each snapshot; 400 bytes of energies and harmonics and 48 of each probe for a sample; the
            // status and two stresses of each contact node for a frame. A checkpoint holds the record once more.
            memory_bytes: (160.0 + 32.0 * output.snapshots.len() as f64) * nodes as f64
                + 2.0 * samples * (400.0 + 48.0 * output.probes.len() as f64)
                + 2.0 * frames * (100.0 + 9.0 * contact_nodes),
            seconds: 2e-9 * elements as f64 * steps,
        }
    }
}
