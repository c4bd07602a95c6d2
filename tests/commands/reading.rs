//! `contributions.csv` and `coupling.csv` of `cea`: where growth comes from, which modes couple.

use crate::prelude::*;

/// Two pads on a slab that turns, the slab and one pad with damping of their own.
const CASE: &str = include_str!("../cases/two-pads.toml");

fn pads() -> Vec<u8> {
    let blocks = [
        brick("slab", [0.0; 3], [0.06, 0.03, 0.01], [6, 3, 1]),
        brick("left", [0.005, 0.005, 0.01], [0.015, 0.02, 0.012], [3, 3, 2]),
        brick("right", [0.035, 0.005, 0.01], [0.02, 0.02, 0.01], [3, 3, 2]),
    ];
    file_of(&blocks, |point| point)
}

fn cea(folder: &Path, case: impl AsRef<Path>, set: &[&str]) -> Answer {
    Run::of("cea", case.as_ref()).within(folder).out("out").args(&["--force"]).set(set).done()
}

/// Every mode of the budget: whether friction acts, growth rate, circular frequency and the rows about it, whose growth rates are held
/// to add up to that of the mode, to a share of the frequency.
fn budget(answer: &Answer, tolerance: f64) -> Vec<(bool, f64, f64, Vec<Row>)> {
    let rows = answer.rows("contributions.csv");
    let of_mode = |mode: Row| {
        let names = ["mode", "friction_coefficient"];
        let is_own = |row: &&Row| names.iter().all(|name| row[*name] == mode[*name]);
        let own: Vec<Row> = rows.iter().filter(is_own).cloned().collect();
        let [growth, hz] = mode.numbers(["growth_rate_per_s", "frequency_hz"]);
        let (omega, sum) = (TAU * hz, own.iter().map(rate).sum::<f64>());
        assert!((sum - growth).abs() < tolerance * omega, "{sum} {growth}");
        (mode.number("friction_coefficient") > 0.0, growth, omega, own)
    };
    answer.rows("eigenvalues.csv").into_iter().map(of_mode).collect()
}

fn rate(row: &Row) -> f64 {
    row.number("growth_rate_per_s")
}

/// Exact identities: what parts, supports and two contacts add is the growth rate; without friction the contacts add nothing,
/// and each region takes `(alpha T + beta U) / 2` of its shares `T`, `U` of the energies.
#[test]
fn what_parts_supports_and_contacts_add_is_the_growth_rate() {
    let folder = folder_with(&[("pads.msh", &pads()), ("case.toml", CASE.as_bytes())]);
    let answer = cea(folder.path(), "case.toml", &[]);
    let coefficients =
        BTreeMap::from([("slab", [10.0, 1e-7]), ("left", [5.0, 2e-7]), ("right", [40.0, 4.5e-7])]);
    let mut is_fed = false;
    // Contacts are found from their forces, which a residual of 1e-12 of the eigenproblem carries.
    for (has_friction, _, omega, own) in budget(&answer, 1e-8) {
        assert_eq!(own.len(), 6, "three parts, a support, two contacts");
        for share in ["kinetic_share", "strain_share"] {
            let shares = own.iter().map(|row| row.number(share)).filter(|share| share.is_finite());
            assert!((shares.sum::<f64>() - 1.0).abs() < 1e-12);
        }
        let fed: Vec<f64> = own.iter().filter(|row| row["kind"] == "contact").map(rate).collect();
        if !has_friction {
            assert!(fed.iter().all(|fed| fed.abs() < 1e-8 * omega), "{fed:?} without friction");
            // `-2 g_r = alpha_r T_r + beta_r U_r`: every region tells the same strain energy of the whole.
            let energy = |row: &Row| {
                let [alpha, beta] = coefficients[row["name"].as_str()];
                let rest = -2.0 * rate(row) - alpha * row.number("kinetic_share");
                rest / (beta * row.number("strain_share"))
            };
            let parts = own.iter().filter(|row| row["kind"] == "part");
            let whole: Vec<f64> = parts.map(energy).collect();
            let same = |energy: &f64| (energy / whole[0] - 1.0).abs() < 1e-6;
            assert!(whole.iter().all(same) && whole[0] < omega * omega * 1.01, "{whole:?}");
        } else {
            is_fed |= fed.iter().any(|fed| *fed > 1.0);
        }
    }
    assert!(is_fed, "friction feeds a mode");
    // The most unstable mode in words, if there is one.
    let feeds = answer.stdout.contains("feeds");
    assert_eq!(answer.rows("coupling.csv").is_empty(), !feeds, "{}", answer.stdout);
    // Contacts of one friction need no word; of two, those that are varied are told.
    let told = "friction coefficients are those of contacts.first; times as much have: contacts.second 0.5";
    assert!(!answer.stdout.contains("times as much"));
    let set = ["contacts.second.friction_coefficient=0.3", "cea.friction_coefficients=[0.6]"];
    has(&cea(folder.path(), "case.toml", &set).stdout, &[told]);
}

