use super::*;
use crate::contact::SlidingContact;
use crate::fem::{
    ElasticMaterial, ElementGeometry, MassKind, PlaneFormulation, assemble_around,
    assemble_stiffness,
};
use crate::mesh::{AnnulusMesh, AnnulusSpecification, BoundaryCondition, ElementKind, Mesh};
use crate::prestress::{Assembly, DampingModel};

fn turning(rotation_speed: f64) -> SlidingContact {
    SlidingContact { decay: None, friction_coefficient: 0.3, interference: 25e-6, rotation_speed }
}

fn disc(element: ElementKind) -> (Mesh, ElasticMaterial) {
    let mesh = AnnulusMesh::generate(&AnnulusSpecification {
        inner_radius: 0.0205,
        outer_radius: 0.0905,
        circumferential_elements: 24,
        radial_elements: 6,
        radial_grading: 1.2,
        element,
        outer: BoundaryCondition::Clamped,
        shaft: None,
    });
    let material = ElasticMaterial {
        young_modulus: 2.5e9,
        poisson_ratio: 0.3805,
        density: 1228.0,
        formulation: PlaneFormulation::PlaneStrain,
        ..ElasticMaterial::PLAIN
    };
    (mesh.unwrap().mesh, material)
}

/// Independent check (objectivity): a rigid rotation of everything costs no elastic force, and the
/// turned stress balances the turned contact forces, for the pressed and for the sheared state.
#[test]
fn rigid_rotation_leaves_the_prestressed_edge_in_balance() {
    for element in [ElementKind::Quad4, ElementKind::Quad8] {
        let (mesh, material) = disc(element);
        let elastic = assemble_stiffness(&mesh, &material);
        let rigid = ContactStiffness::default();
        let body = Assembly::of_edge(&mesh, &material, &turning(-60.0), rigid).unwrap();
        let state = body.state(0.3).unwrap();
        let points = &body.contacts()[0].1.points;
        let mut prestress = turned(points, &body.turnings()[0], (&state, 0));
        let of = ElementGeometry::geometric_stiffnesses;
        let stresses = assemble_around((&mesh, &material), &state.displacements, None, of);
        for (terms, stress) in prestress.iter_mut().zip(stresses) {
            terms.entries.extend(stress.entries);
        }
        let total = mesh.dof_count();
        let rotation: Vec<f64> = (0..mesh.node_count())
            .flat_map(|node| [0.0, mesh.nodes[node][0].hypot(mesh.nodes[node][1])])
            .collect();
        let free = DofMap::excluding(total, mesh.held_dofs());
        for terms in &prestress {
            let force = terms.multiply(total, &rotation);
            let scale = terms.entries.iter().fold(0.0_f64, |m, &(_, _, value)| m.max(value.abs()));
            for dof in &free.dofs {
                // Each row sums a dozen terms of size `scale * radius`.
                assert!(force[*dof].abs() < 1e-11 * scale * 0.0905, "{element:?} {dof}");
            }
        }
        let elastic_force = elastic.multiply(total, &rotation);
        assert!(elastic_force.iter().all(|f| f.abs() < 1e-6), "{element:?}");
    }
}

#[test]
fn every_matrix_is_symmetric_without_friction() {
    let (mesh, material) = disc(ElementKind::Quad4);
    for normal_stiffness in [None, Some(7.4e12)] {
        let options = TangentOptions {
            mass: MassKind::Consistent,
            geometric_stiffness: true,
            damping: RayleighDamping { mass_coefficient: 40.0, stiffness_coefficient: 4.5e-7 },
            damping_model: DampingModel::WholeTangent,
            contact: ContactStiffness {
                normal_stiffness,
                normal_damping: 0.0,
                tangential_damping: 3.0,
                ..ContactStiffness::default()
            },
        };
        let body = Assembly::of_edge(&mesh, &material, &turning(60.0), options.contact).unwrap();
        let tangent = body.tangent(&body.state(0.3).unwrap(), &options).unwrap();
        for polynomial in [&tangent.mass, &tangent.damping, &tangent.stiffness] {
            let values = polynomial.evaluate(0.0);
            let pattern = polynomial.pattern();
            let scale = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            for column in 0..pattern.dimension() {
                let range =
                    pattern.column_pointers()[column]..pattern.column_pointers()[column + 1];
                for place in range {
                    let row = pattern.row_indices()[place];
                    let mirrored = pattern.position(column, row).map_or(0.0, |p| values[p]);
                    assert!((values[place] - mirrored).abs() <= 1e-12 * scale);
                }
            }
        }
    }
}
