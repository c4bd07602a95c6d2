//! What most commands name.

pub(super) use super::{
    Failure, OutputOptions, ResumedRun, RunOptions, Session, Told, depend_on, input_name,
    read_input, terminal,
};
pub(super) use crate::{
    case::Case,
    chart::Figure,
    results::{Head, Manifest, OutputFolder},
};
pub(super) use clap::{Args, ValueHint};
pub(super) use serde_json::{Value, json};
pub(super) use std::{
    path::{Path, PathBuf},
    time::Instant,
};
