//! Splitting of elements: arcs and nodes (independent checks).

use crate::prelude::*;

const KINDS: [ElementKind; 4] = [Quad4, Quad8, Tri3, Tri6];

fn file(kind: ElementKind, around: usize, radial: usize) -> FileMesh {
    let is_quadratic = kind.is_quadratic();
    let mesh = match kind.corner_count() {
        3 => triangles(&annulus(Quad4, around, radial), is_quadratic),
        _ => AnnulusMesh::generate(&annulus(kind, around, radial)).unwrap().mesh,
    };
    FileMesh::read(&write_msh(&mesh, FORMS[3], &[], |p| p)).unwrap()
}

#[test]
fn refined_arcs_stay_on_their_circles_and_old_nodes_stay_where_they_are() {
    for kind in KINDS {
        let coarse = file(kind, 24, 3);
        let fine = refined_file(&refined_file(&coarse).unwrap()).unwrap();
        assert_eq!(fine.elements.len(), 16 * coarse.elements.len());
        assert_eq!(fine.points[..coarse.points.len()], coarse.points);
        let mesh: Mesh = body(&fine);
        assert!(mesh.quality().worst_jacobian > 0.3, "{kind:?}");
        for (name, radius) in [("inner", 0.0205), ("outer", 0.0905)] {
            let boundary = mesh.boundary(name).unwrap();
            let per_edge = if kind.is_quadratic() { 2 } else { 1 };
            assert_eq!(boundary.nodes.len(), 4 * 24 * per_edge, "{kind:?} {name}");
            for &node in &boundary.nodes {
                let [x, y] = mesh.plane_node(node as usize);
                assert!((x.hypot(y) / radius - 1.0).abs() < 1e-12, "{kind:?} {name}");
            }
        }
    }
}
