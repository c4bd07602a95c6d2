//! Explicit frictional-contact transient.
