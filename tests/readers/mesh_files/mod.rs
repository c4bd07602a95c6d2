//! Mesh files of other programs: the same bodies, whoever wrote them.

mod abaqus;
mod nastran;
mod same_body;
mod taken;
mod universal;

pub use abaqus::ASSEMBLY;
pub use nastran::BRICK as BULK_DATA;
pub use universal::BRICK as UNIVERSAL;

use crate::prelude::*;

fn read(name: &str, text: &str) -> Result<FileMesh, MeshFileError> {
    FileMesh::read_as(name, text.as_bytes())
}

fn body(name: &str, text: &str) -> Mesh {
    let file = read(name, text).unwrap_or_else(|error| panic!("{error}"));
    Mesh::from_solids(&file, 1.0, &[]).unwrap_or_else(|error| panic!("{error}"))
}

/// Holds named boundaries to their areas, m2.
fn has_areas(mesh: &Mesh, areas: &[(&str, f64)]) {
    for (name, exact) in areas {
        let found = mesh.face_area(&mesh.boundaries[boundary(mesh, name)].faces);
        assert!((found - exact).abs() < 1e-12, "{name}");
    }
}

/// An isotropic material, E 2e5, nu 0.3, as the stiffness of an orthotropic one: Lamé's constants and the diagonal, lambda + 2 G.
fn isotropic_stiffness() -> [f64; 3] {
    let (e, nu) = (2e5_f64, 0.3);
    let lambda = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
    let g = e / (2.0 * (1.0 + nu));
    [lambda, g, lambda + 2.0 * g]
}

/// Holds the engineering constants that a stiffness was read as to those of that material.
fn is_that_material(elasticity: Option<&FileElasticity>) {
    let Some(FileElasticity::Orthotropic { young_moduli, poisson_ratios, shear_moduli, .. }) =
        elasticity
    else {
        panic!("{elasticity:?}");
    };
    near_each(young_moduli, &[2e5; 3], 1e-12);
    near_each(poisson_ratios, &[0.3; 3], 1e-12);
    near_each(shear_moduli, &[2e5 / 2.6; 3], 1e-12);
}

pub fn error(name: &str, text: &str) -> String {
    read(name, text).expect_err("the file is wrong").to_string()
}

/// What is said of a case in a folder, a line each.
pub fn said_of(folder: &Path, text: &str) -> String {
    read_case(folder.join("case.toml"), text, AS_IT_IS).unwrap_err().messages().join("\n")
}

/// Lines `FROM => TO => SAID` of a change to a right file, and what must be said of it.
fn check_errors(name: &str, text: &str, changes: &str) {
    for change in changes.trim_matches('\n').split('\n') {
        let parts: Vec<String> = change.split(" => ").map(|own| own.replace("\\n", "\n")).collect();
        let [from, to, said] = &parts[..] else { panic!("{change}") };
        assert!(text.contains(from), "{from}");
        let found = error(name, &text.replacen(from, to, 1));
        assert!(found.contains(said), "{from} -> {to}: {found}, not {said}");
    }
}
