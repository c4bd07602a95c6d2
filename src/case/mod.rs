//! Case files: TOML to validated SI values.
