//! Ranges of values shown by colours, and the bars that tell which colour is which value.

use crate::prelude::*;

/// Room that a flat bar needs below its top, points.
pub(super) const FLAT_BAR_HEIGHT: f64 = LABEL_SIZE + TITLE_SIZE + 14.0;

/// A range of values shown by the colours of a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

    fn ruler(&self) -> Ruler {
        let (low, high) = self.range;
        self.axis.clone().between(low, high).resolve(None)
    }

    /// Room that an upright bar needs, points.
    pub(super) fn bar_width(&self, height: f64) -> f64 {
        21.0 + widest(&self.ruler().ticks(vertical_count(height)), LABEL_SIZE) + TITLE_SIZE
    }

    /// Draws an upright bar with its left edge at `x`, over the height of an area: ticks and title at its right.
    pub(super) fn draw_bar(&self, svg: &mut Svg, x: f64, area: &Rect) {
        let ruler = self.ruler();
        let height = area.height.min(150.0);
        let bar = Rect::new(x, area.y + 0.5 * (area.height - height), 6.0, height);
        self.draw_colours(svg, &bar, true);
        let ticks = ruler.ticks(vertical_count(bar.height));
        for tick in &ticks {
            let y = bar.bottom() - bar.height * ruler.place(tick.value);
            svg.line((bar.right(), y), (bar.right() + 2.2, y), &Stroke::solid(INK, 0.5));
            let style = TextStyle::new(LABEL_SIZE);
            svg.text(bar.right() + 4.0, y + 0.36 * LABEL_SIZE, &tick.label, &style);
        }
        let x = bar.right() + 7.0 + widest(&ticks, LABEL_SIZE) + TITLE_SIZE;
        let style = TextStyle::new(TITLE_SIZE).anchored(Anchor::Middle).rotated(-90.0);
        svg.text(x, bar.y + 0.5 * bar.height, &ruler.full_title(), &style);
    }

    fn draw_colours(&self, svg: &mut Svg, bar: &Rect, is_upright: bool) {
        const LEVELS: usize = 128;
        let palette = Palette::of_map(self.map, LEVELS);
        let levels = 0..LEVELS as u8;
        let (width, height, pixels) = match is_upright {
            true => (1, LEVELS, levels.rev().collect()),
            false => (LEVELS, 1, levels.collect()),
        };
        IndexedImage { width, height, pixels }.draw(svg, bar, &palette, false);
        svg.rectangle(bar, "none", Some(&Stroke::solid(INK, 0.5)));
    }

    /// Draws a flat bar: ticks and title below it.
    pub(super) fn draw_flat_bar(&self, svg: &mut Svg, (x, y): (f64, f64), width: f64) {
        let ruler = self.ruler();
        let bar = Rect::new(x, y, width, 5.0);
        self.draw_colours(svg, &bar, false);
        let style = TextStyle::new(LABEL_SIZE).anchored(Anchor::Middle);
        for tick in ruler.ticks((bar.width / 26.0) as usize) {
            let x = bar.x + bar.width * ruler.place(tick.value);
            svg.line((x, bar.bottom()), (x, bar.bottom() + 2.2), &Stroke::solid(INK, 0.5));
            svg.text(x, bar.bottom() + LABEL_SIZE + 3.0, &tick.label, &style);
        }
        let baseline = bar.bottom() + LABEL_SIZE + TITLE_SIZE + 6.0;
        let (middle, title) = (bar.x + 0.5 * bar.width, ruler.full_title());
        svg.centred(middle, baseline, &title, &TextStyle::new(TITLE_SIZE));
    }
}
