//! Noise level of a frequency response.

use crate::FrequencyResponse;

/// Noise of each real component of a response value: variance `additive^2 + relative^2 |H|^2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseModel {
    /// Standard deviation that does not depend on the response, unit of the response.
    pub additive: f64,
    /// Standard deviation relative to the modulus of the response.
    pub relative: f64,
}

/// A single value counts at most as this many variances, so that spikes do not make the noise.
const CLIP: f64 = 9.0;

impl NoiseModel {
    /// Variance of one component where the modulus of the response is `modulus`.
    pub fn variance(&self, modulus: f64) -> f64 {
        self.additive * self.additive + (self.relative * modulus).powi(2)
    }

    /// Noise from third differences of successive values, `|x_0 - 3 x_1 + 3 x_2 - x_3|^2 / 20`.
    ///
    /// Too large where the lines are so coarse that the response itself differs from a parabola over
    /// four of them: safe, since it then only asks more of a peak.
    pub fn from_differences(response: &FrequencyResponse) -> Self {
        let (squares, moduli): (Vec<f64>, Vec<f64>) = (response.values())
            .windows(4)
            .map(|w| {
                let d = w[0] - w[1] * 3.0 + w[2] * 3.0 - w[3];
                let mean = 0.25 * w.iter().map(|z| z.norm()).sum::<f64>();
                (d.norm_sqr() / 20.0, mean)
            })
            .unzip();
        Self::from_squares(&squares, &moduli, response.has_phase())
    }

    /// Noise from squared residuals `|r|^2` and the moduli of the response beneath them, by maximum
    /// likelihood over both parameters (gamma regression with identity link, reweighted, non-negative).
    pub fn from_squares(squares: &[f64], moduli: &[f64], has_phase: bool) -> Self {
        let components = if has_phase { 2.0 } else { 1.0 };
        let top = moduli.iter().copied().fold(0.0, f64::max);
        let tiny = (1e-13 * top).powi(2).max(f64::MIN_POSITIVE);
        let scale = top * top;
        if squares.is_empty() || scale == 0.0 {
            return Self { additive: tiny.sqrt(), relative: 0.0 };
        }
        let q: Vec<f64> = squares.iter().map(|s| s / components).collect();
        let h: Vec<f64> = moduli.iter().map(|m| m * m / scale).collect();
        let mean = q.iter().sum::<f64>() / q.len() as f64;
        let mean_h = h.iter().sum::<f64>() / h.len() as f64;
        // Variance v = x + y h; start from half of the mean each.
        let (mut x, mut y) = ((0.5 * mean).max(tiny), 0.5 * mean / mean_h);
        for _ in 0..60 {
            let (mut s1, mut sh, mut shh, mut sq, mut sqh) = (0.0, 0.0, 0.0, 0.0, 0.0);
            for (q, h) in q.iter().zip(&h) {
                let v = x + y * h;
                let q = q.min(CLIP * v);
                let w = 1.0 / (v * v);
                s1 += w;
                sh += w * h;
                shh += w * h * h;
                sq += w * q;
                sqh += w * h * q;
            }
            let determinant = s1 * shh - sh * sh;
            let (mut nx, mut ny) =
                ((sq * shh - sqh * sh) / determinant, (s1 * sqh - sh * sq) / determinant);
            let regular = determinant > 1e-12 * s1 * shh;
            if !regular || nx < 0.0 || ny < 0.0 {
                // On the boundary: the better of the two one-parameter fits.
                (nx, ny) = if regular && nx < 0.0 { (0.0, sqh / shh) } else { (sq / s1, 0.0) };
            }
            let (old_x, old_y) = (x, y);
            (x, y) = (nx.max(tiny), ny.max(0.0));
            if (x - old_x).abs() <= 1e-6 * x && (y - old_y).abs() <= 1e-6 * y {
                break;
            }
        }
        Self { additive: x.sqrt(), relative: (y / scale).sqrt() }
    }
}
