//! What most tables and figures are made of, from other crates; [`common`](crate::common) has what is of this one too.

pub(crate) use crate::{keys::keys, plural};
pub(crate) use flate2::Compression;
pub(crate) use frictionsim_bounds::{RESULT, read_file};
pub(crate) use frictionsim_chart::{
    Axis, Bars, ColourMap, Figure, Fill, Heat, INK, Label, Line, MUTED, Mark, Marker, Motion,
    MotionKind, MotionState, Panel, PanelData, Points, Rule, SERIES, Scale, SeriesKind, Shapes,
    Side, Stroke, Surface, TextStyle, escape, extremes, literal, look, plain, prefixed, signed,
};
pub(crate) use frictionsim_output::{
    Cell, Column, Described, Document, Format, Section, Table, columns, fixed, parted, rounded,
    significant, unit_of, write_rows,
};
pub(crate) use frictionsim_physics::{
    cea::{ComplexMode, FrictionPoint, UnstableInterval},
    contact::{ContactInterface, ContactStatus},
    cycle::{
        BranchEnd, Confirmation, Family, FloquetMultipliers, Parameter, PhasePoint, TwoWaveMotion,
        periodic::{MotionFrame, PeriodicMotion, Sound},
    },
    fem::{MaterialField, NodalStress, SolidStress, nodal_stress},
    linalg::c64,
    mesh::{BoundaryCondition, BoundaryFace, Counterface, Mesh, SolidFace, SolidSector},
    transient::{EndState, ProbeMotion, Recorder, SampleRow, Snapshot},
};
pub(crate) use frictionsim_signal::{AmplitudeSpectrum, Estimate, FrequencyResponse, spectrogram};
pub(crate) use nalgebra::Vector3;
pub(crate) use serde::{Deserialize, Serialize, de::DeserializeOwned};
pub(crate) use serde_json::{Map, Value, json};
pub(crate) use std::{
    collections::{BTreeMap, BTreeSet},
    f64::consts::{PI, TAU},
    fmt::Write as _,
    fs,
    io::{self, Write as _},
    path::{Path, PathBuf},
    sync::Arc,
};
