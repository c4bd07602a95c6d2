//! The program's discrete problem, solved densely one circumferential harmonic at a time.

use super::rates::{DISC, refinements};
use crate::cea_cyclic::dense::fold;
use crate::continuum::{damped, smallest_first};
use crate::prelude::*;

/// Radial expansion of the cylinder, m.
pub const INTERFERENCE: f64 = 25e-6;

pub fn material(annulus: &Annulus) -> ElasticMaterial {
    let formulation = if annulus.plane_strain { PlaneStrain } else { PlaneStress };
    elastic(annulus.young_modulus, annulus.poisson_ratio, annulus.density, formulation)
}

/// Counter-clockwise rotation, rad/s; linear sliding knows its sign only.
pub const FORWARD: f64 = 60.0;

/// The refined meshes of the disc with their steady sliding.
pub fn base_states(element: ElementKind) -> [(AnnulusMesh, PressedState); 3] {
    let (material, sliding) = (material(&DISC), sliding_at(0.3, INTERFERENCE, FORWARD));
    refinements(element).map(|specification| {
        let mesh = AnnulusMesh::generate(&specification).expect("a valid mesh");
        let body = Assembly::of_edge(&mesh.mesh, &material, &sliding, RIGID).unwrap();
        let base = body.state(0.3).expect("the disc is pressed everywhere");
        (mesh, base)
    })
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
        Self { annulus: DISC, contact, mass: Consistent, rayleigh }
    }
}

/// The program's discrete problem for the same annulus and contact as the reference.
pub struct Discretisation {
    /// `M`, `C`, `K_t` as polynomials in the friction coefficient.
    pub tangent: SlidingTangent,
    pub mesh: AnnulusMesh,
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
        let options = TangentOptions {
            mass,
            geometric_stiffness: contact.prestress_interference.is_some(),
            damping: rayleigh_damping(rayleigh.0, rayleigh.1),
            contact: ContactStiffness { normal_stiffness: contact.normal_stiffness, ..RIGID },
            ..TANGENT
        };
        let sliding = sliding_at(0.3, INTERFERENCE, rotation_speed);
        let body = Assembly::of_edge(&mesh.mesh, &material, &sliding, options.contact).unwrap();
        let base = body.state(0.3).expect("the disc is pressed everywhere");
        Self {
            tangent: body.tangent(&base, &options).unwrap(),
            friction_coefficient: contact.friction_coefficient,
            rayleigh,
            mesh,
        }
    }

    /// Eigenvalues of one harmonic, as [`Annulus::eigenvalues`] gives them.
    pub fn eigenvalues(&self, harmonic: usize) -> Vec<Eigenvalue> {
        let (tangent, mu) = (&self.tangent, self.friction_coefficient);
        let [stiffness, mass] = [&tangent.stiffness, &tangent.mass]
            .map(|own| fold(tangent, &self.mesh, own, mu, harmonic as i32));
        damped(&smallest_first(&stiffness, &mass), self.rayleigh, harmonic)
    }
}
