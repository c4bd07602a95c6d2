//! Two bodies of a mesh file, four-node elements, their meshes matching or not.

use crate::prelude::*;

/// A body, its region, the names that its boundaries have in the file, and the angle by which it is turned, rad.
type Part<'a> = (Mesh, &'a str, [&'a str; 2], f64);

/// Both bodies in one file.
fn file_of(parts: &[Part<'_>]) -> Vec<u8> {
    let (mut points, mut groups, mut elements) = (Vec::new(), Vec::new(), Vec::new());
    for (mesh, region, names, turn) in parts {
        let first = points.len();
        let (sin, cos) = turn.sin_cos();
        points
            .extend(mesh.nodes.iter().map(|[x, y, _]| [cos * x - sin * y, sin * x + cos * y, 0.0]));
        let number = |node: &u32| first + *node as usize;
        for e in 0..mesh.element_count() {
            let nodes = mesh.element_nodes(e).iter().map(number).collect();
            elements.push((mesh.element_kind(e).gmsh_type(), groups.len(), nodes));
        }
        groups.push((2, *region));
        // Corners and middles alternate where edges have a middle.
        let (stride, kind) = if mesh.is_quad4() { (1, 1) } else { (2, 8) };
        for (boundary, name) in mesh.boundaries.iter().zip(*names) {
            let count = boundary.nodes.len();
            for i in (0..count - usize::from(!boundary.is_closed)).step_by(stride) {
                let place = |k: usize| number(&boundary.nodes[(i + k) % count]);
                let nodes = [place(0), place(stride), place(1)][..1 + stride].to_vec();
                elements.push((kind, groups.len(), nodes));
            }
            groups.push((1, name));
        }
    }
    mesh_text(&points, &groups, &elements)
}

/// A lower and an upper block in one file.
pub fn blocks_of([lower, upper]: [Lines; 2]) -> Vec<u8> {
    let lower = Grid::of(lower, ["floor", "track"], &|_| "lower");
    grids(&[lower, Grid::of(upper, ["sole", "top"], &|_| "upper")])
}

/// The same read, the lower one held at its floor, the upper one at its top.
pub fn held_blocks(blocks: [Lines; 2], top: BoundaryCondition) -> Result<Mesh, BodyError> {
    let plane = CounterfaceSpecification::Plane { direction: None };
    let held = [("floor", Clamped), ("top", top)];
    let specification = plane_body("sole", plane, Some("track"), &held);
    Mesh::from_gmsh(&FileMesh::read(&blocks_of(blocks)).unwrap(), &specification)
}

/// Disc and shaft as rings of `around` elements (shaft, disc); the shaft is turned by `turn`.
pub fn rings(around: [usize; 2], radial: [usize; 2], turn: f64) -> Mesh {
    rings_of(Quad4, 0.0905, around, radial, turn)
}

/// The same of any element, with the outer radius of the disc.
pub fn rings_of(
    element: ElementKind,
    outer_radius: f64,
    around: [usize; 2],
    radial: [usize; 2],
    turn: f64,
) -> Mesh {
    let shaft = ring(element, [0.006, 0.0205], around[0], radial[0]);
    let disc = ring(element, [0.0205, outer_radius], around[1], radial[1]);
    let parts =
        [(disc, "disc", ["inner", "outer"], 0.0), (shaft, "shaft", ["bore", "journal"], turn)];
    let held = ["outer", "bore"].map(|name| (name, Clamped));
    let specification = plane_body("inner", CYLINDER, Some("journal"), &held);
    Mesh::from_gmsh(&FileMesh::read(&file_of(&parts)).unwrap(), &specification).unwrap()
}

/// One ring of even elements.
pub fn ring(element: ElementKind, radii: [f64; 2], around: usize, radial: usize) -> Mesh {
    AnnulusMesh::generate(&crate::disc::ring(radii, element, around, radial)).unwrap().mesh
}

/// A rectangle of so many elements with its lower left corner at `corner`.
pub fn rectangle(corner: [f64; 2], size: [f64; 2], count: [usize; 2]) -> Lines {
    [0, 1].map(|c| even(size[c], count[c]).iter().map(|x| corner[c] + x).collect())
}
