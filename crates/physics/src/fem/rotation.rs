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
/// `G` is skew and takes no power. Over all dofs, N s/m and N/m.
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
        for i in 0..count {
            for j in 0..count {
                let sum = &mut sums[i * count + j];
                sum[0] += weight * point.values[i] * point.values[j];
                sum[1] += weight * point.values[i] * slopes[j];
                sum[2] += weight * slopes[i] * slopes[j];
            }
            let pull = mesh.frame(nodes[i] as usize).transpose() * spin.velocity.cross(&velocity);
            for axis in 0..3 {
                let force = weight * point.values[i] * pull[axis];
                terms.centrifugal[3 * nodes[i] as usize + axis] -= force;
            }
        }
    }
    let across = spin.velocity.cross_matrix();
    for i in 0..count {
        for j in 0..count {
            let [mass, along, twice] = sums[i * count + j];
            let [gyroscopic, transport] = match spin.frame {
                RotationFrame::Rest => {
                    let skew = along - sums[j * count + i][1];
                    [skew, -twice].map(Matrix3::from_diagonal_element)
                }
                RotationFrame::Turning => [across * (2.0 * mass), across * across * mass],
            };
            add_block(mesh, [nodes[i], nodes[j]], &gyroscopic, &mut terms.gyroscopic);
            add_block(mesh, [nodes[i], nodes[j]], &transport, &mut terms.transport);
        }
    }
}

/// Adds what one node's displacement does at another, in their frames.
fn add_block(mesh: &Mesh, [i, j]: [u32; 2], block: &Matrix3<f64>, sum: &mut Triplets) {
    let [i, j] = [i, j].map(|node| node as usize);
    sum.push_block([3 * i, 3 * j], &(mesh.frame(i).transpose() * block * mesh.frame(j)));
}
