//! Inertia of solid bodies that turn about an axis, in the frame at rest.

use super::element::ElementGeometry;
use super::{MaterialField, Triplets};
use crate::mesh::Mesh;

/// What the rotation of some regions adds to the equation of small motions.
///
/// A particle of a turning body of revolution stands at `x + u(x, t)`, `x` a place at rest; with `v = Omega x r` the operator
/// `d/dt + v . grad` takes its velocity, and twice its acceleration:
///
/// ```text
/// rho (d/dt + v . grad)^2 u = rho (u'' + 2 v . grad u' + (v . grad)^2 u)
/// G_IJ = ∫ rho (N_I v . grad N_J - N_J v . grad N_I) dV,   S_IJ = -∫ rho (v . grad N_I) (v . grad N_J) dV
/// ```
///
/// for each Cartesian component, by parts over the body, through whose surface `v` carries nothing: `G` is skew and takes no
/// power. Over all dofs, N s/m and N/m.
#[derive(Clone, Debug)]
pub struct RotationTerms {
    /// `G`: Coriolis and transport, times the velocity.
    pub gyroscopic: Triplets,
    /// `S`: transport twice, times the displacement.
    pub transport: Triplets,
    /// Centrifugal load `∫ rho N_I |Omega|^2 r dV`, N.
    pub centrifugal: Vec<f64>,
}

/// Velocity and acceleration of a place of a turning body, m/s and m/s2.
pub type Turning<'a> = dyn Fn([f64; 3]) -> [[f64; 3]; 2] + 'a;

/// The terms of the regions that turn; `turning` gives the motion of a region, `None` where it is at rest.
pub fn assemble_rotation<'a>(
    mesh: &Mesh,
    material: &dyn MaterialField,
    turning: &dyn Fn(usize) -> Option<&'a Turning<'a>>,
) -> RotationTerms {
    let mut terms = RotationTerms {
        gyroscopic: Triplets::default(),
        transport: Triplets::default(),
        centrifugal: vec![0.0; mesh.dof_count()],
    };
    for e in 0..mesh.element_count() {
        let region = mesh.region(e);
        if let Some(motion) = turning(region) {
            add_element(mesh, e, material.of(region).density, motion, &mut terms);
        }
    }
    terms
}

/// Adds one element. Nodes of solid bodies have the frame of the whole.
fn add_element(
    mesh: &Mesh,
    element: usize,
    density: f64,
    motion: &Turning<'_>,
    terms: &mut RotationTerms,
) {
    let geometry = ElementGeometry::new(mesh, element);
    let nodes = mesh.element_nodes(element);
    let count = nodes.len();
    let mut along = vec![0.0; count * count];
    let mut twice = vec![0.0; count * count];
    for point in geometry.integration_points() {
        let [velocity, acceleration] = motion(geometry.position(&point));
        let weight = density * point.measure;
        let slopes = point.gradients.iter();
        let slopes: Vec<f64> = slopes
            .map(|g| g.x * velocity[0] + g.y * velocity[1] + g.z * velocity[2])
            .collect();
        for i in 0..count {
            for j in 0..count {
                along[i * count + j] += weight * point.values[i] * slopes[j];
                twice[i * count + j] += weight * slopes[i] * slopes[j];
            }
            for (axis, a) in acceleration.iter().enumerate() {
                terms.centrifugal[3 * nodes[i] as usize + axis] -= weight * point.values[i] * a;
            }
        }
    }
    // The same for each component.
    for i in 0..count {
        for j in 0..count {
            let skew = along[i * count + j] - along[j * count + i];
            for axis in 0..3 {
                let [row, column] = [i, j].map(|k| 3 * nodes[k] as usize + axis);
                if i != j {
                    terms.gyroscopic.push(row, column, skew);
                }
                terms.transport.push(row, column, -twice[i * count + j]);
            }
        }
    }
}
