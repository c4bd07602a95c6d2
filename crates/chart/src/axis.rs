//! Specification of an axis, before the data are known.

use crate::prelude::*;

/// How the ends of an axis follow from the data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
enum Ends {
    /// Room at either end, as a fraction of the range.
    Room(f64),
    /// These.
    At(f64, f64),
    /// Equally far from zero.
    #[default]
    Symmetric,
}

/// One axis of a panel: quantity, unit, scale, ends.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    quantity: String,
    unit: String,
    scale: Scale,
    factor: Option<f64>,
    ends: Ends,
    includes: Vec<f64>,
    decades: f64,
    ticks: Option<Vec<Tick>>,
}

impl Axis {
    /// A linear axis for values in this unit, with a little room around the data; names are mark-up, an empty unit
    /// shows none.
    pub fn new(quantity: &str, unit: &str) -> Self {
        Self {
            quantity: quantity.into(),
            unit: unit.into(),
            factor: Some(1.0),
            ends: Ends::Room(0.04),
            decades: 300.0,
            ..Self::default()
        }
    }

    /// The time of a run, s, with the prefix that suits it.
    pub fn time() -> Self {
        Self::new("time *t*", "s").prefixed().tight()
    }

    /// Frequencies, Hz, shown in kHz.
    pub fn kilohertz() -> Self {
        Self::new("frequency *f*", "kHz").times(1e-3)
    }

    /// Angles, rad, shown over a full turn in degrees.
    pub fn angle() -> Self {
        let quarters =
            [0, 90, 180, 270, 360].map(|degrees| (f64::from(degrees), degrees.to_string()));
        let circle = Self::degrees().between(0.0, std::f64::consts::TAU);
        circle.ticks(quarters)
    }

    /// An angle, as much of the circle as the data take; data in rad.
    pub fn degrees() -> Self {
        Self::new("angle *θ*", "°").times(180.0 / std::f64::consts::PI)
    }

    /// The friction coefficient.
    pub fn friction() -> Self {
        Self::new("friction coefficient *μ*", "–")
    }

    /// Quantity and unit, as they are shown without a prefix.
    pub fn title(&self) -> String {
        titled(&self.quantity, &self.unit)
    }

    /// The ends, where they are given.
    pub(super) fn given(&self) -> Option<(f64, f64)> {
        if let Ends::At(low, high) = self.ends { Some((low, high)) } else { None }
    }

    /// The axis once the range of the data is known (in their unit; of the positive ones on a logarithmic axis).
    pub(super) fn resolve(&self, data: Option<(f64, f64)>) -> Ruler {
        let all = data.into_iter().flat_map(|(low, high)| [low, high]);
        let positive = |v: &f64| self.scale == Scale::Linear || *v > 0.0;
        let (low, high) = extremes(all.chain(self.includes.iter().copied()).filter(positive));
        let (low, high) = match (self.ends, self.scale) {
            (Ends::At(low, high), _) => (low, high),
            (Ends::Room(part), Scale::Linear) => {
                let room = part * (high - low);
                // Zero, where it is an end by itself, stays one.
                let keeps = |end: f64| end == 0.0 && self.includes.contains(&0.0);
                let room_at = |end: f64| if keeps(end) { 0.0 } else { room };
                (low - room_at(low), high + room_at(high))
            }
            (Ends::Symmetric, _) => {
                let reach = 1.05 * low.abs().max(high.abs());
                (-reach, reach)
            }
            // Without a positive value there is nothing to go by.
            (Ends::Room(_), Scale::Logarithmic) if low <= 0.0 => (0.1, 1.0),
            (Ends::Room(part), Scale::Logarithmic) => {
                let low = low.max(high * 10f64.powf(-self.decades));
                let room = (high / low).powf(part).max(if part > 0.0 { 1.25 } else { 1.0 });
                (low / room, high * room)
            }
        };
        let reach = low.abs().max(high.abs());
        let (factor, unit) = match self.factor {
            Some(factor) => (factor, self.unit.clone()),
            // A hair below a power of ten is that power.
            None => prefixed(reach * 0.9995, &self.unit),
        };
        let title = titled(&self.quantity, &unit);
        let ruler = Ruler::new(title, self.scale, factor, (low, high), self.ticks.clone());
        Ruler { declared: self.title(), ..ruler }
    }

    pub(super) fn is_logarithmic(&self) -> bool {
        self.scale == Scale::Logarithmic
    }
}

changed! { Axis:
    /// The same, logarithmic.
    logarithmic() => { scale: Scale::Logarithmic }
    /// The same, logarithmic over at most so many decades below the largest value.
    decades(decades: f64) => { decades: decades, scale: Scale::Logarithmic }
    /// The same without room at the ends.
    tight() => { ends: Ends::Room(0.0) }
    /// The same, long enough for one more value.
    including(value: f64) => [includes: [value]]
    /// The same with these ticks: value in the unit shown, label.
    ticks(ticks: impl IntoIterator<Item = (f64, String)>) => {
        ticks: Some(ticks.into_iter().map(|(value, label)| Tick { value, label }).collect())
    }
    /// The same for values that the unit shown is a multiple of: 1e-3 for kHz from Hz.
    times(factor: f64) => { factor: Some(factor) }
    /// The same with the unit's prefix chosen by the data.
    prefixed() => { factor: None }
    /// The same with a scale.
    scaled(scale: Scale) => { scale: scale }
    /// The same with room at the ends, as a fraction of the range.
    room(fraction: f64) => { ends: Ends::Room(fraction) }
    /// The same between two values, in the unit of the data.
    between(low: f64, high: f64) => { ends: Ends::At(low, high) }
    /// The same with zero in the middle.
    symmetric() => { ends: Ends::Symmetric }
}

fn titled(quantity: &str, unit: &str) -> String {
    if unit.is_empty() { quantity.to_owned() } else { format!("{quantity} ({unit})") }
}
