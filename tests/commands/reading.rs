//! `contributions.csv` and `coupling.csv` of `cea`: where growth comes from, which modes couple.

use crate::bricks::{Block, file_of};
use crate::coarse_disc::coarse_disc;
use assert_cmd::Command;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use std::path::Path;

/// Two pads on a slab that turns, the slab and one pad with damping of their own.
const CASE: &str = "title = \"Two pads\"
[mesh]\nfile = \"pads.msh\"
[material]\nyoung_modulus = 2.5e9\npoisson_ratio = 0.38\ndensity = 1228.0
[materials.slab]\nyoung_modulus = 7e9\npoisson_ratio = 0.3\ndensity = 2000.0\nmass_coefficient = 10.0\nstiffness_coefficient = 1e-7
[materials.left]\nyoung_modulus = 2e9\npoisson_ratio = 0.3\ndensity = 1200.0\nmass_coefficient = 5.0\nstiffness_coefficient = 2e-7
[damping]\nmass_coefficient = 40.0\nstiffness_coefficient = 4.5e-7\ninclude_contact = false
[boundaries.slab_z0]\ncondition = \"support\"\nnormal_stiffness = 1e13\ntangential_stiffness = 1e13\nnormal_damping = 1e4
[boundaries.left_z1]\ncondition = \"clamped\"
[boundaries.right_z1]\ncondition = \"clamped\"
[motion.slab]\naxis = [0.0, 0.0, 1.0]\ncenter = [0.5, 0.1, 0.0]\nrotation_speed_rpm = 100.0
[contacts.first]\nsurface = \"left_z0\"\ncounter = \"slab_z1\"\nfriction_coefficient = 0.6\nnormal_stiffness = 1e13\nstate = \"closed\"
[contacts.second]\nsurface = \"right_z0\"\ncounter = \"slab_z1\"\nfriction_coefficient = 0.6\nnormal_stiffness = 1e13\nstate = \"closed\"
[cea]\nfriction_coefficients = [0.0, 0.3, 0.6]\nmodes = 12\n";

fn pads() -> Vec<u8> {
    let block = |name, origin, size, counts| Block {
        name,
        origin,
        size,
        counts,
    };
    let blocks = [
        block("slab", [0.0; 3], [0.06, 0.03, 0.01], [6, 3, 1]),
        block(
            "left",
            [0.005, 0.005, 0.01],
            [0.015, 0.02, 0.012],
            [3, 3, 2],
        ),
        block("right", [0.035, 0.005, 0.01], [0.02, 0.02, 0.01], [3, 3, 2]),
    ];
    file_of(&blocks, |point| point)
}

/// The rows of a table by column.
fn table(path: &Path) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let rows = reader.deserialize();
    rows.map(|row| row.unwrap()).collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or(f64::NAN)
}

