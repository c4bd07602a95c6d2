//! Bodies from mesh files as a user meets them: probes by place, refinement, signals beside modes, figures without the mesh in its place.

mod commands;
pub mod studies;

use crate::prelude::*;

/// Independent check: where arcs and nodes are.
#[test]
fn refined_arcs_stay_on_their_circles_and_old_nodes_stay_where_they_are() {
    for kind in [Quad4, Quad8, Tri3, Tri6] {
        let mesh = match kind.corner_count() {
            3 => triangles(&annulus(Quad4, 24, 3), kind.is_quadratic()),
            _ => AnnulusMesh::generate(&annulus(kind, 24, 3)).unwrap().mesh,
        };
        let coarse = FileMesh::read(&write_msh(&mesh, FORMS[3], &[], |p| p)).unwrap();
        let fine = refined_file(&refined_file(&coarse).unwrap()).unwrap();
        assert_eq!(fine.elements.len(), 16 * coarse.elements.len());
        assert_eq!(fine.points[..coarse.points.len()], coarse.points);
        let mesh = body(&fine);
        assert!(mesh.quality().worst_jacobian > 0.3, "{kind:?}");
        for (name, radius) in [("inner", 0.0205), ("outer", 0.0905)] {
            let boundary = mesh.boundary(name).unwrap();
            let per_edge = if kind.is_quadratic() { 2 } else { 1 };
            assert_eq!(boundary.nodes.len(), 4 * 24 * per_edge, "{kind:?} {name}");
            for &node in &boundary.nodes {
                let [x, y] = mesh.plane_node(node as usize);
                near(x.hypot(y), radius, 1e-12);
            }
        }
    }
}
