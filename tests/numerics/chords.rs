//! Quadratic elements with straight edges on round counterfaces (independent: curved edges, linear elements, exact distances).

use crate::assemblies::on_rigid;
use crate::prelude::*;

const RUBBER: ElasticMaterial = ElasticMaterial { formulation: ThreeDimensional, ..POLYCARBONATE };

const BALL: f64 = 0.016;

fn ball(interference: f64) -> RigidCounterface {
    let turning = flat(RigidMotion::Turning(10.0), [0.0; 3], interference);
    RigidCounterface { shape: RigidShape::Sphere(Some(BALL)), ..turning }
}

/// A cup of 4 mm on the ball, wide open.
fn cup([u, v, w]: [f64; 3]) -> [f64; 3] {
    let arm = [1.2 * (u - 0.5), 1.2 * (v - 0.5), 1.0];
    arm.map(|x| x / Vector3::from(arm).norm() * (BALL + 0.004 * w))
}

/// Puts the middles of all edges onto the straight lines between their ends.
fn straighten(file: &mut FileMesh) {
    for element in &file.elements {
        for edge in 0..element.kind.edges().len() {
            let (a, b, middle) = element.kind.edge(edge);
            let [a, b] = [a, b].map(|local| file.points[element.nodes[local] as usize]);
            if let Some(middle) = middle {
                let place = [0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis]));
                file.points[element.nodes[middle] as usize] = place;
            }
        }
    }
}

fn solid(file: &FileMesh) -> Mesh {
    solids_of(file, &[("z1", Clamped)])
}

/// Largest pressure of a cup on the ball, and the force between them.
fn pressed(file: &FileMesh, interference: f64) -> [f64; 2] {
    let mesh = solid(file);
    let contact = on_rigid(&mesh, "z0", ball(interference), Some(1e13));
    let (contacts, base) = (&[contact][..], (&[][..], BaseChoice::Solved));
    let assembly = Assembly::new(&mesh, &RUBBER, (&[], contacts), base, Consistent).unwrap();
    let forces = assembly.state(0.0).unwrap().normal_forces(0.0);
    let points = &assembly.contacts()[0].1.points;
    let pressures = forces.iter().zip(points).map(|(force, point)| force / point.weight);
    [pressures.fold(0.0, f64::max), forces.iter().sum()]
}

/// The chords of these edges lie up to 0.3 mm inside the ball, fifteen times the interference.
#[test]
fn a_cup_with_straight_edges_is_pressed_like_one_with_curved_edges() {
    for (kind, linear) in [(Tet10, Tet4), (Hex20, Hex8)] {
        let cells = [4, 4, 1];
        let curved = block(kind, cells, cup);
        let mut straight = curved.clone();
        straighten(&mut straight);
        let [_, expected] = pressed(&curved, 2e-5);
        let [largest, force] = pressed(&straight, 2e-5);
        let [of_linear, _] = pressed(&block(linear, cells, cup), 2e-5);
        near(force, expected, 0.05);
        assert!(largest < 1.5 * of_linear, "{kind:?} {largest} {of_linear}");
    }
}

/// A flat face has straight edges because it is flat: its distance from a ball stays that of its nodes.
#[test]
fn a_flat_face_keeps_its_distance_from_a_ball() {
    let flat = |[u, v, w]: [f64; 3]| [0.008 * (u - 0.5), 0.008 * (v - 0.5), BALL + 0.004 * w];
    let mesh = solid(&block(Hex20, [3, 3, 1], flat));
    let surface = mesh.boundary("z0").unwrap();
    let pair = SurfacePair::on_rigid(&mesh, surface, &ball(0.0)).unwrap();
    for point in &pair.points {
        // The means of the ends of edges are wrong by up to 6e-5 m.
        within(&[point.at.gap], &[Vector3::from(point.at.position).norm() - BALL], 1e-6);
    }
    // A real overlap is one, whatever the edges: this cup has the radius of a smaller ball.
    let mut small = block(Tet10, [4, 4, 1], |at| cup(at).map(|x| 0.99 * x));
    straighten(&mut small);
    let small = solid(&small);
    let overlap = ball(0.0).overlap(&small, small.boundary("z0").unwrap()).unwrap();
    near(overlap, 0.01 * BALL, 1e-9);
}

/// The chords stand 44 um inside a shaft that is pushed in by 25 um. Pressures at corners and middles of straight edges differ, as the
/// body has corners there; their mean is that of the round hole.
#[test]
fn a_plane_ring_with_straight_edges_is_pressed_like_one_with_curved_edges() {
    let force = |is_straight: bool| {
        let mesh = AnnulusMesh::generate(&annulus(Quad8, 48, 3)).unwrap().mesh;
        let mut file = FileMesh::read(&write_msh(&mesh, FORMS[3], &[], |p| p)).unwrap();
        if is_straight {
            straighten(&mut file);
        }
        let mesh = body(&file);
        let interface = ContactInterface::of(&mesh);
        assert!(interface.gaps.iter().all(|gap| gap.abs() < 1e-12), "{:?}", interface.gaps);
        let body = Assembly::of_edge(&mesh, &POLYCARBONATE, &contact(610.0), RIGID).unwrap();
        body.state(0.3).unwrap().normal_forces(0.3).iter().sum::<f64>()
    };
    let [straight, curved] = [true, false].map(force);
    near(straight, curved, 0.01);
}

/// A shaft of 20.6 mm in a hole of 20.5 mm, and a cup of 16 mm on a ball of 16.2 mm, both pushed in by 20 um.
#[test]
fn an_overlap_beyond_the_interference_is_told_with_its_depth() {
    let ring = AnnulusMesh::generate(&annulus(Quad4, 36, 3)).unwrap().mesh;
    let ring = write_msh(&ring, FORMS[2], &[], |p| p);
    let cup = file_of(&[brick("cup", [0.0; 3], [1.0; 3], [3, 3, 1])], cup);
    let sphere = "contact.boundary=cup_z0 ; contact.counterface=sphere";
    for (mesh, held, contact, radius, said) in [
        (ring, "outer", "contact.interference=2e-5", 0.0206, "by 1.00e-4 m, 5.0 times"),
        (cup, "cup_z1", sphere, 0.0162, "by 2.00e-4 m, 10.0 times"),
    ] {
        let told_of = |radius: &str| {
            let held = format!("boundaries.{held}={{ condition = \"clamped\" }}");
            let (text, set) = (include_str!("../cases/pushed-in.toml"), [&*held, contact, radius]);
            warnings(&case_beside("chords", &[("body.msh", &mesh)], text, &set))
        };
        has(&told_of(&format!("contact.radius={radius}")), &[said, "contact.interference"]);
        has(&told_of("contact.friction_coefficient=0.3"), &["!enters"]);
    }
}
