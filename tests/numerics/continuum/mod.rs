//! Exact continuum reference of the annulus in sliding contact, against which the finite elements must converge.
//!
//! With `u = (U(r) e_r + i W(r) e_theta) e^{i n theta + lambda t}` the linearised problem is exact in `theta`; in `r` the weak form is
//! solved by one spectral element of polynomial degree [`DEGREE`], whose error is near round-off. No mesh, shape function or assembly of
//! the program is used: the only thing shared with it is the theory.

pub mod bessel;
pub mod prestress;
pub mod radial;

use crate::prelude::*;
use prestress::Stress;
use radial::RadialElement;

/// Polynomial degree in `r`: some more or less change eigenvalues below 20 kHz by round-off (see `continuum_reference.rs`).
pub const DEGREE: usize = 24;

/// An isotropic annulus with radii `a` and `b`, clamped outside (SI units, per metre of thickness), in plane strain or plane stress.
#[derive(Clone, Copy, Debug)]
pub struct Annulus {
    pub inner_radius: f64,
    pub outer_radius: f64,
    pub young_modulus: f64,
    pub poisson_ratio: f64,
    pub density: f64,
    pub plane_strain: bool,
}

/// State of the inner edge: a rigid cylinder sliding towards `+e_theta`.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Coulomb friction coefficient `mu`.
    pub friction_coefficient: f64,
    /// Normal stiffness `k_n`, Pa/m; `None` is rigid contact, `Some(0.0)` a free edge.
    pub normal_stiffness: Option<f64>,
    /// Interference `delta`, m, whose prestress enters the tangent with the turning of the contact forces; `None` leaves the prestress out.
    pub prestress_interference: Option<f64>,
}

impl Contact {
    /// Rigid sliding contact without prestress.
    pub fn rigid(friction_coefficient: f64) -> Self {
        Self { friction_coefficient, normal_stiffness: None, prestress_interference: None }
    }

    /// Penalty contact without prestress.
    pub fn penalty(friction_coefficient: f64, normal_stiffness: f64) -> Self {
        Self { normal_stiffness: Some(normal_stiffness), ..Self::rigid(friction_coefficient) }
    }
}

/// Rayleigh coefficients `(alpha, beta)` of `C = alpha M + beta K_t`.
pub type Rayleigh = (f64, f64);

/// One eigenvalue of the exact problem with `Im(lambda) > 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eigenvalue {
    /// `lambda`, rad/s.
    pub lambda: c64,
    /// +1 travels with the rotor, -1 against it, 0 stands.
    pub direction: i8,
}

impl Eigenvalue {
    /// `Re(lambda) / 2 pi`, Hz.
    pub fn real_hz(&self) -> f64 {
        self.lambda.re / TAU
    }

    /// `Im(lambda) / 2 pi`, Hz.
    pub fn frequency_hz(&self) -> f64 {
        self.lambda.im / TAU
    }
}

impl Annulus {
    /// Lamé constants `[lambda, G]` of the plane problem, Pa.
    pub fn lame_constants(&self) -> [f64; 2] {
        let (e, nu) = (self.young_modulus, self.poisson_ratio);
        let lambda = if self.plane_strain {
            e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
        } else {
            e * nu / (1.0 - nu * nu)
        };
        [lambda, e / (2.0 * (1.0 + nu))]
    }

    /// Eigenvalues `kappa` of `K_n phi = kappa M phi`, 1/s2, by rising real part.
    pub fn kappas(&self, harmonic: usize, contact: &Contact) -> Vec<c64> {
        self.kappas_at_degree(harmonic, contact, DEGREE)
    }

    /// [`Annulus::kappas`] with another polynomial degree in `r`.
    pub fn kappas_at_degree(&self, harmonic: usize, contact: &Contact, degree: usize) -> Vec<c64> {
        let (stiffness, mass) = self.sliding_pencil(harmonic, contact, degree);
        smallest_first(&stiffness, &mass)
    }

