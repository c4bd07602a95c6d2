//! Small images inside drawings: heat maps, maps of states.

use super::axis::Axis;
use super::colour::{ColourMap, channels};
use super::frame::Frame;
use super::layer::Layer;
use super::legend::Key;
use super::scale::extremes;
use super::svg::Svg;

/// Colours of an image by index; one index more is transparent.
#[derive(Clone, Debug, PartialEq)]
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
        Self::of(colours.iter().map(|colour| channels(colour)))
    }

    fn of(colours: impl Iterator<Item = [u8; 3]>) -> Self {
        let opaque = colours.map(|[r, g, b]| [r, g, b, 255]);
        Self(opaque.chain([[255, 255, 255, 0]]).collect())
    }

    /// The transparent index.
    pub(super) fn transparent(&self) -> u8 {
        (self.0.len() - 1) as u8
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
#[derive(Clone, Debug, PartialEq)]
pub(super) struct IndexedImage {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<u8>,
}

impl IndexedImage {
    /// The image as PNG; `None` for one without pixels.
    pub fn encode(&self, palette: &Palette) -> Option<Vec<u8>> {
        if self.width * self.height == 0 {
            return None;
        }
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.set_filter(png::Filter::NoFilter);
        let colours = palette.0.iter().flat_map(|c| [c[0], c[1], c[2]]);
        encoder.set_palette(colours.collect::<Vec<u8>>());
        encoder.set_trns(palette.0.iter().map(|c| c[3]).collect::<Vec<u8>>());
        let mut writer = encoder.write_header().ok()?;
        writer.write_image_data(&self.pixels).ok()?;
        writer.finish().ok()?;
        Some(bytes)
    }
}

/// A range of values shown by the colours of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Colours {
    /// Quantity and unit.
    pub axis: Axis,
    /// The map.
    pub map: ColourMap,
    /// Values of the first and the last colour.
    pub range: (f64, f64),
}

impl Colours {
    /// The range that holds all values: from zero or below, or symmetric about zero where the map diverges.
    pub(super) fn over(axis: Axis, map: ColourMap, values: &[f64]) -> Self {
        let (low, high) = extremes(values.iter().copied());
        let range = match (axis.given(), map) {
            (Some(range), _) => range,
            (None, ColourMap::Diverging) => {
                let reach = low.abs().max(high.abs()).max(f64::MIN_POSITIVE);
                (-reach, reach)
            }
            // A body at rest has a scale all the same.
            (None, _) if high > low.min(0.0) => (low.min(0.0), high),
            (None, _) => (0.0, 1.0),
        };
        Self { axis, map, range }
    }
}

/// Values over a grid of equal cells, as colours.
#[derive(Clone, Debug)]
pub struct Heat {
    x: (f64, f64),
    y: (f64, f64),
    image: IndexedImage,
    palette: Palette,
    colours: Option<Colours>,
    names: Vec<(Key, String)>,
}

impl Heat {
    /// `value(column, row)` over `columns` by `rows` cells between the ends, row 0 lowest.
    pub fn of_values(
        (x, columns): ((f64, f64), usize),
        (y, rows): ((f64, f64), usize),
        (axis, map): (Axis, ColourMap),
        value: impl Fn(usize, usize) -> f64,
    ) -> Self {
        let values: Vec<f64> = (0..rows)
            .rev()
            .flat_map(|row| (0..columns).map(move |column| (column, row)))
            .map(|(column, row)| value(column, row))
            .collect();
        let colours = Colours::over(axis, map, &values);
        let palette = Palette::of_map(map, Palette::FINE);
        let pixels = values
            .iter()
            .map(|&value| palette.level_of(value, colours.range))
            .collect();
        let image = IndexedImage {
            width: columns,
            height: rows,
            pixels,
        };
        Self {
            x,
            y,
            image,
            palette,
            colours: Some(colours),
            names: Vec::new(),
        }
    }

    /// States by their index in the palette.
    pub fn of_states(
        (x, columns): ((f64, f64), usize),
        (y, rows): ((f64, f64), usize),
        palette: Palette,
        state: impl Fn(usize, usize) -> u8,
    ) -> Self {
        let cells = (0..rows)
            .rev()
            .flat_map(|row| (0..columns).map(move |column| (column, row)));
        let pixels = cells.map(|(column, row)| state(column, row)).collect();
        let image = IndexedImage {
            width: columns,
            height: rows,
            pixels,
        };
        Self {
            x,
            y,
            image,
            palette,
            colours: None,
            names: Vec::new(),
        }
    }
}

impl Heat {
    /// The same with entries in the legend.
    pub fn names(self, names: Vec<(Key, String)>) -> Self {
        Self { names, ..self }
    }
}

impl Layer for Heat {
    fn extent(&self, see: &mut dyn FnMut(f64, f64)) {
        if self.image.width * self.image.height > 0 {
            see(self.x.0, self.y.0);
            see(self.x.1, self.y.1);
            // The corners may lie outside what is shown.
            see(0.5 * (self.x.0 + self.x.1), 0.5 * (self.y.0 + self.y.1));
        }
    }

    fn draw(&self, svg: &mut Svg, frame: &Frame) {
        let place = frame.rect(self.x, self.y);
        if let Some(png) = self.image.encode(&self.palette) {
            svg.image(&place, &png, self.colours.is_none());
        }
    }

    fn keys(&self) -> Vec<(Key, String)> {
        self.names.clone()
    }

    fn colours(&self) -> Option<&Colours> {
        self.colours.as_ref()
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
