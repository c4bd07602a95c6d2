//! Contact that stiffens with pressure.

/// Pressure over the approach `g` of two rough surfaces, positive where they are pressed; nothing pulls them together.
///
/// Source: exponential law of asperities, e.g. J. A. Greenwood, J. B. P. Williamson, Contact of nominally flat surfaces,
/// Proc. R. Soc. A 295 (1966): the stiffness is proportional to the pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NormalLaw {
    /// `p = k g + c g^3`.
    Cubic {
        /// `k`, Pa/m.
        stiffness: f64,
        /// `c`, Pa/m3.
        cubic_stiffness: f64,
    },
    /// `p = p_r (e^{g / h} - 1)`, so that `dp / dg = (p + p_r) / h`.
    Exponential {
        /// `p_r`, Pa.
        reference_pressure: f64,
        /// `h`, m.
        height: f64,
    },
}

/// `(e^x - 1) / x - 1`, without cancellation.
fn excess_of_mean(x: f64) -> f64 {
    if x.abs() < 0.03 {
        // x / 2! + x^2 / 3! + ..., to the last bit.
        return (2..11).rev().map(f64::from).fold(0.0, |sum, n| (x + x * sum) / n);
    }
    x.exp_m1() / x - 1.0
}

impl NormalLaw {
    /// Springs that do not stiffen, `p = k g`.
    pub fn linear(stiffness: f64) -> Self {
        Self::Cubic { stiffness, cubic_stiffness: 0.0 }
    }

    /// `p(g)`, Pa.
    pub fn pressure(self, approach: f64) -> f64 {
        match self {
            Self::Cubic { stiffness, cubic_stiffness } => {
                approach * (stiffness + cubic_stiffness * approach * approach)
            }
            Self::Exponential { reference_pressure, height } => {
                reference_pressure * (approach / height).exp_m1()
            }
        }
    }

    /// `dp / dg`, Pa/m.
    pub fn stiffness(self, approach: f64) -> f64 {
        match self {
            Self::Cubic { stiffness, cubic_stiffness } => {
                stiffness + 3.0 * cubic_stiffness * approach * approach
            }
            Self::Exponential { reference_pressure, height } => {
                reference_pressure * (approach / height).exp() / height
            }
        }
    }

    /// Energy stored in each unit of area, `int_0^g p dg`, J/m2; none where the surfaces are apart.
    pub fn energy(self, approach: f64) -> f64 {
        let closed = approach.max(0.0);
        closed * self.mean_pressure(0.0, closed)
    }

    /// Mean pressure on the way between two approaches, `(U(b) - U(a)) / (b - a)` with the energy `U`, Pa; the pressure itself
    /// where both are the same.
    ///
    /// A force of this size does the work that the energy takes, whatever the way.
    pub fn mean_pressure(self, from: f64, to: f64) -> f64 {
        if from >= 0.0 && to >= 0.0 {
            return self.mean_closed(from, to);
        }
        // One of both is open: the pressure acts on the rest of the way alone.
        let closed = from.max(to).max(0.0);
        if closed == 0.0 {
            return 0.0;
        }
        closed * self.mean_closed(0.0, closed) / (to - from).abs()
    }

    fn mean_closed(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Cubic { stiffness, cubic_stiffness } => {
                0.5 * (a + b) * (stiffness + 0.5 * cubic_stiffness * (a * a + b * b))
            }
            Self::Exponential { reference_pressure, height } => {
                let excess = excess_of_mean((b - a) / height);
                let start = (a / height).exp_m1();
                reference_pressure * (start + excess * (start + 1.0))
            }
        }
    }

    /// `g` at a pressure of zero or more, m.
    pub fn approach(self, pressure: f64) -> f64 {
        match self {
            Self::Cubic { stiffness, cubic_stiffness: 0.0 } => pressure / stiffness,
            // The one real root, by the hyperbolic form of Cardano's formula.
            Self::Cubic { stiffness, cubic_stiffness } => {
                let size = (stiffness / (3.0 * cubic_stiffness)).sqrt();
                let turn = 1.5 * pressure / (stiffness * size);
                2.0 * size * (turn.asinh() / 3.0).sinh()
            }
            Self::Exponential { reference_pressure, height } => {
                height * (pressure / reference_pressure).ln_1p()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAWS: [NormalLaw; 2] = [
        NormalLaw::Cubic { stiffness: 1e13, cubic_stiffness: 3e24 },
        NormalLaw::Exponential { reference_pressure: 2e5, height: 1.5e-6 },
    ];

    /// Independent: Simpson's rule over the pressure, and differences.
    #[test]
    fn energy_is_the_work_of_the_pressure_and_rates_are_differences() {
        for law in LAWS {
            for [a, b] in [[0.0, 3e-6], [2e-6, 2.00001e-6], [4e-6, 1e-6], [-1e-6, 2e-6]] {
                let count = 2000;
                let at = |k: usize| a + (b - a) * k as f64 / f64::from(count as u32);
                let pressure = |k: usize| if at(k) > 0.0 { law.pressure(at(k)) } else { 0.0 };
                let weight = |k: usize| match k {
                    0 => 1.0,
                    k if k == count => 1.0,
                    k => 2.0 + 2.0 * (k % 2) as f64,
                };
                let sum: f64 = (0..=count).map(|k| weight(k) * pressure(k)).sum();
                let mean = sum / (3.0 * count as f64);
                let found = law.mean_pressure(a, b);
                // The rule is exact to the kink, of which it sees one step.
                let tolerance = if a < 0.0 { 1e-6 } else { 1e-10 };
                assert!((found / mean - 1.0).abs() < tolerance, "{law:?} {a} {b}");
                let change = law.energy(b) - law.energy(a);
                let scale = law.energy(a.max(b));
                assert!((found * (b - a) - change).abs() < 1e-14 * scale);
            }
            assert_eq!(law.mean_pressure(2e-6, 2e-6), law.pressure(2e-6));
        }
    }

    #[test]
    fn approach_is_the_inverse_of_pressure_and_stiffness_its_slope() {
        for law in LAWS {
            for approach in [0.0, 1e-8, 1e-6, 8e-6] {
                let found = law.approach(law.pressure(approach));
                assert!((found - approach).abs() <= 1e-13 * 8e-6, "{law:?} {approach}");
                let step = 1e-10;
                let rise = law.pressure(approach + step) - law.pressure(approach - step);
                let slope = law.stiffness(approach);
                assert!((rise / (2.0 * step) / slope - 1.0).abs() < 1e-6);
            }
        }
    }
}
