//! Onsets of limit cycles: steady sliding that neither damps nor feeds a wave.

use super::body::{DiscModel, DynamicCoefficients};
use super::parameter::OperatingPoint;
use super::state::{Event, Phase, PointState, WaveState};
use super::wave::Wave;
use super::{CycleError, Family, LARGEST_FRICTION};
use crate::cea::cyclic;
use crate::cea::{ModeLimit, SweepRequest, UnstableInterval};
use crate::contact::SlidingContact;
use crate::fem::{MassKind, RayleighDamping};
use crate::linalg::c64;
use crate::mesh::AnnulusSpecification;
use crate::prestress::TangentOptions;
use std::f64::consts::TAU;

/// Modes of lowest frequency whose onsets are looked for where no limit is given, `+n` and `-n` counted singly.
pub const MODES: usize = 60;

/// Loss of stability of steady sliding to one wave, a Hopf bifurcation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Onset {
    /// Circumferential harmonic `n`.
    pub harmonic: usize,
    /// +1 travels with the rotor, -1 against it.
    pub direction: i8,
    /// Critical friction coefficient.
    pub friction_coefficient: f64,
    /// `omega`, rad/s.
    pub frequency: f64,
}

impl DiscModel {
    /// Every loss of stability of steady sliding to a travelling wave up to a friction coefficient, by rising critical
    /// friction, among the modes of `limit`.
    ///
    /// The eigenvalue analysis of the model that cycles live in: lumped mass, rigid contact, damping of the whole tangent, no
    /// geometric stiffness. Nothing is sought on a grid of frequencies.
    ///
    /// # Errors
    /// [`CycleError::NotFound`] where the eigenvalue analysis fails.
    pub fn onsets(
        &self,
        highest_friction: f64,
        limit: ModeLimit,
    ) -> Result<Vec<Onset>, CycleError> {
        let options = TangentOptions::of_free(MassKind::Lumped, self.damping);
        let contact = unloaded(&self.specification);
        let (mesh, material) = (&self.specification, &self.material);
        // As many as it has at least.
        let least = mesh.circumferential_elements * (2 * mesh.radial_elements - 1);
        let limit = match limit {
            ModeLimit::Lowest(count) => ModeLimit::Lowest(count.min(least)),
            below => below,
        };
        let frictions = [highest_friction];
        let request = SweepRequest::new(&frictions, limit);
        let found = cyclic::sweep(mesh, material, &options, &contact, &request)
            .map_err(|error| CycleError::NotFound(format!("onsets of limit cycles: {error}")))?;
        let travelling = found.sweep.intervals.iter().filter(|i| i.direction != 0);
        let onset = |interval: &UnstableInterval| Onset {
            harmonic: interval.harmonic,
            direction: interval.direction,
            friction_coefficient: interval.critical_friction,
            frequency: TAU * interval.frequency_hz,
        };
        Ok(travelling.map(onset).collect())
    }

    /// The onset of a family, sought up to ever larger friction coefficients.
    ///
    /// # Errors
    /// [`CycleError::NoOnset`] if there is none up to a friction coefficient of two.
    pub fn onset_of(&self, family: Family, limit: ModeLimit) -> Result<Onset, CycleError> {
        for share in [0.125, 0.25, 0.5, 1.0] {
            let found = self.onsets(share * LARGEST_FRICTION, limit)?;
            let mut own = found.into_iter().filter(|o| o.harmonic == family.harmonic);
            if let Some(onset) = own.nth(family.onset - 1) {
                return Ok(onset);
            }
        }
        Err(CycleError::NoOnset(family))
    }
}

/// A cylinder that presses little: without geometric stiffness neither interference nor speed enter the tangent.
pub fn unloaded(specification: &AnnulusSpecification) -> SlidingContact {
    SlidingContact {
        decay: None,
        friction_coefficient: 0.0,
        interference: 1e-6 * specification.inner_radius,
        rotation_speed: 1.0,
    }
}