fn cea(folder: &Path, case: &Path, set: &[&str]) -> String {
    let mut command = Command::cargo_bin("frictionsim").unwrap();
    command
        .arg("cea")
        .arg(case)
        .args(["--out"])
        .arg(folder.join("out"));
    command.args(["--force", "--no-figures"]);
    for text in set {
        command.args(["--set", text]);
    }
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Exact identities: what parts, supports and two contacts add is the growth rate; without friction the contacts add nothing,
/// and each region takes `(alpha T + beta U) / 2` of its shares `T`, `U` of the energies.
#[test]
fn what_parts_supports_and_contacts_add_is_the_growth_rate() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("pads.msh"), pads()).unwrap();
    let case = folder.path().join("case.toml");
    std::fs::write(&case, CASE).unwrap();
    let said = cea(folder.path(), &case, &[]);
    let out = folder.path().join("out");
    let rows = table(&out.join("contributions.csv"));
    let coefficients = BTreeMap::from([
        ("slab", [10.0, 1e-7]),
        ("left", [5.0, 2e-7]),
        ("right", [40.0, 4.5e-7]),
    ]);
    let mut is_fed = false;
    for mode in table(&out.join("eigenvalues.csv")) {
        let is_own = |row: &&BTreeMap<String, String>| {
            row["mode"] == mode["mode"]
                && row["friction_coefficient"] == mode["friction_coefficient"]
        };
        let own: Vec<_> = rows.iter().filter(is_own).collect();
        assert_eq!(own.len(), 6, "three parts, a support, two contacts");
        let (growth, omega) = (
            number(&mode, "growth_rate_per_s"),
            TAU * number(&mode, "frequency_hz"),
        );
        let sum: f64 = own.iter().map(|row| number(row, "growth_rate_per_s")).sum();
        // Contacts are found from their forces, which a residual of 1e-12 of the eigenproblem carries.
        assert!((sum - growth).abs() < 1e-8 * omega, "{sum} {growth}");
        for share in ["kinetic_share", "strain_share"] {
            let shares = own
                .iter()
                .map(|row| number(row, share))
                .filter(|share| share.is_finite());
            assert!((shares.sum::<f64>() - 1.0).abs() < 1e-12);
        }
        let fed = own.iter().filter(|row| row["kind"] == "contact");
        let fed: Vec<f64> = fed.map(|row| number(row, "growth_rate_per_s")).collect();
        if number(&mode, "friction_coefficient") == 0.0 {
            assert!(
                fed.iter().all(|fed| fed.abs() < 1e-8 * omega),
                "{fed:?} without friction"
            );
            // `-2 g_r = alpha_r T_r + beta_r U_r`: every region tells the same strain energy of the whole.
            let parts = own.iter().filter(|row| row["kind"] == "part");
            let whole: Vec<f64> = parts
                .map(|row| {
                    let [alpha, beta] = coefficients[row["name"].as_str()];
                    let damped = -2.0 * number(row, "growth_rate_per_s");
                    let rest = damped - alpha * number(row, "kinetic_share");
                    rest / (beta * number(row, "strain_share"))
                })
                .collect();
            let same = |energy: &f64| (energy / whole[0] - 1.0).abs() < 1e-6;
            assert!(
                whole.iter().all(same) && whole[0] < omega * omega * 1.01,
                "{whole:?}"
            );
        } else {
            is_fed |= fed.iter().any(|fed| *fed > 1.0);
        }
    }
    assert!(is_fed, "friction feeds a mode");
    // The most unstable mode in words, if there is one.
    let couplings = table(&out.join("coupling.csv"));
    assert_eq!(couplings.is_empty(), !said.contains("feeds"), "{said}");
}

