//! Fields over a mesh of equal sectors, from harmonics around its circumference.

use crate::linalg::c64;
use std::f64::consts::TAU;

/// What one harmonic adds to a field.
pub(super) struct HarmonicField {
    /// Harmonic around the circumference.
    pub around: isize,
    /// Phase on the first sector, rad.
    pub phase: f64,
    /// `i omega`, 1/s.
    pub rate: c64,
    /// Displacement of every node of a sector, m.
    pub profile: Vec<[c64; 2]>,
}

/// Displacement (m) and velocity (m/s) over all dofs in nodal frames, of `rays` nodes on each of so many sectors.
pub(super) fn summed(
    harmonics: impl Iterator<Item = HarmonicField>,
    [rays, sectors]: [usize; 2],
) -> [Vec<f64>; 2] {
    let mut fields = [0, 1].map(|_| vec![0.0; 2 * rays * sectors]);
    for own in harmonics {
        for sector in 0..sectors {
            // Whole turns taken out first, so that high harmonics lose no digits.
            let turns = (own.around * sector as isize).rem_euclid(sectors as isize);
            let turn = c64::from_polar(1.0, TAU * turns as f64 / sectors as f64 + own.phase);
            for (i, value) in own.profile.iter().enumerate() {
                for component in 0..2 {
                    let dof = 2 * (sector * rays + i) + component;
                    let amplitude = value[component] * turn;
                    fields[0][dof] += amplitude.re;
                    fields[1][dof] += (amplitude * own.rate).re;
                }
            }
        }
    }
    fields
}
