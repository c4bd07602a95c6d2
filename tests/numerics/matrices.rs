//! Matrices that leave the program and come back.
//!
//! Independent check: `disk_brake100` of the NLEVP collection (licence beside the data) with eigenvalues computed to 40 digits elsewhere.
//! Consistency check: the exported matrices of a body without symmetry, solved densely, have the eigenvalues of `cea`.

use crate::cea_cyclic::dense::dense_quadratic;
use crate::prelude::*;

/// The eigenvalues published with the problem.
fn published() -> Vec<c64> {
    let values = columns(&rows(&public("eigenvalues.csv")), ["real", "imaginary"]);
    values.into_iter().map(|[re, im]| c64::new(re, im)).collect()
}

/// Badly scaled on purpose: sizes of eigenvalues lie seven orders apart. A plain linearization loses the small ones.
#[test]
fn the_public_disk_brake_problem_has_its_eigenvalues_of_every_size() {
    let [m, c, k] = ["M.mtx", "C.mtx", "K.mtx"].map(|name| market_matrix(&public(name)));
    let exact = published();
    let found = quadratic_modes(m.as_ref(), c.as_ref(), k.as_ref()).unwrap();
    assert_eq!(found.len(), exact.len());
    let own: Vec<c64> = found.iter().map(|mode| mode.eigenvalue).collect();
    // A prototype in another language, by the same windows, has 3e-13.
    below(largest_error(&own, &exact), 2e-12, "disk brake");
    assert!(found.iter().all(|mode| mode.residual < 1e-12));
}

/// A sheared block of 5 x 3 quadrilaterals, thicker on one side, on a plane that slides under it; its back on springs and dashpots of
/// their own, so that damping is not proportional.
fn block(folder: &TempDir) {
    let names = ["face", "back", "block"];
    let sheared = |x: f64, y: f64| [x + 0.2 * y, y * (1.0 + 4.0 * x)];
    let mesh = quadrilaterals(&even(0.05, 5), &even(0.03, 3), names, sheared);
    fs::write(folder.path().join("block.msh"), mesh).unwrap();
    let case = include_str!("../cases/sheared-block.toml");
    fs::write(folder.path().join("block.toml"), case).unwrap();
}

fn run(folder: &TempDir, command: &str, set: &[&str]) -> Run {
    let run = Run::of(command, "block.toml").within(folder).out(command);
    run.args(&["--quiet", "--force"]).set(set)
}

fn solved(folder: &TempDir, set: &[&str]) -> Answer {
    run(folder, "cea", set).done();
    run(folder, "matrices", set).done()
}

fn public(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/numerics/nlevp");
    folder.join(format!("disk_brake100_{name}"))
}

/// The exported problem at a friction coefficient, put together as `matrices.json` says.
fn assembled(folder: &Path, friction: f64) -> [Mat<f64>; 4] {
    let description = fs::read(folder.join("matrices.json")).unwrap();
    let description: Value = serde_json::from_slice(&description).unwrap();
    let size = description["dofs"].as_u64().unwrap() as usize;
    let away = friction - description["friction_coefficient"].as_f64().unwrap();
    let mut sums = [0, 1, 2, 3].map(|_| Mat::<f64>::zeros(size, size));
    for entry in description["matrices"].as_array().unwrap() {
        let file = folder.join(entry["matrix_market"].as_str().unwrap());
        let matrix = market_matrix(&file);
        let roles = ["mass", "damping", "stiffness", "structural"];
        for (sum, role) in sums.iter_mut().zip(roles) {
            if let Some(power) = entry["role"][role]["friction_power"].as_i64() {
                *sum += faer::Scale(away.powi(power as i32)) * &matrix;
            }
        }
    }
    sums
}

/// Eigenvalues of `lambda^2 M + lambda C + K + i H` by the companion matrix, frequencies scaled to about one.
pub fn lossy_eigenvalues([mass, damping, stiffness, losses]: [&Mat<f64>; 4]) -> Vec<c64> {
    let size = mass.nrows();
    let scale = (stiffness.norm_l2() / mass.norm_l2()).sqrt();
    let complex = |own: &Mat<f64>| Mat::from_fn(size, size, |i, j| c64::new(own[(i, j)], 0.0));
    let elastic = Mat::from_fn(size, size, |i, j| c64::new(stiffness[(i, j)], losses[(i, j)]));
    dense_quadratic(&complex(mass), &complex(damping), &elastic, scale)
}

