//! Operation counts and typical rates behind the cost of each analysis.

use super::size::Size;
use super::{CeaCost, CycleCost, FrfCost, TransientCost};
use crate::case::{
    AssemblyBody, Body, Case, Cea, CeaMethod, Cycle, Frf, FrfMethod, ModeSelection, Revolution,
    StabilityChoice, TimeStep, Transient,
};
use crate::fem::ElasticMaterial;
use crate::frf::FrfBoundary;
use crate::mesh::SolidSpecification;
use crate::transient::{OperatorChoice, stable_step_limit};
use std::f64::consts::TAU;

/// Time of a complex multiplication and subtraction in the elimination of eight bands side by side, s.
const SOLID_LINE: f64 = 7e-10;

/// Friction steps of each value of a stability map.
const MAP_STEPS: usize = 9;

// Costs of eigenvalue analyses, fitted to the processor time of the shipped cases and of coarser and finer meshes of them.

/// Time of one eigenvalue of a plane annulus, s: at all, and for each unknown of a sector.
const CYCLIC_PAIR: [f64; 2] = [4.5e-4, 3e-7];

/// Time of one eigenvalue of a body of revolution, s: at all, and for each unknown of a sheet times its half bandwidth squared.
const SOLID_PAIR: [f64; 2] = [8e-4, 5e-9];

/// Memory of each harmonic of a body of revolution, bytes for each entry of its band.
const SOLID_BYTES: f64 = 600.0;

/// Time of the basis of a whole mesh, s: at all, and for each unknown and mode.
const SPARSE_BASIS: [f64; 2] = [1.0, 6e-6];

/// Time of each friction value in it, s: at all, and for each unknown and mode.
const SPARSE_VALUE: [f64; 2] = [0.15, 3e-7];

/// Memory of a whole mesh, bytes: at all, and for each unknown and vector of its basis.
const SPARSE_BYTES: [f64; 2] = [1e8, 100.0];

/// Memory (bytes) and time (s) of the factors of `n` unknowns of solid bodies, for each of `n^(4/3)`; measured on blocks of 20-node
/// bricks of 2e3 to 3e4 unknowns and on a brake of 8-node ones.
const SOLID_FACTOR: [f64; 2] = [1.4e3, 2.3e-5];

/// The same for each unknown and mode.
const SOLID_VECTOR: [f64; 2] = [240.0, 9e-6];

/// Time of each friction value on them, s: at all, and for each unknown and mode.
const SOLID_VALUE: [f64; 2] = [0.1, 3e-6];

/// Phases of a limit cycle where the mesh decides.
const LIKELY_PHASES: usize = 169;

/// Modes that grow where nobody knows yet.
const LIKELY_GROWING: usize = 2;

/// Periods that the search for a periodic motion and its multipliers take.
const PERIODS: [f64; 2] = [80.0, 60.0];

/// Steps of such a period.
const PERIOD_STEPS: f64 = 800.0;

/// Memory of the program itself, bytes, and of each unknown of a whole mesh that is stepped in time.
const PROGRAM_BYTES: f64 = 2.5e7;
const STEPPED_BYTES: f64 = 4e3;

/// Time of a step, s: for each unknown of a whole mesh, and for each element of sectors that are alike, of a plane body and of
/// one in three dimensions.
const SPARSE_STEP: f64 = 1.3e-8;
const SECTOR_STEP: [f64; 2] = [2e-9, 4.3e-8];

impl Case {
    pub(super) fn samples(&self) -> f64 {
        let duration = self.transient.as_ref().map_or(0.0, |run| run.duration);
        duration / self.output.sample_interval
    }

    /// Energies and harmonics, and the motion of each probe, of all samples.
    pub(super) fn sample_bytes(&self) -> f64 {
        self.samples() * (400.0 + 48.0 * self.output.probes.len() as f64)
    }

    /// Status and two stresses of each contact node in all frames.
    pub(super) fn frame_bytes(&self) -> f64 {
        let duration = self.transient.as_ref().map_or(0.0, |run| run.duration);
        let frames = match self.output.contact_interval {
            Some(interval) => duration / interval,
            None => self.samples().min(10_000.0),
        };
        // A status, and a normal stress and those along the contact in single precision.
        let each = 4.0 * self.body.dimension() as f64 + 1.0;
        frames * (100.0 + each * self.body.contact_node_count() as f64)
    }

