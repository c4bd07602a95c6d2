//! Text: the embedded font, its widths, and a small mark-up for symbols and indices.

use crate::prelude::*;
use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};
use std::sync::LazyLock;

/// Font families named in every drawing; the first is embedded in this program for PNG output,
/// the next has nearly the same widths.
pub const FONT_FAMILY: &str = "DejaVu Sans,Verdana,sans-serif";

/// The embedded faces: regular, bold, oblique.
pub const FACES: [&[u8]; 3] = [
    include_bytes!("font/DejaVuSans.ttf"),
    include_bytes!("font/DejaVuSans-Bold.ttf"),
    include_bytes!("font/DejaVuSans-Oblique.ttf"),
];

/// Size of sub- and superscripts relative to the text.
pub(super) const SCRIPT_SIZE: f64 = 0.72;

/// Which point of the text its position names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Anchor {
    /// The left end.
    Start,
    /// The middle.
    Middle,
    /// The right end.
    End,
}

/// How text is set.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TextStyle {
    /// Size, points.
    pub size: f64,
    /// Anchor.
    pub anchor: Anchor,
    /// Rotation about its position, degrees clockwise.
    pub rotation: f64,
    /// Colour.
    pub colour: Colour,
    /// Bold face.
    pub bold: bool,
    /// A white outline that keeps text readable over data.
    pub halo: bool,
}

impl TextStyle {
    /// Regular dark text, left-aligned.
    pub fn new(size: f64) -> Self {
        let (anchor, colour) = (Anchor::Start, INK.into());
        Self { size, anchor, rotation: 0.0, colour, bold: false, halo: false }
    }
}

changed! { TextStyle:
    /// The same with another anchor.
    anchored(anchor: Anchor) => { anchor: anchor }
    /// The same, rotated (degrees clockwise).
    rotated(rotation: f64) => { rotation: rotation }
    /// The same in another colour.
    coloured(colour: impl Into<Colour>) => { colour: colour.into() }
    /// The same in bold.
    bold() => { bold: true }
    /// The same with a white outline.
    with_halo() => { halo: true }
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
    let mut runs: Vec<Run> = Vec::new();
    let (mut italic, mut shift) = (false, 0i8);
    let mut chars = markup.chars().peekable();
    while let Some(c) = chars.next() {
        let shown = match c {
            '\\' => chars.next(),
            '*' => {
                italic = !italic;
                None
            }
            '_' | '^' if chars.next_if_eq(&'{').is_some() => {
                shift = if c == '^' { 1 } else { -1 };
                None
            }
            '}' if shift != 0 => {
                shift = 0;
                None
            }
            c => Some(c),
        };
        let Some(c) = shown else { continue };
        match runs.last_mut() {
            Some(run) if (run.italic, run.shift) == (italic, shift) => run.text.push(c),
            _ => runs.push(Run { text: c.into(), italic, shift }),
        }
    }
    runs
}

/// Mark-up that shows `text` literally.
pub fn literal(text: &str) -> String {
    let mark = |c: char| matches!(c, '\\' | '*' | '_' | '^' | '}').then_some('\\');
    text.chars().flat_map(|c| mark(c).into_iter().chain([c])).collect()
}

/// Mark-up without its marks.
pub fn plain(markup: &str) -> String {
    parse(markup).into_iter().map(|run| run.text).collect()
}

/// Mark-up in lines of at most `width` points, broken at spaces; a word that is longer has a line of its own.
pub(super) fn wrapped(markup: &str, size: f64, most: f64) -> Vec<String> {
    if width(markup, size, false) <= most {
        return vec![markup.to_owned()];
    }
    let mut lines: Vec<String> = Vec::new();
    for word in words(markup) {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size, false) <= most => {
                *line += &format!(" {word}");
            }
            _ => lines.push(word),
        }
    }
    lines
}

/// The words of mark-up, each with marks of its own; spaces in sub- and superscripts part none.
fn words(markup: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    for Run { text, italic, shift } in parse(markup) {
        let mark = if italic { "*" } else { "" };
        for (index, part) in text.split(|c| c == ' ' && shift == 0).enumerate() {
            if index > 0 {
                words.push(String::new());
            }
            let (part, last) = (literal(part), words.len() - 1);
            words[last] += &match shift {
                _ if part.is_empty() => continue,
                0 => format!("{mark}{part}{mark}"),
                1.. => format!("{mark}^{{{part}}}{mark}"),
                ..0 => format!("{mark}_{{{part}}}{mark}"),
            };
        }
    }
    words.retain(|word| !word.is_empty());
    words
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

/// Advance width of a character in one face, em; 0.6 where the face does not tell.
fn advance(face: usize, character: char) -> f64 {
    static FONTS: LazyLock<[Option<FontRef<'static>>; 3]> =
        LazyLock::new(|| FACES.map(|face| FontRef::new(face).ok()));
    let width = |font: &FontRef<'static>| {
        let glyph = font.charmap().map(character).unwrap_or_default();
        let metrics = font.glyph_metrics(Size::new(1.0), LocationRef::default());
        metrics.advance_width(glyph)
    };
    let found = FONTS[face].as_ref().and_then(width);
    found.map_or(0.6, f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_embedded_face_gives_character_widths() {
        for (face, font) in FACES.iter().enumerate() {
            assert!(FontRef::new(font).is_ok());
            // DejaVu's own figure width is 1303/2048 em upright, 1425/2048 em bold.
            let digit = if face == 1 { 1425.0 } else { 1303.0 } / 2048.0;
            assert!((advance(face, '0') - digit).abs() < 1e-6);
            assert!(advance(face, 'i') < advance(face, 'm'));
        }
        for symbol in "μζλαβθωΩδπ²³⁻−×→±°≤".chars() {
            assert_ne!(advance(0, symbol), advance(0, '\u{e000}'), "{symbol}");
        }
    }

    #[test]
    fn markup_splits_into_symbols_and_indices() {
        let runs = parse("*μ*_{c} = 10^{-3}");
        let view: Vec<_> = runs.iter().map(|r| (r.text.as_str(), r.italic, r.shift)).collect();
        assert_eq!(view, [("μ", true, 0), ("c", false, -1), (" = 10", false, 0), ("-3", false, 1)]);
    }

    #[test]
    fn wrapped_text_keeps_its_words_and_their_marks() {
        let text = "damping *ζ over ω* = (*α*_{R}/*ω* + *β*_{R}*ω*)/2 of the disc\\*";
        let lines = wrapped(text, 7.0, 60.0);
        assert!(lines.len() > 2, "{lines:?}");
        assert!(lines.iter().all(|line| width(line, 7.0, false) <= 60.0));
        let joined: Vec<String> = lines.iter().map(|line| plain(line)).collect();
        assert_eq!(joined.join(" "), plain(text));
        assert_eq!(wrapped(text, 7.0, 1e3), [text]);
    }

    #[test]
    fn literal_text_survives_the_markup() {
        let nasty = r"a*b_{c}^{d}\e";
        assert_eq!(plain(&literal(nasty)), nasty);
    }
}
