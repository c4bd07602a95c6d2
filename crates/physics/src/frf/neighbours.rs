//! Lines close to each other, solved from one factorization.

use super::factors::Analyses;
use super::krylov::KrylovSpace;
use super::system::{BACKWARD_ERROR_BOUND, GROWTH_BOUND};
use super::{FrfSystem, Port};
use crate::fem::RayleighDamping;
use crate::linalg::{ComplexSparseLu, MatMut, SparseLdl, SparseLu, c64};
use std::f64::consts::TAU;

/// The response at each line; `None` where only a factorization of its own will do.
pub(super) fn solve_together(
    system: &FrfSystem,
    analyses: &Analyses,
    force: &Port,
    response: &Port,
    lines: &[f64],
) -> Vec<Option<c64>> {
    let solved = match system.proportional {
        Some(rayleigh) => proportional(system, analyses, rayleigh, force, lines),
        None => general(system, analyses, force, lines),
    };
    let Some(solved) = solved else {
        return vec![None; lines.len()];
    };
    let accepted = |(f, x): (&f64, Vec<c64>)| {
        let (residual, size) = system.residual(*f, &x, force);
        let is_solved = residual <= BACKWARD_ERROR_BOUND * size && size < GROWTH_BOUND;
        is_solved.then(|| response.observe(&x))
    };
    lines.iter().zip(solved).map(accepted).collect()
}

/// Solutions of lines `(1 + i omega beta) (K - s M) x = f`, `s = (omega^2 - i omega alpha) / (1 + i omega beta)`.
///
/// With `B = (K - sigma M)^{-1} M` and `g = (K - sigma M)^{-1} f`, both real, every line is
/// `(1 - (s - sigma) B) x = g`: one real space serves them all, larger for lines far apart or close
/// to a resonance.
fn proportional(
    system: &FrfSystem,
    analyses: &Analyses,
    rayleigh: RayleighDamping,
    force: &Port,
    lines: &[f64],
) -> Option<Vec<Vec<c64>>> {
    let count = system.dimension();
    let middle = 0.5 * (lines[0] + lines[lines.len() - 1]);
    let factors = RealFactors::new(system, analyses, middle)?;
    let mut space = KrylovSpace::new(factors.solve(force.force(count)));
    let sigma = (TAU * middle).powi(2);
    let distance = |f: &f64| rayleigh.kappa(c64::new(0.0, TAU * f)) - sigma;
    let distances: Vec<c64> = lines.iter().map(distance).collect();
    let [mass, _, _] = system.matrices();
    let solved = space.solve(&distances, |v| factors.solve(system.multiply(mass, v, false)));
    let vectors = lines.iter().zip(solved).map(|(f, mut y)| {
        let factor = c64::new(1.0, TAU * f * rayleigh.stiffness_coefficient);
        y.iter_mut().for_each(|y| *y /= factor);
        space.combined(&y, count)
    });
    Some(vectors.collect())
}

/// Solutions of lines with any damping.
///
/// About the middle line `omega_0`, with `d = omega - omega_0`, the matrix is
/// `A = A_0 + d (i C - 2 omega_0 M) - d^2 M`. In the state `z = (x, d x / omega_0)` this is linear in `d`:
///
/// ```text
/// (1 - d B) z = (A_0^{-1} f, 0),   B (x, w) = (A_0^{-1} [(2 omega_0 M - i C) x + omega_0 M w], x / omega_0)
/// ```
fn general(
    system: &FrfSystem,
    analyses: &Analyses,
    force: &Port,
    lines: &[f64],
) -> Option<Vec<Vec<c64>>> {
    let count = system.dimension();
    let middle = 0.5 * (lines[0] + lines[lines.len() - 1]);
    let omega = TAU * middle;
    let factors =
        ComplexSparseLu::factorize(&analyses.lu, system.dynamic_stiffness(middle)).ok()?;
    let solve = |x: &mut [c64]| {
        factors.solve_in_place(MatMut::from_column_major_slice_mut(x, count, 1));
    };
    let mut start = force.complex_force(count);
    start.resize(2 * count, c64::new(0.0, 0.0));
    solve(&mut start[..count]);
    let mut space = KrylovSpace::new(start);
    let distances: Vec<c64> = lines.iter().map(|f| c64::new(TAU * f - omega, 0.0)).collect();
    let solved = space.solve(&distances, |z| {
        let (x, w) = z.split_at(count);
        let mut image = system.slope(omega, x, w);
        solve(&mut image);
        image.extend(x.iter().map(|x| x / omega));
        image
    });
    let vectors = solved.iter().map(|y| space.combined(y, count));
    Some(vectors.collect())
}

