//! What most tables and figures are made of, from other crates; what is of this one is named where it is used.

pub(crate) use crate::{keys::keys, plural};
pub(crate) use frictionsim_chart::{
    Axis, ColourMap, Figure, INK, Label, Line, MUTED, Marker, Motion, Panel, Points, Rule, SERIES,
    Side, Stroke, extremes, literal, look, plain,
};
pub(crate) use frictionsim_output::{
    Column, Described, Document, Format, Section, Table, columns, fixed, parted, rounded,
    significant,
};
pub(crate) use frictionsim_physics::{
    cea::ComplexMode,
    contact::{ContactInterface, ContactStatus},
    cycle::PhasePoint,
    linalg::c64,
    mesh::{Mesh, SolidFace, SolidSector},
};
pub(crate) use serde::{Deserialize, Serialize};
pub(crate) use serde_json::Value;
pub(crate) use std::{
    collections::{BTreeMap, BTreeSet},
    f64::consts::TAU,
};
