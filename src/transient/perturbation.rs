//! The initial velocity that decides which mode grows.

use super::TransientError;
use crate::mesh::AnnulusMesh;
use std::f64::consts::FRAC_PI_2;

/// Initial velocity of the body, a sum over circumferential harmonics.
///
/// ```text
/// v_theta(r, theta) = V cos(pi/2 (r - a) / (b - a)) sum_n cos(n theta),   v_r = 0
/// ```
///
/// Tangential only, so that it neither opens nor presses the contact; smooth, largest at the contact edge and
/// zero at the clamped one. A standing `cos(n theta)` holds both travelling directions in equal parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Perturbation {
    /// Harmonics `n`; none for a symmetric start.
    pub harmonics: Vec<usize>,
    /// Amplitude `V` of each, m/s.
    pub velocity: f64,
}

impl Perturbation {
    /// Velocity over all dofs of `annulus`, m/s.
    ///
    /// # Errors
    /// [`TransientError::HarmonicAboveNyquist`] for a harmonic above half the circumferential elements.
    pub fn field(&self, annulus: &AnnulusMesh) -> Result<Vec<f64>, TransientError> {
        let elements = annulus.specification.circumferential_elements;
        let limit = elements / 2;
        if let Some(&harmonic) = self.harmonics.iter().find(|&&n| n > limit) {
            return Err(TransientError::HarmonicAboveNyquist {
                harmonic,
                limit,
                elements,
            });
        }
        let mesh = &annulus.mesh;
        let (inner, outer) = (
            annulus.specification.inner_radius,
            annulus.specification.outer_radius,
        );
        let mut velocity = vec![0.0; 2 * mesh.node_count()];
        for (node, ([x, y], angle)) in mesh.nodes.iter().zip(&mesh.frame_angles).enumerate() {
            let depth = (x.hypot(*y) - inner) / (outer - inner);
            let waves: f64 = self
                .harmonics
                .iter()
                .map(|&n| (n as f64 * angle).cos())
                .sum();
            velocity[2 * node + 1] = self.velocity * (FRAC_PI_2 * depth).cos() * waves;
        }
        for &node in &mesh.outer_edge.nodes {
            velocity[2 * node as usize + 1] = 0.0;
        }
        Ok(velocity)
    }
}
