//! Pyramids between bricks and tetrahedra (theory: the patch test), and as Gmsh and Nastran number them (independent: their manuals).

use crate::prelude::*;

/// Three cells in a row: a brick, six pyramids, and tetrahedra with a pyramid on the side of the others.
fn row(is_quadratic: bool) -> FileMesh {
    let corner = |i: u32, j: u32, k: u32| i + 4 * (j + 2 * k);
    let mut places: Vec<[f64; 3]> = Vec::new();
    for (k, j, i) in (0..2).flat_map(|k| (0..2).flat_map(move |j| (0..4).map(move |i| (k, j, i)))) {
        places.push([f64::from(i), f64::from(j), f64::from(k)]);
    }
    places.extend([[1.55, 0.45, 0.6], [2.4, 0.6, 0.45]]);
    let cell = |i: u32| {
        let ring = [(i, 0), (i + 1, 0), (i + 1, 1), (i, 1)];
        [0, 1].map(|k| ring.map(|(i, j)| corner(i, j, k))).concat()
    };
    let mut elements = vec![cell(0)];
    let sides =
        [[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]];
    for (number, middle) in [(1, 16), (2, 17)] {
        for side in sides {
            let [a, b, c, d] = side.map(|local: usize| cell(number)[local]);
            match number == 2 && side != sides[5] {
                true => elements.extend([vec![a, b, c, middle], vec![a, c, d, middle]]),
                false => elements.push(vec![a, b, c, d, middle]),
            }
        }
    }
    let kind = |corners: &Vec<u32>| Tet4.with_corners(corners.len(), is_quadratic);
    let mut file = meshed(places, elements.into_iter().map(|corners| (kind(&corners), corners)));
    // A map of all that is linear, so that edges stay straight.
    let skewed = |[x, y, z]: [f64; 3]| [0.05 * x + 0.01 * y, 0.06 * y + 0.008 * z, 0.04 * z];
    file.points = file.points.into_iter().map(skewed).collect();
    file
}

/// Theory: in a body of bricks, pyramids and tetrahedra a linear displacement has a constant stress and no force inside.
#[test]
fn bricks_pyramids_and_tetrahedra_in_one_body_pass_the_patch_test() {
    for is_quadratic in [false, true] {
        let mesh = solids_of(&row(is_quadratic), &[]);
        let kinds = (0..mesh.element_count()).map(|e| mesh.element_kind(e));
        assert_eq!(BTreeSet::from_iter(kinds).len(), 3);
        passes_the_patch_test(&mesh, &format!("quadratic {is_quadratic}"));
    }
}

#[test]
fn bodies_of_mixed_shapes_are_refined_without_cracks() {
    for is_quadratic in [false, true] {
        let coarse = solids_of(&row(is_quadratic), &[]);
        let fine = coarse.refined_solids().unwrap();
        assert_eq!(fine.element_count(), 8 + 7 * 10 + 10 * 8);
        assert_eq!(fine.outer_faces().len(), 4 * coarse.outer_faces().len());
        near(fine.region_measures()[0], coarse.region_measures()[0], 1e-13);
    }
}

/// A pyramid of thirteen nodes with a bulging base; Gmsh's manual numbers the middles by edges 01, 03, 04, 12, 14, 23, 24, 34.
#[test]
fn pyramids_of_gmsh_are_read_in_the_order_of_its_manual() {
    let corners =
        [[0.0, 0.0, 0.0], [2.0, 0.0, 0.1], [2.1, 1.0, 0.0], [0.0, 1.2, 0.0], [0.9, 0.6, 1.5]];
    let edges = [[0, 1], [0, 3], [0, 4], [1, 2], [1, 4], [2, 3], [2, 4], [3, 4]];
    let middle = |[p, q]: [usize; 2]| -> [f64; 3] {
        std::array::from_fn(|axis| 0.5 * (corners[p][axis] + corners[q][axis]))
    };
    for (number, count) in [(7, 5), (19, 13)] {
        let points: Vec<[f64; 3]> =
            corners.into_iter().chain(edges.map(middle)).take(count).collect();
        let bytes = mesh_text(&points, &[(3, "body")], &[(number, 0, (0..count).collect())]);
        let mesh = mesh_of(&bytes, &[]);
        let kind = mesh.element_kind(0);
        assert_eq!(kind.node_count(), count);
        let nodes = mesh.element_nodes(0);
        let place = |local: usize| mesh.nodes[nodes[local] as usize];
        for (edge, &[p, q]) in kind.edges().iter().enumerate().filter(|_| count == 13) {
            assert_eq!(place(5 + edge), middle([p, q]));
        }
    }
}
