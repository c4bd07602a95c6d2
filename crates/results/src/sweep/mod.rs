//! Results of a parameter study: a file for each finished point, one table over them.

mod figures;
mod folder;
mod matrix_figure;
mod record;
mod report;
mod table;

pub use figures::draw_sweep;
pub use folder::{Claim, Found, Start, SweepFolder};
pub use record::{PointClock, PointRecord};
pub use report::{FailedPoint, SweepSummary, document};
pub use table::swept_text;

pub(super) use table::{BRANCHES, FRICTION, SPEED, by_other_keys, cell, join, tables};
