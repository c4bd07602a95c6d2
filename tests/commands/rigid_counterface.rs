//! Three-dimensional bodies on a rigid counterface: from a mesh file, and generated ones on their whole mesh.

use crate::prelude::*;

/// The built-in disc, coarse, as the harmonics solve it.
const DISC: &str = include_str!("../cases/solid-disc.toml");

fn run(command: &str, case: &str, sets: &[&str]) -> Answer {
    let files = [("case.toml", case), ("rubber.csv", RUBBER)];
    Run::of(command, "case.toml").beside(&files).set(sets).out("out").end()
}

fn modes(answer: &Answer) -> Vec<[f64; 3]> {
    let wanted = ["friction_coefficient", "frequency_hz", "growth_rate_per_s"];
    columns(&answer.rows("eigenvalues.csv"), wanted)
}

/// What a command leaves of the disc harmonic by harmonic, and on its whole mesh, as the key says.
fn by_both<T>([command, key]: [&str; 2], sets: &[&str], read: impl Fn(Answer) -> T) -> [T; 2] {
    ["auto", "sparse"].map(|method| {
        let own = format!("{key}=\"{method}\"");
        read(run(command, DISC, &[sets, &[&own]].concat()).code(0))
    })
}

const CEA: [&str; 2] = ["cea", "cea.method"];
const UNDAMPED: &str = "damping.mass_coefficient=0 ; damping.stiffness_coefficient=0";

/// Largest distance of a mode from the nearest of the others at the same friction, relative.
fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let to = |p: &[f64; 3], q: &[f64; 3]| ((p[1] - q[1]).hypot((p[2] - q[2]) / TAU)) / p[1];
    let nearest = |p: &[f64; 3]| {
        b.iter().filter(|q| q[0] == p[0]).map(|q| to(p, q)).fold(f64::INFINITY, f64::min)
    };
    a.iter().map(nearest).fold(0.0, f64::max)
}

/// Independent: the harmonics of a body of revolution have assembly, base state and contact of their own, and in rigid contact both
/// have friction across the sliding at the nodes.
#[test]
fn the_whole_mesh_of_a_body_of_revolution_has_the_spectrum_of_its_harmonics() {
    let ring = [
        "contact.boundary=\"top\" ; contact.ring_inner_radius=0.04 ; contact.ring_outer_radius=0.07",
        "boundaries.bottom={condition=\"guide\"}",
    ];
    for contact in [&[][..], &ring] {
        let sets = [contact, &["contact.rotation_speed_rpm=6000"]].concat();
        let [cyclic, whole] = by_both(CEA, &sets, |answer| modes(&answer));
        let at_rest = |all: &[[f64; 3]]| -> Vec<[f64; 3]> {
            all.iter().filter(|mode| mode[0] == 0.0).copied().collect()
        };
        below(distance(&at_rest(&whole), &at_rest(&cyclic)), 1e-10, "at rest");
        below(distance(&whole, &cyclic), 1e-7, "sliding");
    }
}

/// Steady sliding is the same all around: a quarter of a turn on, the probe of a node moves along the other axis.
#[test]
fn probes_of_a_whole_mesh_move_along_x_y_and_z() {
    let sets = [
        "transient={duration=1e-6,initial=\"steady-sliding\",operator=\"sparse\"}",
        "output={sample_interval=1e-6,probes=[6,38]}",
    ];
    let answer = run("transient", DISC, &sets).code(0);
    let [[x, y, z], [ahead_x, ahead_y, ahead_z]] = ["probe-6.csv", "probe-38.csv"]
        .map(|name| answer.rows(name)[0].numbers(["u_x_m", "u_y_m", "u_z_m"]));
    assert!(x > 1e-6 && y > 1e-8, "{x:e} {y:e}");
    let probes = &answer.summary()["probes"]["6"];
    let has = |key: &str| probes.get(key).is_some();
    assert!(["x", "y", "z"].into_iter().all(has), "{probes}");
    assert!(!["radial", "tangential", "axial"].into_iter().any(has), "{probes}");
    for [a, b] in [[ahead_x, -y], [ahead_y, x], [ahead_z, z]] {
        assert!((a - b).abs() < 1e-9 * x, "{a:e} {b:e}");
    }
}

/// A ring of steel in the lower half, with damping of its own, on a finer mesh.
const RING: [&str; 2] = [
    "materials.ring={radii=[0.0438333333333333,0.0671666666666667],heights=[0.0,0.0045],young_modulus=2e11,\
     poisson_ratio=0.3,density=7850.0,mass_coefficient=300.0,stiffness_coefficient=2e-7}",
    "mesh.axial_elements=2",
];

