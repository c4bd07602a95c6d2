//! The contact edge and the whole field of a mesh of equal sectors, in harmonics around its circumference.

use super::state::WaveState;
use super::wave::Wave;
use crate::linalg::c64;
use crate::transient::CentralDifference;
use std::f64::consts::TAU;
use std::ops::Mul;

/// Displacement (m) and velocity (m/s) over all dofs in nodal frames of one wave or two, of these `harmonics` around the
/// circumference, at a time (s).
pub(super) fn field(
    wave: &Wave,
    state: &WaveState,
    harmonics: [isize; 2],
    time: f64,
) -> [Vec<f64>; 2] {
    let (rays, sectors) = (wave.body.rays, wave.body.sector_count);
    let mut fields = [0, 1].map(|_| vec![0.0; 2 * rays * sectors]);
    for (k, u) in wave.displacements(state).into_iter().enumerate() {
        let share = if k == 0 { 1.0 } else { 2.0 } / wave.points() as f64; // Sums over M points, and -k beside k.
        let at = wave.coefficients(k, state);
        let profile = wave.body.profile(k, at, u.map(|value| value * share));
        let around = wave.circumferential(k, harmonics);
        let phase = wave.phase(k, state.frequencies()) * time;
        for sector in 0..sectors {
            // Whole turns taken out first, so that high harmonics lose no digits.
            let turns = (around * sector as isize).rem_euclid(sectors as isize);
            let turn = c64::from_polar(1.0, TAU * turns as f64 / sectors as f64 + phase);
            for (i, value) in profile.iter().enumerate() {
                for component in 0..2 {
                    let dof = 2 * (sector * rays + i) + component;
                    let amplitude = value[component] * turn;
                    fields[0][dof] += amplitude.re;
                    fields[1][dof] += (amplitude * at.damping).re; // v = Re(lambda u e^{i phase}).
                }
            }
        }
    }
    fields
}

/// What the time loop starts from, of fields over time: displacement at time zero (m), velocity half a step earlier (m/s).
pub(super) fn start_of(field: impl Fn(f64) -> [Vec<f64>; 2], time_step: f64) -> [Vec<f64>; 2] {
    let [displacement, _] = field(0.0);
    let [_, velocity] = field(-0.5 * time_step);
    [displacement, velocity]
}

/// Displacements of the contact nodes along the counterface, m.
pub(super) fn slips(run: &CentralDifference<'_>) -> Vec<f64> {
    let displacement = &run.fields().displacement;
    (0..run.interface().len()).map(|i| run.contact().slip(i, displacement)).collect()
}

/// Amplitude of harmonic `n` of values on equal nodes, `u = Re(a e^{i n theta})`.
pub(super) fn amplitude<T: Copy + Mul<c64, Output = c64>>(edge: &[T], harmonic: isize) -> c64 {
    let count = edge.len() as isize;
    let terms = edge.iter().enumerate().map(|(j, &value)| {
        let angle = TAU * (harmonic * j as isize).rem_euclid(count) as f64 / count as f64;
        value * c64::from_polar(2.0 / count as f64, -angle) // (2 / N) sum_j u_j e^{-i n theta_j}.
    });
    terms.sum()
}
