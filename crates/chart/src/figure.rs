//! A figure: panels in a grid, in reading order.

use super::layout::{Grid, Layout, letter};
use crate::prelude::*;

/// Width across two columns of a journal page, mm.
const TWO_COLUMNS: f64 = 178.0;
/// Width of one column, mm.
const ONE_COLUMN: f64 = 85.0;

/// A drawing of one or more panels, with its name and caption.
#[derive(Serialize, Deserialize)]
pub struct Figure {
    /// File name without extension, ASCII.
    pub name: String,
    /// What is shown, in a sentence or two of plain text.
    pub caption: String,
    grid: Grid,
    /// A body that moves, for readers with scripts.
    pub motion: Option<Motion>,
    /// Points of the first panel that move with a parameter, for the same.
    pub steps: Option<Steps>,
}

impl Figure {
    /// An empty figure across two columns of a page.
    pub fn new(name: impl Into<String>, caption: impl Into<String>) -> Self {
        let grid = Grid::new(TWO_COLUMNS);
        Self { name: name.into(), caption: caption.into(), grid, motion: None, steps: None }
    }

    /// The same with one horizontal axis for all panels of a column.
    pub fn shared_x(mut self) -> Self {
        self.grid.shares[0] = true;
        self
    }

    /// The same with one vertical axis for all panels of a row.
    pub fn shared_y(mut self) -> Self {
        self.grid.shares[1] = true;
        self
    }

    /// The same without the samples of long curves that no drawing shows; a signal to listen to keeps all.
    #[must_use]
    pub fn thinned(mut self) -> Self {
        self.grid.cells.iter_mut().flatten().for_each(Panel::thin);
        self
    }

    /// Whether its lists are as long as they must be and its counts are in range, as those of one that was read must
    /// be.
    pub fn is_whole(&self) -> bool {
        self.grid.is_whole() && self.grid.panels().all(Panel::is_whole)
    }

    /// Whether some panel has a point of data to show.
    pub fn has_data(&self) -> bool {
        self.grid.panels().any(Panel::has_data)
    }

    /// The numbers behind each panel, in reading order.
    pub fn numbers(&self) -> Vec<PanelData> {
        self.grid.panels().map(Panel::data).collect()
    }

    /// The finished drawing, `width_mm` wide or as wide as it is meant to be; in a narrower one panels stand one below
    /// the other.
    ///
    /// # Errors
    /// [`ChartError::Empty`] if no panel has data.
    pub fn to_svg(&self, width_mm: Option<f64>) -> Result<String, ChartError> {
        if !self.has_data() {
            return Err(ChartError::Empty(self.name.clone()));
        }
        let width_mm = width_mm.unwrap_or(self.grid.width_mm);
        let mut svg = Svg::new(&self.name, width_mm * POINTS_PER_MM, 100.0);
        Layout::of(&self.grid, width_mm).draw(&mut svg);
        let title = self.caption.split(['.', ';', ':']).next().unwrap_or_default();
        let describe = |(index, panel): (usize, &Panel)| {
            let name = Some(&panel.caption).filter(|caption| !caption.is_empty());
            let name = name.or(panel.headings.first().map(|heading| &heading.0))?;
            Some(format!(" ({}) {}", letter(index), plain(name)))
        };
        let parts: String = self.grid.panels().enumerate().filter_map(describe).collect();
        Ok(svg.finish(title, &format!("{}{parts}", self.caption)))
    }
}

