//! Number of phases at which a wave is sampled.

use std::f64::consts::TAU;

/// Landing time, in units of `1 / omega` of a contact node between fixed neighbours.
const LANDING: f64 = 0.5;
/// Landing time, in phases, that is resolved.
const RESOLVED: f64 = 0.5;
/// Fewest and most phases where none are given.
const POINTS: (usize, usize) = (91, 181);

/// Phases kept between `M` and a multiple of `2 N / n`, at most.
const CLEARANCE: f64 = 12.0;

/// Landing time `tau`, as a share of the period, of a wave of about `frequency` (rad/s) on contact nodes of the frequency `node`, no less
/// than so many phases resolve.
///
/// Contact obeys `0 <= N ⟂ gap + tau v_n >= 0`: a touching node comes to rest over the landing time `tau` instead of at
/// one instant, which takes the kinetic energy of the lumped edge mass out as an inelastic impact does. A landing time
/// below the node's own `1 / omega` blurs nothing that the mesh resolves, and shrinks with it; but the phases must
/// resolve it, or points open and close at random around each landing.
pub fn landing_share(frequency: f64, node: f64, phases: usize) -> f64 {
    let wanted = LANDING / node * frequency / TAU; // tau / T = LANDING omega / (2 pi omega_node).
    wanted.max(RESOLVED / phases as f64)
}

/// Number of phases, odd, for a wave of about `frequency` (rad/s) on a mesh whose contact nodes have the frequency `node`, with
/// `nodes` of them along one wave.
///
/// With a number `given`, the landing time is never below what they resolve. Near a multiple of twice `nodes` the highest harmonics,
/// which the differences in time take for slow ones, are long waves to the mesh and would resonate: there fewer phases are taken.
pub fn phases(frequency: f64, node: f64, nodes: f64, given: Option<usize>) -> usize {
    let wanted = landing_share(frequency, node, usize::MAX);
    let own = || ((RESOLVED / wanted).round() as usize).clamp(POINTS.0, POINTS.1);
    let wished = given.unwrap_or_else(own) as f64;
    let period = 2.0 * nodes;
    let clearance = CLEARANCE.min(0.25 * period);
    let resonant = period * (wished / period).round().max(1.0);
    let distance = (wished - resonant).abs(); // To where the highest harmonics resonate.
    let points = if distance < clearance { resonant - clearance } else { wished };
    2 * (points as usize / 2).max(2) + 1 // M = 2 H + 1, at least 5: no harmonic at half the phases.
}
