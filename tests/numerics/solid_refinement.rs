//! Uniform refinement of solid bodies (independent: volumes, surfaces, exact eigenvalues of the meshed block).

use crate::prelude::*;

fn barrel([x, y, z]: [f64; 3]) -> [f64; 3] {
    let bulge = 1.0 + 0.3 * z * (1.0 - z);
    [0.1 * bulge * (x - 0.5), 0.08 * bulge * (y - 0.4), 0.06 * z + 0.01 * x * y]
}

fn mesh(file: &FileMesh) -> Mesh {
    let conditions = [("x0", Clamped), ("y0", Guide), ("z1", Pressure(2e6))];
    solids_of(file, &conditions)
}

#[test]
fn refined_solids_fit_together_and_keep_volume_surfaces_and_conditions() {
    for kind in SOLIDS {
        let coarse = mesh(&block(kind, [2, 1, 2], barrel));
        let mut fine = coarse.clone();
        for level in 1..=2 {
            fine = fine.refined_solids().unwrap();
            let times = |power: i32| 2_usize.pow(level * power as u32);
            // A pyramid has ten parts, six of them pyramids.
            let parts = match (kind.corner_count(), level) {
                (5, 1) => 10,
                (5, _) => 6 * 10 + 4 * 8,
                _ => times(3),
            };
            assert_eq!(fine.element_count(), parts * coarse.element_count());
            // A crack between two elements would show as further faces outside.
            let outer = [&coarse, &fine].map(|mesh| mesh.outer_faces().len());
            assert_eq!(outer[1], times(2) * outer[0], "{kind:?}");
            let mass = [&coarse, &fine].map(|m| lumped_masses(m, &STEEL).iter().sum::<f64>());
            // Parts of linear elements with curved faces, and quadratures of bent ones, see a little less.
            near(mass[1], mass[0], 0.03 / f64::from(level));
            for (own, other) in coarse.boundaries.iter().zip(&fine.boundaries) {
                assert_eq!((&own.name, own.condition), (&other.name, other.condition));
                assert_eq!(other.faces.len(), times(2) * own.faces.len(), "{kind:?}");
                near(fine.face_area(&other.faces), coarse.face_area(&own.faces), 0.02);
            }
            assert_eq!(coarse.nodes[..], fine.nodes[..coarse.nodes.len()]);
        }
    }
}

#[test]
fn a_refined_block_is_the_block_meshed_finer() {
    let straight = |[x, y, z]: [f64; 3]| [0.1 * x + 0.01 * z, 0.08 * y, 0.06 * z];
    for kind in [Hex8, Hex20] {
        let split = mesh(&block(kind, [2, 2, 1], straight)).refined_solids().unwrap();
        let meshed = mesh(&block(kind, [4, 4, 2], straight));
        let sorted = |mesh: &Mesh| {
            let points = mesh.nodes.iter().map(|point| point.map(|x| (1e9 * x).round() as i64));
            BTreeSet::from_iter(points)
        };
        assert_eq!(split.node_count(), meshed.node_count());
        assert_eq!(sorted(&split), sorted(&meshed));
        assert_eq!(split.held_dofs().count(), meshed.held_dofs().count());
    }
}

#[test]
fn nodes_between_those_of_a_held_edge_are_held_too() {
    let mut file = block(Tet10, [2, 2, 2], |place| place.map(|x| 0.1 * x));
    let is_on_edge = |p: &[f64; 3]| p[0] == 0.0 && p[1] == 0.0;
    let nodes = (0..file.points.len() as u32).filter(|&k| is_on_edge(&file.points[k as usize]));
    file.node_sets.insert("edge".to_owned(), nodes.collect());
    let mut mesh = solids_of(&file, &[("edge", Clamped)]);
    for _ in 0..2 {
        mesh = mesh.refined_solids().unwrap();
        let boundary = mesh.boundaries.iter().find(|b| b.name == "edge").unwrap();
        let own = (0..mesh.node_count() as u32).filter(|&k| is_on_edge(&mesh.nodes[k as usize]));
        assert_eq!(boundary.nodes, own.collect::<Vec<u32>>());
    }
}

/// Consistency: a generated body keeps its distribution of sizes over the radius where its whole mesh is refined.
#[test]
fn a_graded_body_is_refined_alike_on_its_whole_mesh() {
    let set = "mesh.circumferential_elements=12 ; mesh.radial_elements=3 ; mesh.axial_elements=1 ; \
        mesh.element=quad4 ; mesh.radial_grading=1.5 ; cea.method=sparse";
    let case = shipped_case("disc-three-dimensions.toml", &[set]);
    let radii = |case: &Case| -> Vec<f64> {
        case.body.assembly().unwrap().mesh.nodes.iter().map(|[x, y, _]| x.hypot(*y)).collect()
    };
    let finer = radii(&case.refined(2.0).unwrap());
    let is_kept = |own: f64| finer.iter().any(|other| (other - own).abs() < 1e-12);
    assert!(radii(&case).into_iter().all(is_kept));
}
