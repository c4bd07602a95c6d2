//! The base state that both bodies share, and the pair as one body.

use crate::prelude::*;
use crate::shaft::model::{STEEL, on, with_shaft};
use frictionsim::fem::MaterialField;

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
        let specification = with_shaft(ElementKind::Quad8, around, radial);
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let elastic = assemble_stiffness(&mesh, &on(STEEL));
        let base = SteadySliding::solve(&mesh, &elastic, &contact(610.0)).unwrap();
        let force: f64 = base.normal_forces(0.3).iter().sum();
        let mean = force / (std::f64::consts::TAU * r);
        (mean / exact - 1.0).abs()
    };
    let errors = [error(12, [3, 5]), error(24, [6, 10])];
    assert!(errors[1] < 3e-4, "{errors:?}");
    // Quadratic elements give energies to the fourth order.
    assert!(errors[0] / errors[1] > 10.0, "{errors:?}");
}

/// `node of the glued ring, of each node of both bodies`.
fn glued(mesh: &Mesh, interface: &ContactInterface, one: &Mesh) -> Vec<usize> {
    let mut place: Vec<Option<usize>> = vec![None; mesh.node_count()];
    let near = |p: [f64; 2]| {
        let distance = |q: &[f64; 3]| (p[0] - q[0]).hypot(p[1] - q[1]);
        (0..one.node_count()).find(|&k| distance(&one.nodes[k]) < 1e-9)
    };
    for (node, place) in place.iter_mut().enumerate() {
        *place = near(mesh.plane_node(node));
    }
    for (i, &node) in interface.nodes.iter().enumerate() {
        let opposite = interface.opposite_of(i)[0].dof / 2;
        assert_eq!(place[node as usize], place[opposite]);
    }
    place.into_iter().map(Option::unwrap).collect()
}

fn summed(matrix: &Triplets, place: &dyn Fn(usize) -> usize) -> BTreeMap<(usize, usize), f64> {
    let mut sum = BTreeMap::new();
    for &(row, column, value) in &matrix.entries {
        *sum.entry((place(row), place(column))).or_default() += value;
    }
    sum
}

/// Patch test: two bodies of one material whose pairs are held together are one body, matrix by matrix.
#[test]
fn glued_bodies_of_one_material_have_the_matrices_of_one_body() {
    for element in [ElementKind::Quad4, ElementKind::Quad8] {
        let width = [0.0205 - 0.006, 0.0905 - 0.0205];
        let [inside, outside] = [2, 9];
        let mut specification = with_shaft(element, 12, [inside, outside]);
        // Elements of one size on both sides, as in the one body.
        let size = width[0] / inside as f64;
        specification.outer_radius = specification.inner_radius + size * outside as f64;
        let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
        let one = AnnulusSpecification {
            inner_radius: 0.006,
            outer_radius: specification.outer_radius,
            ..annulus(element, 12, inside + outside)
        };
        let one = AnnulusMesh::generate(&one).unwrap().mesh;
        let place = glued(&mesh, &ContactInterface::of(&mesh), &one);
        let place = |dof: usize| 2 * place[dof / 2] + dof % 2;
        let two: AnnulusMaterials = on(POLYCARBONATE);
        let alone = AnnulusMaterials::from(POLYCARBONATE);
        let matrices = |mesh: &Mesh, material: &dyn MaterialField| {
            let mass = assemble_mass(mesh, material, MassKind::Consistent);
            [assemble_stiffness(mesh, material), mass]
        };
        let pairs = matrices(&mesh, &two).into_iter().zip(matrices(&one, &alone));
        for (ours, theirs) in pairs {
            let (ours, theirs) = (summed(&ours, &place), summed(&theirs, &|dof| dof));
            let largest = theirs.values().fold(0.0_f64, |m, v| m.max(v.abs()));
            assert_eq!(ours.len(), theirs.len());
            for (at, value) in &theirs {
                assert!((ours[at] - value).abs() < 1e-11 * largest, "{at:?}");
            }
        }
    }
}
