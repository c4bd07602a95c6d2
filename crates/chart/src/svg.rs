//! A small SVG writer: shapes, text, embedded images, clips and gradients, nothing else.
//!
//! One user unit is one typographic point (1/72 inch). Coordinates are written with two decimals,
//! so equal input gives equal bytes.

use super::text::{FONT_FAMILY, SCRIPT_SIZE, parse};
use crate::prelude::*;
use base64::prelude::{BASE64_STANDARD, Engine};
use std::collections::HashMap;
use std::fmt::{Display, Write};

/// Points for each millimetre.
pub const POINTS_PER_MM: f64 = 72.0 / 25.4;

/// Start of every id in a drawing, so that a page can tell those of several drawings apart.
pub const ID_PREFIX: &str = "figure-id-";

/// An axis-parallel rectangle, `y` downwards, points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub x: f64,
    /// Upper edge.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

impl Rect {
    /// Rectangle from its upper left corner and size.
    pub fn new(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self { x, y, width, height }
    }

    /// Right edge.
    pub fn right(&self) -> f64 {
        self.x + self.width
    }

    /// Lower edge.
    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }

    /// Place and size as an element has them.
    fn attributes(&self) -> String {
        let [x, y, width, height] = [self.x, self.y, self.width, self.height].map(number);
        format!(r#"x="{x}" y="{y}" width="{width}" height="{height}""#)
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stroke {
    /// Its colour.
    pub colour: Colour,
    /// Width, points.
    pub width: f64,
    /// Dashes and gaps, points, up to the first zero; zeros for a full line.
    pub dash: [f64; 4],
    /// 0 transparent to 1 opaque.
    pub opacity: f64,
}

impl Stroke {
    /// A full opaque line.
    pub fn solid(colour: impl Into<Colour>, width: f64) -> Self {
        Self { colour: colour.into(), width, dash: [0.0; 4], opacity: 1.0 }
    }

    /// A dashed opaque line.
    pub fn dashed(colour: impl Into<Colour>, width: f64) -> Self {
        Self::solid(colour, width).dashes(&[3.0, 2.0])
    }

    /// A dotted opaque line.
    pub fn dotted(colour: impl Into<Colour>, width: f64) -> Self {
        Self::solid(colour, width).dashes(&[1.0, 1.6])
    }

    /// Whether it is no full line.
    pub fn is_dashed(&self) -> bool {
        self.dash[0] > 0.0
    }

    fn attributes(&self) -> String {
        let (colour, width) = (self.colour, number(self.width));
        let mut out = format!(r#" fill="none" stroke="{colour}" stroke-width="{width}""#);
        if self.is_dashed() {
            let parts = self.dash.iter().take_while(|&&length| length > 0.0);
            let parts: Vec<String> = parts.map(|&length| number(length)).collect();
            let _ = write!(out, r#" stroke-dasharray="{}""#, parts.join(" "));
        }
        if self.opacity < 1.0 {
            let _ = write!(out, r#" stroke-opacity="{}""#, number(self.opacity));
        }
        out
    }
}

changed! { Stroke:
    /// The same line with at most four dashes and gaps.
    dashes(pattern: &[f64]) => {
        dash: std::array::from_fn(|at| pattern.get(at).copied().unwrap_or(0.0))
    }
    /// The same line with another opacity.
    with_opacity(opacity: f64) => { opacity: opacity }
}

/// A coordinate with at most two decimals and no trailing zeros.
fn number(value: f64) -> String {
    let hundredths = (value * 100.0).round();
    if !hundredths.is_finite() || hundredths == 0.0 {
        return "0".into();
    }
    let text = format!("{:.2}", hundredths / 100.0);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Text with the five XML specials escaped.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // XML 1.0 forbids the other control characters even as references.
            c if c.is_control() && c != '\n' && c != '\t' => out.push(' '),
            // Nor has it these two, which are no characters.
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// An SVG document under construction.
#[derive(Clone, Debug, Default)]
pub struct Svg {
    width: f64,
    pub(crate) height: f64,
    prefix: String,
    definitions: String,
    body: String,
    ids: usize,
    /// Images by their size, look and bytes, with the id and the place of each.
    images: HashMap<String, (String, f64, f64)>,
}

impl Svg {
    /// An empty white drawing, `width` by `height` points; `name` prefixes its ids, so that several
    /// drawings can share one HTML page.
    pub fn new(name: &str, width: f64, height: f64) -> Self {
        let prefix =
            name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        Self { width, height, prefix, ..Self::default() }
    }

    fn id(&mut self) -> String {
        self.ids += 1;
        format!("{ID_PREFIX}{}-{}", self.prefix, self.ids)
    }

    /// A straight line.
    pub fn line(&mut self, from: (f64, f64), to: (f64, f64), stroke: &Stroke) {
        self.path(&Path::polyline([from, to], false), stroke);
    }

    /// A stroked path.
    pub fn path(&mut self, path: &Path, stroke: &Stroke) {
        self.drawn(path, &stroke.attributes());
    }

    /// Discs of a diameter at points.
    pub fn discs(&mut self, path: &Path, diameter: f64, colour: Colour) {
        let stroke = Stroke::solid(colour, diameter).attributes();
        self.drawn(path, &format!(r#" stroke-linecap="round"{stroke}"#));
    }

    /// A filled path without outline; `opacity` from 0 to 1.
    pub fn fill_path(&mut self, path: &Path, colour: impl Display, opacity: f64) {
        let faint = match opacity < 1.0 {
            true => format!(r#" fill-opacity="{}""#, number(opacity)),
            false => String::new(),
        };
        self.drawn(path, &format!(r#" fill="{colour}"{faint}"#));
    }

    fn drawn(&mut self, path: &Path, look: &str) {
        if !path.is_empty() {
            let _ = writeln!(self.body, r#"<path d="{}"{look}/>"#, path.data);
        }
    }

    /// A filled rectangle with an optional outline.
    pub fn rectangle(&mut self, rect: &Rect, fill: impl Display, stroke: Option<&Stroke>) {
        let place = rect.attributes();
        let _ = write!(self.body, r#"<rect {place} fill="{fill}""#);
        // `Stroke` writes fill="none"; a filled outline needs its own attributes.
        if let Some(Stroke { colour, width, .. }) = stroke {
            let width = number(*width);
            let _ = write!(self.body, r#" stroke="{colour}" stroke-width="{width}""#);
        }
        self.body.push_str("/>\n");
    }

    /// The middle of a text, moved as little as keeps the text on the sheet.
    pub fn on_sheet(&self, middle: f64, markup: &str, size: f64) -> f64 {
        let half = 0.5 * text::width(markup, size, false) + 1.0;
        middle.min(self.width - half).max(half)
    }

    /// Text about the middle of its baseline, moved as little as keeps it on the sheet.
    pub fn centred(&mut self, middle: f64, y: f64, markup: &str, style: &TextStyle) {
        let middle = self.on_sheet(middle, markup, style.size);
        self.text(middle, y, markup, &style.anchored(Anchor::Middle));
    }

    /// Text at a baseline point; see `text::parse` for its mark-up.
    pub fn text(&mut self, x: f64, y: f64, markup: &str, style: &TextStyle) {
        let out = &mut self.body;
        let (x, y) = (number(x), number(y));
        let _ = write!(out, r#"<text x="{x}" y="{y}" font-size="{}""#, number(style.size));
        match style.anchor {
            Anchor::Start => {}
            Anchor::Middle => out.push_str(r#" text-anchor="middle""#),
            Anchor::End => out.push_str(r#" text-anchor="end""#),
        }
        if style.rotation != 0.0 {
            let _ = write!(out, r#" transform="rotate({} {x} {y})""#, number(style.rotation));
        }
        if style.bold {
            out.push_str(r#" font-weight="bold""#);
        }
        if style.halo {
            out.push_str(r##" stroke="#ffffff" stroke-width="1.6" paint-order="stroke""##);
        }
        let _ = write!(out, r#" fill="{}">"#, style.colour);
        let mut raised = 0.0;
        for run in parse(markup) {
            let target =
                -f64::from(run.shift) * style.size * if run.shift > 0 { 0.36 } else { 0.2 };
            let step: f64 = target - raised;
            raised = target;
            if step == 0.0 && run.shift == 0 && !run.italic {
                out.push_str(&escape(&run.text));
                continue;
            }
            out.push_str("<tspan");
            if step != 0.0 {
                let _ = write!(out, r#" dy="{}""#, number(step));
            }
            if run.shift != 0 {
                let _ = write!(out, r#" font-size="{}""#, number(style.size * SCRIPT_SIZE));
            }
            if run.italic && !style.bold {
                out.push_str(r#" font-style="italic""#);
            }
            let _ = write!(out, ">{}</tspan>", escape(&run.text));
        }
        out.push_str("</text>\n");
    }

    /// A PNG image stretched over a rectangle; `pixelated` keeps its pixels sharp. One that is there again is the first
    /// one moved.
    pub fn image(&mut self, rect: &Rect, png: &[u8], pixelated: bool) {
        let look = if pixelated { r#" style="image-rendering:pixelated""# } else { "" };
        let (place, own) = (rect.attributes(), BASE64_STANDARD.encode(png));
        let key = format!("{} {}{look}{own}", number(rect.width), number(rect.height));
        if let Some((id, x, y)) = self.images.get(&key) {
            let (x, y) = (number(rect.x - x), number(rect.y - y));
            let _ = writeln!(self.body, r##"<use xlink:href="#{id}" x="{x}" y="{y}"/>"##);
            return;
        }
        let id = self.id();
        let _ = writeln!(
            self.body,
            r#"<image id="{id}" {place} preserveAspectRatio="none"{look} xlink:href="data:image/png;base64,{own}"/>"#
        );
        self.images.insert(key, (id, rect.x, rect.y));
    }

    /// Clips everything up to [`Svg::end_group`] to a rectangle.
    pub fn begin_clip(&mut self, rect: &Rect) {
        let (id, place) = (self.id(), rect.attributes());
        let clip = format!(r#"<clipPath id="{id}"><rect {place}/></clipPath>"#);
        let _ = writeln!(self.definitions, "{clip}");
        let _ = writeln!(self.body, r##"<g clip-path="url(#{id})">"##);
    }

    /// Ends a group.
    pub fn end_group(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// The finished document, with a title and a description for readers who cannot see it.
    pub fn finish(&self, title: &str, description: &str) -> String {
        let (width, height) = (number(self.width), number(self.height));
        let (prefix, family) = (&self.prefix, FONT_FAMILY);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
             width=\"{width}pt\" height=\"{height}pt\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-labelledby=\"{ID_PREFIX}{prefix}-title {ID_PREFIX}{prefix}-desc\" font-family=\"{family}\" \
             stroke-linejoin=\"round\">\n\
             <title id=\"{ID_PREFIX}{prefix}-title\">{}</title>\n<desc id=\"{ID_PREFIX}{prefix}-desc\">{}</desc>\n\
             <defs>\n{}</defs>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            escape(&plain(title)),
            escape(&plain(description)),
            self.definitions,
            self.body
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_that_is_there_again_is_the_first_one_moved() {
        let mut svg = Svg::new("name", 100.0, 50.0);
        for (x, pixels) in [(0.0, b"one"), (10.0, b"one"), (20.0, b"two")] {
            svg.image(&Rect::new(x, 5.0, 8.0, 8.0), pixels, false);
        }
        let text = svg.finish("", "");
        assert_eq!(text.matches("data:image/png").count(), 2);
        let again = "<use xlink:href=\"#figure-id-name-1\" x=\"10\" y=\"0\"/>";
        assert_eq!(text.matches(again).count(), 1, "{text}");
    }
}
