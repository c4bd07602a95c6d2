//! Derivatives of the eigenvalues by the parameters of the model.

use super::CyclicSweep;
use super::branch::path_theta;
use super::follow::Follower;
use super::problem::HarmonicProblem;
use super::vectors::ZERO;
use crate::cea::{CeaError, ModeBranch};
use crate::contact::LawParameter;
use crate::linalg::banded::BandedMatrix;
use crate::linalg::c64;
use crate::prestress::{HarmonicTangent, Parameter, SectorTangent, TangentRate};
use rayon::prelude::*;

/// Derivatives of one eigenvalue, `d lambda / d parameter`, rad/s for each unit of the parameter.
///
/// ```text
/// d lambda = - y^H (lambda^2 dM + lambda dC + dK) x / y^H (2 lambda M + C) x
/// ```
///
/// with left and right vectors of one harmonic, so that pairs that coincide at `mu = 0` do no harm. The
/// matrices' derivatives are analytic and include the change of the prestress.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// Circumferential harmonic.
    pub harmonic: usize,
    /// Branch within the harmonic.
    pub branch: usize,
    /// Direction of travel of the branch.
    pub direction: i8,
    /// Where the derivatives are taken.
    pub friction_coefficient: f64,
    /// Eigenvalue there, rad/s.
    pub eigenvalue: c64,
    /// With respect to the friction coefficient `mu`.
    pub friction: c64,
    /// With respect to the normal stiffness `k_n`, Pa/m; `None` for rigid contact.
    pub normal_stiffness: Option<c64>,
    /// With respect to `alpha_R`, 1/s.
    pub mass_coefficient: c64,
    /// With respect to `beta_R`, s.
    pub stiffness_coefficient: c64,
    /// With respect to Young's modulus, Pa; `None` for an orthotropic material.
    pub young_modulus: Option<c64>,
    /// With respect to Poisson's ratio; `None` for an orthotropic material.
    pub poisson_ratio: Option<c64>,
    /// With respect to the density, kg/m3.
    pub density: c64,
    /// With respect to static over kinetic friction `q`; `None` for constant friction.
    pub static_friction_ratio: Option<c64>,
    /// With respect to the decay speed `v_c`, m/s; `None` for constant friction.
    pub decay_speed: Option<c64>,
    /// With respect to Young's modulus (Pa), Poisson's ratio and density (kg/m3) of a deformable shaft, and to the
    /// `alpha_R` (1/s) and `beta_R` (s) that it has of its own; `None` of what there is not.
    pub shaft: [Option<c64>; 5],
    /// With respect to `cubic_stiffness` (Pa/m3), `reference_pressure` (Pa) and `height` (m) of contact that stiffens with
    /// pressure; `None` of what its law has not.
    pub normal_law: [Option<c64>; 3],
}

/// Sensitivities of every branch of a sweep at one friction coefficient within its range.
///
/// # Errors
/// [`CeaError::Friction`] outside the range; [`CeaError::LostHarmonic`] where a branch cannot be
/// solved for there.
pub fn sensitivities(
    result: &CyclicSweep,
    friction_coefficient: f64,
) -> Result<Vec<Sensitivity>, CeaError> {
    let tangent = &result.tangent;
    let mut rates = Vec::new();
    for parameter in PARAMETERS {
        rates.push(tangent.rate(parameter)?);
    }
    result
        .branches
        .par_iter()
        .map(|branch| of_branch(tangent, &rates, branch, friction_coefficient))
        .collect()
}

pub(super) const PARAMETERS: [Parameter; 16] = [
    Parameter::NormalStiffness,
    Parameter::MassCoefficient,
    Parameter::StiffnessCoefficient,
    Parameter::YoungModulus(0),
    Parameter::PoissonRatio(0),
    Parameter::Density(0),
    Parameter::StaticFrictionRatio,
    Parameter::DecaySpeed,
    Parameter::YoungModulus(1),
    Parameter::PoissonRatio(1),
    Parameter::Density(1),
    Parameter::OwnMassCoefficient,
    Parameter::OwnStiffnessCoefficient,
    Parameter::NormalLaw(LawParameter::CubicStiffness),
    Parameter::NormalLaw(LawParameter::ReferencePressure),
    Parameter::NormalLaw(LawParameter::Height),
];

