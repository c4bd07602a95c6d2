//! Mesh files in MSH 2.2 of points and elements that a test makes.

use super::prelude::*;

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

/// Nodes by their numbers and elements of a type, from number 1, as an input file of Abaqus.
pub fn abaqus_text(points: &[(usize, Place)], kind: &str, elements: &[Vec<usize>]) -> String {
    let mut text = "*NODE, NSET=Nall\n".to_owned();
    for (number, [x, y, z]) in points {
        writeln!(text, "{number}, {x:?}, {y:?}, {z:?}").unwrap();
    }
    writeln!(text, "*Element, type={kind}").unwrap();
    for (nodes, number) in elements.iter().zip(1_usize..) {
        let words: Vec<String> =
            [&[number], &nodes[..]].concat().iter().map(usize::to_string).collect();
        // At most 15 numbers a line; a comma at its end.
        let lines: Vec<String> = words.chunks(15).map(|line| line.join(", ")).collect();
        writeln!(text, "{}", lines.join(",\n")).unwrap();
    }
    text
}

/// A grid of quadrilaterals over lines of two coordinates, which `place` takes to the body.
pub struct Grid<'a> {
    pub xs: Vec<f64>,
    pub ys: Vec<f64>,
    /// Whether the last line of `xs` is the first one again.
    pub is_closed: bool,
    /// Whether every quadrilateral is cut into two triangles.
    pub is_cut: bool,
    /// Names of the edges at the ends of `ys` and of `xs`; an edge without a name is no boundary.
    pub names: [&'a str; 2],
    pub sides: [&'a str; 2],
    /// Whether a quadrilateral is missing, and the name of the edges beside such ones.
    pub is_missing: &'a dyn Fn(usize, usize) -> bool,
    pub hole: &'a str,
    pub region_of_layer: &'a dyn Fn(usize) -> &'a str,
    pub place: &'a dyn Fn(f64, f64) -> [f64; 2],
}

/// Lines of a grid along and across.
pub type Lines = [Vec<f64>; 2];

impl<'a> Grid<'a> {
    /// A whole grid on its lines.
    pub fn of(
        [xs, ys]: Lines,
        names: [&'a str; 2],
        region_of_layer: &'a dyn Fn(usize) -> &'a str,
    ) -> Self {
        let (is_closed, is_cut, sides, hole) = (false, false, [""; 2], "");
        let is_missing = &|_: usize, _: usize| false;
        let place = &|x: f64, y: f64| [x, y];
        Self { xs, ys, is_closed, is_cut, names, sides, is_missing, hole, region_of_layer, place }
    }

    /// The name of an edge: that of the rim, or of the hole where what lies beside it is missing.
    fn edge(&self, is_rim: bool, name: &'a str, [i, j]: [usize; 2]) -> &'a str {
        match is_rim {
            true => name,
            false if (self.is_missing)(i, j) => self.hole,
            false => "",
        }
    }
}

/// The file of such grids; nodes of different grids are different nodes.
pub fn grids(all: &[Grid<'_>]) -> Vec<u8> {
    let (mut points, mut groups, mut elements) = (Vec::new(), Vec::new(), Vec::new());
    for grid in all {
        let (first, columns, layers) = (points.len(), grid.xs.len() - 1, grid.ys.len() - 1);
        let around = grid.xs.len() - usize::from(grid.is_closed);
        let node = |i: usize, j: usize| first + i % around + around * j;
        let corners = |i, j| [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
        for &y in &grid.ys {
            points.extend(grid.xs[..around].iter().map(|&x| (grid.place)(x, y)));
        }
        let mut add = |kind: u32, name, nodes: &[usize]| {
            let group = (if kind == 1 { 1 } else { 2 }, name);
            let at = groups.iter().position(|own| *own == group).unwrap_or(groups.len());
            groups.extend((at == groups.len()).then_some(group));
            elements.push((kind, at, nodes.to_vec()));
        };
        for i in 0..columns {
            let there = || (0..layers).filter(|&j| !(grid.is_missing)(i, j));
            for j in there() {
                let [a, b, c, d] = corners(i, j);
                let ([lower, upper], [left, right]) = (grid.names, grid.sides);
                let edges = [
                    (grid.edge(j == 0, lower, [i, j.wrapping_sub(1)]), [a, b]),
                    (grid.edge(j + 1 == layers, upper, [i, j + 1]), [c, d]),
                    (grid.edge(i == 0, left, [i.wrapping_sub(1), j]), [d, a]),
                    (grid.edge(i + 1 == columns, right, [i + 1, j]), [b, c]),
                ];
                let named = edges.iter().filter(|(name, _)| !name.is_empty());
                named.for_each(|(name, edge)| add(1, *name, edge));
            }
            for j in there() {
                let ([a, b, c, d], region) = (corners(i, j), (grid.region_of_layer)(j));
                match grid.is_cut {
                    true => [[a, b, c], [a, c, d]].iter().for_each(|own| add(2, region, own)),
                    false => add(3, region, &[a, b, c, d]),
                }
            }
        }
    }
    // Nodes of no element are left out.
    let used: BTreeSet<usize> = elements.iter().flat_map(|own: &Listed| own.2.clone()).collect();
    let used: Vec<usize> = used.into_iter().collect();
    let nodes = elements.iter_mut().flat_map(|own| &mut own.2);
    nodes.for_each(|node| *node = used.binary_search(node).unwrap());
    let point = |&node: &usize| [points[node][0], points[node][1], 0.0];
    mesh_text(&used.iter().map(point).collect::<Vec<_>>(), &groups, &elements)
}

/// One such grid of one region; names of its lower edge, its upper edge and its region.
pub fn quadrilaterals(
    xs: &[f64],
    ys: &[f64],
    [lower, upper, region]: [&str; 3],
    place: impl Fn(f64, f64) -> [f64; 2],
) -> Vec<u8> {
    let lines = [xs, ys].map(<[f64]>::to_vec);
    grids(&[Grid { place: &place, ..Grid::of(lines, [lower, upper], &|_| region) }])
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
    // Clockwise, so that elements outwards of it are counter-clockwise.
    let angles = even(-std::f64::consts::TAU, around);
    let radii = even(outer - inner, across).into_iter().map(|depth| inner + depth).collect();
    Grid {
        is_closed: true,
        place: &|angle, radius| [radius * angle.cos(), radius * angle.sin()],
        ..Grid::of([angles, radii], names, region_of_layer)
    }
}

/// Lines of a grid at equal distances.
pub fn even(length: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| length * i as f64 / count as f64).collect()
}
