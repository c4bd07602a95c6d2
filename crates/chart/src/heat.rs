//! Heat maps, maps of states.

use crate::prelude::*;

/// Values over a grid of equal cells, as colours.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
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
        x: ((f64, f64), usize),
        y: ((f64, f64), usize),
        (axis, map): (Axis, ColourMap),
        value: impl Fn(usize, usize) -> f64,
    ) -> Self {
        let values = downwards(x.1, y.1, value);
        let colours = Colours::over(axis, map, &values);
        let palette = Palette::of_map(map, Palette::FINE);
        let level = |&value: &f64| palette.level_of(value, colours.range);
        let pixels = values.iter().map(level).collect();
        Self { colours: Some(colours), ..Self::of_pixels(x, y, pixels, palette) }
    }

    /// States by their index in the palette.
    pub fn of_states(
        x: ((f64, f64), usize),
        y: ((f64, f64), usize),
        palette: Palette,
        state: impl Fn(usize, usize) -> u8,
    ) -> Self {
        Self::of_pixels(x, y, downwards(x.1, y.1, state), palette)
    }

    fn of_pixels(
        (x, width): ((f64, f64), usize),
        (y, height): ((f64, f64), usize),
        pixels: Vec<u8>,
        palette: Palette,
    ) -> Self {
        let image = IndexedImage { width, height, pixels };
        Self { x, y, image, palette, ..Self::default() }
    }
}

changed! { Heat:
    /// The same with entries in the legend.
    names(names: Vec<(Key, String)>) => { names: names }
}

/// What each cell has, row by row from the top, as images have it.
fn downwards<T>(columns: usize, rows: usize, of: impl Fn(usize, usize) -> T) -> Vec<T> {
    let row = |row: usize| (0..columns).map(move |column| (column, row));
    (0..rows).rev().flat_map(row).map(|(column, row)| of(column, row)).collect()
}

impl Layer for Heat {
    fn is_whole(&self) -> bool {
        let Self { image, palette, .. } = self;
        image.width.checked_mul(image.height) == Some(image.pixels.len()) && palette.holds(image)
    }

    fn extent(&self, see: &mut dyn FnMut(f64, f64)) {
        if self.image.width * self.image.height > 0 {
            see(self.x.0, self.y.0);
            see(self.x.1, self.y.1);
            // The corners may lie outside what is shown.
            see(0.5 * (self.x.0 + self.x.1), 0.5 * (self.y.0 + self.y.1));
        }
    }

    fn draw(&self, svg: &mut Svg, frame: &Frame) {
        // Cells that a reader can count keep their edges.
        let is_sharp = self.colours.is_none() || self.image.pixels.len() <= 1024;
        self.image.draw(svg, &frame.rect(self.x, self.y), &self.palette, is_sharp);
    }

    fn keys(&self) -> Vec<(Key, String)> {
        self.names.clone()
    }

    fn colours(&self) -> Option<&Colours> {
        self.colours.as_ref()
    }
}