/// Independent, as above: energies and losses of several materials are those of the whole mesh in steps, pressed onto both.
#[test]
fn several_materials_of_a_body_of_revolution_are_those_of_its_whole_mesh() {
    let sets = [RING[0], RING[1], "transient={duration=3e-4,expansion_time=1e-4}"];
    let motions = by_both(["transient", "transient.operator"], &sets, |answer| {
        columns(&answer.rows("energy.csv"), ["kinetic_j", "strain_j", "material_damping_w"])
    });
    assert_eq!(motions[0].len(), motions[1].len());
    for column in 0..3 {
        let largest = motions[1].iter().fold(0.0, |m: f64, row| m.max(row[column]));
        let pairs = motions[0].iter().zip(&motions[1]);
        let error = pairs.map(|(a, b)| (a[column] - b[column]).abs()).fold(0.0, f64::max);
        assert!(error < 1e-9 * largest, "{error:e} of {largest:e}");
    }
}

/// Modulus and loss factor of rubber that stiffens over the modes of the disc.
const RUBBER: &str = "frequency_hz,young_modulus,loss_factor\n\
     0,1.2e9,0.02\n4000,1.6e9,0.1\n9000,2.2e9,0.2\n40000,4e9,0.1\n";

/// Independent, as above: losses of the body, of a part with dashpots of its own, and moduli over frequency part the waves of each
/// harmonic. The part makes top and bottom differ.
#[test]
fn losses_of_a_body_of_revolution_are_those_of_its_whole_mesh() {
    let lossy_ring = RING[0].replace("young", "loss_factor=0.2,young");
    let rubber_ring = RING[0].replace("young_modulus=2e11", "table=\"rubber.csv\"");
    for (name, sets) in [
        ("disc", vec!["material.loss_factor=0.02"]),
        ("ring", vec![&lossy_ring, RING[1], "material.loss_factor=0.05"]),
        ("parts", RING.to_vec()),
        ("rubber", vec![&rubber_ring, RING[1]]),
    ] {
        let further = "cea.friction_coefficients=[0.0, 0.3, 0.6] ; cea.modes=16 ; \
            contact.rotation_speed_rpm=1e12";
        let [waves, whole] = by_both(CEA, &[&sets[..], &[further]].concat(), |own| {
            (modes(&own), column(&own.rows("stability.csv"), "critical_friction"), own)
        });
        assert_eq!(waves.2.summary()["method"], "cyclic");
        assert_eq!(waves.0.len(), whole.0.len());
        let error = distance(&whole.0, &waves.0).max(distance(&waves.0, &whole.0));
        below(error, 1e-10, format!("{name} {:?} {:?}", waves.1, whole.1));
        assert!(!waves.1.is_empty());
        within(&waves.1, &whole.1, 1e-8);
        let listed = waves.2.rows("eigenvalues.csv");
        assert!(listed.iter().any(|row| row["direction"] == "1" && row["harmonic"] == "3"));
    }
}

/// Exact: one loss factor of the body, of what holds it and of the springs of its contact makes `(1 + i eta) lambda^2` of each
/// `lambda^2`, friction or not, where nothing else damps.
#[test]
fn one_loss_factor_of_body_and_springs_turns_every_eigenvalue() {
    let held = "condition=\"support\",normal_stiffness=1e12,tangential_stiffness=1e12,axial_stiffness=1e12";
    let springs = ["contact.normal_stiffness=1e12 ; contact.base_state=compliant", UNDAMPED];
    let lossy = "material.loss_factor=0.1 ; contact.loss_factor=0.1";
    let spectrum = |own: &str, further: &[&str]| {
        let held = format!("boundaries.outer={{{held}{own}}}");
        let sets = [&springs[..], &[&held], further].concat();
        modes(&run("cea", DISC, &sets).code(0))
    };
    let (mut plain, lossy) = (spectrum("", &[]), spectrum(",loss_factor=0.1", &[lossy]));
    for mode in &mut plain {
        let root = (c64::new(mode[2], TAU * mode[1]).powi(2) * c64::new(1.0, 0.1)).sqrt();
        let root = if root.im < 0.0 { -root } else { root };
        (mode[1], mode[2]) = (root.im / TAU, root.re);
    }
    below(distance(&lossy, &plain), 1e-7, "turned eigenvalues");
}

