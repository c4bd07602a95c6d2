//! The size of a mesh, and the operation counts and memory behind the cost of each analysis.

use super::{CeaCost, CycleCost, FrfCost, RunCost, TransientCost};
use crate::*;
use crate::{
    BodyKind, Cea, CeaMethod, Cycle, Frf, FrfMethod, ModeLimit, StabilityChoice, TimeStep,
    Transient,
};
use frictionsim_physics::cycle::BasinRequest;
use frictionsim_physics::linalg::SparsityPattern;
use frictionsim_physics::transient::stable_step_limit;

/// Operations for each eigenvalue of a harmonic: iterations, residual, its branch over friction.
const HARMONIC_PAIR: f64 = 5e5;

/// Operations for each unknown and mode of a whole mesh: for the basis, and for each friction value in it.
const WHOLE_MESH: [f64; 2] = [8e3, 1e3];

/// Memory of each harmonic of a body of revolution, bytes for each entry of its band.
const SOLID_BYTES: f64 = 600.0;

/// Memory of a whole plane mesh, measured from 40 to 15,000 unknowns, bytes: for each unknown, for each mode, and for
/// each unknown and mode.
const SPARSE_BYTES: [f64; 3] = [1.8e4, 1.2e6, 360.0];

/// Memory of solid bodies, measured from 1e3 to 6e4 unknowns: bytes for each entry of the factors, which are complex
/// and general at times, and for each mode and unknown up to so many, for each more of these.
const FACTOR_BYTES: f64 = 70.0;
const VECTOR_BYTES: [f64; 3] = [1000.0, 4e3, 160.0];
/// Operations at each friction value for `e` entries of their factors, for each of `e^(3/2)`.
const FACTORS: f64 = 0.2;

/// Phases of a limit cycle where the mesh decides.
const LIKELY_PHASES: usize = 169;

/// Modes that grow where nobody knows yet.
const LIKELY_GROWING: usize = 2;

/// Periods that the search for a periodic motion and its multipliers take.
const PERIODS: [f64; 2] = [80.0, 100.0];

/// Steps of such a period.
const PERIOD_STEPS: f64 = 800.0;

/// Memory of the program itself, bytes, and of each unknown of a whole mesh that is stepped in time.
const PROGRAM_BYTES: f64 = 2.5e7;
const STEPPED_BYTES: f64 = 4e3;

/// Operations of a step for each unknown: of a plane body of equal sectors, and of any other.
const STEP: [f64; 2] = [1.0, 13.0];

/// Steps of the transients that find the boundary of two basins, for each period of one: some eight.
const BASIN_STEPS: f64 = 8.0 * PERIOD_STEPS;

impl Case {
    /// Bytes of the record of a transient: of all samples, of all frames of the contact, of all snapshots.
    pub(super) fn record_bytes(&self) -> [f64; 3] {
        let duration = self.transient.as_ref().map_or(0.0, |run| run.settings.duration);
        let samples = duration / self.output.sample_interval;
        let recorder = &self.output.recorder;
        let frames = recorder.contact_interval.map_or(samples.min(10_000.0), |own| duration / own);
        let dimension = self.body.dimension() as f64;
        // Energies and harmonics, and the motion of each probe.
        let sample = 400.0 + 48.0 * recorder.probes.len() as f64;
        // Of a contact node a status, and a normal stress and those along the contact in single precision.
        let each = 4.0 * dimension + 1.0;
        let frame = 100.0 + each * self.body.contact_node_count() as f64;
        // Displacements and velocities of all nodes.
        let snapshot = 16.0 * dimension * self.body.node_count() as f64;
        [samples * sample, frames * frame, snapshot * recorder.snapshots.len() as f64]
    }

