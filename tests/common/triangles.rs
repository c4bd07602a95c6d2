//! Unstructured triangle meshes of the disc, and the disc as the body of a file.

use super::prelude::*;

/// The annulus of triangles: every quadrilateral of `specification` is cut along one diagonal or the other, and inner
/// nodes are moved by up to a quarter of an element, both as a fixed sequence of numbers has it.
pub fn triangles(specification: &AnnulusSpecification, is_quadratic: bool) -> Mesh {
    let quads = AnnulusMesh::generate(specification).unwrap();
    let (inner, outer) = (specification.inner_radius, specification.outer_radius);
    let step = (outer - inner) / specification.radial_elements as f64;
    let mut mesh = quads.mesh;
    let mut draw = super::draws::draws(12345);
    for [x, y, _] in &mut mesh.nodes {
        let radius = x.hypot(*y);
        if radius > inner * 1.000_01 && radius < outer * 0.999_99 {
            let size = step.min(TAU * radius / specification.circumferential_elements as f64);
            *x += 0.5 * size * (draw() - 0.5);
            *y += 0.5 * size * (draw() - 0.5);
        }
    }
    let mut corners: Vec<[u32; 3]> = Vec::new();
    for element in 0..mesh.element_count() {
        let &[a, b, c, d] = mesh.element_nodes(element) else {
            unreachable!("four-node quadrilaterals");
        };
        let (one, other) = ([[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]);
        corners.extend(if draw() < 0.5 { one } else { other });
    }
    let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    let mut elements = Vec::new();
    for triangle in &corners {
        elements.extend(triangle);
        for i in (0..3).filter(|_| is_quadratic) {
            let (p, q) = (triangle[i], triangle[(i + 1) % 3]);
            let middle = *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                let [a, b] = [p, q].map(|node| mesh.plane_node(node as usize));
                let (x, y) = (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]));
                let radius = |p: [f64; 2]| p[0].hypot(p[1]);
                // Edges of the body are arcs.
                let arc = [inner, outer].into_iter().find(|r| {
                    (radius(a) / r - 1.0).abs() < 1e-9 && (radius(b) / r - 1.0).abs() < 1e-9
                });
                let factor = arc.map_or(1.0, |r| r / radius([x, y]));
                mesh.nodes.push([factor * x, factor * y, 0.0]);
                (mesh.nodes.len() - 1) as u32
            });
            elements.push(middle);
        }
    }
    for boundary in &mut mesh.boundaries {
        let own = middles
            .iter()
            .filter(|((p, q), _)| boundary.nodes.contains(p) && boundary.nodes.contains(q));
        let own: Vec<u32> = own.map(|(_, &middle)| middle).collect();
        boundary.nodes.extend(own);
    }
    let (kind, per_element) = if is_quadratic { (Tri6, 6) } else { (Tri3, 3) };
    let count = corners.len();
    Mesh {
        element_kinds: vec![kind; count],
        element_starts: (0..=count).map(|e| (per_element * e) as u32).collect(),
        elements,
        element_regions: vec![0; count],
        congruent_to: (0..count as u32).collect(),
        ..mesh
    }
}

/// The disc of a file, clamped at its rim.
pub fn body(file: &FileMesh) -> Mesh {
    Mesh::from_gmsh(file, &plane_body("inner", CYLINDER, None, &[("outer", Clamped)])).unwrap()
}
