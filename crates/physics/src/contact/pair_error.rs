//! Surfaces that make no contact or tie.

/// Why two surfaces make no pair, and what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct PairError(pub(super) String);
