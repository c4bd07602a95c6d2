//! A nodal field over a (deformed) mesh as a small image with sharp outlines.

use crate::prelude::*;

/// What a field is drawn over: elements and boundary curves, by the nodes they have.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mesh {
    /// The nodes in order around each element, with mid-side nodes between its corners where it has any.
    #[serde(with = "lists")]
    pub rings: Vec<Vec<u32>>,
    /// Whether every second node of a ring is one of a side.
    pub are_quadratic: Vec<bool>,
    /// Curves drawn as outlines.
    #[serde(with = "lists")]
    pub outlines: Vec<Vec<u32>>,
    /// Curves drawn as thin white lines that show the deformation.
    #[serde(with = "lists")]
    pub lines: Vec<Vec<u32>>,
}

/// Values at the nodes of a mesh, as colours.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Field {
    mesh: Arc<Mesh>,
    #[serde(with = "Levels::<65_534>")]
    positions: Vec<[f64; 2]>,
    #[serde(with = "Levels::<65_534>")]
    values: Vec<f64>,
    colours: Colours,
    levels: usize,
}

impl Field {
    /// Values at nodes; the axis names them and gives the range where it has ends.
    pub fn new(
        mesh: Arc<Mesh>,
        positions: Vec<[f64; 2]>,
        values: Vec<f64>,
        axis: Axis,
        map: ColourMap,
    ) -> Self {
        let colours = Colours::over(axis, map, &values);
        Self { mesh, positions, values, colours, levels: Palette::FINE }
    }

    /// The corners of the square around nodes, with `room` as a fraction of its size.
    pub fn window(positions: &[[f64; 2]], room: f64) -> [[f64; 2]; 2] {
        let ends = [0, 1].map(|axis| extremes(positions.iter().map(|p| p[axis])));
        let half =
            0.5 * (1.0 + room) * ends.iter().map(|e| e.1 - e.0).fold(f64::MIN_POSITIVE, f64::max);
        let centre = ends.map(|e| 0.5 * (e.0 + e.1));
        [centre.map(|c| c - half), centre.map(|c| c + half)]
    }

    /// Colours the field: values are interpolated linearly on triangles around the centre of each element.
    fn rasterize(&self, frame: &Frame, palette: &Palette) -> IndexedImage {
        let mut image = IndexedImage::over(&frame.area, 4000.0, palette);
        let (low, high) = self.colours.range;
        let steepness = self.levels as f64 / (high - low).max(f64::MIN_POSITIVE);
        let vertex = |(place, value): (&[f64; 2], &f64)| {
            let [column, row] = image.place(frame, *place);
            [column, row, (value - low) * steepness]
        };
        let vertices: Vec<[f64; 3]> = self.positions.iter().zip(&self.values).map(vertex).collect();
        for (ring, is_quadratic) in self.mesh.rings.iter().zip(&self.mesh.are_quadratic) {
            let ring = ring.iter().map(|&node| vertices.get(node as usize).copied());
            let Some(ring) = ring.collect::<Option<Vec<[f64; 3]>>>() else { continue };
            let centre = centre(&ring, *is_quadratic);
            for (index, &corner) in ring.iter().enumerate() {
                let next = ring[(index + 1) % ring.len()];
                triangle(&mut image, [centre, corner, next], self.levels);
            }
        }
        image
    }

    fn curve(&self, nodes: &[u32], frame: &Frame) -> Vec<(f64, f64)> {
        let places = nodes.iter().filter_map(|&node| self.positions.get(node as usize));
        places.map(|&[x, y]| frame.at(x, y)).collect()
    }
}

changed! { Field:
    /// The same with few colours, one of many.
    coarse() => { levels: Palette::COARSE }
}

/// Value of the shape functions at the centre times the nodes: of quadratic elements on four sides -1/4 at corners and
/// 1/2 at sides, on three -1/9 and 4/9.
fn centre(ring: &[[f64; 3]], is_quadratic: bool) -> [f64; 3] {
    let count = ring.len() as f64;
    let (corner, side) = match (is_quadratic, ring.len()) {
        (true, 6) => (-1.0 / 9.0, 4.0 / 9.0),
        (true, _) => (-0.25, 0.5),
        (false, _) => (1.0 / count, 1.0 / count),
    };
    let mut sum = [0.0; 3];
    for (index, vertex) in ring.iter().enumerate() {
        let weight = if index % 2 == 0 { corner } else { side };
        (0..3).for_each(|axis| sum[axis] += weight * vertex[axis]);
    }
    sum
}

/// Fills a triangle of vertices (x, y in pixels, level).
fn triangle(image: &mut IndexedImage, [a, b, c]: [[f64; 3]; 3], levels: usize) {
    let corners = [a, b, c].map(|[x, y, _]| [x, y]);
    image.over_triangle(corners, |pixel, _, v, w| {
        let level = a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]);
        *pixel = level.clamp(0.0, (levels - 1) as f64) as u8;
    });
}

