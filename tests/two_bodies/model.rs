//! Two bodies of a mesh file, four-node elements, their meshes matching or not.

use crate::disc::{self, DAMPING, POLYCARBONATE, annulus};
use frictionsim::cea::sparse::sweep;
use frictionsim::cea::{ComplexMode, ModeLimit, SweepRequest};
use frictionsim::contact::{ContactStiffness, SlidingContact};
use frictionsim::fem::{MassKind, MaterialField, assemble_stiffness};
use frictionsim::mesh::{
    AnnulusMesh, AnnulusSpecification, BodySpecification, Boundary, BoundaryCondition,
    CounterfaceSpecification, ElementKind, GmshFile, Mesh2d,
};
use frictionsim::prestress::{DampingModel, SlidingTangent, SteadySliding, TangentOptions};

/// A body with the names that its boundaries have in the file.
pub struct Part<'a> {
    pub mesh: Mesh2d,
    pub region: &'a str,
    pub names: [&'a str; 2],
    /// Angle by which it is turned, rad.
    pub turn: f64,
}

/// Both bodies in one file.
pub fn file_of(parts: &[Part<'_>]) -> Vec<u8> {
    let mut names = String::new();
    let (mut nodes, mut elements) = (Vec::new(), Vec::new());
    let mut tag = 0;
    for part in parts {
        let first = 1 + nodes.len();
        let (sin, cos) = part.turn.sin_cos();
        for [x, y] in &part.mesh.nodes {
            nodes.push([cos * x - sin * y, sin * x + cos * y]);
        }
        tag += 1;
        names += &format!("2 {tag} \"{}\"\n", part.region);
        for e in 0..part.mesh.element_count() {
            let corners = part.mesh.element_nodes(e).iter();
            let corners: Vec<String> = corners.map(|&n| (first + n as usize).to_string()).collect();
            elements.push(format!("3 2 {tag} {tag} {}", corners.join(" ")));
        }
        for (boundary, name) in part.mesh.boundaries.iter().zip(part.names) {
            tag += 1;
            names += &format!("1 {tag} \"{name}\"\n");
            let count = boundary.nodes.len();
            for i in 0..count - usize::from(!boundary.is_closed) {
                let ends = [boundary.nodes[i], boundary.nodes[(i + 1) % count]];
                let [p, q] = ends.map(|node| first + node as usize);
                elements.push(format!("1 2 {tag} {tag} {p} {q}"));
            }
        }
    }
    let mut text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{names}$EndPhysicalNames\n",
        names.lines().count()
    );
    text += &format!("$Nodes\n{}\n", nodes.len());
    for (i, [x, y]) in nodes.iter().enumerate() {
        text += &format!("{} {x:?} {y:?} 0\n", i + 1);
    }
    text += &format!("$EndNodes\n$Elements\n{}\n", elements.len());
    for (i, element) in elements.iter().enumerate() {
        text += &format!("{} {element}\n", i + 1);
    }
    (text + "$EndElements\n").into_bytes()
}

/// Disc and shaft of the same material as rings of `around` elements (shaft, disc); the shaft is turned by `turn`.
pub fn rings(around: [usize; 2], radial: [usize; 2], turn: f64) -> Mesh2d {
    let ring =
        |specification: &AnnulusSpecification| AnnulusMesh::generate(specification).unwrap().mesh;
    let shaft = ring(&AnnulusSpecification {
        inner_radius: 0.006,
        outer_radius: 0.0205,
        ..annulus(ElementKind::Quad4, around[0], radial[0])
    });
    let disc = ring(&annulus(ElementKind::Quad4, around[1], radial[1]));
    let parts = [
        Part {
            mesh: disc,
            region: "disc",
            names: ["inner", "outer"],
            turn: 0.0,
        },
        Part {
            mesh: shaft,
            region: "shaft",
            names: ["bore", "journal"],
            turn,
        },
    ];
    let clamped = |name: &str| (name.to_owned(), BoundaryCondition::Clamped);
    let specification = BodySpecification {
        scale: 1.0,
        contact: "inner".to_owned(),
        counterface: CounterfaceSpecification::Cylinder {
            center: [0.0; 2],
            radius: None,
        },
        opposite: Some("journal".to_owned()),
        conditions: vec![clamped("outer"), clamped("bore")],
    };
    Mesh2d::from_gmsh(&GmshFile::read(&file_of(&parts)).unwrap(), &specification).unwrap()
}

pub fn options(mass: MassKind, geometric_stiffness: bool) -> TangentOptions {
    TangentOptions {
        mass,
        geometric_stiffness,
        damping: DAMPING,
        damping_model: DampingModel::WholeTangent,
        contact: ContactStiffness::default(),
    }
}

pub fn contact() -> SlidingContact {
    disc::contact(610.0)
}

pub fn modes(
    mesh: &Mesh2d,
    material: &dyn MaterialField,
    options: &TangentOptions,
    count: usize,
) -> Vec<ComplexMode> {
    let stiffness = assemble_stiffness(mesh, material);
    let base = SteadySliding::solve(mesh, &stiffness, &contact()).unwrap();
    let tangent = SlidingTangent::linearize(mesh, material, &stiffness, &base, options);
    let request = SweepRequest {
        friction_coefficients: &[0.3],
        limit: ModeLimit::Lowest(count),
        shapes_at: &[],
    };
    let found = sweep(&tangent, &request, &|_| {}).unwrap();
    found.points.into_iter().next().unwrap().modes
}

pub fn one_material() -> &'static dyn MaterialField {
    &POLYCARBONATE
}

/// A rectangle of elements with its lower left corner at `corner`.
pub fn rectangle(corner: [f64; 2], size: [f64; 2], count: [usize; 2]) -> Mesh2d {
    let [nx, ny] = count;
    let node = |i: usize, j: usize| (i + j * (nx + 1)) as u32;
    let mut mesh = Mesh2d::default();
    for j in 0..=ny {
        for i in 0..=nx {
            let share = [i as f64 / nx as f64, j as f64 / ny as f64];
            mesh.nodes
                .push([0, 1].map(|c| corner[c] + size[c] * share[c]));
        }
    }
    mesh.element_starts.push(0);
    for j in 0..ny {
        for i in 0..nx {
            let corners = [
                node(i, j),
                node(i + 1, j),
                node(i + 1, j + 1),
                node(i, j + 1),
            ];
            mesh.elements.extend(corners);
            mesh.element_starts.push(mesh.elements.len() as u32);
            mesh.element_kinds.push(ElementKind::Quad4);
        }
    }
    for j in [0, ny] {
        mesh.boundaries.push(Boundary {
            nodes: (0..=nx).map(|i| node(i, j)).collect(),
            ..Boundary::default()
        });
    }
    mesh
}
