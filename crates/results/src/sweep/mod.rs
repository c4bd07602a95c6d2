//! Results of a parameter study: a file for each finished point, one table over them.

mod critical;
mod folder;
mod long;
mod matrix;
mod matrix_figure;
mod record;
mod report;
mod swept;
mod table;

pub use folder::{Claim, Found, Start, SweepFolder};
pub(super) use long::BRANCHES;
pub use long::tables;
pub use record::{PointClock, PointRecord};
pub use report::{FailedPoint, SweepReport, SweepSummary, document};
pub use swept::swept_text;

pub(super) use critical::critical_friction;
pub(super) use matrix_figure::operating_matrix;
pub(super) use record::listed;
pub(super) use report::{TWO_FREQUENCY, UNSETTLED};
pub(super) use swept::{by_other_keys, printed};
pub(super) use table::{cell, join};
