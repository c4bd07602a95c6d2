//! What most results are made of; what one kind of result has alone is named where it is used.

pub(crate) use crate::prelude::*;
pub(crate) use crate::{
    Declaration, EncodedMesh, Extent, Field, Finding, FolderError, Head, OutputFolder, PvdEntry,
    ShownBody, cartesian_vectors,
    charts::{
        Disc, ModeLine, MovingBody, SolidView,
        palette::{STABLE, UNSTABLE},
    },
    declared, distinct, grouped,
    parameter::{parameter_axis, parameter_name},
    sorted,
    summary::{CriticalValue, MeanPowers, StatusFractions, present},
    write_pvd, write_summary, write_table, write_vtu,
};
