//! Frequency responses harmonic by harmonic against sparse solutions of the whole mesh (another
//! assembly, another factorization: independent checks).

use crate::prelude::*;
use frictionsim::study::response::FrequencyStudy;

/// Even and odd numbers of sectors differ in their last harmonic.
fn meshes() -> [AnnulusSpecification; 3] {
    [(24, Quad4), (25, Quad4), (16, Quad8)].map(|(circumferential, element)| AnnulusSpecification {
        radial_grading: 1.1,
        ..annulus(element, circumferential, 6)
    })
}

fn terminals(specification: &AnnulusSpecification, is_sliding: bool) -> Vec<[Terminal; 2]> {
    let mesh = AnnulusMesh::generate(specification).unwrap().mesh;
    let per_sector = mesh.node_count() / specification.circumferential_elements;
    let at = |sector: usize, position: usize, is_tangential: bool| {
        at_node(sector * per_sector + position, is_tangential)
    };
    // On the contact edge, inside, and (Quad8) on the middle ray of a sector.
    let middle = if specification.element.is_quadratic() { per_sector - 4 } else { 2 };
    vec![
        [at(0, 0, true), at(0, 0, true)],
        [at(3, 0, true), at(9, 4, false)],
        [at(7, middle, false), at(2, 3, true)],
        [at(11, 3, true), at(1, middle, true)],
        [at(0, usize::from(is_sliding), false), at(5, 2, false)],
    ]
}

const FREQUENCIES: [f64; 11] =
    [100.0, 777.0, 1500.0, 2345.0, 2800.0, 3456.0, 4321.0, 5678.0, 7000.0, 8765.0, 10_000.0];

fn agree(
    (mesh, whole): (&Mesh, &FrfSystem),
    cyclic: &CyclicSystem,
    terminals: &[[Terminal; 2]],
    what: &str,
) {
    assert_eq!(whole.dimension(), cyclic.dimension());
    for [force, response] in terminals {
        let [at, seen] = [force, response].map(|t| whole.port(mesh, None, *t, "node").unwrap());
        let direct = direct_response(whole, &at, &seen, &FREQUENCIES, &|_| {}).unwrap();
        let solved = cyclic_response(cyclic, *force, *response, &FREQUENCIES).unwrap();
        assert!(solved.backward_error <= 1e-14);
        let top = direct.iter().map(|h| h.norm()).fold(0.0, f64::max);
        for ((f, x), y) in FREQUENCIES.iter().zip(&solved.receptance).zip(&direct) {
            // Backward errors of at most 1e-14 and condition numbers up to 1e5, that of the rigid motion of the free body at 100 Hz; far
            // from the force relative to a thousandth of the largest response.
            let is_same = (x - y).norm() < 1e-9 * y.norm().max(1e-3 * top);
            assert!(is_same, "{what}, {force:?} to {response:?}, {f} Hz: {x} {y}");
        }
    }
}

#[test]
fn harmonics_of_a_free_and_a_clamped_body_sum_to_the_response_of_the_whole_mesh() {
    for specification in &meshes() {
        let mesh = AnnulusMesh::generate(specification).unwrap().mesh;
        let sector = Strip::of_annulus(specification).unwrap();
        let bodies = [(false, Consistent), (false, Lumped), (true, Consistent), (true, Lumped)];
        for (is_clamped, mass) in bodies {
            let whole = FrfSystem::body(&mesh, &POLYCARBONATE, mass, DAMPING, is_clamped);
            let waves = WaveTangent::of_free(&sector, &POLYCARBONATE, mass, DAMPING, is_clamped);
            let cyclic = CyclicSystem::sliding(&waves, 0.0);
            let what = format!("{:?}, clamped {is_clamped}, {mass:?}", specification.element);
            agree((&mesh, &whole), &cyclic, &terminals(specification, false), &what);
        }
    }
}

