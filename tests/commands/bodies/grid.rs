//! Mesh files of rings and blocks of four-node quadrilaterals, written node by node.

use crate::mesh_text::mesh_text;

/// Type of the element in the file, its physical group, its nodes.
type Element = (u32, String, Vec<usize>);

/// A grid of `along` x `across` elements: a ring around the origin (`along` around, `across` from inside outwards) or a block.
pub struct Grid<'a> {
    pub shape: Shape,
    pub along: usize,
    pub across: usize,
    /// Region of each layer across.
    pub region_of_layer: &'a dyn Fn(usize) -> &'a str,
    /// Names of the first and the last line along.
    pub names: [&'a str; 2],
    /// Whether every quadrilateral is cut into two triangles.
    pub triangles: bool,
}

impl<'a> Grid<'a> {
    /// A block of one region between its `face` and its `back`.
    pub fn block(
        [width, height]: [f64; 2],
        [along, across]: [usize; 2],
        region_of_layer: &'a dyn Fn(usize) -> &'a str,
    ) -> Self {
        let shape = Shape::Block { width, height };
        Self { shape, along, across, region_of_layer, names: ["face", "back"], triangles: false }
    }
}

#[derive(Clone, Copy)]
pub enum Shape {
    Ring { inner: f64, outer: f64 },
    Block { width: f64, height: f64 },
}

pub fn msh(grids: &[Grid<'_>]) -> String {
    let mut nodes: Vec<[f64; 2]> = Vec::new();
    let mut elements: Vec<Element> = Vec::new();
    for grid in grids {
        let first = nodes.len();
        let around = match grid.shape {
            Shape::Ring { .. } => grid.along,
            Shape::Block { .. } => grid.along + 1,
        };
        for layer in 0..=grid.across {
            for step in 0..around {
                nodes.push(grid.place(step, layer));
            }
        }
        let node = |step: usize, layer: usize| first + layer * around + step % around;
        for layer in 0..grid.across {
            for step in 0..grid.along {
                let [a, b, c, d] =
                    [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(i, j)| node(step + i, layer + j));
                // Counter-clockwise: outwards first on a ring, along first on a block.
                let corners = match grid.shape {
                    Shape::Ring { .. } => [a, b, c, d],
                    Shape::Block { .. } => [a, d, c, b],
                };
                let region = (grid.region_of_layer)(layer).to_owned();
                if grid.triangles {
                    let [a, b, c, d] = corners;
                    elements.push((2, region.clone(), vec![a, b, c]));
                    elements.push((2, region, vec![a, c, d]));
                } else {
                    elements.push((3, region, corners.to_vec()));
                }
            }
        }
        for (name, layer) in grid.names.iter().zip([0, grid.across]) {
            for step in 0..grid.along {
                elements.push((
                    1,
                    (*name).to_owned(),
                    vec![node(step, layer), node(step + 1, layer)],
                ));
            }
        }
    }
    written(&nodes, &elements)
}

impl Grid<'_> {
    fn place(&self, step: usize, layer: usize) -> [f64; 2] {
        let (x, y) = (step as f64 / self.along as f64, layer as f64 / self.across as f64);
        match self.shape {
            Shape::Ring { inner, outer } => {
                let radius = inner + (outer - inner) * y;
                let (sin, cos) = (std::f64::consts::TAU * x).sin_cos();
                [radius * cos, radius * sin]
            }
            Shape::Block { width, height } => [width * x, height * y],
        }
    }
}

fn written(nodes: &[[f64; 2]], elements: &[Element]) -> String {
    let mut groups: Vec<(u32, &str)> = Vec::new();
    let mut listed = Vec::new();
    for (kind, name, corners) in elements {
        let group = (if *kind == 1 { 1 } else { 2 }, name.as_str());
        let at = groups.iter().position(|own| *own == group).unwrap_or(groups.len());
        if at == groups.len() {
            groups.push(group);
        }
        listed.push((*kind, at, corners.clone()));
    }
    let points: Vec<_> = nodes.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    String::from_utf8(mesh_text(&points, &groups, &listed)).unwrap()
}
