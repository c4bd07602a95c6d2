//! Exact steady sliding of the annulus: Lamé's field of the expansion and the shear of the friction.

use super::Annulus;
use std::f64::consts::TAU;

/// Stress in the polar frame, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stress {
    pub radial: f64,
    pub circumferential: f64,
    pub shear: f64,
}

/// Steady sliding equilibrium under an imposed expansion `u_r(a) = delta`, `u(b) = 0`.
#[derive(Clone, Copy, Debug)]
pub struct SteadyState {
    /// Contact pressure `p`, Pa.
    pub pressure: f64,
    /// Friction traction `tau = mu p` along `+e_theta`, Pa.
    pub shear: f64,
    /// Torque for each metre of thickness, N m/m.
    pub torque: f64,
    /// `u_r = linear r + inverse / r`.
    linear: f64,
    inverse: f64,
    inner_radius: f64,
    outer_radius: f64,
    lame_constants: [f64; 2],
}

impl Annulus {
    /// Exact steady sliding state.
    pub fn prestress(&self, interference: f64, friction_coefficient: f64) -> SteadyState {
        let (a, b) = (self.inner_radius, self.outer_radius);
        let [lambda, shear_modulus] = self.lame_constants();
        let inverse = interference * a * b * b / (b * b - a * a);
        let linear = -inverse / (b * b);
        let pressure =
            2.0 * shear_modulus * inverse / (a * a) - 2.0 * (lambda + shear_modulus) * linear;
        let shear = friction_coefficient * pressure;
        SteadyState {
            pressure,
            shear,
            torque: TAU * a * a * shear,
            linear,
            inverse,
            inner_radius: a,
            outer_radius: b,
            lame_constants: [lambda, shear_modulus],
        }
    }
}

impl SteadyState {
    /// `[u_r, u_theta]` at radius `r`, m: `u_theta = tau a^2 r / (2 G) (1 / r^2 - 1 / b^2)`.
    pub fn displacement(&self, r: f64) -> [f64; 2] {
        let (a, b) = (self.inner_radius, self.outer_radius);
        let twist = self.shear * a * a / (2.0 * self.lame_constants[1]);
        [self.linear * r + self.inverse / r, twist * r * (1.0 / (r * r) - 1.0 / (b * b))]
    }

    /// Stress at radius `r`.
    pub fn stress(&self, r: f64) -> Stress {
        let [lambda, shear_modulus] = self.lame_constants;
        let mean = 2.0 * (lambda + shear_modulus) * self.linear;
        let deviation = 2.0 * shear_modulus * self.inverse / (r * r);
        let a = self.inner_radius;
        Stress {
            radial: mean - deviation,
            circumferential: mean + deviation,
            shear: -self.shear * a * a / (r * r),
        }
    }
}
