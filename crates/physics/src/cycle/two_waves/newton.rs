//! Newton's method on the grid of two phases.

use super::super::parameter::Parameter;
use super::super::state::{PointState, WaveState};
use super::super::system::{Closure, Heading, System};
use super::super::wave::{Linearization, Wave};
use super::super::{CycleError, DiscModel};

/// Points along either phase, where the mesh allows for them.
const SIDE: usize = 53;
/// Circumferential harmonics kept between the highest of the grid and a multiple of the mesh's sectors: differences in time take
/// the highest harmonics for slow ones, which would resonate with the long wave that the mesh takes them for.
const CLEARANCE: usize = 10;
/// Most iterations.
const MOST: usize = 60;
/// Root mean square of what the forces of a solution miss the laws by, over the mean normal force; and with which it is taken where
/// no more is to be had: points on the edge of stick, slip or opening may go to and fro between two states.
const CONVERGED: f64 = 1e-9;
const ACCEPTED: f64 = 1e-3;
/// Iterations without what is missed a tenth smaller than before after which the search ends.
const PATIENCE: usize = 12;
/// Shares of a step that are tried.
const SHARES: [f64; 4] = [1.0, 0.5, 0.2, 0.05];

/// Two rotating waves of a disc on a grid of both phases.
pub struct TwoWaves {
    pub(super) wave: Wave,
    /// Points along both phases.
    pub sides: [usize; 2],
    /// `n_1, n_2`, negative for a wave with the rotor.
    pub harmonics: [isize; 2],
}

impl TwoWaves {
    /// Those of two harmonics and about these frequencies (rad/s), on `side` points along either phase, or as many as resolve them,
    /// where the mesh allows for so many.
    ///
    /// # Errors
    /// A mesh that cannot be built.
    pub fn new(
        model: &DiscModel,
        harmonics: [isize; 2],
        frequencies: [f64; 2],
        side: Option<usize>,
    ) -> Result<Self, CycleError> {
        let sectors = model.specification.circumferential_elements;
        let reach = harmonics[0].unsigned_abs() + harmonics[1].unsigned_abs(); // The highest n is `half` times this.
        let is_clear = |half: &usize| {
            let above = (half * reach) % sectors;
            half * reach < sectors / 2 || above.min(sectors - above) >= CLEARANCE // Below half the sectors nothing is an alias.
        };
        let half = (4..=side.unwrap_or(SIDE) / 2).rev().find(is_clear).unwrap_or(4);
        let sides = [2 * half + 1; 2];
        Ok(Self { wave: Wave::new(model, harmonics, frequencies, sides)?, sides, harmonics })
    }

    /// The state that satisfies the contact laws at all points, near one that does nearly.
    ///
    /// Signorini's and Coulomb's laws are `N = max(N - c gap, 0)` and `T = clamp(T - c_t slip, -mu N, mu N)`; Newton's method on
    /// them takes the contact states of all points from one iterate and solves for the forces of the next (P. Alart, A. Curnier,
    /// Comput. Methods Appl. Mech. Engrg. 92 (1991) 353), by a shorter step where the whole one misses the laws by more. The first
    /// step takes the contact states as they are. `None` where it does not converge.
    pub(super) fn solved(
        &self,
        start: &WaveState,
        parameter: Parameter,
        closure: Closure<'_>,
    ) -> Option<WaveState> {
        let wave = &self.wave;
        let at = |state: WaveState| Iterate::at(wave, state, parameter);
        let mut here = at(start.clone());
        let mut best: Option<(f64, WaveState)> = None;
        let mut improved = (0, f64::INFINITY);
        for turn in 0..MOST {
            // Contact states of the laws, the forces that they ask for.
            let mut state = here.state.clone();
            if turn > 0 {
                state.contact.clone_from(&here.contact);
            }
            state.impose_law();
            let system = System::at(wave, &state, parameter, here.scale());
            let (matrix, residual) = system.assemble(closure);
            let change = system.solve(matrix, &residual)?;
            let mut target = state.clone();
            change.add_to(&mut target, 1.0, parameter);
            // As far towards them as the laws are missed by less.
            let mut next = None;
            for share in if turn == 0 { &SHARES[..1] } else { &SHARES[..] } {
                let trial = at(between(&here.state, &target, *share, parameter));
                let is_less = turn == 0 || trial.missed < (1.0 - 0.1 * share) * here.missed; // A tenth of what a linear problem would gain.
                next = Some(trial);
                if is_less {
                    break;
                }
            }
            here = next?;
            // The best so far stays; without progress for some turns that is all there is.
            let is_sound = here.state.frequencies().iter().all(|&omega| omega > 0.0); // A negative one is the wave turned round.
            if !here.missed.is_finite() || !is_sound {
                break;
            }
            if best.as_ref().is_none_or(|best| here.missed < best.0) {
                best = Some((here.missed, here.state.clone()));
            }
            if here.missed < 0.9 * improved.1 {
                improved = (turn, here.missed);
            }
            if here.missed < CONVERGED || turn > improved.0 + PATIENCE {
                break;
            }
        }
        best.filter(|best| best.0 < ACCEPTED).map(|best| best.1)
    }
}

/// An iterate with what its forces miss the laws by.
struct Iterate {
    state: WaveState,
    /// Contact states of the laws.
    contact: Vec<PointState>,
    /// Root mean square of what the forces miss the laws by, over the mean normal force.
    missed: f64,
}

impl Iterate {
    fn at(wave: &Wave, state: WaveState, parameter: Parameter) -> Self {
        let linear = Linearization::at(wave, &state, parameter);
        let friction = state.point.contact.friction_coefficient;
        let mut sum = 0.0;
        let points = 0..state.contact.len();
        let contact = points.map(|i| {
            let normal = (state.normal[i] - linear.scales[0] * linear.gap[i]).max(0.0);
            let shear = state.tangential[i] - linear.scales[1] * linear.slip[i];
            let limit = friction * normal;
            sum += (state.normal[i] - normal).powi(2);
            sum += (state.tangential[i] - shear.clamp(-limit, limit)).powi(2);
            PointState::of(normal <= 0.0, shear, limit)
        });
        let contact = contact.collect();
        let mut iterate = Self { state, contact, missed: 0.0 };
        let count = iterate.contact.len() as f64;
        iterate.missed = (sum / count).sqrt() / iterate.scale();
        iterate
    }

    /// Mean normal force, N/m.
    fn scale(&self) -> f64 {
        let normal = &self.state.normal;
        normal.iter().map(|force| force.abs()).sum::<f64>() / normal.len() as f64
    }
}

/// The state a share of the way from one to another, with the contact of the other.
fn between(from: &WaveState, to: &WaveState, share: f64, parameter: Parameter) -> WaveState {
    let mut state = WaveState { contact: to.contact.clone(), ..from.clone() };
    Heading::between(from, to, parameter).shift(&mut state, share, parameter); // No law is imposed: what they are missed by counts.
    state
}
