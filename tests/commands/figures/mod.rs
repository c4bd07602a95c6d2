//! Figures: the grammar they are made of, and those of runs, analyses and studies. A drawing is well-formed, holds its axis
//! titles, names and data, stays light, is the same each time, and its PNG shows something.
//!
//! Consistency checks: they look at the drawing, not at the physics.

mod grammar;
mod report;
mod run;
mod studies;
mod synthetic;

use frictionsim::chart::Drawing;
use std::path::PathBuf;

/// Largest drawing that a mail or a report should carry.
const LARGEST_SVG: usize = 600_000;

/// The lines of text in a drawing.
fn texts(svg: &str) -> Vec<String> {
    let document = resvg::usvg::roxmltree::Document::parse(svg).unwrap();
    let lines = document
        .descendants()
        .filter(|node| node.has_tag_name("text"));
    let words = lines.map(|node| {
        node.descendants()
            .filter(|d| d.is_text())
            .filter_map(|d| d.text())
            .collect()
    });
    words.collect()
}

/// Whether no attribute or text of a drawing holds what is no number; encoded images may spell anything.
fn is_finite(svg: &str) -> bool {
    let parts = svg.split("base64,").enumerate();
    let mut outside = parts.map(|(index, part)| match index {
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
    for wanted in expected {
        let is_there = text.iter().any(|line| line.contains(wanted));
        assert!(is_there, "{name} lacks '{wanted}': {text:?}");
    }
    assert!(svg.contains("<title") && svg.contains("<desc"));
    assert!(is_finite(svg), "{name}");
    assert!(svg.len() < LARGEST_SVG, "{name}: {} bytes", svg.len());
    let png = Drawing::parse(svg).unwrap().to_png(220.0).unwrap();
    std::fs::write(folder.join(format!("{name}.png")), &png).unwrap();
    assert!(ink_fraction(&png) > 0.005, "{name} is blank");
}

/// Part of the pixels that are not white.
fn ink_fraction(png: &[u8]) -> f64 {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png))
        .read_info()
        .unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    let is_inked = |pixel: &&[u8]| pixel.iter().any(|&channel| channel < 230);
    let inked = pixels.chunks_exact(3).filter(is_inked).count();
    inked as f64 / (pixels.len() / 3) as f64
}