/// The onset on a grid of phases, whose differences slow the wave down, and for its own damping.
///
/// While the whole edge slips, the wave lives on `u_r = 0` with `T = mu N`, so `R_rr + mu R_rt = 0` at its harmonic. A
/// steady wave has real frequency and friction: the zero of `Im(R_rr / R_rt)` next to the one given, by the secant method.
pub fn refined(wave: &Wave, damping: &RayleighDamping, onset: &Onset) -> Option<Onset> {
    let friction = |frequency: f64| {
        let at = DynamicCoefficients::new(wave.rate(1, [frequency, 0.0]), damping);
        let (r, []) = wave.body.receptance(1, at, []);
        -r[(0, 0)] / r[(0, 1)] // u_r = (R_rr + mu R_rt) N = 0.
    };
    let start = onset.frequency / wave.orders(1)[0];
    let (mut before, mut now) = (start, start * (1.0 + 1e-6));
    let mut value_before = friction(before).im;
    for _ in 0..40 {
        let value = friction(now).im;
        let step = value * (now - before) / (value - value_before); // Secant step to Im(mu) = 0.
        (before, value_before) = (now, value);
        // Round-off of the first step: an onset that is already right.
        if !step.is_finite() || step.abs() < 1e-13 * now {
            break;
        }
        now -= step;
    }
    let found = Onset { frequency: now, friction_coefficient: friction(now).re, ..*onset };
    let is_near = (now / start - 1.0).abs() < 0.2;
    (is_near && found.friction_coefficient > 0.0).then_some(found)
}

/// The largest wave of full slip at an onset, and the inequality that ends it.
///
/// `origin` is the phase of the wave's tangential displacement. At the critical friction a wave of any
/// amplitude lives on, up to the one at which the first point opens or sticks.
pub fn largest_linear_wave(
    wave: &Wave,
    point: &OperatingPoint,
    onset: &Onset,
    origin: f64,
) -> (WaveState, Event) {
    let points = wave.points();
    let mut point = *point;
    point.contact.friction_coefficient = onset.friction_coefficient;
    let receptance = |k: usize| {
        let at = DynamicCoefficients::new(wave.rate(k, [onset.frequency, 0.0]), &point.damping);
        wave.body.receptance(k, at, []).0
    };
    let mean = point.contact.interference / receptance(0)[(0, 0)].re; // delta = R_rr(0) N_0: at n = 0 shear moves nothing radially.
    let edge = receptance(1);
    // Normal force for a tangential displacement of unit amplitude and phase zero.
    let response = edge[(1, 0)] + onset.friction_coefficient * edge[(1, 1)]; // u_theta = (R_tr + mu R_tt) N.
    let force = 1.0 / response;
    let velocity = onset.frequency * wave.contact_orders(1)[0]; // b, as slip is measured.
    let turn = |i: usize| c64::from_polar(1.0, TAU * i as f64 / points as f64 + origin);
    let surface_speed = point.contact.rotation_speed * wave.body.radius;
    let mut limit = (f64::INFINITY, Event::Lift(0));
    for i in 0..points {
        let (normal, speed) = ((force * turn(i)).re, (velocity * turn(i)).re); // Of unit amplitude: N_0 + A N = 0 lifts, A v = V sticks.
        for (amplitude, event) in
            [(mean / -normal, Event::Lift(i)), (surface_speed / speed, Event::Rest(i))]
        {
            if amplitude > 0.0 && amplitude < limit.0 {
                limit = (amplitude, event);
            }
        }
    }
    let normal: Vec<f64> = (0..points).map(|i| mean + limit.0 * (force * turn(i)).re).collect();
    let mut state = WaveState {
        tangential: vec![0.0; points],
        normal,
        contact: vec![PointState::SlipForward; points],
        phases: vec![Phase { frequency: onset.frequency, origin }],
        point,
    };
    state.impose_law(); // T = mu N.
    (state, limit.1)
}
