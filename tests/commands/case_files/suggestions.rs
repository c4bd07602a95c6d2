//! Consistency check of remedies: what a message suggests is taken when it is followed.

use frictionsim::case::{Case, unset};
use std::path::Path;

/// A shipped case under overrides; `-KEY` takes a key away.
fn parse(name: &str, further: &str, overrides: &[&str]) -> Result<Case, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    let text = std::fs::read_to_string(&path).unwrap() + further;
    let laid = |text: &&str| text.strip_prefix('-').map_or_else(|| (*text).to_owned(), unset);
    let overrides: Vec<String> = overrides.iter().map(laid).collect();
    let case = Case::parse(&path.to_string_lossy(), text.as_bytes(), &overrides);
    case.map_err(|errors| errors.to_string())
}

/// Errors of a case, else its warnings.
fn said(name: &str, overrides: &[&str]) -> String {
    match parse(name, "", overrides) {
        Ok(case) => {
            case.deny_warnings(&[]).map_or_else(|errors| errors.to_string(), |()| String::new())
        }
        Err(errors) => errors,
    }
}

const BRAKE: &str = "brake.toml";
const BLOCK: &str = "sliding-block.toml";
const TREAD: &str = "tread-block.toml";
const DISC: &str = "polycarbonate-610rpm.toml";

