//! Number of phases at which a wave is sampled.

use std::f64::consts::TAU;

/// Phases of a wave, and how softly it lands.
///
/// Contact obeys `0 <= N ⟂ gap + tau v_n >= 0`: a touching node comes to rest over the landing time `tau` instead of at
/// one instant, which takes the kinetic energy of the lumped edge mass out as an inelastic impact does. A landing time
/// below the node's own `1 / omega` blurs nothing that the mesh resolves, and shrinks with it; but the phases must
/// resolve it, or points open and close at random around each landing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseGrid {
    /// Number of phases `M`, odd.
    pub points: usize,
    /// Landing time `tau`, as a share of the period.
    pub landing_share: f64,
}

/// Landing time, in units of `1 / omega` of a contact node between fixed neighbours.
const LANDING: f64 = 0.5;
/// Landing time, in phases, that is resolved.
pub(super) const RESOLVED: f64 = 0.5;
/// Fewest and most phases where none are given.
const POINTS: (usize, usize) = (91, 181);

/// Phases kept between `M` and a multiple of `2 N / n`, at most.
const CLEARANCE: f64 = 12.0;

/// Landing time, as a share of the period, of a wave of about `frequency` (rad/s) on contact nodes of the frequency `node`.
pub(super) fn landing_share(frequency: f64, node: f64) -> f64 {
    LANDING / node * frequency / TAU // tau / T = LANDING omega / (2 pi omega_node).
}

impl PhaseGrid {
    /// The grid for a wave of about `frequency` (rad/s) on a mesh whose contact nodes have the frequency `node`, with
    /// `nodes` of them along one wave.
    ///
    /// With `points` given, the landing time is never below what they resolve. Near a multiple of twice `nodes` the highest harmonics,
    /// which the differences in time take for slow ones, are long waves to the mesh and would resonate: there fewer phases are taken.
    pub fn new(frequency: f64, node: f64, nodes: f64, points: Option<usize>) -> Self {
        let wanted = landing_share(frequency, node);
        let wished = points
            .unwrap_or_else(|| ((RESOLVED / wanted).round() as usize).clamp(POINTS.0, POINTS.1))
            as f64;
        let period = 2.0 * nodes;
        let clearance = CLEARANCE.min(0.25 * period);
        let resonant = period * (wished / period).round().max(1.0);
        let distance = (wished - resonant).abs(); // To where the highest harmonics resonate.
        let points = if distance < clearance { resonant - clearance } else { wished };
        let points = 2 * (points as usize / 2).max(2) + 1; // M = 2 H + 1, at least 5: no harmonic at half the phases.
        Self { points, landing_share: wanted.max(RESOLVED / points as f64) }
    }
}
