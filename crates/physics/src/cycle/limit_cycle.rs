//! A limit cycle: motion along its phase, statuses, powers, harmonics.

use super::state::WaveState;
use super::wave::Wave;
use crate::contact::ContactStatus;
use crate::linalg::c64;
use crate::transient::ContactPowers;
use std::f64::consts::TAU;

/// Harmonics of the contact edge in a summary, `n = 0..=8`.
const HARMONIC_COUNT: usize = 9;

/// Mean powers of a cycle, W for each metre of thickness, of a body in three dimensions W.
///
/// `external = stick + slide + contact_dissipated`, and `stick + slide + normal = material_damping + damping`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CyclePowers {
    /// Of the contact; of a wave `normal` is negative where landing nodes lose energy.
    pub contact: ContactPowers,
    /// Lost in body and supports, `v^T C v`.
    pub material_damping: f64,
}

impl CyclePowers {
    /// `|external + normal - dissipated - material damping - contact damping| / external`: what is left of the energy balance of the cycle.
    pub fn balance_residual(&self) -> f64 {
        let own = &self.contact;
        let out = own.contact_dissipated + self.material_damping + own.damping;
        ((own.external + own.normal - out) / own.external).abs()
    }

    /// Every power times `factor`.
    pub fn scaled(&self, factor: f64) -> Self {
        let material_damping = factor * self.material_damping;
        Self { contact: self.contact.scaled(factor), material_damping }
    }
}

/// Contact and motion of a point of the contact at one phase; all points of the edge of a wave go through the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhasePoint {
    /// `xi`, rad.
    pub phase: f64,
    /// Time from phase zero on, s.
    pub time: f64,
    /// Contact status.
    pub status: ContactStatus,
    /// Contact pressure, Pa.
    pub pressure: f64,
    /// Contact shear, Pa, positive along the rotation.
    pub shear: f64,
    /// `u_r, u_theta`, m; on other bodies than discs along the normal and along the counterface, between solid bodies that of the one
    /// relative to the other.
    pub displacement: [f64; 2],
    /// `v_r, v_theta`, m/s.
    pub velocity: [f64; 2],
}

/// A limit cycle: a wave that turns against the rotor without changing its shape.
///
/// `u(r, theta, t) = U(r, n theta + omega t)`. For each metre of thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitCycle {
    /// Circumferential harmonic `n`.
    pub harmonic: usize,
    /// Contact forces, frequency, operating point.
    pub state: WaveState,
    /// Mean powers.
    pub powers: CyclePowers,
    /// Fractions of the contact edge that `[stick, slip, open]`.
    pub fractions: [f64; 3],
    /// Amplitude of the tangential displacement of the edge at circumferential harmonics 0 to 8 (the mean twist for 0), m.
    pub harmonics: [f64; HARMONIC_COUNT],
    /// Contact and motion of the edge along the phase.
    pub points: Vec<PhasePoint>,
}

impl LimitCycle {
    /// Reads a converged state.
    pub fn new(wave: &Wave, state: WaveState) -> Self {
        let edge = wave.displacements(&state);
        let count = wave.points() as f64;
        let mut harmonics = [0.0; HARMONIC_COUNT];
        for (k, spectrum) in edge.iter().enumerate() {
            if let Some(place) = harmonics.get_mut(k * wave.body.harmonic.unsigned_abs()) {
                let share = if k == 0 { 1.0 } else { 2.0 }; // k > 0 stands for -k, too.
                *place = share * spectrum[1].norm() / count;
            }
        }
        Self {
            harmonic: wave.body.harmonic.unsigned_abs(),
            powers: powers(wave, &state, &edge),
            fractions: state.fractions(),
            harmonics,
            points: points(wave, &state, &edge),
            state,
        }
    }

    /// Speed of the cylinder above which a cycle without stick no longer depends on it, `max v_theta / a`, rad/s: friction
    /// then knows only the sense of sliding. `None` for a cycle with sticking points.
    pub fn saturation_speed(&self, inner_radius: f64) -> Option<f64> {
        let sticks = self.points.iter().any(|point| point.status == ContactStatus::Stick);
        let fastest = self.points.iter().filter(|point| point.status == ContactStatus::Slip);
        let fastest = fastest.map(|point| point.velocity[1]).fold(f64::NEG_INFINITY, f64::max);
        (!sticks).then_some(fastest / inner_radius)
    }