/// Exact identities: without friction what one support or one contact loses is the whole growth rate where nothing else is
/// damped, and the other takes nothing; with friction the sum stays the growth rate.
#[test]
fn loss_factors_of_supports_and_contacts_are_told_where_they_act() {
    let undamped = CASE
        .lines()
        .filter(|line| !line.contains("_coefficient = ") || line.contains("friction"))
        .map(|line| line.replace("normal_damping = 1e4", ""));
    let case = undamped.collect::<Vec<_>>().join("\n");
    let folder = folder_with(&[("pads.msh", &pads()), ("case.toml", case.as_bytes())]);
    for [group, name] in [["boundaries", "slab_z0"], ["contacts", "first"]] {
        let answer = cea(folder.path(), "case.toml", &[&format!("{group}.{name}.loss_factor=0.1")]);
        let mut largest = 0.0_f64;
        for (has_friction, growth, omega, own) in budget(&answer, 1e-8) {
            if !has_friction {
                let taken = own.iter().find(|row| row["name"] == name).map(rate).unwrap();
                assert!((taken - growth).abs() < 1e-8 * omega, "{name} {taken} {growth}");
                assert!(growth <= 0.0);
                largest = largest.max(-growth / omega);
            }
        }
        // At most eta / 2 of the frequency, of a mode whose strain is all in the springs.
        assert!(largest > 1e-5 && largest < 0.05, "{name} {largest}");
    }
}

/// Bessel's inequality: modes without friction are orthogonal by mass, so that shares never sum to more than one.
#[test]
fn an_unstable_mode_consists_of_the_modes_without_friction() {
    let folder = folder();
    let case = shipped("polycarbonate-disc.toml");
    let set = ["mesh.circumferential_elements=48 ; mesh.radial_elements=8 ; \
         cea.friction_coefficients=[0.0, 0.15, 0.3]"];
    for method in METHODS {
        let answer = cea(folder.path(), &case, &[&set[..], &[method]].concat());
        let mut sums: BTreeMap<(String, String), f64> = BTreeMap::new();
        for row in answer.says(&["comes from mode", "contact feeds"]).rows("coupling.csv") {
            let key = (row["friction_coefficient"].clone(), row["mode"].clone());
            *sums.entry(key).or_default() += row.number("share");
        }
        assert!(!sums.is_empty());
        for (mode, sum) in sums {
            assert!((0.8..1.0 + 1e-6).contains(&sum), "{method} {mode:?}: {sum}");
        }
    }
}

