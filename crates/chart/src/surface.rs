//! The surface of solid bodies, hidden parts hidden: shaded, or in the colours of values at its nodes.

use crate::prelude::*;

/// Colours of the values, and one more for faces without a value ...
const LEVELS: usize = 15;
/// ... each at so many brightnesses: together, with the edges, fewer than 255.
const SHADES: usize = 15;
/// Colour of faces without a value.
const NEUTRAL: &str = "#c8c8c8";
/// Colour of edges.
const EDGE: &str = "#303030";
/// Where the light comes from: over the left shoulder of the viewer.
const LIGHT: [f64; 3] = [-0.35, 0.5, 0.79];

/// Triangles and edges of a surface by their nodes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SurfaceMesh {
    /// Corners, the outside to the viewer where they run counter-clockwise.
    #[serde(with = "whole")]
    pub triangles: Vec<[u32; 3]>,
    /// Edges drawn as lines.
    #[serde(with = "whole")]
    pub edges: Vec<[u32; 2]>,
}

/// A surface seen along the third axis of its positions.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Surface {
    mesh: Arc<SurfaceMesh>,
    /// Light shows the direction of a face, which takes fine places.
    #[serde(with = "Levels::<16_777_214>")]
    positions: Vec<[f64; 3]>,
    paint: Paint,
}

/// What colours a surface.
#[derive(Clone, Debug, Serialize, Deserialize)]
enum Paint {
    /// Values at the nodes.
    Values(#[serde(with = "Levels::<65_534>")] Vec<f64>, Box<Colours>),
    /// The part that each triangle belongs to; colour and name of each part, with "" for one that the legend leaves
    /// out.
    Parts(Vec<usize>, Vec<(Colour, String)>),
}

impl Surface {
    /// Nodes at positions to the right, upwards and towards the viewer, with values (NaN: none) at them.
    pub fn new(
        mesh: Arc<SurfaceMesh>,
        positions: Vec<[f64; 3]>,
        values: Vec<f64>,
        axis: Axis,
        map: ColourMap,
    ) -> Self {
        let known: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        let colours = Box::new(Colours::over(axis, map, &known));
        Self { mesh, positions, paint: Paint::Values(values, colours) }
    }

    /// Triangles in the colours of the parts that they belong to, by index; `parts` has colour and name of each ("":
    /// not in the legend). From the sixteenth on parts take the colours of the first ones again.
    pub fn of_parts(
        mesh: Arc<SurfaceMesh>,
        positions: Vec<[f64; 3]>,
        part_of: Vec<usize>,
        parts: Vec<(Colour, String)>,
    ) -> Self {
        Self { mesh, positions, paint: Paint::Parts(part_of, parts) }
    }

    /// The corners of the rectangle around the nodes of the surface, with `room` as a fraction of its size.
    pub fn window(&self, room: f64) -> [[f64; 2]; 2] {
        let nodes = self.mesh.triangles.iter().flatten();
        let mut ends = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for &node in nodes {
            let place = self.positions[node as usize];
            for axis in 0..2 {
                ends[0][axis] = ends[0][axis].min(place[axis]);
                ends[1][axis] = ends[1][axis].max(place[axis]);
            }
        }
        let size = (ends[1][0] - ends[0][0]).max(ends[1][1] - ends[0][1]);
        let more = 0.5 * room * size;
        [ends[0].map(|x| x - more), ends[1].map(|x| x + more)]
    }

    fn palette(&self) -> Palette {
        let values = (0..LEVELS).map(|level| match &self.paint {
            Paint::Values(_, colours) => colours.map.at((level as f64 + 0.5) / LEVELS as f64),
            Paint::Parts(_, parts) => parts.get(level).map_or(NEUTRAL.into(), |part| part.0).0,
        });
        let bases: Vec<[u8; 3]> = values.chain([Colour::from(NEUTRAL).0]).collect();
        let shaded = bases.iter().flat_map(|base| {
            (0..SHADES).map(|shade| {
                let brightness = 0.42 + 0.58 * shade as f64 / (SHADES - 1) as f64;
                base.map(|channel| (f64::from(channel) * brightness).round() as u8)
            })
        });
        Palette::of(shaded.chain([Colour::from(EDGE).0]))
    }

