//! Where the growth of each mode comes from, and which modes couple: `contributions.csv` and `coupling.csv`.

use super::branches::{Branch, ModeName, NAMES, SHORT_NAMES, kilohertz};
use super::{CeaReport, ModeFeed};
use crate::common::*;

/// What a contribution comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Described, Serialize)]
pub enum Source {
    /// The material damping of a region.
    Part,
    /// The dashpots of a support.
    Support,
    /// A contact: its friction, its dashpots, the turning of its forces.
    Contact,
    /// The gyroscopic forces of regions that turn with the inertia of their rotation.
    Rotation,
}

impl From<Source> for Cell {
    fn from(source: Source) -> Self {
        Self::from(match source {
            Source::Part => "part",
            Source::Support => "support",
            Source::Contact => "contact",
            Source::Rotation => "rotation",
        })
    }
}

keys! {
    /// The share of one part, support or contact in a mode.
    Contribution, CONTRIBUTIONS {
        /// The mode.
        mode: ModeName;
        name: String = "name of the region, boundary or contact";
        kind: Source = "part, support, contact or rotation";
        kinetic_share: Option<f64> = "share of the kinetic energy; none of what has no mass";
        strain_share: Option<f64> = "share of the strain energy; none of a contact";
        growth_rate_per_s: f64 = "what it adds to the growth rate";
    }
}

/// The share of a mode of the lowest friction value in an unstable mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// The unstable mode.
    pub mode: ModeName,
    /// Its growth rate, 1/s.
    pub growth_rate: f64,
    /// The mode of the lowest friction value.
    pub reference: ModeName,
    /// `|phi_0^H M phi|^2 / (phi_0^H M phi_0  phi^H M phi)`.
    pub share: f64,
}

/// Where growth comes from, and which modes couple.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// Every mode whose shape was solved for, with all that contributes to it.
    pub contributions: Vec<Contribution>,
    /// Every unstable one of them with the modes that it consists of, the largest share first.
    pub couplings: Vec<Coupling>,
    /// Where the contacts feed the unstable modes at the case's own friction coefficient.
    pub feed: Vec<ModeFeed>,
}

columns! {
    /// A mode of the lowest friction value in an unstable mode.
    pub(crate) COUPLINGS: row as Coupling;
    growth_rate_per_s: "growth rate of the unstable mode" = row.growth_rate;
    reference_friction: "lowest friction coefficient" = row.reference.friction_coefficient;
    reference_mode: "number of the mode there, from 1" = row.reference.mode;
    reference_frequency_hz: "its frequency" = row.reference.frequency_hz;
    reference_harmonic: "its nodal diameters; none without symmetry" = row.reference.harmonic;
    share: "share of that mode in the unstable one, 0 to 1" = row.share;
}

impl Reading {
    /// `contributions.csv`: a row for each mode, friction value and part, support or contact.
    pub(super) fn contributions(&self) -> Table {
        let rows = &self.contributions;
        Table::new("contributions.csv", "")
            .columns(NAMES, rows.iter().map(|row| row.mode))
            .columns(CONTRIBUTIONS, rows)
    }

    /// `coupling.csv`: a row for each unstable mode and each mode of the lowest friction value that it consists of.
    pub(super) fn couplings(&self) -> Table {
        let rows = &self.couplings;
        Table::new("coupling.csv", "")
            .columns(SHORT_NAMES, rows.iter().map(|row| row.mode))
            .columns(COUPLINGS, rows)
    }

    /// The unstable modes at a friction coefficient in a sentence each, the fastest first: which modes couple, what
    /// feeds and what takes.
    pub(super) fn sentences(&self, friction: f64, most: usize) -> Vec<String> {
        let own = self.couplings.iter().filter(|row| row.mode.friction_coefficient == friction);
        let unstable = grouped(own.map(|row| (row.mode, row)));
        let unstable = sorted(unstable, |(_, own)| -own[0].growth_rate);
        unstable.iter().take(most).map(|(mode, own)| self.sentence(mode, own)).collect()
    }

