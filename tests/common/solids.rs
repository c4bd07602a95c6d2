//! Solid bodies of a file that are tied together and slide on each other.

use super::prelude::*;

pub fn mesh_of(bytes: &[u8], conditions: &[(&str, BoundaryCondition)]) -> Mesh {
    solids_of(&FileMesh::read(bytes).unwrap(), conditions)
}

/// Solid bodies of a file in metres.
pub fn solids_of(file: &FileMesh, conditions: &[(&str, BoundaryCondition)]) -> Mesh {
    let conditions: Vec<_> =
        conditions.iter().map(|&(name, condition)| (name.to_owned(), condition)).collect();
    Mesh::from_solids(file, 1.0, &conditions).unwrap()
}

pub fn boundary(mesh: &Mesh, name: &str) -> usize {
    let place = mesh.boundaries.iter().position(|b| b.name == name);
    place.unwrap_or_else(|| panic!("no boundary {name}"))
}

pub fn contact_of(
    mesh: &Mesh,
    surface: &str,
    counter: Counterpart,
    normal_stiffness: Option<f64>,
) -> SlidingSurfaces {
    SlidingSurfaces {
        name: "pad".to_owned(),
        surface: boundary(mesh, surface),
        counter,
        friction: PairFriction { ratio: 1.0, decay: None },
        stiffness: ContactStiffness { normal_stiffness, ..RIGID },
        topography: None,
    }
}

/// A rigid plane across z.
pub const fn flat(motion: RigidMotion, center: [f64; 3], interference: f64) -> RigidCounterface {
    let (shape, axis) = (RigidShape::Plane, [0.0, 0.0, 1.0]);
    RigidCounterface { shape, center, axis, motion, interference }
}

pub fn tie(mesh: &Mesh, surface: &str, counter: &str) -> TiedSurfaces {
    let [surface, counter] = [surface, counter].map(|name| boundary(mesh, name));
    TiedSurfaces { name: "glue".to_owned(), surface, counter }
}
