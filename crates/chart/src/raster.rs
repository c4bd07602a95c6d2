//! Whole drawings as PNG.

use super::{ChartError, text};
use resvg::{tiny_skia, usvg};
use std::sync::{Arc, OnceLock};

/// A finished drawing, ready to be written in other formats, with the embedded font alone.
pub struct Drawing(pub(super) usvg::Tree);

impl Drawing {
    /// Reads an SVG of this module.
    ///
    /// # Errors
    /// [`ChartError::Parse`] if it is malformed.
    pub fn parse(svg: &str) -> Result<Self, ChartError> {
        let options = usvg::Options {
            font_family: "DejaVu Sans".into(),
            fontdb: fonts(),
            ..usvg::Options::default()
        };
        let tree = usvg::Tree::from_str(svg, &options);
        tree.map(Self).map_err(|error| ChartError::Parse(error.to_string()))
    }

    /// The drawing as PNG: one point becomes `dots_per_inch / 72` pixels, 300 suits print.
    ///
    /// # Errors
    /// [`ChartError::Size`] if the image would be empty or larger than 100 million pixels.
    pub fn to_png(&self, dots_per_inch: f64) -> Result<Vec<u8>, ChartError> {
        // The tree has points as pixels at 96 for each inch.
        let scale = (dots_per_inch / 96.0) as f32;
        let (width, height) = (self.0.size().width() * scale, self.0.size().height() * scale);
        let size = ChartError::Size { width: f64::from(width), height: f64::from(height) };
        if f64::from(width) * f64::from(height) > 1e8 {
            return Err(size);
        }
        let pixmap = tiny_skia::Pixmap::new(width.round() as u32, height.round() as u32);
        let mut pixmap = pixmap.ok_or(size)?;
        // The rim pixels may be covered in part only.
        pixmap.fill(tiny_skia::Color::WHITE);
        let transform = tiny_skia::Transform::from_scale(scale, scale);
        resvg::render(&self.0, transform, &mut pixmap.as_mut());
        encode_opaque(&pixmap)
    }
}

/// Drawings have a white ground, so the alpha channel is dropped.
fn encode_opaque(pixmap: &tiny_skia::Pixmap) -> Result<Vec<u8>, ChartError> {
    let rgb: Vec<u8> =
        pixmap.data().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
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

fn encoding(error: png::EncodingError) -> ChartError {
    ChartError::Encoding(error.to_string())
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
    fn malformed_drawings_are_errors() {
        assert!(matches!(Drawing::parse("<svg"), Err(ChartError::Parse(_))));
    }
}
