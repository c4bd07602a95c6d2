//! The built-in disc and its shaft with moduli over frequency, by case.

use crate::prelude::*;

/// A lining whose modulus and losses rise over the modes of a disc.
const LINING: &[u8] = include_bytes!("../cases/lining.csv");

fn disc_of(material: &str, sections: &str, set: &[&str]) -> Case {
    let flat = b"frequency_hz,young_modulus,loss_factor\n0,3e9,0.1\n50000,3e9,0.1\n";
    let folder = folder_with(&[("lining.csv", LINING), ("flat.csv", flat)]);
    let material = format!("[material]\n{material}\npoisson_ratio = 0.3805\ndensity = 1228.0\n");
    let text = [include_str!("../cases/tabled-disc.toml"), sections, &material].concat();
    case_of(folder.path().join("disc.toml"), &text, set)
}

const GRID: &str = "[mesh]\ncircumferential_elements = 24\nradial_elements = 4\n";

/// Independent: the generated disc with constants that are those of its table at the frequency of an onset turns unstable at the
/// same friction there; with those of the lowest frequency it does not.
#[test]
fn an_onset_has_the_modulus_of_its_own_frequency() {
    let case = disc_of("table = \"lining.csv\"", GRID, &[]);
    let table = case.materials().table(0).unwrap();
    // The table lies beside the results, which are drawn again without it in its place.
    assert_eq!(case.raw.kept_tables()[0].1.bytes[..], *LINING);
    let found = modes_and_onsets(&case).unwrap().intervals;
    let crossed: Vec<_> = found.iter().filter(|own| !own.unstable_from_start).collect();
    assert!(!crossed.is_empty(), "{found:?}");
    for onset in crossed.iter().take(2) {
        let nearest = |[modulus, loss_factor]: [f64; 2]| {
            let material = format!("young_modulus = {modulus:?}\nloss_factor = {loss_factor:?}");
            let frozen = modes_and_onsets(&disc_of(&material, GRID, &[])).unwrap().intervals;
            let distance = |own: &f64| (own - onset.critical_friction).abs();
            distance(&nearest_by(criticals(&frozen), distance))
        };
        let [own, lowest] = [onset.frequency_hz, 100.0].map(|f| nearest(table.at(f)));
        assert!(own < 1e-7 && lowest > 1e-4, "{onset:?} {own:e} {lowest:e}");
    }
}

/// Theory: a shaft whose table has one modulus and one loss factor is one of that material.
#[test]
fn a_flat_table_of_a_shaft_is_its_material() {
    let modes = |own: &str| -> Vec<c64> {
        let grid = GRID.replace("radial", "shaft_radial_elements = 2\nradial");
        let sections = format!(
            "shaft_inner_radius = 0.006\n{grid}[materials.shaft]\n{own}\npoisson_ratio = 0.3\ndensity = 1200.0\n"
        );
        let case = disc_of("young_modulus = 2.5e9", &sections, &[]);
        let points = modes_and_onsets(&case).unwrap().points;
        points.iter().flat_map(|point| point.modes.iter().map(|mode| mode.eigenvalue)).collect()
    };
    let constant = modes("young_modulus = 3e9\nloss_factor = 0.1");
    let tabled = modes("table = \"flat.csv\"");
    near_each(&tabled, &constant, 1e-8);
}

/// Independent: losses of disc, shaft, contact and support, and a modulus over frequency, by harmonics and on the whole mesh.
#[test]
fn losses_of_an_annulus_by_harmonics_are_those_of_its_whole_mesh() {
    let lossy = "young_modulus = 2.5e9\nloss_factor = 0.02";
    let shaft = GRID.replace("radial", "shaft_radial_elements = 2\nradial");
    let shaft = format!(
        "shaft_inner_radius = 0.006\n{shaft}[materials.shaft]\nyoung_modulus = 7e10\n\
         loss_factor = 0.05\npoisson_ratio = 0.3\ndensity = 2700.0\n"
    );
    let support = "[boundaries.outer]\ncondition = \"support\"\nnormal_stiffness = 1e12\n\
         tangential_stiffness = 1e12\nloss_factor = 0.1\n";
    let springs = ["contact.normal_stiffness=1e13", "contact.loss_factor=0.1"];
    for (name, material, sections, sets) in [
        ("disc", lossy, GRID.to_owned(), &[][..]),
        ("shaft", lossy, shaft, &[][..]),
        ("springs", "young_modulus = 2.5e9", format!("{GRID}{support}"), &springs[..]),
        ("table", "table = \"lining.csv\"", GRID.to_owned(), &[][..]),
    ] {
        let [waves, whole] = METHODS.map(|method| {
            let set = [sets, &["cea.geometric_stiffness=true", method]].concat();
            modes_and_onsets(&disc_of(material, &sections, &set)).unwrap()
        });
        for (a, b) in waves.points.iter().zip(&whole.points) {
            let [a, b] = [a, b].map(|point| eigenvalues_of(&point.modes));
            let error = largest_error(&a, &b).max(largest_error(&b, &a));
            assert!(a.len() == b.len() && error < 1e-9, "{name}: {error:e}");
        }
        let directions = |point: &FrictionPoint| point.modes.iter().any(|own| own.direction == 1);
        assert!(waves.points.iter().skip(1).all(directions), "{name}");
        let onsets = [&waves, &whole]
            .map(|found| criticals(found.intervals.iter().filter(|own| !own.unstable_from_start)));
        within(&onsets[0], &onsets[1], 1e-7);
    }
}
