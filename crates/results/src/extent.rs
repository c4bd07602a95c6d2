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
    /// The unit of a quantity that grows with the thickness: "W", or "W/m" for each metre of it.
    pub fn unit(self, unit: &str) -> String {
        match self {
            Self::WholeBody => unit.to_owned(),
            Self::MetreOfThickness => format!("{unit}/m"),
        }
    }

    /// What is to be said beside numbers for each metre; nothing of those of a whole body.
    pub fn sentence(self) -> Option<String> {
        let text = "forces, torques, powers and energies are for each metre of thickness: the case gives no \
                    geometry.thickness.";
        (self == Self::MetreOfThickness).then(|| text.to_owned())
    }
}