/// Independent: a response harmonic by harmonic, with losses, and that of the whole mesh. A place without a height is on the top face
/// of either; the response is below it.
#[test]
fn the_response_of_a_lossy_body_of_revolution_is_that_of_its_whole_mesh() {
    let place = "x=0.0,y=0.0671666666666667";
    let frf = format!(
        "frf={{force_node={{{place}}},response_node={{{place},z=0.0}},force_direction=\"axial\",\
         response_direction=\"axial\",frequencies_hz=[600.0,1200.0,2400.0],boundary=\"clamped\"}}"
    );
    let sets = [&frf, "material.loss_factor=0.05"];
    let [waves, whole] = by_both(["frf", "cea.method"], &sets, |answer| {
        let parts = ["accelerance_real", "accelerance_imaginary"];
        let lines = columns(&answer.rows("frf.csv"), parts).into_iter();
        lines.map(|[re, im]| c64::new(re, im)).collect::<Vec<c64>>()
    });
    assert_eq!(waves.len(), 3);
    near_each(&waves, &whole, 1e-9);
}

/// What the harmonics cannot do is done on the whole mesh: a mass on the disc, its matrices, measured shapes, improvements.
#[test]
fn a_generated_body_of_revolution_takes_what_breaks_its_symmetry() {
    let mass =
        format!("{DISC}\n[modifications.weight]\nat = {{ x = 0.0905, y = 0.0 }}\nmass = 0.01\n");
    let free = "boundaries.outer={condition=\"support\",normal_stiffness=1e10,tangential_stiffness=1e10,axial_stiffness=1e10}";
    let cea = |case, sets: &[&str]| modes(&run("cea", case, sets).code(0));
    let (plain, loaded) = (cea(DISC, &[free, "cea.method=\"sparse\""]), cea(&mass, &[free]));
    assert!(loaded[0][1] < plain[0][1] * (1.0 - 1e-4), "{loaded:?} {plain:?}");
    // Without damping of its own, losses of 1 % damp a mode that contact does not by half as much.
    let lossy = ["material.loss_factor=0.01", UNDAMPED];
    for mode in cea(DISC, &lossy).iter().filter(|mode| mode[0] == 0.0) {
        let damping = -mode[2] / (TAU * mode[1]);
        assert!((damping - 0.005).abs() < 1e-5, "{mode:?}");
    }
    let [auto, sparse] = by_both(["matrices", "cea.method"], &[], |answer| answer.bytes("K.mtx"));
    assert!(auto == sparse, "the matrices are those of the whole mesh");
    // What is predicted for one body, whichever way it was asked for.
    let sets = [
        "contact.friction_coefficient=0.6 ; cea.friction_coefficients=[0.0, 0.6]",
        "improve.modifications=[\"mass\"] ; improve.confirm=0 ; improve.mass=0.01",
    ];
    let [auto, sparse] = by_both(["improve", "cea.method"], &sets, |answer| {
        let growth = column(&answer.rows("candidates.csv"), "predicted_growth_rate_per_s");
        (growth, answer.summary()["notes"].to_string())
    });
    near_each(&sparse.0, &auto.0, 1e-6);
    has(&auto.1, &["on its whole mesh"]);
    has(&sparse.1, &["!on its whole mesh"]);
    let points = ["0.0205,0,0.009", "0.01893953042,0.00784501036,0.009", "0,0.0205,0.009"];
    let points = points.map(|point| format!("s,1000,{point},0,0,1\n")).concat();
    let shapes = format!("mode,frequency_hz,x,y,z,ux,uy,uz\n{points}");
    let files = [("case.toml", DISC), ("shapes.csv", &shapes)];
    let mac = Run::of("mac", "case.toml").args(&["shapes.csv"]).beside(&files).out("mac");
    let mac = mac.done().summary();
    // Motion along the axis, the same all around, is that of a mode of harmonic 0.
    let best = mac["pairs"][0]["mode"].as_u64().unwrap() as usize;
    assert_eq!(mac["modes"][best - 1]["harmonic"], 0, "{mac}");
    let springs = "contact.normal_stiffness=1e12";
    let refused = run("matrices", DISC, &[springs]).code(2);
    refused.warns(&["contact.base_state", "write base_state = \"compliant\""]);
}

/// Numbers by LAPACK: the dense eigenvalues of the exported matrices at this friction have a mode at 1424.66 Hz with growth 0.0 1/s.
#[test]
fn the_shipped_tread_block_squeals_in_its_shear_mode() {
    let sets = ["cea.friction_coefficients=[0.0,0.4,0.5]", "cea.modes=4"];
    let run = Run::of("cea", shipped("tread-block.toml")).out("out").set(&sets);
    let summary = run.done().summary();
    let onset = &summary["critical_frictions"][0];
    let of = |key: &str| onset[key].as_f64().unwrap();
    assert!((of("critical_friction") - 0.451102).abs() < 1e-6, "{onset}");
    has(&summary.to_string(), &["drag_n"]);
    assert!((of("frequency_hz") - 1424.66).abs() < 0.01, "{onset}");
}

