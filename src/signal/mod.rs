//! Measured and computed signals: spectra, spectrograms, modal damping.
