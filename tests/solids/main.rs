//! Bodies of revolution in three dimensions against theory, the plane program and an independent solution.

mod disc;
mod elements;
mod limits;
mod model;
mod ring;
mod transient;
