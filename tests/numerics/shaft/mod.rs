//! A deformable shaft in the disc: eigenvalues and transient against theory, a rigid shaft and each other.

mod eigenvalues;

pub use crate::friction_law::block::STEEL;
use crate::prelude::*;

/// Materials of an annulus, region 0, and of its deformable shaft, region 1.
#[derive(Clone, Debug, PartialEq)]
pub struct AnnulusMaterials {
    /// Of the annulus.
    pub annulus: ElasticMaterial,
    /// Of the shaft, where it is deformable.
    pub shaft: Option<RegionMaterial>,
}

impl From<ElasticMaterial> for AnnulusMaterials {
    fn from(annulus: ElasticMaterial) -> Self {
        Self { annulus, shaft: None }
    }
}

impl MaterialField for AnnulusMaterials {
    fn of(&self, region: usize) -> &ElasticMaterial {
        let shaft = self.shaft.as_ref().filter(|_| region == 1);
        shaft.map_or(&self.annulus, |shaft| &shaft.elastic)
    }

    fn own_damping(&self, region: usize) -> Option<RayleighDamping> {
        self.shaft.as_ref().filter(|_| region == 1)?.damping
    }
}

/// The disc with a bore of 6 mm in its shaft.
pub fn with_shaft(element: ElementKind, around: usize, radial: [usize; 2]) -> AnnulusSpecification {
    on_shaft(annulus(element, around, radial[1]), radial[0])
}

pub fn on(shaft: ElasticMaterial) -> AnnulusMaterials {
    AnnulusMaterials { annulus: POLYCARBONATE, shaft: Some(shaft.into()) }
}

pub fn stiffer(factor: f64) -> AnnulusMaterials {
    on(ElasticMaterial { young_modulus: factor * POLYCARBONATE.young_modulus, ..POLYCARBONATE })
}

pub fn rigid_contact(geometric_stiffness: bool) -> TangentOptions {
    TangentOptions { geometric_stiffness, ..TANGENT }
}

/// Disc and shaft at 610 rpm.
pub fn model(
    specification: AnnulusSpecification,
    material: AnnulusMaterials,
    options: TangentOptions,
) -> AnnulusModel<AnnulusMaterials> {
    WaveModel { specification, material, options, contact: contact(610.0) }
}

/// Radial compliance `u_r / p` at `r` of a ring pressed there, its other edge, of radius `held`, clamped.
///
/// `u = A r + B / r` with `A = -B / held^2`, `sigma_rr = 2 (lambda + G) A - 2 G B / r^2`.
fn compliance(material: &ElasticMaterial, r: f64, held: f64) -> f64 {
    let [lambda, shear] = material.lame_constants();
    let (a, b) = (-1.0 / (held * held), 1.0);
    let stress = 2.0 * (lambda + shear) * a - 2.0 * shear * b / (r * r);
    ((a * r + b / r) / stress).abs()
}

/// Independent check: Lame's solution of both rings.
#[test]
fn the_interference_is_shared_as_lame_says_at_the_order_of_the_element() {
    let (r, delta) = (0.0205, 25e-6);
    let whole = compliance(&POLYCARBONATE, r, 0.0905) + compliance(&STEEL, r, 0.006);
    let exact = delta / whole;
    let error = |around: usize, radial: [usize; 2]| {
        let specification = with_shaft(Quad8, around, radial);
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let materials = on(STEEL);
        let body = Assembly::of_edge(&mesh, &materials, &contact(610.0), RIGID).unwrap();
        let force: f64 = body.state(0.3).unwrap().normal_forces(0.3).iter().sum();
        (force / (TAU * r) / exact - 1.0).abs()
    };
    let errors = [error(12, [3, 5]), error(24, [6, 10])];
    assert!(errors[1] < 3e-4, "{errors:?}");
    // Quadratic elements give energies to the fourth order.
    assert!(errors[0] / errors[1] > 10.0, "{errors:?}");
}

/// Cross-method check: the eigenvalue analysis of both bodies.
#[test]
fn a_wave_in_disc_and_shaft_grows_as_the_complex_eigenvalue_predicts() {
    let specification = with_shaft(Quad4, 48, [4, 10]);
    let annulus = AnnulusMesh::generate(&specification).unwrap();
    let mut steel = on(STEEL);
    steel.shaft.as_mut().unwrap().damping = Some(rayleigh_damping(20.0, 1e-8));
    let options = TangentOptions { mass: Lumped, ..rigid_contact(false) };
    let (n, start) = (2, InitialState::SteadySliding);
    let settings = transient_settings([0.006, 4e-6, 1e-4], start, Perturbation::of(&[n], 1e-8));
    for materials in [on(POLYCARBONATE), steel] {
        let limit = MaxFrequency(20e3);
        let found = model(specification, materials.clone(), options).swept(&[0.0, 0.3], limit);
        let modes = found.sweep.points[1].modes.iter();
        let predicted = fastest(modes.filter(|mode| mode.harmonic == n)).eigenvalue;
        assert!(predicted.re > 0.0);
        let model = TransientModel::of_annulus(&annulus, &materials, DAMPING, contact(610.0));
        let (record, _) = recorded(model, OperatorChoice::Cyclic, &settings);
        // Two bodies alike have short waves that grow much faster, out of round-off: the fit ends before them.
        grows_as(&record, n, predicted, 1e-3);
    }
}
