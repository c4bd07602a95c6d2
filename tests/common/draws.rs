//! Numbers that look random and are the same every time.

/// Numbers of a linear congruential generator, from 0 to 1.
pub fn draws(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}
