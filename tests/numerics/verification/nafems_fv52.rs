//! A thick square plate whose lower edges are held across. Independent check: the target values of a published benchmark.
//!
//! Source: NAFEMS, Selected Benchmarks for Natural Frequency Analysis (1987), test FV52, "simply supported solid square plate":
//! 10 x 10 x 1 m, E = 2e11 Pa, nu = 0.3, rho = 8000 kg/m3, no motion along z on the four edges of the lower face. Three rigid
//! motions are left, then 45.897, 109.44 (twice), 167.89, 193.59, 206.19 (twice) Hz.
//!
//! The four lowest bend the plate. Their targets are those of a plate held along its middle surface; held along its lower edges, a
//! solid one is up to 2.4 % off on the mesh of the benchmark (4 x 4 x 1 bricks of 20 nodes), and softens further on finer ones,
//! because a line carries no load in three dimensions. The others move in the plane and come within 4e-4.

use super::{folder, table};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The targets above the rigid motions, Hz.
const TARGETS: [f64; 7] = [45.897, 109.44, 109.44, 167.89, 193.59, 206.19, 206.19];

/// The plate of `n` x `n` x 1 bricks of 20 nodes, as an input file.
fn plate(n: usize) -> String {
    let size = [2 * n, 2 * n, 2];
    let mut nodes = String::new();
    let mut number = BTreeMap::new();
    let mut edges = Vec::new();
    for k in 0..=size[2] {
        for j in 0..=size[1] {
            for i in 0..=size[0] {
                // Corners and middles of edges.
                if [i, j, k].iter().filter(|index| **index % 2 == 1).count() > 1 {
                    continue;
                }
                let own = number.len() + 1;
                number.insert([i, j, k], own);
                let at = |index: usize, axis: usize, length: f64| {
                    length * index as f64 / size[axis] as f64
                };
                let [x, y, z] = [at(i, 0, 10.0), at(j, 1, 10.0), at(k, 2, 1.0)];
                writeln!(nodes, "{own}, {x:?}, {y:?}, {z:?}").unwrap();
                if k == 0 && (i % size[0] == 0 || j % size[1] == 0) {
                    edges.push(own.to_string());
                }
            }
        }
    }
    let corners = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]];
    let middles = [[1, 0, 0], [2, 1, 0], [1, 2, 0], [0, 1, 0]];
    let mut elements = String::new();
    for e in 0..n * n {
        let [x, y] = [2 * (e % n), 2 * (e / n)];
        let at = |place: &[usize; 3], z: usize| number[&[x + place[0], y + place[1], z]];
        let mut own: Vec<usize> = corners.iter().map(|corner| at(corner, 0)).collect();
        own.extend(corners.iter().map(|corner| at(corner, 2)));
        own.extend(middles.iter().map(|middle| at(middle, 0)));
        own.extend(middles.iter().map(|middle| at(middle, 2)));
        own.extend(corners.iter().map(|corner| at(corner, 1)));
        let own: Vec<String> = own.iter().map(usize::to_string).collect();
        writeln!(elements, "{}, {}", e + 1, own.join(", ")).unwrap();
    }
    let edges: Vec<String> = edges.chunks(8).map(|some| some.join(", ")).collect();
    format!(
        "*NODE\n{nodes}*ELEMENT, TYPE=C3D20, ELSET=plate\n{elements}*NSET, NSET=edges\n{}\n\
         *MATERIAL, NAME=steel\n*ELASTIC\n2e11, 0.3\n*DENSITY\n8000.\n\
         *SOLID SECTION, ELSET=plate, MATERIAL=steel\n*BOUNDARY\nedges, 3, 3\n",
        edges.join("\n")
    )
}

/// Frequencies of a mesh above its rigid motions, Hz.
fn frequencies(n: usize) -> Vec<f64> {
    let folder = folder(&format!("nafems_fv52_{n}"), &[]);
    std::fs::write(folder.join("plate.inp"), plate(n)).unwrap();
    let case = "[mesh]\nfile = \"plate.inp\"\n[cea]\nmodes = 10\nfriction_coefficients = [0.0]\n";
    let modes = table(&folder, "cea", case, "eigenvalues.csv");
    modes.iter().map(|mode| mode["frequency_hz"]).collect()
}

#[test]
fn the_frequencies_of_a_thick_plate_are_the_targets_of_the_benchmark() {
    let [coarse, fine] = [4, 8].map(frequencies);
    println!("{coarse:?}\n{fine:?}");
    for (k, (found, target)) in coarse.iter().zip(TARGETS).enumerate() {
        let bound = if k < 4 { 0.025 } else { 2.5e-3 };
        assert!((found / target - 1.0).abs() < bound, "{found} {target}");
    }
    // Bending modes of the finer mesh come between those in the plane.
    for target in [TARGETS[4], TARGETS[5]] {
        let near = fine.iter().filter(|f| (*f / target - 1.0).abs() < 4e-4).count();
        assert_eq!(near, if target == TARGETS[4] { 1 } else { 2 }, "{target}");
    }
}
