//! The explicit contact transient against theory, other methods and itself.

mod contact;
mod energy;
mod linear_stage;
mod model;
mod operators;
mod restart;
mod seeds;
mod settings;
mod settling;
mod time_order;
