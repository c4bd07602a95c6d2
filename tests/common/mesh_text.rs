//! Mesh files in MSH 2.2 of points and elements that a test makes.

use std::fmt::Write;

/// Type of an element in the file, its group and its nodes, both from 0.
pub type Listed = (u32, usize, Vec<usize>);

/// Groups are given by dimension and name.
pub fn mesh_text(points: &[[f64; 3]], groups: &[(u32, &str)], elements: &[Listed]) -> Vec<u8> {
    let mut text =
        format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", groups.len());
    for (group, (dimension, name)) in groups.iter().enumerate() {
        writeln!(text, "{dimension} {} \"{name}\"", group + 1).unwrap();
    }
    writeln!(text, "$EndPhysicalNames\n$Nodes\n{}", points.len()).unwrap();
    for (node, [x, y, z]) in points.iter().enumerate() {
        writeln!(text, "{} {x:?} {y:?} {z:?}", node + 1).unwrap();
    }
    writeln!(text, "$EndNodes\n$Elements\n{}", elements.len()).unwrap();
    for (k, (kind, group, nodes)) in elements.iter().enumerate() {
        let nodes: Vec<String> = nodes.iter().map(|node| (node + 1).to_string()).collect();
        let (number, group) = (k + 1, group + 1);
        writeln!(text, "{number} {kind} 2 {group} {group} {}", nodes.join(" ")).unwrap();
    }
    (text + "$EndElements\n").into_bytes()
}

/// A plane mesh of quadrilaterals over a grid of lines, `place` taking a point of the grid to the body; names of its lower edge,
/// its upper edge and its region.
pub fn quadrilaterals(
    xs: &[f64],
    ys: &[f64],
    [lower, upper, region]: [&str; 3],
    place: impl Fn(f64, f64) -> [f64; 2],
) -> Vec<u8> {
    let node = |i: usize, j: usize| i + xs.len() * j;
    let at = |(&x, &y): (&f64, &f64)| [place(x, y)[0], place(x, y)[1], 0.0];
    let points: Vec<[f64; 3]> =
        ys.iter().flat_map(|y| xs.iter().map(move |x| (x, y))).map(at).collect();
    let mut elements = Vec::new();
    let last = ys.len() - 1;
    for i in 0..xs.len() - 1 {
        elements.push((1, 0, vec![node(i, 0), node(i + 1, 0)]));
        elements.push((1, 1, vec![node(i + 1, last), node(i, last)]));
        for j in 0..last {
            let corners = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            elements.push((3, 2, corners.to_vec()));
        }
    }
    mesh_text(&points, &[(1, lower), (1, upper), (2, region)], &elements)
}

/// Lines of a grid at equal distances.
pub fn even(length: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| length * i as f64 / count as f64).collect()
}
