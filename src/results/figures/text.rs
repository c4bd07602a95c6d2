//! Text: the embedded font, its widths, and a small mark-up for symbols and indices.

use super::svg::{escape, number};
use std::fmt::Write;
use std::sync::OnceLock;

/// Font families named in every drawing; the first is embedded in this program for PNG output,
/// the next has nearly the same widths.
pub const FONT_FAMILY: &str = "DejaVu Sans,Verdana,sans-serif";

/// The embedded faces: regular, bold, oblique.
pub const FACES: [&[u8]; 3] = [
    include_bytes!("../../chart/font/DejaVuSans.ttf"),
    include_bytes!("../../chart/font/DejaVuSans-Bold.ttf"),
    include_bytes!("../../chart/font/DejaVuSans-Oblique.ttf"),
];

/// Size of sub- and superscripts relative to the text.
const SCRIPT_SIZE: f64 = 0.72;

/// Which point of the text its position names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The left end.
    Start,
    /// The middle.
    Middle,
    /// The right end.
    End,
}

/// How text is set.
#[derive(Clone, Debug, PartialEq)]
pub struct TextStyle {
    /// Size, points.
    pub size: f64,
    /// Anchor.
    pub anchor: Anchor,
    /// Rotation about its position, degrees clockwise.
    pub rotation: f64,
    /// Colour.
    pub colour: String,
    /// Bold face.
    pub bold: bool,
    /// A white outline that keeps text readable over data.
    pub halo: bool,
}

impl TextStyle {
    /// Regular dark text, left-aligned.
    pub fn new(size: f64) -> Self {
        Self {
            size,
            anchor: Anchor::Start,
            rotation: 0.0,
            colour: super::colour::INK.into(),
            bold: false,
            halo: false,
        }
    }

    /// The same with another anchor.
    pub fn anchored(mut self, anchor: Anchor) -> Self {
        self.anchor = anchor;
        self
    }

    /// The same, rotated (degrees clockwise).
    pub fn rotated(mut self, degrees: f64) -> Self {
        self.rotation = degrees;
        self
    }

    /// The same in another colour.
    pub fn coloured(mut self, colour: &str) -> Self {
        self.colour = colour.into();
        self
    }

    /// The same in bold.
    pub fn bold(mut self) -> Self {
        self.bold = true;
        self
    }

    /// The same with a white outline.
    pub fn with_halo(mut self) -> Self {
        self.halo = true;
        self
    }
}

/// A stretch of text in one style.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Its characters.
    pub text: String,
    /// Oblique face, for quantities.
    pub italic: bool,
    /// -1 subscript, +1 superscript, 0 on the line.
    pub shift: i8,
}

/// Splits mark-up into runs: `*x*` is oblique, `_{..}` a subscript, `^{..}` a superscript, and a
/// backslash takes the next character literally.
pub fn parse(markup: &str) -> Vec<Run> {
    let mut runs = Vec::new();
    let (mut italic, mut shift, mut current) = (false, 0i8, String::new());
    let mut chars = markup.chars().peekable();
    let flush = |current: &mut String, italic: bool, shift: i8, runs: &mut Vec<Run>| {
        if !current.is_empty() {
            runs.push(Run {
                text: std::mem::take(current),
                italic,
                shift,
            });
        }
    };
    while let Some(c) = chars.next() {
        match c {
            '\\' => current.extend(chars.next()),
            '*' => {
                flush(&mut current, italic, shift, &mut runs);
                italic = !italic;
            }
            '_' | '^' if chars.peek() == Some(&'{') => {
                chars.next();
                flush(&mut current, italic, shift, &mut runs);
                shift = if c == '^' { 1 } else { -1 };
            }
            '}' if shift != 0 => {
                flush(&mut current, italic, shift, &mut runs);
                shift = 0;
            }
            c => current.push(c),
        }
    }
    flush(&mut current, italic, shift, &mut runs);
    runs
}

