//! Steady sliding equilibrium and the tangent around it.
