//! What one core of this processor can do at most.

#![allow(unsafe_code)]

use frictionsim::fem::operator::SimdLevel;
use std::hint::black_box;
use std::time::Instant;

/// Fused multiply-adds a second of one thread, times two: the widest vectors of this processor, enough
/// independent sums to fill its pipelines.
pub fn fma_peak() -> f64 {
    const ROUNDS: usize = 100_000;
    const SUMS: usize = 96;
    #[inline(always)]
    fn body(x: f64, fused: bool) -> [f64; SUMS] {
        let mut sums = [0.5_f64; SUMS];
        for _ in 0..ROUNDS {
            for sum in &mut sums {
                *sum = if fused { sum.mul_add(x, 1.0) } else { *sum * x + 1.0 };
            }
        }
        sums
    }
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
    unsafe fn wide(x: f64) -> [f64; SUMS] {
        body(x, true)
    }
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    unsafe fn narrow(x: f64) -> [f64; SUMS] {
        body(x, true)
    }
    let mut best = f64::INFINITY;
    for _ in 0..20 {
        let clock = Instant::now();
        let x = black_box(0.999);
        let sums = match SimdLevel::detect() {
            // SAFETY: the processor has these instructions.
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx512 => unsafe { wide(x) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx2 => unsafe { narrow(x) },
            _ => body(x, false),
        };
        black_box(sums);
        best = best.min(clock.elapsed().as_secs_f64());
    }
    2.0 * (ROUNDS * SUMS) as f64 / best
}
