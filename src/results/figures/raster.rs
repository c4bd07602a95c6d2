//! Small images inside drawings (heat maps, coloured fields) and whole drawings as PNG.

use super::colour::ColourMap;
use super::{FigureError, text};
use resvg::{tiny_skia, usvg};
use std::sync::{Arc, OnceLock};

/// Colours of a large image; at most 255, as one palette entry stays transparent.
pub const FINE: usize = 192;

/// Colours of one of many small images: few, so that together they stay light.
pub const COARSE: usize = 48;

/// An image of palette indices, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct IndexedImage {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Palette index of each pixel.
    pub pixels: Vec<u8>,
}

/// Palette of `levels` colours of a map, then a last transparent entry.
pub fn map_palette(map: ColourMap, levels: usize) -> Vec<[u8; 4]> {
    let last = (levels - 1) as f64;
    let mut palette: Vec<[u8; 4]> = (0..levels)
        .map(|level| {
            let [red, green, blue] = map.at(level as f64 / last);
            [red, green, blue, 255]
        })
        .collect();
    palette.push([255, 255, 255, 0]);
    palette
}

/// Palette index of a value between `low` and `high`; values that are not finite are transparent.
pub fn level_of(value: f64, low: f64, high: f64, levels: usize) -> u8 {
    if !value.is_finite() {
        return levels as u8;
    }
    let position = (value - low) / (high - low) * levels as f64;
    position.clamp(0.0, (levels - 1) as f64) as u8
}

impl IndexedImage {
    /// The image as PNG bytes with the given palette (red, green, blue, opacity).
    ///
    /// # Errors
    /// [`FigureError::Encoding`] if the pixels do not fit the size.
    pub fn encode(&self, palette: &[[u8; 4]]) -> Result<Vec<u8>, FigureError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.set_filter(png::Filter::NoFilter);
        encoder.set_palette(
            palette
                .iter()
                .flat_map(|c| [c[0], c[1], c[2]])
                .collect::<Vec<u8>>(),
        );
        encoder.set_trns(palette.iter().map(|c| c[3]).collect::<Vec<u8>>());
        let mut writer = encoder.write_header().map_err(encoding)?;
        writer.write_image_data(&self.pixels).map_err(encoding)?;
        writer.finish().map_err(encoding)?;
        Ok(bytes)
    }
}

fn encoding(error: png::EncodingError) -> FigureError {
    FigureError::Encoding(error.to_string())
}

/// Base64 with padding (RFC 4648, section 4).
pub fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let group = (0..3).fold(0u32, |sum, i| {
            sum << 8 | u32::from(chunk.get(i).copied().unwrap_or(0))
        });
        for i in 0..4 {
            if i <= chunk.len() {
                out.push(ALPHABET[(group >> (18 - 6 * i)) as usize & 63] as char);
            } else {
                out.push('=');
            }
        }
    }
    out
}

/// Draws an SVG of this module as PNG, with the embedded font alone.
///
/// `dots_per_inch` 300 suits print; one point becomes `dots_per_inch / 72` pixels.
///
/// # Errors
/// [`FigureError::Parse`] if the SVG is malformed, [`FigureError::Size`] if the image would be
/// empty or larger than 100 million pixels.
pub fn render_png(svg: &str, dots_per_inch: f64) -> Result<Vec<u8>, FigureError> {
    let options = usvg::Options {
        font_family: "DejaVu Sans".into(),
        fontdb: fonts(),
        ..usvg::Options::default()
    };
    let tree =
        usvg::Tree::from_str(svg, &options).map_err(|e| FigureError::Parse(e.to_string()))?;
    // usvg has turned points into pixels at 96 for each inch.
    let scale = (dots_per_inch / 96.0) as f32;
    let (width, height) = (tree.size().width() * scale, tree.size().height() * scale);
    let size = FigureError::Size {
        width: f64::from(width),
        height: f64::from(height),
    };
    if f64::from(width) * f64::from(height) > 1e8 {
        return Err(size);
    }
    let mut pixmap =
        tiny_skia::Pixmap::new(width.round() as u32, height.round() as u32).ok_or(size)?;
    // The rim pixels may be covered in part only.
    pixmap.fill(tiny_skia::Color::WHITE);
    let transform = tiny_skia::Transform::from_scale(scale, scale);
    resvg::render(&tree, transform, &mut pixmap.as_mut());
    encode_opaque(&pixmap)
}

/// Drawings have a white ground, so the alpha channel is dropped.
fn encode_opaque(pixmap: &tiny_skia::Pixmap) -> Result<Vec<u8>, FigureError> {
    let rgb: Vec<u8> = pixmap
        .data()
        .chunks_exact(4)
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
        .collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, pixmap.width(), pixmap.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    let mut writer = encoder.write_header().map_err(encoding)?;
    writer.write_image_data(&rgb).map_err(encoding)?;
    writer.finish().map_err(encoding)?;
    Ok(bytes)
}

fn fonts() -> Arc<usvg::fontdb::Database> {
    static FONTS: OnceLock<Arc<usvg::fontdb::Database>> = OnceLock::new();
    FONTS
        .get_or_init(|| {
            let mut database = usvg::fontdb::Database::new();
            for face in text::FACES {
                database.load_font_data(face.to_vec());
            }
            database.set_sans_serif_family("DejaVu Sans");
            Arc::new(database)
        })
        .clone()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_reproduces_the_examples_of_rfc_4648() {
        for (plain, coded) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn levels_span_the_range_and_mark_missing_values() {
        assert_eq!(level_of(0.0, 0.0, 2.0, 48), 0);
        assert_eq!(level_of(2.0, 0.0, 2.0, 48), 47);
        assert_eq!(level_of(-5.0, 0.0, 2.0, 48), 0);
        assert_eq!(level_of(f64::NAN, 0.0, 2.0, 48), 48);
        assert_eq!(map_palette(ColourMap::Viridis, 48)[48][3], 0);
    }

    #[test]
    fn malformed_drawings_are_errors() {
        assert!(matches!(
            render_png("<svg", 96.0),
            Err(FigureError::Parse(_))
        ));
    }
}
