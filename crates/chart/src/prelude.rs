//! What layers, panels and figures are made of; what one file alone needs is named there.

pub(crate) use crate::{
    Anchor, Axis, Bars, ChartError, Colour, ColourMap, Field, Fill, Frame, GRID, Heat, INK, Key,
    Label, Line, MUTED, Marker, Motion, Palette, Panel, PanelData, Path, Points, Rect, Rule, Ruler,
    SERIES, Scale, Series, SeriesKind, Shapes, Side, Steps, Stroke, Surface, Svg, TextStyle,
    colour_bar::{Colours, FLAT_BAR_HEIGHT},
    decimation::{COLUMNS_PER_POINT, INVISIBLE, lasting, simplify},
    extremes,
    frame::{LABEL_SIZE, TITLE_SIZE, vertical_count},
    image::IndexedImage,
    keep_extremes,
    layer::{Drawn, Layer},
    legend::{LINE_HEIGHT, Legend},
    packed::{Levels, lists, whole},
    plain, prefixed,
    ruler::{Tick, widest},
    signed,
    svg::POINTS_PER_MM,
    text,
};
pub(crate) use serde::{Deserialize, Serialize};
pub(crate) use std::sync::Arc;
