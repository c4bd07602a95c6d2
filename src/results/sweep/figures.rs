//! Figures of a study of transients over speed and friction.

use super::super::figures::{SpeedSeries, SpeedSweep, draw_speed_frequencies, draw_speed_status};
use super::super::{DrawingError, render};
use super::{SweepFolder, SweepReport};
use serde_json::Value;

const SPEED: &str = "contact.rotation_speed_rpm";
const FRICTION: &str = "contact.friction_coefficient";

/// Draws main frequency and contact status over speed, one series for each friction coefficient, as
/// `figures/frequencies` and `figures/status`.
///
/// Draws nothing unless transients were swept over speed, and over friction or nothing else.
///
/// # Errors
/// Those of the drawing and of the folder.
pub fn draw(folder: &SweepFolder, report: &SweepReport<'_>) -> Result<(), DrawingError> {
    let Some(data) = speed_sweep(report) else {
        return Ok(());
    };
    for (name, drawing) in [
        ("frequencies", draw_speed_frequencies(&data)),
        ("status", draw_speed_status(&data)),
    ] {
        if let Some(figure) = render(drawing)? {
            folder.write(&format!("figures/{name}.svg"), |out| {
                out.write_all(figure.svg.as_bytes())
            })?;
            folder.write(&format!("figures/{name}.png"), |out| {
                out.write_all(&figure.png)
            })?;
        }
    }
    Ok(())
}

/// Limit cycles over speed; `None` if the points are not of that kind.
fn speed_sweep(report: &SweepReport<'_>) -> Option<SpeedSweep> {
    let (keys, records) = (report.keys, report.records);
    let is_known = |key: &String| key == SPEED || key == FRICTION;
    if !keys.iter().any(|key| key == SPEED) || !keys.iter().all(is_known) {
        return None;
    }
    let mut series: Vec<SpeedSeries> = Vec::new();
    for record in records {
        let speed = record.swept.get(SPEED)?.as_f64()?;
        // Friction that is not swept is the same for all points and has no value here.
        let friction = record.swept.get(FRICTION).and_then(Value::as_f64);
        let friction = friction.unwrap_or(f64::NAN);
        let same = |known: &SpeedSeries| known.friction_coefficient.to_bits() == friction.to_bits();
        let at = series.iter().position(same).unwrap_or_else(|| {
            series.push(SpeedSeries {
                friction_coefficient: friction,
                speeds_rpm: Vec::new(),
                main_frequency_hz: Vec::new(),
                stick: Vec::new(),
                slip: Vec::new(),
                open: Vec::new(),
            });
            series.len() - 1
        });
        let summary = record.summaries.get("transient");
        let number = |pointer: &str| {
            let value = summary.and_then(|summary| summary.pointer(pointer));
            value.and_then(Value::as_f64).unwrap_or(f64::NAN)
        };
        let line = &mut series[at];
        line.speeds_rpm.push(speed);
        line.main_frequency_hz.push(number("/main_frequency_hz"));
        line.stick.push(number("/status/stick"));
        line.slip.push(number("/status/slip"));
        line.open.push(number("/status/open"));
    }
    let has_values = |line: &SpeedSeries| line.main_frequency_hz.iter().any(|f| f.is_finite());
    series.iter().any(has_values).then(|| SpeedSweep {
        series,
        references: Vec::new(),
    })
}
