//! Text tables to signals.