    pub(super) fn cea_cost(&self, cea: &Cea, size: &Size) -> CeaCost {
        let friction_values = cea.solved_friction_coefficients().len();
        let modes = match cea.modes {
            ModeLimit::Lowest(modes) => modes,
            ModeLimit::MaxFrequency(limit) => self.modes_below(limit, size),
        };
        let pairs = friction_values as f64 * modes as f64;
        let shapes = (modes * cea.shapes_at.len()) as f64;
        let unknowns = size.unknowns;
        let (memory_bytes, operations) = match (&self.body.kind, cea.method) {
            (BodyKind::Revolution(solid), _) => {
                let sectors = solid.annulus.circumferential_elements.max(1);
                let (unknowns, band) = (unknowns / sectors as f64, solid_half_bandwidth(solid));
                let waves = (modes as f64 / 4.0).max(3.0);
                let factorization = 5.0 * unknowns * band * band;
                (SOLID_BYTES * waves * unknowns * band, pairs * (HARMONIC_PAIR + factorization))
            }
            (BodyKind::Annulus(annulus), CeaMethod::Auto | CeaMethod::Cyclic) => {
                let sectors = annulus.circumferential_elements.max(1);
                let sector = unknowns / sectors as f64;
                let bytes = 100.0 * sector * sector.min(200.0) + 16.0 * shapes * unknowns;
                (bytes + pairs * (16.0 * sector + 600.0), pairs * HARMONIC_PAIR)
            }
            _ => {
                let (vectors, values) = (unknowns * modes as f64, friction_values as f64);
                let [each, mode, both] = SPARSE_BYTES;
                let (bytes, factors) = match &self.body.kind {
                    BodyKind::Assembly(own) => {
                        let entries = factor_entries(&own.mesh, unknowns);
                        let [each, few, next] = VECTOR_BYTES;
                        let vector = each * unknowns.min(few) + next * (unknowns - few).max(0.0);
                        let is_waves = own.mesh.symmetry.is_some();
                        let are_real = !is_waves && !self.body.has_structural_damping();
                        let parts = if are_real { 1.0 } else { 2.0 }; // Real and imaginary ones.
                        let bytes = FACTOR_BYTES * entries + vector * modes as f64;
                        (parts * bytes, FACTORS * values * entries.powf(1.5))
                    }
                    _ => (each * unknowns + mode * modes as f64 + both * vectors, 0.0),
                };
                (bytes, factors + vectors * (WHOLE_MESH[0] + WHOLE_MESH[1] * values))
            }
        };
        let run = RunCost { memory_bytes: PROGRAM_BYTES + memory_bytes, operations };
        CeaCost { friction_values, modes, run }
    }

    pub(super) fn cycle_cost(&self, cycle: &Cycle, size: &Size) -> CycleCost {
        let followed = cycle.continuation.as_ref().map_or(0, |range| range.count);
        // Cycles whose stability is worked out, of one and those that follow it along a branch.
        let analysed = match cycle.stability {
            StabilityChoice::None => 0,
            StabilityChoice::Point => 1,
            StabilityChoice::Branch => 1 + followed,
        } as f64;
        let (unknowns, confirmed) = (size.unknowns, cycle.confirmation_periods as f64);
        let (families, bytes, operations) = if self.has_rotating_waves() {
            let families = cycle.harmonics.as_ref().map_or(2, Vec::len);
            let phases = cycle.phases.unwrap_or(LIKELY_PHASES) as f64;
            // Dense factorizations: of the search from birth, and of the exponents.
            let dense = phases.powi(3) * (50.0 + followed as f64 + 80.0 * analysed);
            // A few dense matrices of two unknowns for each phase, and of four for the perturbations.
            let bytes = 8.0 * 40.0 * phases * phases;
            (families, bytes, dense + STEP[0] * unknowns * confirmed * PERIOD_STEPS)
        } else {
            // Periodic motions of the whole mesh, each from the periods that it takes.
            let [search, multipliers] = PERIODS;
            let periods = search * (1 + followed) as f64 + multipliers * analysed + confirmed;
            // Secants with their images and their basis, twice as long as there are unknowns, and the Krylov space.
            let bytes = 8.0 * 2.0 * unknowns * 250.0;
            (LIKELY_GROWING, bytes, periods * PERIOD_STEPS * STEP[1] * unknowns)
        };
        let (count, memory_bytes) = (families as f64, PROGRAM_BYTES + families as f64 * bytes);
        let run = RunCost { memory_bytes, operations: count * operations };
        CycleCost { families, cycles: 1 + followed, run }
    }

