//! The seed that decides which mode grows: a velocity added to that of the body.

use super::TransientError;
use crate::contact::ContactInterface;
use crate::linalg::GaussianNoise;
use crate::mesh::{AnnulusMesh, Counterface, Mesh};
use std::f64::consts::{FRAC_PI_2, TAU};

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
        let wave = |&harmonic: &usize| StandingWave { harmonic, velocity, phase: 0.0 };
        Self { waves: harmonics.iter().map(wave).collect(), ..Self::default() }
    }

    /// Harmonics of the waves.
    pub fn harmonics(&self) -> Vec<usize> {
        self.waves.iter().map(|wave| wave.harmonic).collect()
    }

    /// [`Self::field`] over a mesh, which may belong to an annulus.
    pub(super) fn over(
        &self,
        mesh: &Mesh,
        annulus: Option<&AnnulusMesh>,
    ) -> Result<Vec<f64>, TransientError> {
        let elements = match annulus {
            Some(annulus) => annulus.specification.circumferential_elements,
            None => ContactInterface::of(mesh).len(),
        };
        self.check_harmonics(elements)?;
        let mut velocity = vec![0.0; 2 * mesh.node_count()];
        match annulus {
            Some(annulus) => self.add_waves(&places_on(annulus), mesh, &mut velocity),
            None => self.add_waves(&places(mesh), mesh, &mut velocity),
        }
        self.add_noise(&mut velocity, 2);
        mesh.held_dofs().for_each(|dof| velocity[dof] = 0.0);
        Ok(velocity)
    }

    /// Refuses harmonics that `elements` around do not hold.
    pub(super) fn check_harmonics(&self, elements: usize) -> Result<(), TransientError> {
        let limit = elements / 2;
        match self.waves.iter().find(|wave| wave.harmonic > limit) {
            Some(wave) => Err(TransientError::HarmonicAboveNyquist {
                harmonic: wave.harmonic,
                limit,
                elements,
            }),
            None => Ok(()),
        }
    }

    /// Velocity of the waves along the sliding, m/s.
    pub(super) fn along(&self, place: &Place) -> f64 {
        // Amplitudes relative to the largest: waves of one amplitude have the factor one, exactly.
        let largest = self.waves.iter().fold(0.0, |m: f64, w| m.max(w.velocity.abs()));
        if largest == 0.0 {
            return 0.0;
        }
        let wave = |wave: &StandingWave| {
            (wave.velocity / largest) * (wave.harmonic as f64 * place.angle - wave.phase).cos()
        };
        let sum: f64 = self.waves.iter().map(wave).sum();
        largest * (FRAC_PI_2 * place.depth).cos() * sum
    }

    fn add_waves(&self, places: &[Place], mesh: &Mesh, velocity: &mut [f64]) {
        if self.waves.iter().all(|wave| wave.velocity == 0.0) {
            return;
        }
        for (node, place) in places.iter().enumerate() {
            let along = self.along(place);
            let turn = place.tangent - mesh.frame_angles()[node];
            // A quarter turn, but for round-off: along the node's second axis exactly.
            if (turn - FRAC_PI_2).abs() < 1e-12 {
                velocity[2 * node + 1] = along;
            } else {
                velocity[2 * node] = along * turn.cos();
                velocity[2 * node + 1] = along * turn.sin();
            }
        }
    }

    /// Adds noise to every component of nodes with `components` each.
    pub(super) fn add_noise(&self, velocity: &mut [f64], components: usize) {
        if self.noise == 0.0 {
            return;
        }
        let mut noise = GaussianNoise::new(self.noise_seed);
        for node in velocity.chunks_exact_mut(components) {
            for pair in node.chunks_mut(2) {
                let draw = noise.draw();
                for (v, part) in pair.iter_mut().zip([draw.re, draw.im]) {
                    *v += self.noise * part;
                }
            }
        }
    }
}

/// Where a node stands for the waves.
pub(super) struct Place {
    /// 0 at the contact edge, 1 where the waves vanish.
    pub depth: f64,
    pub angle: f64,
    /// Direction along the counterface, rad.
    pub tangent: f64,
}

fn places_on(annulus: &AnnulusMesh) -> Vec<Place> {
    let specification = &annulus.specification;
    let (inner, outer) = (specification.inner_radius, specification.outer_radius);
    let bore = specification.shaft.map_or(inner, |shaft| shaft.inner_radius);
    let per_sector = annulus.sector_node_count();
    let first = annulus.mesh.contact_edge().nodes[0] as usize;
    let nodes = annulus.mesh.nodes.iter().zip(annulus.mesh.frame_angles());
    let place = |(node, ([x, y, _], &angle)): (usize, (&[f64; 3], &f64))| Place {
        depth: if node % per_sector < first {
            (inner - x.hypot(*y)) / (inner - bore)
        } else {
            (x.hypot(*y) - inner) / (outer - inner)
        },
        angle,
        tangent: angle + FRAC_PI_2,
    };
    nodes.enumerate().map(place).collect()
}

fn places(mesh: &Mesh) -> Vec<Place> {
    let counterface = mesh.counterface;
    let gaps: Vec<f64> =
        mesh.plane_nodes().into_iter().map(|p| counterface.gap(p).max(0.0)).collect();
    let deepest = gaps.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let along = mesh
        .contact_edge()
        .nodes
        .iter()
        .map(|&node| counterface.place(mesh.plane_node(node as usize)));
    let (low, high) =
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| (low.min(s), high.max(s)));
    let angle = |point: [f64; 2]| match counterface {
        Counterface::Cylinder { .. } => counterface.place(point),
        Counterface::Plane { .. } => TAU * (counterface.place(point) - low) / (high - low),
    };
    let pairs = mesh.plane_nodes().into_iter().zip(gaps);
    let place = |(point, gap): ([f64; 2], f64)| Place {
        depth: gap / deepest,
        angle: angle(point),
        tangent: counterface.normal_angle(point) + FRAC_PI_2,
    };
    pairs.map(place).collect()
}