/// Exact identities: without friction what one support or one contact loses is the whole growth rate where nothing else is
/// damped, and the other takes nothing; with friction the sum stays the growth rate.
#[test]
fn loss_factors_of_supports_and_contacts_are_told_where_they_act() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("pads.msh"), pads()).unwrap();
    let case = folder.path().join("case.toml");
    let undamped = CASE
        .lines()
        .filter(|line| !line.contains("_coefficient = ") || line.contains("friction"))
        .map(|line| line.replace("normal_damping = 1e4", ""));
    std::fs::write(&case, undamped.collect::<Vec<_>>().join("\n")).unwrap();
    for (lossy, name) in [
        ("boundaries.slab_z0.loss_factor=0.1", "slab_z0"),
        ("contacts.first.loss_factor=0.1", "first"),
    ] {
        cea(folder.path(), &case, &[lossy]);
        let out = folder.path().join("out");
        let rows = table(&out.join("contributions.csv"));
        let mut largest = 0.0_f64;
        for mode in table(&out.join("eigenvalues.csv")) {
            let is_own = |row: &&BTreeMap<String, String>| {
                row["mode"] == mode["mode"]
                    && row["friction_coefficient"] == mode["friction_coefficient"]
            };
            let own = || rows.iter().filter(is_own);
            let growth = number(&mode, "growth_rate_per_s");
            let omega = TAU * number(&mode, "frequency_hz");
            let rate = |row: &BTreeMap<String, String>| number(row, "growth_rate_per_s");
            let sum: f64 = own().map(rate).sum();
            assert!((sum - growth).abs() < 1e-8 * omega, "{name} {sum} {growth}");
            if number(&mode, "friction_coefficient") == 0.0 {
                let taken = own().find(|row| row["name"] == name).map(rate).unwrap();
                assert!(
                    (taken - growth).abs() < 1e-8 * omega,
                    "{name} {taken} {growth}"
                );
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
    let folder = tempfile::tempdir().unwrap();
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/polycarbonate-disc.toml");
    let set = [
        "mesh.circumferential_elements=48",
        "mesh.radial_elements=8",
        "cea.friction_coefficients=[0.0, 0.15, 0.3]",
    ];
    for method in ["cyclic", "sparse"] {
        let method = format!("cea.method={method}");
        let said = cea(
            folder.path(),
            &case,
            &[&set[..], &[method.as_str()]].concat(),
        );
        assert!(
            said.contains("comes from mode") && said.contains("contact feeds"),
            "{said}"
        );
        let rows = table(&folder.path().join("out/coupling.csv"));
        let mut sums: BTreeMap<(String, String), f64> = BTreeMap::new();
        for row in &rows {
            let key = (row["friction_coefficient"].clone(), row["mode"].clone());
            *sums.entry(key).or_default() += number(row, "share");
        }
        assert!(!sums.is_empty());
        for (mode, sum) in sums {
            assert!((0.8..1.0 + 1e-6).contains(&sum), "{method} {mode:?}: {sum}");
        }
    }
}

/// Exact identities, whatever presses: the growth that the contact points feed adds up to what the contacts feed in the budget, on
/// springs and rigid, in the plane and in space, friction constant and falling.
#[test]
fn the_feed_over_the_contact_points_adds_up_to_that_of_the_contacts() {
    let folder = tempfile::tempdir().unwrap();
    let disc = folder.path().join("disc.toml");
    std::fs::write(&disc, coarse_disc("[cea]\nmodes = 10\n")).unwrap();
    let brake = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/operating-matrix.toml");
    let soft = [
        "cea.max_frequency_hz=2800",
        "cea.friction_coefficients=[0.4]",
        "materials.Outer_Lining.young_modulus=3e9",
        "materials.Inner_Lining.young_modulus=3e9",
    ];
    let compliant = ["contact.normal_stiffness=7.4e12", "cea.method=\"sparse\""];
    let falling = [
        "contact.static_friction_ratio=1.3",
        "contact.decay_speed=1.0",
    ];
    let kinds: [(&Path, &[&str]); 4] = [
        (&brake, &soft),
        (&disc, &[]),
        (&disc, &compliant),
        (&disc, &falling),
    ];
    for (path, set) in kinds {
        cea(folder.path(), path, set);
        let out = folder.path().join("out");
        let (feed, rows) = (
            table(&out.join("feed.csv")),
            table(&out.join("contributions.csv")),
        );
        let own: BTreeSet<&String> = feed.iter().map(|row| &row["mode"]).collect();
        assert!(!own.is_empty(), "{set:?}: no unstable mode");
        let friction = number(&feed[0], "friction_coefficient");
        for mode in own {
            let points = feed.iter().filter(|row| row["mode"] == **mode);
            let sum: f64 = points
                .clone()
                .map(|row| number(row, "growth_rate_per_s"))
                .sum();
            let size: f64 = points
                .map(|row| number(row, "growth_rate_per_s").abs())
                .sum();
            let is_contact = |row: &&BTreeMap<String, String>| {
                row["mode"] == **mode
                    && row["kind"] == "contact"
                    && number(row, "friction_coefficient") == friction
            };
            let contacts = rows.iter().filter(is_contact);
            let fed: f64 = contacts.map(|row| number(row, "growth_rate_per_s")).sum();
            let omega = TAU * number(rows.iter().find(is_contact).unwrap(), "frequency_hz");
            // What is left is the residual of the eigenpair, 1e-12 of the forces of inertia and less.
            assert!(
                (sum - fed).abs() < 1e-9 * (omega + size),
                "{set:?}: {sum} {fed}"
            );
        }
        assert!(out.join("feed.vtu").exists());
    }
}
