//! Bodies that turn as a user meets them: input files of CalculiX with a centrifugal load, both frames.

use crate::prelude::*;

/// A grid of cells between radii and heights, revolved into bricks of 20 nodes with reduced integration.
struct Revolved {
    around: usize,
    /// Cells `[r_0, r_1, z_0, z_1]`.
    cells: Vec<[f64; 4]>,
    /// Cells and sectors where there is no material.
    holes: Vec<[usize; 2]>,
}

/// Places of the nodes of a brick in halves of its edges, in the order of C3D20R.
const PLACES: &str =
    "000 200 220 020 002 202 222 022 100 210 120 010 102 212 122 012 001 201 221 021";

/// Radius and height in thousandths, angle in halves of an element.
type Place = (i64, usize, i64);

impl Revolved {
    /// Nodes with their numbers from 1, and the nodes of each element.
    fn mesh(&self) -> (BTreeMap<Place, usize>, Vec<Vec<usize>>) {
        let (mut nodes, mut elements) = (BTreeMap::new(), Vec::new());
        for (cell, &[r0, r1, z0, z1]) in self.cells.iter().enumerate() {
            let is_filled = |sector: &usize| !self.holes.contains(&[cell, *sector]);
            for sector in (0..self.around).filter(is_filled) {
                let between = |a: f64, b: f64, half: usize| {
                    (1000.0 * (a + 0.5 * half as f64 * (b - a))).round() as i64
                };
                let number = |[i, j, k]: [usize; 3]| {
                    let angle = (2 * sector + j) % (2 * self.around);
                    let place = (between(r0, r1, i), angle, between(z0, z1, k));
                    let next = nodes.len() + 1;
                    *nodes.entry(place).or_insert(next)
                };
                let half = |place: &str, axis: usize| usize::from(place.as_bytes()[axis] - b'0');
                let places = PLACES.split(' ').map(|place| [0, 1, 2].map(|axis| half(place, axis)));
                elements.push(places.map(number).collect());
            }
        }
        (nodes, elements)
    }

    /// Nodes and elements of an input file.
    fn text(&self) -> (BTreeMap<Place, usize>, String) {
        let (nodes, elements) = self.mesh();
        let place = |(&(radius, angle, height), &number): (&Place, &usize)| {
            let angle = TAU * angle as f64 / (2 * self.around) as f64;
            (number, polar([radius as f64, angle, height as f64]).map(|x| x / 1e3))
        };
        let points: Vec<_> = nodes.iter().map(place).collect();
        let mut text = abaqus_text(&points, "C3D20R, ELSET=Eall", &elements);
        text += "*SOLID SECTION, ELSET=Eall, MATERIAL=steel\n*MATERIAL, NAME=steel\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.8e-9\n";
        (nodes, text)
    }
}

/// The rotor of CalculiX' test decks, in millimetres: a tube of 0.5 to 1, 100.25 long, a disc of radius 5 and 0.25 thick at its middle.
fn rotor() -> Revolved {
    let before = (0..10).map(|i| 5.0 * f64::from(i));
    let after = (0..10).map(|i| 50.25 + 5.0 * f64::from(i));
    let tube = before.chain(after).map(|z| [0.5, 1.0, z, z + 5.0]);
    let disc = [[0.5, 1.0], [1.0, 3.0], [3.0, 5.0]].map(|[a, b]| [a, b, 50.0, 50.25]);
    Revolved { around: 16, cells: tube.chain(disc).collect(), holes: Vec::new() }
}

/// Appends what holds the rotor in bearings: the mean displacement of the bore's 16 nodes at each end vanishes.
fn hold_ends(text: &mut String, nodes: &BTreeMap<Place, usize>) {
    let first = nodes.len() + 1;
    let last = first + 1;
    write!(text, "*NODE\n{first}, 0., 0., 0.\n{last}, 0., 0., 100.25\n").unwrap();
    write!(text, "*NSET, NSET=Nfix\n{first},\n{last},\n*EQUATION\n").unwrap();
    for (end, height) in [(first, 0), (last, 100_250)] {
        for axis in 1..=3 {
            *text += "17\n";
            for angle in 0..16 {
                writeln!(text, "{}, {axis}, 1.", nodes[&(500, 2 * angle, height)]).unwrap();
            }
            writeln!(text, "{end}, {axis}, -16.").unwrap();
        }
    }
    *text += "*BOUNDARY\nNfix, 1, 3\n";
}

fn turning(speed_squared: &str) -> String {
    format!(
        "*STEP, NLGEOM\n*STATIC\n*DLOAD\nEall, centrif, {speed_squared}, 0., 0., 0., 0., 0., 1.\n*END STEP\n"
    )
}

/// Runs `init --from` on an input file, and a command on the case that it writes with keys added; a table.
fn rows_of(deck: &str, more: &str, command: &str, table: &str) -> Vec<Row> {
    let folder = folder_with(&[("rotor.inp", deck.as_bytes())]);
    Run::new(&["init", "--from", "rotor.inp"]).within(&folder).done();
    let case = fs::read_to_string(folder.path().join("rotor.toml")).unwrap();
    Run::of_text(command, folder.path(), &format!("{case}\n{more}")).out("out").done().rows(table)
}

