//! `normal_force`: force and interference are two ways to say one thing.

use crate::prelude::*;

const MATERIAL: &str = "young_modulus = 2.5e9\npoisson_ratio = 0.38\ndensity = 1228.0\n";
const CONTACT: &str = "friction_coefficient = 0.3\n";

fn ring(further: &str) -> String {
    format!(
        "[geometry]\ninner_radius = 0.02\nouter_radius = 0.06\nthickness = 0.009\n\
         [mesh]\ncircumferential_elements = 24\nradial_elements = 6\n{further}\n{MATERIAL}\
         [contact]\nrotation_speed_rpm = 60.0\n{CONTACT}"
    )
}

/// A block of `name` on a rigid plane, or two blocks beside each other.
fn pads(contacts: &str) -> String {
    format!(
        "[mesh]\nfile = \"pads.msh\"\n[material]\n{MATERIAL}[boundaries.left_z1]\ncondition = \"clamped\"\n\
         [boundaries.right_z1]\ncondition = \"clamped\"\n[ties.seam]\nsurface = \"left_x1\"\ncounter = \"right_x0\"\n{contacts}"
    )
}

fn read(folder: &Path, text: &str) -> Result<Case, String> {
    read_case(folder.join("case.toml"), text, AS_IT_IS)
}

fn folder() -> TempDir {
    let names = ["face", "back", "block"];
    let block = quadrilaterals(&even(0.04, 6), &even(0.03, 4), names, |x, y| [x, y]);
    let pad = |name, left: f64| brick(name, [left, 0.0, 0.0], [0.02, 0.02, 0.01], [2, 2, 1]);
    let pads = [pad("left", 0.0), pad("right", 0.02)];
    folder_with(&[("block.msh", &block), ("pads.msh", &file_of(&pads, |point| point))])
}

/// Interference, force, and the same interference again, on every kind of body.
#[test]
fn the_force_of_an_interference_gives_that_interference_back() {
    let folder = folder();
    let plane = format!(
        "[mesh]\nfile = \"block.msh\"\n[material]\n{MATERIAL}[boundaries.back]\ncondition = \"clamped\"\n\
         [contact]\nboundary = \"face\"\ncounterface = \"plane\"\nspeed = 1.5\n{CONTACT}"
    );
    let stiffening = "normal_law = \"exponential\"\nreference_pressure = 2e5\nheight = 2e-6\n";
    let solid = "axial_elements = 1\n[material]\nformulation = \"three-dimensional\"";
    let under_ring = "boundary = \"top\"\nring_inner_radius = 0.03\nring_outer_radius = 0.05\n";
    let guide = "[boundaries.bottom]\ncondition = \"guide\"\n";
    let rigid = "counterface = \"plane\"\nspeed = 1.5\ndirection = [1.0, 0.0, 0.0]\n";
    let short = format!("[contact]\nboundary = \"left_z0\"\n{rigid}{CONTACT}");
    for (head, tail) in [
        (ring("[material]"), ""),
        (ring("[material]") + stiffening, ""),
        (ring(solid), ""),
        (ring(solid) + under_ring, guide),
        (plane.clone(), ""),
        (plane + stiffening, ""),
        (pads(&short), ""),
    ] {
        let with = |line: &str| read(folder.path(), &format!("{head}{line}\n{tail}")).unwrap();
        let pushed = with("interference = 2e-5");
        let force = pushed.normal_forces().unwrap()[0];
        assert!(force > 0.0, "{head}");
        let pressed = with(&format!("normal_force = {force:?}"));
        let found = pressed.contact.sliding.interference;
        assert!((found / 2e-5 - 1.0).abs() < 1e-9, "{head}: {found:e}");
        assert!((pressed.normal_forces().unwrap()[0] / force - 1.0).abs() < 1e-9);
    }
}

/// Two contacts of one body lean on each other through it, and each gets its own force.
#[test]
fn every_contact_gets_its_own_force() {
    let contact = |name: &str, force: f64| {
        format!(
            "[contacts.{name}]\nsurface = \"{name}_z0\"\ncounterface = \"plane\"\nspeed = 1.5\n\
             direction = [1.0, 0.0, 0.0]\nnormal_stiffness = 1e12\nnormal_force = {force:?}\n{CONTACT}"
        )
    };
    let both = contact("left", 200.0) + &contact("right", 300.0);
    let case = read(folder().path(), &pads(&both)).unwrap();
    let forces = case.normal_forces().unwrap();
    near_each(&forces, &[200.0, 300.0], 1e-9);
}

/// Closed form: a block without Poisson's ratio under a rigid plane is a spring `E A / h`.
#[test]
fn a_block_is_pushed_in_by_its_force_over_its_stiffness() {
    let text = format!(
        "[contact]\nboundary = \"left_z0\"\ncounterface = \"plane\"\nspeed = 1.5\ndirection = [1.0, 0.0, 0.0]\n\
         normal_force = 1000.0\n{CONTACT}"
    );
    let text = pads(&text).replace("0.38", "0.0");
    let (text, rest) = text.split_once("[ties.seam]").unwrap();
    let (_, rest) = rest.split_once("[contact]").unwrap();
    let case = read(folder().path(), &format!("{text}[contact]{rest}")).unwrap();
    let exact = 1000.0 * 0.01 / (2.5e9 * 0.02 * 0.02);
    let found = case.contact.sliding.interference;
    assert!((found / exact - 1.0).abs() < 1e-9, "{found:e} {exact:e}");
}