    /// The pencil of the sliding state over the free unknowns, per radian: trial space without the
    /// clamped edge and, in rigid contact, without `U(a)`; friction row in the test space.
    fn sliding_pencil(&self, n: usize, contact: &Contact, degree: usize) -> (Mat<c64>, Mat<c64>) {
        let (mut stiffness, mut mass) = self.unconstrained_pencil(n, contact, degree);
        let friction = c64::new(0.0, contact.friction_coefficient);
        let first = match contact.normal_stiffness {
            Some(k_n) => {
                // p' = -k_n U acts with the virtual work a (p' v_r^* + mu p' v_theta^*), and v_theta = i w.
                let spring = c64::new(self.inner_radius * k_n, 0.0);
                stiffness[(0, 0)] += spring;
                stiffness[(1, 0)] -= friction * spring;
                0
            }
            None => {
                // The contact force does no work in e_theta - mu e_r, so the friction row is the
                // tangential residual minus mu times the normal one; mass and stiffness alike.
                for matrix in [&mut stiffness, &mut mass] {
                    for column in 0..matrix.ncols() {
                        matrix[(1, column)] = matrix[(1, column)] + friction * matrix[(0, column)];
                    }
                }
                1
            }
        };
        let free = 2 * degree - first;
        let restrict = |m: &Mat<c64>| Mat::from_fn(free, free, |i, j| m[(i + first, j + first)]);
        (restrict(&stiffness), restrict(&mass))
    }

    /// Stiffness (elastic, and geometric with the turning of the contact forces if there is prestress) and mass over all unknowns `(U_0,
    /// W_0, U_1, W_1, ...)` from the inner edge outwards, per radian.
    pub fn unconstrained_pencil(
        &self,
        harmonic: usize,
        contact: &Contact,
        degree: usize,
    ) -> (Mat<c64>, Mat<c64>) {
        let element = RadialElement::new(self.inner_radius, self.outer_radius, degree);
        let [lambda, shear] = self.lame_constants();
        let (delta, mu) = (contact.prestress_interference, contact.friction_coefficient);
        let stress = delta.map(|delta| self.prestress(delta, mu));
        let n = harmonic as f64;
        let size = 2 * (degree + 1);
        let mut stiffness = Mat::<c64>::zeros(size, size);
        let mut mass = Mat::<c64>::zeros(size, size);
        for point in &element.points {
            let r = point.radius;
            let weight = point.weight * r;
            let initial = stress.as_ref().map(|state| state.stress(r));
            // Displacement gradients (rr, r theta, theta r, theta theta) of each unknown, without the factor i of the second and third.
            let gradient = |dof: usize| {
                let (value, slope) = (point.values[dof / 2], point.slopes[dof / 2]);
                if dof.is_multiple_of(2) {
                    [slope, n * value / r, 0.0, value / r]
                } else {
                    [0.0, -value / r, slope, -n * value / r]
                }
            };
            for row in 0..size {
                let v = gradient(row);
                for column in 0..size {
                    let u = gradient(column);
                    let mut density = c64::new(elastic(lambda, shear, &v, &u), 0.0);
                    if let Some(initial) = &initial {
                        density += geometric(initial, &v, &u);
                    }
                    stiffness[(row, column)] += density * weight;
                    if row % 2 == column % 2 {
                        let product = point.values[row / 2] * point.values[column / 2];
                        mass[(row, column)] += c64::new(self.density * product * weight, 0.0);
                    }
                }
            }
        }
        if let Some(state) = stress {
            // On the curved edge u_theta turns pressure and traction by u_theta / a:
            // force p u_theta / a e_theta - tau u_theta / a e_r for each unit of area.
            stiffness[(1, 1)] -= c64::new(state.pressure, 0.0);
            stiffness[(0, 1)] += c64::new(0.0, state.shear);
        }
        (stiffness, mass)
    }

    /// Eigenvalues with `Im(lambda) > 0` by rising frequency; for `n > 0` both members of each pair.
    ///
    /// `lambda^2 + alpha lambda + (1 + beta lambda) kappa = 0`. The field `e^{i n theta + lambda t}` travels against the rotor where
    /// `Im(lambda) > 0`; a root with `Im(lambda) < 0` is the conjugate of a wave that travels with it.
    pub fn eigenvalues(&self, n: usize, contact: &Contact, rayleigh: Rayleigh) -> Vec<Eigenvalue> {
        damped(&self.kappas(n, contact), rayleigh, n)
    }

    /// Eigenvalue of one branch (1 = lowest of its harmonic) and travelling direction.
    ///
    /// The branch is counted by frequency among the waves of that direction, which follows it from
    /// `mu = 0` as long as no two branches of the harmonic cross.
    pub fn branch(
        &self,
        harmonic: usize,
        branch: usize,
        direction: i8,
        contact: &Contact,
        rayleigh: Rayleigh,
    ) -> Eigenvalue {
        let all = self.eigenvalues(harmonic, contact, rayleigh).into_iter();
        let own = all.filter(|mode| mode.direction == direction).nth(branch - 1);
        own.expect("the spectral element has far more branches than any test asks for")
    }

