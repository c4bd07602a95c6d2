//! Charts that several commands share, and what their colours mean.

mod bodies;
mod contact;
mod course;
mod disc;
mod motion;
pub mod palette;
mod solid;

pub use bodies::{contact_surfaces, speeds_of_bodies, speeds_on_top};
pub use contact::{
    ContactVelocity, FieldFrame, contact_figure, field_figure, open_contact_figure, place_axis,
    shear_stress_figure, status_curves, status_map,
};
pub use course::{
    ModeLine, Stage, run_axis, signal_panel, spectrogram_panels, spectrum_panel, with_stages,
};
pub use disc::Disc;
pub use motion::MovingBody;
pub use solid::SolidView;
