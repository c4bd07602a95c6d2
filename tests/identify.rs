//! Damping identified from synthetic frequency responses whose coefficients are known.
//!
//! Independent checks: the responses are modal sums written here, not the library's model.

use faer::c64;
use frictionsim::signal::{
    FrequencyResponse, IdentificationOptions, ResponseQuantity, SignalError, identify,
};
use std::f64::consts::TAU;

const ALPHA: f64 = 40.0;
const BETA: f64 = 4.5e-7;

/// Standard normal numbers, Box and Muller over a linear congruential sequence.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((self.0 >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    fn normal(&mut self) -> c64 {
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        c64::from_polar(radius, TAU * self.uniform())
    }
}

/// Accelerance of a free body: rigid motion and modes `(frequency, residue)`, 1 Hz to 10 kHz.
fn free_body(modes: &[(f64, f64)], step: f64, alpha: f64, beta: f64) -> (Vec<f64>, Vec<c64>) {
    let f: Vec<f64> = (1..=(1e4 / step) as usize)
        .map(|i| i as f64 * step)
        .collect();
    let h = f
        .iter()
        .map(|f| {
            let s = c64::new(0.0, TAU * f);
            let rigid = 1.0 / (s * s + s * alpha);
            let elastic: c64 = modes
                .iter()
                .map(|(f, r)| {
                    let w = TAU * f;
                    *r / (s * s + s * (alpha + beta * w * w) + w * w)
                })
                .sum();
            s * s * (rigid + elastic)
        })
        .collect();
    (f, h)
}

fn noisy(values: &[c64], relative: f64, seed: u64) -> Vec<c64> {
    let mut noise = Noise(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    values
        .iter()
        .map(|h| h + noise.normal() * (relative * h.norm()))
        .collect()
}

/// Modes of a free disc below 10 kHz and above, each with a residue of the usual size.
const DISC: [(f64, f64); 12] = [
    (2400.0, 1.9),
    (3950.0, 1.2),
    (4700.0, 1.8),
    (5620.0, 0.7),
    (6480.0, 1.6),
    (7240.0, 1.1),
    (8630.0, 1.5),
    (9170.0, 0.9),
    (10_400.0, 1.4),
    (12_100.0, 1.2),
    (14_800.0, 1.7),
    (18_300.0, 1.5),
];

#[test]
fn seeds() {
    let (f, h) = free_body(&DISC, 1.0, ALPHA, BETA);
    let t0 = std::time::Instant::now();
    let mut cov = [0, 0];
    for seed in 0..2 {
        let r = FrequencyResponse::new(
            f.clone(),
            noisy(&h, 0.01, seed),
            ResponseQuantity::Accelerance,
        )
        .unwrap();
        let id = identify(&r, &IdentificationOptions::default()).unwrap();
        let (a, b) = (
            id.rayleigh.mass_coefficient,
            id.rayleigh.stiffness_coefficient,
        );
        cov[0] += i32::from(a.low <= ALPHA && ALPHA <= a.high);
        cov[1] += i32::from(b.low <= BETA && BETA <= b.high);
        println!(
            "{seed} {a:?} {b:?} chi {:.2} added {} corr {:.3} terms {} hp {:?}",
            id.rayleigh.reduced_chi_square,
            id.fit.added_poles,
            id.fit.correlation,
            id.fit.model.remainder.len(),
            id.half_power_rayleigh
                .map(|r| (r.mass_coefficient, r.stiffness_coefficient))
        );
        if seed == 0 {
            for m in &id.modes {
                let w = TAU * m.fitted.frequency_hz.value;
                println!(
                    "{:.2} {:.5} se {:.2e} true {:.5} hp {:?} {}",
                    m.fitted.frequency_hz.value,
                    m.fitted.damping_factor.value,
                    m.fitted.standard_error,
                    0.5 * (ALPHA / w + BETA * w),
                    m.half_power.map(|h| (h.damping_factor, h.note)),
                    m.is_used
                );
            }
            println!("{:?}", id.fit.noise);
        }
    }
    println!("{cov:?} {:?}", t0.elapsed());
}
