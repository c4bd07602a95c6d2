//! Charts: a figure is a grid of panels, a panel two axes and the layers drawn between them.
//!
//! ```
//! use frictionsim_chart::{Axis, Figure, Line, Panel, Rule};
//! let (time, power) = ([0.0, 0.01, 0.02], [0.0, 900.0, 1300.0]);
//! let panel = Panel::new(Axis::new("time *t*", "s").prefixed(), Axis::new("power", "W").prefixed())
//!     .layer(Line::new(&time, &power).name("external"))
//!     .layer(Rule::horizontal(1000.0).name("limit"));
//! let svg = Figure::new("power", "Power of the drive.").panel(panel).to_svg(None)?;
//! assert!(svg.contains("power (kW)"));
//! # Ok::<(), frictionsim_chart::ChartError>(())
//! ```
//!
//! Layers hold data in the units of the program; axes bring them to the unit shown. Frames, clips, letters, legends of
//! what is there to be seen, empty and non-finite data are dealt with here, once. Sizes are journal column widths,
//! equal data give equal bytes, text stays text. Nothing here computes physics or touches a file.

#[macro_use]
mod changed;

mod axis;
mod colour;
mod colour_bar;
mod data;
mod decimation;
mod field;
mod figure;
mod frame;
mod heat;
mod image;
mod layer;
mod layout;
mod legend;
mod line;
mod marks;
mod numbers;
mod packed;
mod panel;
mod path;
mod pdf;
mod prelude;
mod raster;
mod ruler;
mod shapes;
mod surface;
mod svg;
mod text;

pub use axis::Axis;
pub use colour::{Colour, ColourMap, GRID, INK, MUTED, SERIES};
pub use data::{Mark, Motion, MotionKind, MotionState, PanelData, Series, SeriesKind, Steps};
pub use decimation::{WIDEST, keep_extremes};
pub use field::{Field, Mesh};
pub use figure::Figure;
pub use frame::Frame;
pub use heat::Heat;
pub use image::Palette;
pub use layer::{Drawn, Side};
pub use legend::Key;
pub use line::{Line, Marker, Points, look};
pub use marks::{Label, Rule};
pub use numbers::{Scale, extremes, prefixed, signed, significant};
pub use packed::{common_length, levels, steps};
pub use panel::Panel;
pub use path::Path;
pub use raster::Drawing;
pub use ruler::Ruler;
pub use shapes::{Bars, Fill, Shapes};
pub use surface::{Surface, SurfaceMesh};
pub use svg::{ID_PREFIX, Rect, Stroke, Svg, escape};
pub use text::{Anchor, TextStyle, literal, plain};

/// A figure that cannot be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChartError {
    /// Nothing to draw.
    #[error("{0}: there is nothing to draw")]
    Empty(String),
    /// The image cannot be encoded.
    #[error("the image cannot be encoded as PNG: {0}")]
    Encoding(String),
    /// The drawing is not well-formed.
    #[error("the drawing is not well-formed SVG: {0}")]
    Parse(String),
    /// The image is empty or too large.
    #[error("an image of {width:.0} x {height:.0} pixels cannot be drawn: 1 to 1e8 pixels fit")]
    Size {
        /// Pixels in a row.
        width: f64,
        /// Rows.
        height: f64,
    },
}