    /// Displacements and velocities of all nodes at each snapshot.
    pub(super) fn snapshot_bytes(&self) -> f64 {
        let bytes = 16.0 * self.body.dimension() as f64 * self.body.node_count() as f64;
        bytes * self.output.snapshots.len() as f64
    }

    pub(super) fn cea_cost(&self, cea: &Cea, size: &Size) -> CeaCost {
        let friction_values = cea.solved_friction_coefficients().len();
        let modes = match cea.modes {
            ModeSelection::Lowest(modes) => modes,
            ModeSelection::BelowHz(limit) => self.modes_below(limit, size),
        };
        // Every value of a map has friction steps of its own.
        let map_values = cea.map.as_ref().map_or(0, |map| map.values.len());
        let values = (friction_values + map_values * MAP_STEPS) as f64;
        let pairs = values * modes as f64;
        let shapes = (modes * cea.shapes_at.len()) as f64;
        let (memory_bytes, seconds) = match (&self.body, cea.method) {
            (Body::Revolution(Revolution { specification, .. }), _) => {
                let sectors = specification.annulus.circumferential_elements.max(1);
                let unknowns = 3.0 * size.nodes as f64 / sectors as f64;
                let band = solid_half_bandwidth(specification);
                let waves = (modes as f64 / 4.0).max(3.0);
                (
                    SOLID_BYTES * waves * unknowns * band,
                    pairs * (SOLID_PAIR[0] + SOLID_PAIR[1] * unknowns * band * band),
                )
            }
            (Body::Annulus(annulus), CeaMethod::Auto | CeaMethod::Cyclic) => {
                let sectors = annulus.specification.circumferential_elements.max(1);
                let unknowns = 2.0 * size.nodes as f64 / sectors as f64;
                (
                    100.0 * unknowns * unknowns.min(200.0)
                        + 16.0 * shapes * 2.0 * size.nodes as f64
                        + pairs * (16.0 * unknowns + 600.0),
                    pairs * (CYCLIC_PAIR[0] + CYCLIC_PAIR[1] * unknowns),
                )
            }
            (Body::Assembly(_), _) => {
                let unknowns = 3.0 * size.nodes as f64;
                let (fill, vectors) = (unknowns.powf(4.0 / 3.0), unknowns * modes as f64);
                let value = SOLID_VALUE[0] + SOLID_VALUE[1] * vectors;
                let [bytes, times] =
                    [0, 1].map(|k| SOLID_FACTOR[k] * fill + SOLID_VECTOR[k] * vectors);
                (bytes, times + values * value)
            }
            (Body::Annulus(_) | Body::Imported(_), _) => {
                let unknowns = 2.0 * size.nodes as f64;
                let vectors = unknowns * modes as f64;
                let value = SPARSE_VALUE[0] + SPARSE_VALUE[1] * vectors;
                (
                    SPARSE_BYTES[0] + SPARSE_BYTES[1] * (2.0 * vectors + 40.0 * unknowns),
                    SPARSE_BASIS[0] + SPARSE_BASIS[1] * vectors + values * value,
                )
            }
        };
        CeaCost { friction_values, modes, memory_bytes: PROGRAM_BYTES + memory_bytes, seconds }
    }

    pub(super) fn cycle_cost(&self, cycle: &Cycle, size: &Size) -> CycleCost {
        if !self.has_rotating_waves() {
            return self.periodic_cost(cycle, size);
        }
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
        let elements = size.elements as f64;
        let each = factorization * (0.25 + 0.006 * followed as f64 + 0.4 * stable as f64);
        CycleCost {
            families,
            cycles: 1 + followed,
            // A few dense matrices of two unknowns for each phase, and of four for the perturbations.
            memory_bytes: PROGRAM_BYTES + families as f64 * 8.0 * 40.0 * phases * phases,
            seconds: families as f64 * (each + 2e-9 * elements * steps),
        }
    }