/// Rigid contact, springs with dashpots, those with falling friction, whose dashpots have a power of friction more than the stress, and
/// losses of the block and of springs, which have a matrix of their own.
#[test]
fn exported_matrices_solved_densely_have_the_eigenvalues_of_the_analysis() {
    let folder = folder();
    block(&folder);
    let springs = "contact.normal_stiffness=1e13";
    let dashpots = [springs, "contact.normal_damping=1e4"];
    let falling = [springs, "contact.static_friction_ratio=1.4 ; contact.decay_speed=0.5"];
    let lossy = ["material.loss_factor=0.03", springs, "contact.loss_factor=0.1"];
    for contact in [&[][..], &dashpots, &falling, &lossy] {
        solved(&folder, contact);
        let [.., losses] = assembled(&folder.path().join("matrices"), 0.3);
        assert_eq!(losses.norm_max() > 0.0, contact == lossy, "{contact:?}");
        assert!(listed_modes_found(&folder, 0.3) >= 6, "{contact:?}");
    }
}

/// How many modes `cea` lists at a friction coefficient, all of them among the dense ones of the exported matrices.
fn listed_modes_found(folder: &TempDir, friction: f64) -> usize {
    modes_among(folder, friction, &assembled(&folder.path().join("matrices"), friction))
}

fn modes_among(folder: &TempDir, friction: f64, matrices: &[Mat<f64>; 4]) -> usize {
    let [mass, damping, stiffness, losses] = matrices;
    let found: Vec<c64> = if losses.norm_max() > 0.0 {
        lossy_eigenvalues([mass, damping, stiffness, losses])
    } else {
        quadratic_eigenvalues([mass, damping, stiffness])
    };
    let rows = rows(&folder.path().join("cea/eigenvalues.csv"));
    let own = columns(&rows, ["friction_coefficient", "real_hz", "frequency_hz"]).into_iter();
    let own = own.filter(|[at, ..]| *at == friction);
    let listed: Vec<c64> = own.map(|[_, re, im]| TAU * c64::new(re, im)).collect();
    below(largest_error(&found, &listed), 1e-9, "modes among the dense ones");
    listed.len()
}

/// A block that is pressed on another, which turns under it.
const BLOCKS: &str = include_str!("../cases/block-on-a-turning-block.toml");

/// Two blocks that slide on each other, on springs and rigidly, and the rows of their contact.
#[test]
fn exported_matrices_of_solid_bodies_have_the_eigenvalues_of_the_analysis() {
    let block = |name, z: f64, counts| brick(name, [0.0, 0.0, z], [0.02, 0.02, 0.01], counts);
    let blocks = [block("low", 0.0, [2, 2, 1]), block("high", 0.01, [3, 2, 1])];
    let text = format!("{BLOCKS}[cea]\nfriction_coefficients = [0.4]\nmodes = 6\n");
    let mesh = file_of(&blocks, |p| p);
    let files = [("block.msh", &mesh[..]), ("block.toml", text.as_bytes())];
    let set = "boundaries.high_x1.normal_stiffness=1e12 ; contacts.face.friction_coefficient=0.4";
    for contact in [&["contacts.face.normal_stiffness=1e13"][..], &[]] {
        let folder = folder_with(&files);
        let answer = solved(&folder, &[&[set], contact].concat());
        assert!(listed_modes_found(&folder, 0.4) >= 6);
        // Points part by one where the upper block, second in the file, is lifted by one; pressed rigid points do not part.
        let unknowns = columns(&answer.rows("unknowns.csv"), ["node", "direction_z"]);
        let lifted = Mat::from_fn(unknowns.len(), 1, |unknown, _| match unknowns[unknown] {
            [node, along] if node > 18.0 => along,
            _ => 0.0,
        });
        let parted = market_matrix(&answer.path("contact_normal.mtx")) * lifted;
        let expected = if contact.is_empty() { 0.0 } else { 1.0 };
        assert!(parted.col(0).iter().all(|own| (own - expected).abs() < 1e-12), "{parted:?}");
        let header = "point,contact,status,area_m2,normal_force_n,x_m,y_m,z_m";
        assert_eq!(answer.header("contact.csv"), header);
        let forces = column(&answer.rows("contact.csv"), "normal_force_n");
        // 1 MPa on 400 mm2, but for what the springs of the side bear.
        near(forces.iter().sum(), 400.0, 0.02);
    }
}

/// Two blocks of which the upper one, taller than wide, is held loosely at its side, and slides on the lower.
fn tall_block(folder: &TempDir, contact: &str, frictions: &str) {
    let block = |name, z: f64, high, counts| brick(name, [0.0, 0.0, z], [0.02, 0.02, high], counts);
    let wide = sized(1, 2);
    let blocks = [block("low", 0.0, 0.01, [2, wide, 1]), block("high", 0.01, 0.03, [3, wide, 2])];
    let cea = format!("[cea]\nfriction_coefficients = {frictions}\nmodes = 6\n");
    let text = format!("{BLOCKS}{contact}\n{cea}");
    fs::write(folder.path().join("block.msh"), file_of(&blocks, |p| p)).unwrap();
    fs::write(folder.path().join("block.toml"), text).unwrap();
}

