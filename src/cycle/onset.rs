//! Where limit cycles are born: steady sliding that neither damps nor feeds a wave.

use super::body::DynamicCoefficients;
use super::branch::Event;
use super::parameter::OperatingPoint;
use super::state::{PointState, WaveState};
use super::wave::Wave;
use crate::fem::RayleighDamping;
use faer::c64;
use std::f64::consts::TAU;

/// Largest friction coefficient at which an onset is looked for.
pub const LARGEST_FRICTION: f64 = 2.0;

/// Highest frequency at which an onset is looked for, Hz.
pub const HIGHEST_FREQUENCY_HZ: f64 = 30e3;

const SCAN_POINTS: usize = 3000;

/// Loss of stability of steady sliding to one wave, a Hopf bifurcation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Onset {
    /// Critical friction coefficient.
    pub friction_coefficient: f64,
    /// `omega`, rad/s.
    pub frequency: f64,
}

/// Every onset of the wave against the rotor, by rising critical friction.
///
/// While the whole edge slips, the wave lives on `u_r = 0` with `T = mu N`, so `R_rr + mu R_rt = 0` at its harmonic. A
/// steady wave has real frequency and friction: zeros of `Im(R_rr / R_rt)` over the frequency.
pub fn onsets(wave: &Wave<'_>, damping: &RayleighDamping) -> Vec<Onset> {
    let friction = |frequency: f64| {
        let rate = c64::new(0.0, frequency * wave.order(1));
        let (r, []) = wave
            .body
            .receptance(1, DynamicCoefficients::new(rate, damping), []);
        -r[(0, 0)] / r[(0, 1)]
    };
    let highest = TAU * HIGHEST_FREQUENCY_HZ;
    let frequencies = (1..=SCAN_POINTS).map(|i| highest * i as f64 / SCAN_POINTS as f64);
    let scan: Vec<(f64, f64)> = frequencies
        .map(|omega| (omega, friction(omega).im))
        .collect();
    let mut found: Vec<Onset> = scan
        .windows(2)
        .filter(|pair| pair[0].1 * pair[1].1 < 0.0)
        .map(|pair| {
            let frequency = bisect(pair[0].0, pair[1].0, |omega| friction(omega).im);
            Onset {
                friction_coefficient: friction(frequency).re,
                frequency,
            }
        })
        // Poles change the sign too, but friction is large there.
        .filter(|onset| (0.0..LARGEST_FRICTION).contains(&onset.friction_coefficient))
        .collect();
    found.sort_by(|a, b| a.friction_coefficient.total_cmp(&b.friction_coefficient));
    found
}

fn bisect(mut low: f64, mut high: f64, function: impl Fn(f64) -> f64) -> f64 {
    let rising = function(high) > 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (function(middle) > 0.0) == rising {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

/// The largest wave of full slip at an onset, and the inequality that ends it.
///
/// `origin` is the phase of the wave's tangential displacement. At the critical friction a wave of any amplitude lives on, up to the one at which the first point opens or sticks.
pub fn largest_linear_wave(
    wave: &Wave<'_>,
    point: &OperatingPoint,
    onset: &Onset,
    origin: f64,
) -> (WaveState, Event) {
    let points = wave.points();
    let mut point = *point;
    point.contact.friction_coefficient = onset.friction_coefficient;
    let receptance = |k: usize| {
        let rate = c64::new(0.0, onset.frequency * wave.order(k));
        let at = DynamicCoefficients::new(rate, &point.damping);
        wave.body.receptance(k, at, []).0
    };
    let mean = point.contact.interference / receptance(0)[(0, 0)].re;
    let edge = receptance(1);
    // Normal force for a tangential displacement of unit amplitude and phase zero.
    let response = edge[(1, 0)] + onset.friction_coefficient * edge[(1, 1)];
    let force = 1.0 / response;
    let velocity = onset.frequency * wave.contact_order(1);
    let turn = |i: usize| c64::from_polar(1.0, TAU * i as f64 / points as f64 + origin);
    let surface_speed = point.contact.rotation_speed * wave.body.radius;
    let mut limit = (f64::INFINITY, Event::Lift(0));
    for i in 0..points {
        let (normal, speed) = ((force * turn(i)).re, (velocity * turn(i)).re);
        for (amplitude, event) in [
            (mean / -normal, Event::Lift(i)),
            (surface_speed / speed, Event::Rest(i)),
        ] {
            if amplitude > 0.0 && amplitude < limit.0 {
                limit = (amplitude, event);
            }
        }
    }
    let normal: Vec<f64> = (0..points)
        .map(|i| mean + limit.0 * (force * turn(i)).re)
        .collect();
    let mut state = WaveState {
        tangential: vec![0.0; points],
        normal,
        frequency: onset.frequency,
        contact: vec![PointState::SlipForward; points],
        origin,
        point,
    };
    state.impose_law();
    (state, limit.1)
}