/// Real factors of `K - sigma M`.
enum RealFactors {
    Symmetric(SparseLdl),
    General(Box<SparseLu>),
}

impl RealFactors {
    fn new(system: &FrfSystem, analyses: &Analyses, frequency_hz: f64) -> Option<Self> {
        // On an undamped resonance there are no factors; beside it they serve as well.
        [1.0, 1.000_7, 0.999_1].iter().find_map(|moved| {
            let values = system.undamped_stiffness(frequency_hz * moved);
            if system.is_symmetric {
                let ldl = SparseLdl::factorize(&analyses.ldl, &values).ok()?;
                Some(Self::Symmetric(ldl))
            } else {
                let lu = SparseLu::factorize(&analyses.lu, values).ok()?;
                Some(Self::General(Box::new(lu)))
            }
        })
    }

    fn solve(&self, mut x: Vec<f64>) -> Vec<f64> {
        let count = x.len();
        let column = MatMut::from_column_major_slice_mut(&mut x, count, 1);
        match self {
            Self::Symmetric(ldl) => ldl.solve_in_place(column),
            Self::General(lu) => lu.solve_in_place(column),
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{ContactStiffness, SlidingContact};
    use crate::fem::{ElasticMaterial, MassKind, PlaneFormulation};
    use crate::frf::factors::factorized;
    use crate::mesh::{AnnulusMesh, AnnulusSpecification, BoundaryCondition, ElementKind};
    use crate::prestress::{Assembly, DampingModel, TangentOptions};

    fn sliding(damping_model: DampingModel) -> FrfSystem {
        let specification = AnnulusSpecification {
            inner_radius: 0.0205,
            outer_radius: 0.0905,
            circumferential_elements: 36,
            radial_elements: 8,
            radial_grading: 1.0,
            element: ElementKind::Quad4,
            outer: BoundaryCondition::Clamped,
            shaft: None,
        };
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let material = ElasticMaterial {
            young_modulus: 2.5e9,
            poisson_ratio: 0.3805,
            density: 1228.0,
            formulation: PlaneFormulation::PlaneStrain,
            ..ElasticMaterial::PLAIN
        };
        let contact = SlidingContact {
            decay: None,
            friction_coefficient: 0.3,
            interference: 25e-6,
            rotation_speed: 63.9,
        };
        let options = TangentOptions {
            mass: MassKind::Consistent,
            geometric_stiffness: true,
            damping: RayleighDamping { mass_coefficient: 40.0, stiffness_coefficient: 4.5e-7 },
            damping_model,
            contact: ContactStiffness::default(),
        };
        let body = Assembly::of_edge(&mesh, &material, &contact, options.contact).unwrap();
        let tangent = body.tangent(&body.state(0.3).unwrap(), &options).unwrap();
        FrfSystem::sliding(&tangent, contact.friction_coefficient)
    }

    #[test]
    fn lines_10_hz_apart_need_no_factorization_of_their_own() {
        for damping_model in [DampingModel::WholeTangent, DampingModel::BodyOnly] {
            let system = sliding(damping_model);
            let analyses = Analyses::of(&system).unwrap();
            // Two of the lines lie within the bandwidth of unstable modes (9.9 and 10.5 kHz).
            for first in [500.0, 5000.0, 9850.0, 10_450.0] {
                let lines: Vec<f64> = (0..16).map(|k| first + 10.0 * f64::from(k)).collect();
                let [from, to] = [5, 200].map(|unknown| Port(vec![(unknown, 1.0)]));
                let shared = solve_together(&system, &analyses, &from, &to, &lines);
                for (f, found) in lines.iter().zip(shared) {
                    let own = factorized(&system, &analyses.lu, &from, &to, *f).unwrap();
                    // Backward errors of 1e-14 times condition numbers of 1e4 or less.
                    let found = found.expect("solved together");
                    assert!((found - own).norm() < 1e-10 * own.norm(), "{f}: {found} {own}");
                }
            }
        }
    }
}
