//! Figures: the grammar they are made of, and those of runs, analyses and studies. A drawing is well-formed, holds its axis
//! titles, names and data, stays light, is the same each time, and its PNG shows something.
//!
//! Consistency checks: they look at the drawing, not at the physics.

mod bodies;
mod grammar;
mod report;
mod run;
mod studies;
pub mod synthetic;

use frictionsim::chart::Drawing;
use std::path::PathBuf;

/// Largest drawing that a mail or a report should carry.
const LARGEST_SVG: usize = 600_000;

fn texts(svg: &str) -> Vec<String> {
    let document = resvg::usvg::roxmltree::Document::parse(svg).unwrap();
    let lines = document.descendants().filter(|node| node.has_tag_name("text"));
    let words = lines
        .map(|node| node.descendants().filter(|d| d.is_text()).filter_map(|d| d.text()).collect());
    words.collect()
}

/// Words of a text, its box (left, top, right, bottom) in points, and whether it has a halo.
type TextBox = (String, [f64; 4], bool);

/// The boxes of the texts of a drawing, points, as the embedded font sets them, with their words; and the size of the sheet.
fn text_boxes(svg: &str) -> (Vec<TextBox>, [f64; 2]) {
    use resvg::usvg::{Group, Node, Options, PaintOrder, Tree};
    fn visit(group: &Group, out: &mut Vec<TextBox>) {
        for node in group.children() {
            match node {
                Node::Group(group) => visit(group, out),
                Node::Text(text) => {
                    let words: String = text.chunks().iter().map(|chunk| chunk.text()).collect();
                    let mut spans = text.chunks().iter().flat_map(|chunk| chunk.spans());
                    let halo = PaintOrder::StrokeAndFill;
                    let has_halo = spans.any(|span| span.paint_order() == halo);
                    let place = text.abs_bounding_box();
                    let ends = [place.left(), place.top(), place.right(), place.bottom()];
                    out.push((words, ends.map(f64::from), has_halo));
                }
                _ => {}
            }
        }
    }
    let mut options = Options::default();
    for face in ["DejaVuSans", "DejaVuSans-Bold", "DejaVuSans-Oblique"] {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("crates/chart/src/font");
        let font = std::fs::read(folder.join(format!("{face}.ttf"))).unwrap();
        options.fontdb_mut().load_font_data(font);
    }
    let tree = Tree::from_str(svg, &options).unwrap();
    let mut boxes = Vec::new();
    visit(tree.root(), &mut boxes);
    let size = tree.size();
    (boxes, [size.width(), size.height()].map(f64::from))
}

/// Holds the texts of a drawing to the sheet, and those without a ground of their own apart from each other.
fn check_texts(name: &str, svg: &str) {
    let (boxes, [width, height]) = text_boxes(svg);
    for (words, place, _) in &boxes {
        let [left, top, right, bottom] = *place;
        let is_inside = left.min(top) > -0.5 && right < width + 0.5 && bottom < height + 0.5;
        assert!(is_inside, "{name}: '{words}' at {place:.1?} leaves {width:.1} x {height:.1}");
    }
    let plain: Vec<_> = boxes.iter().filter(|text| !text.2).collect();
    for (at, (words, a, _)) in plain.iter().enumerate() {
        for (others, b, _) in &plain[at + 1..] {
            let overlap = |k: usize| a[k + 2].min(b[k + 2]) - a[k].max(b[k]);
            // Boxes reach from the ascender to the descender: lines that touch there are apart.
            let is_apart = overlap(0) < 1.0 || overlap(1) < 3.0;
            assert!(is_apart, "{name}: '{words}' and '{others}' lie on each other");
        }
    }
}

/// Whether no attribute or text of a drawing holds what is no number; encoded images may spell anything.
fn is_finite(svg: &str) -> bool {
    let mut outside = svg.split("base64,").enumerate().map(|(index, part)| match index {
        0 => part,
        _ => part.split_once('"').map_or("", |(_, rest)| rest),
    });
    outside.all(|part| !part.contains("NaN") && !part.contains("inf"))
}

/// Writes drawing and PNG below the target folder for a look, and checks both.
fn check(name: &str, svg: &str, expected: &[&str]) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("figures");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join(format!("{name}.svg")), svg).unwrap();
    let text = texts(svg);
    for wanted in expected.iter().flat_map(|words| words.split(" ; ")) {
        let is_there = text.iter().any(|line| line.contains(wanted));
        assert!(is_there, "{name} lacks '{wanted}': {text:?}");
    }
    assert!(svg.contains("<title") && svg.contains("<desc"));
    assert!(is_finite(svg), "{name}");
    assert!(svg.len() < LARGEST_SVG, "{name}: {} bytes", svg.len());
    check_texts(name, svg);
    let png = Drawing::parse(svg).unwrap().to_png(220.0).unwrap();
    std::fs::write(folder.join(format!("{name}.png")), &png).unwrap();
    assert!(ink_fraction(&png) > 0.005, "{name} is blank");
}

fn ink_fraction(png: &[u8]) -> f64 {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    let is_inked = |pixel: &&[u8]| pixel.iter().any(|&channel| channel < 230);
    let inked = pixels.chunks_exact(3).filter(is_inked).count();
    inked as f64 / (pixels.len() / 3) as f64
}
