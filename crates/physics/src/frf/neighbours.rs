//! Lines close to each other, solved from one factorization.

use super::driven::Driven;
use super::krylov::KrylovSpace;
use super::system::{BACKWARD_ERROR_BOUND, GROWTH_BOUND};
use crate::fem::RayleighDamping;
use crate::linalg::c64;
use std::f64::consts::TAU;

impl Driven<'_> {
    /// The response at each line; `None` where only a factorization of its own will do.
    pub fn solve_together(&self, lines: &[f64]) -> Vec<Option<c64>> {
        let solved = match self.system.proportional {
            Some(rayleigh) => self.proportional(rayleigh, lines),
            None => self.general(lines),
        };
        let Some(solved) = solved else {
            return vec![None; lines.len()];
        };
        let accepted = |(f, x): (&f64, Vec<c64>)| {
            let (residual, size) = self.system.residual(*f, &x, self.force);
            let is_solved = residual <= BACKWARD_ERROR_BOUND * size && size < GROWTH_BOUND;
            is_solved.then(|| self.response.observe(&x))
        };
        lines.iter().zip(solved).map(accepted).collect()
    }

    /// Solutions of lines `(1 + i omega beta) (K - s M) x = f`, `s = (omega^2 - i omega alpha) / (1 + i omega beta)`.
    ///
    /// With `B = (K - sigma M)^{-1} M` and `g = (K - sigma M)^{-1} f`, both real, every line is `(1 - (s - sigma) B) x = g`: one real space
    /// serves them all, larger for lines far apart or close to a resonance.
    fn proportional(&self, rayleigh: RayleighDamping, lines: &[f64]) -> Option<Vec<Vec<c64>>> {
        let (system, count) = (self.system, self.system.dimension());
        let middle = 0.5 * (lines[0] + lines[lines.len() - 1]);
        let factors = self.real_factors(middle).ok()?;
        let mut space = KrylovSpace::new(factors.solve(self.force.force(count)));
        let sigma = (TAU * middle).powi(2);
        let distance = |f: &f64| rayleigh.kappa(c64::new(0.0, TAU * f)) - sigma;
        let distances: Vec<c64> = lines.iter().map(distance).collect();
        let mass = &system.matrices.mass;
        let multiply = |v: &[f64]| factors.solve(system.multiply(mass, v));
        let found = space.solve(&distances, multiply);
        let vectors = lines.iter().zip(found).map(|(f, mut y)| {
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
    fn general(&self, lines: &[f64]) -> Option<Vec<Vec<c64>>> {
        let (system, count) = (self.system, self.system.dimension());
        let middle = 0.5 * (lines[0] + lines[lines.len() - 1]);
        let omega = TAU * middle;
        let factors = self.factors(middle).ok()?;
        let mut start = factors.solve(self.force.complex_force(count));
        start.resize(2 * count, c64::ZERO);
        let mut space = KrylovSpace::new(start);
        let distances: Vec<c64> = lines.iter().map(|f| c64::new(TAU * f - omega, 0.0)).collect();
        let solved = space.solve(&distances, |z| {
            let (x, w) = z.split_at(count);
            let terms = [w.iter().map(|w| w * omega).collect(), x.to_vec()];
            let mut image = factors.solve(system.slope(omega, &terms, false));
            image.extend(x.iter().map(|x| x / omega));
            image
        });
        let vectors = solved.iter().map(|y| space.combined(y, count));
        Some(vectors.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{ContactStiffness, SlidingContact};
    use crate::fem::{ElasticMaterial, MassKind, PlaneFormulation};
    use crate::frf::{FrfSystem, Port};
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
            let [from, to] = [5, 200].map(|unknown| Port(vec![(unknown, 1.0)]));
            let driven = Driven::of(&system, [&from, &to], 500.0).unwrap();
            // Two of the lines lie within the bandwidth of unstable modes (9.9 and 10.5 kHz).
            for first in [500.0, 5000.0, 9850.0, 10_450.0] {
                let lines: Vec<f64> = (0..16).map(|k| first + 10.0 * f64::from(k)).collect();
                for (f, found) in lines.iter().zip(driven.solve_together(&lines)) {
                    let own = driven.factorized(*f).unwrap();
                    // Backward errors of 1e-14 times condition numbers of 1e4 or less.
                    let found = found.expect("solved together");
                    assert!((found - own).norm() < 1e-10 * own.norm(), "{f}: {found} {own}");
                }
            }
        }
    }
}