/// Frequencies of an input file with `cea` keys added, rad/s.
fn modes_of(deck: &str, more: &str) -> Vec<f64> {
    let rows = rows_of(deck, more, "cea", "eigenvalues.csv");
    rows.iter().map(|row| TAU * row.number("frequency_hz")).collect()
}

/// Published values: the decks `rotor` and `rotor2` of CalculiX' test set (`test/rotor.dat.ref`, `rotor2.dat.ref`, step 3), in a
/// frame that turns at 17565 rad/s, above the first critical speed. Its complex modes are combinations of 10 and 20 real ones: the
/// highest it lists are not converged in that (`rotor` modes 9 and 10 are 14 and 13 % above those of all unknowns), and are left out.
#[test]
fn a_rotor_above_its_critical_speed_has_the_published_frequencies_in_its_turning_frame() {
    let (nodes, mesh) = rotor().text();
    let load = turning("3.0853e8");
    // Held at middles of edges on both ends, but for those at right angles.
    let held = nodes.iter().filter(|((radius, angle, height), _)| {
        *radius == 750 && angle % 2 == 0 && angle % 8 != 0 && [0, 100_250].contains(height)
    });
    let held: Vec<String> = held.map(|(_, number)| number.to_string()).collect();
    assert_eq!(held.len(), 24);
    let set = format!("*NSET, NSET=Nfix\n{}\n*BOUNDARY\nNfix, 1, 3\n", held.join(",\n"));
    let found = modes_of(&(mesh.clone() + &set + &load), "[cea]\nmodes = 10\n");
    let published =
        [5.089832, 11737.65, 14535.82, 23381.42, 34851.37, 38368.38, 45038.27, 49577.86];
    near_each(&found[..published.len()], &published, 5e-3);
    // The mean displacement of the bore's nodes at each end vanishes; weak springs hold the turn about the axis.
    let mut text = mesh;
    hold_ends(&mut text, &nodes);
    text += "*SURFACE, NAME=skin\nEall,\n";
    let weak = "[boundaries.skin]\ncondition = \"support\"\nnormal_stiffness = 1e4\ntangential_stiffness = 1e4\n[cea]\nmodes = 11\n";
    let found = modes_of(&(text + &load), weak);
    let published = [
        6128.151, 6351.323, 14905.19, 20215.56, 27483.61, 28809.47, 41398.47, 48544.58, 60801.77,
        71798.82,
    ];
    near_each(&found[1..=published.len()], &published, 5e-3);
}

/// Independent: the body of CalculiX' deck `rotor3`, six elements of its tube missing, which answers a force on the rim of its disc
/// in a frame that turns at 1000 rad/s; solved at 200 Hz with all unknowns by a program of its own (NumPy, elements of 20 nodes with
/// 8 points, on the deck's own mesh). The shaft is out of balance and bends, which moves the resonance at 236 Hz by 5e-4 between
/// base states of first and of second order, and this figure by 3e-3.
///
/// Undamped, its dynamic stiffness is Hermitian: a node moves in phase with the force on it, and two ports answer each other with conjugate
/// figures. The published response (`test/rotor3.dat.ref`: 0.21704 - 0.03626i) is none of such a system: `steadystate.c` multiplies the
/// stored half of the skew Coriolis matrix as if it were symmetric, which the same program confirms (0.21700 - 0.03623i).
#[test]
fn an_undamped_rotor_answers_a_force_in_its_turning_frame_by_a_hermitian_matrix() {
    let holes = [15, 0, 1, 2, 3, 4].map(|sector| [11, sector]).to_vec();
    let (nodes, mut text) = Revolved { holes, ..rotor() }.text();
    hold_ends(&mut text, &nodes);
    writeln!(text, "{}, 2", nodes[&(1000, 0, 0)]).unwrap();
    text += &turning("1.e6");
    let rim = nodes[&(5000, 0, 50_000)];
    let response = |force: &str, observed: &str| {
        let keys = format!(
            "[frf]\nboundary = \"sliding\"\nforce_node = {rim}\nforce_direction = \"{force}\"\nresponse_direction = \"{observed}\"\n\
             quantity = \"receptance\"\nfrequencies_hz = [200.0]\n"
        );
        let row = &rows_of(&text, &keys, "frf", "frf.csv")[0];
        row.numbers(["receptance_real", "receptance_imaginary"]).map(|part| 1e3 * part)
    };
    let expected = [[0.55149, 0.0], [0.11340, -0.37617], [0.11340, 0.37617]];
    for ([force, observed], expected) in [["x", "x"], ["x", "y"], ["y", "x"]].iter().zip(expected) {
        let found = response(force, observed);
        let error = (found[0] - expected[0]).hypot(found[1] - expected[1]);
        assert!(error < 5e-3 * 0.55149, "{force} {observed}: {found:?} {expected:?} mm/N");
        assert!(force != observed || found[1].abs() < 1e-8 * found[0], "{found:?}");
    }
}

