//! The name of a mode in tables of what is read from it.

/// A mode of one friction value, as its table numbers it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeName {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Number by frequency, from 1.
    pub mode: usize,
    /// `Im(lambda) / 2 pi`, Hz.
    pub frequency_hz: f64,
    /// Circumferential harmonic; none without symmetry.
    pub harmonic: Option<usize>,
    /// Branch, from 0.
    pub branch: usize,
    /// +1 travels with the rotor, -1 against it, 0 stands; none without symmetry.
    pub direction: Option<i8>,
}
