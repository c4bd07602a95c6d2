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

impl NormalLaw {
    /// `p(g)`, Pa.
    pub fn pressure(self, approach: f64) -> f64 {
        match self {
            Self::Cubic {
                stiffness,
                cubic_stiffness,
            } => approach * (stiffness + cubic_stiffness * approach * approach),
            Self::Exponential {
                reference_pressure,
                height,
            } => reference_pressure * (approach / height).exp_m1(),
        }
    }

    /// `dp / dg`, Pa/m.
    pub fn stiffness(self, approach: f64) -> f64 {
        match self {
            Self::Cubic {
                stiffness,
                cubic_stiffness,
            } => stiffness + 3.0 * cubic_stiffness * approach * approach,
            Self::Exponential {
                reference_pressure,
                height,
            } => reference_pressure * (approach / height).exp() / height,
        }
    }

    /// `g` at a pressure of zero or more, m.
    pub fn approach(self, pressure: f64) -> f64 {
        match self {
            // The one real root, by the hyperbolic form of Cardano's formula.
            Self::Cubic {
                stiffness,
                cubic_stiffness,
            } => {
                let size = (stiffness / (3.0 * cubic_stiffness)).sqrt();
                let turn = 1.5 * pressure / (stiffness * size);
                2.0 * size * (turn.asinh() / 3.0).sinh()
            }
            Self::Exponential {
                reference_pressure,
                height,
            } => height * (pressure / reference_pressure).ln_1p(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn approach_is_the_inverse_of_pressure_and_stiffness_its_slope() {
        let laws = [
            NormalLaw::Cubic {
                stiffness: 1e13,
                cubic_stiffness: 3e24,
            },
            NormalLaw::Exponential {
                reference_pressure: 2e5,
                height: 1.5e-6,
            },
        ];
        for law in laws {
            for approach in [0.0, 1e-8, 1e-6, 8e-6] {
                let found = law.approach(law.pressure(approach));
                assert!(
                    (found - approach).abs() <= 1e-13 * 8e-6,
                    "{law:?} {approach}"
                );
                let step = 1e-10;
                let rise = law.pressure(approach + step) - law.pressure(approach - step);
                let slope = law.stiffness(approach);
                assert!((rise / (2.0 * step) / slope - 1.0).abs() < 1e-6);
            }
        }
    }
}