    pub(super) fn basin_cost(&self, basin: &BasinRequest, size: &Size) -> RunCost {
        let steps = BASIN_STEPS * basin.periods as f64;
        // A few fields, less than the mesh.
        RunCost { memory_bytes: 0.0, operations: STEP[0] * size.unknowns * steps }
    }

    pub(super) fn frf_cost(&self, frf: &Frf, size: &Size) -> FrfCost {
        let (dofs, lines) = (size.unknowns, frf.frequencies_hz.len());
        let sectors = self.body.sector_count().filter(|_| self.responds_by_harmonics(frf));
        // Entries of the factor of a plane mesh under a minimum-degree ordering, 12 bytes each, as measured.
        let fill = 9.0 * dofs * dofs.max(2.0).log2();
        let (bytes, each) = match (frf.method, sectors, &self.body.kind) {
            (_, _, BodyKind::Revolution(solid)) => solid_frf_cost(frf, solid, dofs),
            // One block band of a sector for each harmonic.
            (FrfMethod::Auto | FrfMethod::Cyclic, Some(sectors), _) => {
                (100.0 * dofs / sectors.max(1) as f64, 20.0 * dofs)
            }
            (FrfMethod::Reduced, ..) => (24.0 * fill, 1e4),
            // In three dimensions eight lines share one factor.
            (_, _, BodyKind::Assembly(own)) => {
                let entries = factor_entries(&own.mesh, dofs);
                (FACTOR_BYTES * entries, FACTORS / 8.0 * entries.powf(1.5))
            }
            // A complex factorization takes some operations for each entry and its rows.
            (FrfMethod::Auto | FrfMethod::Cyclic | FrfMethod::Direct, ..) => {
                (24.0 * fill, 35.0 * fill)
            }
        };
        let memory_bytes = PROGRAM_BYTES + bytes + 64.0 * lines as f64;
        FrfCost { lines, run: RunCost { memory_bytes, operations: each * lines as f64 } }
    }

    /// Weyl's estimate of the number of modes below a frequency, see [`weyl`].
    fn modes_below(&self, limit_hz: f64, size: &Size) -> usize {
        let omega = TAU * limit_hz;
        let count = match self.body.assembly() {
            Some(own) => solid_modes(&own.mesh, &self.body.materials, omega),
            None => {
                let thickness = self.body.revolution().map(|solid| solid.thickness);
                weyl(&self.material, omega, self.body.area(), thickness)
            }
        };
        count.clamp(1.0, 2.0 * size.nodes.max(1) as f64) as usize
    }

    pub(super) fn transient_cost(&self, transient: &Transient, size: &Size) -> TransientCost {
        let stable_step = stable_step_limit(size.highest_frequency, &self.damping.rayleigh);
        let time_step = match transient.settings.time_step {
            TimeStep::Seconds(step) => step,
            TimeStep::Auto => stable_step,
        };
        let steps = (transient.settings.duration / time_step).ceil();
        let is_sparse = transient.operator == OperatorChoice::Sparse;
        let unknowns = size.unknowns;
        let (each, operator_bytes) = match self.body.kind {
            BodyKind::Revolution(_) => (STEP[1], 0.0),
            BodyKind::Annulus(_) if !is_sparse => (STEP[0], 0.0),
            _ => (STEP[1], STEPPED_BYTES * unknowns),
        };
        // Ten nodal vectors and the record, which a checkpoint holds once more.
        let [samples, frames, snapshots] = self.record_bytes();
        let held = 160.0 * size.nodes as f64 + snapshots + 2.0 * (samples + frames);
        let memory_bytes = PROGRAM_BYTES + operator_bytes + held;
        let run = RunCost { memory_bytes, operations: each * unknowns * steps };
        TransientCost { time_step, stable_step, steps: steps as u64, run }
    }
}