/// Exact identities, whatever presses: the growth that the contact points feed adds up to what the contacts feed in the budget, on
/// springs with losses and rigid, in the plane and in space, friction constant and falling.
#[test]
fn the_feed_over_the_contact_points_adds_up_to_that_of_the_contacts() {
    let folder = folder_with(&[("disc.toml", coarse_disc("[cea]\nmodes = 10\n").as_bytes())]);
    let brake = &shipped("operating-matrix.toml");
    let soft = ["cea.max_frequency_hz=2800 ; cea.friction_coefficients=[0.4] ; \
         materials.Outer_Lining.young_modulus=3e9 ; materials.Inner_Lining.young_modulus=3e9"];
    let compliant =
        ["contact.normal_stiffness=7.4e12 ; contact.loss_factor=0.02", "cea.method=\"sparse\""];
    let falling = ["contact.static_friction_ratio=1.3", "contact.decay_speed=1.0"];
    let disc = "disc.toml";
    // Contact that opens: each state is a polynomial of its own in friction.
    let tread = &shipped("tread-block.toml");
    let few = "cea.friction_coefficients=[0.3, 0.6] ; cea.modes=4";
    let kinds: [(&str, &[&str]); 6] = [
        (brake, &[soft[0], "cea.geometric_stiffness=true"]),
        (tread, &[few]),
        (tread, &[few, "cea.geometric_stiffness=true"]),
        (disc, &[]),
        (disc, &compliant),
        (disc, &falling),
    ];
    for (path, set) in kinds {
        let answer = cea(folder.path(), path, set);
        let (feed, rows) = (answer.rows("feed.csv"), answer.rows("contributions.csv"));
        let own: BTreeSet<&String> = feed.iter().map(|row| &row["mode"]).collect();
        assert!(!own.is_empty(), "{set:?}: no unstable mode");
        let friction = feed[0].number("friction_coefficient");
        for mode in own {
            let points = feed.iter().filter(|row| row["mode"] == **mode).map(rate);
            let sum: f64 = points.clone().sum();
            let size: f64 = points.map(f64::abs).sum();
            let is_contact = |row: &&Row| {
                row["mode"] == **mode
                    && row["kind"] == "contact"
                    && row.number("friction_coefficient") == friction
            };
            let fed: f64 = rows.iter().filter(is_contact).map(rate).sum();
            let omega = TAU * rows.iter().find(is_contact).unwrap().number("frequency_hz");
            // What is left is the residual of the eigenpair, 1e-12 of the forces of inertia and less.
            assert!((sum - fed).abs() < 1e-9 * (omega + size), "{set:?}: {sum} {fed}");
        }
        assert!(answer.path("feed.vtu").exists());
    }
}

/// Rows of a table by friction value, mode and what they are about.
fn rows_by(rows: Vec<Row>, names: &[&str]) -> BTreeMap<Vec<String>, Row> {
    let rows = rows.into_iter();
    rows.map(|row| (names.iter().map(|name| row[*name].clone()).collect(), row)).collect()
}

/// Independent check: the matrices of one sector tell the same budget as those of the whole mesh, row by row at every friction value:
/// a disc with a rim on springs and dashpots, rigid contact or springs with dashpots, prestress, friction that falls. Eigenpairs of
/// two solvers agree to 1e-10 of the frequency, and with them growth rates.
#[test]
fn sectors_tell_the_same_budget_as_the_whole_mesh() {
    let text = coarse_disc("[cea]\nmodes = 8\nfriction_coefficients = [0.0, 0.2, 0.3]\n");
    let folder = folder_with(&[("disc.toml", text.as_bytes())]);
    let rim =
        ["boundaries.outer.condition=\"support\" ; boundaries.outer.normal_stiffness=2e12 ; \
         boundaries.outer.tangential_stiffness=1e12 ; boundaries.outer.normal_damping=3e5 ; \
         boundaries.outer.tangential_damping=1e5"];
    let springs = ["contact.normal_stiffness=7.4e12 ; contact.tangential_damping=2e4 ; \
         contact.normal_damping=1e4 ; mesh.element=\"quad8\""];
    let falling = ["contact.static_friction_ratio=1.3 ; contact.decay_speed=1.0 ; \
         damping.include_contact=false"];
    let shaft = ["geometry.shaft_inner_radius=0.005 ; mesh.shaft_radial_elements=3 ; \
         materials.shaft.young_modulus=7e10 ; materials.shaft.poisson_ratio=0.3 ; \
         materials.shaft.density=2700.0 ; materials.shaft.mass_coefficient=5.0 ; \
         materials.shaft.stiffness_coefficient=1e-8"];
    let kinds: [Vec<&str>; 4] =
        [rim.to_vec(), [&rim[..], &springs].concat(), falling.to_vec(), shaft.to_vec()];
    for set in kinds {
        let mut found = Vec::new();
        for method in METHODS {
            let answer = cea(folder.path(), "disc.toml", &[&set[..], &[method]].concat());
            let names = ["friction_coefficient", "mode", "name"];
            let budget = rows_by(answer.rows("contributions.csv"), &names);
            let names = ["friction_coefficient", "mode", "reference_mode"];
            let shares = rows_by(answer.rows("coupling.csv"), &names);
            let mut sums: BTreeMap<Vec<String>, f64> = BTreeMap::new();
            for (key, row) in &shares {
                *sums.entry(key[..2].to_vec()).or_default() += row.number("share");
            }
            // Place by place: contact, x, y.
            found.push((budget, sums, answer.rows("feed.csv")));
        }
        let ((budget, sums, feed), (whole, whole_sums, whole_feed)) = (&found[0], &found[1]);
        assert_eq!(budget.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>());
        for (key, row) in budget {
            let omega = TAU * row.number("frequency_hz");
            let names = ["growth_rate_per_s", "kinetic_share", "strain_share"];
            for (column, scale) in names.into_iter().zip([1e-9 * omega, 1e-7, 1e-7]) {
                let [own, other] = [row.number(column), whole[key].number(column)];
                let is_same = (own - other).abs() <= scale || own.is_nan() && other.is_nan();
                assert!(is_same, "{set:?} {key:?} {column}: {own} {other}");
            }
        }
        // A pair of modes without friction is known up to a rotation: its shares as a sum.
        assert!(!sums.is_empty());
        for (key, sum) in sums {
            assert!((sum - whole_sums[key]).abs() < 1e-6, "{set:?} {key:?}");
        }
        assert!(!feed.is_empty() && feed.len() == whole_feed.len());
        let size = feed.iter().map(|row| rate(row).abs()).fold(0.0, f64::max);
        for (own, other) in feed.iter().zip(whole_feed) {
            assert_eq!((&own["x_m"], &own["mode"]), (&other["x_m"], &other["mode"]));
            let [a, b] = [own, other].map(rate);
            assert!((a - b).abs() < 1e-6 * size, "{set:?}: {a} {b}");
        }
    }
}

