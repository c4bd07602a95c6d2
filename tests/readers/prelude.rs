//! What most of these tests name.

pub use crate::common::prelude::*;
pub use crate::fuzz::hold;
pub use crate::fuzz::mutation::{Random, binary, either, text};
pub use frictionsim::case::case_from;
pub use frictionsim::signal::reader::{self, ResponseOptions, SignalOptions};
pub use frictionsim::signal::{FrequencyResponse, ResponseQuantity};
