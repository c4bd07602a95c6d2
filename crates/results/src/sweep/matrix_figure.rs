//! The picture of an operating matrix: the frequency of every unstable mode over the operating conditions.

use super::PointRecord;
use super::report::{Condition, conditions, unstable};
use super::table::{printed, swept_text};
use crate::common::*;
use crate::parameter::{in_unit, shared_unit};

/// Most panels of the figure.
const PANELS: usize = 12;
/// Part of a place along the abscissa that the friction values in it take.
const FILLED: f64 = 0.8;
/// Ground of every second place.
const GROUND: &str = "#f4f4f4";
/// Colour and radius of the marks, the slowest growth first.
const CLASSES: [(&str, f64); 4] =
    [("#fdbb84", 1.6), ("#fc8d59", 2.3), ("#d7301f", 3.1), ("#7f0000", 4.0)];

/// What varies over the conditions: the labels of its values, and which of them each condition has.
#[derive(Clone, Debug, PartialEq)]
struct Dimension {
    role: Role,
    /// Mark-up, and the unit of the labels.
    name: String,
    unit: String,
    labels: Vec<String>,
    at: Vec<usize>,
}

/// Where a dimension goes in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    /// Sign of the rotation: panels side by side.
    Direction,
    /// Side by side within a place of the abscissa.
    Friction,
    /// The abscissa before others.
    Pressure,
    Other,
}

/// Frequency of the unstable modes over the operating conditions, marked by growth; one panel for each direction of
/// rotation and each choice of what is left over.
pub(crate) fn operating_matrix(records: &[PointRecord]) -> Option<Figure> {
    let conditions = &conditions(records);
    let modes = || unstable(conditions).map(|own| own.1);
    if conditions.len() < 2 || modes().next().is_none() {
        return None;
    }
    let layout = Layout::of(conditions);
    let largest = modes().map(|mode| mode.growth_rate_per_s);
    let bounds = class_bounds(largest.fold(0.0, f64::max));
    let (low, high) = extremes(modes().map(|mode| mode.frequency_hz));
    let room = (0.12 * (high - low)).max(0.04 * high);
    let ends = ((low - 1.5 * room).max(0.0), high + room);

    // Panels in the order of their choices, the directions side by side.
    let panels: Vec<Panel> = (0..layout.panel_count())
        .take(PANELS)
        .map(|panel| {
            let all = conditions.iter().enumerate();
            let own: Vec<_> = all.filter(|(at, _)| layout.panel(*at) == panel).collect();
            layout.draw(panel, &own, (&bounds, ends))
        })
        .collect();
    let columns = layout.columns.as_ref().map_or(2, |d| d.labels.len()).min(panels.len()).max(1);
    let figure = Figure::new("operating-matrix", layout.caption())
        .columns(columns)
        .shared_y()
        .panels(panels);
    Some(layout.friction_note().into_iter().fold(figure, |figure, note| figure.note(note)))
}

/// Which dimension goes where.
struct Layout {
    columns: Option<Dimension>,
    abscissa: Option<Dimension>,
    within: Option<Dimension>,
    rest: Vec<Dimension>,
}