    /// Periodic motions of the whole mesh, each from the periods that it takes.
    fn periodic_cost(&self, cycle: &Cycle, size: &Size) -> CycleCost {
        let followed = cycle.continuation.as_ref().map_or(0, |range| range.count);
        let families = LIKELY_GROWING;
        let [search, multipliers] = PERIODS;
        let analysed = match cycle.stability {
            StabilityChoice::None => 0,
            StabilityChoice::Point => 1,
            StabilityChoice::Branch => 1 + followed,
        };
        let periods = search * (1 + followed) as f64
            + multipliers * analysed as f64
            + cycle.confirmation_periods as f64;
        let unknowns = self.body.dimension() as f64 * size.nodes as f64;
        CycleCost {
            families,
            cycles: 1 + followed,
            // Secants with their images and their basis, twice as long as there are unknowns, and the Krylov space.
            memory_bytes: PROGRAM_BYTES + families as f64 * 8.0 * 2.0 * unknowns * 250.0,
            seconds: families as f64 * periods * PERIOD_STEPS * SPARSE_STEP * unknowns,
        }
    }

    pub(super) fn frf_cost(&self, frf: &Frf, size: &Size) -> FrfCost {
        let dofs = self.body.dimension() as f64 * size.nodes as f64;
        let lines = frf.frequencies_hz.len();
        if let Body::Revolution(Revolution { specification, .. }) = &self.body {
            return self.solid_frf_cost(frf, specification, size.nodes);
        }
        let sectors = self.body.sector_count();
        let sectors = sectors.filter(|_| self.responds_by_harmonics(frf));
        let (bytes, each) = match (frf.method, sectors) {
            // One block band of a sector for each harmonic.
            (FrfMethod::Auto | FrfMethod::Cyclic, Some(sectors)) => {
                (100.0 * dofs / sectors.max(1) as f64, 2e-8 * dofs)
            }
            (FrfMethod::Reduced, _) => (24.0 * sparse_fill(dofs), 1e-5),
            // In three dimensions the factor fills as n^(4/3) and takes n^2 operations; eight lines share one.
            (_, _) if self.body.assembly().is_some() => {
                (24.0 * 6.0 * dofs.powf(4.0 / 3.0), 4e-9 * dofs * dofs / 8.0)
            }
            // Measured: a complex factorization takes 4 ns for each entry and its rows.
            (FrfMethod::Auto | FrfMethod::Cyclic | FrfMethod::Direct, _) => {
                (24.0 * sparse_fill(dofs), 3.5e-8 * sparse_fill(dofs))
            }
        };
        FrfCost {
            lines,
            memory_bytes: PROGRAM_BYTES + bytes + 64.0 * lines as f64,
            seconds: each * lines as f64,
        }
    }

    /// One band of three unknowns at each node of a sheet for each harmonic, complex, eliminated for each line; with friction
    /// the waves with and against the rotor differ.
    fn solid_frf_cost(&self, frf: &Frf, solid: &SolidSpecification, nodes: u128) -> FrfCost {
        let sectors = solid.annulus.circumferential_elements.max(1) as f64;
        let unknowns = 3.0 * nodes as f64 / sectors;
        let half_bandwidth = solid_half_bandwidth(solid);
        let waves = match frf.boundary {
            FrfBoundary::Sliding => sectors,
            FrfBoundary::Free | FrfBoundary::Clamped => 0.5 * sectors + 1.0,
        };
        let lines = frf.frequencies_hz.len();
        let entries = unknowns * (2.0 * half_bandwidth + 1.0);
        // Measured: see SOLID_LINE. Sixteen harmonics of three bands or 2^21 entries of each, and eight lines at a time.
        let held = (16.0 * entries).min(entries.max(f64::from(1 << 21)));
        FrfCost {
            lines,
            memory_bytes: PROGRAM_BYTES + 48.0 * held + 256.0 * entries + 64.0 * lines as f64,
            seconds: SOLID_LINE * lines as f64 * waves * unknowns * half_bandwidth.powi(2),
        }
    }

    /// Weyl's estimate of the number of modes below a frequency, see [`weyl`].
    fn modes_below(&self, limit_hz: f64, size: &Size) -> usize {
        let omega = TAU * limit_hz;
        let count = match &self.body {
            Body::Assembly(assembly) => solid_modes(assembly, omega),
            Body::Annulus(_) | Body::Imported(_) | Body::Revolution(_) => {
                let solid = self.body.revolution();
                let thickness = solid.map(|body| body.specification.thickness);
                weyl(&self.material, omega, self.body.area(), thickness)
            }
        };
        let most = usize::try_from(2 * size.nodes).unwrap_or(usize::MAX);
        (count as usize).clamp(1, most.max(1))
    }