/// Bytes, and operations of each line: one band of three unknowns at each node of a sheet for each harmonic, complex,
/// eliminated for each line; with friction the waves with and against the rotor differ.
fn solid_frf_cost(frf: &Frf, solid: &SolidSpecification, dofs: f64) -> (f64, f64) {
    let sectors = solid.annulus.circumferential_elements.max(1) as f64;
    let unknowns = dofs / sectors;
    let half_bandwidth = solid_half_bandwidth(solid);
    let is_sliding = frf.boundary == FrfBoundary::Sliding;
    let waves = if is_sliding { sectors } else { 0.5 * sectors + 1.0 };
    let entries = unknowns * (2.0 * half_bandwidth + 1.0);
    // Sixteen harmonics of three bands or 2^21 entries of each, and eight lines at a time.
    let held = (16.0 * entries).min(entries.max(f64::from(1 << 21)));
    (48.0 * held + 256.0 * entries, waves * unknowns * half_bandwidth.powi(2))
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
fn solid_modes(mesh: &Mesh, materials: &[RegionMaterial], omega: f64) -> f64 {
    let mut surfaces = vec![Vec::new(); mesh.regions.len()];
    for face in mesh.outer_faces() {
        surfaces[mesh.region(face.element as usize)].push(face);
    }
    let volumes = mesh.region_measures();
    let each = volumes.iter().zip(&surfaces).zip(materials).map(|((volume, faces), material)| {
        let material = &material.elastic;
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

/// Entries of the factors of solid bodies: the unknowns at a node are coupled to those of the nodes of its elements.
/// With other numbers of `unknowns` they grow as `n^(4/3)`.
fn factor_entries(mesh: &Mesh, unknowns: f64) -> f64 {
    let pairs = (0..mesh.element_count()).flat_map(|element| {
        let nodes = mesh.element_nodes(element);
        nodes.iter().flat_map(|&i| nodes.iter().map(move |&j| (i as usize, j as usize)))
    });
    let pattern = SparsityPattern::from_positions(mesh.nodes.len(), pairs);
    let own = pattern.factor_entry_count().map_or(f64::INFINITY, |own| own as f64);
    9.0 * own * (unknowns / mesh.dof_count() as f64).powf(4.0 / 3.0)
}

/// Half the bandwidth of a harmonic of a body of revolution: neighbours in the numbering of a sheet, along its shorter
/// side, with 20 nodes in four rows.
fn solid_half_bandwidth(solid: &SolidSpecification) -> f64 {
    let short = solid.annulus.radial_elements.min(solid.axial_elements) as f64;
    3.0 * if solid.annulus.element.is_quadratic() { 4.0 * short + 5.0 } else { short + 3.0 }
}

/// Highest frequency of a quadratic element over that of a linear one of its size, about: its nodes lie half as far
/// apart, and its lumped mass is uneven.
const QUADRATIC: f64 = 2.5;

/// Size of a mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    /// Nodes.
    pub nodes: u128,
    /// Elements.
    pub elements: u128,
    /// Components of all displacements, before the clamped edge is taken out.
    pub unknowns: f64,
    /// Highest frequency that the mesh can hold, rad/s.
    pub highest_frequency: f64,
}

impl Size {
    /// The size of the case's own mesh.
    pub fn of(case: &Case) -> Self {
        let (body, materials) = (&case.body, &case.body.materials);
        let highest_frequency = match &body.kind {
            BodyKind::Annulus(grid) => {
                let of_disc = grid_frequency(grid, materials.of(0), 0.0);
                let shaft = materials.get(1).map(|shaft| &shaft.elastic);
                of_disc.max(shaft_frequency(grid, shaft))
            }
            BodyKind::Revolution(solid) => {
                let through = solid.axial_elements as f64 / solid.thickness;
                let of =
                    |own: &RegionMaterial| grid_frequency(&solid.annulus, &own.elastic, through);
                materials.iter().map(of).fold(0.0, f64::max)
            }
            BodyKind::Imported(own) => highest(&own.mesh, materials, element_frequency),
            BodyKind::Assembly(own) => highest(&own.mesh, materials, solid_frequency),
        };
        let (nodes, elements) = (body.node_count(), body.element_count());
        Self {
            nodes,
            elements,
            unknowns: body.dimension() as f64 * nodes as f64,
            highest_frequency,
        }
    }

    /// The size of a mesh of some dimension whose elements are split to be `factor` times as fine.
    pub fn refined(&self, factor: f64, dimension: usize) -> Self {
        let finer = factor.powi(dimension as i32);
        let times = |count: u128| (count as f64 * finer) as u128;
        Self {
            nodes: times(self.nodes),
            elements: times(self.elements),
            unknowns: dimension as f64 * times(self.nodes) as f64,
            highest_frequency: factor * self.highest_frequency,
        }
    }
}

/// `sqrt((lambda + 2 G) / rho)`, m/s.
fn pressure_wave_speed(material: &ElasticMaterial) -> f64 {
    let [lambda, shear] = material.lame_constants();
    ((lambda + 2.0 * shear) / material.density).sqrt()
}

/// Highest frequency of a generated disc, rad/s, from the pressure-wave speed and the smallest element:
/// `omega = 2 c_p sqrt(1 / h_r^2 + 1 / h_theta^2 + 1 / h_z^2)`, with `through = 1 / h_z`.
fn grid_frequency(grid: &AnnulusSpecification, material: &ElasticMaterial, through: f64) -> f64 {
    let count = grid.radial_elements as f64;
    let width = grid.outer_radius - grid.inner_radius;
    let log = grid.radial_grading.ln();
    let first =
        if log == 0.0 { width / count } else { width * log.exp_m1() / (count * log).exp_m1() };
    let last = first * ((count - 1.0) * log).exp();
    let around = |radius: f64| TAU * radius / grid.circumferential_elements as f64;
    let inner = (1.0 / first).hypot(1.0 / around(grid.inner_radius + 0.5 * first));
    let outer = (1.0 / last).hypot(1.0 / around(grid.outer_radius - 0.5 * last));
    2.0 * pressure_wave_speed(material) * inner.max(outer).hypot(through)
}

/// The same of the shaft in it; 0 where there is none.
fn shaft_frequency(grid: &AnnulusSpecification, material: Option<&ElasticMaterial>) -> f64 {
    grid.shaft.zip(material).map_or(0.0, |(shaft, material)| {
        let width = grid.inner_radius - shaft.inner_radius;
        let radial = shaft.radial_elements as f64 / width;
        let radius = shaft.inner_radius + 0.5 / radial;
        let around = grid.circumferential_elements as f64 / (TAU * radius);
        2.0 * pressure_wave_speed(material) * radial.hypot(around)
    })
}

/// The highest of all elements of a mesh, of which one gives its own for a number times the speed of its waves.
fn highest(mesh: &Mesh, materials: &[RegionMaterial], of: fn(&Mesh, usize, f64) -> f64) -> f64 {
    let each = (0..mesh.element_count()).map(|element| {
        let order = if mesh.element_kind(element).is_quadratic() { QUADRATIC } else { 1.0 };
        let speed = pressure_wave_speed(&materials[mesh.region(element)].elastic);
        of(mesh, element, 2.0 * order * speed)
    });
    each.fold(0.0, f64::max)
}

/// The same of one element, whose sides are its longest one and its area over that.
fn element_frequency(mesh: &Mesh, element: usize, speed: f64) -> f64 {
    let kind = mesh.element_kind(element);
    let corners = &mesh.element_nodes(element)[..kind.corner_count()];
    let place = |corner: usize| mesh.plane_node(corners[corner % corners.len()] as usize);
    let side = |corner: usize| {
        let ([x, y], [to_x, to_y]) = (place(corner), place(corner + 1));
        (to_x - x).hypot(to_y - y)
    };
    let long = (0..corners.len()).map(side).fold(0.0, f64::max);
    let short = mesh.element_measure(element) / long;
    speed * (1.0 / short).hypot(1.0 / long)
}

/// The same of one solid element, as of a cube of its shortest edge.
fn solid_frequency(mesh: &Mesh, element: usize, speed: f64) -> f64 {
    let (kind, nodes) = (mesh.element_kind(element), mesh.element_nodes(element));
    let place = |corner: usize| nalgebra::Vector3::from(mesh.nodes[nodes[corner] as usize]);
    let lengths = kind.edges().iter().map(|&[a, b]| (place(a) - place(b)).norm());
    let shortest = lengths.fold(f64::INFINITY, f64::min);
    speed * 3.0_f64.sqrt() / shortest
}
