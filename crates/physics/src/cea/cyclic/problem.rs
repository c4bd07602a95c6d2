//! The eigenproblem of one harmonic as a function of one scalar `theta`.

use crate::cea::counted::STANDSTILL;
use crate::cea::cyclic::*;
use crate::fem::own_frequency_step;
use crate::linalg::banded::{BandedLu, BandedMatrix};
use crate::linalg::dense::add;
use crate::linalg::vectors::{dot, largest};
use crate::prestress::{FrictionPolynomial, MovingHarmonic, evaluate};

/// `T(theta) x = 0` for one harmonic.
///
/// With proportional damping the unknown is `theta = kappa` of `T = K - kappa M`, and `lambda^2 + alpha lambda + (1 + beta lambda) kappa =
/// 0`; otherwise it is `theta = lambda` of `T = lambda^2 M + lambda C + K`. Either way `T = a(theta) M + b(theta) C + K`. With losses `K`
/// has `sum_p g_p(lambda) K_p` beside it: `i eta K_p` for the wave `+n`, the conjugate for `-n`.
pub(super) struct HarmonicProblem {
    pub tangent: HarmonicTangent,
    /// Whether it is followed as it stands: in the plane without losses.
    pub is_direct: bool,
    pub dimension: usize,
    pub half_bandwidth: usize,
}

/// The matrices at one friction value and their derivatives with respect to it, as bands of values.
#[derive(Clone)]
pub(super) struct Matrices {
    pub now: MovingHarmonic,
    /// `None` of what does not change.
    rates: MotionMatrices<Option<Vec<c64>>>,
    /// Largest row sums of `M`, `C`, `K`.
    norms: [f64; 3],
}

impl Matrices {
    /// The same with the stiffness of one place, whatever the eigenvalue.
    pub fn frozen(&self, theta: c64) -> Self {
        let mut frozen = self.clone();
        frozen.now.matrices.stiffness = self.now.stiffness_at(theta).into_owned();
        frozen.now.matrices.losses.clear();
        frozen.rates.losses.clear();
        frozen
    }
}

impl HarmonicProblem {
    pub fn new(tangent: HarmonicTangent, is_direct: bool) -> Self {
        Self {
            is_direct,
            dimension: tangent.mass[0].dimension(),
            half_bandwidth: tangent.mass[0].half_bandwidth(),
            tangent,
        }
    }

    pub fn is_proportional(&self) -> bool {
        self.tangent.damping.is_none()
    }

    /// Matrices at friction coefficient `mu`.
    pub fn at(&self, mu: f64) -> Matrices {
        let (z, own) = (c64::new(0.0, mu), &self.tangent);
        let now = own.at(mu);
        let mut damping_rate = own.damping.as_ref().and_then(|c| rate(c, z));
        if let Some(dashpots) = &own.friction_dashpots {
            // Of `mu P`: `P + mu P'`.
            let sum =
                damping_rate.get_or_insert_with(|| vec![c64::ZERO; now.matrices.damping.len()]);
            add(sum, c64::ONE, &evaluate(dashpots, z));
            for (sum, slope) in sum.iter_mut().zip(rate(dashpots, z).iter().flatten()) {
                *sum += slope * mu;
            }
        }
        let losses = own.losses.iter().map(|(gain, own)| (gain.clone(), rate(own, z)));
        let rates = MotionMatrices {
            stiffness: rate(&own.stiffness, z),
            damping: damping_rate,
            mass: rate(&own.mass, z),
            losses: losses.collect(),
        };
        Matrices { rates, norms: self.norms(&now.matrices), now }
    }

    /// Matrices without friction and with the share `damped` of the damping; the derivative is that with respect to `damped`.
    pub fn at_damping(&self, damped: f64) -> Matrices {
        let mut own = self.at(0.0);
        let now = &mut own.now.matrices;
        own.rates = now.map(|own| Some(own.clone())); // Linear in the share: the rates are the full matrices.
        (own.rates.mass, own.rates.stiffness) = (None, None);
        let changing = now.losses.iter_mut().map(|(_, own)| own).chain([&mut now.damping]); // Mass and stiffness stay: losses and C grow.
        changing.flatten().for_each(|value| *value *= damped);
        own
    }

    fn norms(&self, now: &MotionMatrices<Vec<c64>>) -> [f64; 3] {
        [&now.mass, &now.damping, &now.stiffness].map(|values| {
            let rows = values.chunks_exact(2 * self.half_bandwidth + 1);
            let sums = rows.map(|row| row.iter().map(|v| v.re.abs() + v.im.abs()).sum::<f64>()); // At most sqrt(2) times the sum of moduli.
            sums.fold(0.0, f64::max)
        })
    }