    /// Fills every triangle in front of what is there, then draws the edges that are not hidden.
    fn rasterize(&self, frame: &Frame, palette: &Palette) -> IndexedImage {
        let image = IndexedImage::over(&frame.area, 2000.0, palette);
        let vertex = |&[x, y, z]: &[f64; 3]| {
            let [column, row] = image.place(frame, [x, y]);
            [column, row, z]
        };
        let vertices: Vec<[f64; 3]> = self.positions.iter().map(vertex).collect();
        let place = |node: u32| vertices[node as usize];
        let mut canvas = Canvas { depth: vec![f64::NEG_INFINITY; image.pixels.len()], image };
        for (triangle, corners) in self.mesh.triangles.iter().enumerate() {
            let shade = self.shade(corners);
            canvas.fill(corners.map(place), self.levels(triangle, corners), shade);
        }
        // An edge lies in its faces: it stands a little in front of them.
        let (far, near) = extremes(self.positions.iter().map(|place| place[2]));
        let lift = 4e-3 * (near - far);
        for ends in &self.mesh.edges {
            canvas.line(ends.map(place), lift);
        }
        canvas.image
    }

    /// Colours at the corners of a triangle, as indices with fractions.
    fn levels(&self, triangle: usize, corners: &[u32; 3]) -> [f64; 3] {
        match &self.paint {
            Paint::Values(values, colours) => corners.map(|node| {
                let (low, high) = colours.range;
                let value = values.get(node as usize).copied().unwrap_or(f64::NAN);
                (value - low) / (high - low).max(f64::MIN_POSITIVE) * LEVELS as f64
            }),
            Paint::Parts(part_of, _) => {
                let part = part_of.get(triangle).map(|part| (part % LEVELS) as f64 + 0.5);
                [part.unwrap_or(f64::NAN); 3]
            }
        }
    }

    /// Brightness of a face, as an index, where it has a colour and where it has none: by its angle to the light, but
    /// full for colours of values, which are those of their bar.
    fn shade(&self, corners: &[u32; 3]) -> [usize; 2] {
        let [a, b, c] = corners.map(|node| self.positions[node as usize]);
        let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
        let normal =
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        let facing: f64 = normal.iter().zip(LIGHT).map(|(n, l)| n * l).sum();
        // A face seen from behind is lit like its back.
        let lit = (facing / length.max(f64::MIN_POSITIVE)).abs();
        let shade = ((lit * SHADES as f64) as usize).min(SHADES - 1);
        match self.paint {
            Paint::Values(..) => [SHADES - 1, shade],
            Paint::Parts(..) => [shade; 2],
        }
    }
}

/// An image with the depth of what it shows.
struct Canvas {
    image: IndexedImage,
    depth: Vec<f64>,
}

impl Canvas {
    /// Fills a triangle of corners (x, y in pixels, depth) where nothing stands in front of it.
    fn fill(&mut self, [a, b, c]: [[f64; 3]; 3], levels: [f64; 3], shades: [usize; 2]) {
        let (image, depths) = (&mut self.image, &mut self.depth);
        let corners = [a, b, c].map(|[x, y, _]| [x, y]);
        image.over_triangle(corners, |pixel, place, v, w| {
            let at = |[p, q, r]: [f64; 3]| p + v * (q - p) + w * (r - p);
            let depth = at([a[2], b[2], c[2]]);
            if depth > depths[place] {
                depths[place] = depth;
                let level = at(levels);
                let (level, shade) = match level.is_finite() {
                    true => (level.clamp(0.0, (LEVELS - 1) as f64) as usize, shades[0]),
                    false => (LEVELS, shades[1]),
                };
                *pixel = (level * SHADES + shade) as u8;
            }
        });
    }

    fn line(&mut self, [a, b]: [[f64; 3]; 2], lift: f64) {
        let steps = (b[0] - a[0]).abs().max((b[1] - a[1]).abs()).ceil();
        if !steps.is_finite() {
            return;
        }
        let count = steps.max(1.0) as usize;
        for k in 0..=count {
            let share = k as f64 / count as f64;
            let [x, y, z] = [0, 1, 2].map(|axis| a[axis] + share * (b[axis] - a[axis]));
            let (column, row) = (x.floor(), y.floor());
            let [width, height] = [self.image.width, self.image.height];
            let is_inside =
                (0.0..width as f64).contains(&column) && (0.0..height as f64).contains(&row);
            if !is_inside {
                continue;
            }
            let pixel = row as usize * width + column as usize;
            if z + lift >= self.depth[pixel] {
                self.image.pixels[pixel] = ((LEVELS + 1) * SHADES) as u8;
            }
        }
    }
}

impl Layer for Surface {
    fn is_whole(&self) -> bool {
        let nodes = self.mesh.triangles.iter().flatten().chain(self.mesh.edges.as_flattened());
        nodes.max().is_none_or(|node| (*node as usize) < self.positions.len())
    }

