//! The numbers of a report, read back from its page.

use super::numbers::read;
use crate::chart::{AxisData, INK, PanelData, Series, SeriesKind};
use serde_json::Value;

/// The curves of a figure of another report.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadFigure {
    /// Its name.
    pub name: String,
    /// Its panels, with curves and points alone.
    pub panels: Vec<PanelData>,
}

/// The figures of a report in the order of its page; none of a page that is of another version or damaged.
pub fn read_figures(html: &str) -> Vec<ReadFigure> {
    figures_of(html).unwrap_or_default()
}

fn figures_of(html: &str) -> Option<Vec<ReadFigure>> {
    let element = |start: &str| {
        let from = html.find(start)? + start.len();
        Some(&html[from..from + html[from..].find("</script>")?])
    };
    let data = element("<script type=\"application/json\" id=\"data\">")?;
    let block = element("<script type=\"text/plain\" id=\"block\">")?;
    let data: Value = serde_json::from_str(data).ok()?;
    let arrays = read(data["arrays"].as_array()?, block)?;
    let array = |index: &Value| arrays.get(index.as_u64()? as usize).cloned();
    let text = |value: &Value| value.as_str().map(str::to_owned);
    let axis = |axis: &Value| {
        Some(AxisData {
            title: text(&axis["title"])?,
            is_logarithmic: axis["log"].as_bool()?,
            ends: [axis["ends"][0].as_f64()?, axis["ends"][1].as_f64()?],
        })
    };
    let series = |series: &Value| {
        let kind = match series["kind"].as_str()? {
            "line" => SeriesKind::Line,
            "dashed" => SeriesKind::Dashed,
            "points" => SeriesKind::Points,
            _ => return None,
        };
        Some(Series {
            name: text(&series["name"])?,
            kind,
            colour: INK,
            xs: array(&series["x"])?,
            ys: array(&series["y"])?,
            values: None,
            rows: Vec::new(),
            tips: Vec::new(),
            is_whole: false,
        })
    };
    let panel = |panel: &Value| {
        Some(PanelData {
            caption: text(&panel["caption"])?,
            axes: [axis(&panel["x"])?, axis(&panel["y"])?],
            series: panel["series"].as_array()?.iter().filter_map(series).collect(),
            rules: Vec::new(),
            labels: Vec::new(),
        })
    };
    let figures = data["figures"].as_array()?.iter().map(|figure| {
        let panels: Option<Vec<PanelData>> =
            figure["panels"].as_array()?.iter().map(panel).collect();
        Some(ReadFigure { name: text(&figure["name"])?, panels: panels? })
    });
    figures.collect()
}