impl Sensitivity {
    /// Of a branch, from its derivatives with respect to the friction coefficient and to [`PARAMETERS`].
    pub(super) fn new(
        branch: &ModeBranch,
        friction_coefficient: f64,
        eigenvalue: c64,
        friction: c64,
        responses: &[Option<c64>],
    ) -> Self {
        let given = |index: usize| responses[index].unwrap_or(ZERO);
        Self {
            harmonic: branch.harmonic,
            branch: branch.branch,
            direction: branch.direction,
            friction_coefficient,
            eigenvalue,
            friction,
            normal_stiffness: responses[0],
            mass_coefficient: given(1),
            stiffness_coefficient: given(2),
            young_modulus: responses[3],
            poisson_ratio: responses[4],
            density: given(5),
            static_friction_ratio: responses[6],
            decay_speed: responses[7],
            shaft: std::array::from_fn(|i| responses[8 + i]),
            normal_law: std::array::from_fn(|i| responses[13 + i]),
        }
    }
}

/// The wave that a branch is: `+n`, or `-n`, which is the complex conjugate of a root of the wave `+n`'s problem with `Im < 0`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wave {
    is_backward: bool,
}

impl Wave {
    pub fn of(branch: &ModeBranch, sliding_direction: f64) -> Self {
        Self { is_backward: f64::from(branch.direction) * sliding_direction > 0.0 }
    }

    /// What belongs to the branch of what belongs to the wave `+n`, and the other way round.
    pub fn own(self, value: c64) -> c64 {
        if self.is_backward { value.conj() } else { value }
    }
}

fn of_branch(
    tangent: &SectorTangent,
    rates: &[Option<TangentRate>],
    branch: &ModeBranch,
    friction: f64,
) -> Result<Sensitivity, CeaError> {
    let n = branch.harmonic;
    let matrices = tangent.harmonic(n);
    let problem = HarmonicProblem::new(matrices.clone(), tangent.is_standing(n));
    let guess = branch.interpolate(friction);
    let guess = guess.ok_or(CeaError::Friction { value: friction })?;
    let wave = Wave::of(branch, tangent.base().sliding_direction);
    let theta = path_theta(&problem, wave.is_backward, guess);
    let found = Follower::new(&problem).find(&problem.at(friction), friction, theta);
    let found = found.ok_or(CeaError::LostHarmonic { harmonic: n, friction })?;
    let own = wave.own(found.theta);
    let eigenvalue = problem.eigenvalue(own);
    let root = wave.own(eigenvalue);
    let z = c64::new(0.0, friction);
    let forms = |set: &HarmonicTangent| {
        let of = |matrix: &[BandedMatrix]| form(matrix, z, &found.y, &found.x);
        let dashpots = set.friction_dashpots.as_ref();
        let dashpots = dashpots.map_or(ZERO, |c| of(c));
        let damping = set.damping.as_ref().map_or(ZERO, |c| of(c));
        [of(&set.mass), damping + dashpots * friction, of(&set.stiffness)]
    };
    let rayleigh = tangent.rayleigh();
    let [m, mut c, k] = forms(&matrices);
    if problem.is_proportional() {
        c = m * rayleigh.mass_coefficient + k * rayleigh.stiffness_coefficient;
    }
    let slope = m * root * 2.0 + c;
    let respond = |rate: &Option<TangentRate>| {
        let rate = tangent.harmonic_rate(rate.as_ref()?, n);
        let [m, c, k] = forms(&rate);
        let response = -(root * root * m + root * c + k) / slope;
        Some(wave.own(response))
    };
    let responses: Vec<Option<c64>> = rates.iter().map(respond).collect();
    let by_friction = problem.eigenvalue_slope(own) * wave.own(found.rate);
    Ok(Sensitivity::new(branch, friction, eigenvalue, by_friction, &responses))
}

/// `y^H P(z) x`.
fn form(polynomial: &[BandedMatrix], z: c64, y: &[c64], x: &[c64]) -> c64 {
    let mut power = c64::new(1.0, 0.0);
    let mut total = ZERO;
    for matrix in polynomial {
        for (row, left) in y.iter().enumerate() {
            let columns = matrix.columns(row);
            let product: c64 = columns.map(|column| x[column] * matrix.get(row, column)).sum();
            total += power * left.conj() * product;
        }
        power *= z;
    }
    total
}
