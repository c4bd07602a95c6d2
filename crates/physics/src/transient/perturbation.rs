//! The seed that decides which mode grows: a velocity added to that of the body.

use super::TransientError;
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

    /// Refuses harmonics that `elements` around do not hold.
    pub(super) fn check_harmonics(&self, elements: usize) -> Result<(), TransientError> {
        let limit = elements / 2;
        let beyond = self.waves.iter().find(|wave| wave.harmonic > limit);
        beyond.map_or(Ok(()), |wave| {
            let problem = format!(
                " holds {}, above {limit}, the highest harmonic that {elements} elements around the circumference can carry",
                wave.harmonic
            );
            let fitting = format!("at most {limit}");
            Err(TransientError::setting("perturbation.harmonics", fitting, problem))
        })
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
    /// Direction of the sliding over the components of the node.
    pub direction: [f64; 3],
}

/// Where the nodes of a plane mesh stand; it may belong to an annulus.
pub(super) fn places(mesh: &Mesh, annulus: Option<&AnnulusMesh>) -> Vec<Place> {
    let points = mesh.plane_nodes().into_iter().zip(mesh.frame_angles());
    if let Some(annulus) = annulus {
        let own = &annulus.specification;
        let bore = own.shaft.map_or(own.inner_radius, |shaft| shaft.inner_radius);
        let first = mesh.contact_edge().nodes[0] as usize;
        let place = points.enumerate().map(|(node, ([x, y], &angle))| {
            let beyond = x.hypot(y) - own.inner_radius;
            let is_shaft = node % annulus.sector_node_count() < first;
            let end = if is_shaft { bore } else { own.outer_radius };
            let depth = beyond / (end - own.inner_radius);
            Place { depth, angle, direction: [0.0, 1.0, 0.0] }
        });
        return place.collect();
    }

    // Extent of the edge along its counterface, and the deepest node.
    let counterface = mesh.counterface;
    let edge = mesh.contact_edge().nodes.iter();
    let along = edge.map(|&node| counterface.place(mesh.plane_node(node as usize)));
    let [low, high] = crate::order::range(along);
    let gap = |point: [f64; 2]| counterface.gap(point).max(0.0);
    let deepest = mesh.plane_nodes().into_iter().map(gap).fold(f64::MIN_POSITIVE, f64::max);
    let place = points.map(|(point, frame)| {
        let turn = counterface.normal_angle(point) + FRAC_PI_2 - frame;
        // A quarter turn, but for round-off: along the node's second axis exactly.
        let is_straight = (turn - FRAC_PI_2).abs() < 1e-12;
        Place {
            depth: gap(point) / deepest,
            angle: match counterface {
                Counterface::Cylinder { .. } => counterface.place(point),
                Counterface::Plane { .. } => TAU * (counterface.place(point) - low) / (high - low),
            },
            direction: if is_straight { [0.0, 1.0, 0.0] } else { [turn.cos(), turn.sin(), 0.0] },
        }
    });
    place.collect()
}