/// A case, what is changed, what is said of it, what is not, and the changes that follow from what is said.
type Row =
    (&'static str, &'static [&'static str], &'static str, &'static str, &'static [&'static str]);

const ROWS: &[Row] = &[
    (
        BRAKE,
        &["contacts.Outer_Friction_face.mu=0.3"],
        "did you mean `friction_coefficient`?",
        "of [contact]",
        &["contacts.Outer_Friction_face.friction_coefficient=0.3"],
    ),
    (
        BRAKE,
        &["contacts.Outer_Friction_face.penalty=1e12"],
        "did you mean `normal_stiffness`?",
        "of [contact]",
        &["contacts.Outer_Friction_face.normal_stiffness=1e12"],
    ),
    (
        BRAKE,
        &["contact.friction_coefficient=0.4"],
        "describe it under [contacts.Inner_Friction_face]",
        "missing key",
        &["contacts.Inner_Friction_face.friction_coefficient=0.4"],
    ),
    (BRAKE, &["contacts.Outer_Friction_face.base_state=rigid"], "keys of", "of [contact]", &[]),
    (TREAD, &["contact.omega=3"], "did you mean `speed`?", "rotation", &["contact.speed=3"]),
    (TREAD, &["speed=2"], "did you mean `speed` of [contact]?", "rotation", &["contact.speed=2"]),
    (
        BRAKE,
        &["sweep={\"contact.rpm\"=[1,2]}"],
        "did you mean \"motion.Disc_Disc_iron.rotation_speed_rpm\"?",
        "contact.rotation",
        &["sweep={\"motion.Disc_Disc_iron.rotation_speed_rpm\"=[1,2]}"],
    ),
    (
        TREAD,
        &["sweep={\"contact.omega\"=[1,2]}"],
        "did you mean \"contact.speed\"?",
        "rotation",
        &["sweep={\"contact.speed\"=[1,2]}"],
    ),
    (TREAD, &["contact.state=closed"], "keys of [contact]: ", "[contacts.*]", &[]),
    (
        DISC,
        &["contact.force=100"],
        "did you mean `normal_force` in place of `interference`?",
        "center",
        &["-contact.interference", "contact.normal_force=100"],
    ),
    (
        DISC,
        &["contact.normal_load=100"],
        "did you mean `normal_force` in place of `interference`?",
        "normal_law",
        &["-contact.interference", "contact.normal_force=100"],
    ),
    (BRAKE, &["material.mass=1"], "", "of [cea]", &[]),
    (DISC, &["cea.frequencies=3"], "", "[frf]", &[]),
    (BRAKE, &["boundaries.Disc_Bore.stiffness=1"], "", "[improve]", &[]),
    (
        TREAD,
        &["-contact.direction"],
        "for example `direction = [1.0, 0.0, 0.0]`",
        "[1.0, 0.0]",
        &["contact.direction=[1.0, 0.0, 0.0]"],
    ),
    (
        TREAD,
        &["contact.direction=[1.0, 0.0]"],
        "for example `direction = [1.0, 0.0, 0.0]`",
        "for example `direction = [1.0, 0.0]`",
        &["contact.direction=[1.0, 0.0, 0.0]"],
    ),
    (
        BLOCK,
        &["frf={force_node=1,frequencies_hz=[100],force_direction=\"axial\"}"],
        "use \"radial\" or \"tangential\"",
        "three-dimensional",
        &["frf={force_node=1,frequencies_hz=[100],force_direction=\"radial\"}"],
    ),
    (
        DISC,
        &["contact.normal_stiffness=1e18", "contact.normal_damping=5"],
        "leave contact.normal_damping out",
        "use \"rigid\"",
        &["contact.normal_stiffness=rigid"],
    ),
    (
        BLOCK,
        &["-boundaries.back"],
        "condition = \"clamped\" under [boundaries.NAME]",
        "\"guide\"",
        &["boundaries.back={condition=\"clamped\"}"],
    ),
    (BLOCK, &["mesh.scale=1"], "of millimetres it is 0.001", "mm-t-s", &["mesh.scale=0.001"]),
    (
        BLOCK,
        &["contact.counterface=sphere"],
        "of a straight one give \"plane\"",
        "use \"cylinder\"",
        &["contact.counterface=plane"],
    ),
    (DISC, &["contact.ring_inner_radius=0.03"], "leave it out", "set it", &[]),
    (BLOCK, &["contact.ring_inner_radius=0.01"], "leave it out", "set it", &[]),
    (
        BRAKE,
        &["contacts.Outer_Friction_face.interference=1e-5"],
        "with direction and speed, or with rotation_speed_rpm",
        "needs meshing",
        &[],
    ),
    (
        BRAKE,
        &["uncertainty.distributions={\"contact.friction_coefficient\"={uniform=[0.2,0.4]}}"],
        "uncertain value contact.friction_coefficient=",
        "could not be solved",
        &[
            "uncertainty.distributions={\"contacts.Outer_Friction_face.friction_coefficient\"={uniform=[0.2,0.4]}}",
        ],
    ),
    (
        BRAKE,
        &["contacts.Outer_Friction_face.normal_stiffness=1e3"],
        "contacts.Outer_Friction_face.normal_stiffness = 1e3 Pa/m",
        "contact.normal_stiffness =",
        &["contacts.Outer_Friction_face.normal_stiffness=1e13"],
    ),
];

#[test]
fn suggestions_that_are_followed_are_taken() {
    for (name, overrides, part, never, followed) in ROWS {
        let said = said(name, overrides);
        assert!(said.contains(part) && !said.is_empty(), "{name} {overrides:?}: {part}\n{said}");
        let beside = said.replace("contacts.Outer_Friction_face.normal_stiffness =", "");
        assert!(!beside.contains(never), "{name} {overrides:?}: {never}\n{said}");
        if let Err(errors) = parse(name, "", followed) {
            panic!("{name} {followed:?}\n{errors}");
        }
    }
}

/// Sections that commands ask for are those of the body at hand.
#[test]
fn sections_that_commands_ask_for_are_taken() {
    for name in [BRAKE, BLOCK, TREAD, DISC, "ring-on-layer.toml"] {
        let case = parse(name, "", &[]).unwrap();
        let asked = [
            case.require_sweep().err(),
            case.require_uncertainty().err(),
            case.require_fit().err(),
            case.require_convergence().err(),
            case.require_basin().err().filter(|errors| errors.to_string().contains("add\n")),
        ];
        for errors in asked.into_iter().flatten() {
            let help = errors.diagnostics[0].help.clone().unwrap();
            let section = help.strip_prefix("add\n").unwrap_or_else(|| panic!("{name}: {help}"));
            let further = format!("\n{section}\n");
            let given =
                parse(name, &further, &[]).unwrap_or_else(|error| panic!("{name}\n{error}"));
            if section == "[basin]" {
                given.require_basin().unwrap();
            }
        }
    }
    let brake = parse(BRAKE, "", &[]).unwrap();
    assert_eq!(brake.speed_key(), "motion.Disc_Disc_iron.rotation_speed_rpm");
}