/// Two blocks apart, each on a plane of its own.
const SLIDERS: &str = include_str!("../cases/two-sliders.toml");

/// Exact: a drag is a power over the speed of its own contact, a torque one over its own rotation.
#[test]
fn drag_and_torque_of_contacts_of_different_speed_are_the_sums_of_their_own() {
    let blocks = [
        brick("left", [0.0; 3], [0.02, 0.02, 0.01], [2, 2, 1]),
        brick("right", [0.05, 0.0, 0.0], [0.02, 0.02, 0.01], [2, 2, 1]),
    ];
    let mesh = file_of(&blocks, |at| at);
    let solve = |case: &str| {
        let files = [("case.toml", case.as_bytes()), ("blocks.msh", &mesh)];
        let answer = Run::of("cea", "case.toml").beside(&files).out("out").done();
        let rows = answer.rows("prestress.csv");
        let force = |name: &str| -> f64 {
            let own = rows.iter().filter(|row| row["contact"] == name);
            own.map(|row| row.number("shear_pa") * row.number("area_m2")).sum()
        };
        let forces = ["first", "second"].map(force);
        (forces, answer.summary()["base_state"].clone(), answer.said())
    };
    let ([first, second], base, said) = solve(SLIDERS);
    assert!(first > 1.0 && second > 1.5 * first, "{first} {second}");
    let number = |base: &Value, key: &str| base[key].as_f64().unwrap_or_else(|| panic!("{base}"));
    near_each(&[number(&base, "drag_n")], &[first + second], 1e-9);
    near_each(&[number(&base, "power_w")], &[first + 5.0 * second], 1e-9);
    assert!(base.get("torque_n_m").is_none_or(Value::is_null), "{base}");
    has(&said, &["drag"]);
    // The second plane turns about an axis beside its block.
    let straight = "direction = [0.0, 1.0, 0.0]\nspeed = 5.0\n";
    let turning =
        "axis = [0.0, 0.0, 1.0]\ncenter = [0.06, -0.1, 0.0]\nrotation_speed_rpm = 600.0\n";
    let ([first, _], base, said) = solve(&SLIDERS.replace(straight, turning));
    near_each(&[number(&base, "drag_n")], &[first], 1e-9);
    let power = number(&base, "power_w") - first;
    near_each(&[number(&base, "torque_n_m")], &[power / (TAU * 10.0)], 1e-9);
    has(&said, &["torque", "drag"]);
}

/// A blade clamped at one end and pulled at the other.
const BLADE: &str = include_str!("../cases/stretched-blade.toml");

fn blade(command: &str, sets: &[&str]) -> Answer {
    let blade = brick("blade", [0.0; 3], [0.2, 0.01, 0.002], [10, 1, 1]);
    let mesh = file_of_order(&[blade], 2, |at| at);
    let files = [("case.toml", BLADE.as_bytes()), ("blade.msh", &mesh)];
    Run::of(command, "case.toml").beside(&files).set(sets).out("out").done()
}

/// Independent: `cea` of the same blade. An undamped response changes its sign at an eigenvalue, and the stress of the pressure
/// takes that of the unloaded blade to three times its frequency.
#[test]
fn a_response_without_contact_resonates_where_the_blade_is_stretched() {
    let mode = |sets: &[&str]| blade("cea", sets).rows("eigenvalues.csv")[0].number("frequency_hz");
    let (own, slack) = (mode(&[]), mode(&["boundaries.blade_x1.pressure=-1.0"]));
    assert!(own > 2.5 * slack, "{own} {slack}");
    let lines = format!("frf.frequencies_hz=[{}, {}]", 0.99 * own, 1.01 * own);
    let rows = blade("frf", &[&lines]).rows("frf.csv");
    let [below, above] = [0, 1].map(|line| rows[line].number("receptance_real"));
    assert!(below > 0.0 && above < 0.0, "{own} Hz: {below:e} {above:e}");
}

#[test]
fn bodies_that_a_pressure_pulls_are_not_told_to_be_free_of_stress() {
    let said = blade("cea", &[]).said();
    has(&said, &["no contact pressure"]);
    assert!(!said.contains("free of stress"), "{said}");
}
