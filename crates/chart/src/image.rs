//! Small images inside drawings: palettes, and pixels in their colours.

use crate::prelude::*;

/// Colours of an image by index; one index more is transparent.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Palette(Vec<[u8; 4]>);

impl Palette {
    /// Colours of a large image; at most 255, as one entry stays transparent.
    pub const FINE: usize = 192;
    /// Colours of one of many small images: few, so that together they stay light.
    pub const COARSE: usize = 48;

    /// `levels` colours of a map.
    pub fn of_map(map: ColourMap, levels: usize) -> Self {
        let last = (levels - 1) as f64;
        let colours = (0..levels).map(|level| map.at(level as f64 / last));
        Self::of(colours)
    }

    /// Colours written as `#rrggbb`.
    pub fn of_colours(colours: &[&str]) -> Self {
        Self::of(colours.iter().map(|&colour| Colour::from(colour).0))
    }

    /// These colours.
    pub(super) fn of(colours: impl Iterator<Item = [u8; 3]>) -> Self {
        let opaque = colours.map(|[r, g, b]| [r, g, b, 255]);
        Self(opaque.chain([[255, 255, 255, 0]]).collect())
    }

    /// Whether it has a colour for each pixel of an image.
    pub(super) fn holds(&self, image: &IndexedImage) -> bool {
        (1..=256).contains(&self.0.len())
            && image.pixels.iter().all(|&pixel| usize::from(pixel) < self.0.len())
    }

    /// Index of the colour of a value between the ends; of one that is not finite, the transparent one.
    pub(super) fn level_of(&self, value: f64, (low, high): (f64, f64)) -> u8 {
        let levels = self.0.len() - 1;
        match value.is_finite() {
            true => {
                ((value - low) / (high - low) * levels as f64).clamp(0.0, levels as f64 - 1.0) as u8
            }
            false => levels as u8,
        }
    }
}

/// An image of palette indices, row by row from the top.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct IndexedImage {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<u8>,
}

/// Image pixels for each point of the drawing.
const PIXELS_PER_POINT: f64 = 3.0;

impl IndexedImage {
    /// A transparent image over an area of a drawing, at most so many pixels wide and high.
    pub fn over(area: &Rect, most: f64, palette: &Palette) -> Self {
        let size = |points: f64| (points * PIXELS_PER_POINT).round().clamp(1.0, most) as usize;
        let (width, height) = (size(area.width), size(area.height));
        let transparent = (palette.0.len() - 1) as u8;
        Self { width, height, pixels: vec![transparent; width * height] }
    }

    /// Where a point of the data lies in an image over the area of a frame, pixels to the right and downwards.
    pub fn place(&self, frame: &Frame, [x, y]: [f64; 2]) -> [f64; 2] {
        [frame.x.fraction(x) * self.width as f64, (1.0 - frame.y.fraction(y)) * self.height as f64]
    }

    /// Calls `see` with the index of every pixel whose centre lies inside or on the edge of a triangle (x, y in
    /// pixels), and the weights `v`, `w` of its second and third corner there. Neighbours share the pixels on their
    /// common edge, so no seam shows.
    pub fn over_triangle(
        &mut self,
        [a, b, c]: [[f64; 2]; 3],
        mut see: impl FnMut(&mut u8, usize, f64, f64),
    ) {
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if !area.is_finite() || area.abs() < 1e-12 {
            return;
        }
        let bounds = |axis: usize, limit: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]) - 0.5;
            let high = a[axis].max(b[axis]).max(c[axis]) - 0.5;
            let last = high.floor().min(limit as f64 - 1.0);
            (low.ceil().max(0.0) as usize)..((last + 1.0).max(0.0) as usize)
        };
        let (columns, rows) = (bounds(0, self.width), bounds(1, self.height));
        for row in rows {
            for column in columns.clone() {
                let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
                let v = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
                let w = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
                if v >= -1e-9 && w >= -1e-9 && v + w <= 1.0 + 1e-9 {
                    let pixel = row * self.width + column;
                    see(&mut self.pixels[pixel], pixel, v, w);
                }
            }
        }
    }

    /// Draws the image stretched over a rectangle; `pixelated` keeps its pixels sharp.
    pub fn draw(&self, svg: &mut Svg, rect: &Rect, palette: &Palette, pixelated: bool) {
        if let Some(png) = self.encode(palette) {
            svg.image(rect, &png, pixelated);
        }
    }

    /// The image as PNG; `None` for one without pixels.
    fn encode(&self, palette: &Palette) -> Option<Vec<u8>> {
        if self.width * self.height == 0 {
            return None;
        }
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        // Neighbours in a row have neighbouring colours: their differences are the shortest to tell.
        encoder.set_filter(png::Filter::Sub);
        let colours = palette.0.iter().flat_map(|c| [c[0], c[1], c[2]]);
        encoder.set_palette(colours.collect::<Vec<u8>>());
        encoder.set_trns(palette.0.iter().map(|c| c[3]).collect::<Vec<u8>>());
        let mut writer = encoder.write_header().ok()?;
        writer.write_image_data(&self.pixels).ok()?;
        writer.finish().ok()?;
        Some(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_span_the_range_and_mark_missing_values() {
        let palette = Palette::of_map(ColourMap::Viridis, 48);
        let level = |value| palette.level_of(value, (0.0, 2.0));
        assert_eq!([0.0, 2.0, -5.0, f64::NAN].map(level), [0, 47, 0, 48]);
        assert_eq!(palette.0[48][3], 0);
    }
}