    /// An unstable mode, and what it consists of.
    fn sentence(&self, mode: &ModeName, own: &[&Coupling]) -> String {
        let partner = |row: &&Coupling| {
            let (name, frequency) = (row.reference.mode, kilohertz(&row.reference));
            format!("{name} ({frequency}, {:.0} %)", 100.0 * row.share)
        };
        let notable = own.iter().take_while(|row| row.share >= NOTABLE).take(2);
        let partners: Vec<String> = notable.map(partner).collect();
        let start = own[0].reference.friction_coefficient;
        let partners = match partners.as_slice() {
            // Nothing is told of a mode by itself.
            _ if start == mode.friction_coefficient => String::new(),
            [one] => format!(" comes from mode {one} of friction {start}"),
            [one, other] => format!(" couples modes {one} and {other} of friction {start}"),
            _ => format!(" consists of many modes of friction {start}"),
        };
        let budget = self.contributions.iter().filter(|row| row.mode == *mode);
        let largest = budget.clone().map(|row| row.growth_rate_per_s.abs()).fold(0.0, f64::max);
        let budget: Vec<String> = budget
            .filter(|row| row.growth_rate_per_s.abs() >= LEAST_RATE * largest)
            .map(|row| {
                let verb = if row.growth_rate_per_s > 0.0 { "feeds" } else { "takes" };
                let rate = fixed(row.growth_rate_per_s.abs(), 1);
                format!("{} {verb} {rate} 1/s", row.name)
            })
            .collect();
        format!("mode {} ({}){partners}: {}", mode.mode, kilohertz(mode), budget.join(", "))
    }

    /// The branches that reach the largest growth rates, the fastest first.
    fn fastest(&self) -> Vec<Branch> {
        let rates = self.couplings.iter().map(|own| (branch_of_mode(&own.mode), own.growth_rate));
        let largest = |rates: &[f64]| rates.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let fastest = sorted(grouped(rates), |(_, rates)| -largest(rates));
        fastest.into_iter().map(|(branch, _)| branch).collect()
    }
}

/// Part of the largest contribution from which on another one is named.
const LEAST_RATE: f64 = 1e-3;

/// Share from which on a mode is named.
const NOTABLE: f64 = 0.05;

/// Panels of the figure, at most.
const PANELS: usize = 6;

/// Growth rate over friction of the modes that grow fastest, and what each part, support and contact adds to it.
pub(super) fn budget(report: &CeaReport<'_>, reading: &Reading) -> Option<Figure> {
    let frictions = reading.contributions.iter().map(|row| row.mode.friction_coefficient);
    let frictions = distinct(frictions.filter(|own| report.friction_coefficients.contains(own)));
    if frictions.len() < 3 {
        return None;
    }
    // Each branch by itself: its rows are found once.
    let rows = grouped(reading.contributions.iter().map(|row| (branch_of_mode(&row.mode), row)));
    let rows = BTreeMap::from_iter(rows);
    let panels = reading.fastest().into_iter().take(PANELS).map(|branch| {
        // As tables and other figures name it.
        budget_panel(report.branch_name(branch), &rows[&branch], &frictions)
    });
    let caption = "Growth rate of the fastest modes over friction, and what each part, support and contact adds to it.";
    Some(Figure::new("budget", caption).columns(2).shared_x().panels(panels))
}

/// The growth rate of one branch, and its parts.
fn budget_panel(name: String, rows: &[&Contribution], frictions: &[f64]) -> Panel {
    let names = distinct(rows.iter().map(|row| row.name.as_str()));
    let total = frictions.iter().filter_map(|&friction| {
        let is_there = |row: &&&Contribution| row.mode.friction_coefficient == friction;
        let mut own = rows.iter().filter(is_there).peekable();
        own.peek()?;
        Some((friction, own.map(|row| row.growth_rate_per_s).sum::<f64>()))
    });
    let last = rows.last().map_or(0.0, |row| row.mode.frequency_hz);
    let mut panel = Panel::new(Axis::friction().tight(), Axis::new("growth rate", "1/s"))
        .height(90.0)
        .caption(format!("{name}, {} kHz", fixed(1e-3 * last, 2)))
        .layer(Rule::horizontal(0.0).stroke(Stroke::solid(INK, 0.6)))
        .layer(Line::through(total).solid(INK, 1.4).name("growth rate"));
    for (place, name) in names.into_iter().enumerate() {
        let own = rows.iter().filter(|row| row.name == name);
        let points = own.map(|row| (row.mode.friction_coefficient, row.growth_rate_per_s));
        panel = panel.layer(Line::through(points).nth(place).name(literal(name)));
    }
    panel
}

/// The branch of a mode.
fn branch_of_mode(mode: &ModeName) -> Branch {
    // Waves around a body made of one sector are numbered together.
    let harmonic = mode.harmonic.filter(|_| mode.direction.is_some());
    (harmonic.unwrap_or(0), mode.branch, mode.direction.unwrap_or(0))
}
