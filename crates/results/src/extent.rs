//! What forces, torques, powers and energies are of.

use crate::prelude::*;

/// What forces, torques, powers and energies are of, `extent` in JSON.
///
/// The columns of tables keep their names: this says how to read `_w`, `_j`, `_n`, `_n_m` there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Described, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Extent {
    /// Of the whole body.
    #[default]
    WholeBody,
    /// Of each metre of the thickness of a plane body, where the case gives no `geometry.thickness`.
    MetreOfThickness,
}

impl Extent {
    /// The unit of a quantity: for each metre "W/m" for "W", but "Hz" for "Hz", which does not grow with the thickness.
    pub fn unit(self, unit: &str) -> String {
        let grows = ["W", "J", "N", "N m", "N/m", "N s/m", "kg"].contains(&unit);
        let is_each = grows && self == Self::MetreOfThickness;
        if is_each { format!("{unit}/m") } else { unit.to_owned() }
    }

    /// A table for people, in these units.
    pub fn table(self, table: Table) -> Table {
        if self == Self::MetreOfThickness { table.for_each_metre() } else { table }
    }

    /// That of a summary, where it says one.
    pub fn of_summary(summary: &Value) -> Option<Self> {
        let own = summary.get("extent").or_else(|| summary.pointer("/base_state/extent"));
        Self::deserialize(own?).ok()
    }

    /// What is to be said beside numbers for each metre; nothing of those of a whole body.
    pub fn sentence(self) -> Option<String> {
        let text = "forces, torques, powers and energies are for each metre of thickness: the case gives no \
                    geometry.thickness.";
        (self == Self::MetreOfThickness).then(|| text.to_owned())
    }
}
