//! The cyclic eigenvalue analysis against theory, dense solutions, the sparse solver and the paper.

#[path = "../common/disc.rs"]
mod disc;
#[path = "../common/table_1.rs"]
mod table_1;

mod dense;
mod model;
mod sensitivity;
mod stability;
mod whole_mesh;