/// Mark-up that shows `text` literally.
pub fn literal(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if matches!(c, '\\' | '*' | '_' | '^' | '}') {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// Mark-up without its marks.
pub fn plain(markup: &str) -> String {
    parse(markup).into_iter().map(|run| run.text).collect()
}

/// Width of a line of mark-up, points.
pub fn width(markup: &str, size: f64, bold: bool) -> f64 {
    parse(markup)
        .iter()
        .map(|run| {
            let face = match (bold, run.italic) {
                (true, _) => 1,
                (false, true) => 2,
                (false, false) => 0,
            };
            let scale = if run.shift == 0 { 1.0 } else { SCRIPT_SIZE };
            run.text.chars().map(|c| advance(face, c)).sum::<f64>() * scale * size
        })
        .sum()
}

/// Writes a `<text>` element.
pub(super) fn write(out: &mut String, x: f64, y: f64, markup: &str, style: &TextStyle) {
    let (x, y) = (number(x), number(y));
    let _ = write!(
        out,
        r#"<text x="{x}" y="{y}" font-size="{}""#,
        number(style.size)
    );
    match style.anchor {
        Anchor::Start => {}
        Anchor::Middle => out.push_str(r#" text-anchor="middle""#),
        Anchor::End => out.push_str(r#" text-anchor="end""#),
    }
    if style.rotation != 0.0 {
        let _ = write!(
            out,
            r#" transform="rotate({} {x} {y})""#,
            number(style.rotation)
        );
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
        let target = -f64::from(run.shift) * style.size * if run.shift > 0 { 0.36 } else { 0.2 };
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

/// Advance widths of one face, by character, in em.
struct Advances {
    sorted: Vec<(u32, f64)>,
    fallback: f64,
}

fn advance(face: usize, character: char) -> f64 {
    static TABLES: OnceLock<[Advances; 3]> = OnceLock::new();
    let tables =
        TABLES.get_or_init(|| FACES.map(|font| read_advances(font).unwrap_or(Advances::unknown())));
    let table = &tables[face];
    table
        .sorted
        .binary_search_by_key(&(character as u32), |entry| entry.0)
        .map_or(table.fallback, |index| table.sorted[index].1)
}

impl Advances {
    fn unknown() -> Self {
        Self {
            sorted: Vec::new(),
            fallback: 0.6,
        }
    }
}

/// Reads character widths from a TrueType file: `cmap` format 4 gives the glyph, `hmtx` its advance
/// (OpenType specification 1.9).
fn read_advances(font: &[u8]) -> Option<Advances> {
    let u16_at = |at: usize| Some(u16::from_be_bytes(font.get(at..at + 2)?.try_into().ok()?));
    let u32_at = |at: usize| Some(u32::from_be_bytes(font.get(at..at + 4)?.try_into().ok()?));
    let table = |tag: &[u8; 4]| {
        (0..u16_at(4)? as usize)
            .map(|index| 12 + 16 * index)
            .find(|&record| font.get(record..record + 4) == Some(tag))
            .and_then(|record| Some(u32_at(record + 8)? as usize))
    };
    let em = f64::from(u16_at(table(b"head")? + 18)?);
    let metric_count = u16_at(table(b"hhea")? + 34)? as usize;
    let metrics = table(b"hmtx")?;
    let advance_of = |glyph: usize| {
        let entry = glyph.min(metric_count.saturating_sub(1));
        Some(f64::from(u16_at(metrics + 4 * entry)?) / em)
    };
    let cmap = table(b"cmap")?;
    let subtable = (0..u16_at(cmap + 2)? as usize)
        .filter_map(|index| Some(cmap + u32_at(cmap + 8 + 8 * index)? as usize))
        .find(|&at| u16_at(at) == Some(4))?;
    let segments = u16_at(subtable + 6)? as usize / 2;
    let mut sorted = Vec::new();
    for segment in 0..segments {
        let end_at = subtable + 14 + 2 * segment;
        let start_at = end_at + 2 + 2 * segments;
        let (end, start) = (u16_at(end_at)?, u16_at(start_at)?);
        let delta = u16_at(start_at + 2 * segments)?;
        let range_at = start_at + 4 * segments;
        let range = u16_at(range_at)? as usize;
        for code in start..=end.min(0xfffe) {
            let glyph = if range == 0 {
                code.wrapping_add(delta)
            } else {
                u16_at(range_at + range + 2 * (code - start) as usize)?
            };
            sorted.push((u32::from(code), advance_of(glyph as usize)?));
        }
    }
    Some(Advances {
        sorted,
        fallback: advance_of(0)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_embedded_face_gives_character_widths() {
        for (face, font) in FACES.iter().enumerate() {
            assert!(!read_advances(font).unwrap().sorted.is_empty());
            // DejaVu's own figure width is 1303/2048 em upright, 1425/2048 em bold.
            let digit = if face == 1 { 1425.0 } else { 1303.0 } / 2048.0;
            assert!((advance(face, '0') - digit).abs() < 1e-12);
            assert!(advance(face, 'i') < advance(face, 'm'));
        }
        for symbol in "μζλαβθωΩδπ²³⁻−×→±°≤".chars() {
            assert_ne!(advance(0, symbol), advance(0, '\u{e000}'), "{symbol}");
        }
    }

    #[test]
    fn markup_splits_into_symbols_and_indices() {
        let runs = parse("*μ*_{c} = 10^{-3}");
        let view: Vec<_> = runs
            .iter()
            .map(|r| (r.text.as_str(), r.italic, r.shift))
            .collect();
        assert_eq!(
            view,
            [
                ("μ", true, 0),
                ("c", false, -1),
                (" = 10", false, 0),
                ("-3", false, 1)
            ]
        );
    }

    #[test]
    fn literal_text_survives_the_markup() {
        let nasty = r"a*b_{c}^{d}\e";
        assert_eq!(plain(&literal(nasty)), nasty);
    }
}
