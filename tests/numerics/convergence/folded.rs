//! The program's discrete problem, solved densely one circumferential harmonic at a time.

use crate::continuum::{Annulus, Contact, Eigenvalue, Rayleigh, damped_pair, smallest_first};
use crate::prelude::*;

/// Radial expansion of the cylinder, m.
pub const INTERFERENCE: f64 = 25e-6;

pub fn material(annulus: &Annulus) -> ElasticMaterial {
    let formulation = match annulus.plane_strain {
        true => PlaneFormulation::PlaneStrain,
        false => PlaneFormulation::PlaneStress,
    };
    elastic(annulus.young_modulus, annulus.poisson_ratio, annulus.density, formulation)
}

/// Counter-clockwise rotation, rad/s; linear sliding knows its sign only.
pub const FORWARD: f64 = 60.0;

/// Steady sliding of a rotor turning at `rotation_speed`.
pub fn base_state(mesh: &AnnulusMesh, annulus: &Annulus, rotation_speed: f64) -> SteadySliding {
    let sliding = sliding_at(0.3, INTERFERENCE, rotation_speed);
    let stiffness = assemble_stiffness(&mesh.mesh, &material(annulus));
    SteadySliding::solve(&mesh.mesh, &stiffness, &sliding).expect("the disc is pressed everywhere")
}

/// What one convergence study covers: the two lowest branches of harmonics 0 to 4, both directions.
pub struct Study {
    pub annulus: Annulus,
    pub contact: Contact,
    pub mass: MassKind,
    pub rayleigh: Rayleigh,
}

impl Study {
    pub fn of(contact: Contact, rayleigh: Rayleigh) -> Self {
        Self { annulus: super::rates::DISC, contact, mass: MassKind::Consistent, rayleigh }
    }
}

/// The program's discrete problem for the same annulus and contact as the reference.
pub struct Discretisation {
    /// `M`, `C`, `K_t` as polynomials in the friction coefficient.
    pub tangent: SlidingTangent,
    /// Sectors of the mesh.
    pub sectors: usize,
    /// `mu` of every evaluation.
    pub friction_coefficient: f64,
    /// `(alpha, beta)`.
    pub rayleigh: Rayleigh,
}

impl Discretisation {
    /// Prestress and tangent on one mesh, the rotor turning at a speed; damping on the whole tangent.
    pub fn new(specification: &AnnulusSpecification, study: &Study, rotation_speed: f64) -> Self {
        let Study { annulus, contact, mass, rayleigh } = *study;
        let mesh = AnnulusMesh::generate(specification).expect("a valid mesh");
        let material = material(&annulus);
        let (mass_coefficient, stiffness_coefficient) = rayleigh;
        let options = TangentOptions {
            mass,
            geometric_stiffness: contact.prestress_interference.is_some(),
            damping: RayleighDamping { mass_coefficient, stiffness_coefficient },
            contact: ContactStiffness { normal_stiffness: contact.normal_stiffness, ..RIGID },
            ..TANGENT
        };
        let base = base_state(&mesh, &annulus, rotation_speed);
        let elastic = assemble_stiffness(&mesh.mesh, &material);
        Self {
            tangent: SlidingTangent::linearize(&mesh.mesh, &material, &elastic, &base, &options),
            sectors: mesh.sector_count(),
            friction_coefficient: contact.friction_coefficient,
            rayleigh,
        }
    }

    /// Dense block of one harmonic: rows of sector 0, columns of sector `j` folded onto sector 0
    /// with the phase `e^{i n theta_j}`. Exact, because in polar frames every sector has the same
    /// rows.
    pub fn fold(&self, matrix: &MatrixPolynomial, harmonic: usize) -> Mat<c64> {
        let values = matrix.evaluate(self.friction_coefficient);
        let pattern = matrix.pattern();
        let size = pattern.dimension() / self.sectors;
        let mut folded = Mat::<c64>::zeros(size, size);
        for column in 0..pattern.dimension() {
            let turns = (harmonic * (column / size)) as f64 / self.sectors as f64;
            let phase = c64::cis(TAU * turns);
            let range = pattern.column_pointers()[column]..pattern.column_pointers()[column + 1];
            for place in range {
                let row = pattern.row_indices()[place];
                if row < size {
                    folded[(row, column % size)] += phase * values[place];
                }
            }
        }
        folded
    }

    /// Eigenvalues of one harmonic, as [`Annulus::eigenvalues`] gives them.
    pub fn eigenvalues(&self, harmonic: usize) -> Vec<Eigenvalue> {
        let stiffness = self.fold(&self.tangent.stiffness, harmonic);
        let mass = self.fold(&self.tangent.mass, harmonic);
        let kappas = smallest_first(&stiffness, &mass);
        let mut all: Vec<Eigenvalue> = kappas
            .iter()
            .flat_map(|&kappa| damped_pair(kappa, self.rayleigh, harmonic))
            .flatten()
            .collect();
        all.sort_by(|x, y| x.lambda.im.total_cmp(&y.lambda.im));
        all
    }
}