    /// Whether open points lie outside the cylinder, within a fiftieth of interference and motion, and landing takes
    /// energy, within a two-hundredth of the external power.
    ///
    /// The contact law looks ahead of the gap; on meshes too coarse for a wave it can be met by one that is neither.
    pub fn is_physical(&self) -> bool {
        let interference = self.state.point.contact.interference;
        let gaps = self.points.iter().filter(|point| point.status == ContactStatus::Open);
        let (deepest, widest) = gaps.fold((0.0_f64, 0.0_f64), |(deepest, widest), point| {
            let gap = point.displacement[0] - interference; // Negative inside the cylinder.
            (deepest.min(gap), widest.max(gap))
        });
        let is_outside = -deepest < 0.02 * (interference + widest);
        is_outside && self.powers.contact.normal < 5e-3 * self.powers.contact.external.abs()
    }

    /// `omega / 2 pi`, Hz: the main frequency of any point of the body.
    pub fn frequency_hz(&self) -> f64 {
        self.state.frequency() / TAU
    }
}

/// Contact and motion at each phase.
fn points(wave: &Wave, state: &WaveState, edge: &[[c64; 2]]) -> Vec<PhasePoint> {
    let displacement = wave.motion(edge, |_| c64::ONE);
    let velocity = wave.motion(edge, |k| wave.contact_rate(k, state.frequencies())); // b, as the laws of contact have it.
    let length = wave.body.tributary_length;
    let phases = (0..wave.points()).map(|i| TAU * i as f64 / wave.points() as f64);
    (phases.enumerate())
        .map(|(i, phase)| PhasePoint {
            phase,
            time: phase / state.frequency(),
            status: state.contact[i].status(),
            pressure: state.normal[i] / length,
            shear: state.tangential[i] / length,
            displacement: [displacement[0][i], displacement[1][i]],
            velocity: [velocity[0][i], velocity[1][i]],
        })
        .collect()
}

/// Mean powers of a wave, or of two, whose `edge` moves so.
pub(super) fn powers(wave: &Wave, state: &WaveState, edge: &[[c64; 2]]) -> CyclePowers {
    let contact = &state.point.contact;
    let surface_speed = contact.rotation_speed * wave.body.radius;
    let mut powers = ContactPowers::default();
    let velocity = wave.motion(edge, |k| wave.rate(k, state.frequencies())); // v = i s u, which keeps energy.
    for (i, point) in state.contact.iter().enumerate() {
        let (normal, tangential) = (state.normal[i], state.tangential[i]);
        let (v_n, v_t) = (velocity[0][i], velocity[1][i]);
        powers.external += tangential * surface_speed;
        powers.contact_dissipated += tangential * (surface_speed - v_t);
        powers.normal += normal * v_n;
        match point.status() {
            ContactStatus::Stick => powers.stick += tangential * v_t,
            _ => powers.slide += tangential * v_t,
        }
    }
    let nodes = wave.body.sector_count as f64;
    CyclePowers {
        contact: powers.scaled(nodes / wave.points() as f64), // Mean over the phases, times the nodes: each goes through all of them.
        material_damping: nodes * material_damping(wave, state, edge),
    }
}

/// Mean of `v^T C v` over one sector, from the motion of every node.
fn material_damping(wave: &Wave, state: &WaveState, edge: &[[c64; 2]]) -> f64 {
    let count = wave.points() as f64;
    let harmonics = edge.iter().enumerate().skip(1); // The mean displacement is at rest.
    let means = harmonics.map(|(k, &u)| {
        let (damping, at) = (&state.point.damping, wave.coefficients(k, state));
        let profile = wave.body.profile(k, at, u);
        let form = wave.body.damping_form(k, damping, &profile);
        2.0 / (count * count) * form * at.damping.norm_sqr() // A = 2 lambda u / M: A^H C A / 2.
    });
    means.sum()
}
