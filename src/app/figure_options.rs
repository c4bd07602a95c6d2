//! Options of every command that draws figures.

use super::choice::{Choice, one_of};
use crate::chart::WIDEST;
use crate::results::{DOTS_PER_INCH, DrawingOptions, Format};
use clap::Args;

/// Resolution, width and formats of the figures.
#[derive(Args, Clone, Debug)]
pub struct FigureOptions {
    /// Resolution of the PNG figures, dots per inch
    #[arg(long, value_name = "DPI", default_value_t = DOTS_PER_INCH, value_parser = resolution)]
    dpi: f64,
    /// Width of the figures: "column" (85 mm), "page" (178 mm) or mm [default: each figure's own]
    #[arg(long, value_name = "WIDTH", value_parser = width)]
    width: Option<f64>,
    /// Formats of the figures
    #[arg(
        long,
        value_parser = one_of(&FORMATS),
        value_name = "FORMAT",
        value_delimiter = ',',
        default_value = "svg,png,pdf"
    )]
    format: Vec<Format>,
}

/// Formats of figures, each with its word.
const FORMATS: [Choice<Format>; 3] = [
    ("svg", Format::Svg, "Lines, text as text"),
    ("png", Format::Png, "Pixels"),
    ("pdf", Format::Pdf, "Lines, text as outlines"),
];

impl Default for FigureOptions {
    fn default() -> Self {
        let format = FORMATS.map(|choice| choice.1).into();
        Self { dpi: DOTS_PER_INCH, width: None, format }
    }
}

impl FigureOptions {
    /// What the drawing needs to know.
    pub fn drawing(&self) -> DrawingOptions {
        DrawingOptions {
            dots_per_inch: self.dpi,
            width_mm: self.width,
            formats: self.format.clone(),
        }
    }
}

fn resolution(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(dpi) if (20.0..=1200.0).contains(&dpi) => Ok(dpi),
        _ => Err("20 to 1200 dots per inch".to_owned()),
    }
}

fn width(text: &str) -> Result<f64, String> {
    match (text, text.trim_end_matches("mm").trim().parse::<f64>()) {
        ("column", _) => Ok(85.0),
        ("page", _) => Ok(178.0),
        (_, Ok(width)) if (60.0..=WIDEST).contains(&width) => Ok(width),
        _ => Err(format!("\"column\", \"page\" or 60 to {WIDEST} mm")),
    }
}