/// Exact: a wave of `n` nodal diameters that has the frequency `omega` in the frame that turns with a ring has `omega +- n Omega` in
/// the frame at rest, with Coriolis forces, centrifugal stress and all; and so for springs that are alike in every direction.
#[test]
fn frequencies_of_a_turning_ring_in_both_frames_differ_by_multiples_of_its_speed() {
    let cells = vec![[60.0, 80.0, 0.0, 8.0], [80.0, 100.0, 0.0, 8.0]];
    let ring = Revolved { around: 64, cells, holes: Vec::new() };
    let (_, mesh) = ring.text();
    let deck = mesh + "*SURFACE, NAME=skin\nEall,\n";
    let speed = 30.0;
    let modes = |frame: &str| {
        let rpm = speed * 60.0 / TAU;
        let springs = "[boundaries.skin]\ncondition = \"support\"\nnormal_stiffness = 1e8\ntangential_stiffness = 1e8\n";
        let motion = format!(
            "[motion.Eall]\naxis = [0.0, 0.0, 1.0]\nrotation_speed_rpm = {rpm:?}\nrotation_terms = true\nframe = \"{frame}\"\n"
        );
        modes_of(&deck, &format!("{motion}{springs}[cea]\nmodes = 20\n"))
    };
    let (turning, rest) = (modes("turning"), modes("rest"));
    // Each mode at rest is one of the turning frame, of some number of nodal diameters.
    for found in &rest[..12] {
        let nearest = turning
            .iter()
            .flat_map(|omega| (-6..=6).map(move |n| (omega + f64::from(n) * speed).abs() - found));
        let nearest = nearest.min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap();
        assert!(nearest.abs() < 1e-6 * found, "{found}: {nearest}");
    }
}

/// A block of steel on springs that are alike in every direction, with a mass at its middle.
const WHIRLING: &str = include_str!("../cases/whirling-mass.toml");

/// Closed form: a mass on equal springs in a frame that turns whirls at `omega_0 -+ Omega` there, and at `omega_0` along the axis.
#[test]
fn a_point_mass_whirls_with_the_body_that_it_turns_with() {
    let block = brick("block", [-0.01; 3], [0.02; 3], [2; 3]);
    let files = [("case.toml", WHIRLING.as_bytes()), ("block.msh", &file_of(&[block], |at| at))];
    let rows = Run::of("cea", "case.toml").beside(&files).out("out").done().rows("eigenvalues.csv");
    let found: Vec<f64> = rows.iter().map(|row| row.number("frequency_hz")).collect();
    let (side, mass): (f64, f64) = (0.02, 1.0);
    let springs = 7e6 * 6.0 * side.powi(2);
    let own = (springs / (mass + 7850.0 * side.powi(3))).sqrt() / TAU;
    near_each(&found, &[own - 10.0, own, own + 10.0], 2e-5);
}

/// Damped by what turns with it, the mass whirls unstably above its critical speed.
#[test]
fn what_a_further_mass_does_to_a_whirl_is_predicted_as_it_is_found() {
    let case = WHIRLING.replace("rpm = 600.0", "rpm = 3000.0");
    let case = case.replace("mass = 1.0", "mass = 1.0\ndamping = 5.0")
        + "[improve]\nmodifications = [\"mass\"]\nmass = 0.05\ncandidates = 1\nconfirm = 1\n";
    let block = brick("block", [-0.01; 3], [0.02; 3], [2; 3]);
    let files = [("case.toml", case.as_bytes()), ("block.msh", &file_of(&[block], |at| at))];
    let found = Run::of("improve", "case.toml").beside(&files).out("out").done().summary();
    let own = &found["candidates"][0];
    let growth = |of: &Value| of["growth_rate_per_s"].as_f64().unwrap();
    let (before, after) = (growth(&found["base"]), growth(&own["confirmed"]));
    assert!(before - after > 0.03, "{own}");
    near_each(&[growth(&own["predicted"])], &[after], 2e-3);
    near_each(&[own["first_order_growth_rate_per_s"].as_f64().unwrap()], &[after], 5e-3);
}

/// Exact: `m Omega^2 r` away from the axis, in the frame that turns; the one at rest has no place for what turns.
#[test]
fn a_point_mass_is_pulled_away_from_the_axis_of_a_turning_frame() {
    let [stiffness, damping] = [nalgebra::Matrix3::zeros(); 2];
    let mesh = Mesh {
        dimension: 3,
        nodes: vec![[0.3, 0.4, 0.1]],
        frames: NodalFrames::Solid(vec![nalgebra::Matrix3::identity()]),
        attachments: vec![Attachment { node: 0, mass: 2.0, stiffness, damping }],
        ..Mesh::default()
    };
    for (frame, pull) in
        [(RotationFrame::Turning, [60.0, 80.0, 0.0]), (RotationFrame::Rest, [0.0; 3])]
    {
        let spin = Spin { velocity: nalgebra::Vector3::z() * 10.0, center: [0.0; 3], frame };
        let terms = assemble_rotation(&mesh, &ElasticMaterial::PLAIN, &|_| Some(spin));
        within(&terms.centrifugal, &pull, 1e-12);
    }
}