/// Consistency check: dashpots act on the response whether springs too weak to matter stand beside them or not.
#[test]
fn a_support_of_dashpots_alone_damps_the_response() {
    let specification = &meshes()[0];
    let response = |[spring, dashpot]: [f64; 2]| {
        let mut mesh = AnnulusMesh::generate(specification).unwrap().mesh;
        let mut edges = mesh.boundaries.iter_mut();
        let edge = edges.find(|own| own.condition == Free).unwrap();
        edge.condition = support([spring, spring, 0.0], [dashpot, dashpot]);
        let system = FrfSystem::body(&mesh, &POLYCARBONATE, Consistent, DAMPING, true);
        let [force, seen] = terminals(specification, false)[1];
        let port = |own: Terminal| system.port(&mesh, None, own, "node").unwrap();
        direct_response(&system, &port(force), &port(seen), &FREQUENCIES, &|_| {}).unwrap()
    };
    let [alone, beside, none] = [[0.0, 1e4], [1e-3, 1e4], [1e-3, 0.0]].map(response);
    for ((alone, beside), none) in alone.iter().zip(&beside).zip(&none) {
        assert!((alone - beside).norm() < 1e-9 * beside.norm(), "{alone} {beside}");
        assert!((alone - none).norm() > 1e-4 * none.norm(), "{alone} {none}");
    }
}

#[test]
fn harmonics_in_sliding_contact_sum_to_the_response_of_the_whole_mesh() {
    for specification in meshes() {
        let rigid = contact(610.0);
        let kinds = [(WholeTangent, rigid), (BodyOnly, rigid), (BodyOnly, falling(610.0))];
        for (damping_model, contact) in kinds {
            let contacts = [(None, 0.0), (Some(7.4e12), 0.0), (None, 0.02), (Some(7.4e12), 0.05)];
            for (normal_stiffness, loss_factor) in contacts {
                let material = ElasticMaterial { loss_factor, ..POLYCARBONATE };
                let own = if normal_stiffness.is_some() { loss_factor } else { 0.0 };
                let options = TangentOptions {
                    geometric_stiffness: true,
                    damping_model,
                    contact: ContactStiffness { normal_stiffness, loss_factor: own, ..RIGID },
                    ..TANGENT
                };
                let model = WaveModel { specification, material, options, contact };
                let what = format!("{damping_model:?}, {contact:?}, {normal_stiffness:?}");
                let what = format!("{:?}, {what}, {loss_factor}", specification.element);
                let mesh = AnnulusMesh::generate(&specification).unwrap().mesh;
                let whole = FrfSystem::sliding(&model.whole(), 0.3);
                let cyclic = CyclicSystem::sliding(&model.tangent(), 0.3);
                agree((&mesh, &whole), &cyclic, &terminals(&specification, true), &what);
            }
        }
    }
}

/// Without contact a shaft is a body of its own: the disc answers as it does without one, whose response another solver gives.
#[test]
fn a_disc_on_a_shaft_responds_without_contact_as_the_disc_alone() {
    let text = include_str!("../../cases/deformable-shaft.toml");
    let respond = |boundary: &str, changes: &[&str]| {
        let frf = format!(
            "frf={{boundary=\"{boundary}\",force_node={{x=0.05,y=0.0}},response_node={{x=0.0,y=-0.07}},\
             frequencies_hz=[900.0,4321.0,8765.0]}}"
        );
        let coarse = ["mesh.circumferential_elements=24", "mesh.radial_elements=5", &frf];
        let case = case_of("shaft.toml", text, &[&coarse[..], changes].concat());
        let solved = FrequencyStudy::new(&case).unwrap().solve(&|_| {}).unwrap();
        (solved.summary.method.clone(), solved.receptance())
    };
    for boundary in ["free", "clamped"] {
        let apart = respond(boundary, &["frf.method=\"direct\""]);
        let rigid = ["geometry.shaft_inner_radius", "mesh.shaft_radial_elements", "materials"];
        let rigid = rigid.map(unset);
        let alone = respond(boundary, &rigid.each_ref().map(String::as_str));
        assert_eq!([apart.0, alone.0], ["direct", "cyclic"]);
        near_each(&apart.1, &alone.1, 1e-10);
        assert_eq!(respond(boundary, &[]).0, "reduced");
    }
}
