//! The base state that both bodies share.

use super::*;

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
        let mean = force / (TAU * r);
        (mean / exact - 1.0).abs()
    };
    let errors = [error(12, [3, 5]), error(24, [6, 10])];
    assert!(errors[1] < 3e-4, "{errors:?}");
    // Quadratic elements give energies to the fourth order.
    assert!(errors[0] / errors[1] > 10.0, "{errors:?}");
}
