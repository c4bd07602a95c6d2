//! Bodies of revolution in three dimensions against theory, the plane program and an independent solution.

mod disc;
mod elements;
mod frf_command;
mod limits;
pub mod model;
pub mod parts;
mod plane_transient;
mod poles;
mod response;
mod response_limits;
mod ring;
mod sensitivity;
mod slow_sliding;
mod studies;
mod transient;
mod whole_ring;

use crate::prelude::*;
use model::{base, bending, body, disc, guided, modes, opens_in_part};
