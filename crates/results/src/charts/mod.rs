//! Charts that several commands share, and what their colours mean.

mod contact;
mod course;
mod disc;
mod motion;
pub mod palette;
mod solid;

pub use contact::{
    ContactInstant, ContactVelocity, contact_figure, place_axis, shear_stress_figure,
    status_curves, status_map, velocity_figure,
};
pub use course::{
    ModeLine, Stage, ends, run_axis, signal_panel, spectrogram_panels, spectrum_panel, with_stages,
};
pub use disc::Disc;
pub use motion::MovingBody;
pub use solid::{SolidView, contact_surfaces};
