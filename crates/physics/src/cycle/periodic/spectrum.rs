//! Harmonics in time of the motion of contact nodes.

use crate::linalg::c64;
use crate::signal::forward_transform;

/// One harmonic of the motion of the contact nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionHarmonic {
    /// Root mean square over the contact nodes of its amplitude along the normal and along the counterface, m.
    pub amplitude: [f64; 2],
    /// Root of the share in the mean square of the vibration that this and all lower harmonics leave.
    pub remainder: f64,
}

/// Harmonics 1, 2, ... of displacements over one period: `samples[step][node]`, evenly spaced.
pub fn harmonics(samples: &[Vec<[f64; 2]>]) -> Vec<MotionHarmonic> {
    let (steps, nodes) = (samples.len(), samples.first().map_or(0, Vec::len));
    let highest = steps.saturating_sub(1) / 2;
    let mut squares = vec![[0.0; 2]; highest + 1];
    let transform = forward_transform(steps);
    for node in 0..nodes {
        for component in 0..2 {
            let values = samples.iter().map(|sample| sample[node][component]);
            let mut values: Vec<c64> = values.map(|u| c64::new(u, 0.0)).collect();
            transform.process(&mut values);
            for (square, value) in squares.iter_mut().zip(&values) {
                square[component] += value.norm_sqr();
            }
        }
    }
    // Both signs of the frequency.
    let scale = 2.0 / steps.max(1) as f64;
    let amplitude = |square: f64| scale * (square / nodes.max(1) as f64).sqrt();
    let total: f64 = squares.iter().skip(1).flatten().sum();
    let mut rest: f64 = total;
    let of = |square: &[f64; 2]| {
        rest -= square[0] + square[1];
        MotionHarmonic {
            amplitude: square.map(amplitude),
            remainder: (rest.max(0.0) / total.max(f64::MIN_POSITIVE)).sqrt(),
        }
    };
    squares.iter().skip(1).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn harmonics_of_a_sum_of_two_are_those_and_what_the_first_leaves() {
        let sample = |k: usize| {
            let phase = TAU * k as f64 / 64.0;
            vec![[3.0 * phase.cos(), 1.0 + 4.0 * (2.0 * phase).sin()]; 3]
        };
        let samples: Vec<Vec<[f64; 2]>> = (0..64).map(sample).collect();
        let found = harmonics(&samples);
        assert!((found[0].amplitude[0] - 3.0).abs() < 1e-12);
        assert!((found[1].amplitude[1] - 4.0).abs() < 1e-12);
        assert!((found[0].remainder - 0.8).abs() < 1e-12);
        assert!(found[1].remainder < 1e-7);
    }
}
