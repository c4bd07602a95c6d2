//! What most tables and figures are made of, from other crates; [`common`](crate::common) has what is of this one too.

pub(crate) use crate::{keys::keys, plural};
pub(crate) use frictionsim_chart::{
    Axis, Bars, ColourMap, Figure, Fill, Heat, INK, Label, Line, MUTED, Marker, Motion, MotionKind,
    MotionState, Panel, Points, Rule, SERIES, Scale, Shapes, Side, Stroke, TextStyle, extremes,
    literal, look, plain, prefixed, signed,
};
pub(crate) use frictionsim_output::{
    Cell, Column, Described, Document, Format, Section, Table, columns, fixed, parted, rounded,
    significant, unit_of, write_rows,
};
pub(crate) use frictionsim_physics::{
    cea::{ComplexMode, FrictionPoint},
    contact::{ContactInterface, ContactStatus},
    cycle::PhasePoint,
    fem::MaterialField,
    linalg::c64,
    mesh::{BoundaryFace, Counterface, Mesh, SolidFace, SolidSector},
    transient::EndState,
};
pub(crate) use nalgebra::Vector3;
pub(crate) use serde::{Deserialize, Serialize};
pub(crate) use serde_json::{Map, Value};
pub(crate) use std::{
    collections::{BTreeMap, BTreeSet},
    f64::consts::TAU,
    fmt::Write as _,
    io::{self, Write as _},
    path::Path,
    sync::Arc,
};