/// Independent check: a body of revolution whose ends are guided is in plane strain. Its modes without axial motion have the budget
/// of the plane disc, and are fed evenly over the height of the contact.
#[test]
fn a_guided_body_of_revolution_has_the_budget_of_the_plane_disc() {
    let text = coarse_disc("[cea]\nmodes = 12\nfriction_coefficients = [0.0, 0.15, 0.3]\n");
    let folder = folder_with(&[("disc.toml", text.as_bytes())]);
    let plane = ["mesh.element=\"quad8\"", "cea.method=\"cyclic\""];
    let solid = ["mesh.element=\"quad8\" ; mesh.axial_elements=1 ; \
         material.formulation=\"three-dimensional\" ; boundaries.top.condition=\"guide\" ; \
         boundaries.bottom.condition=\"guide\" ; cea.modes=40"];
    let answer = cea(folder.path(), "disc.toml", &plane);
    let (budget, feed) = (answer.rows("contributions.csv"), answer.rows("feed.csv"));
    let answer = cea(folder.path(), "disc.toml", &solid);
    let solids = answer.rows("contributions.csv");
    for row in &budget {
        let frequency = row.number("frequency_hz");
        let same = |other: &&Row| {
            ["friction_coefficient", "name", "harmonic", "direction"]
                .iter()
                .all(|name| row[*name] == other[*name])
                && (other.number("frequency_hz") / frequency - 1.0).abs() < 1e-4
        };
        let other = solids.iter().find(same);
        let other = other.unwrap_or_else(|| panic!("no solid mode like {row:?}"));
        let [own, other] = [row, other].map(rate);
        // Bricks of 20 nodes are integrated in another way than the plane's elements.
        let close = 1e-3 * own.abs() + 1e-6 * TAU * frequency;
        assert!((own - other).abs() < close, "{row:?}: {own} {other}");
    }
    let rings = answer.rows("feed.csv");
    let mut is_found = false;
    for mode in rings.iter().map(|row| &row["mode"]).collect::<BTreeSet<&String>>() {
        let own = rings.iter().filter(|row| row["mode"] == *mode);
        let columns = ["frequency_hz", "growth_rate_per_s", "growth_rate_per_s_m2"];
        let own: Vec<[f64; 3]> = own.map(|row| row.numbers(columns)).collect();
        let is_it = |row: &&Row| (row.number("frequency_hz") / own[0][0] - 1.0).abs() < 1e-4;
        let flat: f64 = feed.iter().filter(is_it).map(rate).sum();
        if flat == 0.0 {
            continue;
        }
        is_found = true;
        let sum: f64 = own.iter().map(|row| row[1]).sum();
        assert!((sum / flat - 1.0).abs() < 1e-3, "mode {mode}: {sum} {flat}");
        // Both ends alike; the middle differs by what a quadratic face makes of a wave along it.
        let off = |row: &[f64; 3]| (row[2] / own[0][2] - 1.0).abs();
        assert!(off(&own[own.len() - 1]) < 1e-6, "mode {mode}: {own:?}");
        assert!(own.iter().all(|row| off(row) < 0.05), "mode {mode}: {own:?}");
    }
    assert!(is_found, "no unstable mode without axial motion");
}

