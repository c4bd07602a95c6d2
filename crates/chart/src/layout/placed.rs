//! What stands above the data area of a panel, and the room that it takes.

use super::Placed;
use crate::prelude::*;

/// Height of a line of caption, points.
const CAPTION_STEP: f64 = 8.5;
/// Size of headings, points.
const HEADING_SIZE: f64 = 7.5;
/// Room that the letter of a panel takes, points.
const LETTER_WIDTH: f64 = 18.0;

impl Placed<'_> {
    /// Height of the data area by itself, points.
    pub(super) fn height(&self) -> f64 {
        let panel = self.panel;
        match panel.is_plane {
            true => panel.height.min(self.frame.area.width * self.aspect()),
            false => panel.height,
        }
    }

    fn aspect(&self) -> f64 {
        let length = |ruler: &Ruler| ruler.ends().1 - ruler.ends().0;
        length(&self.frame.y) / length(&self.frame.x)
    }

    /// Shrinks the area of a plane about its middle until its units are equal.
    pub(super) fn make_equal(&mut self) {
        if self.panel.is_plane {
            let (aspect, area) = (self.aspect(), &mut self.frame.area);
            let width = area.width.min(area.height / aspect);
            area.x += 0.5 * (area.width - width);
            area.width = width;
            area.height = width * aspect;
        }
    }

    /// Lines of its caption, beside a letter.
    fn caption_lines(&self) -> Vec<String> {
        match self.panel.caption.as_str() {
            "" => Vec::new(),
            caption => text::wrapped(caption, LABEL_SIZE, self.part.1 - LETTER_WIDTH),
        }
    }

    /// Lines of its headings with their colours; a letter at the left stands in the same line.
    fn heading_lines(&self, has_letter: bool) -> Vec<(String, Colour)> {
        let wrapped = |(line, colour): &(String, Colour)| {
            let letters = if has_letter { 2.0 * LETTER_WIDTH } else { 0.0 };
            let room = (self.part.1 - letters).max(LETTER_WIDTH);
            let lines = text::wrapped(line, HEADING_SIZE, room);
            lines.into_iter().map(|line| (line, *colour)).collect::<Vec<_>>()
        };
        self.panel.headings.iter().flat_map(wrapped).collect()
    }

    /// Room right of the caption for a legend in the same line, points.
    pub(super) fn legend_room(&self) -> f64 {
        let caption = text::width(&self.panel.caption, LABEL_SIZE, false);
        self.frame.area.width - caption - 24.0
    }

    /// Room needed above the data area, points.
    pub(super) fn top_need(&self, letters: bool) -> f64 {
        let headings = self.heading_lines(letters).len() as f64 * 1.25 * HEADING_SIZE;
        let lines = self.caption_lines().len().max(usize::from(letters));
        let line = if lines == 0 { 0.0 } else { 9.5 + CAPTION_STEP * (lines - 1) as f64 };
        let legend = match self.legend.width() {
            _ if self.legend.is_empty() => 0.0,
            width if width <= self.legend_room() => LINE_HEIGHT,
            // It has lines of its own.
            _ => line + self.legend.height(self.part.1),
        };
        let head = match self.panel.caption.is_empty() {
            true => headings.max(line).max(legend),
            // Headings stand above a caption.
            false => headings + line.max(legend),
        };
        head + self.panel.rim_height() + if head > 0.0 { 3.0 } else { 0.0 }
    }

    /// Draws letter, caption, headings and the panel's own legend.
    pub(super) fn draw_head(&self, svg: &mut Svg, letter: Option<char>) {
        let (area, panel) = (&self.frame.area, self.panel);
        // Texts begin where the part of the row does, which of a picture of the plane is left of its area.
        let left = if panel.is_plane { self.part.0 } else { area.x };
        let mut baseline = area.y - 3.5 - panel.rim_height();
        if !self.legend.is_empty() {
            if self.legend.width() <= self.legend_room() {
                let x = area.right() - self.legend.width() + 9.0;
                self.legend.draw(svg, (x, baseline - 7.5), self.legend.width());
            } else {
                let height = self.legend.height(self.part.1);
                let place = (left, baseline + 1.5 - height);
                self.legend.draw(svg, place, self.part.1);
                baseline -= height;
            }
        }
        let captions = self.caption_lines();
        let first = baseline - CAPTION_STEP * captions.len().saturating_sub(1) as f64;
        let headings = self.heading_lines(letter.is_some());
        let lines = headings.len();
        let last = if captions.is_empty() { baseline } else { first - 9.5 };
        for (row, (line, colour)) in headings.iter().enumerate() {
            let y = last - (lines - 1 - row) as f64 * 1.25 * HEADING_SIZE;
            let style = TextStyle::new(HEADING_SIZE).coloured(*colour);
            svg.centred(area.x + 0.5 * area.width, y, line, &style);
        }
        if let Some(letter) = letter {
            let style = TextStyle::new(8.0).bold();
            svg.text(left, first, &format!("({letter})"), &style);
        }
        let x = left + if letter.is_some() { LETTER_WIDTH } else { 0.0 };
        for (row, line) in captions.iter().enumerate() {
            let y = first + CAPTION_STEP * row as f64;
            svg.text(x, y, line, &TextStyle::new(LABEL_SIZE));
        }
    }
}
