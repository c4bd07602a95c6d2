//! Pseudo-random numbers: noise of synthesised measurements, random seeds of a transient.

use faer::c64;
use std::f64::consts::TAU;

/// The next number of the sequence of a state, which depends on the first state alone.
///
/// Source: G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
pub(super) fn splitmix64(state: &mut u64) -> u64 {
    // The increment is `2^64` over the golden ratio.
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A stream of Gaussian noise that depends on its seed alone.
///
/// Each value has independent real and imaginary parts with mean 0 and standard deviation 1 (dimensionless): Box and Muller's transform of
/// splitmix64. Streams of different seeds share no part of any practical length. Not for cryptography.
#[derive(Clone, Debug)]
pub struct GaussianNoise(u64);

impl GaussianNoise {
    /// The stream of a seed.
    pub fn new(mut seed: u64) -> Self {
        // All streams are parts of one sequence, `state + k increment`. A state that is linear in the seed would let neighbouring seeds run
        // through the same numbers a few places apart; a scrambled one puts each seed at a random place among 2^64.
        Self(splitmix64(&mut seed))
    }

    /// The next value.
    pub fn draw(&mut self) -> c64 {
        // 1 - u lies in (0, 1], where the logarithm exists.
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        c64::from_polar(radius, TAU * self.uniform())
    }

    /// A number in [0, 1).
    fn uniform(&mut self) -> f64 {
        (splitmix64(&mut self.0) >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: usize = 4096;

    fn stream(seed: u64) -> Vec<c64> {
        let mut noise = GaussianNoise::new(seed);
        (0..COUNT).map(|_| noise.draw()).collect()
    }

    #[test]
    fn noise_of_neighbouring_seeds_is_not_the_same_noise_shifted() {
        let streams: Vec<Vec<c64>> = (0..8).map(stream).collect();
        let mut largest = 0.0f64;
        for (p, x) in streams.iter().enumerate() {
            for y in &streams[p + 1..] {
                for lag in 0..40 {
                    for (a, b) in [(x, y), (y, x)] {
                        let pairs = a[lag..].iter().zip(b);
                        let sum: c64 = pairs.map(|(a, b)| a * b.conj()).sum();
                        largest = largest.max(sum.norm());
                    }
                }
            }
        }
        // Real and imaginary part of such a sum have variance 2 COUNT. Of 2240 sums the largest is below 6 of those standard deviations
        // with probability 1 - 2240 exp(-18); the same noise would give 2 COUNT = 90.
        let chance = (2.0 * COUNT as f64).sqrt();
        assert!(largest < 6.0 * chance, "{}", largest / chance);
    }

    #[test]
    fn noise_has_the_moments_of_independent_standard_normal_numbers() {
        let (mut mean, mut square, mut fourth, mut cross) = (0.0, 0.0, 0.0, 0.0);
        for z in (0..64).flat_map(stream) {
            mean += z.re + z.im;
            square += z.re * z.re + z.im * z.im;
            fourth += z.re.powi(4) + z.im.powi(4);
            cross += z.re * z.im;
        }
        // Five standard deviations of each sum of n numbers: variances 1, 2 and 96, and 1 of each of the n / 2 products.
        let n = (64 * 2 * COUNT) as f64;
        assert!(mean.abs() < 5.0 * n.sqrt(), "{mean}");
        assert!((square - n).abs() < 5.0 * (2.0 * n).sqrt(), "{square}");
        assert!((fourth - 3.0 * n).abs() < 5.0 * (96.0 * n).sqrt(), "{fourth}");
        assert!(cross.abs() < 5.0 * (0.5 * n).sqrt(), "{cross}");
    }
}
