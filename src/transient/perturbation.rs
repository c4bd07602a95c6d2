//! The seed that decides which mode grows: a velocity added to that of the body.

use super::TransientError;
use crate::linalg::GaussianNoise;
use crate::mesh::AnnulusMesh;
use std::f64::consts::FRAC_PI_2;

/// One circumferential harmonic of a [`Perturbation`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StandingWave {
    /// Nodal diameters `n`.
    pub harmonic: usize,
    /// Amplitude `V_n`, m/s.
    pub velocity: f64,
    /// Phase `phi_n`, rad: a crest stands at the angle `phi_n / n`.
    pub phase: f64,
}

/// Velocity that is added to the body's, a sum over circumferential harmonics and a random part of every node.
///
/// ```text
/// v_theta(r, theta) = cos(pi/2 (r - a) / (b - a)) sum_n V_n cos(n theta - phi_n),   v_r = 0
/// ```
///
/// The waves are tangential only, so that they neither open nor press the contact; smooth, largest at the contact edge
/// and zero at the clamped one. A standing wave holds both travelling directions in equal parts. The random part has
/// independent normal components in both directions at every node that is not clamped.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Perturbation {
    /// The waves; none for a symmetric start.
    pub waves: Vec<StandingWave>,
    /// Standard deviation of each component of the random velocity, m/s.
    pub noise: f64,
    /// Seed of the random velocity.
    pub noise_seed: u64,
    /// When the velocity is added, s; moved to the nearest step.
    pub time: f64,
}

impl Perturbation {
    /// Waves of one amplitude (m/s) and no phase, at the start.
    pub fn of(harmonics: &[usize], velocity: f64) -> Self {
        let wave = |&harmonic: &usize| StandingWave {
            harmonic,
            velocity,
            phase: 0.0,
        };
        Self {
            waves: harmonics.iter().map(wave).collect(),
            ..Self::default()
        }
    }

    /// Harmonics of the waves.
    pub fn harmonics(&self) -> Vec<usize> {
        self.waves.iter().map(|wave| wave.harmonic).collect()
    }

    /// Velocity over all dofs of `annulus`, m/s.
    ///
    /// # Errors
    /// [`TransientError::HarmonicAboveNyquist`] for a harmonic above half the circumferential elements.
    pub fn field(&self, annulus: &AnnulusMesh) -> Result<Vec<f64>, TransientError> {
        let elements = annulus.specification.circumferential_elements;
        let limit = elements / 2;
        if let Some(wave) = self.waves.iter().find(|wave| wave.harmonic > limit) {
            return Err(TransientError::HarmonicAboveNyquist {
                harmonic: wave.harmonic,
                limit,
                elements,
            });
        }
        let mesh = &annulus.mesh;
        let mut velocity = vec![0.0; 2 * mesh.node_count()];
        self.add_waves(annulus, &mut velocity);
        self.add_noise(&mut velocity);
        for &node in &mesh.outer_edge.nodes {
            velocity[2 * node as usize..][..2].fill(0.0);
        }
        Ok(velocity)
    }

    fn add_waves(&self, annulus: &AnnulusMesh, velocity: &mut [f64]) {
        let (inner, outer) = (
            annulus.specification.inner_radius,
            annulus.specification.outer_radius,
        );
        // Amplitudes relative to the largest: waves of one amplitude have the factor one, exactly.
        let largest = self
            .waves
            .iter()
            .fold(0.0, |m: f64, w| m.max(w.velocity.abs()));
        if largest == 0.0 {
            return;
        }
        let nodes = annulus.mesh.nodes.iter().zip(&annulus.mesh.frame_angles);
        for (node, ([x, y], angle)) in nodes.enumerate() {
            let depth = (x.hypot(*y) - inner) / (outer - inner);
            let wave = |wave: &StandingWave| {
                (wave.velocity / largest) * (wave.harmonic as f64 * angle - wave.phase).cos()
            };
            let sum: f64 = self.waves.iter().map(wave).sum();
            velocity[2 * node + 1] = largest * (FRAC_PI_2 * depth).cos() * sum;
        }
    }

    fn add_noise(&self, velocity: &mut [f64]) {
        if self.noise == 0.0 {
            return;
        }
        let mut noise = GaussianNoise::new(self.noise_seed);
        for components in velocity.chunks_exact_mut(2) {
            let draw = noise.draw();
            components[0] += self.noise * draw.re;
            components[1] += self.noise * draw.im;
        }
    }
}
