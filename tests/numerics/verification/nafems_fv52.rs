//! A thick square plate whose lower edges are held across. Independent check: the target values of a published benchmark.
//!
//! Source: NAFEMS, Selected Benchmarks for Natural Frequency Analysis (1987), test FV52, "simply supported solid square plate":
//! 10 x 10 x 1 m, E = 2e11 Pa, nu = 0.3, rho = 8000 kg/m3, no motion along z on the four edges of the lower face. Three rigid
//! motions are left, then 45.897, 109.44 (twice), 167.89, 193.59, 206.19 (twice) Hz.
//!
//! The four lowest bend the plate. Their targets are those of a plate held along its middle surface; held along its lower edges, a
//! solid one is up to 2.4 % off on the mesh of the benchmark (4 x 4 x 1 bricks of 20 nodes), and softens further on finer ones,
//! because a line carries no load in three dimensions. The others move in the plane and come within 4e-4.

use super::*;

/// The targets above the rigid motions, Hz.
const TARGETS: [f64; 7] = [45.897, 109.44, 109.44, 167.89, 193.59, 206.19, 206.19];

/// The plate of `n` x `n` x 1 bricks of 20 nodes, as an input file.
fn plate(n: usize) -> String {
    let file = block(Hex20, [n, n, 1], |[x, y, z]| [10.0 * x, 10.0 * y, z]);
    let is_held = |[x, y, z]: &Place| *z == 0.0 && [x, y].iter().any(|k| [0.0, 10.0].contains(*k));
    let edges = file.labels.iter().zip(&file.points).filter(|(_, place)| is_held(place));
    let edges: String = edges.map(|(number, _)| format!("{number},\n")).collect();
    let mesh = abaqus_of(&file, "C3D20, ELSET=plate");
    format!(
        "{mesh}*NSET, NSET=edges\n{edges}*MATERIAL, NAME=steel\n*ELASTIC\n2e11, 0.3\n*DENSITY\n8000.\n\
         *SOLID SECTION, ELSET=plate, MATERIAL=steel\n*BOUNDARY\nedges, 3, 3\n"
    )
}

/// Frequencies of a mesh above its rigid motions, Hz.
fn frequencies(n: usize) -> Vec<f64> {
    let folder = folder(&format!("nafems_fv52_{n}"), &[]);
    fs::write(folder.join("plate.inp"), plate(n)).unwrap();
    let case = "[mesh]\nfile = \"plate.inp\"\n[cea]\nmodes = 10\nfriction_coefficients = [0.0]\n";
    column(&table(&folder, "cea", case, "", "eigenvalues.csv"), "frequency_hz")
}

#[test]
fn the_frequencies_of_a_thick_plate_are_the_targets_of_the_benchmark() {
    let [coarse, fine] = [4, 8].map(frequencies);
    near_each(&coarse[..4], &TARGETS[..4], 0.025);
    near_each(&coarse[4..7], &TARGETS[4..], 2.5e-3);
    // Bending modes of the finer mesh come between those in the plane.
    for target in [TARGETS[4], TARGETS[5]] {
        let near = fine.iter().filter(|f| (*f / target - 1.0).abs() < 4e-4).count();
        assert_eq!(near, if target == TARGETS[4] { 1 } else { 2 }, "{target}");
    }
}