changed! { Figure:
    /// The same with one more panel.
    panel(panel: Panel) => [grid.cells: [Some(panel)]]
    /// The same with more panels.
    panels(panels: impl IntoIterator<Item = Panel>) => [grid.cells: panels.into_iter().map(Some)]
    /// The same with the panel, or with its place left free where there is none.
    panel_or_gap(panel: Option<Panel>) => [grid.cells: [panel]]
    /// The same with a line of remarks below, in mark-up.
    note(note: impl Into<String>) => [grid.notes: [note.into()]]
    /// The same under another name.
    named(name: impl Into<String>) => { name: name.into() }
    /// The same for one column of a page.
    narrow() => { grid.width_mm: ONE_COLUMN }
    /// The same with so many panels in a row.
    columns(columns: usize) => { grid.columns: columns.max(1) }
    /// The same with columns of these relative widths.
    weighted(weights: &[f64]) => {
        grid.weights: weights.to_vec(), grid.columns: weights.len().max(1)
    }
    /// The same without letters on its panels.
    unlettered() => { grid.has_letters: false }
    /// The same with one scale of colours for all panels below them, over the given ends of an axis.
    colour_foot(axis: Axis, map: ColourMap) => { grid.foot: Some(Colours::over(axis, map, &[])) }
    /// The same with a body that moves, where the figure is read with scripts.
    motion(motion: Motion) => { motion: Some(motion) }
    /// The same with points of the first panel that move with a parameter, where the figure is read with scripts.
    steps(steps: Steps) => { steps: Some(steps) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Drawing, Fill, INK, Line, SERIES, WIDEST};

    /// A vibration of so many samples over one second, with a spike, its range and a signal to listen to.
    fn figure(samples: usize) -> Figure {
        let times: Vec<f64> = (0..samples).map(|i| i as f64 / samples as f64).collect();
        let mut values: Vec<f64> =
            times.iter().map(|t| (900.0 * t).sin() * (7e4 * t).cos()).collect();
        values[samples / 3] = 2.0;
        let panel = Panel::new(Axis::time(), Axis::new("value", ""))
            .layer(Fill::range_of(&times, &values, INK).opacity(0.2))
            .layer(Fill::from(0.0, &times, &times, SERIES[2]).opacity(0.2).name("area"))
            .layer(Line::new(&times, &values).solid(SERIES[0], 0.5).name("all"))
            .layer(Line::new(&times, &times).solid(SERIES[1], 0.5).whole());
        Figure::new("long", "A long line.").panel(panel)
    }

    #[test]
    fn a_thinned_figure_is_the_same_picture_with_a_fraction_of_the_numbers() {
        let [whole, thinned] = [figure(200_000), figure(200_000).thinned()];
        let counts = |figure: &Figure| -> Vec<usize> {
            figure.numbers()[0].series.iter().map(|series| series.xs.len()).collect()
        };
        // The area, the line, the signal.
        assert_eq!(counts(&whole), [200_000; 3]);
        let [area, line, signal] = counts(&thinned)[..] else { panic!("three series") };
        assert!(signal == 200_000 && area < 60_000 && line < 60_000, "{area} {line}");
        // Light of each square of a millimetre: within a column the order of its extremes may be another.
        let squares = |figure: &Figure, width: f64| -> Vec<f64> {
            let drawing = Drawing::parse(&figure.to_svg(Some(width)).unwrap()).unwrap();
            let png = drawing.to_png(8.0 * 25.4).unwrap();
            let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            let frame = reader.next_frame(&mut pixels).unwrap();
            let (row, of_pixel) = (frame.line_size, frame.line_size / frame.width as usize);
            let mut sums = vec![0.0; row.div_ceil(8 * of_pixel) * pixels.len().div_ceil(8 * row)];
            for (place, value) in pixels.iter().enumerate() {
                let square =
                    place / row / 8 * row.div_ceil(8 * of_pixel) + place % row / (8 * of_pixel);
                sums[square] += f64::from(*value) / (64.0 * 255.0 * of_pixel as f64);
            }
            sums
        };
        // A dense band of strokes may be a tenth lighter or darker somewhere.
        for width in [85.0, WIDEST] {
            let [one, other] = [&whole, &thinned].map(|figure| squares(figure, width));
            let off = one.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(one.len() == other.len() && off < 0.1, "{width} mm: {off}");
        }
    }

    #[test]
    fn a_figure_of_a_usual_run_keeps_every_number() {
        let [whole, thinned] = [figure(25_000), figure(25_000).thinned()];
        assert!(format!("{:?}", thinned.numbers()) == format!("{:?}", whole.numbers()));
    }
}
