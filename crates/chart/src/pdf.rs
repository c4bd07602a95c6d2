//! Whole drawings as PDF: paths, clips and images as they are, letters as their outlines.

use super::{ChartError, Drawing};
use flate2::{Compression, write::ZlibEncoder};
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref};
use resvg::tiny_skia::{PathSegment, Transform};
use resvg::usvg::{Color, Group, Image, ImageKind, LineCap, Node, Paint, Path};
use std::{collections::BTreeMap, io::Write, sync::Arc};

impl Drawing {
    /// The drawing as a PDF of one page of its own size.
    ///
    /// # Errors
    /// [`ChartError::Encoding`] if an image in it cannot be read.
    pub fn to_pdf(&self) -> Result<Vec<u8>, ChartError> {
        let tree = &self.0;
        let (catalog, pages, page, contents) = (Ref::new(1), Ref::new(2), Ref::new(3), Ref::new(4));
        let mut writer =
            Writer { content: Content::new(), images: Vec::new(), opacities: BTreeMap::new() };
        // From pixels at 96 for each inch, down from the top, to points up from the bottom.
        let (width, height) = (0.75 * tree.size().width(), 0.75 * tree.size().height());
        writer.content.transform([0.75, 0.0, 0.0, -0.75, 0.0, height]);
        writer.group(tree.root());

        let mut pdf = Pdf::new();
        pdf.catalog(catalog).pages(pages);
        pdf.pages(pages).kids([page]).count(1);
        let mut entry = pdf.page(page);
        entry.parent(pages).contents(contents).media_box(Rect::new(0.0, 0.0, width, height));
        let mut resources = entry.resources();
        let first = contents.get() + 1;
        let image_at = |index: usize| Ref::new(first + 2 * index as i32);
        let names: Vec<String> =
            (0..writer.images.len()).map(|index| format!("I{index}")).collect();
        let mut objects = resources.x_objects();
        for (index, name) in names.iter().enumerate() {
            objects.pair(Name(name.as_bytes()), image_at(index));
        }
        objects.finish();
        let mut states = resources.ext_g_states();
        for (hundredths, name) in &writer.opacities {
            let opacity = *hundredths as f32 / 100.0;
            let mut state = states
                .insert(Name(name.as_bytes()))
                .start::<pdf_writer::writers::ExtGraphicsState<'_>>();
            state.stroking_alpha(opacity).non_stroking_alpha(opacity);
        }
        states.finish();
        resources.finish();
        entry.finish();
        for (index, bytes) in writer.images.iter().enumerate() {
            write_image(&mut pdf, image_at(index), bytes)?;
        }
        let stream = deflated(&writer.content.finish())?;
        pdf.stream(contents, &stream).filter(Filter::FlateDecode);
        Ok(pdf.finish())
    }
}

/// What the page consists of, as it is met in the tree.
struct Writer {
    content: Content,
    /// Images as PNG, each once.
    images: Vec<Arc<Vec<u8>>>,
    /// Names of the graphics states by opacity in hundredths.
    opacities: BTreeMap<u32, String>,
}

