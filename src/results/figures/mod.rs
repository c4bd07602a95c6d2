//! Figures: a small drawing kit, and one function for each kind of figure.
//!
//! Every figure takes a plain data struct and returns a finished SVG document; [`render_png`] turns
//! it into PNG with the embedded font. Sizes are journal column widths, colours are defined once in
//! [`colour`], and equal data give equal bytes. Nothing here computes physics or touches a file.

pub mod axis;
pub mod colour;
pub mod decimation;
pub mod field;
pub mod legend;
pub mod panel;
pub mod path;
pub mod raster;
pub mod svg;
pub mod text;

mod branch_figures;
mod branches;
mod contact_state;
mod contact_status;
mod convergence;
mod critical_friction;
mod eigenvalues;
mod energy;
mod growth;
mod identification;
mod mode_shapes;
mod node_cycle;
mod node_orbit;
mod overview;
mod prestress;
mod response;
mod snapshots;
mod spectrum;
mod stability;
mod sweep;
mod time_stack;
mod trajectories;

pub use branch_figures::{draw_branch_frequencies, draw_branch_shares};
pub use branches::{BranchCurve, BranchCurves, Stability};
pub use contact_state::{ContactState, draw_contact_state};
pub use contact_status::StatusHistory;
pub use convergence::{ConvergenceSeries, ConvergenceStudy, draw_convergence, observed_order};
pub use critical_friction::{CriticalFriction, draw_critical_friction};
pub use eigenvalues::{EigenvalueLocus, PairSweep, draw_eigenvalue_locus, draw_pair_sweep};
pub use energy::{EnergyFlows, draw_energy_flows, moving_average};
pub use growth::{HarmonicGrowth, PredictedGrowth, draw_harmonic_growth};
pub use identification::{DampingIdentification, Resonance, draw_damping_identification};
pub use mode_shapes::{ModeShape, ModeShapes, draw_mode_over_friction, draw_mode_shapes};
pub use node_cycle::{NodeCycle, draw_node_cycle};
pub use node_orbit::draw_node_orbit;
pub use overview::{TransientOverview, draw_transient_overview};
pub use prestress::{PrestressedContact, draw_prestress};
pub use raster::render_png;
pub use response::{ResponsePlot, draw_response};
pub use snapshots::{Snapshot, Snapshots, draw_snapshots};
pub use spectrum::{SpectrumPlot, draw_spectrum};
pub use stability::{StabilityMap, draw_stability_map};
pub use sweep::{SpeedSeries, SpeedSweep, draw_speed_frequencies, draw_speed_status};
pub use time_stack::{ReferenceFrequency, SpectrogramMap, Stage};
pub use trajectories::{ContactTrace, PhasePlot, Trajectories, draw_trajectories};

/// A figure that cannot be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FigureError {
    /// Two arrays of the data do not belong together.
    #[error("{what}: {found} values where {expected} are needed to draw the figure")]
    Shape {
        /// Which array.
        what: String,
        /// Its length.
        found: usize,
        /// Length needed.
        expected: usize,
    },
    /// Nothing to draw.
    #[error("{what} is empty: there is nothing to draw")]
    Empty {
        /// Which array.
        what: String,
    },
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

/// Checks the length of an array of figure data.
pub(crate) fn expect_length(what: &str, found: usize, expected: usize) -> Result<(), FigureError> {
    if found == expected {
        Ok(())
    } else {
        Err(FigureError::Shape {
            what: what.into(),
            found,
            expected,
        })
    }
}

/// Checks that there is something to draw.
pub(crate) fn expect_some(what: &str, count: usize) -> Result<(), FigureError> {
    if count == 0 {
        Err(FigureError::Empty { what: what.into() })
    } else {
        Ok(())
    }
}
