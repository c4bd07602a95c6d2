//! `normal_force`: force and interference are two ways to say one thing.

use crate::prelude::*;

const RING: &str = include_str!("../cases/pressed-ring.toml");
const BLOCK: &str = include_str!("../cases/pressed-block.toml");
/// Two blocks beside each other.
const PADS: &str = include_str!("../cases/pressed-pads.toml");
const SEAM: &str = "ties.seam={ surface=\"left_x1\", counter=\"right_x0\" }";
const ON_PLANE: &str = "contact={ boundary=\"left_z0\", counterface=\"plane\", speed=1.5, \
    direction=[1.0, 0.0, 0.0], friction_coefficient=0.3 }";

fn folder() -> TempDir {
    let block = plane_block([0.04, 0.03], [6, 4], ["face", "back", "block"]);
    let pad = |name, left: f64| brick(name, [left, 0.0, 0.0], [0.02, 0.02, 0.01], [2, 2, 1]);
    let pads = [pad("left", 0.0), pad("right", 0.02)];
    folder_with(&[("block.msh", &block), ("pads.msh", &file_of(&pads, |point| point))])
}

/// Interference, force, and the same interference again, on every kind of body.
#[test]
fn the_force_of_an_interference_gives_that_interference_back() {
    let folder = folder();
    let stiffening = "contact.normal_law=exponential ; contact.reference_pressure=2e5 ; \
        contact.height=2e-6";
    let solid = "mesh.axial_elements=1 ; material.formulation=three-dimensional";
    let under_ring = "contact.boundary=top ; contact.ring_inner_radius=0.03 ; \
        contact.ring_outer_radius=0.05 ; boundaries.bottom.condition=guide";
    let cases: [(&str, &[&str]); 7] = [
        (RING, &[]),
        (RING, &[stiffening]),
        (RING, &[solid]),
        (RING, &[solid, under_ring]),
        (BLOCK, &[]),
        (BLOCK, &[stiffening]),
        (PADS, &[SEAM, ON_PLANE]),
    ];
    for (text, own) in cases {
        let path = folder.path().join("case.toml");
        let with = |change: &str| case_of(&path, text, &[own, &[change]].concat());
        let force = with("contact.interference=2e-5").normal_forces().unwrap()[0];
        assert!(force > 0.0, "{own:?}");
        let pressed = with(&format!("contact.normal_force={force:?}"));
        near_each(&[pressed.contact.sliding.interference], &[2e-5], 1e-9);
        near_each(&pressed.normal_forces().unwrap()[..1], &[force], 1e-9);
    }
}

/// Contacts of one body lean on each other through it, the more so the stiffer it is and the softer it is held: each gets its own force.
#[test]
fn every_contact_gets_its_own_force() {
    let folder = folder();
    let contact = |surface: &str, force: f64| {
        format!(
            "contacts.{surface}={{ surface=\"{surface}\", counterface=\"plane\", speed=1.5, \
             direction=[1.0, 0.0, 0.0], normal_stiffness=1e12, normal_force={force:?}, \
             friction_coefficient=0.3 }}"
        )
    };
    let forces = |more: &[String], wanted: [(&str, f64); 2]| {
        let [left, right] = wanted.map(|(surface, force)| contact(surface, force));
        let own = [SEAM.to_owned(), left, right];
        let path = folder.path().join("case.toml");
        case_of(path, PADS, &[&own, more].concat()).normal_forces().unwrap()
    };
    let below = |left, right| [("left_z0", left), ("right_z0", right)];
    near_each(&forces(&[], below(200.0, 300.0)), &[200.0, 300.0], 1e-9);
    for (held, bound) in [(1e4, 1e-4), (1e6, 1e-6), (1e9, 1e-9)] {
        let held = |name: &str| {
            let springs = format!("normal_stiffness={held:e}, tangential_stiffness={held:e}");
            format!("boundaries.{name}_z1={{ condition=\"support\", {springs} }}")
        };
        let more = ["material.young_modulus=2e11".to_owned(), held("left"), held("right")];
        near_each(&forces(&more, below(2.0, 3.0)), &[2.0, 3.0], bound);
    }
    // Of two opposite ones the weaker follows the block away from where its face was.
    let free = |name: &str| format!("boundaries.{name}_z1={{ condition=\"free\" }}");
    let springs = "condition=\"support\", normal_stiffness=1e11, tangential_stiffness=1e11";
    let aside = format!("boundaries.left_x0={{ {springs} }} ; boundaries.right_x1={{ {springs} }}");
    let more = [free("left"), free("right"), aside];
    let opposite = [("left_z0", 300.0), ("left_z1", 100.0)];
    near_each(&forces(&more, opposite), &[300.0, 100.0], 1e-9);
}

/// Closed forms: a block without Poisson's ratio under a rigid plane is a spring `E A / h`; springs of `k` on the length `l` give way by
/// `F / (k l)`, and a stiff block with them. On springs so soft a force is rounded by more than the share to which others are met.
#[test]
fn a_block_is_pushed_in_by_its_force_over_its_stiffness() {
    let folder = folder();
    let block = [ON_PLANE, "contact.normal_force=1000.0 ; material.poisson_ratio=0.0"];
    let springs = "material.young_modulus=2e11 ; contact.normal_force=10.0 ; boundaries.back={ \
        condition=\"support\", normal_stiffness=1e4, tangential_stiffness=1e4 }";
    for (text, set, exact, bound) in [
        (PADS, &block[..], 1000.0 * 0.01 / (2.5e9 * 0.02 * 0.02), 1e-9),
        (BLOCK, &[springs], 10.0 / (1e4 * 0.04), 1e-4),
    ] {
        let case = case_of(folder.path().join("case.toml"), text, set);
        near_each(&[case.contact.sliding.interference], &[exact], bound);
    }
}