/// Consistency check: the same problem leaves the program as the analysis has it, at each friction coefficient alone, and by powers of the
/// distance from the case's own over the range that they hold in. Powers of friction itself had terms of 4e22 whose sum was 1e12.
#[test]
fn exported_matrices_have_the_eigenvalues_of_the_analysis_where_contact_opens_or_stiffens() {
    let law = ["normal_law=\"exponential\"", "reference_pressure=1e5", "height=1e-6"];
    let frictions = [0.1, 0.4, 0.7, 0.9];
    let of = |section: &str| law.map(|key| format!("{section}.{key}"));
    for (is_solid, contact) in [
        (false, Vec::new()),
        (false, of("contact").to_vec()),
        (true, vec!["contacts.face.normal_stiffness=1e13".to_owned()]),
        (true, of("contacts.face").to_vec()),
    ] {
        let folder = folder();
        let own = if is_solid {
            tall_block(&folder, "", "[0.7]");
            "contacts.face.friction_coefficient=0.7"
        } else {
            block(&folder);
            "contact.friction_coefficient=0.7"
        };
        let mut set: Vec<&str> = contact.iter().map(String::as_str).collect();
        set.extend(["cea.friction_coefficients=[0.1,0.4,0.7,0.9]", own]);
        let description = solved(&folder, &set).json("matrices.json");
        let [low, high] = [0, 1].map(|end| description["friction_range"][end].as_f64().unwrap());
        let own = frictions.into_iter().filter(|own| (low..=high).contains(own));
        let held: usize = own.map(|friction| listed_modes_found(&folder, friction)).sum();
        // Of the plane block two friction coefficients have the contact state of the case's own.
        let least = if is_solid { 6 } else { 12 };
        assert!(held >= least, "{contact:?}: {held} in {low} to {high}");
        // Dense problems of solid bodies take a second each.
        for friction in frictions.into_iter().step_by(1 + usize::from(is_solid)) {
            let matrices = at_friction(&folder, friction, &set);
            let found = modes_among(&folder, friction, &matrices);
            assert!(found >= 6, "{contact:?} {friction}: {found}");
        }
    }
}

/// What `frictionsim matrices --friction` writes, without losses.
fn at_friction(folder: &TempDir, friction: f64, set: &[&str]) -> [Mat<f64>; 4] {
    let run = Run::new(&["matrices", "block.toml", "--quiet", "--force"]).within(folder);
    let out = run.out("alone").args(&["--friction", &friction.to_string()]).set(set).done().out;
    let mut files = names_in(&out);
    files.retain(|name| !name.starts_with('.'));
    assert_eq!(files.join(" "), "C.mtx K.mtx M.mtx manifest.json mesh.msh summary.json");
    let [m, c, k] = ["M.mtx", "C.mtx", "K.mtx"].map(|name| market_matrix(&out.join(name)));
    let none = Mat::zeros(m.nrows(), m.nrows());
    [m, c, k, none]
}

/// Independent: contact that stiffens, whose points open within the sweep. The polynomials of each state hold in its own range only: the
/// analysis starts without friction from another one, and reports and exported matrices are those of the case's own friction. Modes
/// there are the same whichever other friction coefficients are asked for, between which other points touch.
#[test]
fn exported_matrices_hold_where_contact_that_stiffens_has_opened() {
    let folder = folder();
    let law = "normal_law = \"exponential\"\nreference_pressure = 1e5\nheight = 1e-6";
    tall_block(&folder, law, "[0.1, 0.8]");
    for turning in ["-100.0", "100.0"] {
        let turning = format!("motion.low.rotation_speed_rpm={turning}");
        let answer = solved(&folder, &[&turning]);
        assert_eq!(listed_modes_found(&folder, 0.8), 6);
        let range = &answer.json("matrices.json")["friction_range"];
        assert!(range[0].as_f64().unwrap() > 0.2, "nothing opens: {range}");
        let base = &answer.json("../cea/summary.json")["base_state"];
        assert!(base["open"].as_u64().unwrap() > sized(50, 100), "{base}");
        assert!(base["pressure_pa"][0].as_f64().unwrap() >= 0.0, "{base}");
    }
    for others in ["", "0.7, ", "0.1, 0.5, 0.7, "] {
        let frictions = format!("cea.friction_coefficients=[{others}0.8]");
        run(&folder, "cea", &[&frictions]).done();
        assert_eq!(listed_modes_found(&folder, 0.8), 6);
    }
}

