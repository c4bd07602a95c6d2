//! Complex eigenvalue analysis: the stability of steady sliding.
