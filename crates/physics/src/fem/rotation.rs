//! Inertia of solid bodies that turn about an axis.

use super::element::ElementGeometry;
use super::{MaterialField, Triplets};
use crate::mesh::Mesh;
use nalgebra::{Matrix3, Vector3};

/// The frame in which the motion of a turning body is described.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RotationFrame {
    /// At rest: the body passes through its mesh. It is one of revolution; its supports and contacts are at rest.
    #[default]
    Rest,
    /// It turns with the body, whose supports turn too. Any body.
    Turning,
}

/// How a body turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin {
    /// `Omega`, rad/s.
    pub velocity: Vector3<f64>,
    /// A point of the axis, m.
    pub center: [f64; 3],
    /// The frame of its equations.
    pub frame: RotationFrame,
}

impl Spin {
    /// `Omega x r` at a place, m/s.
    pub fn velocity_at(&self, place: [f64; 3]) -> Vector3<f64> {
        let arm = Vector3::from(place) - Vector3::from(self.center);
        self.velocity.cross(&arm)
    }

    /// Coriolis and centrifugal terms of a mass in the turning frame, `2 m [Omega x]`, N s/m, and `m [Omega x]^2`, N/m.
    pub fn of_mass(&self, mass: f64) -> [Matrix3<f64>; 2] {
        let across = self.velocity.cross_matrix();
        [across * (2.0 * mass), across * across * mass]
    }
}

/// What the rotation of some regions adds to the equation of small motions.
///
/// In the frame at rest a particle of a turning body of revolution stands at `x + u(x, t)`, `x` a place at rest; with
/// `v = Omega x r` the operator `d/dt + v . grad` takes its velocity, and twice its acceleration:
///
/// ```text
/// rho (d/dt + v . grad)^2 u = rho (u'' + 2 v . grad u' + (v . grad)^2 u)
/// G_IJ = ∫ rho (N_I v . grad N_J - N_J v . grad N_I) dV,   S_IJ = -∫ rho (v . grad N_I) (v . grad N_J) dV
/// ```
///
/// for each Cartesian component, by parts over the body, through whose surface `v` carries nothing. In the turning frame
///
/// ```text
/// rho (u'' + 2 Omega x u' + Omega x (Omega x u)),   G_IJ = 2 ∫ rho N_I N_J dV [Omega x],   S_IJ = ∫ rho N_I N_J dV [Omega x]^2.
/// ```
///
/// `G` is skew and takes no power. Over all dofs, N s/m and N/m; point masses have theirs in the turning frame.
#[derive(Clone, Debug)]
pub struct RotationTerms {
    /// `G`: Coriolis and transport, times the velocity.
    pub gyroscopic: Triplets,
    /// `S`: transport twice or the centrifugal force's growth with the radius, times the displacement.
    pub transport: Triplets,
    /// Centrifugal load `∫ rho N_I |Omega|^2 r dV`, N.
    pub centrifugal: Vec<f64>,
}

/// The terms of the regions that turn; `turning` gives how a region does, `None` where it is at rest.
pub fn assemble_rotation(
    mesh: &Mesh,
    material: &dyn MaterialField,
    turning: &dyn Fn(usize) -> Option<Spin>,
) -> RotationTerms {
    let mut terms = RotationTerms {
        gyroscopic: Triplets::default(),
        transport: Triplets::default(),
        centrifugal: vec![0.0; mesh.dof_count()],
    };
    for e in 0..mesh.element_count() {
        let region = mesh.region(e);
        if let Some(spin) = turning(region) {
            add_element(mesh, e, material.of(region).density, &spin, &mut terms);
        }
    }
    // A frame that turns does so with all regions, and with what is attached to them.
    if let Some(spin) = turning(0).filter(|spin| spin.frame == RotationFrame::Turning) {
        for own in &mesh.attachments {
            add_blocks(mesh, [own.node; 2], (&spin, own.mass), spin.of_mass(own.mass), &mut terms);
        }
    }
    terms
}

/// Adds one element, and its load. Vectors are those of the nodes' frames.
fn add_element(mesh: &Mesh, element: usize, density: f64, spin: &Spin, terms: &mut RotationTerms) {
    let geometry = ElementGeometry::new(mesh, element);
    let nodes = mesh.element_nodes(element);
    let count = nodes.len();
    // `∫ rho N_I N_J`, `∫ rho N_I v . grad N_J` and `∫ rho (v . grad N_I) (v . grad N_J)`.
    let mut sums = vec![[0.0; 3]; count * count];
    for point in geometry.integration_points() {
        let velocity = spin.velocity_at(geometry.position(&point));
        let weight = density * point.measure;
        let slopes: Vec<f64> = point.gradients.iter().map(|g| g.dot(&velocity)).collect();
        for (k, sum) in sums.iter_mut().enumerate() {
            let (i, j) = (k / count, k % count);
            sum[0] += weight * point.values[i] * point.values[j];
            sum[1] += weight * point.values[i] * slopes[j];
            sum[2] += weight * slopes[i] * slopes[j];
        }
    }
    for (k, &[mass, along, twice]) in sums.iter().enumerate() {
        let (i, j) = (k / count, k % count);
        let blocks = match spin.frame {
            RotationFrame::Rest => {
                let skew = along - sums[j * count + i][1];
                [skew, -twice].map(Matrix3::from_diagonal_element)
            }
            RotationFrame::Turning => spin.of_mass(mass),
        };
        add_blocks(mesh, [i, j].map(|i| nodes[i] as usize), (spin, mass), blocks, terms);
    }
}

/// Adds `[G, S]` of what a node's displacement does at another, and the load of the mass that they share, in their frames.
fn add_blocks(
    mesh: &Mesh,
    [i, j]: [usize; 2],
    (spin, mass): (&Spin, f64),
    blocks: [Matrix3<f64>; 2],
    terms: &mut RotationTerms,
) {
    let turn = mesh.frame(i).transpose();
    for (sum, block) in [&mut terms.gyroscopic, &mut terms.transport].into_iter().zip(blocks) {
        sum.push_block([3 * i, 3 * j], &(turn * block * mesh.frame(j)));
    }
    // - m Omega x (Omega x r).
    let inertia = turn * spin.velocity.cross(&(spin.velocity_at(mesh.nodes[j]) * mass));
    (0..3).for_each(|axis| terms.centrifugal[3 * i + axis] -= inertia[axis]);
}
