//! Size of a mesh, as the cost estimates need it.

use crate::{BodyKind, Case};
use frictionsim_physics::fem::{ElasticMaterial, MaterialField, RegionMaterial};
use frictionsim_physics::mesh::{AnnulusSpecification, Mesh};
use std::f64::consts::TAU;

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
        Self { nodes: body.node_count(), elements: body.element_count(), highest_frequency }
    }

    /// The size of a mesh of some dimension whose elements are split to be `factor` times as fine.
    pub fn refined(&self, factor: f64, dimension: usize) -> Self {
        let times = |count: u128| (count as f64 * factor.powi(dimension as i32)) as u128;
        Self {
            nodes: times(self.nodes),
            elements: times(self.elements),
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

/// The highest of all elements of a mesh.
fn highest(mesh: &Mesh, materials: &[RegionMaterial], of: fn(&Mesh, usize, f64) -> f64) -> f64 {
    let speed = |element| pressure_wave_speed(&materials[mesh.region(element)].elastic);
    let each = (0..mesh.element_count()).map(|element| of(mesh, element, speed(element)));
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
    let order = if kind.is_quadratic() { QUADRATIC } else { 1.0 };
    2.0 * order * speed * (1.0 / short).hypot(1.0 / long)
}

/// The same of one solid element, as of a cube of its shortest edge.
fn solid_frequency(mesh: &Mesh, element: usize, speed: f64) -> f64 {
    let (kind, nodes) = (mesh.element_kind(element), mesh.element_nodes(element));
    let place = |corner: usize| nalgebra::Vector3::from(mesh.nodes[nodes[corner] as usize]);
    let lengths = kind.edges().iter().map(|&[a, b]| (place(a) - place(b)).norm());
    let shortest = lengths.fold(f64::INFINITY, f64::min);
    let finer = if kind.is_quadratic() { QUADRATIC } else { 1.0 };
    2.0 * finer * speed * 3.0_f64.sqrt() / shortest
}
