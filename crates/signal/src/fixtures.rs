//! What unit tests share.

/// So many values of a function of time, from 0 s on.
pub(crate) fn sampled<T>(count: usize, rate: f64, of: impl FnMut(f64) -> T) -> Vec<T> {
    (0..count).map(|sample| sample as f64 / rate).map(of).collect()
}

/// Standard normal numbers from sums of twelve uniform ones, for tests.
pub(crate) fn gaussian_sequence(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        let uniform = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        std::iter::repeat_with(uniform).take(12).sum::<f64>() - 6.0
    }
}
