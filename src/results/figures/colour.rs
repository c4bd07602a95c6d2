//! Colours: one place that fixes what each colour means in every figure.

use crate::contact::ContactStatus;

/// Text, axes and outlines.
pub const INK: &str = "#222222";
/// Grid lines.
pub const GRID: &str = "#dddddd";
/// Second-rank lines and text.
pub const MUTED: &str = "#666666";

/// Okabe and Ito's colour-blind-safe set, without its yellow, which is too light for lines.
pub const SERIES: [&str; 7] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000",
];

/// Nodes that stick.
pub const STICK: &str = "#0072b2";
/// Nodes that slip.
pub const SLIP: &str = "#e69f00";
/// Nodes without contact.
pub const OPEN: &str = "#d9d9d9";
/// Stable modes.
pub const STABLE: &str = "#0072b2";
/// Unstable modes.
pub const UNSTABLE: &str = "#d55e00";
/// Frequencies and rates of the complex eigenvalue analysis drawn over a transient.
pub const EIGENVALUE: &str = "#d55e00";

/// Power from the drive.
pub const EXTERNAL_POWER: &str = "#000000";
/// Power given to the body by sticking nodes.
pub const STICK_POWER: &str = STICK;
/// Power given to the body by sliding nodes.
pub const SLIDE_POWER: &str = SLIP;
/// Power dissipated at the contact.
pub const CONTACT_DISSIPATION: &str = "#d55e00";
/// Power dissipated by the material damping.
pub const MATERIAL_DISSIPATION: &str = "#009e73";
/// Power of the normal contact forces.
pub const NORMAL_POWER: &str = "#cc79a7";

/// Colour of a contact status.
pub fn of_status(status: ContactStatus) -> &'static str {
    match status {
        ContactStatus::Stick => STICK,
        ContactStatus::Slip => SLIP,
        ContactStatus::Open => OPEN,
    }
}

/// Name of a contact status.
pub fn name_of_status(status: ContactStatus) -> &'static str {
    match status {
        ContactStatus::Stick => "stick",
        ContactStatus::Slip => "slip",
        ContactStatus::Open => "open",
    }
}

/// The three states in the order of every legend.
pub const STATUSES: [ContactStatus; 3] = [
    ContactStatus::Stick,
    ContactStatus::Slip,
    ContactStatus::Open,
];

/// Red, green and blue of `#rrggbb`.
pub fn channels(hex: &str) -> [u8; 3] {
    let part = |at: usize| {
        hex.get(at..at + 2)
            .and_then(|digits| u8::from_str_radix(digits, 16).ok())
            .unwrap_or(0)
    };
    [part(1), part(3), part(5)]
}

/// A perceptually uniform colour map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColourMap {
    /// Dark blue to yellow, for amplitudes.
    Viridis,
    /// Black to pale yellow, for spectra.
    Inferno,
    /// Blue through white to red, for signed values.
    Diverging,
}

impl ColourMap {
    /// Colour at `position` from 0 to 1.
    pub fn at(self, position: f64) -> [u8; 3] {
        let clamped = if position.is_finite() {
            position.clamp(0.0, 1.0)
        } else {
            0.0
        };
        let colour = match self {
            Self::Viridis => colorous::VIRIDIS.eval_continuous(clamped),
            Self::Inferno => colorous::INFERNO.eval_continuous(clamped),
            Self::Diverging => colorous::RED_BLUE.eval_continuous(1.0 - clamped),
        };
        [colour.r, colour.g, colour.b]
    }

    /// `count` colours from low to high as `#rrggbb`.
    pub fn samples(self, count: usize) -> Vec<String> {
        let last = count.saturating_sub(1).max(1) as f64;
        (0..count).map(|i| hex(self.at(i as f64 / last))).collect()
    }
}

/// `#rrggbb` of red, green and blue.
pub fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}
