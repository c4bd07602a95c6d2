//! Eigenvalues on unstructured meshes against Table 1 and the exact continuum (independent checks).

use crate::convergence::rates::{DISC, NORMAL_STIFFNESS, RAYLEIGH};
use crate::prelude::*;

/// Harmonic, branch and direction of the lowest modes at friction 0.3.
const EXACT: [(usize, usize, i8); 7] =
    [(0, 1, 0), (1, 1, 1), (1, 1, -1), (2, 1, 1), (2, 1, -1), (1, 2, 1), (1, 2, -1)];

fn modes(mesh: &Mesh, count: usize) -> Vec<ComplexMode> {
    let springs = compliant(NORMAL_STIFFNESS, [0.0; 2]);
    let options = TangentOptions { contact: springs, ..TANGENT };
    let tangent = linearized(mesh, &POLYCARBONATE, &contact(610.0), &options);
    modes_at(&tangent, 0.3, Lowest(count))
}

fn exact(names: &[(usize, usize, i8)]) -> Vec<c64> {
    let contact = Contact::penalty(0.3, NORMAL_STIFFNESS);
    let all = names.iter();
    all.map(|&(n, branch, direction)| DISC.branch(n, branch, direction, &contact, RAYLEIGH).lambda)
        .collect()
}

#[test]
fn five_thousand_imported_elements_give_table_1_and_the_continuum() {
    let triangles = triangles(&annulus(Quad4, 120, 21), true);
    let quads = AnnulusMesh::generate(&annulus(Quad8, 160, 31)).unwrap().mesh;
    for mesh in [triangles, quads] {
        let mesh = body(&FileMesh::read(&write_msh(&mesh, FORMS[3], &[], |p| p)).unwrap());
        assert!((4900..5100).contains(&mesh.element_count()));
        let found = modes(&mesh, TABLE_1.len());
        for (i, (mode, row)) in found.iter().zip(TABLE_1.iter()).enumerate() {
            // What the fit of the material to the table leaves.
            near(mode.frequency_hz(), row.1, 3e-3);
            below((mode.real_hz() - row.0).abs(), 10.0, format_args!("mode {}, Hz", i + 1));
        }
        below(largest_error(&eigenvalues_of(&found), &exact(&EXACT)), 1e-4, "of the continuum");
    }
}

/// Slopes of the mean error of the lowest eigenvalues over three meshes, each split from the one before.
#[test]
fn eigenvalues_on_unstructured_meshes_converge_with_orders_two_and_four() {
    for (kind, around, radial, order) in [(Tri3, 48, 9, 2.0), (Tri6, 24, 4, 4.0)] {
        let mesh = triangles(&annulus(Quad4, around, radial), kind.is_quadratic());
        let bytes = write_msh(&mesh, FORMS[3], &[], |p| p);
        let mut file = FileMesh::read(&bytes).unwrap();
        let mut errors = Vec::new();
        for level in 0..3 {
            if level > 0 {
                file = refined_file(&file).unwrap();
            }
            // The mean, each that of the nearest mode.
            let found = eigenvalues_of(&modes(&body(&file), 7));
            let own = exact(&EXACT[..5]).into_iter().map(|one| largest_error(&found, &[one]));
            errors.push(own.sum::<f64>() / 5.0);
        }
        let slope = (errors[1] / errors[2]).log2();
        // A family of three meshes shows its order within a tenth of it.
        assert!((slope - order).abs() < 0.1 * order, "{kind:?} {errors:?} {slope}");
    }
}
