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

/// A grid of quadrilaterals over lines of two coordinates, which `place` takes to the body.
pub struct Grid<'a> {
    pub xs: Vec<f64>,
    pub ys: Vec<f64>,
    /// Whether the last line of `xs` is the first one again.
    pub is_closed: bool,
    /// Whether every quadrilateral is cut into two triangles.
    pub is_cut: bool,
    /// Names of the lower and the upper edge.
    pub names: [&'a str; 2],
    pub region_of_layer: &'a dyn Fn(usize) -> &'a str,
    pub place: &'a dyn Fn(f64, f64) -> [f64; 2],
}

/// The file of such grids; nodes of different grids are different nodes.
pub fn grids(all: &[Grid<'_>]) -> Vec<u8> {
    let (mut points, mut groups, mut elements) = (Vec::new(), Vec::new(), Vec::new());
    for grid in all {
        let (first, last) = (points.len(), grid.ys.len() - 1);
        let around = grid.xs.len() - usize::from(grid.is_closed);
        let node = |i: usize, j: usize| first + i % around + around * j;
        for &y in &grid.ys {
            points.extend(grid.xs[..around].iter().map(|&x| (grid.place)(x, y)));
        }
        let mut add = |kind: u32, name, nodes: &[usize]| {
            let group = (if kind == 1 { 1 } else { 2 }, name);
            let at = groups.iter().position(|own| *own == group).unwrap_or(groups.len());
            groups.extend((at == groups.len()).then_some(group));
            elements.push((kind, at, nodes.to_vec()));
        };
        for i in 0..grid.xs.len() - 1 {
            add(1, grid.names[0], &[node(i, 0), node(i + 1, 0)]);
            add(1, grid.names[1], &[node(i + 1, last), node(i, last)]);
            for j in 0..last {
                let region = (grid.region_of_layer)(j);
                let corners = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
                let [a, b, c, d] = corners;
                match grid.is_cut {
                    true => [[a, b, c], [a, c, d]].iter().for_each(|own| add(2, region, own)),
                    false => add(3, region, &corners),
                }
            }
        }
    }
    let points: Vec<[f64; 3]> = points.into_iter().map(|[x, y]: [f64; 2]| [x, y, 0.0]).collect();
    mesh_text(&points, &groups, &elements)
}

/// One such grid of one region; names of its lower edge, its upper edge and its region.
pub fn quadrilaterals(
    xs: &[f64],
    ys: &[f64],
    [lower, upper, region]: [&str; 3],
    place: impl Fn(f64, f64) -> [f64; 2],
) -> Vec<u8> {
    grids(&[Grid {
        xs: xs.to_vec(),
        ys: ys.to_vec(),
        is_closed: false,
        is_cut: false,
        names: [lower, upper],
        region_of_layer: &|_| region,
        place: &place,
    }])
}

/// A rectangle of such elements, its corner at the origin.
pub fn plane_block(size: [f64; 2], counts: [usize; 2], names: [&str; 3]) -> Vec<u8> {
    let [xs, ys] = [0, 1].map(|axis| even(size[axis], counts[axis]));
    quadrilaterals(&xs, &ys, names, |x, y| [x, y])
}

/// A ring around the origin between two radii; names of its inner and its outer edge.
pub fn ring_grid<'a>(
    [inner, outer]: [f64; 2],
    [around, across]: [usize; 2],
    names: [&'a str; 2],
    region_of_layer: &'a dyn Fn(usize) -> &'a str,
) -> Grid<'a> {
    Grid {
        // Clockwise, so that elements outwards of it are counter-clockwise.
        xs: even(-std::f64::consts::TAU, around),
        ys: even(outer - inner, across).into_iter().map(|depth| inner + depth).collect(),
        is_closed: true,
        is_cut: false,
        names,
        region_of_layer,
        place: &|angle, radius| [radius * angle.cos(), radius * angle.sin()],
    }
}

/// Lines of a grid at equal distances.
pub fn even(length: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| length * i as f64 / count as f64).collect()
}