/// Two pads on a ring that turns fast, with the inertia of its rotation, everything damped by its mass.
const ROTOR: &str = include_str!("../cases/two-pads-on-a-rotor.toml");

/// Exact identities: gyroscopic forces have a row of their own, without which the contacts would have to feed what they add to motions
/// that decay; without friction they feed nothing, and with friction all rows add up to the growth rate.
#[test]
fn gyroscopic_forces_have_their_own_row_in_the_budget() {
    let blocks = [
        brick("ring", [0.06, 0.0, 0.0], [0.06, TAU, 0.01], [2, 24, 1]),
        brick("first", [0.08, 0.3, 0.01], [0.03, 0.8, 0.01], [2, 3, 1]),
        brick("second", [0.08, 3.5, 0.01], [0.03, 0.8, 0.01], [2, 3, 1]),
    ];
    let file = file_of(&blocks, polar);
    let folder = folder_with(&[("rotor.msh", &file), ("case.toml", ROTOR.as_bytes())]);
    let mut largest = 0.0_f64;
    for (has_friction, growth, omega, own) in budget(&cea(folder.path(), "case.toml", &[]), 1e-9) {
        let of_kind = |kind: &'static str| own.iter().filter(move |row| row["kind"] == kind);
        let turned = of_kind("rotation").map(rate).next().unwrap();
        largest = largest.max(turned.abs() / growth.abs());
        let mut fed = of_kind("contact").map(rate);
        assert!(has_friction || fed.all(|rate| rate.abs() < 1e-8 * omega), "{own:?}");
    }
    assert!(largest > 1e-3, "rotation matters: {largest}");
}

/// Friction that falls with speed feeds both waves of a pair: the one gains far more than the other loses, and the page said that it
/// gains what the other loses. Constant friction couples them.
#[test]
fn friction_couples_a_pair_where_one_wave_loses_what_the_other_gains() {
    let sections = "[cea]\nfriction_coefficients = [0.0, 0.1, 0.2, 0.3]\nmodes = 12\n";
    let case = disc_of([36, 6], sections);
    let page = |law: &str| {
        let run = Run::new(&["cea", "case.toml"]).beside(&[("case.toml", &case)]).out("out");
        run.set(&[law]).done().text("report.html")
    };
    let couples = "friction couples the two waves of the pair";
    has(&page("contact.friction_coefficient=0.3"), &[couples]);
    let falling = "contact.static_friction_ratio=3.0 ; contact.decay_speed=0.5 ; contact.rotation_speed_rpm=100.0";
    has(&page(falling), &["!friction couples"]);
}

/// Where contact opens growth may jump across zero: that friction depends on the contact alone, and growth has no slope there. The
/// derivative told was that of a smooth crossing.
#[test]
fn a_critical_friction_at_which_growth_jumps_has_no_derivative() {
    let mesh = include_bytes!("../cases/skewed-block.msh");
    let case = include_bytes!("../cases/skewed-block.toml");
    let folder = folder_with(&[("skewed-block.msh", &mesh[..]), ("case.toml", &case[..])]);
    let set = "boundaries.top.normal_stiffness=3.7e11 ; boundaries.top.tangential_stiffness=6.1e11 ; \
        material.poisson_ratio=0.38 ; damping.stiffness_coefficient=7.5e-8 ; cea.modes=8 ; \
        cea.friction_coefficients=[0.0, 0.3, 0.6, 0.9] ; cea.sensitivities=true";
    let answer = cea(folder.path(), "case.toml", &[set]);
    let said = ["at friction 0.495801, 0.794148 the growth of a mode jumps", "another, jumps, or"];
    let answer = answer.says(&said);
    let critical = |row: &Row| row.number("critical_friction");
    assert!(answer.rows("stability.csv").iter().any(|row| (critical(row) - 0.495801).abs() < 1e-6));
    let onsets: Vec<f64> = answer.rows("sensitivities.csv").iter().map(critical).collect();
    assert!(onsets.iter().all(|own| own.is_nan() || (own - 0.495801).abs() > 1e-6), "{onsets:?}");
}