/// Header and data of an array of an archive.
pub fn array_of(archive: &Path, name: &str) -> (String, Vec<u8>) {
    let mut archive = zip::ZipArchive::new(fs::File::open(archive).unwrap()).unwrap();
    let mut bytes = Vec::new();
    archive.by_name(name).unwrap().read_to_end(&mut bytes).unwrap();
    let header = 10 + usize::from(bytes[8]) + 256 * usize::from(bytes[9]);
    (String::from_utf8_lossy(&bytes[10..header]).into_owned(), bytes[header..].to_vec())
}

/// The keys and types that `scipy.sparse.load_npz` asks for.
#[test]
fn archives_hold_compressed_rows_as_scipy_reads_them() {
    let folder = folder();
    block(&folder);
    let answer = run(&folder, "matrices", &[]).done();
    let matrix = MarketMatrix::read(&answer.text("K.mtx"), usize::MAX).unwrap();
    let (pointers, columns, _) = matrix.compressed_rows();
    let entry = |name: &str| array_of(&answer.path("K.npz"), name);
    let (text, bytes) = entry("format.npy");
    assert!(text.contains("'descr': '|S3'") && text.contains("'shape': ()"), "{text}");
    assert_eq!(bytes, b"csr");
    for (name, values) in [("indptr.npy", pointers), ("indices.npy", columns)] {
        let (text, bytes) = entry(name);
        assert!(text.contains("'descr': '<i8'"), "{text}");
        let read = bytes.as_chunks().0.iter().map(|own| i64::from_le_bytes(*own) as usize);
        assert!(read.eq(values.iter().copied()), "{name}");
    }
    let head = "unknown,node,kind,direction_x,direction_y,direction_z,x_m,y_m,z_m";
    assert_eq!(answer.header("unknowns.csv"), head);
}

fn brake(folder: &TempDir, stiffness: &str) {
    for name in ["M.mtx", "C.mtx", "K.mtx"] {
        fs::copy(public(name), folder.path().join(name)).unwrap();
    }
    let case = format!(
        "[superelements.brake]\nmass = \"M.mtx\"\ndamping = \"C.mtx\"\nstiffness = \"{stiffness}\"\n[cea]\nmodes = 100\n"
    );
    fs::write(folder.path().join("block.toml"), case).unwrap();
}

#[test]
fn cea_of_a_superelement_lists_the_oscillating_modes_of_its_matrices() {
    let folder = folder();
    brake(&folder, "K.mtx");
    let found = column(&run(&folder, "cea", &[]).done().rows("eigenvalues.csv"), "frequency_hz");
    let found: Vec<c64> = found.iter().map(|hz| c64::new(0.0, TAU * hz)).collect();
    let exact = published().into_iter().filter(|own| own.im > 0.0);
    let exact: Vec<c64> = exact.map(|own| c64::new(0.0, own.im)).collect();
    assert_eq!(found.len(), exact.len());
    // Some decay a hundred times faster than they oscillate: digits of the frequency are those of the whole over that.
    below(largest_error(&found, &exact), 1e-9, "a superelement");
}

#[test]
fn superelements_are_checked_as_cea_solves_them_and_what_they_cannot_is_refused_with_the_reason() {
    let folder = folder();
    let case = folder.path().join("block.toml");
    let examine = || frictionsim::app::check::examine(&case, &[]);
    brake(&folder, "K.mtx");
    let found = examine().unwrap();
    assert_eq!((&found["valid"], &found["dofs"]), (&true.into(), &100.into()), "{found}");
    for command in ["matrices", "mesh", "frf", "transient", "sweep"] {
        let words = ["superelements have eigenvalues alone ; block.toml:1:2 ; !missing section"];
        run(&folder, command, &[]).refused(&words);
    }
    let beside = run(&folder, "cea", &["mesh.file=disc.msh"]);
    beside.refused(&["superelements are solved free-standing ; beside a body"]);
    brake(&folder, "nowhere.mtx");
    has(&examine().unwrap_err().messages().concat(), &["superelements.brake.stiffness: "]);
    run(&folder, "cea", &[]).end().warns(&["superelements.brake.stiffness: nowhere.mtx"]);
    for (matrix, words) in [
        ("2 2 1\n1 1 1.0\n", "superelements.brake.stiffness is 2 x 2"),
        ("100 100 1\n1 1 inf\n", "line 3: inf is not finite"),
        ("100 100 1\n101 1 1.0\n", "lies outside a matrix of 100 x 100"),
    ] {
        brake(&folder, "other.mtx");
        let text = format!("%%MatrixMarket matrix coordinate real general\n{matrix}");
        fs::write(folder.path().join("other.mtx"), text).unwrap();
        run(&folder, "cea", &[]).refused(&[words]);
    }
}