    pub(super) fn transient_cost(&self, transient: &Transient, size: &Size) -> TransientCost {
        let stable_step = stable_step_limit(size.highest_frequency, &self.damping.rayleigh);
        let time_step = match transient.time_step {
            TimeStep::Seconds(step) => step,
            TimeStep::Auto => stable_step,
        };
        let steps = (transient.duration / time_step).ceil();
        let elements = size.elements as f64;
        let is_sparse = transient.operator == OperatorChoice::Sparse;
        let unknowns = self.body.dimension() as f64 * size.nodes as f64;
        let (each, operator_bytes) = match &self.body {
            Body::Revolution(_) => (SECTOR_STEP[1] * elements, 0.0),
            Body::Annulus(_) if !is_sparse => (SECTOR_STEP[0] * elements, 0.0),
            _ => (SPARSE_STEP * unknowns, STEPPED_BYTES * unknowns),
        };
        TransientCost {
            time_step,
            stable_step,
            steps,
            // Ten nodal vectors and the record, which a checkpoint holds once more.
            memory_bytes: PROGRAM_BYTES
                + 160.0 * size.nodes as f64
                + operator_bytes
                + self.snapshot_bytes()
                + 2.0 * (self.sample_bytes() + self.frame_bytes()),
            seconds: each * steps,
        }
    }
}

/// Weyl's estimate of the number of modes below an angular frequency: of motions in the plane
/// `A omega^2 / 4 pi (1 / c_p^2 + 1 / c_s^2)`, and of the bending of a plate, `A omega / 4 pi sqrt(rho h / D)` with
/// `D = E h^3 / 12 (1 - nu^2)`.
fn weyl(material: &ElasticMaterial, omega: f64, area: f64, thickness: Option<f64>) -> f64 {
    let [lambda, shear] = material.lame_constants();
    let (density, ratio) = (material.density, material.poisson_ratio);
    let slowness = density / (lambda + 2.0 * shear) + density / shear;
    let area = area / (2.0 * TAU);
    let bending = thickness.map_or(0.0, |thickness| {
        let stiffness = material.young_modulus * thickness.powi(3);
        let stiffness = stiffness / (12.0 * (1.0 - ratio * ratio));
        area * omega * (density * thickness / stiffness).sqrt()
    });
    area * omega * omega * slowness + bending
}

/// The same of solid bodies: each region as a plate of half its surface that has its volume, and with
/// `V omega^3 / 6 pi^2 (1 / c_p^3 + 2 / c_s^3)` as a piece of space.
fn solid_modes(assembly: &AssemblyBody, omega: f64) -> f64 {
    let mesh = &assembly.mesh;
    let mut surfaces = vec![Vec::new(); mesh.regions.len()];
    for face in mesh.outer_faces() {
        surfaces[mesh.region(face.element as usize)].push(face);
    }
    let volumes = mesh.region_measures();
    let regions = volumes.iter().zip(&surfaces).zip(&assembly.materials);
    let each = regions.map(|((volume, faces), material)| {
        let material = &material.own.elastic;
        // A region within others has no surface of its own.
        let area = (0.5 * mesh.face_area(faces)).max(volume.powf(2.0 / 3.0));
        let [lambda, shear] = material.lame_constants();
        let [pressure, shear] =
            [lambda + 2.0 * shear, shear].map(|m| (material.density / m).sqrt());
        let slowness = pressure.powi(3) + 2.0 * shear.powi(3);
        let inside = volume * omega.powi(3) * slowness / (1.5 * TAU * TAU);
        inside + weyl(material, omega, area, Some(volume / area))
    });
    each.sum()
}

/// Entries of the factor of a plane mesh under a minimum-degree ordering, measured: about
/// `9 n log2 n` of 12 bytes.
fn sparse_fill(dofs: f64) -> f64 {
    9.0 * dofs * dofs.max(2.0).log2()
}

/// Half the bandwidth of a harmonic of a body of revolution: neighbours in the numbering of a sheet, along its shorter side,
/// with 20 nodes in four rows.
fn solid_half_bandwidth(solid: &SolidSpecification) -> f64 {
    let short = solid.annulus.radial_elements.min(solid.axial_elements) as f64;
    3.0 * match solid.annulus.element.is_quadratic() {
        false => short + 3.0,
        true => 4.0 * short + 5.0,
    }
}