    /// Lowest friction coefficient in `(0, limit)` at which the backward wave of a branch turns
    /// unstable, by a scan in steps of 0.01 and bisection to round-off.
    pub fn critical_friction(
        &self,
        harmonic: usize,
        branch: usize,
        contact: &Contact,
        rayleigh: Rayleigh,
        limit: f64,
    ) -> Option<f64> {
        let growth = |friction_coefficient: f64| {
            let contact = Contact { friction_coefficient, ..*contact };
            self.branch(harmonic, branch, -1, &contact, rayleigh).lambda.re
        };
        let step = 0.01;
        let mut stable = 0.0;
        while growth(stable + step) <= 0.0 {
            stable += step;
            if stable >= limit {
                return None;
            }
        }
        let (mut low, mut high) = (stable, stable + step);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            (low, high) = if growth(middle) > 0.0 { (low, middle) } else { (middle, high) };
        }
        Some(0.5 * (low + high))
    }
}

/// Elastic energy density of two gradients: `lambda tr tr + 2 G epsilon : epsilon`.
fn elastic(lambda: f64, shear: f64, v: &[f64; 4], u: &[f64; 4]) -> f64 {
    lambda * (v[0] + v[3]) * (u[0] + u[3])
        + 2.0 * shear * (v[0] * u[0] + v[3] * u[3])
        + shear * (v[1] + v[2]) * (u[1] + u[2])
}

/// `grad(v)^* : (grad(u) sigma)`, with the factors `i` of the mixed gradients restored.
fn geometric(sigma: &Stress, v: &[f64; 4], u: &[f64; 4]) -> c64 {
    let normal = sigma.radial * (v[0] * u[0] + v[2] * u[2])
        + sigma.circumferential * (v[1] * u[1] + v[3] * u[3]);
    // Rows (u_rr, i u_rtheta) and (i u_thetar, u_thetatheta): the products with sigma_rtheta.
    let mixed = sigma.shear * (v[0] * u[1] - v[1] * u[0] + v[3] * u[2] - v[2] * u[3]);
    c64::new(normal, mixed)
}

/// All eigenvalues of `K x = kappa M x`, as inverses of those of `K^-1 M`, whose round-off favours the small `kappa` wanted here.
pub fn smallest_first(stiffness: &Mat<c64>, mass: &Mat<c64>) -> Vec<c64> {
    let flexibility = stiffness.partial_piv_lu().solve(mass).eigenvalues();
    let values = flexibility.expect("the dense eigenvalue iteration converges").into_iter();
    let mut kappas: Vec<c64> = values.map(|value| c64::new(1.0, 0.0) / value).collect();
    kappas.sort_by(|x, y| x.re.total_cmp(&y.re));
    kappas
}

/// The eigenvalues of some `kappa` with damping, by rising frequency.
pub fn damped(kappas: &[c64], rayleigh: Rayleigh, harmonic: usize) -> Vec<Eigenvalue> {
    let pairs = kappas.iter().flat_map(|&kappa| damped_pair(kappa, rayleigh, harmonic));
    let mut all: Vec<Eigenvalue> = pairs.flatten().collect();
    all.sort_by(|x, y| x.lambda.im.total_cmp(&y.lambda.im));
    all
}

/// Both roots of `lambda^2 + alpha lambda + (1 + beta lambda) kappa = 0` that oscillate
/// (`|Re| < |Im|`), turned to `Im(lambda) > 0`; one only for `n = 0`.
fn damped_pair(kappa: c64, (alpha, beta): Rayleigh, harmonic: usize) -> [Option<Eigenvalue>; 2] {
    let half = (c64::new(alpha, 0.0) + kappa * beta) * 0.5;
    let root = (half * half - kappa).sqrt();
    let mut roots = [root - half, -root - half];
    roots.sort_by(|x, y| y.im.total_cmp(&x.im));
    let [backward, forward] = roots;
    let direction = if harmonic == 0 { 0 } else { -1 };
    // Of the far overdamped roots of the largest kappa, friction gives some a small imaginary part.
    let oscillates = |mode: Eigenvalue| (mode.lambda.im > mode.lambda.re.abs()).then_some(mode);
    let first = oscillates(Eigenvalue { lambda: backward, direction });
    let second = oscillates(Eigenvalue { lambda: forward.conj(), direction: -direction });
    [first, if harmonic == 0 { None } else { second }]
}