impl Layout {
    fn of(conditions: &[Condition<'_>]) -> Self {
        let mut all = dimensions(conditions);
        let mut take = |role: Role| {
            let at = all.iter().position(|own| own.role == role)?;
            Some(all.remove(at))
        };
        let (columns, mut within) = (take(Role::Direction), take(Role::Friction));
        let mut abscissa = take(Role::Pressure);
        if abscissa.is_none() && !all.is_empty() {
            let longest = (0..all.len()).rev().max_by_key(|&at| all[at].labels.len());
            abscissa = longest.map(|at| all.remove(at));
        }
        Self { abscissa: abscissa.or_else(|| within.take()), columns, within, rest: all }
    }

    fn panel_count(&self) -> usize {
        self.rest.iter().chain(&self.columns).map(|own| own.labels.len()).product()
    }

    /// The panel that a condition belongs to.
    fn panel(&self, condition: usize) -> usize {
        let digits = self.rest.iter().chain(&self.columns);
        digits.fold(0, |sum, own| sum * own.labels.len() + own.at[condition])
    }

    /// Abscissa of a condition: the place, and in it the friction value.
    fn x(&self, condition: usize) -> f64 {
        let place = self.abscissa.as_ref().map_or(0, |own| own.at[condition]) as f64;
        place
            + self.within.as_ref().map_or(0.0, |own| {
                let count = own.labels.len() as f64;
                FILLED * ((own.at[condition] as f64 + 0.5) / count - 0.5)
            })
    }

    /// One panel: the conditions that were solved along its foot, and their unstable modes.
    fn draw(
        &self,
        panel: usize,
        own: &[(usize, &Condition<'_>)],
        (bounds, (low, high)): (&[f64], (f64, f64)),
    ) -> Panel {
        let labels = self.abscissa.as_ref().map_or(1, |own| own.labels.len());
        let ticks = self.abscissa.iter().flat_map(|own| own.labels.iter());
        let ticks = ticks.enumerate().map(|(at, label)| (at as f64, label.clone()));
        let along = self.abscissa.as_ref();
        let (name, unit) = along.map_or(("", ""), |own| (own.name.as_str(), own.unit.as_str()));
        let x = Axis::new(name, unit).between(-0.5, labels as f64 - 0.5).ticks(ticks);
        let bands = (1..labels).step_by(2).map(|at| (at as f64 - 0.5, at as f64 + 0.5, GROUND));
        let foot = low + 0.025 * (high - low);
        let solved = own.iter().map(|(at, _)| (self.x(*at), foot));
        let mut drawn = Panel::new(x, Axis::kilohertz().between(low, high))
            .plain()
            .height(150.0)
            .layer(Shapes::bands(bands.collect()))
            .layer(
                Points::new(solved)
                    .marker(Marker::Disc, 0.7, MUTED)
                    .name("condition that was solved"),
            );
        for heading in self.headings(panel) {
            drawn = drawn.heading(heading);
        }
        let modes = own.iter().flat_map(|(at, condition)| {
            condition.unstable.iter().map(move |mode| (self.x(*at), *condition, mode))
        });
        // The fastest first, so that none hides behind a larger mark.
        let classes = CLASSES.iter().enumerate().rev().map(|(class, &(colour, radius))| {
            let of_class = modes.clone().filter(|(.., mode)| {
                bounds.partition_point(|bound| *bound <= mode.growth_rate_per_s) == class
            });
            Points::new(of_class.clone().map(|(x, _, mode)| (x, mode.frequency_hz)))
                .marker(Marker::Disc, radius, colour)
                .rows(of_class.clone().map(|(_, condition, _)| condition.point).collect())
                .tips(of_class.map(|(_, condition, mode)| tip(condition, mode)).collect())
                .name(class_name(bounds, class))
        });
        drawn.layers(classes)
    }

    /// The choices that a panel stands for.
    fn headings(&self, mut panel: usize) -> Vec<String> {
        let mut lines = Vec::new();
        for own in self.columns.iter().chain(self.rest.iter().rev()) {
            let label = &own.labels[panel % own.labels.len()];
            panel /= own.labels.len();
            lines.push(match own.role {
                Role::Direction => label.clone(),
                _ => format!("{} = {label} {}", own.name, own.unit).trim_end().to_owned(),
            });
        }
        lines.reverse();
        lines
    }

    /// What lies side by side at each place.
    fn friction_note(&self) -> Option<String> {
        let labels = self.within.as_ref()?.labels.join(", ");
        Some(format!("At each place, from left to right: friction {labels}."))
    }

    fn caption(&self) -> String {
        let mut caption = "Unstable modes under the operating conditions of the study: frequency, marked by growth rate"
            .to_owned();
        if self.panel_count() > PANELS {
            caption += &format!(
                "; the first {PANELS} of {} panels (unstable_modes.csv has all)",
                self.panel_count()
            );
        }
        caption
            + ". A dot at the foot is a condition that was solved: one without marks above it is \
            stable, none at all failed."
    }
}

/// What a mark is, in plain text.
fn tip(condition: &Condition<'_>, mode: &crate::cea::UnstableMode) -> String {
    let critical = mode.critical_friction.map_or_else(String::new, |friction| {
        format!(", unstable from friction {}", fixed(friction, 4))
    });
    let Condition { point, friction_coefficient: friction, swept, .. } = condition;
    let (swept, number) = (swept_text(swept), mode.mode);
    let [hz, rate] = [mode.frequency_hz, mode.growth_rate_per_s].map(|own| fixed(own, 1));
    format!(
        "point {point}: {swept}, friction {friction}: mode {number}, {hz} Hz, {rate} 1/s{critical}"
    )
}

/// Bounds between the classes of growth: the last three of 1, 3, 10, 30, ... below the largest.
fn class_bounds(largest: f64) -> [f64; 3] {
    let bound = |half_decade: i32| match half_decade.rem_euclid(2) {
        0 => 10f64.powi(half_decade / 2),
        _ => 3.0 * 10f64.powi((half_decade - 1) / 2),
    };
    let mut last = (2.0 * largest.max(1e-9).log10()).ceil() as i32 + 1;
    while bound(last) >= largest && last > -20 {
        last -= 1;
    }
    [2, 1, 0].map(|below| bound(last - below))
}

fn class_name(bounds: &[f64], class: usize) -> String {
    match class {
        0 => format!("growth up to {} 1/s", bounds[0]),
        _ if class == bounds.len() => format!("above {} 1/s", bounds[class - 1]),
        _ => format!("{} to {} 1/s", bounds[class - 1], bounds[class]),
    }
}

/// Everything that takes several values over the conditions: the swept keys, those that go together as one, rotation of
/// both signs as direction and speed, and friction.
fn dimensions(conditions: &[Condition<'_>]) -> Vec<Dimension> {
    let mut found: Vec<Dimension> = Vec::new();
    let keys = conditions.first().into_iter().flat_map(|own| own.swept.keys());
    let frictions: Vec<f64> = conditions.iter().map(|own| own.friction_coefficient).collect();
    for key in keys {
        let values: Vec<&Value> = conditions.iter().map(|own| &own.swept[key]).collect();
        let numbers: Option<Vec<f64>> = values.iter().map(|value| value.as_f64()).collect();
        match numbers {
            // The friction of the conditions is a dimension of its own.
            Some(numbers) if key.ends_with("friction_coefficient") && frictions == numbers => {}
            Some(numbers) => of_numbers(key, &numbers, &mut found),
            None => {
                let texts: Vec<String> = values.iter().map(|value| printed(value)).collect();
                let name = (parameter_name(key), String::new());
                let values = (&texts[..], &distinct(texts.clone())[..]);
                add(&mut found, Role::Other, name, values, String::clone);
            }
        }
    }
    let name = ("friction coefficient *μ*".to_owned(), String::new());
    let label = |friction: &f64| literal(&friction.to_string());
    add(&mut found, Role::Friction, name, (&frictions, &rising(&frictions)), label);
    found.retain(|own| own.labels.len() > 1);
    found
}

/// A swept number as one or two dimensions.
fn of_numbers(key: &str, numbers: &[f64], found: &mut Vec<Dimension>) {
    let (low, high) = extremes(numbers.iter().copied());
    let is_speed = key.ends_with("rotation_speed_rpm") || key.ends_with(".speed");
    let is_both_ways = is_speed && low < 0.0 && high > 0.0;
    if is_both_ways {
        let is_reverse: Vec<bool> = numbers.iter().map(|speed| *speed < 0.0).collect();
        let way = |is_reverse: &bool| match is_reverse {
            true => "reverse, speed < 0".to_owned(),
            false => "forward, speed > 0".to_owned(),
        };
        let name = (parameter_name(key), String::new());
        add(found, Role::Direction, name, (&is_reverse, &[false, true]), way);
    }
    let sizes: Vec<f64> = numbers.iter().map(|v| if is_both_ways { v.abs() } else { *v }).collect();
    let (factor, unit) = shared_unit(key, low.abs().max(high.abs()));
    let role = if key.ends_with("pressure") { Role::Pressure } else { Role::Other };
    let name = (parameter_name(key), unit);
    add(found, role, name, (&sizes, &rising(&sizes)), |value| in_unit(*value, factor));
}

/// The distinct ones of some numbers, rising.
fn rising(numbers: &[f64]) -> Vec<f64> {
    let mut distinct = numbers.to_vec();
    distinct.sort_by(f64::total_cmp);
    distinct.dedup();
    distinct
}

/// Adds a dimension with the labels of its distinct values, or its name to one that takes its values at the same
/// conditions.
fn add<T: PartialEq>(
    found: &mut Vec<Dimension>,
    role: Role,
    (name, unit): (String, String),
    (values, distinct): (&[T], &[T]),
    label: impl Fn(&T) -> String,
) {
    let rank = |value: &T| distinct.iter().position(|own| own == value).unwrap_or(0);
    let at: Vec<usize> = values.iter().map(rank).collect();
    let labels: Vec<String> = distinct.iter().map(label).collect();
    let same = |own: &&mut Dimension| own.at == at && own.role == role && labels.len() > 1;
    if let Some(known) = found.iter_mut().find(same) {
        known.name = joined(&known.name, &name);
        return;
    }
    found.push(Dimension { role, name, unit, labels, at });
}

/// The name of two keys that go together: the quantity once, then the names of both parts.
fn joined(one: &str, other: &str) -> String {
    match (one.split_once(", "), other.split_once(", ")) {
        (Some((quantity, names)), Some((same, rest))) if quantity == same => {
            format!("{quantity}, {names} and {rest}")
        }
        _ => format!("{one}; {other}"),
    }
}