impl Layer for Field {
    fn is_whole(&self) -> bool {
        (2..=Palette::FINE).contains(&self.levels)
    }

    fn extent(&self, see: &mut dyn FnMut(f64, f64)) {
        let known = self.positions.iter().zip(&self.values).filter(|(_, value)| value.is_finite());
        known.for_each(|(&[x, y], _)| see(x, y));
    }

    fn draw(&self, svg: &mut Svg, frame: &Frame) {
        let palette = Palette::of_map(self.colours.map, self.levels);
        self.rasterize(frame, &palette).draw(svg, &frame.area, &palette, false);
        // A fine bright line needs no hundredths.
        let tenths = |(x, y): (f64, f64)| ((10.0 * x).round() / 10.0, (10.0 * y).round() / 10.0);
        let lines = self.mesh.lines.iter();
        let lines =
            lines.map(|line| simplify(&self.curve(line, frame), 0.12).into_iter().map(tenths));
        svg.path(&Path::of(lines, false), &Stroke::solid("#ffffff", 0.3).with_opacity(0.45));
    }

    fn draw_over(&self, svg: &mut Svg, frame: &Frame) {
        let outlines = self.mesh.outlines.iter();
        let outlines = outlines.map(|outline| simplify(&self.curve(outline, frame), INVISIBLE));
        svg.path(&Path::of(outlines, true), &Stroke::solid(INK, 0.6));
    }

    fn colours(&self) -> Option<&Colours> {
        Some(&self.colours)
    }

    fn series(&self) -> Vec<Series> {
        let ruler = self.colours.axis.resolve(Some(self.colours.range));
        // Small multiples are pictures: their numbers are in the files of the run.
        if self.levels == Palette::COARSE {
            return Vec::new();
        }
        let values = self.values.iter().map(|&value| ruler.shown(value)).collect();
        let places = self.positions.iter().map(|&[x, y]| (x, y));
        vec![Series {
            values: Some((plain(&ruler.title), values)),
            is_whole: true,
            ..Series::new(SeriesKind::Field, INK.into(), places)
        }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::svg::Rect;

    /// A disc of radius 1 around a hole of radius 0.5, in quadratic cells.
    fn annulus(around: u32) -> (Mesh, Vec<[f64; 2]>) {
        let count = 2 * around;
        let node = |ring: u32, step: u32| ring * count + step % count;
        let rings = (0..around).map(|i| {
            let (a, b, c) = (2 * i, 2 * i + 1, 2 * i + 2);
            let ring = [(0, a), (0, b), (0, c), (1, c), (2, c), (2, b), (2, a), (1, a)];
            ring.map(|(r, s)| node(r, s)).to_vec()
        });
        let are_quadratic = vec![true; around as usize];
        let places = (0..3).flat_map(|ring| (0..count).map(move |step| (ring, step)));
        let places = places.map(|(ring, step)| {
            let (sin, cos) = (f64::from(step) / f64::from(count) * std::f64::consts::TAU).sin_cos();
            let radius = 0.5 + 0.25 * f64::from(ring);
            [radius * cos, radius * sin]
        });
        (Mesh { rings: rings.collect(), are_quadratic, ..Mesh::default() }, places.collect())
    }

    #[test]
    fn raster_covers_the_annulus_area_and_follows_the_field() {
        let (mesh, positions) = annulus(90);
        let values = positions.iter().map(|p| p[0]).collect();
        let axis = Axis::new("", "").between(-1.0, 1.0);
        let field = Field::new(Arc::new(mesh), positions, values, axis.clone(), ColourMap::Viridis)
            .coarse();
        let frame = Frame {
            area: Rect::new(0.0, 0.0, 133.33, 133.33),
            x: axis.resolve(None),
            y: axis.resolve(None),
        };
        let palette = Palette::of_map(ColourMap::Viridis, Palette::COARSE);
        let image = field.rasterize(&frame, &palette);
        let filled = image.pixels.iter().filter(|&&p| p < 48).count() as f64;
        let exact = std::f64::consts::PI * 0.75 / 4.0 * 160_000.0;
        // A pixel on the rim counts whole or not at all: about one in a hundred.
        assert!(image.width == 400 && (filled / exact - 1.0).abs() < 0.01, "{filled} {exact}");
        for column in [20, 60, 320, 380] {
            let level = f64::from(image.pixels[200 * 400 + column]);
            let expected = (column as f64 + 0.5) / 400.0 * 48.0;
            assert!((level + 0.5 - expected).abs() < 1.0);
        }
    }
}
