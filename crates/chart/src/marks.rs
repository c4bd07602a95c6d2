//! Rules and labels that data are compared with.

use crate::prelude::*;

/// A line across the panel at one value.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Rule {
    pub(super) value: f64,
    pub(super) is_horizontal: bool,
    stroke: Stroke,
    stretches: bool,
    pub(super) name: Option<String>,
    beside: Option<String>,
    /// Its text beyond the frame: of a horizontal one at the right, else above.
    pub(super) rim: Option<String>,
}

impl Rule {
    fn new(value: f64, is_horizontal: bool) -> Self {
        let stroke = Stroke::dashed(INK, 0.8);
        Self { value, is_horizontal, stroke, stretches: false, name: None, beside: None, rim: None }
    }

    /// A dashed line at an ordinate; it is left out where the axis does not reach it.
    pub fn horizontal(value: f64) -> Self {
        Self::new(value, true)
    }

    /// A dashed line at an abscissa.
    pub fn vertical(value: f64) -> Self {
        Self::new(value, false)
    }

    /// Where it lies in the drawing, if the axis reaches it.
    fn place(&self, frame: &Frame) -> Option<f64> {
        let (ruler, at) = match self.is_horizontal {
            true => (&frame.y, frame.at_y(self.value)),
            false => (&frame.x, frame.at_x(self.value)),
        };
        ruler.contains(self.value).then_some(at)
    }
}

changed! { Rule:
    /// The same with an entry in the legend.
    name(name: impl Into<String>) => { name: Some(name.into()) }
    /// The same with a stroke.
    stroke(stroke: Stroke) => { stroke: stroke }
    /// The same, and the axis reaches it.
    stretching() => { stretches: true }
    /// The same with a text along it inside the frame.
    beside(text: impl Into<String>) => { beside: Some(text.into()) }
    /// The same with a text beyond the frame, at the right or above.
    at_rim(text: impl Into<String>) => { rim: Some(text.into()) }
}

impl Layer for Rule {
    fn extent(&self, see: &mut dyn FnMut(f64, f64)) {
        match self.is_horizontal {
            true => see(f64::INFINITY, self.value),
            false => see(self.value, f64::INFINITY),
        }
    }

    fn draw(&self, svg: &mut Svg, frame: &Frame) {
        let (area, Some(at)) = (&frame.area, self.place(frame)) else { return };
        let (from, to) = match self.is_horizontal {
            true => ((area.x, at), (area.right(), at)),
            false => ((at, area.y), (at, area.bottom())),
        };
        svg.line(from, to, &self.stroke);
    }

    fn draw_over(&self, svg: &mut Svg, frame: &Frame) {
        let (Some(text), Some(at)) = (&self.beside, self.place(frame)) else { return };
        let (area, style) = (&frame.area, TextStyle::new(LABEL_SIZE).with_halo());
        match self.is_horizontal {
            true => svg.text(area.x + 4.0, at - 2.5, text, &style),
            false => svg.text(at - 2.5, area.bottom() - 5.0, text, &style.rotated(-90.0)),
        }
    }

    fn keys(&self) -> Vec<(Key, String)> {
        let key = Key::line(self.stroke);
        self.name.iter().map(|name| (key, name.clone())).collect()
    }

    fn is_data(&self) -> bool {
        self.stretches
    }
}

/// Text at a point of the data.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Label {
    pub(super) place: (f64, f64),
    offset: (f64, f64),
    pub(super) text: String,
    style: TextStyle,
}

impl Label {
    /// Text to the right of a point, in mark-up, with a white outline.
    pub fn new(place: (f64, f64), text: impl Into<String>) -> Self {
        let style = TextStyle::new(LABEL_SIZE).with_halo();
        Self { place, offset: (3.0, 2.4), text: text.into(), style }
    }

    /// The same, centred above the point.
    pub fn above(mut self) -> Self {
        self.style = self.style.anchored(Anchor::Middle);
        self.moved(0.0, -4.0)
    }

    /// The baseline point, moved as little as keeps the text off the frame; a text that starts at its point and passes
    /// the right end stands on the other side of it.
    fn inside(&self, frame: &Frame, (x, y): (f64, f64)) -> (f64, f64) {
        let (area, style) = (&frame.area, &self.style);
        let width = text::width(&self.text, style.size, style.bold);
        let left = match style.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * width,
            Anchor::End => width,
        };
        let (lowest, highest) = (area.x + 2.0 + left, area.right() - 2.0 - width + left);
        let x = match style.anchor {
            Anchor::Start if x > highest => x - width - 2.0 * self.offset.0.abs(),
            _ => x,
        };
        let (top, bottom) = (area.y + 1.0 + 0.76 * style.size, area.bottom() - 2.0);
        let within = |value: f64, low: f64, high: f64| {
            if low <= high { value.clamp(low, high) } else { value }
        };
        (within(x, lowest, highest), within(y, top, bottom))
    }
}