    /// `C` where `kappa` does not stand for it.
    fn damping<'a>(&self, at: &'a Matrices) -> Option<&'a [c64]> {
        (!self.is_proportional()).then_some(&at.now.matrices.damping[..])
    }

    /// `(a, b)` and their derivatives at `theta`.
    fn factors(&self, theta: c64) -> [c64; 4] {
        if self.is_proportional() {
            [-theta, c64::ZERO, c64::new(-1.0, 0.0), c64::ZERO] // T = K - kappa M.
        } else {
            [theta * theta, theta, theta + theta, c64::ONE] // T = K + theta C + theta^2 M.
        }
    }

    /// Band of `T(theta)` into `values`.
    pub fn assemble(&self, at: &Matrices, theta: c64, values: &mut Vec<c64>) {
        let [a, b, _, _] = self.factors(theta);
        values.clear();
        let mass = &at.now.matrices.mass;
        values.extend(at.now.stiffness_at(theta).iter().zip(mass).map(|(k, m)| k + a * m));
        if let Some(damping) = self.damping(at) {
            for (value, c) in values.iter_mut().zip(damping) {
                *value += b * c;
            }
        }
    }

    /// `T'(theta) x` or its adjoint.
    pub fn apply_slope(&self, at: &Matrices, theta: c64, x: &[c64], adjoint: bool) -> Vec<c64> {
        let [_, _, a, b] = self.factors(theta);
        let MotionMatrices { mass, damping, .. } = &at.now.matrices;
        at.now.combine([(a, &mass[..]), (b, damping)], x, adjoint)
    }

    /// Two-sided Rayleigh functional: the root nearest to `theta` of `y^H T(.) x = 0`, and `y^H T' x` there.
    pub fn rayleigh_quotient(&self, at: &Matrices, theta: c64, x: &[c64], y: &[c64]) -> (c64, c64) {
        let form = |values: &[c64]| dot(y, &at.now.combine([(c64::ONE, values)], x, false));
        let (m, k) = (form(&at.now.matrices.mass), form(&at.now.stiffness_at(theta)));
        let Some(damping) = self.damping(at) else { return (k / m, -m) };
        let c = form(damping);
        let root = (c * c - m * k * 4.0).sqrt(); // m theta^2 + c theta + k = 0; without damping k - theta m = 0.
        let candidates = [(root - c) / (m * 2.0), (-root - c) / (m * 2.0)];
        let distance = |candidate: c64| (candidate - theta).norm();
        let nearest = if distance(candidates[0]) <= distance(candidates[1]) { 0 } else { 1 };
        let root = candidates[nearest];
        let slope = m * root * 2.0 + c; // y^H T' x = 2 m theta + c.
        let step = self.own_step(at, theta, [x, y], (root - theta, slope));
        (step.map_or(root, |step| theta + step), slope)
    }

    /// The step of an eigenvalue whose stiffness follows it, from the `step` at fixed stiffness and `y^H T' x`; `None` without tables.
    fn own_step(
        &self,
        at: &Matrices,
        theta: c64,
        vectors: [&[c64]; 2],
        (step, slope): (c64, c64),
    ) -> Option<c64> {
        Some(own_frequency_step(step, self.own_slope(at, theta, vectors)? / slope))
    }

    /// `y^H (dK / d omega) x` of stiffness that follows its frequency; `None` without tables.
    pub fn own_slope(&self, at: &Matrices, theta: c64, [x, y]: [&[c64]; 2]) -> Option<c64> {
        let tabled = at.now.matrices.own_rates(theta);
        let own = tabled.map(|(rate, values)| dot(y, &at.now.combine([(rate, values)], x, false)));
        own.reduce(|sum, own| sum + own)
    }

    /// `d theta / d parameter = -y^H (dT) x / y^H T' x`.
    pub fn rate_of(&self, at: &Matrices, theta: c64, x: &[c64], y: &[c64], slope: c64) -> c64 {
        let [a, b, _, _] = self.factors(theta);
        let MotionMatrices { stiffness, damping, mass, losses } = &at.rates;
        let terms = [(a, mass), (b, damping), (c64::ONE, stiffness)].into_iter();
        let losses = losses.iter().map(|(gain, own)| (gain.at(theta), own));
        let change: c64 = terms
            .chain(losses)
            .filter_map(|(factor, values)| values.as_ref().map(|v| (factor, v)))
            .map(|(factor, values)| dot(y, &at.now.combine([(factor, values)], x, false)))
            .sum();
        let step = -change / slope;
        self.own_step(at, theta, [x, y], (step, slope)).unwrap_or(step)
    }

    /// Residual of the quadratic problem in the largest-entry norm, see [`crate::cea::ComplexMode`].
    pub fn residual(&self, at: &Matrices, theta: c64, x: &[c64]) -> f64 {
        let lambda = self.eigenvalue(theta);
        largest(&at.now.apply(lambda, x, false)) / (self.size(at, lambda, x) * largest(x))
    }

    /// `|lambda|^2 |M| + |lambda| |C| + |K|`.
    fn size(&self, at: &Matrices, lambda: c64, x: &[c64]) -> f64 {
        let [m, _, k] = at.norms;
        let c = self.damping_norm(at, x);
        let size = lambda.norm();
        size * size * m + size * c + k
    }

    /// How well rounded matrices determine an eigenvalue, see [`crate::cea::ComplexMode`].
    pub fn uncertainty(&self, at: &Matrices, pair: &Eigenpair) -> f64 {
        let lambda = self.eigenvalue(pair.theta);
        let slope = dot(&pair.y, &at.now.apply_slope(lambda, &pair.x, false));
        f64::EPSILON * self.size(at, lambda, &pair.x) / (slope.norm() * lambda.norm()) // Of unit vectors: eps |T| / (|y^H T' x| |lambda|).
    }

    /// Largest row sum of `C`; in three dimensions each column counts as much as the vector has of it: the motion across the sliding
    /// is small where its dashpot is strong.
    fn damping_norm(&self, at: &Matrices, x: &[c64]) -> f64 {
        let Some(damping) = self.damping(at).filter(|_| !self.is_direct) else {
            return at.norms[1];
        };
        let h = self.half_bandwidth;
        let sums = damping.chunks_exact(2 * h + 1).enumerate().map(|(row, band)| {
            let (first, last) = (row.saturating_sub(h), (row + h + 1).min(self.dimension));
            let entries = band[first + h - row..last + h - row].iter();
            entries.zip(&x[first..last]).map(|(c, x)| c.norm() * x.norm()).sum::<f64>() // sum_j |c_ij| |x_j|.
        });
        sums.fold(0.0, f64::max) / largest(x)
    }

    /// Whether a table makes the stiffness follow the eigenvalue.
    pub fn is_tabled(&self) -> bool {
        self.tangent.losses.iter().any(|(gain, _)| gain.0.is_some())
    }

    /// Whether `K` is not the same for the waves `+n` and `-n`.
    pub fn is_lossy(&self) -> bool {
        !self.tangent.losses.is_empty()
    }

    /// Dense `M`, `C`, `K`.
    pub fn dense(&self, at: &Matrices) -> [Mat<c64>; 3] {
        let (n, h) = (self.dimension, self.half_bandwidth);
        let full = |values: &[c64]| {
            Mat::from_fn(n, n, |i, j| match i.abs_diff(j) <= h {
                true => values[i * (2 * h + 1) + j + h - i], // Row i begins at column i - h.
                false => c64::ZERO,
            })
        };
        let MotionMatrices { mass, damping, stiffness, .. } = &at.now.matrices;
        [full(mass), full(damping), full(stiffness)]
    }

    /// Kinetic energy of the contact's nodes, and of axial motion, over the whole, see [`crate::cea::ComplexMode`].
    pub fn shares(&self, x: &[c64]) -> [f64; 2] {
        let real: Vec<f64> = x.iter().map(|v| v.re).collect();
        let imaginary: Vec<f64> = x.iter().map(|v| v.im).collect();
        let energy = |form: &BandedMatrix| energy(form, &real) + energy(form, &imaginary); // x^H F x of a real symmetric F.
        let HarmonicTangent { shares, mass, .. } = &self.tangent;
        shares.each_ref().map(|part| energy(part) / energy(&mass[0]))
    }

    /// `lambda` with `Im >= 0` of the wave `+n`.
    pub fn eigenvalue(&self, theta: c64) -> c64 {
        if !self.is_proportional() {
            return theta;
        }
        self.tangent.rayleigh.eigenvalue(theta)
    }

    /// `theta` of an eigenvalue `lambda` of the wave `+n`.
    pub fn theta(&self, lambda: c64) -> c64 {
        if self.is_proportional() { self.tangent.rayleigh.kappa(lambda) } else { lambda }
    }

    /// Whether a motion hardly oscillates any more under the dashpot across the sliding, on the way to where it does not at all.
    pub fn is_ending(&self, theta: c64) -> bool {
        !self.is_direct && theta.im.abs() < STANDSTILL * theta.norm()
    }

    /// `d lambda / d theta`.
    pub fn eigenvalue_slope(&self, theta: c64) -> c64 {
        if !self.is_proportional() {
            return c64::ONE;
        }
        self.tangent.rayleigh.eigenvalue_slope(self.eigenvalue(theta), theta)
    }

    /// Space for the factorization of `T`.
    pub fn workspace(&self) -> BandedLu {
        BandedLu::new(self.dimension, self.half_bandwidth)
    }
}

/// `x^T F x`.
fn energy(form: &BandedMatrix, x: &[f64]) -> f64 {
    x.iter().zip(form.multiply(x)).map(|(a, b)| a * b).sum()
}

/// `dP / d mu = i dP / dz`; `None` where it vanishes identically.
fn rate(polynomial: &FrictionPolynomial, z: c64) -> Option<Vec<c64>> {
    if polynomial.len() == 1 {
        return None;
    }
    let mut values = vec![c64::ZERO; polynomial[0].values().len()];
    let mut factor = c64::I; // dz / dmu = i.
    for (power, coefficient) in polynomial.iter().enumerate().skip(1) {
        for (value, v) in values.iter_mut().zip(coefficient.values()) {
            *value += factor * (power as f64 * v); // d(z^p) / dmu = i p z^{p-1}.
        }
        factor *= z;
    }
    Some(values)
}