impl Writer {
    fn group(&mut self, group: &Group) {
        self.content.save_state();
        self.transform(group.transform());
        if let Some(clip) = group.clip_path() {
            for node in clip.root().children() {
                if let Node::Path(path) = node {
                    self.outline(path);
                }
            }
            self.content.clip_nonzero().end_path();
        }
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group),
                Node::Path(path) => self.path(path),
                Node::Text(text) => self.group(text.flattened()),
                Node::Image(image) => self.image(image),
            }
        }
        self.content.restore_state();
    }

    fn transform(&mut self, t: Transform) {
        if !t.is_identity() {
            self.content.transform([t.sx, t.ky, t.kx, t.sy, t.tx, t.ty]);
        }
    }

    fn outline(&mut self, path: &Path) {
        let mut last = (0.0, 0.0);
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(p) => self.content.move_to(p.x, p.y),
                PathSegment::LineTo(p) => self.content.line_to(p.x, p.y),
                // The cubic curve that is the quadratic one.
                PathSegment::QuadTo(c, p) => {
                    let third = |from: (f32, f32)| {
                        (from.0 + (c.x - from.0) * 2.0 / 3.0, from.1 + (c.y - from.1) * 2.0 / 3.0)
                    };
                    let (a, b) = (third(last), third((p.x, p.y)));
                    self.content.cubic_to(a.0, a.1, b.0, b.1, p.x, p.y)
                }
                PathSegment::CubicTo(a, b, p) => {
                    self.content.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y)
                }
                PathSegment::Close => self.content.close_path(),
            };
            if let PathSegment::MoveTo(p)
            | PathSegment::LineTo(p)
            | PathSegment::QuadTo(_, p)
            | PathSegment::CubicTo(_, _, p) = segment
            {
                last = (p.x, p.y);
            }
        }
    }

    /// Stroke, then fill where a path has both: halos lie below their letters.
    fn path(&mut self, path: &Path) {
        if let Some(stroke) = path.stroke() {
            self.content.save_state();
            self.opacity(stroke.opacity().get());
            let [r, g, b] = colour(stroke.paint());
            self.content.set_stroke_rgb(r, g, b).set_line_width(stroke.width().get());
            let cap = match stroke.linecap() {
                LineCap::Round => LineCapStyle::RoundCap,
                _ => LineCapStyle::ButtCap,
            };
            self.content.set_line_join(LineJoinStyle::RoundJoin).set_line_cap(cap);
            self.content.set_dash_pattern(
                stroke.dasharray().unwrap_or(&[]).iter().copied(),
                stroke.dashoffset(),
            );
            self.outline(path);
            self.content.stroke().restore_state();
        }
        if let Some(fill) = path.fill() {
            self.content.save_state();
            self.opacity(fill.opacity().get());
            let [r, g, b] = colour(fill.paint());
            self.content.set_fill_rgb(r, g, b);
            self.outline(path);
            self.content.fill_nonzero().restore_state();
        }
    }

    fn opacity(&mut self, opacity: f32) {
        let hundredths = (opacity * 100.0).round() as u32;
        if hundredths < 100 {
            let name = self.opacities.entry(hundredths).or_insert_with(|| format!("G{hundredths}"));
            self.content.set_parameters(Name(name.as_bytes()));
        }
    }

    fn image(&mut self, image: &Image) {
        let ImageKind::PNG(bytes) = image.kind() else { return };
        let known = self.images.iter().position(|image| image == bytes);
        let index = known.unwrap_or_else(|| {
            self.images.push(bytes.clone());
            self.images.len() - 1
        });
        // Images of a PDF stand on their feet in a unit square.
        let size = image.size();
        let name = format!("I{index}");
        self.content.save_state();
        self.content.transform([size.width(), 0.0, 0.0, -size.height(), 0.0, size.height()]);
        self.content.x_object(Name(name.as_bytes())).restore_state();
    }
}

fn colour(paint: &Paint) -> [f32; 3] {
    let Color { red, green, blue } = match paint {
        Paint::Color(colour) => *colour,
        _ => Color::black(),
    };
    [red, green, blue].map(|channel| f32::from(channel) / 255.0)
}

/// Writes the colours of an image, and behind it its opacities as a mask.
fn write_image(pdf: &mut Pdf, at: Ref, png: &[u8]) -> Result<(), ChartError> {
    let fail = |error: png::DecodingError| ChartError::Encoding(error.to_string());
    let mut decoder = png::Decoder::new(std::io::Cursor::new(png));
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
    let mut reader = decoder.read_info().map_err(fail)?;
    let mut rgba = vec![0; reader.output_buffer_size().unwrap_or(0)];
    let info = reader.next_frame(&mut rgba).map_err(fail)?;
    let colours: Vec<u8> = rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    let opacities: Vec<u8> = rgba.chunks_exact(4).map(|p| p[3]).collect();
    let mask = Ref::new(at.get() + 1);
    for (at, values, is_mask) in [(at, colours, false), (mask, opacities, true)] {
        let data = deflated(&values)?;
        let mut image = pdf.image_xobject(at, &data);
        image.filter(Filter::FlateDecode);
        image.width(info.width as i32).height(info.height as i32).bits_per_component(8);
        if is_mask {
            image.color_space().device_gray();
        } else {
            image.color_space().device_rgb();
            image.s_mask(mask);
        }
    }
    Ok(())
}

fn deflated(bytes: &[u8]) -> Result<Vec<u8>, ChartError> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    let written = encoder.write_all(bytes).and_then(|()| encoder.finish());
    written.map_err(|error| ChartError::Encoding(error.to_string()))
}