changed! { Label:
    /// The same, moved from the point, points right and down.
    moved(right: f64, down: f64) => { offset: (right, down) }
    /// The same in a style.
    style(style: TextStyle) => { style: style }
}

impl Layer for Label {
    fn draw_over(&self, svg: &mut Svg, frame: &Frame) {
        for (x, y) in frame.inside([self.place]) {
            let (x, y) = self.inside(frame, (x + self.offset.0, y + self.offset.1));
            svg.text(x, y, &self.text, &self.style);
        }
    }

    fn is_data(&self) -> bool {
        false
    }
}

/// Moves rising positions apart to at least `gap`, as little as clusters centred on their members allow.
pub(super) fn spread(wanted: &[f64], gap: f64, low: f64, high: f64) -> Vec<f64> {
    let mut clusters: Vec<(f64, usize)> = Vec::new();
    for &position in wanted {
        clusters.push((position, 1));
        while let [.., (a, count_a), (b, count_b)] = clusters[..] {
            if b - a >= 0.5 * gap * (count_a + count_b) as f64 {
                break;
            }
            let count = count_a + count_b;
            let centre = (a * count_a as f64 + b * count_b as f64) / count as f64;
            clusters.truncate(clusters.len() - 2);
            clusters.push((centre, count));
        }
    }
    let places = clusters.into_iter().flat_map(|(centre, count)| {
        let half = 0.5 * gap * (count - 1) as f64;
        let first = (centre - half).max(low).min((high - 2.0 * half).max(low));
        (0..count).map(move |member| first + gap * member as f64)
    });
    places.collect()
}

/// Names the places of rules beyond the frame, without overlap; those at the right inside it where `is_inside`.
pub(super) fn draw_rim_labels(
    svg: &mut Svg,
    frame: &Frame,
    labels: &[(&Rule, &str)],
    is_inside: bool,
) {
    let (leader, style) = (Stroke::solid(MUTED, 0.4), TextStyle::new(RIM_SIZE));
    let area = &frame.area;
    for at_right in [true, false] {
        let own = labels.iter().filter(|(rule, _)| rule.is_horizontal == at_right);
        let own = own.filter_map(|(rule, text)| Some((rule.place(frame)?, *text)));
        let mut own: Vec<(f64, &str)> = own.collect();
        own.sort_by(|a, b| a.0.total_cmp(&b.0));
        if at_right {
            let wanted: Vec<f64> = own.iter().map(|label| label.0).collect();
            let places = spread(&wanted, RIM_SIZE + 1.5, area.y + 3.0, area.bottom() - 2.0);
            for ((y, text), place) in own.into_iter().zip(places) {
                if is_inside {
                    let style = style.anchored(Anchor::End).with_halo();
                    svg.text(area.right() - 3.0, place - 1.0, text, &style);
                    continue;
                }
                svg.line((area.right(), y), (area.right() + 6.0, place), &leader);
                svg.text(area.right() + 7.5, place + 0.36 * RIM_SIZE, text, &style);
            }
        } else {
            let width = |text: &str| text::width(text, RIM_SIZE, false);
            let widest = own.iter().map(|label| width(label.1));
            let gap = widest.fold(4.0, f64::max) + 5.0;
            // More names than have room are left out, the last ones first.
            own.truncate(((area.width / gap) as usize + 1).max(1));
            let wanted: Vec<f64> = own.iter().map(|label| label.0).collect();
            let places = spread(&wanted, gap, area.x, area.right());
            for ((x, text), place) in own.into_iter().zip(places) {
                let place = svg.on_sheet(place, text, RIM_SIZE);
                svg.line((x, area.y), (place, area.y - 4.5), &leader);
                svg.text(place, area.y - 6.0, text, &style.anchored(Anchor::Middle));
            }
        }
    }
}

/// Size of names beyond the frame, points.
pub(super) const RIM_SIZE: f64 = 6.25;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_spread_without_overlap() {
        let places = spread(&[10.0, 10.5, 11.0, 40.0, 80.0], 8.0, 0.0, 100.0);
        assert!(places.windows(2).all(|pair| pair[1] - pair[0] >= 8.0 - 1e-9), "{places:?}");
        assert!(places[3] == 40.0 && (places[1] - 10.5).abs() < 1e-9);
    }
}