    fn extent(&self, see: &mut dyn FnMut(f64, f64)) {
        let [low, high] = self.window(0.0);
        see(low[0], low[1]);
        see(high[0], high[1]);
    }

    fn draw(&self, svg: &mut Svg, frame: &Frame) {
        let palette = self.palette();
        self.rasterize(frame, &palette).draw(svg, &frame.area, &palette, false);
    }

    fn colours(&self) -> Option<&Colours> {
        if let Paint::Values(_, colours) = &self.paint { Some(colours) } else { None }
    }

    fn keys(&self) -> Vec<(Key, String)> {
        let Paint::Parts(_, parts) = &self.paint else { return Vec::new() };
        let named = parts.iter().filter(|(_, name)| !name.is_empty());
        let keys = named.map(|(colour, name)| (Key::patch(*colour, 1.0), name.clone()));
        keys.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A large square behind a small one: where both are, the small one shows; edges behind it are hidden.
    #[test]
    fn what_lies_in_front_hides_what_lies_behind() {
        let square = |half: f64, depth: f64| {
            [[-half, -half], [half, -half], [half, half], [-half, half]].map(|[x, y]| [x, y, depth])
        };
        let positions = [square(1.0, 0.0), square(0.5, 1.0)].concat();
        let mesh = SurfaceMesh {
            triangles: vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]],
            edges: vec![[0, 2]],
        };
        let values = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let axis = Axis::new("", "").between(0.0, 1.0);
        let surface = Surface::new(Arc::new(mesh), positions, values, axis, ColourMap::Viridis);
        let mut canvas = Canvas {
            image: IndexedImage { width: 40, height: 40, pixels: vec![0; 1600] },
            depth: vec![f64::NEG_INFINITY; 1600],
        };
        let place = |node: u32| {
            let [x, y, z] = surface.positions[node as usize];
            [20.0 * (x + 1.0), 20.0 * (1.0 - y), z]
        };
        for (triangle, corners) in surface.mesh.triangles.iter().enumerate() {
            let levels = surface.levels(triangle, corners);
            canvas.fill(corners.map(place), levels, surface.shade(corners));
        }
        for ends in &surface.mesh.edges {
            canvas.line(ends.map(place), 0.01);
        }
        let pixel = |column: usize, row: usize| canvas.image.pixels[row * 40 + column] as usize;
        let level = |column: usize, row: usize| pixel(column, row) / SHADES;
        // The colours of values are those of the bar, however a face lies.
        assert!([(20, 20), (3, 10)].map(|(x, y)| pixel(x, y) % SHADES) == [SHADES - 1; 2]);
        assert_eq!((level(20, 20), level(3, 10)), (LEVELS - 1, 0));
        // The diagonal is an edge outside the small square.
        assert_eq!((level(3, 37), level(15, 25)), (LEVELS + 1, LEVELS - 1));
    }
    /// Parts have one colour each, whatever their triangles, and names in the legend where they have one.
    #[test]
    fn parts_have_one_colour_each_and_a_name_in_the_legend() {
        let mesh = SurfaceMesh { triangles: vec![[0, 1, 2], [0, 2, 3]], edges: Vec::new() };
        let parts = vec![("#ff0000".into(), "disc".to_owned()), ("#00ff00".into(), String::new())];
        let surface = Surface::of_parts(Arc::new(mesh), vec![[0.0; 3]; 4], vec![1, 0], parts);
        assert_eq!(surface.levels(0, &[0, 1, 2]), [1.5; 3]);
        assert_eq!(surface.levels(1, &[0, 2, 3]), [0.5; 3]);
        let names: Vec<String> = surface.keys().into_iter().map(|key| key.1).collect();
        assert_eq!(names, ["disc"]);
        assert!(surface.colours().is_none());
    }
}
